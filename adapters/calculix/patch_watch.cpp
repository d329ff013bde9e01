// SPDX-License-Identifier: BSD-3-Clause
#include "patch_watch.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <mutex>
#include <string>

#include "../common/patch_watch.hpp"
#include "stiffness_store.hpp"

namespace ccx {
namespace {

using ents_adapter::Beside;

constexpr const char* output_file = "ents_slide.txt";
constexpr const char* advice = ", or let \"ents-deck run\" do so";

std::mutex& mutex() {
  static std::mutex& one = *new std::mutex; // never freed: threads of the host may outlive static objects
  return one;
}

int left_in_increment = 0;

std::ofstream& output() {
  static std::ofstream& one = *new std::ofstream;
  if (!one.is_open()) {
    one.open(output_file, std::ios::binary);
    one << "# step increment kind points beyond slide pair: open slave points beside their patches (open), "
           "in contact "
           "before (left), pressed into the master (lost)\n";
  }
  return one;
}

void write(int step, int increment, const char* kind, int points, const Beside& found) {
  output() << step << ' ' << increment << ' ' << kind << ' ' << points << ' ' << found.beyond << ' '
           << found.slide << ' ' << found.slave << ", " << found.master << '\n'
           << std::flush;
}

auto displacement(const Configuration& now) {
  return [now](std::int64_t node) {
    return now.v + static_cast<std::ptrdiff_t>(now.mt) * static_cast<std::ptrdiff_t>(node - 1) + 1;
  };
}

} // namespace

void note_left(const ents_adapter::Host& host, int element, const Configuration& now) {
  constexpr int most = 20; // of an increment: each builds a tree
  const std::lock_guard lock(mutex());
  Beside found;
  if (left_in_increment++ < most && is_beside(host, element, displacement(now), found))
    write(0, 0, "left", 1, found);
}

void check_patches(const ents_adapter::Host& host, const Configuration& now, int step, int increment) {
  const std::lock_guard lock(mutex());
  left_in_increment = 0;
  std::string lost;
  for (const Beside& found : compare_patches(host, displacement(now))) {
    if (found.open > 0) write(step, increment, "open", found.open, found);
    if (found.grows) // the file has every increment
      std::printf(" *WARNING in U1E: %s\n", found.open_text(advice).c_str());
    if (found.lost == 0) continue;
    write(step, increment, "lost", found.lost, found);
    if (lost.empty()) lost = found.lost_text(advice);
  }
  if (!lost.empty()) stop("U1E", lost.c_str());
}

} // namespace ccx
