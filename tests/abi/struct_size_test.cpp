// SPDX-License-Identifier: BSD-3-Clause
// Structs of older and newer callers: a shorter one is served, a longer one if its unknown tail is zero;
// anything else is refused with a message that names the struct.
#include <gtest/gtest.h>

#include <climits>
#include <functional>

#include "support/element.hpp"

namespace struct_size_test {
namespace {

using namespace test;

// The caller's memory of a struct: `known` bytes as this header has them, then a tail.
template <class Struct> class Callers {
public:
  Callers(const Struct& known, int32_t size, bool zero_tail)
      : memory_(sizeof(Struct) + 128, zero_tail ? '\0' : '\5') {
    std::memcpy(memory_.data(), &known, sizeof known);
    std::memcpy(memory_.data(), &size, sizeof size);
  }
  Struct* get() { return reinterpret_cast<Struct*>(memory_.data()); }
  const Struct& value() const { return *reinterpret_cast<const Struct*>(memory_.data()); }
  // Bytes from `from` on are as they were made.
  bool untouched(const Struct& known, std::size_t from, bool zero_tail) const {
    const auto* made = reinterpret_cast<const char*>(&known);
    for (std::size_t i = from; i < memory_.size(); ++i)
      if (memory_[i] != (i < sizeof(Struct) ? made[i] : zero_tail ? '\0' : '\5')) return false;
    return true;
  }

private:
  std::vector<char> memory_;
};

// Every size worth a try.
template <class Struct> std::vector<int32_t> sizes() {
  const auto known = static_cast<int32_t>(sizeof(Struct));
  std::vector<int32_t> all = {INT_MIN, -8, -1, 0, 4, INT_MAX, INT_MAX - 7, 1 << 16, (1 << 16) + 8};
  for (int32_t size = 8; size < known - 8; size += 8) all.push_back(size);
  for (int32_t size = std::max(known - 8, 5); size <= known + 64; ++size) all.push_back(size);
  return all;
}

enum class SizeVerdict { served, refused };
template <class Struct> SizeVerdict verdict(int32_t size, bool zero_tail) {
  const auto known = static_cast<int32_t>(sizeof(Struct));
  if (size < 8 || size > 1 << 16 || size % static_cast<int32_t>(alignof(Struct)) != 0)
    return SizeVerdict::refused;
  return size <= known || zero_tail ? SizeVerdict::served : SizeVerdict::refused;
}

// `call` must end with ENTS_OK, or with `short_status` where the struct is too short for what the call needs.
template <class Struct>
void try_sizes(const char* name, const Struct& known,
               const std::function<int32_t(Struct*, ents_report*)>& call, int32_t needed_size,
               int32_t short_status) {
  for (const bool zero_tail : {true, false})
    for (const int32_t size : sizes<Struct>()) {
      if (size > static_cast<int32_t>(sizeof(Struct)) + 128 && size <= 1 << 16)
        continue; // more than the memory of this test
      SCOPED_TRACE(std::string(name) + " size " + std::to_string(size) +
                   (zero_tail ? ", zero tail" : ", tail in use"));
      Callers<Struct> callers(known, size, zero_tail);
      ents_report report = new_report();
      const int32_t status = call(callers.get(), &report);
      if (verdict<Struct>(size, zero_tail) == SizeVerdict::refused) {
        EXPECT_EQ(status, ENTS_STRUCT_SIZE);
        EXPECT_NE(std::string(report.message).find(name), std::string::npos) << report.message;
        EXPECT_TRUE(callers.untouched(known, sizeof(int32_t), zero_tail));
      } else {
        EXPECT_EQ(status, size < needed_size ? short_status : ENTS_OK) << report.message;
        EXPECT_TRUE(
            callers.untouched(known, std::min(sizeof(Struct), static_cast<std::size_t>(size)), zero_tail))
            << "written beyond the caller's struct";
      }
    }
}

const ModelKind kind = {"quad4", "sine"};

TEST(StructSize, Input) {
  const Model model(text(kind));
  Random random(91);
  const Element e = draw(model, basis("quad4"), random);
  Results results(model.layout);
  const ents_output output = output_of(results, ENTS_GAP);
  const auto master_ends = static_cast<int32_t>(offsetof(ents_input, master_stride));
  try_sizes<ents_input>(
      "input", input_of(e),
      [&](ents_input* input, ents_report* report) {
        return call::evaluate(model.get(), int64_t{0}, int64_t{1}, input, &output, report);
      },
      master_ends, ENTS_NULL_ARGUMENT);
}

TEST(StructSize, Output) {
  const Model model(text(kind));
  Random random(92);
  const Element e = draw(model, basis("quad4"), random);
  Results results(model.layout);
  const ents_input input = input_of(e);
  const auto gap_ends = static_cast<int32_t>(offsetof(ents_output, gap_stride));
  try_sizes<ents_output>(
      "output", output_of(results, ENTS_GAP),
      [&](ents_output* output, ents_report* report) {
        return call::evaluate(model.get(), int64_t{0}, int64_t{1}, &input, output, report);
      },
      gap_ends, ENTS_NULL_ARGUMENT);
}

// An older caller's results are those of a newer one: the fields it does not have count as zero.
TEST(StructSize, ShorterStructsGiveTheSameResults) {
  const Model model(text(kind));
  Random random(93);
  const Element e = draw(model, basis("quad4"), random);
  Results expected(model.layout), results(model.layout);
  Element plain = e; // what the shorter input still has
  for (const int i : {surface_coordinates, start, area}) plain[i].clear();
  ASSERT_EQ(test::evaluate(model, plain, ENTS_GAP | ENTS_RESIDUAL, expected), ENTS_OK);
  ents_input input = input_of(e);
  input.struct_size = offsetof(ents_input, surface_coordinates);
  const ents_output output = output_of(results, ENTS_GAP | ENTS_RESIDUAL);
  ASSERT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{1}, &input, &output, nullptr), ENTS_OK);
  EXPECT_TRUE(same_bits(results.of(ENTS_RESIDUAL), expected.of(ENTS_RESIDUAL)));
}

TEST(StructSize, Layout) {
  const Model model(text(kind));
  ents_layout layout{};
  layout.struct_size = sizeof layout;
  try_sizes<ents_layout>(
      "layout", layout,
      [&](ents_layout* l, ents_report* report) {
        const int32_t status = call::model_layout(model.get(), l, report);
        if (status == ENTS_OK && l->struct_size >= 12) {
          EXPECT_EQ(l->nodes, 4);
        }
        return status;
      },
      0, ENTS_OK);
}

TEST(StructSize, Surface) {
  const Model model(text(kind));
  const std::vector<double> nodes = flat_master(basis("quad4")), xi = {0.1, 0.2};
  std::vector<double> point(3);
  ents_surface surface{};
  surface.struct_size = sizeof surface;
  surface.master = nodes.data();
  surface.xi = xi.data();
  surface.point = point.data();
  try_sizes<ents_surface>(
      "surface", surface,
      [&](ents_surface* s, ents_report* report) {
        return call::surface_evaluate(model.get(), int64_t{1}, s, report);
      },
      offsetof(ents_surface, point), ENTS_NULL_ARGUMENT);
}

TEST(StructSize, Admissibility) {
  const Model model(text(kind));
  const std::vector<double> nodes = flat_master(basis("quad4"));
  ents_admissibility result{};
  result.struct_size = sizeof result;
  result.samples = 3;
  try_sizes<ents_admissibility>(
      "result", result,
      [&](ents_admissibility* r, ents_report* report) {
        return call::model_check(model.get(), nodes.data(), nullptr, r, report);
      },
      0, ENTS_OK);
}

TEST(StructSize, SurfaceAdmissibility) {
  const Model model(text(kind));
  const std::vector<double> nodes = flat_master(basis("quad4"));
  const int64_t connectivity[] = {0, 1, 2, 3};
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = 1, mesh.nodes = 4;
  mesh.connectivity = connectivity, mesh.positions = nodes.data();
  ents_surface_admissibility result{};
  result.struct_size = sizeof result;
  result.samples = 3;
  try_sizes<ents_surface_admissibility>(
      "result", result,
      [&](ents_surface_admissibility* r, ents_report* report) {
        return call::surface_check(model.get(), &mesh, r, report);
      },
      0, ENTS_OK);
}

TEST(StructSize, Data) {
  const double values[4] = {0.0, 0.1, 0.2, 0.1};
  ents_data data{};
  data.struct_size = sizeof data;
  data.name = "scan";
  data.values = values;
  data.rows = 1;
  data.columns = 4;
  const char* t =
      R"({"segment": "line2", "height": {"type": "map", "data": "scan", "boundary": "periodic", "size": [1]}})";
  const auto create = [&](ents_data* d, int64_t count, ents_report* report) {
    ents_model* model = nullptr;
    const int32_t status = call::model_create(t, int64_t{-1}, nullptr, d, count, &model, report);
    EXPECT_EQ(model != nullptr, status == ENTS_OK);
    call::model_destroy(&model, nullptr);
    return status;
  };
  for (const bool zero_tail : {true, false})
    for (const int32_t size : sizes<ents_data>()) {
      if (size > static_cast<int32_t>(sizeof(ents_data)) + 128 && size <= 1 << 16) continue;
      SCOPED_TRACE(size);
      Callers<ents_data> callers(data, size, zero_tail);
      ents_report report = new_report();
      const int32_t status = create(callers.get(), 1, &report);
      if (verdict<ents_data>(size, zero_tail) == SizeVerdict::refused)
        EXPECT_EQ(status, ENTS_STRUCT_SIZE) << report.message;
      else if (size < static_cast<int32_t>(offsetof(ents_data, rows)))
        EXPECT_EQ(status, ENTS_NULL_ARGUMENT) << report.message;
      else // the sizes are missing, or the columns: zero
        EXPECT_EQ(status, size < static_cast<int32_t>(sizeof data) ? ENTS_BAD_COUNT : ENTS_OK)
            << report.message;
    }
  // structs of a newer caller lie as far apart as its struct is long; all say the same size
  struct Newer {
    ents_data known;
    double unknown;
  };
  Newer two[2] = {{data, 0.0}, {data, 0.0}};
  two[0].known.name = "other";
  two[0].known.struct_size = two[1].known.struct_size = sizeof(Newer);
  ents_report report = new_report();
  EXPECT_EQ(create(&two[0].known, 2, &report), ENTS_OK) << report.message;
  two[1].known.struct_size = sizeof(ents_data);
  EXPECT_EQ(create(&two[0].known, 2, &report), ENTS_STRUCT_SIZE);
  EXPECT_NE(std::string(report.message).find("data[1]"), std::string::npos) << report.message;
}

// The report itself: as much of it as the caller has is written, nothing beyond.
TEST(StructSize, Report) {
  for (const bool zero_tail : {true, false})
    for (const int32_t size : sizes<ents_report>()) {
      if (size > static_cast<int32_t>(sizeof(ents_report)) + 128 && size <= 1 << 16) continue;
      SCOPED_TRACE(std::to_string(size) + (zero_tail ? ", zero tail" : ", tail in use"));
      for (const bool good : {true, false}) {
        ents_report known{};
        std::memset(known.message, 'x', sizeof known.message);
        Callers<ents_report> callers(known, size, zero_tail);
        const int32_t status = call::check_contract(good ? ENTS_CONTRACT_MAJOR : 99, 0, callers.get());
        if (verdict<ents_report>(size, zero_tail) == SizeVerdict::refused) {
          EXPECT_EQ(status, ENTS_STRUCT_SIZE);
          EXPECT_TRUE(callers.untouched(known, sizeof(int32_t), zero_tail));
          continue;
        }
        EXPECT_EQ(status, good ? ENTS_OK : ENTS_VERSION);
        EXPECT_EQ(callers.value().status, status);
        EXPECT_TRUE(
            callers.untouched(known, std::min(sizeof known, static_cast<std::size_t>(size)), zero_tail));
        const std::size_t has = static_cast<std::size_t>(size);
        if (has >= offsetof(ents_report, step_factor)) {
          EXPECT_EQ(callers.value().element, -1);
        }
        if (has >= offsetof(ents_report, message)) {
          EXPECT_EQ(callers.value().step_factor, 1.0);
        }
        if (has > offsetof(ents_report, message)) {
          const std::size_t room = std::min(has - offsetof(ents_report, message), sizeof known.message);
          EXPECT_LT(strnlen(callers.value().message, room), room) << "not terminated";
          EXPECT_EQ(callers.value().message[0] == '\0', good);
        }
      }
    }
}

// A long message is cut to the room that is left, between characters of UTF-8.
TEST(StructSize, LongMessagesAreCut) {
  std::string t = R"({"segment": "quad4", ")";
  for (int i = 0; i < 40; ++i) t += "\xC3\xA4"; // a with two dots
  t += R"(": 1})";
  std::string whole;
  for (auto size = static_cast<int32_t>(sizeof(ents_report));
       size > static_cast<int32_t>(offsetof(ents_report, message)); size -= 8) {
    SCOPED_TRACE(size);
    ents_report known{};
    std::memset(known.message, 'x', sizeof known.message);
    Callers<ents_report> callers(known, size, true);
    ents_model* model = nullptr;
    EXPECT_EQ(call::model_create(t.c_str(), int64_t{-1}, nullptr, nullptr, int64_t{0}, &model, callers.get()),
              ENTS_UNKNOWN_KEY);
    EXPECT_TRUE(callers.untouched(known, static_cast<std::size_t>(size), true))
        << "written beyond the caller's report";
    const std::size_t room = static_cast<std::size_t>(size) - offsetof(ents_report, message);
    const std::size_t length = strnlen(callers.value().message, room);
    ASSERT_LT(length, room) << "not terminated";
    const std::string message(callers.value().message, length);
    if (whole.empty()) whole = message;
    EXPECT_EQ(message, whole.substr(0, length));
    EXPECT_GE(length + 2, std::min(room, whole.size() + 2)) << "cut by more than a character";
    EXPECT_NE(static_cast<unsigned char>(length < whole.size() ? whole[length] : 'x') & 0xC0, 0x80)
        << "half a character";
  }
  EXPECT_GT(whole.size(), 100u);
}

// A reserved field holds zero: what stands there by chance must not get a meaning in a later version.
TEST(StructSize, ReservedFieldsAreZero) {
  const Model model(text(kind));
  Random random(94);
  const Element e = draw(model, basis("quad4"), random);
  Results results(model.layout);
  ents_input input = input_of(e);
  input.reserved = 3;
  const ents_output output = output_of(results, ENTS_GAP);
  ents_report report = new_report();
  EXPECT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{1}, &input, &output, &report), ENTS_STRUCT_SIZE);
  EXPECT_NE(std::string(report.message).find("input.reserved"), std::string::npos) << report.message;
  ents_surface surface{};
  surface.struct_size = sizeof surface;
  surface.reserved = 1;
  EXPECT_EQ(call::surface_evaluate(model.get(), int64_t{0}, &surface, &report), ENTS_STRUCT_SIZE);
  EXPECT_NE(std::string(report.message).find("surface.reserved"), std::string::npos) << report.message;
  ents_admissibility result{};
  result.struct_size = sizeof result;
  result.reserved = -1;
  EXPECT_EQ(call::model_check(model.get(), e[master].data(), nullptr, &result, &report), ENTS_STRUCT_SIZE);
  EXPECT_NE(std::string(report.message).find("result.reserved"), std::string::npos) << report.message;
}

} // namespace
} // namespace struct_size_test
