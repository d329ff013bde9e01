// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_size.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include <sys/resource.h>
#include <unistd.h>

#include "output/table.hpp"

namespace host {
namespace {

// Bytes per node that a run takes at least, with the pattern of its equations and without their factors,
// which take several times as much: measured, rounded down.
constexpr double bytes_in_plane = 700, bytes_in_space = 4000;
constexpr double bytes_per_segment = 300; // of an explicit mesh: nodes, models, search

/// Memory that this process can have, in bytes: of the machine, of its control group, of the shell's limit.
double memory() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    bytes = std::min(bytes, static_cast<double>(limit.rlim_cur));
  std::ifstream group("/sys/fs/cgroup/memory.max"); // "max", or a number
  if (double most = 0; group >> most) bytes = std::min(bytes, most);
  return bytes;
}

std::string gigabytes(double bytes) { return format_number(bytes / 1e9, 3) + " GB"; }

[[noreturn]] void refuse(const std::string& what, double bytes, const std::string& instead) {
  throw InputError(what + " need at least " + gigabytes(bytes) + " of memory, and there are " +
                   gigabytes(memory()) + "; " + instead);
}

} // namespace

void check_mesh_size(const Scene& scene) {
  double bytes = 0, nodes = 0;
  for (const PartSpec& part : scene.parts) {
    if (part.lines.empty()) continue;
    double own = 1;
    std::string cells;
    for (const GridLines& line : part.lines) {
      own *= static_cast<double>(line.size());
      cells += (cells.empty() ? "" : " x ") + std::to_string(line.size() - 1);
    }
    nodes += own;
    bytes += own * (scene.dimension == 2 ? bytes_in_plane : bytes_in_space);
    const std::string what =
        part.where + ": /x, /y" + (scene.dimension == 2 ? "" : ", /z") + ": " + cells + " divisions";
    if (bytes > memory()) refuse(what, bytes, "take fewer \"divisions\"");
    if (nodes * scene.dimension > std::numeric_limits<int>::max())
      throw InputError(what +
                       " are more than the numbers of the equations can count; take fewer \"divisions\"");
  }
}

void check_explicit_size(const Scene& scene, int divisions) {
  const double segments = std::pow(divisions, scene.dimension - 1), bytes = segments * bytes_per_segment;
  const std::string n = std::to_string(divisions);
  const std::string what = scene.file.string() +
                           ": explicit mesh (--explicit, --compare, /compare/divisions): " +
                           (scene.dimension == 2 ? n : n + " x " + n) + " segments";
  if (bytes > memory()) refuse(what, bytes, "take fewer");
  if (segments * 12 > std::numeric_limits<int>::max())
    throw InputError(what + " are more than can be counted; take fewer");
}

} // namespace host
