// Random numbers that are the same everywhere (the distributions of <random> are not). splitmix64: Steele,
// Lea, Flood 2014.
#pragma once

#include <cstdint>

namespace mechanics {

class Random {
public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
  }
  bool coin() { return (bits() >> 63) != 0; }
  int below(int n) { return static_cast<int>((bits() >> 33) % static_cast<std::uint64_t>(n)); }

private:
  std::uint64_t state_;
};

} // namespace mechanics
