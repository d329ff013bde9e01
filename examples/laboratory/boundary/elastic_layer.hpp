// SPDX-License-Identifier: BSD-3-Clause
// Boundary elements: a rigid surface pressed without friction on an elastic layer that is bonded to a rigid
// base, or a half-space, whose sides are planes of symmetry or repeat. An answer that shares nothing with the
// elements, projections and laws of the other scenes.
//   Compliance of the layer: K. L. Johnson, Contact Mechanics, 1985, section 13.2 (half-space), and R. B.
//   Hannah, Q. J. Mech. Appl. Math. 4 (1951) 94 (bonded layer); conjugate gradients with p >= 0: I. A.
//   Polonsky and L. M. Keer, Wear 231 (1999) 206; area: V. A. Yastrebov, G. Anciaux, J.-F. Molinari, Tribol.
//   Int. 114 (2017) 161.
#pragma once

#include <Eigen/Core>

#include "material.hpp"
#include "wave_transform.hpp"

namespace host {

/// Displacement of a layer's surface per pressure, both a cosine of this wave number k, against the pressure.
/// @param k  k = 0: uniform pressure [1/L]
/// @return [L^3/F]
double layer_compliance(double k, double thickness, const Material& material);

/// What is known of a contact; its pressures are those of the finer of two grids.
struct LayerContact {
  Eigen::ArrayXXd pressure; ///< [x][y] at the centres of equal cells
  double mean_pressure = 0, peak_pressure = 0;
  double fraction = 0;         ///< of the area in contact, corrected by the length of its border
  double fraction_counted = 0; ///< cells that carry pressure
  Eigen::ArrayXXd gap; ///< [x][y] between the deformed surfaces; negative: the overlap that a softness allows
  int iterations = 0;
};

class ElasticLayer {
public:
  /// @param nx, ny  cells
  /// @param lx, ly     lengths of the sides
  /// @param thickness  infinite: a half-space, whose mean displacement is left out
  /// @param grid       cells: the sides are planes of symmetry; periodic
  ElasticLayer(Eigen::Index nx, Eigen::Index ny, double lx, double ly, double thickness,
               const Material& material, Grid grid = Grid::cells);

  double length_x() const { return lx_; }
  double length_y() const { return ly_; }
  Grid grid() const { return grid_; }

  /// Centre of a cell from the corner of the layer.
  double x(Eigen::Index i) const {
    return (static_cast<double>(i) + 0.5) * lx_ / static_cast<double>(cells_x());
  }
  double y(Eigen::Index j) const {
    return (static_cast<double>(j) + 0.5) * ly_ / static_cast<double>(cells_y());
  }
  Eigen::Index cells_x() const { return compliance_.rows(); }
  Eigen::Index cells_y() const { return compliance_.cols(); }

  /// Displacement of the surface away from the rigid body under a pressure.
  Eigen::ArrayXXd displacement(const Eigen::ArrayXXd& pressure) const;

  /// Mean of a field around each cell, with the weights of a normal distribution.
  /// @param deviation  its standard deviation [L]
  Eigen::ArrayXXd smoothed(const Eigen::ArrayXXd& field, double deviation) const;

  /// Displacement under pressures that are means over boxes around points hx and hy apart, without the waves
  /// that such points cannot have: that of the law of a place (place_laws.hpp).
  Eigen::ArrayXXd displacement_of_boxes(const Eigen::ArrayXXd& pressure, double hx, double hy) const;

  /// A field between the centres of the cells, bilinear; beyond the outermost as there.
  /// @param x, y  from the corner of the layer
  double between(const Eigen::ArrayXXd& field, double x, double y) const;

  /// Pressure >= 0 under a rigid surface, where gap + displacement >= 0, one of them zero.
  /// @param gap  [x][y] of the undeformed layer, < 0: overlap
  /// @throws JobError if the iteration does not converge
  /// @param softness  overlap per pressure that the contact law allows [L^3/F]; 0: hard contact
  LayerContact press(const Eigen::ArrayXXd& gap, double softness = 0) const;
  /// The same with a given mean pressure; `gap` up to a constant.
  /// @param start   pressure that the iteration starts from, scaled to the mean; null: the mean everywhere
  /// @param enough  where it ends: largest gap in contact or overlap, of the height of the surface
  LayerContact press_with(double mean_pressure, const Eigen::ArrayXXd& gap, double softness = 0,
                          const Eigen::ArrayXXd* start = nullptr, double enough = 1e-8) const;

private:
  LayerContact describe(Eigen::ArrayXXd pressure, Eigen::ArrayXXd gap, int iterations) const;

  double lx_, ly_;
  Grid grid_;
  bool periodic_;
  WaveTransform transform_;
  Eigen::ArrayXXd wave_number_, compliance_; ///< [modes x][modes y]
};

} // namespace host
