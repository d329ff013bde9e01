// SPDX-License-Identifier: BSD-3-Clause
// theory.md, section 4.8.
// The law of the short waves of a rough surface: boundary elements press exactly these waves on a half-space
// without friction, at mean pressures from nearly full contact down to a few per mille of the area. Gaps are
// counted from the mean plane of the waves, so that the law acts on the gap to the surface without them.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "elastic_layer.hpp"
#include "toolbox/json_reader.hpp"

namespace host {

/// The waves under one mean pressure.
struct WaveLevel {
  double pressure = 0;     ///< mean [F/L^2]
  double gap = 0;          ///< mean, between the deformed surface and the waves [L]
  double share = 0;        ///< of the area in contact, corrected by the length of its border
  double counted = 0;      ///< the same, cells that carry pressure
  Eigen::ArrayXXf pressed; ///< [x][y] pressure of every cell [F/L^2]
};

/// By falling pressure.
using WaveLaw = std::vector<WaveLevel>;

/// Told after each level: how many there are, and are done.
using WaveProgress = std::function<void(int done, int levels)>;

/// Lines on stderr: what it is, and how far. On a terminal each one replaces the one before, else only the last.
WaveProgress progress_on_stderr(std::string what);

/// Root mean square of the slope of a field with these distances of its points.
double rms_slope(const Eigen::ArrayXXd& z, double dx, double dy);

/// @param waves       height of the gap [L], its mean 0
/// @param half_space  an ElasticLayer without thickness of these cells, with E* = 1
/// @param modulus     E* [F/L^2]; pressures are proportional to it
/// @throws JobError if the iteration does not converge
WaveLaw press_waves(const Eigen::ArrayXXd& waves, const ElasticLayer& half_space, double modulus,
                    const WaveProgress& progress = {});

/// The same from a file, if one with these waves was kept; else computed and kept. The file's name is the hash
/// of all that the law depends on; E* is none of it. A file that is damaged is computed again; one that cannot
/// be written is left out.
/// @param[out] kept  was there a file? May be null
WaveLaw kept_wave_law(const Eigen::ArrayXXd& waves, const ElasticLayer& half_space, double modulus,
                      const WaveProgress& progress = {}, bool* kept = nullptr);

/// The key "normal" of a model with these points, by falling pressure. Behind the last one the pressure falls
/// exponentially, as it does before it, and ends.
Json law_table(std::vector<double> gap, std::vector<double> pressure);

/// A half-space of unit modulus E* under cells.
ElasticLayer unit_half_space(Eigen::Index nx, Eigen::Index ny, double lx, double ly, Grid grid);

} // namespace host
