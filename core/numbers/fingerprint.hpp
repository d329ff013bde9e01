// SPDX-License-Identifier: BSD-3-Clause
// A number that differs, but for one chance in 2^52, between two sequences of numbers that differ (FNV-1a;
// Fowler, Noll, Vo 1991).
#pragma once

#include <bit>
#include <cstdint>

namespace ents {

class Fingerprint {
public:
  void add(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int shift = 0; shift < 64; shift += 8) hash_ = (hash_ ^ (bits >> shift & 0xff)) * 0x100000001b3u;
  }
  // A whole number, 1 .. 2^52: exact as a double.
  double number() const { return static_cast<double>((hash_ >> 12) + 1); }

private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

} // namespace ents
