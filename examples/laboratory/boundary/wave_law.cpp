// SPDX-License-Identifier: BSD-3-Clause
#include "wave_law.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "hash.hpp"
#include "toolbox/error.hpp"

namespace host {
namespace {

constexpr int level_count = 16;
constexpr double highest = 1.5, lowest = 1e-3; // mean pressures over E* times the rms slope
constexpr double gap_of_full_contact = 1e-3;   // gap over the rms of the waves: full contact
constexpr double enough = 4e-4;                // error of gaps, of the height of the waves
constexpr int tail = 5;                        // points of the exponential end, one per factor e

/// ENTS_CACHE, else the user's folder of caches; empty: none is known.
std::filesystem::path folder() {
  if (const char* own = std::getenv("ENTS_CACHE")) return own;
  if (const char* users = std::getenv("XDG_CACHE_HOME"); users && *users)
    return std::filesystem::path(users) / "ents";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".cache" / "ents";
  return {};
}

/// Of all that the law of unit modulus depends on.
std::string hash_of(const Eigen::ArrayXXd& waves, const ElasticLayer& half_space) {
  Hash hash;
  const double numbers[] = {1, // version of the file
                            level_count,
                            highest,
                            lowest,
                            gap_of_full_contact,
                            enough,
                            half_space.length_x(),
                            half_space.length_y(),
                            static_cast<double>(waves.rows()),
                            static_cast<double>(waves.cols()),
                            static_cast<double>(half_space.grid())};
  hash.add(numbers, sizeof numbers);
  hash.add(waves.data(), static_cast<std::size_t>(waves.size()) * sizeof(double));
  return hash.text();
}

/// The bytes of a law of unit modulus, and their hash.
struct Bytes {
  std::string text;
  template <class T> void add(const T* values, std::size_t count) {
    text.append(reinterpret_cast<const char*>(values), count * sizeof(T));
  }
  std::string hash() const {
    Hash hash;
    hash.add(text.data(), text.size());
    return hash.text();
  }
};

void write(const WaveLaw& law, const std::filesystem::path& file) {
  Bytes bytes;
  for (const WaveLevel& level : law) {
    const double numbers[] = {level.pressure, level.gap, level.share, level.counted};
    bytes.add(numbers, 4);
    bytes.add(level.pressed.data(), static_cast<std::size_t>(level.pressed.size()));
  }
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  const std::filesystem::path part = file.string() + ".part";
  std::ofstream out(part, std::ios::binary);
  out << bytes.text << bytes.hash();
  out.close();
  if (out)
    std::filesystem::rename(part, file, error);
  else
    std::filesystem::remove(part, error);
}

/// @return empty: there is none, or it is damaged
WaveLaw read(const std::filesystem::path& file, Eigen::Index nx, Eigen::Index ny) {
  std::ifstream in(file, std::ios::binary);
  Bytes bytes;
  bytes.text.assign(std::istreambuf_iterator<char>(in), {});
  constexpr std::size_t hash_size = 16;
  const std::size_t cells = static_cast<std::size_t>(nx * ny) * sizeof(float),
                    size = 4 * sizeof(double) + cells;
  if (bytes.text.size() <= hash_size || (bytes.text.size() - hash_size) % size != 0) return {};
  const std::string hash = bytes.text.substr(bytes.text.size() - hash_size);
  bytes.text.resize(bytes.text.size() - hash_size);
  if (bytes.hash() != hash) return {};
  WaveLaw law;
  for (const char* at = bytes.text.data(); at != bytes.text.data() + bytes.text.size(); at += size) {
    double numbers[4];
    std::copy(at, at + sizeof numbers, reinterpret_cast<char*>(numbers));
    WaveLevel level{numbers[0], numbers[1], numbers[2], numbers[3], Eigen::ArrayXXf(nx, ny)};
    std::copy(at + sizeof numbers, at + size, reinterpret_cast<char*>(level.pressed.data()));
    law.push_back(std::move(level));
  }
  return law;
}

} // namespace

double rms_slope(const Eigen::ArrayXXd& z, double dx, double dy) {
  const Eigen::Index n = z.rows(), m = z.cols();
  const Eigen::ArrayXXd along = (z.bottomRows(n - 1) - z.topRows(n - 1)) / dx,
                        across = (z.rightCols(m - 1) - z.leftCols(m - 1)) / dy;
  return std::sqrt(along.square().mean() + across.square().mean());
}

WaveProgress progress_on_stderr(std::string what) {
  return [what = std::move(what), terminal = isatty(STDERR_FILENO) != 0](int done, int levels) {
    if (terminal || done == levels)
      std::fprintf(stderr, "%s: %d of %d pressures%s", what.c_str(), done, levels,
                   done == levels ? "\n" : "\r");
  };
}

Json law_table(std::vector<double> gap, std::vector<double> pressure) {
  const std::size_t n = gap.size();
  if (n < 2) throw JobError("boundary elements: all pressures are those of full contact");
  const double last = gap[n - 1], lowest_pressure = pressure[n - 1],
               length = (last - gap[n - 2]) / std::log(pressure[n - 2] / lowest_pressure);
  for (int i = 1; i <= tail; ++i) {
    gap.push_back(last + i * length);
    pressure.push_back(i < tail ? lowest_pressure * std::exp(-i) : 0);
  }
  return {{"type", "table"}, {"gap", gap}, {"pressure", pressure}};
}

ElasticLayer unit_half_space(Eigen::Index nx, Eigen::Index ny, double lx, double ly, Grid grid) {
  Material unit;
  unit.young = 1, unit.poisson = 0;
  return {nx, ny, lx, ly, std::numeric_limits<double>::infinity(), unit, grid};
}

WaveLaw press_waves(const Eigen::ArrayXXd& waves, const ElasticLayer& half_space, double modulus,
                    const WaveProgress& progress) {
  const double slope = rms_slope(waves, half_space.x(1) - half_space.x(0), half_space.y(1) - half_space.y(0)),
               rms = std::sqrt(waves.square().mean());
  WaveLaw law;
  Eigen::ArrayXXd start;
  for (int i = 0; i < level_count; ++i) {
    const double mean = slope * highest * std::pow(lowest / highest, i / (level_count - 1.));
    LayerContact found = half_space.press_with(mean, waves, 0, start.size() == 0 ? nullptr : &start, enough);
    // Full contact is left out: its gap says nothing of the pressure.
    if (!law.empty() && law.back().gap < gap_of_full_contact * rms) law.pop_back();
    law.push_back({mean * modulus, found.gap.mean(), found.fraction, found.fraction_counted,
                   (found.pressure * modulus).cast<float>()});
    start = std::move(found.pressure);
    if (progress) progress(i + 1, level_count);
  }
  return law;
}

WaveLaw kept_wave_law(const Eigen::ArrayXXd& waves, const ElasticLayer& half_space, double modulus,
                      const WaveProgress& progress, bool* kept) {
  const std::filesystem::path caches = folder(),
                              file = caches / ("waves-" + hash_of(waves, half_space) + ".bin");
  WaveLaw law;
  if (!caches.empty()) law = read(file, waves.rows(), waves.cols());
  if (kept) *kept = !law.empty();
  if (law.empty()) {
    law = press_waves(waves, half_space, 1, progress);
    if (!caches.empty()) write(law, file);
  }
  for (WaveLevel& level : law) {
    level.pressure *= modulus;
    level.pressed *= static_cast<float>(modulus);
  }
  return law;
}

} // namespace host
