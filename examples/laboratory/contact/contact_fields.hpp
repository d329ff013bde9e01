// SPDX-License-Identifier: BSD-3-Clause
// What a person wants to know about the slave points of a contact.
#pragma once

#include <cstdint>
#include <vector>

namespace host {

/// Fields on the slave nodes, in their order.
struct ContactFields {
  std::vector<double> gap, normal_gap,
      pressure;                      ///< [slaves]; no projection inside the segment: NaN gaps, no pressure
  std::vector<double> normal, point; ///< [slaves][d] n_e and rho_e at the projection
  std::vector<char> closed;          ///< [slaves] carries pressure
  std::vector<double> traction;      ///< [slaves][d] tangential, on the master
  std::vector<double> slip, age;     ///< [slaves] accumulated; increments since the last change of status
  double dissipation = 0;            ///< of friction within the increment, all points [F L]
  std::vector<double> worn;          ///< [slaves] depth lost by the slave surface [L]; empty: no wear
  std::vector<std::int32_t> flags;   ///< [slaves] ENTS_FLAG_...; no segment: ENTS_FLAG_OUTSIDE
  std::vector<std::int64_t> segment; ///< [slaves] -1: none
  std::vector<double> node_forces;   ///< [slaves][d] on the master
  std::vector<double> force;         ///< [d] their sum
  std::vector<double>
      moment; ///< [3], 2D [1] about the reference point of a rigid body that turns; else empty
};

} // namespace host
