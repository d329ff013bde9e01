// SPDX-License-Identifier: BSD-3-Clause
// A scene as a system of equations: displacements of the bodies, motion of the rigid master, and the load.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bulk.hpp"
#include "contact.hpp"
#include "scene.hpp"
#include "solver.hpp"

namespace host {

/// Wall time by activity [s].
struct Timings {
  double setup = 0;    ///< mesh, equations, pattern, symbolic factorisation
  double bulk = 0;     ///< assembly of the bulk elements
  double contact = 0;  ///< search and contact elements
  double solver = 0;   ///< numerical factorisation and solution
  double total = 0;
};

/// Sizes of the problem.
struct Sizes {
  std::size_t nodes = 0, elements = 0, dofs = 0, equations = 0;
  std::size_t slaves = 0, master_segments = 0;
  std::size_t master_dofs = 0; ///< coordinates of distinct master nodes
};

/// Where the system is.
struct Configuration {
  std::vector<double> displacement; ///< [dofs]
  double motion = 0;                ///< of the rigid master along its direction [L]
  double force = 0;                 ///< on the rigid master along its direction, this mesh's share [F]
  double load_factor = 0;           ///< of supports and tractions
};

/// What an increment aims at.
struct Target {
  double value = 0; ///< of the scene's control
  double load_factor = 0;
};

struct NewtonOutcome {
  bool converged = false;
  std::vector<double> residuals; ///< relative to the forces present, after each iteration
  std::vector<int> status_changes; ///< of slave nodes, at each iteration against the one before
  std::string reason;            ///< why it failed
  double step_factor = 0.5;      ///< suggested for the next try
};

class Simulation {
public:
  /// @param library   may be null if the scene has no contact
  /// @param divisions of the explicit mesh that replaces the enriched segment; 0: the scene as it is
  /// @throws InputError, JobError
  Simulation(const Scene& scene, const EntsLibrary* library, int divisions = 0);

  const Scene& scene() const { return *scene_; }
  const Mesh& mesh() const { return mesh_; }
  const Bulk& bulk() const { return *bulk_; }
  Contact* contact() { return contact_.get(); }
  const Configuration& now() const { return now_; }
  Sizes sizes() const;
  const Timings& timings() const { return timings_; }
  std::string solver_name() const { return solver_->name(); }

  /// Solve for the target, starting from the present configuration, which moves only on success.
  NewtonOutcome advance(const Target& target);

  /// Total area of the slave surface in this mesh.
  double contact_area() const { return contact_ ? contact_->total_area() : 0; }

  /// Forces of the bodies and the contact together, [dofs]: reactions at prescribed dofs, zero elsewhere.
  std::vector<double> reactions();

private:
  struct Evaluation {
    std::vector<double> residual; ///< [dofs]
    RigidCoupling coupling;
    double force_scale = 0; ///< norm of the forces present: contact, loads, reactions
    bool ok = false;
    std::string reason;
    double step_factor = 0.5;
  };

  void build_mesh();
  void build_equations();
  void build_contact(const EntsLibrary* library, int divisions);
  void build_pattern();
  Evaluation evaluate(const Configuration& at, const std::vector<double>& direction, bool want_tangent);
  /// Prescribed displacements for a load factor and a force on the master, other dofs as in `displacement`.
  void prescribe(Configuration& at) const;
  /// Move the master until it touches: Newton's iteration for a given force needs a contact to start from.
  void find_contact(Configuration& at);
  bool force_controlled() const;
  /// @param factorize  false: the factors at hand will do
  bool solve(const Evaluation& at, bool factorize, double motion_step, double force_error, Configuration& next);

  const Scene* scene_;
  Mesh mesh_;
  std::unique_ptr<DofMap> dofs_;
  std::unique_ptr<Bulk> bulk_;
  std::unique_ptr<Contact> contact_;
  std::vector<StencilGroup> bulk_stencils_;
  std::unique_ptr<SparseSystem> system_;
  std::unique_ptr<LinearSolver> solver_;
  std::vector<double> bulk_values_; ///< tangent of a linear bulk
  bool factors_fit_ = false;        ///< the solver holds factors of a tangent close to the present one
  std::vector<double> prescribed_;  ///< [dofs] per load factor
  std::vector<double> half_space_;  ///< [dofs] per force of all copies, or empty
  std::vector<double> loads_;       ///< [dofs] per load factor
  Configuration now_;
  Timings timings_;
};

} // namespace host
