// SPDX-License-Identifier: BSD-3-Clause
// Walking through the load steps of a scene.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "contact_area.hpp"
#include "exact.hpp"
#include "simulation.hpp"
#include "toolbox/error.hpp"

namespace host {

/// Residuals of one converged increment (a whole step unless it was cut).
struct IncrementRecord {
  double value = 0;                        ///< of the control at its end
  std::vector<double> residuals;           ///< relative, after each Newton iteration
  std::vector<int> status_changes;         ///< slave nodes that opened or closed, at each iteration
  std::vector<Augmentation> augmentations; ///< Uzawa
  int halvings = 0;                        ///< of steps by the line search
  double rounding = 0;   ///< the last residual is above the tolerance, and rounding may leave this much; or 0
  double dissipated = 0; ///< by friction, all symmetric copies [F L]
  int descents = 0;      ///< iterations whose tangent was not positive definite
  std::optional<EnergyBalance> energy = {};
};

/// The last two residual reductions r[n-1]/r[n-2], r[n]/r[n-1], and the order of convergence they show:
/// log of the second over log of the first. NaN with fewer than three residuals.
struct Convergence {
  double before = 0, last = 0, order = 0;
};
Convergence convergence(const std::vector<double>& residuals);

/// Did Newton's iteration end quadratically? r[n] <= r[n-1]^2 * constant, where residuals below `floor`
/// (rounding) count as reached.
bool quadratic(const std::vector<double>& residuals, double constant, double floor);

struct StepRecord {
  int step = 0; ///< from 1
  double value = 0;
  std::vector<IncrementRecord> increments;
  std::vector<std::string> cuts; ///< why the step was cut
  double motion = 0;             ///< of the rigid master, from where the scene puts it
  double approach = 0;           ///< the same since first touch
  double force = 0;              ///< on the rigid master, all symmetric copies
  double mean_pressure = 0;      ///< force / slave area
  double contact_fraction = 0;   ///< area of closed nodes / slave area
  AreaEstimate area;             ///< the same without the error of counting nodes
  double peak_pressure = 0, mean_gap = 0;
  double mean_cubed_gap = 0; ///< <g^3> over the slave surface, penetrations as 0
  double conductance = 0;    ///< h_c / k_s [1/L], see incremental_conductance(); 0: not asked for
  double worn_slave = 0, worn_master = 0,
         worn_depth = 0;             ///< volumes, all symmetric copies; deepest slave [L]
  double penetration = 0;            ///< largest |gap| of a node that carries pressure [L]
  std::vector<double> contact_force; ///< [d] of the slave nodes on the master, all symmetric copies
  ents_resultants resultants{};      ///< of this mesh
  double dissipated = 0, heat = 0;   ///< by friction, all symmetric copies [F L]; power of it that is heat
  std::vector<double> moment;        ///< [3], 2D [1] of these about a rigid body's reference point; or empty
  std::vector<double> body_moved;    ///< displacement and turns of a rigid body, [6], 2D [3]; or empty
  std::vector<double> body_rotation; ///< [d][d] row by row, its columns are the body's axes; or empty
  std::vector<Quantity> exact;
  std::vector<double> exact_pressure; ///< [slaves] of boundary elements; or empty
  ContactFields fields;
  // Slave points may be others in the next step.
  std::vector<double> positions, places; ///< [slaves][d] current; in the reference configuration
  std::vector<double> areas;             ///< [slaves]
  double wall_time = 0;

  int iterations() const;
  /// Of its increments together; empty: not known.
  std::optional<EnergyBalance> energy() const;
};

/// Where the run tells what it does; empty functions say nothing.
struct RunObserver {
  std::function<void(const std::string&)> line;
  std::function<void(const Simulation&, const StepRecord&)> step_done;
};

/// How the steps are taken, and what is tried and thrown away on the way: the results must not change by a
/// bit.
struct StepPlan {
  enum class Cut {
    none,   ///< each step in one increment
    halves, ///< each in two
    random, ///< each in one to four of random sizes
  };
  Cut cut = Cut::none;
  unsigned seed = 1; ///< of the random sizes, and of what is thrown away
  bool discard =
      false; ///< try the whole step (random: now and then, one to three other parts) before each increment
  int first = 1; ///< continue a run here: earlier steps are those of a checkpoint
  int last = 0;  ///< 0: the scene's last
};

/// A step that cannot be cut any further, or has no way to begin. What was solved before it is kept, and the
/// simulation stands where the last of these steps ended.
struct StepFailure : JobError {
  StepFailure(int failed, const std::string& message, std::vector<StepRecord> before)
      : JobError(message), step(failed), solved(std::move(before)) {}
  int step;
  std::vector<StepRecord> solved;
};

/// Solve all steps, cutting those that fail.
/// @throws StepFailure
std::vector<StepRecord> solve(Simulation& simulation, const RunObserver& observer, const StepPlan& plan = {});

/// The state of the slave surface, for the exact solutions.
SurfaceState surface_state(Simulation& simulation, const StepRecord& record);

/// What the last accepted increment left on the slave surface, beside its exact solution.
void fill_contact_results(Simulation& simulation, StepRecord& record);

/// Of a sine, beside its other exact quantities
void add_exact_conductance(const Scene& scene, StepRecord& record);

} // namespace host
