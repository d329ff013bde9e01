// SPDX-License-Identifier: BSD-3-Clause
#include "bulk.hpp"

#include <algorithm>
#include <array>

namespace host {

Bulk::Bulk(const Mesh& mesh, std::vector<ElementSetup> setups) : mesh_(&mesh), setups_(std::move(setups)) {
  linear_ = std::all_of(setups_.begin(), setups_.end(), [](const ElementSetup& setup) {
    return setup.material.law == Material::Law::linear_elastic;
  });
}

template <ElementType Type>
bool Bulk::assemble_group(std::size_t group_index, const std::vector<double>& displacement,
                          const std::vector<double>& direction, std::vector<double>& residual,
                          const AddTangent& add, double* energy) const {
  constexpr std::size_t nodes = static_cast<std::size_t>(node_count(Type));
  constexpr std::size_t d = static_cast<std::size_t>(dimension(Type)), dofs = nodes * d;
  const ElementGroup& group = mesh_->groups[group_index];
  const ElementSetup& setup = setups_[static_cast<std::size_t>(group.part)];
  std::array<std::size_t, dofs> dof{};
  ElementResult<static_cast<int>(dofs)> result;
  for (std::size_t e = 0; e < group.size(); ++e) {
    const auto element = group.element(e);
    const NodeMatrix<Type> X = gathered<Type>(element, mesh_->coordinates),
                           u = gathered<Type>(element, displacement);
    bool moved = false;
    for (std::size_t a = 0; a < dofs; ++a) {
      dof[a] = static_cast<std::size_t>(element[a / d]) * d + a % d;
      moved = moved || (!direction.empty() && direction[dof[a]] != 0);
    }
    if (!evaluate_element<Type>(setup, {X.data(), dofs}, {u.data(), dofs}, add || moved, result))
      return false;
    if (moved) {
      Eigen::Matrix<double, static_cast<int>(dofs), 1> step;
      for (std::size_t a = 0; a < dofs; ++a) step[static_cast<Eigen::Index>(a)] = direction[dof[a]];
      result.residual.noalias() += result.tangent * step;
    }
    for (std::size_t a = 0; a < dofs; ++a) residual[dof[a]] += result.residual[static_cast<Eigen::Index>(a)];
    if (add) add({group_index, e, dof, result.tangent.data()});
    if (energy != nullptr) *energy += result.energy;
  }
  return true;
}

bool Bulk::assemble(const std::vector<double>& displacement, const std::vector<double>& direction,
                    std::vector<double>& residual, const AddTangent& add, double* energy) const {
  for (std::size_t g = 0; g < mesh_->groups.size(); ++g) {
    const bool ok = with_type(mesh_->groups[g].type, [&]<ElementType Type>() {
      return assemble_group<Type>(g, displacement, direction, residual, add, energy);
    });
    if (!ok) return false;
  }
  return true;
}

template <ElementType Type>
void Bulk::stress_of_group(const ElementGroup& group, const std::vector<double>& displacement,
                           std::vector<double>& sum, std::vector<double>& weight) const {
  constexpr int nodes = node_count(Type), d = dimension(Type);
  const std::size_t components = d == 3 ? 6 : 4;
  const ElementSetup& setup = setups_[static_cast<std::size_t>(group.part)];
  static const auto points = quadrature<Type>();
  MaterialPoint material_point;
  for (std::size_t e = 0; e < group.size(); ++e) {
    const auto element = group.element(e);
    const NodeMatrix<Type> X = gathered<Type>(element, mesh_->coordinates),
                           u = gathered<Type>(element, displacement);
    // Mean over the quadrature points: where linear elements are most accurate.
    Matrix3 mean = Matrix3::Zero();
    double volume = 0;
    for (const auto& point : points) {
      const auto at = element_point<Type>(setup, X, point);
      Matrix3 H = Matrix3::Zero();
      H.template topLeftCorner<d, d>() = u.transpose() * at.dN;
      if (at.radius > 0) H(2, 2) = u.col(0).dot(point.values) / at.radius;
      if (!evaluate(setup, H, false, material_point)) continue;
      Matrix3 cauchy = material_point.stress;
      if (setup.material.law != Material::Law::linear_elastic) {
        const Matrix3 F = Matrix3::Identity() + H;
        cauchy = material_point.stress * F.transpose() / F.determinant();
      }
      const double part = point.weight * at.jacobian;
      mean += part * cauchy;
      volume += part;
    }
    for (int a = 0; a < nodes; ++a) {
      const auto node = static_cast<std::size_t>(element[static_cast<std::size_t>(a)]);
      weight[node] += volume;
      double* target = sum.data() + node * components;
      const std::array<double, 6> plane{mean(0, 0), mean(1, 1), mean(2, 2),
                                        mean(0, 1), mean(1, 2), mean(0, 2)};
      for (std::size_t c = 0; c < components; ++c) target[c] += plane[c];
    }
  }
}

std::vector<double> Bulk::nodal_stress(const std::vector<double>& displacement) const {
  const std::size_t components = mesh_->dimension == 3 ? 6 : 4;
  const auto nodes = static_cast<std::size_t>(mesh_->node_count());
  std::vector<double> sum(nodes * components, 0.0), weight(nodes, 0.0);
  for (const ElementGroup& group : mesh_->groups)
    with_type(group.type,
              [&]<ElementType Type>() { stress_of_group<Type>(group, displacement, sum, weight); });
  for (std::size_t node = 0; node < nodes; ++node)
    for (std::size_t c = 0; c < components; ++c)
      if (weight[node] > 0) sum[node * components + c] /= weight[node];
  return sum;
}

} // namespace host
