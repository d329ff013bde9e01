// SPDX-License-Identifier: BSD-3-Clause
// The equations of a scene: bodies, supports, loads and contact; one linear solution.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bulk.hpp"
#include "contact.hpp"
#include "heat.hpp"
#include "scene.hpp"
#include "toolbox/solver.hpp"

namespace host {

class Equations {
public:
  /// @throws InputError where sets of the scene are not in the mesh, or nothing holds the bodies
  explicit Equations(const Scene& scene);

  const Scene& scene() const { return *scene_; }
  const Mesh& mesh() const { return mesh_; }
  const Bulk& bulk() const { return *bulk_; }
  /// Dofs: the displacements node by node, then the temperatures.
  std::size_t dofs() const { return equation_.size(); }
  int size() const { return size_; }            ///< number of equations
  Contact* contact() { return contact_.get(); } ///< null: the scene has none
  double slave_area() const;
  std::string solver_name() const { return solver_->name(); }

  /// Displacements of the supports at the configuration's load factor.
  void prescribe(Configuration& at) const;

  /// Find the segments, which the tangent's entries depend on. @return not ok: cut the increment
  Outcome search(const Configuration& at);

  /// Residual and tangent; the tangent stays in this object.
  struct State {
    Outcome outcome;
    std::vector<double> residual; ///< [dofs] of all nodes: reactions where displacements are prescribed
    Coupling coupling;            ///< with a rigid master
    double size = 0;              ///< of the forces present
    double power = 0;             ///< of the flows of heat present
  };
  /// @param jump  [dofs] or empty: adds tangent * jump to the residual, for displacements that are prescribed anew
  State evaluate(const Configuration& at, const std::vector<double>& jump = {});

  /// Norm of the residual over the size of the forces; with a prescribed force that one, too.
  double relative_residual(const State& state, const Configuration& at) const;

  /// A step of Newton's iteration from `state`: `at` is moved.
  /// @param motion_step  of the rigid master, prescribed (control "approach"); else 0
  /// @return false if the tangent is singular
  bool solve(const State& state, double motion_step, Configuration& at);

private:
  void build_mesh();
  void hold_and_load();
  void add_element(const ElementTangent& element);
  void add_contact(const SparseMatrix& tangent);

  const Scene* scene_;
  Mesh mesh_;
  std::unique_ptr<Bulk> bulk_;
  std::unique_ptr<Heat> heat_; ///< null: there are no temperatures
  std::unique_ptr<Contact> contact_;
  struct Prescribed {
    std::size_t dof;
    double value; ///< of a temperature: its change
    const Path* path;
  };
  std::vector<Prescribed> prescribed_;
  struct Load {
    std::vector<double> force; ///< [dofs]
    const Path* path;
  };
  std::vector<Load> loads_;
  std::vector<int> equation_; ///< [dofs] -1: prescribed
  int size_ = 0;
  bool symmetric_ = false;                           ///< the tangent: its lower triangle is enough
  std::vector<Eigen::Triplet<double, int>> entries_; ///< that the tangent is the sum of
  SparseMatrix tangent_;
  std::unique_ptr<LinearSolver> solver_;
  bool analyzed_ = false; ///< the solver knows where the tangent has entries
};

} // namespace host
