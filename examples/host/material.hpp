// SPDX-License-Identifier: BSD-3-Clause
// Hyperelastic materials as functions of the displacement gradient H = du/dX (total Lagrangian).
#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/LU>

namespace host {

using Matrix3 = Eigen::Matrix3d;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// Linear elasticity (small strains and rotations, W = mu |sym H|^2 + lambda/2 tr(H)^2), St. Venant and
/// Kirchhoff's material, the same of Green's strain E = (F^T F - 1)/2 (what codes call linear elastic at
/// finite rotations), or the compressible neo-Hooke material W = mu/2 (|F|^2 - 3) - mu ln J + lambda/2 (ln
/// J)^2, F = 1 + H, J = det F (Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd
/// ed., eq. 6.27).
struct Material {
  enum class Law { linear_elastic, st_venant_kirchhoff, neo_hooke };
  Law law = Law::linear_elastic;
  double young = 1;        ///< E > 0 [F/L^2]
  double poisson = 0;      ///< -1 < nu < 0.5
  double conductivity = 0; ///< [power / (L temperature)]; 0: the body has no temperature
  double expansion = 0;    ///< [1 / temperature]

  double mu() const { return young / (2 * (1 + poisson)); }
  double lambda() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
  /// Plane strain modulus E / (1 - nu^2): the contact modulus E* against a rigid body.
  double contact_modulus() const { return young / (1 - poisson * poisson); }
};

/// What a material point answers. Index pairs iJ are flattened row by row: 3 i + J.
struct MaterialPoint {
  double energy = 0; ///< W per reference volume
  Matrix3 stress;    ///< first Piola-Kirchhoff stress P_iJ = dW/dH_iJ
  Matrix9 tangent;   ///< dP_iJ/dH_kL
};

/// @return false if J <= 0: the step must be cut
inline bool evaluate(const Material& material, const Matrix3& gradient, bool want_tangent,
                     MaterialPoint& point) {
  const double mu = material.mu(), lambda = material.lambda();
  if (material.law == Material::Law::linear_elastic) {
    const Matrix3 strain = 0.5 * (gradient + gradient.transpose());
    const double trace = strain.trace();
    point.energy = mu * strain.squaredNorm() + 0.5 * lambda * trace * trace;
    point.stress = 2 * mu * strain + lambda * trace * Matrix3::Identity();
    if (want_tangent) {
      point.tangent.setZero();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          point.tangent(3 * i + j, 3 * i + j) += mu;
          point.tangent(3 * i + j, 3 * j + i) += mu;
          point.tangent(4 * i, 4 * j) += lambda;
        }
    }
    return true;
  }
  const Matrix3 deformation = Matrix3::Identity() + gradient;
  const double jacobian = deformation.determinant();
  if (!(jacobian > 0) || !std::isfinite(jacobian)) return false;
  if (material.law == Material::Law::st_venant_kirchhoff) {
    const Matrix3 strain = 0.5 * (gradient + gradient.transpose() + gradient.transpose() * gradient);
    const double trace = strain.trace();
    const Matrix3 second =
        2 * mu * strain + lambda * trace * Matrix3::Identity(); // second Piola-Kirchhoff stress
    point.energy = mu * strain.squaredNorm() + 0.5 * lambda * trace * trace;
    point.stress = deformation * second;
    if (want_tangent) {
      const Matrix3 left = deformation * deformation.transpose();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l)
              point.tangent(3 * i + j, 3 * k + l) =
                  (i == k ? second(j, l) : 0) + lambda * deformation(i, j) * deformation(k, l) +
                  mu * ((j == l ? left(i, k) : 0) + deformation(i, l) * deformation(k, j));
    }
    return true;
  }
  const Matrix3 inverse = deformation.inverse();
  const double log_jacobian = std::log(jacobian);
  point.energy = 0.5 * mu * (deformation.squaredNorm() - 3) - mu * log_jacobian +
                 0.5 * lambda * log_jacobian * log_jacobian;
  const double factor = lambda * log_jacobian - mu;
  point.stress = mu * deformation + factor * inverse.transpose();
  if (want_tangent)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l)
            point.tangent(3 * i + j, 3 * k + l) = (i == k && j == l ? mu : 0) +
                                                  lambda * inverse(j, i) * inverse(l, k) -
                                                  factor * inverse(j, k) * inverse(l, i);
  return true;
}

/// Plane stress: the thickness stretch H_33 that makes P_33 = 0, and the point with H_33 eliminated.
/// @param gradient  its (3,3) entry is the start value and returns the solution
/// @return false if there is none in reach
inline bool evaluate_plane_stress(const Material& material, Matrix3& gradient, bool want_tangent,
                                  MaterialPoint& point) {
  constexpr int max_iterations = 30;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    if (!evaluate(material, gradient, true, point)) return false;
    const double residual = point.stress(2, 2), slope = point.tangent(8, 8);
    if (!(slope > 0)) return false;
    double step = -residual / slope;
    if (std::abs(step) <= 1e-14 * (1 + std::abs(gradient(2, 2)))) {
      point.stress(2, 2) = 0;
      if (want_tangent) {
        const Eigen::Matrix<double, 9, 1> column = point.tangent.col(8);
        point.tangent -= column * column.transpose() / slope;
      }
      return true;
    }
    if (1 + gradient(2, 2) + step <= 0) step = -0.5 * (1 + gradient(2, 2)); // keep the stretch positive
    gradient(2, 2) += step;
  }
  return false;
}

} // namespace host
