// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that are slave and master: one surface in contact with itself, and two passes over two surfaces.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh.hpp"
#include "scene.hpp"

namespace host {

/// What slave points must not find, and where they were at the begin of the increment: see ents_detection. Empty arrays:
/// not given.
struct LeftOut {
  std::vector<std::int64_t> node, segment;      ///< [slaves] where the slave lies on the master
  std::vector<double> depth;                    ///< [slaves] half the thickness of the body [L]
  std::vector<std::int32_t> side, segment_side; ///< [slaves], [segments]
  const double *slave_begin = nullptr, *positions_begin = nullptr; ///< self-contact: ways are looked at

  /// The same of some slaves, without ways.
  LeftOut of(const std::vector<std::size_t>& slaves) const;
};

/// Are the slave faces the master faces?
inline bool is_one_surface(const ContactSpec& spec) {
  return !spec.master.empty() && spec.slave == spec.master;
}
inline bool has_both_sides(const ContactSpec& spec) { return spec.two_pass || is_one_surface(spec); }

/// The slave faces; with two passes the master faces behind them. Of a master that has both sides: its segments, too.
/// @throws InputError where a set does not exist, or two passes are over surfaces that meet
std::vector<Face> slave_faces(const Mesh& mesh, const ContactSpec& spec);

class ContactSides;
/// What the points of surfaces that are slave and master must not find.
LeftOut left_out_of(const ContactSpec& spec, const ContactSides& sides);

/// @throws InputError for what needs one slave and one master
void refuse_one_sided(const ContactSpec& spec);

} // namespace host
