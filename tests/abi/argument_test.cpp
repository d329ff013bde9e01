// SPDX-License-Identifier: BSD-3-Clause
// Counts, strides, handles and null pointers: refused by name before any arithmetic with them; no elements,
// no complaint.
#include <gtest/gtest.h>

#include <climits>
#include <cmath>
#include <functional>
#include <utility>

#include "support/element.hpp"

namespace argument_test {
namespace {

using namespace test;

class Arguments : public ::testing::Test {
protected:
  Arguments() : model(text({"quad4", "sine"})), results(model.layout), random(101) {
    element = draw(model, basis("quad4"), random);
    reset();
  }
  void reset() {
    input = input_of(element);
    output = output_of(results, usual);
    report = new_report();
  }
  // The call is refused with this status; the message names `name`. Then all is as before.
  void refused(int32_t status, const std::string& name, int64_t first = 0, int64_t count = 1) {
    EXPECT_EQ(call::evaluate(model.get(), first, count, &input, &output, &report), status) << name;
    EXPECT_EQ(report.status, status);
    EXPECT_NE(std::string(report.message).find(name), std::string::npos) << report.message;
    EXPECT_EQ(report.step_factor, 1.0);
    reset();
  }

  std::int32_t usual = want_all;
  Model model;
  Results results;
  Random random;
  Element element;
  ents_input input;
  ents_output output;
  ents_report report;
};

TEST_F(Arguments, CountsAtTheEndsOfTheIntegers) {
  const int64_t least = INT64_MIN, most = INT64_MAX;
  for (const int64_t bad :
       {least, least + 1, int64_t{INT_MIN}, int64_t{-1}, int64_t{1} << 51, most / 8, most - 1, most}) {
    refused(ENTS_BAD_COUNT, "count", 0, bad);
    refused(ENTS_BAD_COUNT, "first", bad, 1);
    refused(ENTS_BAD_COUNT, "first", bad, bad);
  }
  refused(ENTS_BAD_COUNT, "first", int64_t{1} << 50, int64_t{1} << 50);
  refused(ENTS_BAD_COUNT, "first", most, 0);
}

TEST_F(Arguments, NoElementsNoComplaint) {
  output = {};
  output.struct_size = sizeof output;
  output.wanted = want_all; // all arrays null: an empty std::vector has no data
  input = {};
  input.struct_size = sizeof input;
  EXPECT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{0}, &input, &output, &report), ENTS_OK)
      << report.message;
  EXPECT_EQ(call::evaluate(model.get(), int64_t{5}, int64_t{0}, &input, &output, &report), ENTS_OK)
      << report.message;
  EXPECT_EQ(call::state_init(model.get(), int64_t{0}, nullptr, int64_t{model.layout.state_size}, &report),
            ENTS_OK);
  ents_surface surface{};
  surface.struct_size = sizeof surface;
  EXPECT_EQ(call::surface_evaluate(model.get(), int64_t{0}, &surface, &report), ENTS_OK);
  EXPECT_EQ(call::tributary_areas("quad4", 0, nullptr, 0, nullptr, 1.0, nullptr, &report), ENTS_OK);
  EXPECT_STREQ(report.message, "");
}

// Calls of what blocks of elements have, and of forces alone, have a shorter way through the checks.
TEST_F(Arguments, EveryStrideOfABatch) {
  constexpr std::int32_t kinematics =
      ENTS_GAP_GRADIENT | ENTS_GAP_HESSIAN | ENTS_XI_GRADIENT | ENTS_XI_HESSIAN;
  for (const std::int32_t some : {+want_all, want_all & ~kinematics, ENTS_RESIDUAL | ENTS_TANGENT}) {
    usual = some;
    reset();
    for (int i = 0; i < input_count; ++i) {
      if (element[i].empty()) continue;
      const auto size = static_cast<int64_t>(size_of_input(model.layout, i));
      const std::string name = std::string("input.") + inputs[i].name + "_stride";
      for (const int64_t bad : {int64_t{-1}, size - 1, INT64_MIN, INT64_MAX, int64_t{1} << 60}) {
        if (bad == 0) continue; // shared, also for arrays of one number
        input.*inputs[i].stride = bad;
        refused(ENTS_BAD_COUNT, name, 0, 2);
        input.*inputs[i].stride = bad;
        refused(ENTS_BAD_COUNT, name, 1, 1); // element 1 alone lies one stride behind, too
      }
    }
    for (int i = 0; i < output_count; ++i) {
      if ((usual & outputs[i].bit) == 0) continue;
      const auto size = static_cast<int64_t>(size_of_output(model.layout, i));
      const std::string name = std::string("output.") + outputs[i].name + "_stride";
      for (const int64_t bad : {int64_t{-1}, int64_t{0}, size - 1, INT64_MIN, INT64_MAX, int64_t{1} << 60}) {
        output.*outputs[i].stride = bad;
        refused(ENTS_BAD_COUNT, name, 0, 2);
        output.*outputs[i].stride = bad;
        refused(ENTS_BAD_COUNT, name, 1, 1);
      }
    }
    int64_t ents_output::*const integers[] = {&ents_output::flags_stride, &ents_output::iterations_stride,
                                              &ents_output::status_stride};
    const char* names[] = {"output.flags_stride", "output.iterations_stride", "output.status_stride"};
    for (std::size_t i = 0; i < 3; ++i)
      for (const int64_t bad : {int64_t{-1}, int64_t{0}, INT64_MIN, INT64_MAX}) {
        if (i < 2 && (usual & ENTS_FLAGS) == 0) continue;
        output.*integers[i] = bad;
        refused(ENTS_BAD_COUNT, names[i], 0, 2);
        output.*integers[i] = bad;
        refused(ENTS_BAD_COUNT, names[i], 1, 1);
      }
  }
}

// Of two elements that are evaluated without a doubt, so that nothing looks at the arguments a second time.
TEST_F(Arguments, AStrideOfZeroForResultsOfPlainCalls) {
  std::vector<double> residual(static_cast<std::size_t>(2 * model.layout.dofs));
  int32_t status[2] = {-1, -1};
  const auto set = [&] {
    for (int i = 0; i < input_count; ++i) input.*inputs[i].stride = 0;
    output = {};
    output.struct_size = sizeof output;
    output.wanted = ENTS_RESIDUAL;
    output.residual = residual.data(), output.residual_stride = model.layout.dofs;
    output.status = status, output.status_stride = 1;
  };
  set();
  ASSERT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{2}, &input, &output, &report), ENTS_OK)
      << report.message;
  EXPECT_EQ(status[1], ENTS_OK);
  output.status_stride = 0;
  refused(ENTS_BAD_COUNT, "output.status_stride", 0, 2);
  set();
  output.residual_stride = 0;
  refused(ENTS_BAD_COUNT, "output.residual_stride", 0, 2);
}

TEST_F(Arguments, StridesDoNotMatterForOneElement) {
  for (int i = 0; i < input_count; ++i) input.*inputs[i].stride = i % 2 ? -5 : INT64_MAX;
  for (int i = 0; i < output_count; ++i) output.*outputs[i].stride = i % 2 ? 0 : INT64_MIN;
  output.flags_stride = output.iterations_stride = output.status_stride = 0;
  EXPECT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{1}, &input, &output, &report), ENTS_OK)
      << report.message;
}

TEST_F(Arguments, LeadingDimensionOfTheTangent) {
  for (const int64_t bad : {int64_t{-1}, int64_t{1}, int64_t{model.layout.dofs - 1}, int64_t{INT_MAX} + 1,
                            INT64_MIN, INT64_MAX}) {
    output.tangent_leading_dimension = bad;
    refused(ENTS_BAD_COUNT, "output.tangent_leading_dimension");
  }
  output.tangent_leading_dimension = -1; // the tangent is not wanted
  output.wanted = ENTS_GAP;
  EXPECT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{1}, &input, &output, &report), ENTS_OK)
      << report.message;
}

TEST_F(Arguments, WantedBits) {
  for (const int32_t bad : {1 << 22, 1 << 30, INT_MIN, -1}) {
    output.wanted = bad;
    refused(ENTS_BAD_MASK, "output.wanted");
  }
  const Model kinematic(R"({"segment": "quad4"})");
  for (const int32_t bit : {ENTS_ENERGY, ENTS_PRESSURE, ENTS_RESIDUAL, ENTS_TANGENT}) {
    output.wanted = bit;
    EXPECT_EQ(call::evaluate(kinematic.get(), int64_t{0}, int64_t{1}, &input, &output, &report),
              ENTS_BAD_MASK);
    EXPECT_NE(std::string(report.message).find("\"contact\""), std::string::npos) << report.message;
  }
}

TEST_F(Arguments, NullArraysOfInputAndOutput) {
  for (const int i : {slave, master}) {
    input.*inputs[i].pointer = nullptr;
    refused(ENTS_NULL_ARGUMENT, std::string("input.") + inputs[i].name);
  }
  for (int i = 0; i < output_count; ++i) {
    output.*outputs[i].pointer = nullptr;
    refused(ENTS_NULL_ARGUMENT, std::string("output.") + outputs[i].name);
  }
  output.flags = nullptr;
  refused(ENTS_NULL_ARGUMENT, "output.flags");
  output.iterations = nullptr;
  refused(ENTS_NULL_ARGUMENT, "output.iterations");
  // what is not wanted, and what is optional, may be null
  for (const int i : {surface_coordinates, start, area, state_begin, multiplier})
    input.*inputs[i].pointer = nullptr;
  output = {};
  output.struct_size = sizeof output;
  output.wanted = ENTS_GAP;
  output.gap = results.real[1].data();
  EXPECT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{1}, &input, &output, nullptr), ENTS_OK);
  // multipliers as dofs are not optional
  const Model multipliers(text({"quad4", "none", "normal", "", 10}));
  EXPECT_EQ(call::evaluate(multipliers.get(), int64_t{0}, int64_t{1}, &input, &output, &report),
            ENTS_NULL_ARGUMENT);
  EXPECT_NE(std::string(report.message).find("input.multiplier"), std::string::npos) << report.message;
}

TEST_F(Arguments, NullArgumentsByName) {
  ents_model* made = nullptr;
  ents_model* const live = const_cast<ents_model*>(model.get());
  std::vector<double> state(static_cast<std::size_t>(model.layout.state_size));
  const double* nodes = element[master].data();
  ents_surface surface{};
  surface.struct_size = sizeof surface;
  surface.master = nodes;
  ents_admissibility result{};
  result.struct_size = sizeof result;
  double areas[4];
  const int64_t connectivity[] = {0, 1, 2, 3};
  const std::pair<const char*, std::function<int32_t()>> calls[] = {
      {"'model'", [&] { return call::evaluate(nullptr, int64_t{0}, int64_t{1}, &input, &output, &report); }},
      {"'input'", [&] { return call::evaluate(live, int64_t{0}, int64_t{1}, nullptr, &output, &report); }},
      {"'output'", [&] { return call::evaluate(live, int64_t{0}, int64_t{1}, &input, nullptr, &report); }},
      {"'text'",
       [&] {
         return call::model_create(nullptr, int64_t{-1}, nullptr, nullptr, int64_t{0}, &made, &report);
       }},
      {"'data'",
       [&] { return call::model_create("{}", int64_t{-1}, nullptr, nullptr, int64_t{1}, &made, &report); }},
      {"'model'",
       [&] { return call::model_create("{}", int64_t{-1}, nullptr, nullptr, int64_t{0}, nullptr, &report); }},
      {"'path'", [&] { return call::model_create_from_file(nullptr, &made, &report); }},
      {"'model'", [&] { return call::model_create_from_file("x", nullptr, &report); }},
      {"'model'", [&] { return call::model_layout(nullptr, &model.layout, &report); }},
      {"'layout'", [&] { return call::model_layout(live, nullptr, &report); }},
      {"'model'", [&] { return call::state_init(nullptr, int64_t{1}, state.data(), int64_t{99}, &report); }},
      {"'state'", [&] { return call::state_init(live, int64_t{1}, nullptr, int64_t{99}, &report); }},
      {"'model'", [&] { return call::surface_evaluate(nullptr, int64_t{1}, &surface, &report); }},
      {"'surface'", [&] { return call::surface_evaluate(live, int64_t{1}, nullptr, &report); }},
      {"surface.xi", [&] { return call::surface_evaluate(live, int64_t{1}, &surface, &report); }},
      {"'model'", [&] { return call::model_check(nullptr, nodes, nullptr, &result, &report); }},
      {"'master'", [&] { return call::model_check(live, nullptr, nullptr, &result, &report); }},
      {"'result'", [&] { return call::model_check(live, nodes, nullptr, nullptr, &report); }},
      {"'old_master'",
       [&] {
         return call::state_transfer(live, nullptr, nullptr, nodes, nullptr, state.data(), areas, &report);
       }},
      {"'new_master'",
       [&] {
         return call::state_transfer(live, nodes, nullptr, nullptr, nullptr, state.data(), areas, &report);
       }},
      {"'state'",
       [&] { return call::state_transfer(live, nodes, nullptr, nodes, nullptr, nullptr, areas, &report); }},
      {"'moved'",
       [&] {
         return call::state_transfer(live, nodes, nullptr, nodes, nullptr, state.data(), nullptr, &report);
       }},
      {"'facet'",
       [&] { return call::tributary_areas(nullptr, 1, connectivity, 4, nodes, 1.0, areas, &report); }},
      {"connectivity",
       [&] { return call::tributary_areas("quad4", 1, nullptr, 4, nodes, 1.0, areas, &report); }},
      {"positions",
       [&] { return call::tributary_areas("quad4", 1, connectivity, 4, nullptr, 1.0, areas, &report); }},
      {"areas",
       [&] { return call::tributary_areas("quad4", 1, connectivity, 4, nodes, 1.0, nullptr, &report); }},
  };
  for (const auto& [name, make] : calls) {
    report = new_report();
    EXPECT_EQ(make(), ENTS_NULL_ARGUMENT) << name;
    EXPECT_NE(std::string(report.message).find(name), std::string::npos) << report.message;
    EXPECT_EQ(report.status, ENTS_NULL_ARGUMENT);
    EXPECT_EQ(made, nullptr);
  }
}

// Every function takes a null report.
TEST_F(Arguments, NullReport) {
  ents_model* made = nullptr;
  EXPECT_EQ(call::evaluate(nullptr, int64_t{0}, int64_t{1}, &input, &output, nullptr), ENTS_NULL_ARGUMENT);
  EXPECT_EQ(call::model_create("{", int64_t{-1}, nullptr, nullptr, int64_t{0}, &made, nullptr),
            ENTS_JSON_SYNTAX);
  EXPECT_EQ(call::model_create_from_file("nowhere.json", &made, nullptr), ENTS_FILE);
  EXPECT_EQ(call::model_destroy(&made, nullptr), ENTS_OK);
  EXPECT_EQ(call::check_contract(77, 0, nullptr), ENTS_VERSION);
}

TEST_F(Arguments, Destroying) {
  EXPECT_EQ(call::model_destroy(nullptr, &report), ENTS_OK);
  ents_model* none = nullptr;
  EXPECT_EQ(call::model_destroy(&none, &report), ENTS_OK);
  ents_model* made = nullptr;
  ASSERT_EQ(
      call::model_create(model.text().c_str(), int64_t{-1}, nullptr, nullptr, int64_t{0}, &made, &report),
      ENTS_OK);
  EXPECT_EQ(call::model_destroy(&made, &report), ENTS_OK);
  EXPECT_EQ(made, nullptr);
  EXPECT_EQ(call::model_destroy(&made, &report), ENTS_OK);
}

// What is not a model is refused as far as its memory can be read (the header: best effort).
TEST_F(Arguments, ForeignHandles) {
  alignas(64) unsigned char memory[4096];
  for (const int value : {0x00, 0x65, 0xff}) {
    const auto filling = static_cast<unsigned char>(value);
    std::memset(memory, filling, sizeof memory);
    auto* foreign = reinterpret_cast<ents_model*>(memory);
    const auto refused_by = [&](int32_t status, const char* function) {
      EXPECT_EQ(status, ENTS_BAD_HANDLE) << function;
      EXPECT_NE(std::string(report.message).find("'model'"), std::string::npos) << report.message;
    };
    std::vector<double> state(99);
    ents_admissibility result{};
    result.struct_size = sizeof result;
    ents_surface surface{};
    surface.struct_size = sizeof surface;
    refused_by(call::evaluate(foreign, int64_t{0}, int64_t{1}, &input, &output, &report), "evaluate");
    refused_by(call::model_layout(foreign, &model.layout, &report), "layout");
    refused_by(call::state_init(foreign, int64_t{1}, state.data(), int64_t{99}, &report), "state_init");
    refused_by(call::surface_evaluate(foreign, int64_t{1}, &surface, &report), "surface");
    refused_by(call::model_check(foreign, state.data(), nullptr, &result, &report), "check");
    refused_by(call::model_destroy(&foreign, &report), "destroy");
    EXPECT_EQ(foreign, reinterpret_cast<ents_model*>(memory));
    for (const unsigned char byte : memory) ASSERT_EQ(byte, filling);
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// Stale handles, as long as their memory is still there. (Reading freed memory is what sanitizers report.)
TEST_F(Arguments, StaleHandles) {
  for (int i = 0; i < 100; ++i) {
    ents_model* made = nullptr;
    ASSERT_EQ(
        call::model_create(model.text().c_str(), int64_t{-1}, nullptr, nullptr, int64_t{0}, &made, &report),
        ENTS_OK);
    ents_model* stale = made;
    ASSERT_EQ(call::model_destroy(&made, &report), ENTS_OK);
    EXPECT_EQ(call::evaluate(stale, int64_t{0}, int64_t{1}, &input, &output, &report), ENTS_BAD_HANDLE);
    EXPECT_EQ(call::model_destroy(&stale, &report), ENTS_BAD_HANDLE);
  }
}
#endif

// An element may be evaluated twice, so that its state must not be written over.
TEST_F(Arguments, StatesDoNotOverlap) {
  const int64_t size = model.layout.state_size;
  std::vector<double> states(static_cast<std::size_t>(4 * size));
  call::state_init(model.get(), int64_t{4}, states.data(), size, nullptr);
  for (const int32_t wanted : {int32_t{ENTS_STATE}, want_all}) {
    input.state_begin = states.data(), input.state_begin_stride = size;
    output.wanted = wanted;
    output.state_end_stride = size;
    for (const int64_t apart : {int64_t{0}, int64_t{1}, size - 1}) {
      output.state_end = states.data() + apart;
      const ents_input in = input;
      const ents_output out = output;
      refused(ENTS_BAD_VALUE, "output.state_end overlaps input.state_begin");
      input = in, output = out;
    }
    output.state_end = states.data() + size;
    EXPECT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{1}, &input, &output, &report), ENTS_OK)
        << report.message;
    reset();
  }
}

// [element][begin | end]: as near as can be, and in no common place.
TEST_F(Arguments, StatesMayLieBetweenEachOther) {
  constexpr int64_t count = 5;
  const int64_t size = model.layout.state_size, most = std::max<int64_t>(3 * size, 32);
  std::vector<double> states(static_cast<std::size_t>(most * (count + 1))),
      ends(static_cast<std::size_t>(count * size));
  for (int i = 0; i < input_count; ++i) input.*inputs[i].stride = 0; // five times the same element
  output.status = nullptr;
  for (const int32_t wanted : {int32_t{ENTS_STATE}, ENTS_STATE | ENTS_GAP_GRADIENT})
    for (const int64_t stride : {2 * size, 2 * size + 1, 3 * size})
      for (int64_t apart = 0; apart < stride; ++apart)
        for (const bool end_first : {false, true})
          for (const int64_t first : {int64_t{0}, int64_t{2}}) {
            double *begin = states.data() + (end_first ? apart : 0),
                   *end = states.data() + (end_first ? 0 : apart);
            call::state_init(model.get(), count, begin, stride, nullptr);
            std::vector<double> gradient(static_cast<std::size_t>(count * model.layout.dofs));
            output.wanted = wanted;
            output.gap_gradient = gradient.data(), output.gap_gradient_stride = model.layout.dofs;
            input.state_begin = begin, input.state_begin_stride = stride;
            output.state_end = ends.data(), output.state_end_stride = size;
            ASSERT_EQ(call::evaluate(model.get(), first, count - first, &input, &output, &report), ENTS_OK)
                << report.message;
            output.state_end = end, output.state_end_stride = stride;
            const int32_t status =
                call::evaluate(model.get(), first, count - first, &input, &output, &report);
            const bool disjoint = apart >= size && apart + size <= stride;
            ASSERT_EQ(status, disjoint ? ENTS_OK : ENTS_BAD_VALUE)
                << "stride " << stride << ", " << apart << " apart";
            for (int64_t e = first; disjoint && e < count; ++e)
              for (int64_t i = 0; i < size; ++i)
                ASSERT_EQ(end[e * stride + i], ends[static_cast<std::size_t>(e * size + i)]);
          }
  reset();
}

TEST_F(Arguments, SlaveSurfaces) {
  // turned about the axis of r = 0, a facet must not cross it
  const double crossing[] = {0.1, 0.0, 1.0, 0.0, -0.9, 1.0};
  const int64_t line[] = {0, 1, 1, 2};
  double areas[3] = {7, 7, 7};
  EXPECT_EQ(call::tributary_areas("line2", int64_t{2}, line, int64_t{3}, crossing, 0.0, areas, &report),
            ENTS_DEGENERATE_SEGMENT);
  for (const double a : areas) EXPECT_EQ(a, 7.0);
  int64_t begin[5] = {7, 7, 7, 7, 7}, nodes[8] = {7, 7, 7, 7, 7, 7, 7, 7};
  double weights[8] = {7, 7, 7, 7, 7, 7, 7, 7}, of_points[4] = {7, 7, 7, 7};
  EXPECT_EQ(
      ents_sampling_points("line2", 2, 2, line, 3, crossing, 0.0, begin, nodes, weights, of_points, &report),
      ENTS_DEGENERATE_SEGMENT);
  for (const double w : weights) EXPECT_EQ(w, 7.0);
  for (const double a : of_points) EXPECT_EQ(a, 7.0);
  ents_combination combination{};
  combination.struct_size = sizeof combination;
  const int64_t from[] = {1, 2}, of[] = {0, 1};
  const double factors[] = {5, 1};
  double point[2] = {7, 7};
  combination.points = 1, combination.begin = from, combination.nodes = of, combination.weights = factors;
  EXPECT_EQ(ents_combine(&combination, 2, 3, crossing, point, &report), ENTS_BAD_VALUE);
  EXPECT_NE(std::string(report.message).find("begin[0] is 1"), std::string::npos) << report.message;
}

// Quadratic facets are shared out by squares of areas, which leave the range of numbers long before the areas
// do.
TEST_F(Arguments, AreasOfAnySize) {
  const int64_t connectivity[] = {0, 1, 2};
  for (const double size : {1.0, 1e-82, 1e-140, 1e78, 1e140}) {
    const double line[] = {0, 0, 2 * size, 0, size, 0};
    double areas[3] = {};
    ASSERT_EQ(
        call::tributary_areas("line3", int64_t{1}, connectivity, int64_t{3}, line, size, areas, &report),
        ENTS_OK)
        << report.message;
    EXPECT_NEAR((areas[0] + areas[1] + areas[2]) / size / size, 2.0, 1e-14) << size;
    EXPECT_NEAR(areas[2] / areas[0], 4.0, 1e-13) << size;
  }
}

// In space the areas are areas, whatever the thickness.
TEST_F(Arguments, ThicknessIsOfThePlaneOnly) {
  const double square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const int64_t connectivity[] = {0, 1, 2, 3};
  for (const double thickness :
       {0.0, 3.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    double areas[4] = {7, 7, 7, 7};
    EXPECT_EQ(call::tributary_areas("quad4", int64_t{1}, connectivity, int64_t{4}, square, thickness, areas,
                                    &report),
              ENTS_OK)
        << report.message;
    for (const double a : areas) EXPECT_DOUBLE_EQ(a, 0.25);
    int64_t begin[2], nodes[4];
    double weights[4], area = 0.0;
    EXPECT_EQ(ents_sampling_points("quad4", 1, 1, connectivity, 4, square, thickness, begin, nodes, weights,
                                   &area, &report),
              ENTS_OK)
        << report.message;
    EXPECT_DOUBLE_EQ(area, 1.0);
    if (thickness >= 0.0 && std::isfinite(thickness)) continue;
    EXPECT_EQ(call::tributary_areas("line2", int64_t{1}, connectivity, int64_t{4}, square, thickness, areas,
                                    &report),
              ENTS_BAD_VALUE);
    EXPECT_NE(std::string(report.message).find("thickness"), std::string::npos) << report.message;
  }
}

// One struct for many segments: what is asked for stays asked for.
TEST_F(Arguments, TheCheckOfASegmentSaysWhatItSamples) {
  const Model line(
      R"({"segment": "line2", "height": {"type": "sine", "amplitude": 0.02, "wave_vector": [30], "phase": 0.3}})");
  const double nodes[] = {-1, 0, 1, 0}, smooth[] = {0, 0.01}, waves[] = {0, 5};
  ents_admissibility few{}, many{}, nine{};
  few.struct_size = many.struct_size = nine.struct_size = sizeof few;
  nine.samples = 9;
  ASSERT_EQ(call::model_check(line.get(), nodes, smooth, &few, &report), ENTS_OK);
  ASSERT_EQ(call::model_check(line.get(), nodes, waves, &many, &report), ENTS_OK);
  ASSERT_EQ(call::model_check(line.get(), nodes, waves, &nine, &report), ENTS_OK);
  EXPECT_LT(few.samples, 20);
  EXPECT_GT(many.samples, 150 * 4);
  EXPECT_GT(many.height_max, 0.0199);
  EXPECT_EQ(nine.samples, 9);
}

TEST_F(Arguments, CountsOfTheOtherFunctions) {
  std::vector<double> state(100);
  const int64_t size = model.layout.state_size;
  for (const int64_t bad : {int64_t{-1}, INT64_MIN, INT64_MAX, INT64_MAX / 2}) {
    EXPECT_EQ(call::state_init(model.get(), bad, state.data(), size, &report), ENTS_BAD_COUNT) << bad;
    EXPECT_NE(std::string(report.message).find("count"), std::string::npos) << report.message;
  }
  for (const int64_t bad : {int64_t{-1}, int64_t{0}, size - 1, INT64_MIN}) {
    EXPECT_EQ(call::state_init(model.get(), int64_t{1}, state.data(), bad, &report), ENTS_BAD_COUNT) << bad;
    EXPECT_NE(std::string(report.message).find("stride"), std::string::npos) << report.message;
  }
  EXPECT_EQ(call::state_init(model.get(), int64_t{3}, state.data(), INT64_MAX, &report), ENTS_BAD_COUNT);
  ents_surface surface{};
  surface.struct_size = sizeof surface;
  surface.master = surface.xi = element[master].data();
  for (const int64_t bad : {int64_t{-1}, INT64_MIN, INT64_MAX}) {
    EXPECT_EQ(call::surface_evaluate(model.get(), bad, &surface, &report), ENTS_BAD_COUNT);
    EXPECT_NE(std::string(report.message).find("count"), std::string::npos) << report.message;
  }
  ents_admissibility result{};
  result.struct_size = sizeof result;
  for (const int32_t bad : {-1, 1, 4097, INT_MAX, INT_MIN}) {
    result.samples = bad;
    EXPECT_EQ(call::model_check(model.get(), element[master].data(), nullptr, &result, &report),
              ENTS_BAD_COUNT);
    EXPECT_NE(std::string(report.message).find("result.samples"), std::string::npos) << report.message;
  }
  ents_model* made = nullptr;
  for (const int64_t bad : {int64_t{-2}, INT64_MIN}) {
    EXPECT_EQ(call::model_create("{}", bad, nullptr, nullptr, int64_t{0}, &made, &report), ENTS_BAD_COUNT);
    EXPECT_NE(std::string(report.message).find("length"), std::string::npos) << report.message;
  }
  EXPECT_EQ(call::model_create("{}", INT64_MAX, nullptr, nullptr, int64_t{0}, &made, &report),
            ENTS_BAD_VALUE);
  for (const int64_t bad : {int64_t{-1}, INT64_MIN, INT64_MAX, int64_t{1} << 31}) {
    EXPECT_EQ(call::model_create("{}", int64_t{-1}, nullptr, nullptr, bad, &made, &report), ENTS_BAD_COUNT);
    EXPECT_NE(std::string(report.message).find("data_count"), std::string::npos) << report.message;
  }
  double values[4] = {};
  ents_data data{};
  data.struct_size = sizeof data;
  data.name = "x";
  data.values = values;
  for (const int64_t bad : {int64_t{-1}, int64_t{0}, INT64_MIN, INT64_MAX, int64_t{1} << 32}) {
    data.rows = data.columns = bad;
    EXPECT_EQ(call::model_create("{}", int64_t{-1}, nullptr, &data, int64_t{1}, &made, &report),
              ENTS_BAD_COUNT)
        << bad;
    EXPECT_NE(std::string(report.message).find("rows"), std::string::npos) << report.message;
  }
  int64_t connectivity[4] = {0, 1, 2, 3};
  double areas[4];
  for (const int64_t bad : {int64_t{-1}, INT64_MIN, INT64_MAX}) {
    EXPECT_EQ(
        call::tributary_areas("quad4", bad, connectivity, 4, element[master].data(), 1.0, areas, &report),
        ENTS_BAD_COUNT);
    EXPECT_EQ(
        call::tributary_areas("quad4", 1, connectivity, bad, element[master].data(), 1.0, areas, &report),
        ENTS_BAD_COUNT);
    connectivity[2] = bad;
    EXPECT_EQ(call::tributary_areas("quad4", 1, connectivity, 4, element[master].data(), 1.0, areas, &report),
              ENTS_BAD_VALUE);
    EXPECT_NE(std::string(report.message).find("connectivity[2]"), std::string::npos) << report.message;
    connectivity[2] = 2;
  }
}

// The reason, and not what follows from it.
TEST(NamedReasons, FacetsAtANegativeRadiusAreNamedAsSuch) {
  const int64_t connectivity[] = {0, 1, 1, 2};
  const double positions[] = {2, 0, 1, 0, -0.5, 0}, gap[3] = {}, pressure[3] = {};
  double areas[3], weights[4];
  int64_t begin[3], nodes[4];
  ents_area area{};
  area.struct_size = sizeof area;
  ents_report report = new_report();
  const auto is_named = [&](int32_t status) {
    EXPECT_EQ(status, ENTS_DEGENERATE_SEGMENT);
    EXPECT_EQ(report.element, 1);
    EXPECT_NE(std::string(report.message).find("facet 1 has its node 2 at the radius -0.5"),
              std::string::npos)
        << report.message;
  };
  is_named(ents_tributary_areas("line2", 2, connectivity, 3, positions, 0.0, areas, &report));
  is_named(ents_sampling_points("line2", 1, 2, connectivity, 3, positions, 0.0, begin, nodes, weights, areas,
                                &report));
  is_named(
      ents_contact_area("line2", 2, connectivity, 3, positions, 0.0, gap, pressure, 0.0, &area, &report));
  EXPECT_EQ(ents_tributary_areas("line2", 2, connectivity, 3, positions, 1.0, areas, &report), ENTS_OK);
}

// A shadow ray that leaves the surface from behind, as with "direction" the way light shines: named.
TEST(NamedReasons, ADirectionFromBehindIsNamed) {
  for (const bool point : {false, true}) {
    const Model model(
        R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 1}}, "projection": )" +
        std::string(point ? R"({"type": "shadow_point", "emitter": [0, -5]}})"
                          : R"({"type": "shadow_direction", "direction": [0, -1]}})"));
    const double slave[] = {0.0, 0.1}, master[] = {-1, 0, 1, 0};
    double residual[6];
    ents_input in{};
    in.struct_size = sizeof in;
    in.slave = slave, in.master = master;
    ents_output out{};
    out.struct_size = sizeof out;
    out.wanted = ENTS_RESIDUAL, out.residual = residual;
    ents_report report = new_report();
    EXPECT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{1}, &in, &out, &report), ENTS_GRAZING_RAY);
    const std::string message = report.message;
    EXPECT_NE(message.find("from behind (n_e . e = -1)"), std::string::npos) << message;
    EXPECT_NE(message.find(point ? "\"emitter\" lies on the side of the slave nodes" : "turn its sign"),
              std::string::npos)
        << message;
  }
}

} // namespace
} // namespace argument_test
