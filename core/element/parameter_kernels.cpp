// SPDX-License-Identifier: BSD-3-Clause
// Instantiates the kernels that only models with named parameters or fields need.
#include "core/element/parameter_kernels.hpp"

#include "core/element/parameter_rates.hpp"
#include "core/element/transfer.hpp"
#include "core/surface/counted_basis.hpp"

namespace ents {

namespace {

using namespace ENTS_ISA;

template <class B>
Status coordinates_of_segment(const Plan& plan, const double* master, const double* surface_coordinates,
                              const double* xi, double* s, double& area_per_s) {
  constexpr int T = B::dim - 1;
  const B basis = basis_of<B>(plan.basis);
  const double* c = surface_coordinates ? surface_coordinates : plan.surface_coordinates;
  double at[T], value[T], gradient[T][T];
  for (int a = 0; a < T; ++a) at[a] = xi[a];
  if (c) {
    coordinates_at(basis, c, at, value, gradient);
  } else {
    for (int t = 0; t < T; ++t) {
      value[t] = at[t];
      for (int a = 0; a < T; ++a) gradient[t][a] = t == a ? 1.0 : 0.0;
    }
  }
  double det = gradient[0][0];
  if constexpr (T == 2) det = gradient[0][0] * gradient[1][1] - gradient[0][1] * gradient[1][0];
  Geometry<B> g(basis);
  g.set(master, master);
  g.surface_coordinates = c;
  g.height = nullptr;
  Projection<B, false> p;
  if (!evaluate_surface<1>(g, at, p.N, p.s) || det == 0.0) return Status::degenerate_segment;
  for (int t = 0; t < T; ++t) s[t] = value[t];
  area_per_s = p.s.area / absolute(det);
  return Status::ok;
}

#define ENTS_BASIS(name, type, ...)                                                                          \
  {evaluate_parameter_rates<KernelBasis<type>>, coordinates_of_segment<KernelBasis<type>>},
constexpr ParameterKernels kernels[] = {ENTS_BASES(ENTS_BASIS)};
#undef ENTS_BASIS

} // namespace

const ParameterKernels& parameter_kernels(Basis basis) { return kernels[static_cast<std::int32_t>(basis)]; }

} // namespace ents
