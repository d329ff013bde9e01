// SPDX-License-Identifier: BSD-3-Clause
// One call of the caller's slave nodes: arguments checked once, then a detection each.
#pragma once

#include "abi/call/mesh.hpp"
#include "core/search/lost_contact.hpp"

namespace ents {

struct DetectionCall {
  const ents_model* model;
  MasterMesh mesh;
  const double* tree;
  const ents_detection* io;

  // Nothing is written.
  std::int32_t open(const ents_model* model, const ents_master_mesh* mesh, const double* tree,
                    std::int64_t size, std::int64_t first, std::int64_t count,
                    const ents_detection* detection, ents_report* report);

  // States of the begin of the increment: a slave in contact there has a segment, even if the caller gives
  // none.
  const double* state_begin = nullptr;
  std::int64_t state_begin_stride = 0;
  // Where slaves and nodes were at the begin of the increment, or null: ways are not looked at.
  const double *slave_begin = nullptr, *positions_begin = nullptr;
  LeftOutOfSlaves left_out;
  const double* depth = nullptr; // [slaves] or null
  // A slave behind an edge that had no segment ends the call, too.
  bool needs_all = false;

  // What is left out for slave i. Errors are reported.
  std::int32_t read_left_out(std::int64_t i, LeftOut& out, ents_report* report) const;

  // Ends with ENTS_NO_PROJECTION if a slave's contact is lost and the caller does not permit it.
  std::int32_t detect_all(std::int64_t first, std::int64_t count, ents_report* report) const;

private:
  // ENTS_NO_PROJECTION if a slave that is open has passed through the surface.
  std::int32_t look_at_ways(std::int64_t first, std::int64_t count, ents_report* report) const;
  std::int64_t segment_before(std::int64_t slave, double (&xi)[2]) const;

  bool judges;         // the caller's struct has `permitted`
  ents_detection copy; // of an older caller's
};

} // namespace ents
