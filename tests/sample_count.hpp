// SPDX-License-Identifier: BSD-3-Clause
// How many random samples a test takes.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace test {

// A sanitizer run looks for invalid reads and overflows, which the first elements of each kind show as well
// as the last; it takes a fiftieth. The figures of these tests are those of an ordinary build.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr std::int64_t sample_divisor = 50;
#else
inline constexpr std::int64_t sample_divisor = 1;
#endif
/// How many of `count` samples to take.
constexpr std::int64_t samples(std::int64_t count) { return (count + sample_divisor - 1) / sample_divisor; }

/// Is this one of the samples to take?
template <class Random> bool is_taken(Random& random) {
  return sample_divisor == 1 || random.below(static_cast<int>(sample_divisor)) == 0;
}

/// Sweeps over many kinds: with sanitizers one of `every` in turn is taken, else each.
class Turns {
public:
  explicit Turns(int every) : every_(sample_divisor == 1 ? 1 : every) {}
  bool take() { return at_++ % every_ == 0; }

private:
  int every_, at_ = 0;
};

/// The tests that take longest take a fifth of their samples in an ordinary build; with ENTS_TEST_SAMPLES=all in the
/// environment all of them.
inline std::int64_t long_divisor() {
  static const bool all = [] {
    const char* text = std::getenv("ENTS_TEST_SAMPLES");
    return text && std::string_view(text) == "all";
  }();
  return sample_divisor > 1 || all ? sample_divisor : 5;
}
inline std::int64_t long_samples(std::int64_t count) { return (count + long_divisor() - 1) / long_divisor(); }
template <class Random> bool is_long_taken(Random& random) {
  return long_divisor() == 1 || random.below(static_cast<int>(long_divisor())) == 0;
}

} // namespace test
