// Contact on a smoothed surface, put on the host's own nodes: residual and tangent against differences of the
// energy with respect to these nodes, and balance of forces and moments.
#include <gtest/gtest.h>

#include <iostream>

#include "smoothed_surface.hpp"
#include "worst.hpp"

namespace mechanics::smoothed_assembly_test {
namespace {

struct SmoothedCase {
  const char* name;
  const char* basis;
  HostMesh mesh;
  std::int32_t ends;
  MirrorPlanes planes = {};
};

const std::vector<SmoothedCase>& smoothed_cases() {
  static const std::vector<SmoothedCase> all = {
      {"open_chain", "catmull_rom4", chain(6, false), ENTS_ENDS_STRAIGHT},
      {"closed_chain", "bspline4", chain(8, true), ENTS_ENDS_STRAIGHT},
      {"squares", "catmull_rom16", squares(3), ENTS_ENDS_STRAIGHT},
      {"squares_repeated", "bspline16", squares(3), ENTS_ENDS_REPEATED},
      {"star_of_five", "bspline16", star(5, 2), ENTS_ENDS_STRAIGHT},
      {"triangles", "bezier15", halved(squares(3)), ENTS_ENDS_STRAIGHT},
      {"triangles_of_seven", "bezier15", triangle_star(7, 2), ENTS_ENDS_STRAIGHT},
      {"star_of_three", "bspline16", star(3, 2), ENTS_ENDS_STRAIGHT},
      {"concave_border", "bspline16", squares(3, [](int i, int j) { return i < 2 || j < 2; }),
       ENTS_ENDS_STRAIGHT},
      {"quasi_chain", "bspline4", chain(6, false), ENTS_ENDS_QUASI_CUBIC},
      {"quasi_squares", "bspline16", squares(2), ENTS_ENDS_QUASI_PARABOLIC},
      {"mirrored_chain", "bspline4", chain(4, false), ENTS_ENDS_QUASI_CUBIC, {{0}, {0.0}}},
      {"mirrored_squares", "bspline16", squares(3), ENTS_ENDS_STRAIGHT, {{0, 1}, {0.0, 3.0}}}};
  return all;
}

class SmoothedAssembly : public testing::TestWithParam<int> {
protected:
  static HostMesh shaken(const SmoothedCase& smoothed) {
    HostMesh mesh = smoothed.mesh;
    Random random(13);
    mesh.shake(random, 0.03);
    const auto d = static_cast<std::size_t>(mesh.dimension());
    for (std::size_t p = 0; p < smoothed.planes.axes.size(); ++p) // nodes on a plane stay there
      for (std::size_t i = static_cast<std::size_t>(smoothed.planes.axes[p]); i < mesh.positions.size();
           i += d)
        if (smoothed.mesh.positions[i] == smoothed.planes.places[p])
          mesh.positions[i] = smoothed.planes.places[p];
    return mesh;
  }
  static std::string text() {
    const bool line = smoothed_cases()[static_cast<std::size_t>(GetParam())].mesh.dimension() == 2;
    nlohmann::json wave = line ? nlohmann::json{0.6} : nlohmann::json{0.5, 0.4};
    return nlohmann::json{
        {"segment", smoothed_cases()[static_cast<std::size_t>(GetParam())].basis},
        {"height", {{"type", "sine"}, {"amplitude", 0.02}, {"wave_vector", wave}, {"phase", 0.4}}},
        {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 5.0}}}}}}
        .dump();
  }

  SmoothedAssembly()
      : case_(smoothed_cases()[static_cast<std::size_t>(GetParam())]), mesh_(shaken(case_)),
        smoothed_(case_.basis, mesh_, case_.ends, case_.planes), model_(text()),
        d_(static_cast<std::size_t>(mesh_.dimension())) {
    smoothed_.carry_texture();
    // One slave node in every segment, 0.02 behind it: the host's first nodes; then those of the mesh.
    Random random(14);
    for (std::int64_t f = 0; f < mesh_.facets(); ++f) {
      std::vector<double> xi;
      for (std::size_t k = 0; k + 1 < d_; ++k)
        xi.push_back(mesh_.corners() == 3 ? random.uniform(0.15, 0.4) : random.uniform(-0.7, 0.7));
      const SurfacePoints at = smoothed_.evaluate(model_, f, xi);
      for (std::size_t k = 0; k < d_; ++k) unknowns_.push_back(at.point[k] - 0.02 * at.normal[k]);
      segment_.push_back(f);
      start_.insert(start_.end(), xi.begin(), xi.end());
    }
    slaves_ = unknowns_.size();
    unknowns_.insert(unknowns_.end(), mesh_.positions.begin(), mesh_.positions.end());
  }

  void move_to(const std::vector<double>& unknowns) {
    smoothed_.follow({unknowns.begin() + static_cast<std::ptrdiff_t>(slaves_), unknowns.end()});
  }
  ents_input input(const std::vector<double>& unknowns, const ents_master_mesh& mesh) const {
    ents_input in{};
    in.struct_size = sizeof in;
    in.slave = unknowns.data(), in.slave_stride = model_.dimension();
    in.mesh = &mesh, in.segment = segment_.data(), in.segment_stride = 1;
    in.start = start_.data(), in.start_stride = model_.parameters();
    return in;
  }
  double energy(const std::vector<double>& unknowns) {
    move_to(unknowns);
    const ents_master_mesh mesh = smoothed_.surface.mesh();
    const ents_input in = input(unknowns, mesh);
    std::vector<double> energies(segment_.size());
    ents_output out{};
    out.struct_size = sizeof out;
    out.wanted = ENTS_ENERGY;
    out.energy = energies.data(), out.energy_stride = 1;
    check(ents_evaluate(model_.handle(), 0, mesh_.facets(), &in, &out, &report_));
    double sum = 0.0;
    for (const double e : energies) sum += e;
    return sum;
  }
  // Residual and, row by row, the tangent.
  void assemble(const std::vector<double>& unknowns, std::vector<double>& residual,
                std::vector<double>& tangent) {
    move_to(unknowns);
    const std::size_t n = unknowns.size();
    residual.assign(n, 0.0), tangent.assign(n * n, 0.0);
    std::vector<std::int64_t> equations, row_begin, columns;
    for (std::size_t i = 0; i < n; ++i) {
      equations.push_back(static_cast<std::int64_t>(i)),
          row_begin.push_back(static_cast<std::int64_t>(i * n));
      for (std::size_t j = 0; j < n; ++j) columns.push_back(static_cast<std::int64_t>(j));
    }
    row_begin.push_back(static_cast<std::int64_t>(n * n));
    const ents_master_mesh mesh = smoothed_.surface.mesh();
    const ents_input in = input(unknowns, mesh);
    const ents_combination control = smoothed_.combination();
    ents_system system{};
    system.struct_size = sizeof system;
    system.index_size = 8;
    system.master = &control;
    system.slave_nodes = static_cast<std::int64_t>(slaves_ / d_), system.slave_equations = equations.data();
    system.master_nodes = mesh_.nodes(), system.master_equations = equations.data() + slaves_;
    system.rows = static_cast<std::int64_t>(n), system.residual = residual.data();
    system.row_begin = row_begin.data(), system.columns = columns.data(), system.values = tangent.data();
    check(ents_assemble(model_.handle(), 0, mesh_.facets(), &in, nullptr, &system, &report_));
  }
  void check(std::int32_t status) const {
    if (status != ENTS_OK) throw std::runtime_error(report_.message);
  }

  const SmoothedCase& case_;
  const HostMesh mesh_;
  SmoothedSurface smoothed_;
  Model model_;
  std::size_t d_, slaves_ = 0;
  std::vector<double> unknowns_, start_;
  std::vector<std::int64_t> segment_;
  ents_report report_ = [] {
    ents_report report{};
    report.struct_size = sizeof report;
    return report;
  }();
};

TEST_P(SmoothedAssembly, IsTheDerivativeOfTheEnergy) {
  const std::size_t n = unknowns_.size();
  std::vector<double> residual, tangent, ignored;
  assemble(unknowns_, residual, tangent);
  double force = 0.0, stiffness = 0.0;
  for (const double r : residual) test::raise(force, std::fabs(r));
  for (const double k : tangent) test::raise(stiffness, std::fabs(k));
  ASSERT_GT(force, 0.01);
  // Fourth order: t^4 / 30 of a fifth derivative of about 10^3 times the first (lengths of 0.2) is 4e-9; the
  // rounding of the energy, 1e-16 / t of it, and of the residual are smaller.
  constexpr double t = 1e-4, tolerance = 1e-7;
  Random random(15);
  double worst_residual = 0.0, worst_tangent = 0.0;
  for (int sample = 0; sample < 20; ++sample) {
    std::vector<double> v(n), slope(n, 0.0);
    for (double& x : v) x = random.uniform(-1.0, 1.0);
    double energy_slope = 0.0;
    for (const auto& [offset, weight] : {std::pair{-2.0, 1.0}, {-1.0, -8.0}, {1.0, 8.0}, {2.0, -1.0}}) {
      std::vector<double> u = unknowns_, r;
      for (std::size_t i = 0; i < n; ++i) u[i] += offset * t * v[i];
      energy_slope += weight / (12.0 * t) * energy(u);
      assemble(u, r, ignored);
      for (std::size_t i = 0; i < n; ++i) slope[i] += weight / (12.0 * t) * r[i];
    }
    double work = 0.0;
    for (std::size_t i = 0; i < n; ++i) work += residual[i] * v[i];
    test::raise(worst_residual, std::fabs(work - energy_slope) / force);
    for (std::size_t i = 0; i < n; ++i) {
      double expected = 0.0;
      for (std::size_t j = 0; j < n; ++j) expected += tangent[i * n + j] * v[j];
      test::raise(worst_tangent, std::fabs(expected - slope[i]) / stiffness);
    }
  }
  EXPECT_LE(worst_residual, tolerance);
  EXPECT_LE(worst_tangent, tolerance);
  std::cout << case_.name << ": residual " << worst_residual << ", tangent " << worst_tangent << "\n";
}

TEST_P(SmoothedAssembly, BalancesForcesAndMoments) {
  std::vector<double> residual, tangent;
  assemble(unknowns_, residual, tangent);
  Vec3 force{}, moment{};
  double size = 0.0;
  for (std::size_t i = 0; i < unknowns_.size(); i += d_) {
    const Vec3 x = vec3(&unknowns_[i], static_cast<int>(d_)), r = vec3(&residual[i], static_cast<int>(d_));
    force = force + r, moment = moment + cross(x, r);
    size += norm(r);
  }
  ASSERT_GT(size, 0.01);
  for (const std::int32_t axis : case_.planes.axes) force[static_cast<std::size_t>(axis)] = 0.0;
  if (!case_.planes.axes.empty()) moment = {}; // planes take the forces across them, and moments
  // weights of up to 225 in control points, positions up to 6
  constexpr double rounding = 225.0 * 8.0 * 1.1e-16;
  EXPECT_LE(norm(force), rounding * size);
  EXPECT_LE(norm(moment), 6.0 * rounding * size);
}

std::string smoothed_case_name(const testing::TestParamInfo<int>& info) {
  return smoothed_cases()[static_cast<std::size_t>(info.param)].name;
}

INSTANTIATE_TEST_SUITE_P(Surfaces, SmoothedAssembly,
                         testing::Range(0, static_cast<int>(smoothed_cases().size())), smoothed_case_name);

} // namespace
} // namespace mechanics::smoothed_assembly_test
