// Several pieces of code timed in turns, so that a slow second of the machine hits all of them.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "thread_time.hpp"

namespace bench {

// Seconds of one call of each, medians of `rounds`. In a round every piece is called for at least `least`
// seconds.
inline std::vector<double> interleaved_seconds(const std::vector<std::function<void()>>& pieces,
                                               int rounds = 15, double least = 4e-3) {
  std::vector<int> calls;
  for (const auto& piece : pieces) { // also warms up
    int count = 1;
    for (;; count *= 2) {
      const double begin = thread_seconds();
      for (int i = 0; i < count; ++i) piece();
      if (thread_seconds() - begin >= least) break;
    }
    calls.push_back(count);
  }
  std::vector<std::vector<double>> seconds(pieces.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const double begin = thread_seconds();
      for (int i = 0; i < calls[k]; ++i) pieces[k]();
      seconds[k].push_back((thread_seconds() - begin) / calls[k]);
    }
  std::vector<double> medians;
  for (auto& times : seconds) {
    std::nth_element(times.begin(), times.begin() + rounds / 2, times.end());
    medians.push_back(times[static_cast<std::size_t>(rounds / 2)]);
  }
  return medians;
}

} // namespace bench
