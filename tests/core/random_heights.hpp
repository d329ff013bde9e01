// SPDX-License-Identifier: BSD-3-Clause
// Random numbers, random maps, and lists of heights, which cannot be copied.
#pragma once

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "core/height/height.hpp"
#include "core/height/height_map.hpp"

namespace test {

class Random {
public:
  explicit Random(std::uint64_t seed = 1) : generator_(seed) {}
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }

private:
  std::mt19937_64 generator_;
};

inline ents::HeightMap random_map(std::int32_t dimension, ents::MapBoundary boundary, Random& random) {
  ents::HeightMap map;
  map.dimension = dimension;
  map.boundary = boundary;
  map.rows = dimension == 1 ? 1 : 6;
  map.columns = 7;
  map.origin[0] = -1.25;
  map.origin[1] = 0.5;
  map.size[0] = 3.5;
  map.size[1] = 2.75;
  for (std::int64_t k = 0; k < map.rows * map.columns; ++k) map.values.push_back(random(-1.0, 1.0));
  return map;
}

inline std::vector<ents::Height> list(ents::Height a, ents::Height b) {
  std::vector<ents::Height> parts;
  parts.push_back(std::move(a));
  parts.push_back(std::move(b));
  return parts;
}

} // namespace test
