// SPDX-License-Identifier: BSD-3-Clause
// A scene as a system of equations: displacements of the bodies, motion of the rigid master, and the load.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bulk.hpp"
#include "configuration.hpp"
#include "contact.hpp"
#include "exact.hpp"
#include "exact_layer.hpp"
#include "removed_waves.hpp"
#include "resolution.hpp"
#include "scene.hpp"
#include "sparse_system.hpp"
#include "toolbox/solver.hpp"

namespace host {

class LayerBody;

/// Wall time by activity [s].
struct Timings {
  double setup = 0;   ///< mesh, equations, pattern, symbolic factorisation
  double bulk = 0;    ///< assembly of the bulk elements
  double contact = 0; ///< search and contact elements
  double contact_cpu =
      0;             ///< the same as time of the processor: what other programs do meanwhile does not count
  double solver = 0; ///< numerical factorisation and solution
  double total = 0;
};

/// Sizes of the problem.
struct Sizes {
  std::size_t nodes = 0, elements = 0, dofs = 0, equations = 0;
  std::size_t slaves = 0, master_segments = 0;
  std::size_t master_dofs = 0; ///< coordinates of distinct master nodes
};

/// What an increment aims at.
struct Target {
  double value = 0; ///< of the scene's control
  double load_factor = 0;
  std::vector<double> parameters = {}; ///< of the contact model, see Configuration
  double duration = 1;                 ///< time that the increment takes
  bool may_jump =
      true; ///< false: an increment in which surfaces jump fails, and is looked at in smaller parts
};

/// Uzawa: one solution with given multipliers.
struct Augmentation {
  double error = 0;   ///< largest change of a multiplier over the stiffness: penetration or elastic slip [L]
  int iterations = 0; ///< of Newton, after the change
};

/// The energies of an increment of a scene whose law pulls, all symmetric copies [F L]: the work of the master's motion,
/// of supports and loads (trapezoidal rule) goes into what is stored and dissipated, or is lost in jumps.
struct EnergyBalance {
  double work = 0, stored = 0, dissipated = 0;
  double uncertainty = 0; ///< of the work: forces within those at the begin and at the end
  bool jumped = false;    ///< surfaces jumped together or apart
  bool gained =
      false; ///< more is stored than any work explains: the increment is too large to follow the surfaces

  double lost() const { return work - stored - dissipated; }
};

struct NewtonOutcome {
  bool converged = false;
  std::vector<double>
      residuals; ///< relative to the forces present, after each iteration; Uzawa: before the first change
  std::vector<int> status_changes; ///< of slave nodes, at each iteration against the one before
  std::vector<Augmentation> augmentations;
  std::string reason;                ///< why it failed
  std::string advice;                ///< what to look at, if smaller steps will not help
  double step_factor = 0.5;          ///< suggested for the next try; 0: a smaller step does not help
  bool line_search_may_help = false; ///< the iteration diverged, or met what cannot be evaluated
  int halvings = 0;                  ///< of steps by the line search
  int descents = 0; ///< iterations whose tangent was not positive definite, so that a part was left out of it
  double dissipated = 0;               ///< by friction, all symmetric copies [F L]
  std::optional<EnergyBalance> energy; ///< empty: the law does not pull, or its parameters change
  /// The residual is above the tolerance and all rounding, which may leave this much of it; 0: it is below.
  double rounding = 0;
};

class Simulation {
public:
  /// @param library   may be null if the scene has no contact
  /// @param divisions of the explicit mesh that replaces the enriched segment; 0: the scene as it is
  /// @param maker     of the master instead, if not empty
  /// @throws InputError, JobError
  Simulation(const Scene& scene, const EntsLibrary* library, int divisions = 0,
             const MasterMaker& maker = {});

  const Scene& scene() const { return *scene_; }
  const Mesh& mesh() const { return mesh_; }
  const Bulk& bulk() const { return *bulk_; }
  const DofMap& dofs() const { return *dofs_; }
  Contact* contact() { return contact_.get(); }
  const Contact* contact() const { return contact_.get(); }
  /// Of the scene's exact solution.
  const ExactAxis& exact_axis() const { return exact_axis_; }
  /// Is the slave mesh fine enough for the height of a rigid master?
  const Resolution& resolution() const { return resolution_; }
  /// Boundary elements, if they are the scene's exact solution and the master is the scene's own; else null.
  /// Null: the height is the scene's.
  const RemovedWaves* removed_waves() const { return removed_waves_.get(); }
  const ExactLayer* exact_layer() const { return exact_layer_.get(); }
  const Configuration& now() const { return now_; }
  Sizes sizes() const;
  const Timings& timings() const { return timings_; }
  std::string solver_name() const { return solver_->name(); }

  /// Motion at which the master of the scene touches, before anything has deformed or worn: from there
  /// approaches are measured.
  double first_touch() const { return first_touch_; }

  /// Solve for the target, starting from the present configuration, which moves only on success.
  /// @param keep  false: throw the solution away; nothing that later increments see has changed
  NewtonOutcome advance(const Target& target, bool keep = true);

  /// The configuration and the contact's history as JSON that reads back to the same bits, and back.
  Json checkpoint() const;
  /// @throws InputError if the checkpoint is of another scene, or damaged
  void restore(const Json& checkpoint);
  /// A number that differs whenever a node of the mesh or an element does (FNV-1a, hexadecimal).
  std::string mesh_fingerprint() const;
  /// A number that differs whenever a bit of the configuration or the history does (FNV-1a, hexadecimal).
  std::string fingerprint() const;

  /// Dead loads at the present load factor, [dofs].
  std::vector<double> loads(double load_factor) const;

  /// Total area of the slave surface in this mesh.
  double contact_area() const { return contact_ ? contact_->total_area() : 0; }

  /// Forces of the bodies and the contact together, [dofs]: reactions at prescribed dofs, zero elsewhere.
  std::vector<double> reactions();

private:
  struct Evaluation {
    std::vector<double> residual; ///< [dofs]
    RigidCoupling coupling;
    double force_scale = 0; ///< norm of the forces present: contact, loads, reactions
    /// Where the law pulls: of bodies, springs and contact [F L]; with the loads' and the prescribed force's, which the
    /// unknowns make smallest; sum of the sizes of its parts
    double stored = 0, dissipated = 0, potential = 0, potential_size = 0;
    bool ok = false;
    std::string reason, advice; ///< as of NewtonOutcome
    double step_factor = 0.5;
  };
  /// What one solution of the linear equations moves.
  struct Increment {
    Eigen::VectorXd unknowns;
    double motion = 0; ///< of the rigid master
  };
  /// Where the tangent was that the solver holds factors of: a checkpoint has it, for a run that goes on from
  /// there to make the same ones.
  struct Factored {
    Configuration at;
    ElementStart contact;
  };

  void build_mesh();
  void build_equations();
  void build_contact(const EntsLibrary* library, int divisions, const MasterMaker& maker);
  void build_pattern();
  double find_first_touch();
  class Attempt;
  /// What a line search makes smaller.
  enum class Search {
    none,
    residual,
    energy,
    work, ///< of the residual along the step (trapezoidal rule): the energy, where friction has none
  };
  NewtonOutcome attempt(const Target& target, bool keep, bool extrapolate, Search search);
  /// Unknowns are the displacements, then the multipliers; -1 for a prescribed one.
  int equation(std::size_t unknown) const {
    const auto dofs = static_cast<std::size_t>(dofs_->dofs());
    return unknown < dofs ? dofs_->equation(unknown) : dofs_->size() + static_cast<int>(unknown - dofs);
  }
  int equations() const {
    return dofs_->size() + (contact_ ? static_cast<int>(contact_->multiplier_count()) : 0);
  }
  /// Segments for the configuration, and the pattern that goes with them. False: see `reason`, cut the step.
  bool choose(const Configuration& at, bool only_lost, std::string& reason, double& step_factor);
  /// Residual of each equation; those of multipliers as forces.
  Eigen::VectorXd residual_of_equations(const Evaluation& at) const;
  double relative_residual(const Evaluation& at) const;
  /// What rounding makes of the forces of bodies without stress: a strain of some epsilon times the stiffness
  /// of all nodes [F].
  double rounding_of_forces() const;
  /// What rounding may leave of the residual of the last `evaluate`, and of the force on the master.
  struct Rounding {
    double residual = 0, force = 0; ///< norm [F]; [F]
  };
  /// @param where  of the evaluation
  Rounding rounding_of_residual(const Evaluation& at, const Configuration& where) const;
  Evaluation evaluate(const Configuration& at, const std::vector<double>& direction, bool want_tangent);
  /// Energies of an evaluation, but for the bodies' that have elements.
  void add_energies(const Configuration& at, Evaluation& result) const;
  /// Of the increment from `last_` to `end`. Empty: its begin is not known.
  std::optional<EnergyBalance> balance(const Evaluation& end, const Configuration& to) const;
  /// By `step`, the first-order change of the potential.
  double slope(const Evaluation& at, double force_error, const Increment& step) const;
  /// Prescribed displacements for a load factor and a force on the master, other dofs as in `displacement`.
  void prescribe(Configuration& at) const;
  /// Displacement of a dof by the turn of its support.
  double turned(const SupportSpec& support, std::size_t dof, const Configuration& at) const;
  /// A body that only contact can hold, and nothing touches: no step of any size can be solved. Empty: that
  /// is not it.
  /// @param begin  where the iteration began
  std::string nothing_holds(const Configuration& begin);
  /// Most tangents are singular because there is no contact to hold the master. Empty: that is not it.
  std::string advice_if_singular(const Configuration& at);
  /// Move the master until it touches: Newton's iteration for a given force needs a contact to start from.
  void find_contact(Configuration& at);
  /// Does any slave node carry pressure?
  bool touches(const Configuration& at);
  bool force_controlled() const;
  /// Do the factors that an increment leaves serve the first guess of the next one?
  bool keeps_factors() const;
  /// The tangent that was just evaluated there is factorized now.
  void note_factors(const Configuration& at);
  Json factors_json() const;
  /// @throws InputError if they are those of another scene
  /// @param now,history  of the checkpoint
  std::optional<Factored> read_factors(const JsonValue& json, const Configuration& now,
                                       const ContactHistory& history) const;
  /// For what comes before a history is restored. @return false: this scene refuses it
  bool factorize_again(const Factored& where);
  /// @param factorize  false: the factors at hand will do
  bool solve(const Evaluation& at, bool factorize, double motion_step, double force_error, Increment& step);
  /// The same without a step of the motion; where the tangent is not positive definite what makes it so is left out of
  /// the contact elements' part, so that the step descends the potential.
  /// @param left_out  was something?
  bool solve_downhill(Evaluation& at, double force_error, Increment& step, bool& left_out);
  void move(Configuration& at, const Increment& step, double share) const;

  const Scene* scene_;
  Mesh mesh_;
  std::unique_ptr<DofMap> dofs_;
  std::unique_ptr<Bulk> bulk_;
  std::shared_ptr<const LayerBody> layer_; ///< null: the bodies have elements
  std::unique_ptr<Contact> contact_;
  ExactAxis exact_axis_;
  Resolution resolution_;
  std::shared_ptr<const RemovedWaves> removed_waves_;
  std::shared_ptr<const ExactLayer> exact_layer_;
  std::vector<StencilGroup> bulk_stencils_;
  std::unique_ptr<SparseSystem> system_;
  std::unique_ptr<LinearSolver> solver_;
  std::vector<double> bulk_values_;  ///< tangent of a linear bulk
  bool factors_fit_ = false;         ///< the solver holds factors of a tangent close to the present one
  std::optional<Factored> factored_; ///< empty: no factors, or none that are used again
  struct Prescribed {
    std::size_t dof;
    double value;
    const Path* path;
    const SupportSpec* turns; ///< its node turns about a point, too; null: it does not
  };
  struct Load {
    std::vector<double> force; ///< [dofs] at factor 1
    const Path* path;
  };
  std::vector<Prescribed> prescribed_;
  std::vector<double> half_space_; ///< [dofs] per force of all copies, or empty
  std::vector<Load> loads_;
  std::vector<double> springs_; ///< [dofs] stiffness against the ground, or empty
  Configuration now_;
  std::optional<Evaluation> last_; ///< at `now_`, where the law pulls; empty: not known
  double first_touch_ = 0;
  std::vector<double>
      rate_; ///< [dofs] displacement per load factor in the last increment; empty: not known, not wanted
  Timings timings_;
};

} // namespace host
