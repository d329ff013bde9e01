// SPDX-License-Identifier: BSD-3-Clause
// One call of the caller's slave nodes: arguments checked once, then a detection each.
#pragma once

#include "abi/mesh.hpp"

namespace ents {

struct DetectionCall {
  const ents_model* model;
  MasterMesh mesh;
  const double* tree;
  const ents_detection* io;

  // Nothing is written.
  std::int32_t open(const ents_model* model, const ents_master_mesh* mesh, const double* tree, std::int64_t size, std::int64_t first,
                    std::int64_t count, const ents_detection* detection, ents_report* report);

  // lost: the first slave that is behind an edge; -1: none
  std::int32_t detect_all(std::int64_t first, std::int64_t count, std::int64_t& lost, ents_report* report) const;

private:
  ents_detection copy; // of an older caller's
};

} // namespace ents
