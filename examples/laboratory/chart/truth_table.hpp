// SPDX-License-Identifier: BSD-3-Clause
// What each method needs for the asked error against the truth: prices and sentences, from the runs alone.
#pragma once

#include <string>
#include <vector>

#include "chart/work.hpp"

namespace host::chart {

/// The cheapest of a method's runs that reach the asked error of their work, each price for itself.
struct MethodPrice {
  Family family;
  bool counted = false; ///< of a contact area
  std::size_t segments = 0, dofs = 0;
  double seconds = 0;
  const WorkRun* best = nullptr; ///< with the smallest error
  bool reached = false;          ///< else the prices are those of `best`
};

/// Methods with runs, in the order of `families`; works without a truth of their own have none.
std::vector<MethodPrice> method_prices(const Work& work);

/// What the pairs of curves say: corrected and counted contact areas, sampling points and cut faces, the
/// shares of block and master. Empty: the work has no such pair.
std::vector<std::string> comparisons(const Work& work);

/// Which method is the fastest, and which do not reach the asked error; empty: there is no truth.
std::string truth_sentence(const Work& work);

/// The prices of the methods.
Json truth_json(const Work& work);

} // namespace host::chart
