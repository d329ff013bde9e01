// SPDX-License-Identifier: BSD-3-Clause
#include "heat.hpp"

#include <cmath>

namespace host {
namespace {

/// Derivatives of the residual of one element by its displacements and temperatures, all constant:
///   power of node a         R_a  = sum_b  integral of k grad N_a . grad N_b      T_b
///   force a, component i    R_ai = sum_b -integral of beta dN_a/dx_i N_b         T_b
template <ElementType Type> Eigen::MatrixXd tangent_of(const ElementSetup& setup, const NodeMatrix<Type>& X) {
  constexpr int nodes = node_count(Type), d = dimension(Type), forces = nodes * d;
  static const auto points = quadrature<Type>();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(forces + nodes, forces + nodes);
  const double beta = setup.thermal_stress();
  for (const auto& point : points) {
    const auto [jacobian, weight, radius, dN] = element_point<Type>(setup, X, point);
    K.bottomRightCorner(nodes, nodes) += weight * setup.material.conductivity * dN * dN.transpose();
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < d; ++i) {
        const double hoop = radius > 0 && i == 0 ? point.values[a] / radius : 0;
        for (int b = 0; b < nodes; ++b)
          K(d * a + i, forces + b) -= weight * beta * (dN(a, i) + hoop) * point.values[b];
      }
  }
  return K;
}

} // namespace

template <ElementType Type>
double Heat::assemble_group(std::size_t index, const std::vector<double>& values,
                            const std::vector<double>& direction, std::vector<double>& residual,
                            const AddTangent& add) const {
  constexpr int nodes = node_count(Type), d = dimension(Type);
  const ElementGroup& group = mesh_->groups[index];
  const auto displacements = mesh_->coordinates.size();
  std::vector<std::size_t> dof(static_cast<std::size_t>(nodes * (d + 1)));
  Eigen::VectorXd moved(nodes * (d + 1));
  double squared = 0;
  for (std::size_t e = 0; e < group.size(); ++e) {
    const auto element = group.element(e);
    for (int a = 0; a < nodes; ++a) {
      const auto node = static_cast<std::size_t>(element[static_cast<std::size_t>(a)]);
      for (int i = 0; i < d; ++i)
        dof[static_cast<std::size_t>(d * a + i)] =
            node * static_cast<std::size_t>(d) + static_cast<std::size_t>(i);
      dof[static_cast<std::size_t>(nodes * d + a)] = displacements + node;
    }
    const Eigen::MatrixXd K = tangent_of<Type>(setups_[static_cast<std::size_t>(group.part)],
                                               gathered<Type>(element, mesh_->coordinates));
    for (std::size_t k = 0; k < dof.size(); ++k)
      moved[static_cast<Eigen::Index>(k)] = values[dof[k]] + (direction.empty() ? 0 : direction[dof[k]]);
    const Eigen::VectorXd force = K * moved;
    for (std::size_t k = 0; k < dof.size(); ++k) residual[dof[k]] += force[static_cast<Eigen::Index>(k)];
    add({index, e, dof, K.data()});
    squared +=
        (K.bottomRightCorner(nodes, nodes).cwiseAbs() * (moved.tail(nodes).array() + start_).abs().matrix())
            .squaredNorm();
  }
  return squared;
}

double Heat::assemble(const std::vector<double>& values, const std::vector<double>& direction,
                      std::vector<double>& residual, const AddTangent& add) const {
  double squared = 0;
  for (std::size_t g = 0; g < mesh_->groups.size(); ++g)
    squared += with_type(mesh_->groups[g].type, [&]<ElementType Type>() {
      return assemble_group<Type>(g, values, direction, residual, add);
    });
  return std::sqrt(squared);
}

} // namespace host
