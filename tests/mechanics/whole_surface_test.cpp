// A slave that slides over a whole surface: forces at the borders of segments, and textures that do not care
// for the mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "mesh_surface.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace mechanics::whole_surface_test {
namespace {

struct Contact {
  std::int64_t segment = -1;
  double gap = 0.0;
  std::vector<double> xi, normal, force; // force on the slave
};

// The contact of one slave: detected, then evaluated.
Contact contact_of(const Model& model, const MeshSurface& surface, Detector& detector,
                   const std::vector<double>& slave) {
  Detector::Found found;
  detector.detect(slave, 1.0, found);
  Contact out;
  out.segment = found.segment[0];
  if (out.segment < 0) return out;
  const ents_master_mesh mesh = surface.mesh();
  ents_input in{};
  in.struct_size = sizeof in;
  in.slave = slave.data(), in.mesh = &mesh, in.segment = &out.segment, in.start = found.xi.data();
  std::vector<double> residual(static_cast<std::size_t>(model.dofs()));
  out.normal.resize(slave.size());
  ents_output to{};
  to.struct_size = sizeof to;
  to.wanted = ENTS_GAP | ENTS_NORMAL | ENTS_RESIDUAL;
  to.gap = &out.gap, to.normal = out.normal.data(), to.residual = residual.data();
  ents_report report{};
  report.struct_size = sizeof report;
  if (ents_evaluate(model.handle(), 0, 1, &in, &to, &report) != ENTS_OK)
    throw std::runtime_error(report.message);
  for (std::size_t k = 0; k < slave.size(); ++k) out.force.push_back(-residual[k]);
  out.xi = found.xi;
  return out;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) test::raise(most, std::fabs(a[k] - b[k]));
  return most;
}

double length(const std::vector<double>& v) {
  double sum = 0.0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

// Ten segments over a curved profile (2D), or a strip of 10 x 3 of them over a curved surface (3D).
MeshSurface curved(const Basis& basis) {
  Random random(91);
  MeshSurface mesh = draw_mesh(random, basis, 13, 0.0);
  const std::size_t d = static_cast<std::size_t>(basis.dimension);
  for (std::size_t i = 0; i < mesh.positions.size(); i += d) {
    const double x = mesh.positions[i], y = d == 3 ? mesh.positions[i + 1] : 0.0;
    mesh.positions[i + d - 1] = 0.4 * std::sin(0.7 * x) + 0.2 * std::cos(0.5 * y);
  }
  return mesh;
}

struct Jumps {
  double force = 0.0;  // largest change of the force between neighbouring positions that lie on different
                       // segments, over |force|
  double inside = 0.0; // the same within a segment: what smooth change amounts to in one step
  double normal = 0.0; // largest change of n_e at a border
  int borders = 0;
};

// Slides with constant height of the slave under the curved profile over ten segments, in steps of 1e-9
// around the borders.
Jumps slide(const std::string& basis_name, bool textured) {
  const Basis& basis = basis_named(basis_name);
  const MeshSurface mesh = curved(basis);
  nlohmann::json text{{"segment", basis_name},
                      {"border", 0.2}, // over a convex border of flat segments the normals leave a wedge
                      {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 1.0}}}}}};
  if (textured) {
    const std::vector<double> wave =
        basis.dimension == 2 ? std::vector<double>{0.25} : std::vector<double>{0.25, 0.1};
    text["height"] = {{"type", "sine"}, {"amplitude", 0.02}, {"wave_vector", wave}, {"phase", 0.7}};
  }
  const Model model(text.dump());
  Detector detector(model, mesh);
  const auto at = [&](double x) { // 0.3 below the surface that the mesh approximates
    std::vector<double> slave = {x};
    const double y = 12.3;
    if (basis.dimension == 3) slave.push_back(y);
    slave.push_back(0.4 * std::sin(0.7 * x) + (basis.dimension == 3 ? 0.2 * std::cos(0.5 * y) : 0.0) - 0.3);
    return contact_of(model, mesh, detector, slave);
  };
  Jumps jumps;
  double x = 4.0;
  Contact before = at(x);
  const double coarse = 0.02 * static_cast<double>(std::min<std::int64_t>(long_divisor(), 20));
  for (; x < 24.0; x += coarse) {
    const Contact now = at(x + coarse);
    if (before.segment < 0 || now.segment < 0) throw std::runtime_error("no contact at " + std::to_string(x));
    if (now.segment == before.segment) {
      test::raise(jumps.inside, largest_difference(now.force, before.force) / length(now.force));
    } else { // where exactly?
      double low = x, high = x + coarse;
      Contact left = before, right = now;
      while (high - low > 1e-13) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) break;
        Contact there = at(middle);
        if (there.segment == left.segment)
          low = middle, left = there;
        else
          high = middle, right = there;
      }
      ++jumps.borders;
      test::raise(jumps.force, largest_difference(left.force, right.force) / length(right.force));
      test::raise(jumps.normal, largest_difference(left.normal, right.normal));
    }
    before = now;
  }
  return jumps;
}

// Over flat segments the force turns with the angle between them. The force of a smoothed surface does not
// know where its segments end; but a texture on a C1 surface leans with the curvature of what it lies on, n_e
// by h times the jump of the curvature: only a C2 surface carries one without a jump.
TEST(WholeSurface, JumpsOfTheForceAtBorders) {
  std::cout << "basis          texture  borders  jump of the force  of the normal  change per step within a "
               "segment\n";
  for (const bool textured : {false, true})
    for (const char* name : {"line2", "catmull_rom4", "bspline4", "quad4", "catmull_rom16", "bspline16"}) {
      const Jumps jumps = slide(name, textured);
      std::printf("%-14s %-8s %7d %18.1e %14.1e %12.1e\n", name, textured ? "sine" : "none", jumps.borders,
                  jumps.force, jumps.normal, jumps.inside);
      EXPECT_GE(jumps.borders, 10) << name;
      if (std::string(name).find("line2") == 0 || std::string(name).find("quad4") == 0) {
        EXPECT_GT(jumps.force, 0.1) << name; // the angle between neighbours
        continue;
      }
      const bool leans = textured && std::string(name).find("catmull") == 0;
      if (leans) {
        EXPECT_GT(jumps.normal, 1e-5) << name;
      }
      EXPECT_LE(jumps.normal, leans ? 0.02 * 0.2 : 1e-10)
          << name; // |h| times a jump of the curvature below 0.2
      EXPECT_LE(jumps.force, leans ? 0.02 * 0.2 : 1e-10) << name;
    }
}

// One flat square of 4 x 4 as 1, 4 and 16 irregular segments with the same texture in surface coordinates:
// the same contact.
TEST(WholeSurface, ATextureDoesNotCareForTheMesh) {
  const Basis& basis = basis_named("quad4");
  nlohmann::json text{
      {"segment", "quad4"},
      {"master", "rigid"},
      {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 1.0}}}}},
      {"height", {{"type", "sine"}, {"amplitude", 0.05}, {"wave_vector", {0.4, 0.3}}, {"phase", 0.2}}}};
  const Model model(text.dump());
  std::vector<MeshSurface> meshes;
  Random random(92);
  for (const int n : {1, 2, 4}) {
    MeshSurface mesh;
    mesh.basis = &basis;
    std::vector<double> coordinates;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const bool inner_x = i > 0 && i<n, inner_y = j> 0 && j < n;
        const double h = 4.0 / n, move = 0.25 * h;
        const double x = h * i + (inner_x ? random.uniform(-move, move) : 0.0),
                     y = h * j + (inner_y ? random.uniform(-move, move) : 0.0);
        mesh.positions.insert(mesh.positions.end(), {x, y, 0.0});
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (const auto& xi : basis.nodes) {
          const std::int64_t node = (j + (xi[1] > 0.0)) * (n + 1) + i + (xi[0] > 0.0);
          mesh.connectivity.push_back(node);
          for (std::size_t k = 0; k < 2; ++k)
            mesh.surface_coordinates.push_back(mesh.positions[static_cast<std::size_t>(3 * node) + k]);
        }
    meshes.push_back(mesh);
  }
  std::vector<Detector> detectors;
  for (const MeshSurface& mesh : meshes) detectors.emplace_back(model, mesh);
  double worst = 0.0;
  int compared = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::vector<double> slave = {random.uniform(0.2, 3.8), random.uniform(0.2, 3.8),
                                       random.uniform(-0.3, 0.1)};
    const Contact one = contact_of(model, meshes[0], detectors[0], slave);
    for (std::size_t k = 1; k < meshes.size(); ++k) {
      const Contact many = contact_of(model, meshes[k], detectors[k], slave);
      ASSERT_EQ(one.segment < 0, many.segment < 0);
      if (one.segment < 0) continue;
      ++compared;
      test::raise(worst, std::fabs(one.gap - many.gap));
      test::raise(worst, largest_difference(one.force, many.force));
    }
  }
  std::cout << compared
            << " contacts on 4 and 16 segments: gap and force differ from those on one by at most " << worst
            << "\n";
  EXPECT_GT(compared, 1500);
  EXPECT_LE(worst, 1e-10);
}

} // namespace
} // namespace mechanics::whole_surface_test
