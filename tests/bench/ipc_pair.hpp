// The IPC Toolkit's own contact: a vertex before a triangle or, in the plane, before an edge, from its
// sources.
#pragma once

#include <memory>
#include <vector>

namespace bench {

// Clamped log barrier of the squared distance, smoothed Coulomb friction; node order: slave, master 1 .. d.
// The distance has no side: a slave node behind the surface is a vertex as far before it.
class IpcPair {
public:
  static bool available(); // was this program built with the toolkit's sources?

  // Barriers act below this distance; pairs slide from this speed on, sliding length per unit of time
  static constexpr double barrier_distance = 0.1, sliding_speed = 0.01;

  // slave [d], master [d][d], d = dimension; slip [d]: velocity of the slave node, the master's is zero
  IpcPair(int dimension, const double* slave, const double* master, double area, double stiffness,
          const double* slip, double coefficient);
  ~IpcPair();
  IpcPair(IpcPair&&) noexcept;

  // What its solvers evaluate; results are thrown away.
  void barrier() const;                // BarrierPotential: gradient, hessian
  void friction_force() const;         // FrictionPotential: force
  void jacobian_by_velocities() const; // force_jacobian
  void jacobian_by_displacements() const;
  void lagged_friction() const; // FrictionPotential: gradient, hessian

  // The same results. Hessian: column by column
  std::vector<double> barrier_gradient() const, barrier_hessian() const, friction() const;

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

} // namespace bench
