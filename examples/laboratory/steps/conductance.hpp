// SPDX-License-Identifier: BSD-3-Clause
// Conductance and leakage of a rough contact, from its gaps.
#pragma once

#include "run.hpp"

namespace host {

/// Means over the slave surface of the gap and of its cube, penetrations and points without a gap as 0.
struct GapMeans {
  double gap = 0, cubed = 0;
};
GapMeans gap_means(const std::vector<double>& gap, const std::vector<double>& areas);

/// h_c / k_s [1/L] of the step that has just been solved: the conductance of the interface of two half-spaces over
/// their conductivity k_s = 2 k_1 k_2 / (k_1 + k_2), which is their incremental stiffness dp / d(- mean gap) over E*
/// (J. R. Barber, Proc. R. Soc. A 459, 2003): a central difference between a higher and a lower load, which are
/// taken back; NaN where one of them does not converge.
double incremental_conductance(Simulation& simulation, const Target& higher, const Target& lower);

/// Closed forms for a sine of wavelength lambda whose mean pressure is the part P of that of full contact:
/// h_c lambda / k_s = pi / (- ln P), and <g^3> / amplitude^3.
double westergaard_conductance(double part);
double westergaard_cubed_gap(double part);

/// Writes the gaps of all steps for those who solve Reynolds' equation: gaps.npy [steps][points] and places.npy
/// [points][d], NumPy's format; nothing where the slave points are others from step to step.
/// @return the files that were written
std::vector<std::filesystem::path> write_gaps(const std::vector<StepRecord>& records, int dimension,
                                              const std::filesystem::path& folder);

} // namespace host
