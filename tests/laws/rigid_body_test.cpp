// A rigid master that moves and turns, as a change of frame: against the deformable element, differences, and
// the sum of all elements in a host's equations.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "law_elements.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace laws::rigid_body_test {
namespace {

ents_pose pose_of(int d) {
  ents_pose pose{};
  pose.struct_size = sizeof pose;
  EXPECT_EQ(ents_pose_init(d, &pose, nullptr), ENTS_OK);
  return pose;
}
ents_pose draw_pose(Random& random, int d) {
  ents_pose pose = pose_of(d);
  double translation[3], spin[3];
  for (int i = 0; i < 3; ++i) translation[i] = random.uniform(-2, 2), spin[i] = random.uniform(-3, 3);
  EXPECT_EQ(ents_pose_move(d, translation, spin, &pose, nullptr), ENTS_OK);
  return pose;
}
std::vector<double> in_space(int d, const ents_pose& pose, const std::vector<double>& y) {
  std::vector<double> x(y.size());
  const auto n = static_cast<std::int64_t>(y.size()) / d;
  EXPECT_EQ(ents_pose_to_space(d, &pose, n, y.data(), x.data(), nullptr), ENTS_OK);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += pose.point[i % static_cast<std::size_t>(d)];
  return x;
}

int body_dofs(int d) { return d == 2 ? 3 : 6; }

// Residual and tangent of slave and body, element by element
struct BodyElements {
  std::vector<double> residual, tangent;
};
BodyElements body_elements(int d, const ents_pose& pose, const LawElements& e, const LawResults& r) {
  const int n = d + body_dofs(d);
  const auto count = static_cast<std::size_t>(e.at.count), dd = static_cast<std::size_t>(d),
             nn = static_cast<std::size_t>(n);
  BodyElements out{std::vector<double>(count * nn), std::vector<double>(count * nn * nn)};
  for (std::size_t i = 0; i < count; ++i)
    EXPECT_EQ(ents_pose_element(d, &pose, &e.at.slave[i * dd], &r.residual[i * dd],
                                r.tangent.empty() ? nullptr : &r.tangent[i * dd * dd], &out.residual[i * nn],
                                r.tangent.empty() ? nullptr : &out.tangent[i * nn * nn], nullptr),
              ENTS_OK);
  return out;
}

std::vector<Method> tried() {
  std::vector<Method> all;
  for (const Method& method : methods())
    if (method.name == "penalty_frictionless" || method.name == "penalty_coulomb" ||
        method.name == "exponential_coulomb" || method.name == "augmented_rough")
      all.push_back(method);
  return all;
}

class RigidBody : public testing::TestWithParam<Method> {};

// The forces of the deformable element whose nodes move with the body: their sum and their moment.
TEST_P(RigidBody, HasForcesAndMomentOfTheDeformableElement) {
  Random random(3);
  int contact = 0;
  double worst = 0;
  for (const Basis& basis : mechanics::all_bases()) {
    const int d = basis.dimension;
    const auto dd = static_cast<std::size_t>(d), m = static_cast<std::size_t>(basis.node_count());
    const mechanics::Scene scene = draw_scene(random, basis, "sine", "normal");
    const mechanics::Model rigid = model_of(scene, GetParam(), "rigid"),
                           deformable = model_of(scene, GetParam());
    const LawElements e = draw(random, scene, rigid, mechanics::samples(400), 0.05);
    const ents_pose pose = draw_pose(random, d);
    LawElements moved = e;
    moved.layout = layout_of(deformable.handle());
    moved.at.slave = in_space(d, pose, e.at.slave), moved.at.master = in_space(d, pose, e.at.master);
    LawResults r, s;
    evaluate(rigid, e, ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS, r);
    evaluate(deformable, moved, ENTS_RESIDUAL | ENTS_FLAGS, s);
    const BodyElements body = body_elements(d, pose, e, r);
    const auto n = static_cast<std::size_t>(d + body_dofs(d)), all = dd * (m + 1);
    for (std::size_t i = 0; i < static_cast<std::size_t>(e.at.count); ++i) {
      if (r.status[i] != ENTS_OK || s.status[i] != ENTS_OK || !(r.flags[i] & ENTS_FLAG_CONTACT)) continue;
      ++contact;
      std::vector<double> expected(n);
      double size = 0;
      for (std::size_t a = 0; a < dd; ++a) expected[a] = s.residual[i * all + a];
      for (std::size_t node = 0; node < m; ++node) {
        double arm[3] = {}, force[3] = {};
        for (std::size_t a = 0; a < dd; ++a) {
          force[a] = s.residual[i * all + dd * (node + 1) + a];
          arm[a] = moved.at.master[(i * m + node) * dd + a] - pose.point[a];
          expected[dd + a] += force[a];
          size += std::fabs(force[a]);
        }
        for (std::size_t k = 0; k < 3; ++k)
          if (d == 3 || k == 2)
            expected[2 * dd + (d == 3 ? k : 0)] +=
                arm[(k + 1) % 3] * force[(k + 2) % 3] - arm[(k + 2) % 3] * force[(k + 1) % 3];
      }
      for (std::size_t a = 0; a < n; ++a)
        worst = std::max(worst, std::fabs(body.residual[i * n + a] - expected[a]) / (1e-3 + size));
    }
  }
  EXPECT_GT(contact, mechanics::samples(500));
  EXPECT_LE(worst, 1e-11);
}

// Everything moved by a rigid motion: forces and moment turn with it.
TEST_P(RigidBody, IsIndifferentToTheFrame) {
  Random random(4);
  for (const Basis& basis : mechanics::all_bases()) {
    const int d = basis.dimension;
    const auto dd = static_cast<std::size_t>(d);
    const mechanics::Scene scene = draw_scene(random, basis, "sine", "normal");
    const mechanics::Model model = model_of(scene, GetParam(), "rigid");
    LawElements e = draw(random, scene, model, mechanics::samples(100), 0.05);
    const ents_pose pose = draw_pose(random, d);
    const std::vector<double> x = in_space(d, pose, e.at.slave);
    ents_pose moved = pose;
    const double translation[3] = {1, -2, 0.5}, spin[3] = {0.7, -1.1, 2.3};
    // about the origin of space: the reference point turns, too
    ents_pose whole = pose_of(d);
    ASSERT_EQ(ents_pose_move(d, translation, spin, &whole, nullptr), ENTS_OK);
    const std::vector<double> point = in_space(d, whole, {pose.point, pose.point + d});
    double way[3] = {};
    for (std::size_t i = 0; i < dd; ++i) way[i] = point[i] - pose.point[i];
    ASSERT_EQ(ents_pose_move(d, way, spin, &moved, nullptr), ENTS_OK);
    std::vector<double> y(x.size());
    const std::vector<double> x_moved = in_space(d, whole, x);
    ASSERT_EQ(ents_pose_to_body(d, &moved, e.at.count, x_moved.data(), y.data(), nullptr), ENTS_OK);
    LawResults r, s;
    evaluate(model, e, ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS, r);
    const BodyElements before = body_elements(d, pose, e, r);
    e.at.slave = y;
    evaluate(model, e, ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS, s);
    const BodyElements after = body_elements(d, moved, e, s);
    const auto n = static_cast<std::size_t>(d + body_dofs(d));
    for (std::size_t i = 0; i < static_cast<std::size_t>(e.at.count); ++i) {
      if (r.status[i] != ENTS_OK || s.status[i] != ENTS_OK || r.flags[i] != s.flags[i]) continue;
      double size = 1;
      for (std::size_t a = 0; a < n; ++a) size = std::max(size, std::fabs(before.residual[i * n + a]));
      for (std::size_t part = 0; part < n; part += dd) {
        if (d == 2 && part == 4) {
          EXPECT_NEAR(after.residual[i * n + 4], before.residual[i * n + 4], 1e-12 * size);
          continue;
        }
        std::vector<double> turned(dd);
        ASSERT_EQ(ents_pose_to_space(d, &whole, 1, &before.residual[i * n + part], turned.data(), nullptr),
                  ENTS_OK);
        for (std::size_t a = 0; a < dd; ++a)
          EXPECT_NEAR(after.residual[i * n + part + a], turned[a], 1e-12 * size);
      }
    }
  }
}

// Displacement of the slave, of the reference point, and a spin, along one random direction: fourth-order
// differences.
TEST_P(RigidBody, TangentIsTheDerivativeOfTheResidual) {
  constexpr double steps[] = {1e-4, 1e-5, 1e-6}, tolerance = 2e-7;
  constexpr std::int32_t branch =
      ENTS_FLAG_CONTACT | ENTS_FLAG_STICK | ENTS_FLAG_SLIP | ENTS_FLAG_SHEAR_LIMIT | ENTS_FLAG_OUTSIDE;
  Random random(5);
  mechanics::Worst worst;
  std::int64_t checked = 0, closed = 0;
  for (int round = 0; round < 4; ++round)
    for (const Basis& basis : mechanics::all_bases()) {
      const int d = basis.dimension;
      const auto dd = static_cast<std::size_t>(d), n = static_cast<std::size_t>(d + body_dofs(d));
      const mechanics::Scene scene = draw_scene(random, basis, "sine", "normal");
      const mechanics::Model model = model_of(scene, GetParam(), "rigid");
      const LawElements e = draw(random, scene, model, mechanics::samples(200), 0.05);
      const auto count = static_cast<std::size_t>(e.at.count);
      const ents_pose pose = draw_pose(random, d);
      const std::vector<double> x = in_space(d, pose, e.at.slave);
      std::vector<double> v(n);
      for (double& a : v) a = random.uniform(-1, 1);
      LawResults centre;
      evaluate(model, e, ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS, centre);
      const BodyElements exact = body_elements(d, pose, e, centre);
      std::vector<double> error(count, std::numeric_limits<double>::infinity());
      for (const double h : steps) {
        BodyElements at[4];
        LawResults results[4];
        constexpr double offsets[4] = {-2, -1, 1, 2}, weights[4] = {1. / 12, -8. / 12, 8. / 12, -1. / 12};
        for (int k = 0; k < 4; ++k) {
          std::vector<double> way(n);
          for (std::size_t a = 0; a < n; ++a) way[a] = offsets[k] * h * v[a];
          ents_pose moved = pose;
          ASSERT_EQ(ents_pose_move(d, &way[dd], &way[2 * dd], &moved, nullptr), ENTS_OK);
          LawElements there = e;
          std::vector<double> slave = x;
          for (std::size_t i = 0; i < slave.size(); ++i) slave[i] += way[i % dd];
          ASSERT_EQ(ents_pose_to_body(d, &moved, e.at.count, slave.data(), there.at.slave.data(), nullptr),
                    ENTS_OK);
          evaluate(model, there, ENTS_RESIDUAL | ENTS_FLAGS, results[k]);
          at[k] = body_elements(d, moved, there, results[k]);
        }
        for (std::size_t i = 0; i < count; ++i) {
          bool same = centre.status[i] == ENTS_OK;
          for (const LawResults& r : results)
            same = same && r.status[i] == ENTS_OK && (r.flags[i] & branch) == (centre.flags[i] & branch);
          if (!same || !(centre.flags[i] & ENTS_FLAG_CONTACT)) continue;
          double miss = 0, size = 0;
          for (std::size_t a = 0; a < n; ++a) {
            double rate = 0, own = 0;
            for (int k = 0; k < 4; ++k) rate += weights[k] / h * at[k].residual[i * n + a];
            for (std::size_t b = 0; b < n; ++b) {
              own += exact.tangent[(i * n + b) * n + a] * v[b];
              size = std::max(size, std::fabs(exact.tangent[(i * n + b) * n + a]));
            }
            miss = std::max(miss, std::fabs(rate - own));
          }
          error[i] = std::min(error[i], miss / size);
        }
      }
      for (std::size_t i = 0; i < count; ++i) {
        if (error[i] == std::numeric_limits<double>::infinity()) continue;
        ++checked, closed += (centre.flags[i] & ENTS_FLAG_CONTACT) != 0;
        worst.see(error[i], [&] { return basis.name + " element " + std::to_string(i); });
      }
    }
  EXPECT_GT(checked, mechanics::samples(2000));
  EXPECT_EQ(checked, closed);
  EXPECT_LE(worst.error, tolerance) << worst.where;
}

// The skew part of the tangent without friction is that of the spin block alone, -[m]x / 2.
TEST(RigidBodyTangent, IsSymmetricButForTheSpinsOfItsMoment) {
  Random random(6);
  const Method method{"", {{"type", "penalty"}, {"stiffness", 100.0}}, nullptr};
  for (const char* name : {"quad4", "bspline16", "tri6"}) {
    const Basis& basis = mechanics::basis_named(name);
    const mechanics::Scene scene = draw_scene(random, basis, "sine", "normal");
    const mechanics::Model model = model_of(scene, method, "rigid");
    const LawElements e = draw(random, scene, model, mechanics::samples(200), 0.05);
    LawResults r;
    evaluate(model, e, ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS, r);
    const BodyElements body = body_elements(3, draw_pose(random, 3), e, r);
    for (std::size_t i = 0; i < static_cast<std::size_t>(e.at.count); ++i) {
      const double *t = &body.tangent[i * 81], *m = &body.residual[i * 9 + 6];
      const double skew[3][3] = {{0, m[2], -m[1]}, {-m[2], 0, m[0]}, {m[1], -m[0], 0}}; // -[m]x
      double size = 1;
      for (int k = 0; k < 81; ++k) size = std::max(size, std::fabs(t[k]));
      for (int a = 0; a < 9; ++a)
        for (int b = 0; b < 9; ++b)
          EXPECT_NEAR(t[9 * b + a] - t[9 * a + b], a >= 6 && b >= 6 ? skew[a - 6][b - 6] : 0.0, 1e-12 * size);
    }
  }
}

// Turns about one axis add up; nothing drifts in a hundred turns.
TEST(Pose, ManyTurnsEndInTheSamePlace) {
  for (const int d : {2, 3})
    for (const int steps : {8, 64, 512}) {
      ents_pose pose = pose_of(d);
      const double angle = 2 * 3.14159265358979323846 / steps;
      std::vector<double> spin{angle};
      if (d == 3) spin = {2 * angle / 3, -angle / 3, 2 * angle / 3};
      for (int k = 0; k < 100 * steps; ++k)
        ASSERT_EQ(ents_pose_move(d, nullptr, spin.data(), &pose, nullptr), ENTS_OK);
      for (int i = 0; i < d; ++i)
        for (int j = 0; j < d; ++j) {
          EXPECT_NEAR(pose.turn[d * i + j], i == j, 1e-11) << d << " " << steps;
          double product = 0;
          for (int k = 0; k < d; ++k) product += pose.turn[d * i + k] * pose.turn[d * j + k];
          EXPECT_NEAR(product, i == j, 1e-15);
        }
      // one turn
      pose = pose_of(d);
      for (int k = 0; k < steps; ++k)
        ASSERT_EQ(ents_pose_move(d, nullptr, spin.data(), &pose, nullptr), ENTS_OK);
      for (int i = 0; i < d * d; ++i) EXPECT_NEAR(pose.turn[i], i % (d + 1) == 0, 1e-12) << d << " " << steps;
    }
}

// Slave points over nodes, some dofs prescribed: what ents_assemble adds is the sum of the elements.
TEST(RigidBodyAssembly, IsTheSumOfTheElements) {
  Random random(7);
  const Method method{"",
                      {{"type", "penalty"}, {"stiffness", 100.0}},
                      {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 80.0}}};
  for (const char* name : {"line2", "quad4"}) {
    const Basis& basis = mechanics::basis_named(name);
    const int d = basis.dimension;
    const auto dd = static_cast<std::size_t>(d), n = static_cast<std::size_t>(d + body_dofs(d));
    const mechanics::Scene scene = draw_scene(random, basis, "sine", "normal");
    const mechanics::Model model = model_of(scene, method, "rigid");
    constexpr std::int64_t count = 30;
    const LawElements e = draw(random, scene, model, count, 0.05);
    const ents_pose pose = draw_pose(random, d);
    // every element has a segment of its own
    std::vector<std::int64_t> connectivity, segment, begin{0}, of, equations, body;
    std::vector<double> weights;
    for (std::int64_t i = 0; i < count; ++i) {
      segment.push_back(i % 7 == 6 ? -1 : i);
      for (int a = 0; a < basis.node_count(); ++a) connectivity.push_back(i * basis.node_count() + a);
      const double w = random.uniform(0.2, 0.8);
      of.insert(of.end(), {i, (i + 1) % count}), weights.insert(weights.end(), {w, 1 - w});
      begin.push_back(2 * (i + 1));
    }
    std::int64_t rows = 0;
    for (std::int64_t i = 0; i < count * d; ++i) equations.push_back(i % 5 == 2 ? -1 : rows++);
    for (int i = 0; i < body_dofs(d); ++i) body.push_back(i == 1 ? -1 : rows++);
    const auto size = static_cast<std::size_t>(rows);
    std::vector<std::int64_t> row_begin{0}, columns;
    for (std::int64_t i = 0; i < rows; ++i) {
      for (std::int64_t j = 0; j < rows; ++j) columns.push_back(j);
      row_begin.push_back(static_cast<std::int64_t>(columns.size()));
    }
    std::vector<double> residual(size), values(size * size);
    ents_master_mesh mesh{};
    mesh.struct_size = sizeof mesh, mesh.segments = count, mesh.connectivity = connectivity.data();
    mesh.nodes = count * basis.node_count(), mesh.positions = e.at.master.data();
    if (!e.at.surface_coordinates.empty()) mesh.surface_coordinates = e.at.surface_coordinates.data();
    ents_input in = input_of(e, e.at.start);
    in.master = nullptr, in.surface_coordinates = nullptr;
    in.mesh = &mesh, in.segment = segment.data(), in.segment_stride = 1;
    ents_combination points{};
    points.struct_size = sizeof points, points.points = count;
    points.begin = begin.data(), points.nodes = of.data(), points.weights = weights.data();
    ents_system system{};
    system.struct_size = sizeof system, system.index_size = 8;
    system.slave = &points, system.slave_nodes = count, system.slave_equations = equations.data();
    system.rows = rows, system.residual = residual.data(), system.values = values.data();
    system.row_begin = row_begin.data(), system.columns = columns.data();
    system.pose = &pose, system.body_equations = body.data();
    ents_report report{};
    report.struct_size = sizeof report;
    ASSERT_GE(ents_assemble(model.handle(), 0, count, &in, nullptr, &system, &report), 0) << report.message;

    LawResults r;
    evaluate(model.handle(), e, ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS, r);
    const BodyElements elements = body_elements(d, pose, e, r);
    std::vector<double> expected(size), matrix(size * size);
    int contact = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (segment[i] < 0 || r.status[i] != ENTS_OK || !(r.flags[i] & ENTS_FLAG_CONTACT)) continue;
      ++contact;
      struct Term {
        std::int64_t row;
        std::size_t dof;
        double weight;
      };
      std::vector<Term> terms;
      for (std::size_t k = 2 * i; k < 2 * i + 2; ++k)
        for (std::size_t a = 0; a < dd; ++a)
          terms.push_back({equations[static_cast<std::size_t>(of[k]) * dd + a], a, weights[k]});
      for (std::size_t a = 0; a + dd < n; ++a) terms.push_back({body[a], dd + a, 1.0});
      for (const Term& row : terms) {
        if (row.row < 0) continue;
        expected[static_cast<std::size_t>(row.row)] += row.weight * elements.residual[i * n + row.dof];
        for (const Term& column : terms)
          if (column.row >= 0)
            matrix[static_cast<std::size_t>(row.row * rows + column.row)] +=
                row.weight * column.weight * elements.tangent[(i * n + column.dof) * n + row.dof];
      }
    }
    EXPECT_GT(contact, 10);
    for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(residual[i], expected[i], 1e-11) << name;
    for (std::size_t i = 0; i < size * size; ++i) EXPECT_NEAR(values[i], matrix[i], 1e-10) << name;
  }
}

TEST(Pose, MistakesAreNamed) {
  ents_report report{};
  report.struct_size = sizeof report;
  ents_pose pose{};
  EXPECT_EQ(ents_pose_init(3, &pose, &report), ENTS_STRUCT_SIZE);
  pose.struct_size = sizeof pose;
  EXPECT_EQ(ents_pose_init(4, &pose, &report), ENTS_BAD_VALUE);
  const double spin[3] = {0, 0, 1};
  EXPECT_EQ(ents_pose_move(3, nullptr, spin, &pose, &report), ENTS_BAD_STATE) << "zeros are no rotation";
  EXPECT_NE(std::strstr(report.message, "ents_pose_init"), nullptr) << report.message;
  ASSERT_EQ(ents_pose_init(3, &pose, &report), ENTS_OK);
  const double bad[3] = {0, std::numeric_limits<double>::quiet_NaN(), 0};
  EXPECT_EQ(ents_pose_move(3, bad, nullptr, &pose, &report), ENTS_NON_FINITE);
  EXPECT_NE(std::strstr(report.message, "translation[1]"), nullptr) << report.message;
  double out[3];
  EXPECT_EQ(ents_pose_to_body(3, &pose, 1, nullptr, out, &report), ENTS_NULL_ARGUMENT);
  EXPECT_EQ(ents_pose_element(3, &pose, spin, spin, nullptr, out, out, &report), ENTS_NULL_ARGUMENT);
}

INSTANTIATE_TEST_SUITE_P(Method, RigidBody, testing::ValuesIn(tried()),
                         [](const auto& parameter) { return parameter.param.name; });

} // namespace
} // namespace laws::rigid_body_test
