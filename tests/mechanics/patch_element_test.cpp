// SPDX-License-Identifier: BSD-3-Clause
// Elements of one slave and several segments ("patch"): they are the element of the segment that the slave is
// on, spread over all nodes; and a slave that slides over all of them feels one surface.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh_surface.hpp"
#include "worst.hpp"

namespace mechanics::patch_element_test {
namespace {

using nlohmann::json;

ents_layout layout_of(const Model& model) {
  ents_layout layout{};
  layout.struct_size = sizeof layout;
  ents_model_layout(model.handle(), &layout, nullptr);
  return layout;
}

// One evaluation with everything that a state needs.
struct Evaluation {
  std::int32_t status = 0, flags = 0;
  double gap = 0.0, energy = 0.0;
  std::vector<double> residual, tangent, gap_gradient, gap_hessian, xi_gradient, xi_hessian, state;
};
Evaluation evaluate(const Model& model, const std::vector<double>& slave, const std::vector<double>& master,
                    const double* coordinates, const std::vector<double>& state, const double* start,
                    bool with_kinematics) {
  const ents_layout layout = layout_of(model);
  const auto n = static_cast<std::size_t>(layout.dofs), t = static_cast<std::size_t>(layout.parameters);
  Evaluation e;
  e.residual.resize(n), e.tangent.resize(n * n), e.state.resize(static_cast<std::size_t>(layout.state_size));
  e.gap_gradient.resize(n), e.gap_hessian.resize(n * n), e.xi_gradient.resize(t * n),
      e.xi_hessian.resize(t * n * n);
  ents_input in{};
  in.struct_size = sizeof in;
  in.slave = slave.data(), in.master = master.data(), in.surface_coordinates = coordinates, in.start = start;
  if (!state.empty()) in.state_begin = state.data();
  ents_output out{};
  out.struct_size = sizeof out;
  out.wanted = ENTS_GAP | ENTS_ENERGY | ENTS_RESIDUAL | ENTS_TANGENT | ENTS_STATE | ENTS_FLAGS;
  if (with_kinematics)
    out.wanted |= ENTS_GAP_GRADIENT | ENTS_GAP_HESSIAN | ENTS_XI_GRADIENT | ENTS_XI_HESSIAN;
  out.gap = &e.gap, out.energy = &e.energy, out.flags = &e.flags;
  out.residual = e.residual.data(), out.tangent = e.tangent.data(), out.state_end = e.state.data();
  out.gap_gradient = e.gap_gradient.data(), out.gap_hessian = e.gap_hessian.data();
  out.xi_gradient = e.xi_gradient.data(), out.xi_hessian = e.xi_hessian.data();
  ents_report report = new_report();
  e.status = ents_evaluate(model.handle(), 0, 1, &in, &out, &report);
  EXPECT_GE(e.status, 0) << report.message;
  return e;
}

json segment_model(const std::string& segment, bool friction) {
  const bool line = basis_named(segment).dimension == 2;
  json model{
      {"segment", segment},
      {"border", 0.1},
      {"penetration_limit", 10.0},
      {"height", {{"type", "sine"}, {"amplitude", 0.02}, {"wave_vector", line ? json{0.3} : json{0.3, 0.2}}}},
      {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 7.0}}}}}};
  if (friction)
    model["contact"]["friction"] = {{"type", "coulomb"}, {"coefficient", 0.4}, {"stiffness", 5.0}};
  return model;
}

json patch_of(const MeshSurface& mesh) {
  json patch = json::array();
  const int m = mesh.basis->node_count();
  for (std::int64_t s = 0; s < mesh.segments(); ++s) {
    json nodes = json::array();
    for (int i = 0; i < m; ++i) nodes.push_back(mesh.connectivity[static_cast<std::size_t>(s * m + i)]);
    patch.push_back(nodes);
  }
  return patch;
}

// s of each node of the patch, where all segments agree.
std::vector<double> coordinates_of_nodes(const MeshSurface& mesh) {
  const auto t = static_cast<std::size_t>(mesh.basis->parameters());
  std::vector<double> s(static_cast<std::size_t>(mesh.nodes()) * t);
  for (std::size_t i = 0; i < mesh.connectivity.size(); ++i)
    for (std::size_t k = 0; k < t; ++k)
      s[static_cast<std::size_t>(mesh.connectivity[i]) * t + k] = mesh.surface_coordinates[i * t + k];
  return s;
}

class PatchElements : public testing::TestWithParam<const char*> {};

TEST_P(PatchElements, AreTheElementOfTheSegmentTheSlaveIsOn) {
  Random random(11);
  const Basis& basis = basis_named(GetParam());
  const auto d = static_cast<std::size_t>(basis.dimension);
  for (const bool friction : {false, true}) {
    json text = segment_model(GetParam(), friction);
    const Model single(text.dump());
    const MeshSurface mesh = draw_mesh(random, basis,
                                       basis.dimension == 2     ? 6
                                       : basis.node_count() > 9 ? 4
                                                                : 3,
                                       0.15);
    text["patch"] = patch_of(mesh);
    const Model patch(text.dump());
    const ents_layout layout = layout_of(patch), one = layout_of(single);
    ASSERT_EQ(layout.nodes, mesh.nodes());
    ASSERT_EQ(layout.dofs, layout.dimension * (mesh.nodes() + 1));
    const std::vector<double> coordinates = coordinates_of_nodes(mesh);
    Detector detector(single, mesh);
    int closed = 0, on = 0;
    for (int trial = 0; trial < 200; ++trial) {
      std::vector<double> slave;
      const double size = basis.node_count() > 9 || basis.node_count() == 4 ? 4.0 : 1.0;
      for (std::size_t k = 0; k + 1 < d; ++k)
        slave.push_back(random.uniform(size, 2.0 * (d == 2 ? 6 : 3) - size));
      slave.push_back(random.uniform(-0.6, 0.3));
      Detector::Found found;
      detector.detect(slave, 2.0, found);
      if (found.segment[0] < 0 || (found.flags[0] & ENTS_FLAG_AMBIGUOUS) != 0) continue;
      ++on;
      std::vector<double> state(static_cast<std::size_t>(layout.state_size)),
          fresh(static_cast<std::size_t>(one.state_size));
      ents_state_init(patch.handle(), 1, state.data(), layout.state_size, nullptr);
      ents_state_init(single.handle(), 1, fresh.data(), one.state_size, nullptr);
      const Evaluation whole =
          evaluate(patch, slave, mesh.positions, coordinates.data(), state, nullptr, true);
      const Evaluation part = evaluate(single, slave, mesh.master(found.segment[0]),
                                       mesh.coordinates(found.segment[0]), fresh, found.xi.data(), true);
      ASSERT_EQ(whole.status, part.status);
      if (whole.status != ENTS_OK) continue;
      closed += (whole.flags & ENTS_FLAG_CONTACT) != 0;
      EXPECT_EQ(whole.flags & ~ENTS_FLAG_SEARCHED, part.flags & ~ENTS_FLAG_SEARCHED);
      EXPECT_NEAR(whole.gap, part.gap, 1e-14);
      EXPECT_NEAR(whole.energy, part.energy, 1e-14);
      const auto n = static_cast<std::size_t>(one.dofs), all = static_cast<std::size_t>(layout.dofs);
      const auto place = [&](std::size_t dof) {
        if (dof < d) return dof;
        const auto at = static_cast<std::size_t>(found.segment[0] * basis.node_count()) + dof / d - 1;
        return d * (1 + static_cast<std::size_t>(mesh.connectivity[at])) + dof % d;
      };
      const auto same = [&](const double* spread, const double* local, bool matrix, const char* what) {
        std::vector<double> expected(matrix ? all * all : all, 0.0);
        double size_of = 1.0;
        for (std::size_t j = 0; j < (matrix ? n : 1); ++j)
          for (std::size_t i = 0; i < n; ++i) {
            expected[matrix ? place(j) * all + place(i) : place(i)] = local[j * n + i];
            test::raise(size_of, std::fabs(local[j * n + i]));
          }
        double worst = 0.0;
        for (std::size_t i = 0; i < expected.size(); ++i)
          test::raise(worst, std::fabs(spread[i] - expected[i]));
        EXPECT_LT(worst, 1e-11 * size_of) << what; // both projections have converged, not to the same bit
      };
      same(whole.residual.data(), part.residual.data(), false, "residual");
      same(whole.tangent.data(), part.tangent.data(), true, "tangent");
      same(whole.gap_gradient.data(), part.gap_gradient.data(), false, "gap_gradient");
      same(whole.gap_hessian.data(), part.gap_hessian.data(), true, "gap_hessian");
      for (std::size_t t = 0; t + 1 < d; ++t) {
        same(whole.xi_gradient.data() + t * all, part.xi_gradient.data() + t * n, false, "xi_gradient");
        same(whole.xi_hessian.data() + t * all * all, part.xi_hessian.data() + t * n * n, true, "xi_hessian");
      }
    }
    EXPECT_GT(on, 100);
    EXPECT_GT(closed, 30);
  }
}

INSTANTIATE_TEST_SUITE_P(Bases, PatchElements,
                         testing::Values("line2", "line3", "catmull_rom4", "bspline4", "tri3", "quad4",
                                         "quad9"));

// Friction over a straight row of ten segments of random lengths in one element: what one long segment gives.
TEST(PatchElement, FrictionSlidesOverAllOfThem) {
  Random random(5);
  json text{{"segment", "line2"},
            {"contact",
             {{"normal", {{"type", "penalty"}, {"stiffness", 10.0}}},
              {"friction", {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 1.0}}}}}};
  const Model single(text.dump());
  std::vector<double> row;
  json patch = json::array();
  for (int i = 0; i <= 10; ++i) {
    row.push_back(i + (i % 10 == 0 ? 0.0 : random.uniform(-0.3, 0.3)));
    row.push_back(0.0);
    if (i > 0) patch.push_back({i - 1, i});
  }
  text["patch"] = patch;
  const Model chain(text.dump());
  const std::vector<double> ends = {0.0, 0.0, 10.0, 0.0};
  const ents_layout layout = layout_of(chain), one = layout_of(single);
  std::vector<double> state(static_cast<std::size_t>(layout.state_size)),
      expected(static_cast<std::size_t>(one.state_size));
  ents_state_init(chain.handle(), 1, state.data(), layout.state_size, nullptr);
  ents_state_init(single.handle(), 1, expected.data(), one.state_size, nullptr);
  int sticks = 0, slips = 0;
  for (int step = 0; step <= 200; ++step) {
    // to and fro, pressed more and less
    const std::vector<double> slave = {5.0 + 4.9 * std::sin(0.05 * step),
                                       -0.1 - 0.08 * std::sin(0.31 * step)};
    const Evaluation a = evaluate(chain, slave, row, nullptr, state, nullptr, false);
    const Evaluation b = evaluate(single, slave, ends, nullptr, expected, nullptr, false);
    ASSERT_EQ(a.status, ENTS_OK);
    ASSERT_EQ(b.status, ENTS_OK);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(a.residual[i], b.residual[i], 1e-12) << step;
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(a.tangent[j * static_cast<std::size_t>(layout.dofs) + i],
                    b.tangent[j * static_cast<std::size_t>(one.dofs) + i], 1e-11);
    sticks += (a.flags & ENTS_FLAG_STICK) != 0, slips += (a.flags & ENTS_FLAG_SLIP) != 0;
    state = a.state, expected = b.state;
  }
  EXPECT_GT(sticks, 10);
  EXPECT_GT(slips, 50);
}

// Beyond the ends it is open; behind the bottom of a groove it is lost, and says so.
TEST(PatchElement, BeyondTheEndsIsOpenBehindAKinkIsLost) {
  json text{{"segment", "line2"},
            {"patch", {{0, 1}, {1, 2}}},
            {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 10.0}}}}}};
  const Model model(text.dump());
  const std::vector<double> groove = {-1.0, 0.5, 0.0, 0.0, 1.0, 0.5};
  for (const double x : {-2.0, 2.0}) {
    const Evaluation open = evaluate(model, {x, 0.2}, groove, nullptr, {}, nullptr, false);
    EXPECT_EQ(open.status, ENTS_OK);
    EXPECT_NE(open.flags & ENTS_FLAG_OUTSIDE, 0);
    for (const double r : open.residual) EXPECT_EQ(r, 0.0);
  }
  EXPECT_EQ(evaluate(model, {0.0, -0.1}, groove, nullptr, {}, nullptr, false).status, ENTS_NO_PROJECTION);
  text["border"] = 0.2;
  const Model wide(text.dump());
  const Evaluation closed = evaluate(wide, {0.0, -0.1}, groove, nullptr, {}, nullptr, false);
  EXPECT_EQ(closed.status, ENTS_OK);
  EXPECT_NE(closed.flags & ENTS_FLAG_CONTACT, 0);
}

// A slave that is open crosses a groove in small steps: the flank it meets is not the one it was last over.
TEST(PatchElement, AnOpenSlaveIsLookedForAnew) {
  const Model model(
      R"({"segment": "line2", "patch": [[0, 1], [1, 2]], "contact": {"normal": {"type": "penalty", "stiffness": 100}}})");
  const std::vector<double> groove = {-1, 5, 0, 0, 1, 5}; // its flanks are at x = +-0.56 where y = 2.8
  std::vector<double> state;
  for (const double x : {-0.3, 0.1, 0.5, 0.58, 0.6, 0.62}) {
    const std::vector<double> slave = {x, 2.8};
    const Evaluation followed = evaluate(model, slave, groove, nullptr, state, nullptr, false);
    const Evaluation fresh = evaluate(model, slave, groove, nullptr, {}, nullptr, false);
    EXPECT_EQ(followed.status, 0);
    EXPECT_EQ(followed.gap<0, x> 0.56) << x;
    EXPECT_EQ(followed.gap, fresh.gap) << x;
    state = followed.state;
  }
}

TEST(PatchElement, BadPatchesAreNamed) {
  const auto message = [](const json& patch, const json& more = {}) {
    json text{{"segment", "line2"}, {"patch", patch}};
    if (!more.is_null()) text.update(more);
    ents_model* model = nullptr;
    ents_report report = new_report();
    const std::int32_t status =
        ents_model_create(text.dump().c_str(), -1, nullptr, nullptr, 0, &model, &report);
    EXPECT_EQ(status, ENTS_BAD_VALUE);
    EXPECT_EQ(model, nullptr);
    return std::string(report.message);
  };
  EXPECT_NE(message(json::array()).find("/patch"), std::string::npos);
  EXPECT_NE(message({{0, 1, 2}}).find("/patch/0"), std::string::npos);
  EXPECT_NE(message({{0, 1}, {1, 1}}).find("/patch/1"), std::string::npos);
  EXPECT_NE(message({{0, 1}, {1, 3}}).find("node 2"), std::string::npos);
  EXPECT_NE(message({{0, 1}, {1, 64}}).find("/patch/1"), std::string::npos);
  EXPECT_NE(message({{0, -1}}).find("/patch/0"), std::string::npos);
  EXPECT_NE(message({{0, 0.5}}).find("/patch/0"), std::string::npos);
  EXPECT_NE(message("all").find("/patch"), std::string::npos);
  EXPECT_NE(message({{0, 1}, {1, 2}}, {{"surface_coordinates", {{0}, {1}}}}).find("3 master nodes"),
            std::string::npos);
  EXPECT_NE(message({{0, 1}}, {{"contact",
                                {{"normal", {{"type", "augmented"}, {"stiffness", 1}}},
                                 {"friction", {{"type", "rough"}, {"stiffness", 1}}}}}})
                .find("/contact/normal/type"),
            std::string::npos);
  EXPECT_EQ(
      layout_of(
          Model(R"({"segment": "line2", "patch": [[0, 1], [1, 2]], "surface_coordinates": [[0], [1], [2]]})"))
          .nodes,
      3);
}

} // namespace
} // namespace mechanics::patch_element_test
