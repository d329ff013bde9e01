#include "ipc_pair.hpp"

#ifdef ENTS_BENCH_IPC

#include <ipc/collisions/normal/edge_vertex.hpp>
#include <ipc/collisions/normal/face_vertex.hpp>
#include <ipc/collisions/tangential/face_vertex.hpp>
#include <ipc/potentials/barrier_potential.hpp>
#include <ipc/potentials/friction_potential.hpp>

#endif

namespace bench {

#ifdef ENTS_BENCH_IPC

bool IpcPair::available() { return true; }

namespace {

using Dofs = ipc::VectorMax12d;

template <typename Result> void keep(const Result& result) { asm volatile("" : : "r"(&result) : "memory"); }
template <typename Result> std::vector<double> entries(const Result& result) {
  return {result.data(), result.data() + result.size()};
}

} // namespace

struct IpcPair::Parts {
  Dofs positions, velocities, displacements;
  ipc::BarrierPotential barrier;
  ipc::FrictionPotential friction;
  std::unique_ptr<ipc::NormalCollision> pair;
  std::unique_ptr<ipc::FaceVertexTangentialCollision> sliding_pair; // in space

  auto force_jacobian(ipc::FrictionPotential::DiffWRT by) const {
    return friction.force_jacobian(*sliding_pair, positions, displacements, velocities, barrier, by);
  }
};

IpcPair::IpcPair(int dimension, const double* slave, const double* master, double area, double stiffness,
                 const double* slip, double coefficient) {
  const int d = dimension, dofs = d * (d + 1);
  parts_.reset(new Parts{Dofs(dofs), Dofs::Zero(dofs), Dofs::Zero(dofs),
                         ipc::BarrierPotential(barrier_distance, stiffness),
                         ipc::FrictionPotential(sliding_speed), nullptr, nullptr});
  Parts& p = *parts_;
  for (int i = 0; i < dofs; ++i) p.positions[i] = i < d ? slave[i] : master[i - d];
  for (int i = 0; i < d; ++i) p.velocities[i] = slip[i];
  if (d == 2) {
    p.pair = std::make_unique<ipc::EdgeVertexNormalCollision>(0, 0);
    p.pair->weight = area;
    return;
  }
  auto pair = std::make_unique<ipc::FaceVertexNormalCollision>(0, 0);
  pair->weight = area;
  p.sliding_pair = std::make_unique<ipc::FaceVertexTangentialCollision>(*pair, p.positions, p.barrier);
  p.sliding_pair->mu_s = p.sliding_pair->mu_k = coefficient;
  p.sliding_pair->mu_s_effective_lagged = p.sliding_pair->mu_k_effective_lagged = coefficient;
  p.pair = std::move(pair);
}

void IpcPair::barrier() const {
  keep(parts_->barrier.gradient(*parts_->pair, parts_->positions));
  keep(parts_->barrier.hessian(*parts_->pair, parts_->positions));
}

void IpcPair::friction_force() const {
  const Parts& p = *parts_;
  keep(p.friction.force(*p.sliding_pair, p.positions, p.displacements, p.velocities, p.barrier));
}

void IpcPair::jacobian_by_velocities() const {
  keep(parts_->force_jacobian(ipc::FrictionPotential::DiffWRT::VELOCITIES));
}

void IpcPair::jacobian_by_displacements() const {
  keep(parts_->force_jacobian(ipc::FrictionPotential::DiffWRT::LAGGED_DISPLACEMENTS));
}

void IpcPair::lagged_friction() const {
  keep(parts_->friction.gradient(*parts_->sliding_pair, parts_->velocities));
  keep(parts_->friction.hessian(*parts_->sliding_pair, parts_->velocities));
}

std::vector<double> IpcPair::barrier_gradient() const {
  return entries(parts_->barrier.gradient(*parts_->pair, parts_->positions));
}
std::vector<double> IpcPair::barrier_hessian() const {
  return entries(parts_->barrier.hessian(*parts_->pair, parts_->positions));
}
std::vector<double> IpcPair::friction() const {
  const Parts& p = *parts_;
  return entries(p.friction.force(*p.sliding_pair, p.positions, p.displacements, p.velocities, p.barrier));
}

#else

struct IpcPair::Parts {};

bool IpcPair::available() { return false; }
IpcPair::IpcPair(int, const double*, const double*, double, double, const double*, double) {}
void IpcPair::barrier() const {}
void IpcPair::friction_force() const {}
void IpcPair::jacobian_by_velocities() const {}
void IpcPair::jacobian_by_displacements() const {}
void IpcPair::lagged_friction() const {}
std::vector<double> IpcPair::barrier_gradient() const { return {}; }
std::vector<double> IpcPair::barrier_hessian() const { return {}; }
std::vector<double> IpcPair::friction() const { return {}; }

#endif

IpcPair::~IpcPair() = default;
IpcPair::IpcPair(IpcPair&&) noexcept = default;

} // namespace bench
