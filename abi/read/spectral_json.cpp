// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/spectral_json.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "abi/read/json_check.hpp"
#include "abi/read/json_tree.hpp"
#include "abi/read/model_error.hpp"
#include "core/height/expression.hpp"
#include "core/height/roughness.hpp"
#include "core/numbers/transcendental.hpp"

namespace ents {

namespace {

using nlohmann::json;

constexpr std::size_t most_waves = 1024;
constexpr std::int64_t most_samples[2] = {std::int64_t{1} << 20,
                                          2048}; // of a profile, of a surface per coordinate
constexpr double per_shortest = 8.0;             // samples, unless the text says how many

std::vector<double> read_surface_vector(const json& value, const std::string& path, const char* key,
                                        const HeightSources& sources, Range range) {
  return read_vector(value.at(key), member(path, key), static_cast<std::size_t>(sources.dimension), range,
                     per_coordinate);
}

double read_within(const json& value, const std::string& path, const char* key, double low, double high) {
  const double number = read_double(value, path, key, Range::any);
  if (!(number >= low && number <= high))
    fail(ENTS_BAD_VALUE, member(path, key),
         "is " + shown(number) + "; write a number from " + shown(low) + " to " + shown(high));
  return number;
}

double read_whole(const json& value, const std::string& path, const char* key, double low, double high) {
  const double number = read_within(value, path, key, low, high);
  if (number != std::floor(number))
    fail(ENTS_BAD_VALUE, member(path, key), "is " + shown(number) + "; write a whole number");
  return number;
}

// cut_off 0: none
bool is_shorter(const std::vector<double>& wave_vector, double cut_off) {
  double squared = 0.0;
  for (const double k : wave_vector) squared += (k * cut_off) * (k * cut_off);
  return squared > 1.0 + 2e-12; // one of exactly that length stays
}

[[noreturn]] void fail_without_waves(const std::string& path) {
  fail(ENTS_BAD_VALUE, member(path, "cut_off"),
       "is longer than all waves; write the length of the shortest wave that stays");
}

constexpr double largest_seed = 9007199254740992.0; // 2^53: whole numbers up to it are doubles

} // namespace

Height read_roughness(const json& value, const std::string& path, const HeightSources& sources) {
  check_keys(value, path, {"type", "seed", "rms", "hurst", "wavelengths", "size"}, {"samples", "cut_off"});
  Roughness r;
  r.dimension = sources.dimension;
  r.seed = static_cast<std::uint64_t>(read_whole(value, path, "seed", 0.0, largest_seed));
  r.rms = read_double(value, path, "rms", Range::positive);
  r.hurst = read_within(value, path, "hurst", 0.0, 1.0);
  const std::vector<double> lengths =
      read_vector(value.at("wavelengths"), member(path, "wavelengths"), 3, Range::positive,
                  "the shortest wavelength, the one from which on longer ones have equal power, the longest");
  r.shortest = lengths[0], r.roll_off = lengths[1], r.longest = lengths[2];
  if (!(r.shortest <= r.roll_off && r.roll_off <= r.longest))
    fail(ENTS_BAD_VALUE, member(path, "wavelengths"),
         "are not in order; write the shortest, the one of the roll-off, the longest");
  r.cut_off = read_double_or(value, path, "cut_off", Range::positive, 0.0);
  const std::vector<double> size = read_surface_vector(value, path, "size", sources, Range::positive);
  std::vector<double> samples;
  if (value.contains("samples"))
    samples = read_surface_vector(value, path, "samples", sources, Range::positive);
  const std::int64_t most = most_samples[sources.dimension - 1];
  for (std::size_t a = 0; a < size.size(); ++a) {
    r.size[a] = size[a];
    const double waves = size[a] / r.shortest;
    r.samples[a] = power_of_two_above(samples.empty() ? per_shortest * waves : samples[a]);
    if (!samples.empty() && samples[a] != static_cast<double>(r.samples[a]))
      fail(ENTS_BAD_VALUE, member(path, "samples"), "has " + shown(samples[a]) + ", not a power of two");
    if (!samples.empty() && samples[a] < 4.0 * waves)
      fail(ENTS_BAD_VALUE, member(path, "samples"),
           "has " + shown(samples[a]) + "; the shortest wavelength has at least 4 samples: write " +
               shown(static_cast<double>(power_of_two_above(4.0 * waves))) + " or more");
    if (r.samples[a] > most)
      fail(ENTS_BAD_VALUE, path,
           "needs " + shown(static_cast<double>(r.samples[a])) +
               " samples along a surface coordinate of the period, at most " +
               shown(static_cast<double>(most)) +
               " are possible; make \"size\" smaller or the shortest wavelength longer");
  }
  const HeightMap map = rough_map(r);
  if (r.cut_off > r.longest) fail_without_waves(path);
  if (map.values.empty())
    fail(ENTS_BAD_VALUE, member(path, "wavelengths"),
         "have no wave of the period between them; waves have a whole number of lengths in \"size\"");
  return Height::map(map);
}

Height read_fourier(const json& value, const std::string& path, const HeightSources& sources) {
  check_keys(value, path, {"type", "wave_vectors", "amplitudes"}, {"phases", "cut_off"});
  const json& vectors = value.at("wave_vectors");
  const std::string at = member(path, "wave_vectors");
  check_array(vectors, at, most_waves, "wave vectors");
  const auto each = [&](const char* key) {
    return read_vector(value.at(key), member(path, key), vectors.size(), Range::any, "one per wave vector");
  };
  const std::vector<double> amplitudes = each("amplitudes");
  std::vector<double> phases(vectors.size(), 0.0);
  if (value.contains("phases")) phases = each("phases");
  const double cut_off = read_double_or(value, path, "cut_off", Range::positive, 0.0);
  std::vector<Height> waves;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const std::vector<double> wave = read_vector(
        vectors[i], item(at, i), static_cast<std::size_t>(sources.dimension), Range::any, per_coordinate);
    if (!is_shorter(wave, cut_off))
      waves.push_back(Height::sine(amplitudes[i], wave, phases[i] + 0.5 * std::numbers::pi));
  }
  if (waves.empty()) fail_without_waves(path);
  return waves.size() == 1 ? std::move(waves[0]) : Height::sum(std::move(waves));
}

Height read_weierstrass(const json& value, const std::string& path, const HeightSources& sources) {
  check_keys(value, path, {"type", "amplitude", "wave_vector", "hurst", "terms"},
             {"ratio", "seed", "cut_off"});
  const double amplitude = read_double(value, path, "amplitude", Range::any);
  const std::vector<double> first = read_surface_vector(value, path, "wave_vector", sources, Range::any);
  const double hurst = read_within(value, path, "hurst", 0.0, 1.0),
               terms = read_whole(value, path, "terms", 1.0, 64.0);
  const double ratio = value.contains("ratio") ? read_within(value, path, "ratio", 1.01, 100.0) : 1.5;
  const bool random = value.contains("seed");
  const auto seed =
      random ? static_cast<std::uint64_t>(read_whole(value, path, "seed", 0.0, largest_seed)) : 0;
  const double cut_off = read_double_or(value, path, "cut_off", Range::positive, 0.0);
  std::vector<Height> waves;
  double factor = 1.0; // ratio^i
  for (int i = 0; i < static_cast<int>(terms); ++i, factor *= ratio) {
    std::vector<double> vector = first;
    for (double& k : vector) k *= factor;
    if (is_shorter(vector, cut_off)) break;
    const double phase = random ? 2.0 * std::numbers::pi * random_phase(seed, i, 0) : 0.0;
    waves.push_back(Height::sine(amplitude * portable::exponential(-hurst * portable::logarithm(factor)),
                                 vector, phase + 0.5 * std::numbers::pi));
  }
  if (waves.empty()) fail_without_waves(path);
  return waves.size() == 1 ? std::move(waves[0]) : Height::sum(std::move(waves));
}

Height read_window(const json& value, const std::string& path, const HeightSources& sources, Height of) {
  const std::vector<double> low = read_surface_vector(value, path, "low", sources, Range::any),
                            high = read_surface_vector(value, path, "high", sources, Range::any);
  ExpressionBuilder builder(sources.dimension, {});
  int product = builder.number(1.0);
  for (int a = 0; a < sources.dimension; ++a) {
    const double from = low[static_cast<std::size_t>(a)], to = high[static_cast<std::size_t>(a)];
    if (!(to - from >= 1e-100))
      fail(ENTS_BAD_VALUE, member(path, "high"), "is not above \"low\" in each surface coordinate");
    const int off = builder.subtract(builder.coordinate(a), builder.number(0.5 * (from + to)));
    product =
        builder.multiply(product, builder.bump(builder.multiply(builder.number(2.0 / (to - from)), off), 4));
  }
  std::vector<Height> factors;
  factors.push_back(std::move(of));
  factors.emplace_back(sources.dimension);
  const double estimated[2] = {Height::unbounded, Height::unbounded};
  ExpressionBuilder::TooLong too_long;
  builder.finish(product, estimated, factors[1], too_long);
  return Height::product(std::move(factors));
}

} // namespace ents
