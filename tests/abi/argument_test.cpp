// SPDX-License-Identifier: BSD-3-Clause
// Counts, strides, handles and null pointers: refused by name before any arithmetic with them; no elements,
// no complaint.
#include <gtest/gtest.h>

#include <climits>
#include <functional>
#include <utility>

#include "support/arguments.hpp"

namespace argument_test {
namespace {

using namespace test;

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

} // namespace
} // namespace argument_test
