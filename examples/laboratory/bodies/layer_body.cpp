// SPDX-License-Identifier: BSD-3-Clause
#include "layer_body.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "elastic_layer.hpp"
#include "toolbox/error.hpp"

namespace host {
namespace {

Eigen::Index cells(const GridLines& line) { return static_cast<Eigen::Index>(line.size()) - 1; }
double length(const GridLines& line) { return line.back() - line.front(); }

} // namespace

void add_layer(Mesh& mesh, const std::string& name, const std::vector<GridLines>& lines) {
  const int first = mesh.node_count(), columns = static_cast<int>(lines[0].size());
  std::vector<Face> faces;
  for (std::size_t j = 0; j < lines[1].size(); ++j)
    for (std::size_t i = 0; i < lines[0].size(); ++i) {
      mesh.coordinates.insert(mesh.coordinates.end(), {lines[0][i], lines[1][j], lines[2].back()});
      if (i == 0 || j == 0) continue;
      const int node = mesh.node_count() - 1;
      faces.push_back({4, {node - columns - 1, node - columns, node, node - 1}});
    }
  std::vector<int> nodes(static_cast<std::size_t>(mesh.node_count() - first));
  std::iota(nodes.begin(), nodes.end(), first);
  mesh.node_sets[name] = mesh.node_sets[name + ".z_max"] = std::move(nodes);
  mesh.face_sets[name + ".z_max"] = std::move(faces);
}

LayerBody::LayerBody(const std::vector<GridLines>& lines, const Material& material)
    : transform_(Grid::nodes, cells(lines[0]), cells(lines[1])),
      stiffness_(cells(lines[0]) + 1, cells(lines[1]) + 1) {
  const double lx = length(lines[0]), ly = length(lines[1]);
  const double cell = lx / static_cast<double>(cells(lines[0])) * ly / static_cast<double>(cells(lines[1]));
  for (Eigen::Index j = 0; j < stiffness_.cols(); ++j)
    for (Eigen::Index i = 0; i < stiffness_.rows(); ++i) {
      const double k =
          std::numbers::pi * std::hypot(static_cast<double>(i) / lx, static_cast<double>(j) / ly);
      stiffness_(i, j) = cell / layer_compliance(k, length(lines[2]), material);
    }
  compliance_ = stiffness_.inverse();
  const Eigen::MatrixXd x = cosines(Grid::nodes, cells(lines[0])).array().square(),
                        y = cosines(Grid::nodes, cells(lines[1])).array().square();
  const Eigen::ArrayXXd diagonal =
      transform_.weights().square() * (x * stiffness_.matrix() * y.transpose()).array();
  diagonal_ = diagonal.reshaped();
}

// force = W F stiffness F^T W displacement: node (i, j) of the grid is entry i + (cells along x + 1) j.
Eigen::VectorXd LayerBody::force(const Eigen::VectorXd& displacement) const {
  const Eigen::Map<const Eigen::ArrayXXd> field(displacement.data(), stiffness_.rows(), stiffness_.cols());
  const Eigen::ArrayXXd force =
      transform_.weights() * transform_.filter(transform_.weights() * field, stiffness_);
  return force.reshaped();
}

Eigen::VectorXd LayerBody::displacement(const Eigen::VectorXd& force) const {
  const Eigen::Map<const Eigen::ArrayXXd> field(force.data(), stiffness_.rows(), stiffness_.cols());
  return transform_.filter(field, compliance_).reshaped();
}

bool LayerSolver::factorize(const SparseMatrix& matrix) {
  const Eigen::Index nodes = body_->nodes();
  contact_ = matrix.topLeftCorner(nodes, nodes).triangularView<Eigen::Lower>();
  diagonal_ = body_->diagonal() + Eigen::VectorXd(contact_.diagonal());
  free_ = Eigen::ArrayXd::Ones(nodes);
  multipliers_.assign(static_cast<std::size_t>(matrix.cols() - nodes), {});
  for (Eigen::Index column = 0; column < matrix.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, static_cast<int>(column)); entry; ++entry) {
      if (entry.row() < nodes && column < nodes) continue;
      Multiplier& multiplier =
          multipliers_[static_cast<std::size_t>(std::max<Eigen::Index>(entry.row(), column) - nodes)];
      (entry.row() == column ? multiplier.h : column >= nodes ? multiplier.f : multiplier.g) = entry.value();
      if (entry.row() != column) multiplier.node = std::min<Eigen::Index>(entry.row(), column);
    }
  for (const Multiplier& multiplier : multipliers_) {
    if (multiplier.h == 0 && multiplier.g != 0)
      free_[multiplier.node] = 0;
    else if (multiplier.h == 0)
      return false;
    else if (multiplier.f != 0 && multiplier.g != 0) {
      contact_.coeffRef(multiplier.node, multiplier.node) -= multiplier.f * multiplier.g / multiplier.h;
      diagonal_[multiplier.node] -= multiplier.f * multiplier.g / multiplier.h;
    }
  }
  open_ = free_ * (diagonal_.array() < 1.1 * body_->diagonal().array()).cast<double>();
  return diagonal_.minCoeff() > 0;
}

Eigen::VectorXd LayerSolver::product(const Eigen::VectorXd& displacement) const {
  return body_->force(displacement) + contact_.selfadjointView<Eigen::Lower>() * displacement;
}

Eigen::VectorXd LayerSolver::free_displacement(const Eigen::VectorXd& force) const {
  constexpr int most = 10000;
  constexpr double enough = 1e-5; // so much a Newton iteration gains at least
  const Eigen::ArrayXd held = (free_ - open_) / diagonal_.array();
  const auto precondition = [&](const Eigen::VectorXd& forces) -> Eigen::VectorXd {
    return open_ * body_->displacement(open_ * forces.array()).array() + held * forces.array();
  };
  Eigen::VectorXd residual = force, x = Eigen::VectorXd::Zero(force.size());
  Eigen::VectorXd preconditioned = precondition(residual), direction = preconditioned;
  double squared = residual.dot(preconditioned);
  const double wanted = enough * enough * squared;
  for (int iteration = 0; squared > wanted; ++iteration) {
    const Eigen::VectorXd image = product(direction);
    const double curvature = direction.dot(image);
    if (!(curvature > 0) || iteration == most) return {};
    const double step = squared / curvature;
    x += step * direction;
    residual -= step * image;
    preconditioned = precondition(residual);
    const double next = residual.dot(preconditioned);
    direction = preconditioned + next / squared * direction;
    squared = next;
  }
  return x;
}

Eigen::MatrixXd LayerSolver::solve(const Eigen::MatrixXd& right_hand_sides) {
  const Eigen::Index nodes = body_->nodes();
  Eigen::MatrixXd solution(right_hand_sides.rows(), right_hand_sides.cols());
  for (Eigen::Index column = 0; column < right_hand_sides.cols(); ++column) {
    Eigen::VectorXd force = right_hand_sides.col(column).head(nodes),
                    prescribed = Eigen::VectorXd::Zero(nodes);
    const auto rest = [&](std::size_t j) {
      return right_hand_sides(nodes + static_cast<Eigen::Index>(j), column);
    };
    for (std::size_t j = 0; j < multipliers_.size(); ++j) {
      const Multiplier& multiplier = multipliers_[j];
      if (multiplier.h == 0)
        prescribed[multiplier.node] = rest(j) / multiplier.g;
      else if (multiplier.f != 0)
        force[multiplier.node] -= multiplier.f * rest(j) / multiplier.h;
    }
    const bool any = prescribed.any();
    const Eigen::VectorXd by_prescribed = any ? product(prescribed) : prescribed;
    const Eigen::VectorXd moved = free_displacement(force - by_prescribed);
    if (moved.size() == 0) return Eigen::MatrixXd::Constant(solution.rows(), solution.cols(), std::nan(""));
    const Eigen::VectorXd x = prescribed + moved;
    solution.col(column).head(nodes) = x;
    if (multipliers_.empty()) continue;
    const Eigen::VectorXd force_of_multipliers = force - product(x);
    for (std::size_t j = 0; j < multipliers_.size(); ++j) {
      const Multiplier& multiplier = multipliers_[j];
      const double at_node = multiplier.node < 0 ? 0 : x[multiplier.node];
      solution(nodes + static_cast<Eigen::Index>(j), column) =
          multiplier.h == 0 ? force_of_multipliers[multiplier.node] / multiplier.f
                            : (rest(j) - multiplier.g * at_node) / multiplier.h;
    }
  }
  return solution;
}

} // namespace host
