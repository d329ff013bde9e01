// SPDX-License-Identifier: BSD-3-Clause
// Slave points that are beside their patches: an element has a fixed number of master nodes, and where a body moves
// farther than its patches reach, contact is not seen. ents_patches.json (ents-deck) has the whole surfaces; the end of
// every increment is compared with them, and what is found is written to ccx's output and to ents_slide.txt.
#pragma once

namespace ccx {

/// Arrays of ccx: co(3,*) and v(0:mt-1,*).
struct Configuration {
  const double *co, *v;
  int mt;
};

/// The element carries pressure now. Any thread.
void note_contact(int element, bool contact);

/// An increment is cut because this element's point has left its patch while in contact. Any thread.
void note_left(int element, const Configuration& now);

/// The increment has converged. Ends the job where a point is pressed into the master beside its patch.
void check_patches(const Configuration& now, int step, int increment);

} // namespace ccx
