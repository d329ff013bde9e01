// SPDX-License-Identifier: BSD-3-Clause
// Inputs are read where they are and nowhere else: each array ends where a page without access begins (and
// once begins where one ends), lies in memory that cannot be written, and may be aligned as badly as a
// Fortran array.
#include <gtest/gtest.h>

#include <sys/mman.h>
#include <unistd.h>

#include "sample_count.hpp"
#include "support/element.hpp"

namespace input_bounds_test {
namespace {

using namespace test;

// A copy of numbers, between pages without access; read only.
class Fenced {
public:
  enum Side { at_front, at_back };
  Fenced(const std::vector<double>& values, Side side) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t bytes = values.size() * sizeof(double), room = (bytes + page - 1) / page * page;
    size_ = room + 2 * page;
    start_ = static_cast<char*>(mmap(nullptr, size_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    if (start_ == MAP_FAILED) throw std::bad_alloc();
    mprotect(start_ + page, room, PROT_READ | PROT_WRITE);
    char* place = start_ + page + (side == at_back ? room - bytes : 0);
    std::memcpy(place, values.data(), bytes);
    mprotect(start_ + page, room, PROT_READ);
    data_ = reinterpret_cast<const double*>(place);
  }
  ~Fenced() { munmap(start_, size_); }
  Fenced(const Fenced&) = delete;
  Fenced& operator=(const Fenced&) = delete;
  const double* data() const { return data_; }

private:
  char* start_;
  std::size_t size_;
  const double* data_;
};

std::vector<Element> some_elements(const Model& model, const Basis& b, Random& random) {
  std::vector<Element> elements;
  for (int i = 0; i < 4; ++i) {
    Element e = draw(model, b, random);
    if (i % 2 == 1) e = with_history(model, std::move(e), random);
    if (i == 2) e[start].clear();
    elements.push_back(std::move(e));
  }
  return elements;
}

TEST(InputBounds, EvaluationReadsItsArraysAndNothingBeside) {
  Random random(61);
  for (const ModelKind& kind : all_kinds()) {
    const Model model(text(kind));
    for (const Element& e : some_elements(model, basis(kind.basis), random)) {
      Results expected(model.layout), results(model.layout);
      const int32_t status = test::evaluate(model, e, want_all, expected);
      for (const Fenced::Side side : {Fenced::at_front, Fenced::at_back}) {
        ents_input input = input_of(e);
        std::vector<std::unique_ptr<Fenced>> arrays;
        for (int i = 0; i < input_count; ++i)
          if (!e[i].empty()) {
            arrays.push_back(std::make_unique<Fenced>(e[i], side));
            input.*inputs[i].pointer = arrays.back()->data();
          }
        const ents_output output = output_of(results, want_all);
        ASSERT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{1}, &input, &output, nullptr), status);
        ASSERT_TRUE(same_bits(results, expected)) << text(kind);
      }
    }
  }
}

// The begin of the increment is not written, whatever comes of it: its memory is read only above; and the
// model is the same after many evaluations as before.
TEST(InputBounds, StateAndModelStayAsTheyAre) {
  Random random(62);
  for (const ModelKind& kind : some_kinds()) {
    const Model model(text(kind));
    const Element e = with_history(model, draw(model, basis(kind.basis), random), random);
    Results first(model.layout), last(model.layout);
    test::evaluate(model, e, want_all, first);
    const Fenced state(e[state_begin], Fenced::at_back);
    ents_input input = input_of(e);
    input.state_begin = state.data();
    for (int i = 0; i < test::samples(1000); ++i) { // iterations of an increment that are thrown away
      Element trial = e;
      for (double& x : trial[slave]) x += random(-0.1, 0.1);
      ents_input other = input_of(trial);
      other.state_begin = state.data();
      const ents_output output = output_of(last, want_all);
      call::evaluate(model.get(), int64_t{0}, int64_t{1}, &other, &output, nullptr);
    }
    Results fresh(model.layout);
    const ents_output output = output_of(fresh, want_all);
    call::evaluate(model.get(), int64_t{0}, int64_t{1}, &input, &output, nullptr);
    EXPECT_TRUE(same_bits(fresh, first)) << text(kind);
  }
}

TEST(InputBounds, OtherFunctionsReadTheirArraysAndNothingBeside) {
  Random random(63);
  for (const ModelKind& kind : some_kinds()) {
    const Model model(text(kind));
    const Basis& b = basis(kind.basis);
    Element e = with_new_state(model, draw(model, b, random));
    const std::vector<double> xi = centre(b);
    std::vector<double> point(static_cast<std::size_t>(b.dimension));
    for (const Fenced::Side side : {Fenced::at_front, Fenced::at_back}) {
      const Fenced nodes(e[master], side), where(xi, side), state(e[state_begin], side);
      ents_surface s{};
      s.struct_size = sizeof s;
      s.master = nodes.data();
      s.xi = where.data();
      s.point = point.data();
      EXPECT_EQ(call::surface_evaluate(model.get(), int64_t{1}, &s, nullptr), ENTS_OK);
      ents_admissibility result{};
      result.struct_size = sizeof result;
      result.samples = 5;
      call::model_check(model.get(), nodes.data(), nullptr, &result, nullptr);
      std::vector<double> moved = e[state_begin];
      EXPECT_EQ(call::state_transfer(model.get(), nodes.data(), nullptr, nodes.data(), nullptr, state.data(),
                                     moved.data(), nullptr),
                ENTS_OK);
    }
  }
  const std::vector<double> square = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const Fenced positions(square, Fenced::at_back);
  const int64_t connectivity[] = {0, 1, 2, 3};
  double areas[4];
  EXPECT_EQ(call::tributary_areas("quad4", 1, connectivity, 4, positions.data(), 0.0, areas, nullptr),
            ENTS_OK);
}

// The text is not zero-terminated and ends where access ends.
TEST(InputBounds, ModelTextIsReadToItsLength) {
  for (const ModelKind& kind : some_kinds()) {
    std::string t = text(kind);
    while (t.size() % sizeof(double) != 0) t += ' ';
    std::vector<double> bytes(t.size() / sizeof(double));
    std::memcpy(bytes.data(), t.data(), t.size());
    const Fenced fenced(bytes, Fenced::at_back);
    ents_model* model = nullptr;
    ents_report report = new_report();
    EXPECT_EQ(call::model_create(reinterpret_cast<const char*>(fenced.data()), static_cast<int64_t>(t.size()),
                                 nullptr, nullptr, int64_t{0}, &model, &report),
              ENTS_OK)
        << report.message;
    call::model_destroy(&model, nullptr);
    // cut short at the end of access: an error, not a read beyond it
    EXPECT_EQ(call::model_create(reinterpret_cast<const char*>(fenced.data()) + t.size() - 8, int64_t{8},
                                 nullptr, nullptr, int64_t{0}, &model, &report),
              ENTS_JSON_SYNTAX);
  }
}

// All arrays, in and out, at addresses 8 beyond a multiple of 16 and of 64.
TEST(InputBounds, AnyAlignmentGivesTheSameBits) {
  Random random(64);
  for (const ModelKind& kind : all_kinds()) {
    const Model model(text(kind));
    const Element e = with_history(model, draw(model, basis(kind.basis), random), random);
    Results expected(model.layout);
    const int32_t status = test::evaluate(model, e, want_all, expected);
    for (const std::size_t shift : {1, 2, 3, 5}) {
      // doubles in 64-byte blocks, each array `shift` doubles behind the start of one
      struct alignas(64) Block {
        double v[8];
      };
      const auto blocks = [&](std::size_t size) { return std::vector<Block>((size + shift + 7) / 8); };
      std::vector<std::vector<Block>> memory;
      ents_input input = input_of(e);
      for (int i = 0; i < input_count; ++i) {
        if (e[i].empty()) continue;
        memory.push_back(blocks(e[i].size()));
        double* place = memory.back()[0].v + shift;
        std::memcpy(place, e[i].data(), e[i].size() * sizeof(double));
        input.*inputs[i].pointer = place;
      }
      Results results(model.layout);
      ents_output output = output_of(results, want_all);
      std::vector<double*> places;
      for (int i = 0; i < output_count; ++i) {
        memory.push_back(blocks(results[i].size()));
        output.*outputs[i].pointer = memory.back()[0].v + shift;
        places.push_back(output.*outputs[i].pointer);
      }
      ASSERT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{1}, &input, &output, nullptr), status);
      for (int i = 0; i < output_count && status == ENTS_OK; ++i)
        ASSERT_EQ(std::memcmp(places[static_cast<std::size_t>(i)], expected[i].data(),
                              expected[i].size() * sizeof(double)),
                  0)
            << outputs[i].name << " shifted by " << shift << " " << text(kind);
    }
  }
}

} // namespace
} // namespace input_bounds_test
