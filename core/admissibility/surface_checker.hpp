// SPDX-License-Identifier: BSD-3-Clause
// What the conditions of a whole surface share: places on it, and the record of what was found. Points of the
// plane have z = 0 here.
#pragma once

#include <Eigen/Core>

#include "core/admissibility/surface_admissibility.hpp"

namespace ents {

struct Place {
  Eigen::Vector3d rho_e, n_e, n;
  double h;
};

inline Eigen::Vector3d vector_of(const double* x, int d) { return {x[0], x[1], d == 3 ? x[2] : 0.0}; }

// False: rho_e has no tangent plane there.
inline bool place_at(const Plan& plan, const SegmentNodes& nodes, const double* xi, Place& out) {
  double point[3], normal[3], base_normal[3];
  const SurfacePoint wanted = {point, normal, &out.h, nullptr, base_normal, nullptr, nullptr};
  if (plan.surface(plan, nodes.positions, nodes.surface_coordinates, xi, wanted) != Status::ok) return false;
  out.rho_e = vector_of(point, plan.dimension);
  out.n_e = vector_of(normal, plan.dimension);
  out.n = vector_of(base_normal, plan.dimension);
  return true;
}

struct SurfaceChecker {
  const ModelSpec& model;
  const Plan& plan;
  const MasterMesh& mesh;
  double size; // of the box around the nodes
  SurfaceAdmissibility& result;

  bool smoothed() const { return basis_entry(model.basis).smoothed; }
  Finding& finding(int which) const { return result.findings[which]; }
  // Keep the place if its value is the worst so far; a segment without a place is one where the value holds
  // everywhere.
  bool keep(int which, bool worse, double value, std::int64_t segment, const double* xi,
            std::int64_t other = -1, const double* other_xi = nullptr) const {
    Finding& f = finding(which);
    if (f.segment >= 0 && !worse) return false;
    const int parameters = plan.parameters;
    f.value = value, f.segment = segment, f.other = other;
    for (int a = 0; a < 2; ++a) {
      f.xi[a] = xi && a < parameters ? xi[a] : 0.0;
      f.other_xi[a] = other_xi && a < parameters ? other_xi[a] : 0.0;
    }
    return true;
  }
  void mark(int which, std::int64_t segment) const {
    if (!finding(which).judged) return;
    finding(which).violated = true;
    result.violations[static_cast<std::size_t>(segment)] |= std::int64_t{1} << which;
  }
};

// Corners of a segment: places in its connectivity and natural coordinates; 2 of a line, 3 or 4 in the order
// of its border. For smoothed segments the nodes of the part in the middle, which is the segment.
struct Corners {
  int count;
  int node[4];
  double xi[4][2];
};
Corners corners_of(Basis basis);

// Conditions on the edges that two segments share: jump, kink, wedge.
// samples: points along an edge. smooth [nodes] out: no edge at this node has a jump or a kink.
void check_shared_edges(const SurfaceChecker& checker, int samples, std::vector<bool>& smooth);

} // namespace ents
