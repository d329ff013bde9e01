// SPDX-License-Identifier: BSD-3-Clause
// Pictures of runs with friction or with two elastic bodies.
#pragma once

#include <vector>

#include "output/pictures.hpp"
#include "run.hpp"

namespace host {

/// mu p and the shear traction over x, computed and exact (Cattaneo, Mindlin).
pictures::Chart partial_slip_profile(Simulation& simulation, const StepRecord& record);

/// Torque over axial force of a screw against its turns, computed and exact.
pictures::Chart screw_torque_history(const Scene& scene, const std::vector<StepRecord>& records);

/// Components of the contact force against the load factor.
pictures::Chart force_history(const Scene& scene, const std::vector<StepRecord>& records);

} // namespace host
