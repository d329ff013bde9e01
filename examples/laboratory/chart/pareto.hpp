// SPDX-License-Identifier: BSD-3-Clause
// What to take for which error: fronts, sentences and the price at equal error, from the runs alone.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "chart/work.hpp"

namespace host::chart {

/// Runs that no other beats in price and error together, cheapest first.
/// @param price  of a run; runs without error (failed, or the truth itself) or with another tangent than the
///               exact one are left out
std::vector<const WorkRun*> pareto_front(const std::vector<WorkRun>& runs,
                                         const std::function<double(const WorkRun&)>& price);

/// Has the run an error of its own, with the exact tangent?
bool charted(const WorkRun& run);

/// The run with the smallest price among those of a family that reach an error; null: none does.
const WorkRun* cheapest(const std::vector<WorkRun>& runs, double error,
                        const std::function<double(const WorkRun&)>& price,
                        const std::function<bool(const WorkRun&)>& among);

/// What a legend calls the charted runs of a family: "enriched, one segment", or "enriched, 1-4 segments"
/// where some have more. Empty: there are none.
std::string family_name(const std::vector<const Work*>& works, Family family);

/// "enriched, one segment, 64 slave nodes"
std::string name_of(const Problem& problem, const WorkRun& run);

/// 0.0123 as "1.23 %"
std::string percent(double value);

/// "For an error of 1 % take ...": one for each of the errors that a run reaches; the times of the best other
/// family beside it.
std::vector<std::string> advice(const Work& work, const std::vector<double>& errors);

/// Enriched against plain and smoothed segments at one error; null: out of reach of the runs.
struct EqualAccuracy {
  const WorkRun* enriched =
      nullptr; ///< cheapest in time; the fewest segments of those that cost the same within the noise
  const WorkRun* fewest_facets = nullptr;   ///< least segments
  const WorkRun* cheapest_facets = nullptr; ///< least time
  const WorkRun* fewest_smoothed = nullptr;
  const WorkRun* cheapest_smoothed = nullptr;
  const WorkRun* global_facets = nullptr; ///< least segments for the same error of the approach or the forces
  int reaching = 0, faster = 0; ///< runs with plain or smoothed segments that reach the error; those that
                                ///< take less time, beyond the noise
};
EqualAccuracy equal_accuracy(const Work& work, double error);

} // namespace host::chart
