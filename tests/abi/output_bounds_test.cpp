// SPDX-License-Identifier: BSD-3-Clause
// Exactly what is wanted is written, all of it, and nothing beside it: outputs lie between guard zones,
// everything is filled with a pattern before. After an error nothing has changed.
#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "support/element.hpp"

namespace output_bounds_test {
namespace {

using namespace test;

// A signalling NaN with a payload that no computation makes.
const std::uint64_t pattern = 0x7ff4'dead'beef'0001;
constexpr std::size_t guard = 64; // doubles on each side

class Guarded {
public:
  explicit Guarded(std::size_t size) : words_(size + 2 * guard, pattern) {}
  double* data() { return reinterpret_cast<double*>(words_.data() + guard); }
  std::size_t size() const { return words_.size() - 2 * guard; }
  bool written(std::size_t i) const { return words_[guard + i] != pattern; }
  bool guards_intact() const {
    for (std::size_t i = 0; i < guard; ++i)
      if (words_[i] != pattern || words_[words_.size() - 1 - i] != pattern) return false;
    return true;
  }
  void refill() { words_.assign(words_.size(), pattern); }

private:
  std::vector<std::uint64_t> words_;
};

// Outputs of `count` elements with room between elements and, for the tangent, between columns.
struct GuardedOutputs {
  static constexpr std::size_t gap = 3;
  GuardedOutputs(const ents_layout& l, std::size_t elements) : layout(l), count(elements) {
    for (int i = 0; i < output_count; ++i) {
      stride.push_back(size(i) + gap);
      real.emplace_back(count * stride.back());
    }
    integers.resize(3, Guarded(count * 2));
  }
  std::size_t dofs() const { return static_cast<std::size_t>(layout.dofs); }
  std::size_t size(int i) const {
    return outputs[i].bit == ENTS_TANGENT ? (dofs() - 1) * (dofs() + gap) + dofs()
                                          : size_of_output(layout, i);
  }
  // Does entry k of an element's array belong to the result? Between the columns of the tangent it does not.
  bool is_result(int i, std::size_t k) const {
    return k < size(i) && (outputs[i].bit != ENTS_TANGENT || k % (dofs() + gap) < dofs());
  }
  ents_output output(int32_t wanted) {
    ents_output o{};
    o.struct_size = sizeof o;
    o.wanted = wanted;
    for (int i = 0; i < output_count; ++i) {
      o.*outputs[i].pointer = real[static_cast<std::size_t>(i)].data();
      o.*outputs[i].stride = static_cast<int64_t>(stride[static_cast<std::size_t>(i)]);
    }
    o.tangent_leading_dimension = static_cast<int64_t>(dofs() + gap);
    // int32 arrays, one number in four: the rest is room
    o.flags = reinterpret_cast<int32_t*>(integers[0].data());
    o.iterations = reinterpret_cast<int32_t*>(integers[1].data());
    o.status = reinterpret_cast<int32_t*>(integers[2].data());
    o.flags_stride = o.iterations_stride = o.status_stride = 4;
    return o;
  }
  void refill() {
    for (Guarded& g : real) g.refill();
    for (Guarded& g : integers) g.refill();
  }
  // Empty if elements 0 .. done - 1, and nothing else, have what is wanted. Status: written for `visited`
  // elements.
  std::string complaint(int32_t wanted, std::size_t done, std::size_t visited) const {
    for (int i = 0; i < output_count; ++i) {
      const Guarded& g = real[static_cast<std::size_t>(i)];
      if (!g.guards_intact()) return std::string(outputs[i].name) + ": written outside";
      const std::size_t s = stride[static_cast<std::size_t>(i)];
      for (std::size_t k = 0; k < g.size(); ++k) {
        const bool expected = (wanted & outputs[i].bit) && k / s < done && is_result(i, k % s);
        if (g.written(k) != expected)
          return std::string(outputs[i].name) + (expected ? ": not written" : ": touched") + ", entry " +
                 std::to_string(k);
      }
    }
    const std::size_t expected[] = {(wanted & ENTS_FLAGS) ? done : 0, (wanted & ENTS_ITERATIONS) ? done : 0,
                                    visited};
    const char* names[] = {"flags", "iterations", "status"};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto* words = reinterpret_cast<const std::uint32_t*>(const_cast<Guarded&>(integers[i]).data());
      const std::uint32_t halves[] = {static_cast<std::uint32_t>(pattern),
                                      static_cast<std::uint32_t>(pattern >> 32)};
      if (!integers[i].guards_intact()) return std::string(names[i]) + ": written outside";
      for (std::size_t k = 0; k < 4 * count; ++k)
        if ((words[k] != halves[k % 2]) != (k % 4 == 0 && k / 4 < expected[i]))
          return std::string(names[i]) + ": wrong entries written, entry " + std::to_string(k);
    }
    return {};
  }

  ents_layout layout;
  std::size_t count;
  std::vector<std::size_t> stride;
  std::vector<Guarded> real, integers;
};

// Inputs of three elements, one after another.
struct Inputs {
  explicit Inputs(const std::vector<Element>& elements) {
    for (int i = 0; i < input_count; ++i)
      for (const Element& e : elements)
        arrays[static_cast<std::size_t>(i)].insert(arrays[static_cast<std::size_t>(i)].end(), e[i].begin(),
                                                   e[i].end());
    input.struct_size = sizeof input;
    for (int i = 0; i < input_count; ++i) {
      auto& array = arrays[static_cast<std::size_t>(i)];
      input.*inputs[i].pointer = array.empty() ? nullptr : array.data();
      input.*inputs[i].stride = static_cast<int64_t>(array.size() / elements.size());
    }
  }
  Inputs(const Inputs&) = delete;
  Inputs& operator=(const Inputs&) = delete;
  std::array<std::vector<double>, input_count> arrays;
  ents_input input{};
};

std::vector<Element> three(const Model& model, const Basis& b, Random& random, double low = -0.05,
                           double high = 0.02) {
  std::vector<Element> all;
  while (all.size() < 3) {
    Element e = with_history(model, draw(model, b, random, low, high), random);
    e[surface_coordinates].clear();
    Results results(model.layout);
    if (test::evaluate(model, e, want_all, results) == ENTS_OK) all.push_back(std::move(e));
  }
  return all;
}

TEST(OutputBounds, EveryOutputAloneAndAllTogether) {
  Random random(51);
  for (const ModelKind& kind : all_kinds()) {
    const Model model(text(kind));
    // in contact and open
    for (const double low : {-0.05, 0.01}) {
      const Inputs in(three(model, basis(kind.basis), random, low, low + 0.03));
      GuardedOutputs out(model.layout, 3);
      std::vector<int32_t> masks = {0, want_all, want_element, ENTS_XI_HESSIAN | ENTS_RESIDUAL};
      for (int bit = 0; 1 << bit <= want_all; ++bit) masks.push_back(1 << bit);
      for (const int32_t wanted : masks) {
        out.refill();
        const ents_output output = out.output(wanted);
        ASSERT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{3}, &in.input, &output, nullptr), ENTS_OK);
        ASSERT_EQ(out.complaint(wanted, 3, 3), "") << "wanted " << wanted << " " << text(kind);
      }
    }
  }
}

TEST(OutputBounds, RangeOfElementsTouchesNoOther) {
  Random random(52);
  const ModelKind kind = {"quad4", "sine"};
  const Model model(text(kind));
  const Inputs in(three(model, basis("quad4"), random));
  GuardedOutputs out(model.layout, 3);
  const ents_output output = out.output(want_all);
  ASSERT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{2}, &in.input, &output, nullptr), ENTS_OK);
  EXPECT_EQ(out.complaint(want_all, 2, 2), "");
  out.refill();
  ASSERT_EQ(call::evaluate(model.get(), int64_t{1}, int64_t{0}, &in.input, &output, nullptr), ENTS_OK);
  EXPECT_EQ(out.complaint(want_all, 0, 0), "");
  ASSERT_EQ(call::evaluate(model.get(), int64_t{2}, int64_t{1}, &in.input, &output, nullptr), ENTS_OK);
  EXPECT_NE(out.complaint(want_all, 0, 0), ""); // the guard sees it
}

// Every kind of error, alone and after two good elements.
TEST(OutputBounds, NothingIsTouchedByAnError) {
  Random random(53);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (ModelKind kind : some_kinds()) {
    kind.more += R"(, "penetration_limit": 1e-6)";
    const Model model(text(kind));
    const Basis& b = basis(kind.basis);
    const std::vector<Element> good = three(model, b, random, 0.001, 0.02);
    const auto with = [&](auto&& change) {
      std::vector<Element> elements = good;
      change(elements[2]);
      return elements;
    };
    const std::pair<const char*, std::vector<Element>> cases[] = {
        {"NaN", with([&](Element& e) { e[slave][1] = nan; })},
        {"infinite area", with([&](Element& e) { e[area][0] = std::numeric_limits<double>::infinity(); })},
        {"negative area", with([&](Element& e) { e[area][0] = -1.0; })},
        {"foreign state", with([&](Element& e) { e[state_begin][0] += 1.0; })},
        {"one point", with([&](Element& e) { e[master].assign(e[master].size(), 0.1); })},
        {"deep", with([&](Element& e) {
           const SurfacePoint at = surface_point(model, e, centre(b));
           for (std::size_t c = 0; c < e[slave].size(); ++c) e[slave][c] = at.point[c] - 0.02 * at.normal[c];
           if (!e[multiplier].empty()) e[multiplier][0] = 1.0; // pressed
           e[start] = centre(b);
         })},
        {"range", with([&](Element& e) {
           for (const int i : {slave, master})
             for (double& x : e[i]) x *= 1e-160; // squares of its lengths are no normal numbers
         })},
    };
    for (const auto& [name, elements] : cases) {
      const Inputs in(elements);
      GuardedOutputs out(model.layout, 3);
      const ents_output output = out.output(want_all);
      ents_report report = new_report();
      const int32_t status = call::evaluate(model.get(), int64_t{0}, int64_t{3}, &in.input, &output, &report);
      ASSERT_NE(status, ENTS_OK) << name << " " << text(kind);
      ASSERT_EQ(report.element, 2);
      ASSERT_EQ(out.complaint(want_all, 2, 3), "") << name << " " << text(kind);
      out.refill();
      ASSERT_EQ(call::evaluate(model.get(), int64_t{2}, int64_t{1}, &in.input, &output, &report), status);
      out.refill();
      // alone: nothing but its status
      Inputs alone({elements[2]});
      GuardedOutputs single(model.layout, 1);
      const ents_output single_output = single.output(want_all);
      ASSERT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{1}, &alone.input, &single_output, &report),
                status);
      ASSERT_EQ(single.complaint(want_all, 0, 1), "") << name << " " << text(kind);
    }
  }
}

// Wrong arguments: not even the status of an element.
TEST(OutputBounds, NothingIsTouchedByAWrongArgument) {
  Random random(54);
  const ModelKind kind = {"tri3", "gaussian", "shadow_direction"};
  const Model model(text(kind));
  const Model kinematic(R"({"segment": "tri3"})");
  const Inputs in(three(model, basis("tri3"), random));
  GuardedOutputs out(model.layout, 3);
  ents_output output = out.output(want_all);
  ents_input input = in.input;
  const auto refused = [&](int32_t status, const ents_model* m = nullptr, int64_t first = 0,
                           int64_t count = 3) {
    EXPECT_EQ(call::evaluate(m ? m : model.get(), first, count, &input, &output, nullptr), status);
    EXPECT_EQ(out.complaint(output.wanted, 0, 0), "");
    input = in.input;
    output = out.output(want_all);
  };
  refused(ENTS_BAD_COUNT, nullptr, 0, -1);
  refused(ENTS_BAD_COUNT, nullptr, -1, 1);
  refused(ENTS_BAD_MASK, kinematic.get());
  refused((output.wanted = 1 << 30, ENTS_BAD_MASK));
  refused((output.gap = nullptr, ENTS_NULL_ARGUMENT));
  refused((input.master = nullptr, ENTS_NULL_ARGUMENT));
  refused((output.residual_stride = 1, ENTS_BAD_COUNT));
  refused((input.slave_stride = 2, ENTS_BAD_COUNT));
  refused((output.struct_size = 4, ENTS_STRUCT_SIZE));
  refused((output.tangent_leading_dimension = 2, ENTS_BAD_COUNT));
}

TEST(OutputBounds, StateSurfaceAndAreas) {
  for (const ModelKind& kind : some_kinds()) {
    const Model model(text(kind));
    const auto size = static_cast<std::size_t>(model.layout.state_size),
               d = static_cast<std::size_t>(model.layout.dimension);
    Guarded states(3 * (size + 2));
    ASSERT_EQ(
        call::state_init(model.get(), int64_t{3}, states.data(), static_cast<int64_t>(size + 2), nullptr),
        ENTS_OK);
    for (std::size_t k = 0; k < states.size(); ++k) ASSERT_EQ(states.written(k), k % (size + 2) < size);
    ASSERT_TRUE(states.guards_intact());

    const Basis& b = basis(kind.basis);
    const std::vector<double> nodes = flat_master(b);
    std::vector<double> xi = centre(b);
    xi.insert(xi.end(), xi.begin(), xi.begin() + static_cast<std::ptrdiff_t>(d - 1)); // two points
    std::vector<Guarded> arrays = {Guarded(2 * d), Guarded(2 * d), Guarded(2), Guarded(2 * d),
                                   Guarded(2 * d)};
    for (std::size_t which = 0; which < arrays.size(); ++which) { // each alone: the others are null
      ents_surface s{};
      s.struct_size = sizeof s;
      s.master = nodes.data();
      s.xi = xi.data();
      double** pointers[] = {&s.point, &s.normal, &s.height, &s.base_point, &s.base_normal};
      *pointers[which] = arrays[which].data();
      ASSERT_EQ(call::surface_evaluate(model.get(), int64_t{2}, &s, nullptr), ENTS_OK);
      for (std::size_t k = 0; k < arrays[which].size(); ++k) ASSERT_TRUE(arrays[which].written(k)) << which;
      ASSERT_TRUE(arrays[which].guards_intact());
    }
  }
  const int64_t connectivity[] = {0, 1, 2};
  const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5};
  Guarded areas(4);
  ASSERT_EQ(call::tributary_areas("tri3", 1, connectivity, 4, positions, 1.0, areas.data(), nullptr),
            ENTS_OK);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_TRUE(areas.written(k));
  EXPECT_TRUE(areas.guards_intact());
  areas.refill();
  const int64_t wrong[] = {0, 1, 4};
  EXPECT_EQ(call::tributary_areas("tri3", 1, wrong, 4, positions, 1.0, areas.data(), nullptr),
            ENTS_BAD_VALUE);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_FALSE(areas.written(k));
}

} // namespace
} // namespace output_bounds_test
