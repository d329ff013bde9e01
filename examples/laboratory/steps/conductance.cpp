// SPDX-License-Identifier: BSD-3-Clause
#include "conductance.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

namespace host {

GapMeans gap_means(const std::vector<double>& gap, const std::vector<double>& areas) {
  GapMeans sum;
  double area = 0;
  for (std::size_t k = 0; k < gap.size(); ++k) {
    area += areas[k];
    if (!(gap[k] > 0)) continue;
    sum.gap += areas[k] * gap[k];
    sum.cubed += areas[k] * gap[k] * gap[k] * gap[k];
  }
  return {sum.gap / area, sum.cubed / area};
}

double incremental_conductance(Simulation& simulation, const Target& higher, const Target& lower) {
  // The mean gap with its penetrations: the penalty is a part of the stiffness.
  const auto mean_gap = [&] {
    const std::vector<double>&gap = simulation.contact()->accepted().gap,
          &areas = simulation.contact()->areas();
    double sum = 0, area = 0;
    for (std::size_t k = 0; k < gap.size(); ++k)
      if (!std::isnan(gap[k])) sum += areas[k] * gap[k], area += areas[k];
    return sum / area;
  };
  const Json here = simulation.checkpoint();
  double pressures[2] = {}, gaps[2] = {};
  bool converged = true;
  for (const int side : {0, 1}) {
    converged = converged && simulation.advance(side == 0 ? higher : lower).converged;
    pressures[side] = simulation.now().force / simulation.contact_area();
    gaps[side] = mean_gap();
    simulation.restore(here);
  }
  return converged ? (pressures[0] - pressures[1]) / (gaps[1] - gaps[0]) / contact_modulus(simulation.scene())
                   : std::numeric_limits<double>::quiet_NaN();
}

double westergaard_conductance(double part) { return std::numbers::pi / -std::log(part); }

double westergaard_cubed_gap(double part) {
  // Simpson's rule over the open half wave, with a substitution that is smooth at the border of contact
  const double edge = std::asin(std::sqrt(part)) / std::numbers::pi;
  constexpr int intervals = 4096;
  double sum = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double t = static_cast<double>(i) / intervals, x = edge + (0.5 - edge) * t * t;
    const double gap = westergaard_gap(1, edge, x, 1);
    const double weight = i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * gap * gap * gap * 2 * t * (0.5 - edge);
  }
  return 2 * sum / (3 * intervals);
}

namespace {

/// NumPy's format 1.0: a header of Python text, padded to a multiple of 64 bytes, then the numbers.
void write_npy(const std::filesystem::path& file, const std::vector<double>& numbers, std::size_t rows,
               std::size_t columns) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", " +
                       std::to_string(columns) + "), }";
  constexpr std::size_t before = 10;
  while ((before + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::ofstream out(file, std::ios::binary);
  out.write("\x93NUMPY\x01\x00", 8);
  const auto size = static_cast<std::uint16_t>(header.size());
  const char bytes[] = {static_cast<char>(size & 255), static_cast<char>(size >> 8)};
  out.write(bytes, 2);
  out << header;
  out.write(reinterpret_cast<const char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(double)));
  if (!out.flush()) throw JobError(file.string() + ": cannot be written");
}

} // namespace

std::vector<std::filesystem::path> write_gaps(const std::vector<StepRecord>& records, int dimension,
                                              const std::filesystem::path& folder) {
  if (records.empty()) return {};
  const std::vector<double>& places = records.front().places;
  std::vector<double> gaps;
  for (const StepRecord& record : records) {
    if (record.places != places) return {};
    gaps.insert(gaps.end(), record.fields.gap.begin(), record.fields.gap.end());
  }
  const std::size_t d = static_cast<std::size_t>(dimension), points = places.size() / d;
  write_npy(folder / "gaps.npy", gaps, records.size(), points);
  write_npy(folder / "places.npy", places, points, d);
  return {folder / "gaps.npy", folder / "places.npy"};
}

} // namespace host
