// SPDX-License-Identifier: BSD-3-Clause
#include "core/height/roughness.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include "core/numbers/transcendental.hpp"

namespace ents {

namespace {

// Real and imaginary parts apart: GCC makes fused operations of complex products side by side, although it is
// told not to, where the instruction set has them, and bits would depend on it.
struct Complexes {
  std::vector<double> re, im;
  explicit Complexes(std::int64_t n) : re(index(n), 0.0), im(index(n), 0.0) {}
};

// exp(2 pi i k / n)
Complexes roots_of_one(std::int64_t n) {
  Complexes roots(n);
  for (std::int64_t k = 0; k < n; ++k)
    portable::sin_cos_turns(static_cast<double>(k) / static_cast<double>(n), 0.0, roots.im[index(k)],
                            roots.re[index(k)]);
  return roots;
}

// sum_k a[k] exp(2 pi i k j / n) in place (Cooley and Tukey 1965), of the n numbers from `from` on that are
// `apart`; n is a power of two.
void transform(Complexes& a, std::int64_t from, std::int64_t n, std::int64_t apart, const Complexes& roots) {
  double *re = a.re.data() + from, *im = a.im.data() + from;
  for (std::int64_t i = 1, j = 0; i < n; ++i) { // j: i with its bits in reverse
    std::int64_t bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(re[i * apart], re[j * apart]), std::swap(im[i * apart], im[j * apart]);
  }
  for (std::int64_t length = 2; length <= n; length *= 2)
    for (std::int64_t first = 0; first < n; first += length)
      for (std::int64_t k = 0; k < length / 2; ++k) {
        const std::int64_t low = (first + k) * apart, high = low + length / 2 * apart;
        const double c = roots.re[index(k * (n / length))], s = roots.im[index(k * (n / length))];
        const double turned_re = re[high] * c - im[high] * s, turned_im = re[high] * s + im[high] * c;
        re[high] = re[low] - turned_re, re[low] = re[low] + turned_re;
        im[high] = im[low] - turned_im, im[low] = im[low] + turned_im;
      }
}

} // namespace

double random_phase(std::uint64_t seed, std::int64_t i, std::int64_t j) {
  // The finaliser of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014) of a counter.
  const auto mixed = [](std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  };
  const std::uint64_t bits =
      mixed(mixed(mixed(seed) ^ static_cast<std::uint64_t>(i)) ^ static_cast<std::uint64_t>(j));
  return static_cast<double>(bits >> 11) * (1.0 / 9007199254740992.0);
}

// Of a wave that relative_power() has
static bool is_cut_off(const Roughness& r, std::int64_t i, std::int64_t j) {
  const double k1 = static_cast<double>(i) / r.size[0] * r.cut_off,
               k2 = r.dimension == 2 ? static_cast<double>(j) / r.size[1] * r.cut_off : 0.0;
  return k1 * k1 + k2 * k2 > 1.0 + 2e-12; // one of exactly that length stays
}

double relative_power(const Roughness& r, std::int64_t i, std::int64_t j) {
  const double k1 = static_cast<double>(i) / r.size[0],
               k2 = r.dimension == 2 ? static_cast<double>(j) / r.size[1] : 0.0;
  const double k = portable::square_root(k1 * k1 + k2 * k2);
  constexpr double rounding = 1e-12; // a wave of exactly the shortest or the longest length counts
  if (k * r.longest < 1.0 - rounding || k * r.shortest > 1.0 + rounding) return 0.0;
  if (k * r.roll_off <= 1.0) return 1.0;
  return portable::exponential(-(2.0 * r.hurst + r.dimension) * portable::logarithm(k * r.roll_off));
}

std::int64_t power_of_two_above(double least) {
  std::int64_t n = 1;
  while (static_cast<double>(n) < least && n < (std::int64_t{1} << 40)) n *= 2;
  return n;
}

HeightMap rough_map(const Roughness& r) {
  const std::int64_t n1 = r.samples[0], n2 = r.dimension == 2 ? r.samples[1] : 1;
  const auto most = [&](int a) { return static_cast<std::int64_t>(r.size[a] / r.shortest * (1.0 + 1e-9)); };
  const std::int64_t most_1 = most(0), most_2 = r.dimension == 2 ? most(1) : 0;
  double total = 0.0;
  for (std::int64_t j = -most_2; j <= most_2; ++j)
    for (std::int64_t i = -most_1; i <= most_1; ++i) total += relative_power(r, i, j);
  HeightMap map;
  map.dimension = r.dimension;
  map.boundary = MapBoundary::periodic;
  map.columns = n1, map.rows = n2;
  for (int a = 0; a < r.dimension; ++a) map.size[a] = r.size[a];
  if (!(total > 0.0)) return map;

  // c_k = sqrt(power / total) rms exp(2 pi i phase), c_-k its conjugate: sum |c_k|^2 = rms^2
  Complexes waves(n1 * n2);
  for (std::int64_t j = -most_2; j <= most_2; ++j)
    for (std::int64_t i = -most_1; i <= most_1; ++i) {
      const bool upper =
          j > 0 || (j == 0 && i > 0); // of a wave and its conjugate the one whose phase is drawn
      const double power = relative_power(r, i, j);
      if (power == 0.0 || is_cut_off(r, i, j)) continue;
      const double amplitude = r.rms * portable::square_root(power / total);
      double sine, cosine;
      portable::sin_cos_turns(upper ? random_phase(r.seed, i, j) : random_phase(r.seed, -i, -j), 0.0, sine,
                              cosine);
      const std::size_t at = index(((j + n2) % n2) * n1 + (i + n1) % n1);
      waves.re[at] = amplitude * cosine, waves.im[at] = upper ? amplitude * sine : -amplitude * sine;
    }
  const Complexes roots_1 = roots_of_one(n1), roots_2 = roots_of_one(n2);
  for (std::int64_t j = 0; j < n2; ++j) transform(waves, j * n1, n1, 1, roots_1);
  for (std::int64_t i = 0; i < n1; ++i) transform(waves, i, n2, n1, roots_2);
  map.values = std::move(waves.re);
  return map;
}

} // namespace ents
