// SPDX-License-Identifier: BSD-3-Clause
// Numbers out of a fuzzer's bytes: sensible ones, so that calls get somewhere, and now and then any bits at
// all.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace fuzz {

class Bytes {
public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  std::uint8_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }
  int below(int n) { return byte() % n; }
  double number() {
    const std::uint8_t kind = byte();
    if (kind >= 8) return (kind - 132) / 64.0 + byte() / 16384.0; // about -2 .. 2
    if (kind >= 2) return 0.0;
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    double out;
    std::memcpy(&out, &bits, sizeof out);
    return out;
  }
  // Mostly -1 .. n, now and then anything.
  std::int64_t index(int n) {
    const std::uint8_t kind = byte();
    if (kind >= 4) return kind % (n + 1) - (kind == 255 ? 2 : 0);
    std::int64_t out = 0;
    for (int i = 0; i < 8; ++i) out = out << 8 | byte();
    return out;
  }

private:
  const std::uint8_t* data_;
  std::size_t left_;
};

inline void require(bool holds) {
  if (!holds) std::abort();
}

} // namespace fuzz
