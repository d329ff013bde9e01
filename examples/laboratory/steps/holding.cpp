// SPDX-License-Identifier: BSD-3-Clause
#include "holding.hpp"

#include <cmath>
#include <map>
#include <numeric>

#include "spectrum.hpp"

namespace host {
namespace {

/// Nodes that elements or periodic sides join belong to one body.
class Bodies {
public:
  Bodies(const Mesh& mesh, const DofMap& dofs) : first_(static_cast<std::size_t>(mesh.node_count())) {
    std::iota(first_.begin(), first_.end(), 0);
    for (const ElementGroup& group : mesh.groups)
      for (std::size_t e = 0; e < group.size(); ++e)
        for (const int node : group.element(e)) join(group.element(e)[0], node);
    for (int node = 0; node < mesh.node_count(); ++node) join(node, dofs.representative(node));
  }
  int of(int node) {
    while (at(node) != node) node = at(node) = at(at(node));
    return node;
  }

private:
  int& at(int node) { return first_[static_cast<std::size_t>(node)]; }
  void join(int a, int b) {
    a = of(a), b = of(b);
    at(std::max(a, b)) = std::min(a, b);
  }
  std::vector<int> first_;
};

/// Rigid motions of a point: translations, then rotations; components of the motions at the point as columns.
using Motions = Eigen::Matrix<double, 3, Eigen::Dynamic>;

Motions motions(const Eigen::Vector3d& from_centre, int dimension, bool axisymmetric) {
  const double x = from_centre[0], y = from_centre[1], z = from_centre[2];
  Motions all(3, dimension == 3 ? 6 : 3);
  if (dimension == 3)
    all << 1, 0, 0, 0, z, -y, 0, 1, 0, -z, 0, x, 0, 0, 1, y, -x, 0;
  else
    all << 1, 0, -y, 0, 1, x, 0, 0, 0;
  if (axisymmetric) return all.col(1);
  return all;
}

/// "along x", "round z", of the motion with the largest share.
std::string name_of(const Eigen::VectorXd& motion, int dimension, bool axisymmetric) {
  static constexpr std::array<const char*, 6> space{"along x", "along y", "along z",
                                                    "round x", "round y", "round z"};
  static constexpr std::array<const char*, 3> plane{"along x", "along y", "round z"};
  Eigen::Index largest = 0;
  motion.cwiseAbs().maxCoeff(&largest);
  if (axisymmetric) return plane[1];
  return dimension == 3 ? space[static_cast<std::size_t>(largest)] : plane[static_cast<std::size_t>(largest)];
}

} // namespace

std::string what_can_move(const Mesh& mesh, const DofMap& dofs, const std::vector<double>& springs,
                          const Scene& scene) {
  const int d = mesh.dimension;
  const bool axisymmetric = d == 2 && scene.parts.front().setup.formulation == Formulation::axisymmetric;
  const Eigen::Index count = axisymmetric ? 1 : d == 3 ? 6 : 3;
  struct Body {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY), high = -low;
    Eigen::MatrixXd held; ///< sum of m m^T over all that is held, m the motions of its dof
  };
  Bodies bodies(mesh, dofs);
  std::map<int, Body> all;
  const auto place = [&](int node) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (int i = 0; i < d; ++i) x[i] = mesh.node(node)[static_cast<std::size_t>(i)];
    return x;
  };
  const int nodes = mesh.node_count() - (scene.contact && scene.contact->body ? 2 : 0); // of elements
  for (int node = 0; node < nodes; ++node) {
    Body& body = all[bodies.of(node)];
    body.low = body.low.cwiseMin(place(node)), body.high = body.high.cwiseMax(place(node));
  }
  for (auto& [first, body] : all) body.held = Eigen::MatrixXd::Zero(count, count);
  for (int node = 0; node < nodes; ++node) {
    Body& body = all[bodies.of(node)];
    const double size = (body.high - body.low).norm();
    const auto motions_of = [&](int of) {
      return motions((place(of) - 0.5 * (body.low + body.high)) / size, d, axisymmetric);
    };
    const int owner = dofs.representative(node);
    for (int i = 0; i < d; ++i) {
      const Eigen::VectorXd own = motions_of(node).row(i);
      const auto dof = static_cast<std::size_t>(node * d + i);
      if (dofs.equation(dof) < 0 || (!springs.empty() && springs[dof] > 0))
        body.held += own * own.transpose();
      if (owner == node) continue;
      const Eigen::VectorXd apart = own - Eigen::VectorXd(motions_of(owner).row(i)); // must not move apart
      body.held += apart * apart.transpose();
    }
  }
  for (const auto& [first, body] : all) {
    const Spectrum spectrum = spectrum_of(body.held);
    if (spectrum.values[0] > 1e-12 * std::max(1., spectrum.values[count - 1])) continue;
    std::string part;
    for (const ElementGroup& group : mesh.groups)
      for (std::size_t e = 0; part.empty() && e < group.size(); ++e)
        if (bodies.of(group.element(e)[0]) == first)
          part = scene.parts[static_cast<std::size_t>(group.part)].name;
    return "part " + part + " can move " + name_of(spectrum.vectors.col(0), d, axisymmetric);
  }
  return "";
}

} // namespace host
