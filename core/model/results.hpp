// SPDX-License-Identifier: BSD-3-Clause
// The arrays of an element, each listed once: the structs that carry them, their checks and copies are made
// from these tables.
#pragma once

#include <cstdint>

// X(field, size): inputs. Sizes in numbers, of d, t (surface coordinates), m (nodes of the master), states,
// multipliers and slave_values.
#define ENTS_BLOCK_INPUT_ARRAYS(X)                                                                           \
  X(slave, d)                                                                                                \
  X(master, m* d)                                                                                            \
  X(surface_coordinates, m* t)                                                                               \
  X(start, t)                                                                                                \
  X(area, 1)                                                                                                 \
  X(state_begin, states)                                                                                     \
  X(multiplier, multipliers)                                                                                 \
  X(slave_values, slave_values)
// Only elements with heat have these.
#define ENTS_HEAT_INPUT_ARRAYS(X)                                                                            \
  X(slave_temperature, 1)                                                                                    \
  X(master_temperature, m)
#define ENTS_INPUT_ARRAYS(X) ENTS_BLOCK_INPUT_ARRAYS(X) ENTS_HEAT_INPUT_ARRAYS(X)

// X(bit of `wanted`, its name in the C ABI and here, field, type, size): results. Sizes also of all (dofs), n
// (those of the nodes) and tangent (entries between the first and the last).
#define ENTS_FORCE_RESULTS(X)                                                                                \
  X(11, ENTS_RESIDUAL, residual, residual, double, all)                                                      \
  X(12, ENTS_TANGENT, tangent, tangent, double, tangent)
#define ENTS_OTHER_RESULTS(X)                                                                                \
  X(0, ENTS_XI, xi, xi, double, t)                                                                           \
  X(1, ENTS_GAP, gap, gap, double, 1)                                                                        \
  X(2, ENTS_NORMAL_GAP, normal_gap, normal_gap, double, 1)                                                   \
  X(3, ENTS_NORMAL, normal, normal, double, d)                                                               \
  X(4, ENTS_POINT, point, point, double, d)                                                                  \
  X(9, ENTS_ENERGY, energy, energy, double, 1)                                                               \
  X(10, ENTS_PRESSURE, pressure, pressure, double, 1)                                                        \
  X(13, ENTS_STATE, state, state_end, double, states)                                                        \
  X(14, ENTS_FLAGS, flags, flags, std::int32_t, 1)                                                           \
  X(15, ENTS_ITERATIONS, iterations, iterations, std::int32_t, 1)                                            \
  X(16, ENTS_TRACTION, traction, traction, double, d)                                                        \
  X(17, ENTS_SLIP, slip, slip, double, 1)                                                                    \
  X(18, ENTS_AGE, age, age, double, 1)                                                                       \
  X(19, ENTS_DISSIPATION, dissipation, dissipation, double, 1)                                               \
  X(20, ENTS_FRICTION_ENERGY, friction_energy, friction_energy, double, 1)
// Only the element kernel has these.
#define ENTS_VARIATION_RESULTS(X)                                                                            \
  X(5, ENTS_GAP_GRADIENT, gap_gradient, gap_gradient, double, n)                                             \
  X(6, ENTS_GAP_HESSIAN, gap_hessian, gap_hessian, double, n* n)                                             \
  X(7, ENTS_XI_GRADIENT, xi_gradient, xi_gradient, double, t* n)                                             \
  X(8, ENTS_XI_HESSIAN, xi_hessian, xi_hessian, double, t* n* n)
// Only elements with heat have these.
#define ENTS_HEAT_RESULTS(X) X(21, ENTS_HEAT, heat, heat, double, 2)
#define ENTS_BLOCK_RESULTS(X) ENTS_FORCE_RESULTS(X) ENTS_OTHER_RESULTS(X)
#define ENTS_RESULTS(X) ENTS_BLOCK_RESULTS(X) ENTS_VARIATION_RESULTS(X) ENTS_HEAT_RESULTS(X)

namespace ents {

// Bits of `wanted`, those of the C ABI.
namespace want {
enum : std::int32_t {
#define ENTS_BIT(bit, public_name, name, field, type, size) name = 1 << bit,
  ENTS_RESULTS(ENTS_BIT)
#undef ENTS_BIT
      all = (1 << 22) - 1,
  forces = residual | tangent,
  kinematics = gap_gradient | gap_hessian | xi_gradient | xi_hessian,
  block = all & ~(kinematics | heat), // what the kernels of many elements have
  needs_law = energy | pressure | residual | tangent | traction | slip | age | dissipation | friction_energy,
  element = needs_law | state,
};
} // namespace want

struct ElementInput {
#define ENTS_ARRAY(field, size) const double* field;
  ENTS_INPUT_ARRAYS(ENTS_ARRAY) // each but slave and master or null: see ents_input
#undef ENTS_ARRAY
  bool start_first = false;    // before the history's xi
  double time_increment = 0.0; // of heat, and of friction that depends on the slip rate
};

struct ElementOutput {
  std::int32_t wanted;
#define ENTS_ARRAY(bit, public_name, name, field, type, size) type* field;
  ENTS_RESULTS(ENTS_ARRAY)
#undef ENTS_ARRAY
  std::int64_t tangent_leading_dimension;
};

struct DeferredCopy; // streaming.hpp

// Elements `first` .. of a call for the kernels that take many at once. Strides and the leading dimension in
// numbers; arrays that are not wanted or not given are null.
struct ElementBlock {
  static constexpr std::int32_t most = 64;
#define ENTS_ARRAY(field, size) const double* field;
  ENTS_BLOCK_INPUT_ARRAYS(ENTS_ARRAY)
#undef ENTS_ARRAY
#define ENTS_STRIDE(field, size) std::int64_t field##_stride;
  ENTS_BLOCK_INPUT_ARRAYS(ENTS_STRIDE)
#undef ENTS_STRIDE
  std::int32_t wanted; // of want::block
#define ENTS_ARRAY(bit, public_name, name, field, type, size) type* field;
  ENTS_BLOCK_RESULTS(ENTS_ARRAY)
#undef ENTS_ARRAY
#define ENTS_STRIDE(bit, public_name, name, field, type, size) std::int64_t field##_stride;
  ENTS_BLOCK_RESULTS(ENTS_STRIDE)
#undef ENTS_STRIDE
  std::int64_t leading, first;
  double time_increment = 0.0; // see ElementInput
  bool start_first = false;
  // A block of one element may want results that no block has (`rest`): gradients and Hessians.
  const ElementInput* one = nullptr;
  const ElementOutput* rest = nullptr;
  DeferredCopy* last = nullptr; // results of the block before, still to be copied; or none
  // Of elements with heat
  const double *slave_temperature = nullptr, *master_temperature = nullptr;
  std::int64_t slave_temperature_stride = 0, master_temperature_stride = 0, heat_stride = 0;
  double* heat = nullptr;
};

// The same of one element. Its results beside those in `wanted` are the element kernel's.
inline ElementBlock block_of(const ElementInput& in, const ElementOutput& out, const double* start,
                             std::int32_t wanted) {
  ElementBlock b{};
#define ENTS_COPY(field, size) b.field = in.field;
  ENTS_BLOCK_INPUT_ARRAYS(ENTS_COPY)
#undef ENTS_COPY
  b.start = start, b.start_first = in.start_first;
  b.wanted = wanted;
#define ENTS_COPY(bit, public_name, name, field, type, size) b.field = out.field;
  ENTS_BLOCK_RESULTS(ENTS_COPY)
#undef ENTS_COPY
  b.slave_temperature = in.slave_temperature, b.master_temperature = in.master_temperature, b.heat = out.heat;
  b.leading = out.tangent_leading_dimension;
  b.time_increment = in.time_increment;
  return b;
}

} // namespace ents
