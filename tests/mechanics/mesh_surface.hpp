// A master surface of several segments of any basis, drawn at random, with one texture in surface
// coordinates.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "library.hpp"
#include "random.hpp"
#include "surface.hpp"

namespace mechanics {

struct MeshSurface {
  const Basis* basis = nullptr;
  std::vector<std::int64_t> connectivity;  // [segments][m]
  std::vector<double> positions;           // [nodes][d]
  std::vector<double> surface_coordinates; // [segments][m][d-1]

  std::int64_t segments() const {
    return static_cast<std::int64_t>(connectivity.size()) / basis->node_count();
  }
  std::int64_t nodes() const { return static_cast<std::int64_t>(positions.size()) / basis->dimension; }

  ents_master_mesh mesh() const {
    ents_master_mesh m{};
    m.struct_size = sizeof m;
    m.segments = segments();
    m.connectivity = connectivity.data();
    m.nodes = nodes();
    m.positions = positions.data();
    if (!surface_coordinates.empty()) m.surface_coordinates = surface_coordinates.data();
    return m;
  }

  std::vector<double> master(std::int64_t segment) const { // [m][d]
    std::vector<double> out;
    const int m = basis->node_count(), d = basis->dimension;
    for (int i = 0; i < m; ++i)
      for (int k = 0; k < d; ++k)
        out.push_back(positions[static_cast<std::size_t>(
            connectivity[static_cast<std::size_t>(segment * m + i)] * d + k)]);
    return out;
  }
  const double* coordinates(std::int64_t segment) const {
    return surface_coordinates.data() + segment * basis->node_count() * basis->parameters();
  }
};

// A strip (2D) or square (3D) of `n` segments per direction, each of size 2 (a triangle: half of that
// square), its nodes moved by up to `distortion`. Surface coordinates are the undistorted positions.
inline MeshSurface draw_mesh(Random& random, const Basis& basis, int n, double distortion) {
  MeshSurface out;
  out.basis = &basis;
  const bool line = basis.dimension == 2;
  std::map<std::pair<int, int>, std::int64_t> number;
  const auto node = [&](int a, int b) { // in halves of a segment
    const auto [it, is_new] = number.try_emplace({a, b}, static_cast<std::int64_t>(number.size()));
    if (is_new) {
      const double move = distortion;
      out.positions.push_back(a + random.uniform(-move, move));
      if (!line) out.positions.push_back(b + random.uniform(-move, move));
      out.positions.push_back(random.uniform(-move, move));
      if (line) out.positions.back() = -out.positions.back();
    }
    return it->second;
  };
  const auto add = [&](int a, int b, double sign) {
    for (const auto& xi : basis.nodes) {
      const double scale = basis.simplex ? 2.0 * sign : 1.0;
      const int i = a + static_cast<int>(scale * xi[0]), j = line ? 0 : b + static_cast<int>(scale * xi[1]);
      out.connectivity.push_back(node(i, j));
      out.surface_coordinates.push_back(i);
      if (!line) out.surface_coordinates.push_back(j);
    }
  };
  for (int j = 0; j < (line ? 1 : n); ++j)
    for (int i = 0; i < n; ++i)
      if (basis.simplex) {
        add(2 * i, 2 * j, 1.0);
        add(2 * i + 2, 2 * j + 2, -1.0);
      } else {
        add(2 * i + 1, 2 * j + 1, 1.0);
      }
  return out;
}

// The tree of a surface, and what is detected with it.
class Detector {
public:
  Detector(const Model& model, const MeshSurface& surface) : model_(model), surface_(surface) {
    std::int64_t size = 0;
    check(ents_tree_size(model.handle(), surface.segments(), &size, &report_));
    tree_.resize(static_cast<std::size_t>(size));
    const ents_master_mesh mesh = surface.mesh();
    check(ents_tree_build(model.handle(), &mesh, tree_.data(), size, &report_));
  }
  void refit() {
    const ents_master_mesh mesh = surface_.mesh();
    check(ents_tree_refit(model_.handle(), &mesh, tree_.data(), size(), &report_));
  }
  struct Found {
    std::vector<std::int64_t> segment, other;
    std::vector<double> xi, gap;
    std::vector<std::int32_t> flags;
  };
  // slave [count][d]; `found` holds the projections of before (or is empty); normals [count][d] or none, own segments
  // and depths [count] or none
  void detect(const std::vector<double>& slave, double reach, Found& found,
              const std::vector<double>& normals = {}, const std::vector<std::int64_t>& own = {},
              const std::vector<double>& depth = {}) {
    const std::size_t count = slave.size() / static_cast<std::size_t>(model_.dimension());
    found.segment.resize(count, -1);
    found.xi.resize(count * static_cast<std::size_t>(model_.parameters()));
    found.other.resize(count), found.gap.resize(count), found.flags.resize(count);
    ents_detection io{};
    io.struct_size = sizeof io;
    io.slave = slave.data(), io.reach = reach;
    if (!normals.empty()) io.slave_normal = normals.data();
    if (!own.empty()) io.slave_segment = own.data();
    if (!depth.empty()) io.depth = depth.data();
    io.segment = found.segment.data(), io.xi = found.xi.data(), io.gap = found.gap.data();
    io.flags = found.flags.data(), io.other = found.other.data();
    io.permitted = ENTS_FLAG_LEFT | ENTS_FLAG_BEHIND_EDGE; // the tests look at the flags
    const ents_master_mesh mesh = surface_.mesh();
    check(ents_detect(model_.handle(), &mesh, tree_.data(), size(), 0, static_cast<std::int64_t>(count), &io,
                      &report_));
  }

  // Of the body below slaves on their own segments.
  void thickness(const std::vector<double>& slave, double reach, const std::vector<double>& normals,
                 const std::vector<std::int64_t>& own, std::vector<double>& out) {
    std::vector<std::int64_t> segment(own.size(), -1);
    std::vector<double> xi(own.size() * static_cast<std::size_t>(model_.parameters()));
    ents_detection io{};
    io.struct_size = sizeof io;
    io.slave = slave.data(), io.reach = reach, io.slave_normal = normals.data(),
    io.slave_segment = own.data();
    io.segment = segment.data(), io.xi = xi.data();
    const ents_master_mesh mesh = surface_.mesh();
    check(ents_thickness(model_.handle(), &mesh, tree_.data(), size(), 0,
                         static_cast<std::int64_t>(own.size()), &io, out.data(), &report_));
  }

  std::int64_t size() const { return static_cast<std::int64_t>(tree_.size()); } // doubles

private:
  void check(std::int32_t status) const {
    if (status != ENTS_OK) throw std::runtime_error(report_.message);
  }
  const Model& model_;
  const MeshSurface& surface_;
  std::vector<double> tree_;
  ents_report report_ = [] {
    ents_report report{};
    report.struct_size = sizeof report;
    return report;
  }();
};

} // namespace mechanics
