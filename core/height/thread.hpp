// SPDX-License-Identifier: BSD-3-Clause
// Profile of a thread or of grooves: straight flanks between flat crests and roots.
//
//     crest                      h = 0 on the pitch line, where ridge and groove are equally wide
//    /     \                     depth = (pitch - crest - root) / (tan rising + tan falling)
//   /       \______ root         rising, falling: angles of the flanks to the plane across the axis
//                                (ISO 5408), as in ISO metric threads 30 and 30 degrees (ISO 68-1), in
//                                buttress threads 3 and 30 (DIN 513)
//
// The height is the cubic B-spline whose coefficients are samples of these straight lines: the lines
// themselves but for `rounding` on either side of a corner, which it rounds: C2, and inside the corner, for a
// spline reproduces lines and stays between its coefficients (C. de Boor, A Practical Guide to Splines,
// 1978).
#pragma once

#include <cstdint>
#include <vector>

namespace ents {

// Lengths along the axis.
struct ThreadProfile {
  double pitch;           // from ridge to ridge
  double rising, falling; // angles of the flank whose h grows along the axis and of the other, radians,
                          // within 0 .. pi / 2
  double crest, root;     // widths of the flats; crest + root < pitch
  double rounding;        // pitch / 2048 to pitch / 4
};

// B-spline coefficients at equal distances over a pitch, the first at the middle of the crest.
std::vector<double> thread_coefficients(const ThreadProfile& profile);

} // namespace ents
