// SPDX-License-Identifier: BSD-3-Clause
// Slave points beside their patches (common/patch_watch.hpp): what is found goes to ccx's output and to ents_slide.txt,
// from which "ents-deck run" makes wider patches.
#pragma once

#include "../common/element.hpp"

namespace ccx {

/// Displacements of ccx: v(0:mt-1,*).
struct Configuration {
  const double* v;
  int mt;
};

/// An increment is cut because this element's point has left its patch while in contact. Any thread.
void note_left(const ents_adapter::Host& host, int element, const Configuration& now);

/// The increment has converged. Ends the job where a point is pressed into the master beside its patch.
void check_patches(const ents_adapter::Host& host, const Configuration& now, int step, int increment);

} // namespace ccx
