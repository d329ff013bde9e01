// SPDX-License-Identifier: BSD-3-Clause
// Instantiates the kernels that only models with named parameters or fields need.
#include "core/element/parameter_kernels.hpp"

#include "core/element/parameter_rates.hpp"
#include "core/search/transfer.hpp"
#include "core/surface/basis.hpp"

namespace ents {

namespace {

using namespace ENTS_ISA;

template <class B>
Status coordinates_of_segment(const Plan& plan, const double* master, const double* surface_coordinates,
                              const double* xi, double* s, double& area_per_s) {
  constexpr int T = B::dim - 1;
  const double* c = surface_coordinates ? surface_coordinates : plan.surface_coordinates;
  double at[T], value[T], gradient[T][T];
  for (int a = 0; a < T; ++a) at[a] = xi[a];
  if (c) {
    coordinates_at<B>(c, at, value, gradient);
  } else {
    for (int t = 0; t < T; ++t) {
      value[t] = at[t];
      for (int a = 0; a < T; ++a) gradient[t][a] = t == a ? 1.0 : 0.0;
    }
  }
  double det = gradient[0][0];
  if constexpr (T == 2) det = gradient[0][0] * gradient[1][1] - gradient[0][1] * gradient[1][0];
  Geometry<B> g;
  g.set(master, master);
  g.surface_coordinates = c;
  g.height = nullptr;
  Projection<B, false> p;
  if (!evaluate_surface<1>(g, at, p.N, p.s) || det == 0.0) return Status::degenerate_segment;
  for (int t = 0; t < T; ++t) s[t] = value[t];
  area_per_s = p.s.area / absolute(det);
  return Status::ok;
}

template <class B>
constexpr ParameterKernels kernels_of{evaluate_parameter_rates<B>, coordinates_of_segment<B>};

} // namespace

const ParameterKernels& parameter_kernels(Basis basis) {
  switch (basis) {
  case Basis::line2:
    return kernels_of<Line2>;
  case Basis::line3:
    return kernels_of<Line3>;
  case Basis::catmull_rom4:
    return kernels_of<CatmullRom4>;
  case Basis::bspline4:
    return kernels_of<BSpline4>;
  case Basis::tri3:
    return kernels_of<Tri3>;
  case Basis::tri6:
    return kernels_of<Tri6>;
  case Basis::quad4:
    return kernels_of<Quad4>;
  case Basis::quad8:
    return kernels_of<Quad8>;
  case Basis::quad9:
    return kernels_of<Quad9>;
  case Basis::catmull_rom16:
    return kernels_of<CatmullRom16>;
  case Basis::bspline16:
    return kernels_of<BSpline16>;
  case Basis::bezier15:
    break;
  }
  return kernels_of<Bezier15>;
}

} // namespace ents
