// SPDX-License-Identifier: BSD-3-Clause
// Arguments of ents_iterate and ents_assemble: the caller's input stays unchanged, the report says what was
// done.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "support/model.hpp"

namespace iterate_test {
namespace {

using namespace test;

std::string model_text(const std::string& law, const std::string& more = "") {
  return R"({"segment": "line2", "contact": {"normal": )" + law + "}" + more + "}";
}
const std::string stiff_penalty = R"({"type": "penalty", "stiffness": 100})",
                  multiplier = R"({"type": "augmented_multiplier", "stiffness": 100})";

// Slaves above two segments along x, each 2 long.
struct Iteration {
  explicit Iteration(const std::string& text, std::vector<double> where)
      : model(text), slave(std::move(where)) {
    mesh.struct_size = sizeof mesh;
    mesh.segments = 2, mesh.nodes = 3, mesh.connectivity = connectivity, mesh.positions = positions;
    int64_t size = 0;
    EXPECT_EQ(ents_tree_size(model.get(), 2, &size, nullptr), ENTS_OK);
    tree.resize(static_cast<std::size_t>(size));
    EXPECT_EQ(ents_tree_build(model.get(), &mesh, tree.data(), size, nullptr), ENTS_OK);
    const std::size_t count = slave.size() / 2;
    segment.assign(count, -1), xi.assign(count, 0.0), found.assign(count, 0), equations.resize(2 * count);
    for (std::size_t i = 0; i < equations.size(); ++i) equations[i] = 6 + static_cast<int64_t>(i);
    detection.struct_size = sizeof detection;
    detection.slave = slave.data(), detection.reach = 0.5, detection.segment = segment.data(),
    detection.xi = xi.data();
    detection.flags = found.data();
    input.struct_size = sizeof input, output.struct_size = sizeof output, system.struct_size = sizeof system;
    system.index_size = 8, system.slave_nodes = static_cast<int64_t>(count), system.master_nodes = 3;
    system.slave_equations = equations.data(), system.master_equations = of_master;
    system.rows = 6 + static_cast<int64_t>(equations.size());
    residual.assign(64, 0.0);
    system.residual = residual.data();
  }
  int64_t count() const { return static_cast<int64_t>(segment.size()); }
  int32_t iterate(const ents_system* into) {
    return ents_iterate(model.get(), &mesh, tree.data(), static_cast<int64_t>(tree.size()), 0, count(),
                        &detection, &input, &output, into, &report);
  }
  // The segments and starts are those of `segment` and `xi`.
  int32_t assemble() {
    ents_input in = input;
    in.slave = slave.data(), in.slave_stride = 2;
    in.mesh = &mesh, in.segment = segment.data(), in.segment_stride = 1, in.start = xi.data(),
    in.start_stride = 1;
    return ents_assemble(model.get(), 0, count(), &in, &output, &system, &report);
  }

  Model model;
  int64_t connectivity[4] = {0, 1, 1, 2}, of_master[6] = {0, 1, 2, 3, 4, 5};
  double positions[6] = {0, 0, 2, 0, 4, 0};
  ents_master_mesh mesh{};
  std::vector<double> tree, slave, xi, residual;
  std::vector<int64_t> segment, equations;
  std::vector<int32_t> found;
  ents_detection detection{};
  ents_input input{};
  ents_output output{};
  ents_system system{};
  ents_report report = new_report();
};

TEST(Iterate, MultiplierEquationsBeyondTheRowsAreRefused) {
  Iteration it(model_text(multiplier), {0.5, -0.01});
  const double lambda = 1.0;
  int64_t equation = 9; // of 8
  it.input.multiplier = &lambda;
  it.system.multiplier_equations = &equation;
  EXPECT_EQ(it.iterate(&it.system), ENTS_BAD_VALUE);
  EXPECT_NE(std::strstr(it.report.message, "multiplier_equations of element 0 is 9; there are 8 rows"),
            nullptr)
      << it.report.message;
  for (const double r : it.residual) EXPECT_EQ(r, 0.0);
  equation = -1; // prescribed
  EXPECT_EQ(it.iterate(&it.system), ENTS_OK);
}

// A texture under a slave that crosses the border of two segments: its xi on the old one says nothing about
// the new one.
TEST(Iterate, StartsFromWhatItFinds) {
  for (const char* law : {"penalty", "augmented"}) {
    Iteration it(
        model_text(std::string(R"({"type": ")") + law + R"(", "stiffness": 100})",
                   R"(, "height": {"type": "sine", "amplitude": 0.01875, "wave_vector": [8], "phase": 1.9})"),
        {2.04649, -0.02464});
    std::vector<double> begin(static_cast<std::size_t>(it.model.layout.state_size)), end = begin;
    ASSERT_EQ(ents_state_init(it.model.get(), 1, begin.data(), it.model.layout.state_size, nullptr), ENTS_OK);
    double gap = 0.0, detected = 0.0;
    int32_t flags = 0;
    it.detection.gap = &detected;
    it.input.state_begin = begin.data();
    it.output.wanted = ENTS_GAP | ENTS_STATE | ENTS_FLAGS;
    it.output.gap = &gap, it.output.state_end = end.data(), it.output.flags = &flags;
    ASSERT_EQ(it.iterate(nullptr), ENTS_OK);
    ASSERT_EQ(it.segment[0], 1);
    begin = end;
    it.slave[0] = 1.98378;
    ASSERT_EQ(it.iterate(nullptr), ENTS_OK);
    ASSERT_EQ(it.segment[0], 0);
    EXPECT_NEAR(gap, detected, 1e-12) << law;
    EXPECT_LT(gap, -0.03);
    EXPECT_TRUE(flags & ENTS_FLAG_CONTACT);
    // summed up, too
    it.output.wanted = ENTS_FLAGS;
    ASSERT_EQ(it.iterate(&it.system), ENTS_OK);
    EXPECT_LT(it.residual[7], -1.0);
  }
}

TEST(Iterate, PaddingOfTangentsIsTheCallers) {
  Iteration it(model_text(stiff_penalty), {50.0, 50.0, 0.5, -0.01});
  std::vector<double> tangent(120, -7.0);
  it.output.wanted = ENTS_TANGENT;
  it.output.tangent = tangent.data(), it.output.tangent_stride = 60, it.output.tangent_leading_dimension = 10;
  ASSERT_EQ(it.iterate(nullptr), ENTS_OK);
  ASSERT_EQ(it.segment[0], -1);
  for (std::size_t e = 0; e < 2; ++e)
    for (std::size_t j = 0; j < 6; ++j)
      for (std::size_t i = 0; i < 10; ++i) {
        const double k = tangent[60 * e + 10 * j + i];
        EXPECT_EQ(k == -7.0, i >= 6) << e << " " << j << " " << i;
      }
}

TEST(Iterate, TellsTheFirstOfTheRefused) {
  Iteration it(model_text(stiff_penalty, R"(, "penetration_limit": 0.05)"),
               {0.5, -0.1, 50.0, 50.0, 1.5, -0.2});
  std::vector<double> energy(3);
  std::vector<int32_t> status(3, -9);
  it.output.wanted = ENTS_ENERGY;
  it.output.energy = energy.data(), it.output.energy_stride = 1, it.output.status = status.data(),
  it.output.status_stride = 1;
  EXPECT_EQ(it.iterate(nullptr), ENTS_DEEP_PENETRATION);
  EXPECT_EQ(it.report.status, ENTS_DEEP_PENETRATION);
  EXPECT_EQ(it.report.element, 0);
  EXPECT_EQ(status, (std::vector<int32_t>{ENTS_DEEP_PENETRATION, ENTS_OK, ENTS_DEEP_PENETRATION}));
  EXPECT_NE(std::strstr(it.report.message, "gap = -0.1"), nullptr) << it.report.message;
}

// All that is wrong whatever the slaves is refused while their segments are what they were.
TEST(Iterate, RefusesBeforeItWrites) {
  const auto refused = [](Iteration& it, int32_t status, const char* said, bool with_system = false) {
    it.xi[0] = -7.0, it.found[0] = -7;
    EXPECT_EQ(it.iterate(with_system ? &it.system : nullptr), status) << said;
    EXPECT_NE(std::strstr(it.report.message, said), nullptr) << it.report.message;
    EXPECT_EQ(it.segment[0], -1) << said;
    EXPECT_EQ(it.xi[0], -7.0) << said;
    EXPECT_EQ(it.found[0], -7) << said;
  };
  double gap = 0.0;
  const auto want_gap = [&gap](Iteration& it) { it.output.wanted = ENTS_GAP, it.output.gap = &gap; };
  const std::string rough = R"(, "friction": {"type": "rough", "stiffness": 10}}})",
                    segment = R"({"segment": "line2", )";
  {
    Iteration it(segment + R"("contact": {"normal": )" + stiff_penalty + rough, {0.5, -0.01});
    want_gap(it);
    const std::vector<double> state(static_cast<std::size_t>(it.model.layout.state_size));
    it.input.state_begin = state.data();
    refused(it, ENTS_NULL_ARGUMENT, "input.positions_begin is null");
  }
  {
    Iteration it(segment + R"("patch": [[0, 1], [1, 2]], "contact": {"normal": )" + stiff_penalty + "}}",
                 {0.5, -0.01});
    want_gap(it);
    refused(it, ENTS_BAD_VALUE, "patches");
  }
  {
    Iteration it(R"({"segment": "line2"})", {0.5, -0.01});
    want_gap(it);
    it.output.wanted = ENTS_RESIDUAL;
    refused(it, ENTS_BAD_MASK, "the model has no \"contact\"");
    it.output.wanted = ENTS_GAP;
    refused(it, ENTS_BAD_MASK, "the model has no \"contact\"", true);
  }
  {
    Iteration it(model_text(multiplier), {0.5, -0.01});
    want_gap(it);
    refused(it, ENTS_NULL_ARGUMENT, "input.multiplier");
  }
  Iteration it(model_text(stiff_penalty), {0.5, -0.01});
  want_gap(it);
  it.output.wanted = 1 << 25;
  refused(it, ENTS_BAD_MASK, "output.wanted has unknown bits");
  it.output.wanted = ENTS_GAP | ENTS_PRESSURE;
  refused(it, ENTS_NULL_ARGUMENT, "output.pressure");
  it.output.wanted = ENTS_GAP;
  it.system.index_size = 5;
  refused(it, ENTS_BAD_VALUE, "system.index_size", true);
  it.system.index_size = 8, it.system.slave_equations = nullptr;
  refused(it, ENTS_NULL_ARGUMENT, "system.slave_equations", true);
  it.detection.reach = 0.0;
  refused(it, ENTS_BAD_VALUE, "detection.reach");
  it.detection.reach = 0.5;
  EXPECT_EQ(it.iterate(nullptr), ENTS_OK) << it.report.message;
}

// An older caller's ents_detection ends before the flags, and nothing is read beyond its end. A slave that is
// lost is reported nevertheless.
TEST(Iterate, FlagsOfTheDetectionAreOptional) {
  for (const bool older : {false, true}) {
    Iteration it(model_text(stiff_penalty), {0.5, -0.01, 2.0, -0.2});
    it.positions[1] = it.positions[5] = 0.5; // a groove
    ASSERT_EQ(ents_tree_refit(it.model.get(), &it.mesh, it.tree.data(), static_cast<int64_t>(it.tree.size()),
                              nullptr),
              ENTS_OK);
    it.slave[1] = 0.5 * 0.75 - 0.01;
    std::vector<double> gap(2, -7.0);
    it.output.wanted = ENTS_GAP, it.output.gap = gap.data(), it.output.gap_stride = 1;
    EXPECT_EQ(it.iterate(nullptr), ENTS_NO_PROJECTION);
    EXPECT_EQ(it.found[1], ENTS_FLAG_SEARCHED | ENTS_FLAG_BEHIND_EDGE);
    it.found.assign(2, -7);
    if (older)
      it.detection.struct_size = offsetof(ents_detection, flags);
    else
      it.detection.flags = nullptr;
    EXPECT_EQ(it.iterate(nullptr), ENTS_NO_PROJECTION);
    EXPECT_EQ(it.report.element, 1);
    EXPECT_NE(std::strstr(it.report.message, "slave 1 is behind an edge"), nullptr) << it.report.message;
    it.slave[3] = 0.3;
    EXPECT_EQ(it.iterate(nullptr), ENTS_OK) << it.report.message;
    EXPECT_LT(gap[0], 0.0);
    EXPECT_EQ(it.found, std::vector<int32_t>(2, -7));
  }
}

// A model without "contact" has nothing to add: refused as ents_evaluate refuses a residual of it.
TEST(Assemble, AModelWithoutContactIsRefused) {
  Iteration it(R"({"segment": "line2"})", {0.5, -0.01});
  EXPECT_EQ(it.iterate(&it.system), ENTS_BAD_MASK);
  EXPECT_NE(std::strstr(it.report.message, "the model has no \"contact\""), nullptr) << it.report.message;
  it.segment[0] = 0;
  EXPECT_EQ(it.assemble(), ENTS_BAD_MASK);
  EXPECT_NE(std::strstr(it.report.message, "the model has no \"contact\""), nullptr) << it.report.message;
  double gap = 0.0;
  it.output.wanted = ENTS_GAP, it.output.gap = &gap;
  EXPECT_EQ(it.iterate(nullptr), ENTS_OK) << it.report.message; // projections alone need none
  EXPECT_DOUBLE_EQ(gap, -0.01);
}

// Nobody asks for a result of the element, and it is clearly open: its area is looked at all the same.
TEST(Assemble, AreasOfOpenElementsAreChecked) {
  for (const char* height : {"", R"(, "height": {"type": "sine", "amplitude": 0.01, "wave_vector": [1]})"}) {
    for (const std::size_t count : {1u, 9u}) { // one by one, and in lanes
      std::vector<double> where;
      for (std::size_t i = 0; i < count; ++i) where.insert(where.end(), {0.5, 0.3});
      Iteration it(model_text(stiff_penalty, height), where);
      for (const double bad :
           {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        std::vector<double> area(count, 1.0);
        it.input.area = area.data(), it.input.area_stride = 1;
        EXPECT_EQ(it.iterate(&it.system), ENTS_OK) << it.report.message;
        area[0] = bad;
        EXPECT_EQ(it.iterate(&it.system), bad < 0.0 && std::isfinite(bad) ? ENTS_BAD_VALUE : ENTS_NON_FINITE)
            << bad;
        EXPECT_NE(std::strstr(it.report.message, "input.area"), nullptr) << it.report.message;
      }
    }
  }
}

// What a slave without a segment gives does not depend on who asks: ents_evaluate, far beside a segment;
// ents_iterate alone, or into a system.
TEST(Iterate, ASlaveWithoutASegmentHoldsItsMultipliers) {
  const std::string coulomb = R"(, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 70})";
  for (const bool friction : {false, true})
    for (const double area : {0.7, 0.0}) {
      Iteration it(R"({"segment": "line2", "contact": {"normal": )" + multiplier + (friction ? coulomb : "") +
                       "}}",
                   {50.0, 50.0});
      const auto n = static_cast<std::size_t>(it.model.layout.dofs),
                 m = static_cast<std::size_t>(it.model.layout.multipliers);
      ASSERT_EQ(m, friction ? 2u : 1u);
      const double lambda[] = {3.1, -0.9};
      const std::size_t leading = n + 2;
      std::vector<double> alone_r(n, -7.0), alone_k(leading * n, -7.0), r = alone_r, k = alone_k;
      double alone_energy = -7.0, energy = -7.0;
      it.input.multiplier = lambda, it.input.area = &area;
      it.input.shared = ENTS_SHARED_NO_STATE; // of friction: its history begins here
      it.output.wanted = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_ENERGY;
      it.output.tangent_leading_dimension = static_cast<int64_t>(leading);
      it.output.residual = alone_r.data(), it.output.tangent = alone_k.data(),
      it.output.energy = &alone_energy;
      ents_input beside = it.input;
      beside.slave = it.slave.data(), beside.master = it.positions;
      ASSERT_EQ(ents_evaluate(it.model.get(), 0, 1, &beside, &it.output, &it.report), ENTS_OK)
          << it.report.message;
      EXPECT_DOUBLE_EQ(alone_r[6], -(area > 0.0 ? area : 1.0) / 100 * 3.1);
      it.output.residual = r.data(), it.output.tangent = k.data(), it.output.energy = &energy;
      ASSERT_EQ(it.iterate(nullptr), ENTS_OK) << it.report.message;
      EXPECT_EQ(it.segment[0], -1);
      EXPECT_EQ(r, alone_r);
      EXPECT_EQ(k, alone_k);
      EXPECT_EQ(energy, alone_energy);
      // the same in the host's equations
      const int64_t equation[] = {8, 9}, row_begin[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 4},
                    columns[] = {8, 9, 8, 9};
      double values[4] = {};
      it.system.multiplier_equations = equation, it.system.rows = 10;
      it.system.row_begin = row_begin, it.system.columns = columns, it.system.values = values;
      it.output.wanted = ENTS_ENERGY, energy = -7.0;
      ASSERT_EQ(it.iterate(&it.system), ENTS_OK) << it.report.message;
      EXPECT_EQ(energy, alone_energy);
      for (std::size_t a = 0; a < m; ++a) {
        EXPECT_EQ(it.residual[8 + a], alone_r[6 + a]);
        for (std::size_t b = 0; b < m; ++b) EXPECT_EQ(values[2 * a + b], alone_k[(6 + b) * leading + 6 + a]);
      }
    }
}

// Inputs of elements without a segment are checked as those of all others, but for their start, which is
// not set.
TEST(Assemble, InputsOfElementsWithoutASegmentAreChecked) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const struct {
    const char* input;
    double value;
    int32_t status;
  } mistakes[] = {{"slave", inf, ENTS_NON_FINITE},      {"area", nan, ENTS_NON_FINITE},
                  {"area", inf, ENTS_NON_FINITE},       {"area", -3.0, ENTS_BAD_VALUE},
                  {"multiplier", nan, ENTS_NON_FINITE}, {"multiplier", 1e200, ENTS_OUT_OF_RANGE},
                  {"state_begin", 0.0, ENTS_BAD_STATE}, {"state_begin", nan, ENTS_BAD_STATE}};
  for (const bool has_multiplier : {false, true}) {
    Iteration it(model_text(has_multiplier ? multiplier : stiff_penalty), {50.0, 50.0, 50.0, 50.0});
    const std::size_t size = static_cast<std::size_t>(it.model.layout.state_size);
    std::vector<double> area(2, 1.0), lambda(2, 1.0), state(2 * size);
    const int64_t equation[] = {10, 11};
    std::vector<int32_t> status(2, -9);
    it.input.area = area.data(), it.input.area_stride = 1;
    if (has_multiplier) it.input.multiplier = lambda.data(), it.input.multiplier_stride = 1;
    it.input.state_begin = state.data(), it.input.state_begin_stride = static_cast<int64_t>(size);
    it.output.status = status.data(), it.output.status_stride = 1;
    it.system.multiplier_equations = equation, it.system.rows = 12;
    ASSERT_EQ(ents_state_init(it.model.get(), 2, state.data(), static_cast<int64_t>(size), nullptr), ENTS_OK);
    it.xi[1] = nan;
    ASSERT_EQ(it.assemble(), ENTS_OK) << it.report.message;
    for (const auto& mistake : mistakes) {
      const std::string name = mistake.input;
      if (name == "multiplier" && !has_multiplier) continue;
      double& wrong = name == "slave"        ? it.slave[2]
                      : name == "area"       ? area[1]
                      : name == "multiplier" ? lambda[1]
                                             : state[size];
      const double right = wrong;
      wrong = mistake.value;
      std::fill(it.residual.begin(), it.residual.end(), 0.0);
      const auto expect_refused = [&](int32_t result, const char* call) {
        EXPECT_EQ(result, mistake.status) << call << " " << name << " " << mistake.value;
        EXPECT_EQ(it.report.element, 1);
        EXPECT_EQ(status[1], mistake.status);
        const std::string said = mistake.status < 0 ? "input." + name : "exceeds the range";
        EXPECT_NE(std::strstr(it.report.message, said.c_str()), nullptr) << it.report.message;
        EXPECT_NE(std::strstr(it.report.message, "element 1"), nullptr) << it.report.message;
        EXPECT_EQ(it.residual[11], 0.0);
      };
      expect_refused(it.assemble(), "assemble");
      if (name != "slave") expect_refused(it.iterate(nullptr), "iterate"); // a detection has looked at it
      wrong = right;
    }
  }
}

// A slave without area carries no force; its multiplier is zero, and its row of the system is not.
TEST(Assemble, SlavesWithoutAreaHoldTheirMultiplier) {
  for (const char* law : {"augmented_multiplier", "multiplier"})
    for (const double gap : {-0.01, 0.01}) {
      Iteration it(model_text(std::string(R"({"type": ")") + law + R"(", "stiffness": 100})"),
                   {0.5, gap, 50.0, 50.0});
      const double lambda[] = {3.0, 3.0}, area[] = {0.0, 0.0};
      const int64_t equation[] = {10, 11};
      it.input.multiplier = lambda, it.input.multiplier_stride = 1, it.input.area = area,
      it.input.area_stride = 1;
      it.system.multiplier_equations = equation;
      it.system.rows = 12;
      ASSERT_EQ(it.iterate(&it.system), ENTS_OK) << it.report.message;
      for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(it.residual[i], 0.0);
      EXPECT_DOUBLE_EQ(it.residual[10], -3.0 / 100);
      EXPECT_DOUBLE_EQ(it.residual[11], -3.0 / 100);
    }
}

} // namespace
} // namespace iterate_test
