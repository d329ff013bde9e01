// Meshes as a host has them (lines, regular and irregular quadrilaterals), and smoothed surfaces over them by
// the library.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>

#include "mesh_surface.hpp"

namespace mechanics {

struct HostMesh {
  std::string facet;
  std::vector<std::int64_t> connectivity;
  std::vector<double> positions;

  int dimension() const { return facet == "line2" ? 2 : 3; }
  int corners() const { return facet == "line2" ? 2 : (facet == "tri3" ? 3 : 4); }
  std::int64_t facets() const { return static_cast<std::int64_t>(connectivity.size()) / corners(); }
  std::int64_t nodes() const { return static_cast<std::int64_t>(positions.size()) / dimension(); }
  std::int64_t corner(std::int64_t facet_, int k) const {
    return connectivity[static_cast<std::size_t>(facet_ * corners() + k)];
  }
  Vec3 position(std::int64_t node) const {
    return vec3(&positions[static_cast<std::size_t>(node * dimension())], dimension());
  }
  void shake(Random& random, double by) {
    for (double& x : positions) x += random.uniform(-by, by);
  }
};

// Nodes by place (three integers), numbered as they come.
class Nodes {
public:
  explicit Nodes(HostMesh& mesh) : mesh_(mesh) {}
  std::int64_t at(int a, int b, int c, const Vec3& position) {
    const auto [it, is_new] = number_.try_emplace({a, b, c}, static_cast<std::int64_t>(number_.size()));
    if (is_new)
      mesh_.positions.insert(mesh_.positions.end(), position.begin(), position.begin() + mesh_.dimension());
    return it->second;
  }

private:
  HostMesh& mesh_;
  std::map<std::tuple<int, int, int>, std::int64_t> number_;
};

// Squares of size 1 where `has`, over 0 .. n per direction.
inline HostMesh squares(
    int n, const std::function<bool(int, int)>& has = [](int, int) { return true; }) {
  HostMesh mesh{"quad4", {}, {}};
  Nodes nodes(mesh);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      if (has(i, j))
        for (const auto& [a, b] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}})
          mesh.connectivity.push_back(nodes.at(i + a, j + b, 0, {1.0 * (i + a), 1.0 * (j + b), 0.0}));
  return mesh;
}

// Nodes of n sectors around one node; a sector's sides have length 1 and k facets. (s, a, b): sector, steps
// along its two sides.
class StarNodes {
public:
  StarNodes(HostMesh& mesh, int n, int k) : nodes_(mesh), n_(n), k_(k) {}
  std::int64_t operator()(int s, int a, int b) {
    const Vec3 x = (1.0 * a / k_) * ray(s) + (1.0 * b / k_) * ray(s + 1);
    if (a == 0 && b == 0) return nodes_.at(0, 0, 0, x);
    if (a == 0) return nodes_.at((s + 1) % n_, b, 0, x);
    return nodes_.at(s, a, b, x);
  }

private:
  Vec3 ray(int s) const {
    const double angle = 2.0 * 3.141592653589793 * s / n_;
    return {std::cos(angle), std::sin(angle), 0.0};
  }
  Nodes nodes_;
  int n_, k_;
};

// Each sector has k x k facets.
inline HostMesh star(int n, int k) {
  HostMesh mesh{"quad4", {}, {}};
  StarNodes node(mesh, n, k);
  for (int s = 0; s < n; ++s)
    for (int b = 0; b < k; ++b)
      for (int a = 0; a < k; ++a)
        for (const auto& [i, j] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}})
          mesh.connectivity.push_back(node(s, a + i, b + j));
  return mesh;
}

// Each sector is a triangle of k^2 facets.
inline HostMesh triangle_star(int n, int k) {
  HostMesh mesh{"tri3", {}, {}};
  StarNodes node(mesh, n, k);
  for (int s = 0; s < n; ++s)
    for (int b = 0; b < k; ++b)
      for (int a = 0; a + b < k; ++a) {
        mesh.connectivity.insert(mesh.connectivity.end(),
                                 {node(s, a, b), node(s, a + 1, b), node(s, a, b + 1)});
        if (a + b + 1 < k)
          mesh.connectivity.insert(mesh.connectivity.end(),
                                   {node(s, a + 1, b), node(s, a + 1, b + 1), node(s, a, b + 1)});
      }
  return mesh;
}

// Every quadrilateral as two triangles, cut between its first and third corner.
inline HostMesh halved(const HostMesh& quads) {
  HostMesh mesh{"tri3", {}, quads.positions};
  for (std::int64_t f = 0; f < quads.facets(); ++f)
    for (const int k : {0, 1, 2, 0, 2, 3}) mesh.connectivity.push_back(quads.corner(f, k));
  return mesh;
}

// The six sides of a cube, k x k facets each, blown up to a sphere of radius 1: eight nodes of three facets.
inline HostMesh sphere(int k) {
  HostMesh mesh{"quad4", {}, {}};
  Nodes nodes(mesh);
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1})
      for (int j = 0; j < k; ++j)
        for (int i = 0; i < k; ++i)
          for (const auto& [a, b] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            std::array<int, 3> place{};
            place[static_cast<std::size_t>((axis + 1) % 3)] = 2 * (i + (side > 0 ? a : b)) - k;
            place[static_cast<std::size_t>((axis + 2) % 3)] = 2 * (j + (side > 0 ? b : a)) - k;
            place[static_cast<std::size_t>(axis)] = side * k;
            const Vec3 x = {1.0 * place[0], 1.0 * place[1], 1.0 * place[2]};
            mesh.connectivity.push_back(nodes.at(place[0], place[1], place[2], (1.0 / norm(x)) * x));
          }
  return mesh;
}

// A chain of lines round a circle of radius 1, or along the first axis.
inline HostMesh chain(int facets, bool closed) {
  HostMesh mesh{"line2", {}, {}};
  for (int i = 0; i < facets + (closed ? 0 : 1); ++i) {
    const double angle = 2.0 * 3.141592653589793 * i / facets;
    if (closed)
      mesh.positions.insert(mesh.positions.end(), {std::cos(angle), std::sin(angle)});
    else
      mesh.positions.insert(mesh.positions.end(), {1.0 * i, 0.0});
  }
  for (int i = 0; i < facets; ++i)
    mesh.connectivity.insert(mesh.connectivity.end(), {i, closed ? (i + 1) % facets : i + 1});
  return mesh;
}

struct MirrorPlanes {
  std::vector<std::int32_t> axes;
  std::vector<double> places;
};

// A smoothed surface over a host's mesh.
class SmoothedSurface {
public:
  SmoothedSurface(const std::string& basis, const HostMesh& host, std::int32_t ends = ENTS_ENDS_STRAIGHT,
                  const MirrorPlanes& planes = {})
      : host_(&host) {
    if (!planes.axes.empty()) {
      smooth_mirrored(basis, host, ends, planes);
      return;
    }
    ents_report report{};
    report.struct_size = sizeof report;
    std::int64_t points = 0, terms = 0;
    const auto check = [&](std::int32_t status) {
      if (status != ENTS_OK) throw std::runtime_error(report.message);
    };
    check(ents_smooth_size(host.facet.c_str(), basis.c_str(), ends, host.facets(), host.connectivity.data(),
                           host.nodes(), &points, &terms, &report));
    surface.basis = &basis_named(basis);
    surface.connectivity.resize(static_cast<std::size_t>(host.facets() * surface.basis->node_count()));
    begin.resize(static_cast<std::size_t>(points + 1));
    nodes.resize(static_cast<std::size_t>(terms)), weights.resize(nodes.size());
    check(ents_smooth(host.facet.c_str(), basis.c_str(), ends, host.facets(), host.connectivity.data(),
                      host.nodes(), points, terms, surface.connectivity.data(), begin.data(), nodes.data(),
                      weights.data(), &report));
    follow(host.positions);
  }

  ents_combination combination() const {
    ents_combination c{};
    c.struct_size = sizeof c;
    c.points = static_cast<std::int64_t>(begin.size()) - 1;
    c.begin = begin.data(), c.nodes = nodes.data(), c.weights = weights.data();
    if (!shifts.empty()) c.reflected = reflected.data(), c.shifts = shifts.data();
    return c;
  }
  // `of_nodes` [nodes][numbers] at the control points.
  std::vector<double> at_points(const std::vector<double>& of_nodes, int numbers) const {
    const ents_combination c = combination();
    std::vector<double> out(static_cast<std::size_t>(c.points * numbers));
    ents_report report{};
    report.struct_size = sizeof report;
    if (ents_combine(&c, numbers, host_->nodes(), of_nodes.data(), out.data(), &report) != ENTS_OK)
      throw std::runtime_error(report.message);
    return out;
  }
  void follow(const std::vector<double>& positions) {
    surface.positions = at_points(positions, host_->dimension());
  }
  // Material coordinates: the first positions of the nodes without their last component.
  void carry_texture() {
    const auto d = static_cast<std::size_t>(host_->dimension());
    const std::vector<double> of_points = at_points(host_->positions, host_->dimension());
    surface.surface_coordinates.clear();
    for (const std::int64_t point : surface.connectivity)
      for (std::size_t k = 0; k + 1 < d; ++k)
        surface.surface_coordinates.push_back(of_points[static_cast<std::size_t>(point) * d + k]);
  }
  SurfacePoints evaluate(const Model& model, std::int64_t segment, const std::vector<double>& xi) const {
    return evaluate_surface(model, surface.master(segment).data(),
                            surface.surface_coordinates.empty() ? nullptr : surface.coordinates(segment), xi);
  }

  MeshSurface surface;
  std::vector<std::int64_t> begin, nodes;
  std::vector<double> weights;
  std::vector<std::int32_t> reflected; // with planes of symmetry
  std::vector<double> shifts;

private:
  void smooth_mirrored(const std::string& basis, const HostMesh& host, std::int32_t ends,
                       const MirrorPlanes& planes) {
    ents_report report{};
    report.struct_size = sizeof report;
    ents_mirror mirror{};
    mirror.struct_size = sizeof mirror;
    mirror.planes = static_cast<std::int32_t>(planes.axes.size());
    mirror.axes = planes.axes.data(), mirror.places = planes.places.data();
    mirror.positions = host.positions.data();
    std::int64_t points = 0, terms = 0;
    const auto check = [&](std::int32_t status) {
      if (status != ENTS_OK) throw std::runtime_error(report.message);
    };
    check(ents_smooth_mirrored_size(host.facet.c_str(), basis.c_str(), ends, host.facets(),
                                    host.connectivity.data(), host.nodes(), &mirror, &points, &terms,
                                    &report));
    surface.basis = &basis_named(basis);
    surface.connectivity.resize(static_cast<std::size_t>(host.facets() * surface.basis->node_count()));
    begin.resize(static_cast<std::size_t>(points + 1)), nodes.resize(static_cast<std::size_t>(terms));
    weights.resize(nodes.size()), reflected.resize(nodes.size());
    shifts.resize(static_cast<std::size_t>(points * host.dimension()));
    check(ents_smooth_mirrored(host.facet.c_str(), basis.c_str(), ends, host.facets(),
                               host.connectivity.data(), host.nodes(), &mirror, points, terms,
                               surface.connectivity.data(), begin.data(), nodes.data(), weights.data(),
                               reflected.data(), shifts.data(), &report));
    follow(host.positions);
  }

  const HostMesh* host_;
};

} // namespace mechanics
