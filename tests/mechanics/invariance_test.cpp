// What must not matter: where the scene lies, how it is turned, how the nodes are numbered, in which units it
// is written.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "differences.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace mechanics::invariance_test {
namespace {

constexpr std::int32_t element = ENTS_ENERGY | ENTS_PRESSURE | ENTS_RESIDUAL | ENTS_TANGENT;

using Matrix = std::array<Vec3, 3>; // rows

Vec3 turn(const Matrix& q, const Vec3& v) { return {dot(q[0], v), dot(q[1], v), dot(q[2], v)}; }

// Rotation about a random axis (in 2D about e_z) by a random angle: Rodrigues
Matrix draw_rotation(Random& random, int dimension) {
  Vec3 axis = {0.0, 0.0, 1.0};
  if (dimension == 3) {
    do axis = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    while (norm(axis) < 0.1 || norm(axis) > 1.0);
    axis = (1.0 / norm(axis)) * axis;
  }
  const double angle = random.uniform(-3.2, 3.2);
  Matrix q{};
  for (std::size_t j = 0; j < 3; ++j) {
    Vec3 e{};
    e[j] = 1.0;
    const Vec3 turned = std::cos(angle) * e + std::sin(angle) * cross(axis, e) +
                        (1.0 - std::cos(angle)) * dot(axis, e) * axis;
    for (std::size_t i = 0; i < 3; ++i) q[i][j] = turned[i];
  }
  return q;
}

// How results change when a scene is rewritten: dof vectors are multiplied by `dofs` (a matrix with one block
// per node), xi by `xi`, and scalars by powers of the units of length and force.
struct Change {
  Matrix rotation = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  std::vector<std::size_t> node; // new master node k is the old node[k]
  double xi_matrix[2][2] = {{1, 0}, {0, 1}}, xi_shift[2] = {0, 0};
  double gap_sign = 1.0, normal_sign = 1.0; // of the gap along the ray or normal; of n_e
  double length = 1.0, force = 1.0;         // new number of units per old one
};

class Invariance : public testing::TestWithParam<std::string> {
protected:
  // 1e-12 relative: rounding of positions (1e-16 times their distance from the origin, up to 10 here) through
  // condition numbers of the projection and its second variation up to 1e3.
  static constexpr double tolerance = 1e-12;

  const Basis& basis() const { return basis_; }

  // Calls f(scene, model, elements) for every height and projection, about 1000 elements in all per basis.
  template <class F> void for_every_scene(std::uint64_t seed, F&& f) {
    Random random(seed);
    for (const std::string& kind : height_kinds())
      for (const char* projection : projections) {
        const Scene scene = draw_scene(random, basis(), kind, projection);
        const Model model(scene.model().dump());
        f(random, scene, draw_elements(random, scene, model, samples(42), -0.15, -0.02));
      }
  }

  // Dof vector of the old element as it must read in the new one
  std::vector<double> change_dofs(const Change& change, const double* v) const {
    const int d = basis().dimension;
    std::vector<double> out;
    for (int k = 0; k <= basis().node_count(); ++k) {
      const int old = k == 0 || change.node.empty()
                          ? k
                          : 1 + static_cast<int>(change.node[static_cast<std::size_t>(k - 1)]);
      const Vec3 turned = turn(change.rotation, vec3(v + d * old, d));
      out.insert(out.end(), turned.begin(), turned.begin() + d);
    }
    return out;
  }

  std::vector<double> change_matrix(const Change& change, const double* matrix) const {
    const std::size_t n = static_cast<std::size_t>(basis().dofs());
    std::vector<double> half(n * n), out(n * n);
    for (std::size_t j = 0; j < n; ++j) {
      const std::vector<double> row = change_dofs(change, matrix + j * n);
      for (std::size_t i = 0; i < n; ++i) half[i * n + j] = row[i];
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::vector<double> row = change_dofs(change, &half[i * n]);
      std::copy(row.begin(), row.end(), out.begin() + static_cast<std::ptrdiff_t>(i * n));
    }
    return out;
  }

  void compare(const char* name, std::vector<double> expected, double factor, const double* got,
               double scale) {
    for (double& x : expected) x *= factor;
    if (scale == 0.0) scale = largest_entry(expected.data(), expected.size());
    double error = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i)
      test::raise(error, std::fabs(got[i] - expected[i]) / scale);
    worst_.see(error, [&] { return std::string(name) + ", " + place_; });
    ++compared_;
  }

  // Do the results b of the rewritten elements say the same as the results a?
  void compare(const Change& c, std::int32_t wanted, const Results& a, const Results& b,
               const Elements& elements) {
    const std::size_t n = static_cast<std::size_t>(basis().dofs()),
                      t = static_cast<std::size_t>(basis().parameters());
    const std::size_t d = t + 1;
    for (std::size_t e = 0; e < static_cast<std::size_t>(elements.count); ++e) {
      ASSERT_TRUE(a.ok(static_cast<std::int64_t>(e)) && b.ok(static_cast<std::int64_t>(e))) << place_;
      ++elements_;
      const double L = c.length, F = c.force;
      if (wanted & ENTS_XI) {
        std::vector<double> xi(t);
        for (std::size_t i = 0; i < t; ++i) {
          xi[i] = c.xi_shift[i];
          for (std::size_t j = 0; j < t; ++j) xi[i] += c.xi_matrix[i][j] * a.xi[e * t + j];
        }
        compare("xi", xi, 1.0, &b.xi[e * t], 1.0);
        compare("gap", {a.gap[e]}, c.gap_sign * L, &b.gap[e], L);
        compare("normal_gap", {a.normal_gap[e]}, c.normal_sign * L, &b.normal_gap[e], L);
        const Vec3 normal = turn(c.rotation, vec3(&a.normal[e * d], static_cast<int>(d)));
        compare("normal",
                std::vector<double>(normal.begin(), normal.begin() + static_cast<std::ptrdiff_t>(d)),
                c.normal_sign, &b.normal[e * d], 1.0);
        compare("gap_gradient", change_dofs(c, &a.gap_gradient[e * n]), c.gap_sign, &b.gap_gradient[e * n],
                0.0);
        compare("gap_hessian", change_matrix(c, &a.gap_hessian[e * n * n]), c.gap_sign / L,
                &b.gap_hessian[e * n * n], 0.0);
        std::vector<double> gradient(t * n), hessian(t * n * n);
        for (std::size_t j = 0; j < t; ++j) {
          const std::vector<double> v = change_dofs(c, &a.xi_gradient[(e * t + j) * n]);
          const std::vector<double> m = change_matrix(c, &a.xi_hessian[(e * t + j) * n * n]);
          for (std::size_t i = 0; i < t; ++i) {
            for (std::size_t k = 0; k < n; ++k) gradient[i * n + k] += c.xi_matrix[i][j] * v[k];
            for (std::size_t k = 0; k < n * n; ++k) hessian[i * n * n + k] += c.xi_matrix[i][j] * m[k];
          }
        }
        compare("xi_gradient", gradient, 1.0 / L, &b.xi_gradient[e * t * n], 0.0);
        compare("xi_hessian", hessian, 1.0 / (L * L), &b.xi_hessian[e * t * n * n], 0.0);
      }
      if (wanted & ENTS_ENERGY) {
        ASSERT_GT(a.energy[e], 0.0);
        compare("energy", {a.energy[e]}, F * L, &b.energy[e], 0.0);
        compare("pressure", {a.pressure[e]}, F / (L * L), &b.pressure[e], 0.0);
        compare("residual", change_dofs(c, &a.residual[e * n]), F, &b.residual[e * n], 0.0);
        compare("tangent", change_matrix(c, &a.tangent[e * n * n]), F / L, &b.tangent[e * n * n], 0.0);
      }
    }
  }

  void report() {
    EXPECT_LE(worst_.error, tolerance) << worst_.where;
    EXPECT_GE(elements_, samples(1000));
    std::cout << GetParam() << ": " << elements_ << " elements, worst relative change " << worst_.error
              << " (" << worst_.where.substr(0, 60) << ")\n";
  }

  Worst worst_;
  const Basis& basis_ = basis_named(GetParam());
  std::string place_;
  std::int64_t compared_ = 0, elements_ = 0;
};

TEST_P(Invariance, RigidTranslationAndRotation) {
  for_every_scene(31, [&](Random& random, const Scene& scene, const Elements& elements) {
    const int d = basis().dimension;
    Change change;
    change.rotation = draw_rotation(random, d);
    const Vec3 shift = {random.uniform(-8, 8), random.uniform(-8, 8), d == 3 ? random.uniform(-8, 8) : 0.0};
    Scene moved_scene = scene;
    moved_scene.ray = turn(change.rotation, scene.ray);
    if (scene.projection == "shadow_point") moved_scene.ray = moved_scene.ray + shift;
    Elements moved = elements;
    for (std::vector<double>* x : {&moved.slave, &moved.master})
      for (std::size_t i = 0; i < x->size(); i += static_cast<std::size_t>(d)) {
        const Vec3 y = turn(change.rotation, vec3(&(*x)[i], d)) + shift;
        std::copy(y.begin(), y.begin() + d, x->begin() + static_cast<std::ptrdiff_t>(i));
      }
    place_ = scene.model().dump();
    const Model here(scene.model().dump()), there(moved_scene.model().dump());
    compare(change, kinematics | element, here.evaluate(elements, kinematics | element),
            there.evaluate(moved, kinematics | element), elements);
  });
  report();
}

// The maps of the natural coordinates that take the segment to itself: 2 on a line, 8 on a quadrangle, 6 on a
// triangle.
std::vector<Change> symmetries(const Basis& basis) {
  std::vector<Change> all;
  const auto add = [&](double a, double b, double c, double d, double x, double y) {
    Change s;
    const double m[2][2] = {{a, b}, {c, d}};
    std::copy(&m[0][0], &m[0][0] + 4, &s.xi_matrix[0][0]);
    s.xi_shift[0] = x;
    s.xi_shift[1] = y;
    s.normal_sign = a * d - b * c;
    for (const auto& at : basis.nodes) // the old node that comes to lie where the new one is
      for (std::size_t j = 0; j < basis.nodes.size(); ++j) {
        const auto& old = basis.nodes[j];
        if (std::fabs(a * old[0] + b * old[1] + x - at[0]) + std::fabs(c * old[0] + d * old[1] + y - at[1]) <
            1e-9)
          s.node.push_back(j);
      }
    EXPECT_EQ(s.node.size(), basis.nodes.size());
    all.push_back(s);
  };
  if (basis.dimension == 2) {
    add(-1, 0, 0, 1, 0, 0);
  } else if (basis.simplex) {
    add(0, 1, 1, 0, 0, 0);
    add(-1, -1, 1, 0, 1, 0);
    add(0, 1, -1, -1, 0, 1);
    add(-1, -1, 0, 1, 1, 0);
    add(1, 0, -1, -1, 0, 1);
  } else {
    for (const double p : {1.0, -1.0})
      for (const double q : {1.0, -1.0}) {
        if (p + q < 2.0) add(p, 0, 0, q, 0, 0);
        add(0, p, q, 0, 0, 0);
      }
  }
  return all;
}

// Nodes numbered from another corner, or the other way round. The latter turns the normal: the same surface
// then has the height -h, and the gap along the normal changes its sign.
TEST_P(Invariance, NodeRenumbering) {
  for_every_scene(32, [&](Random& random, Scene scene, const Elements& elements) {
    // a texture that sticks to the nodes, not to the numbering
    Elements old = elements;
    if (!scene.with_coordinates) {
      scene.with_coordinates = true;
      const Model model(scene.model().dump());
      old = draw_elements(random, scene, model, elements.count, -0.15, -0.02);
    }
    const std::size_t d = static_cast<std::size_t>(basis().dimension), t = d - 1, m = basis().nodes.size();
    const Results reference = Model(scene.model().dump()).evaluate(old, kinematics | element);
    for (Change change : symmetries(basis())) {
      const bool turned = change.normal_sign < 0.0, along_normal = scene.projection == "normal";
      if (along_normal) change.gap_sign = change.normal_sign;
      Scene new_scene = scene;
      if (turned) new_scene.height = negative_height(scene.height);
      Elements renumbered = old;
      for (std::size_t e = 0; e < static_cast<std::size_t>(old.count); ++e) {
        for (std::size_t k = 0; k < m; ++k) {
          for (std::size_t c = 0; c < d; ++c)
            renumbered.master[(e * m + k) * d + c] = old.master[(e * m + change.node[k]) * d + c];
          for (std::size_t c = 0; c < t; ++c)
            renumbered.surface_coordinates[(e * m + k) * t + c] =
                old.surface_coordinates[(e * m + change.node[k]) * t + c];
        }
        for (std::size_t i = 0; i < t; ++i) {
          double& xi = renumbered.start[e * t + i] = change.xi_shift[i];
          for (std::size_t j = 0; j < t; ++j) xi += change.xi_matrix[i][j] * old.start[e * t + j];
        }
      }
      // seen from behind, the slave is not in contact
      const std::int32_t wanted = turned ? kinematics : kinematics | element;
      place_ = new_scene.model().dump();
      compare(change, wanted, reference, Model(new_scene.model().dump()).evaluate(renumbered, wanted), old);
    }
  });
  report();
}

// Metres and newtons, millimetres and newtons, inches and pounds, micrometres and meganewtons
TEST_P(Invariance, Units) {
  const double units[][2] = {{1e3, 1.0}, {1.0 / 0.0254, 1.0 / 4.4482216152605}, {1e6, 1e-6}};
  for_every_scene(33, [&](Random& random, const Scene& scene, const Elements& elements) {
    const Results reference = Model(scene.model().dump()).evaluate(elements, kinematics | element);
    for (const auto& unit : units) {
      Change change;
      change.length = unit[0];
      change.force = unit[1];
      const double L = unit[0];
      // surface coordinates are lengths in one scene, free of dimension in the next
      const double coordinate = scene.with_coordinates && random.coin() ? L : 1.0;
      Scene scaled_scene = scene;
      scaled_scene.height = rescale_height(scene.height, L, coordinate);
      scaled_scene.stiffness = scene.stiffness * unit[1] / (L * L * L);
      if (scene.projection == "shadow_point") scaled_scene.ray = L * scene.ray;
      Elements scaled = elements;
      for (double& x : scaled.slave) x *= L;
      for (double& x : scaled.master) x *= L;
      for (double& s : scaled.surface_coordinates) s *= coordinate;
      for (double& a : scaled.area) a *= L * L;
      place_ = scaled_scene.model().dump();
      compare(change, kinematics | element, reference,
              Model(scaled_scene.model().dump()).evaluate(scaled, kinematics | element), elements);
    }
  });
  report();
}

INSTANTIATE_TEST_SUITE_P(Basis, Invariance, testing::ValuesIn(all_basis_names()),
                         [](const auto& parameter) { return parameter.param; });

} // namespace
} // namespace mechanics::invariance_test
