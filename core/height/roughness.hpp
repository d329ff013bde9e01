// SPDX-License-Identifier: BSD-3-Clause
// Periodic self-affine roughness: samples of a surface whose discrete spectrum is exactly the one asked for,
// with random phases.
//
// The wave vectors are those of the period, (i / size_1, j / size_2). The mean square of each is proportional
// to
//   1                              from the longest wavelength to roll_off,
//   (roll_off k)^-(2 hurst + T)    for shorter ones down to the shortest,
//   0                              beyond;
// T the number of surface coordinates: the profile's -(2 H + 1), the surface's -2 (H + 1) (Persson et al., J.
// Phys. Condens. Matter 17, R1, 2005). All of them together are rms^2.
#pragma once

#include <cstdint>

#include "core/height/height_map.hpp"

namespace ents {

struct Roughness {
  std::int32_t dimension = 1;
  std::uint64_t seed = 0;
  double rms = 0.0, hurst = 0.0;
  double shortest = 0.0, roll_off = 0.0, longest = 0.0; // wavelengths
  double cut_off = 0.0;                                 // shorter waves are left out; rms is that of all
  double size[2] = {0.0, 0.0};                          // period
  std::int64_t samples[2] = {1, 1};                     // powers of two, more than 2 size / shortest
};

// A number in 0 .. 1 that depends on the seed and the place alone: the phase of a wave, in turns.
double random_phase(std::uint64_t seed, std::int64_t i, std::int64_t j);

// Mean square of the wave (i, j) before all are scaled to rms: 0 outside the wavelengths. That of (-i, -j) is
// the same.
double relative_power(const Roughness& roughness, std::int64_t i, std::int64_t j);

// Smallest power of two that is at least `least`.
std::int64_t power_of_two_above(double least);

// The periodic map. Its bits are the same on all machines. Empty values: no wave of the period is between the
// wavelengths.
HeightMap rough_map(const Roughness& roughness);

} // namespace ents
