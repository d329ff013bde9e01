// SPDX-License-Identifier: BSD-3-Clause
#include "advice.hpp"

#include <algorithm>
#include <cmath>

namespace host {
namespace {

constexpr std::size_t half = 4, window = 2 * half; // iterations that are looked at
constexpr double above_rounding = 1e-3; // what stands above this is no rounding of a large stiffness
constexpr double scatter = 100;         // of residuals that are rounding

/// The key of the law that makes it stiff, in brackets; empty: there is none.
std::string stiffness_of(const Json& model) {
  const Json law = find_json(model, "/contact/normal");
  for (const char* key : {"stiffness", "coefficient"})
    if (law.is_object() && law.contains(key))
      return std::string("the contact stiffness (/contact/model/contact/normal/") + key + ")";
  return "";
}

bool smooth(const Json& model) {
  const Json law = find_json(model, "/contact/normal");
  return law.is_object() && (law.value("type", "") == "power" || law.value("type", "") == "exponential");
}

/// Every second residual is the same, and nodes open and close all the while.
bool alternates(const IterationHistory& history) {
  const auto& r = history.residuals;
  for (std::size_t i = r.size() - half / 2; i < r.size(); ++i)
    if (!(std::abs(r[i] - r[i - 2]) <= 1e-2 * r[i]) || history.switches[i] == 0) return false;
  return true;
}

/// Nodes change their segment at every iteration, and it is never enough.
bool wanders(const IterationHistory& history) {
  const auto& r = history.residuals;
  for (std::size_t i = r.size() - half; i < r.size(); ++i)
    if (history.moves[i] == 0) return false;
  return true;
}

bool stands_still(const std::vector<double>& residuals) {
  const auto begin = residuals.end() - window, middle = residuals.end() - half;
  const double high = *std::max_element(begin, residuals.end());
  const double before = *std::min_element(begin, middle), after = *std::min_element(middle, residuals.end());
  return high <= above_rounding && high <= scatter * std::min(before, after) && after > 0.5 * before;
}

} // namespace

std::string advice_if_stuck(const IterationHistory& history, const Json& model) {
  if (history.residuals.size() < window) return "";
  if (alternates(history))
    return smooth(model) ? ""
                         : "nodes open and close in turn: see examples/chatter (power or exponential law)";
  if (wanders(history))
    return "slave nodes change between neighbouring segments at every iteration: take a smoothed segment "
           "(/contact/model/segment), which has no edges, or other steps";
  if (!stands_still(history.residuals)) return "";
  const std::string stiffness = stiffness_of(model);
  return "the residual does not fall any more: " + (stiffness.empty() ? "" : "lower " + stiffness + " or ") +
         "raise /solver/tolerance";
}

std::string advice_if_deep(const Json& model) {
  const std::string stiffness = stiffness_of(model);
  return smaller_steps + (stiffness.empty() ? "" : ", or raise " + stiffness);
}

std::string advice_if_lost(const Json& model, bool behind_edge) {
  if (!behind_edge) return "let the master reach farther than its slave nodes slide";
  const bool has_one = model.is_object() && model.contains("border");
  return "take a smoothed segment (/contact/model/segment), which has no edges, or " +
         std::string(has_one ? "raise /contact/model/border" : "write \"border\": 0.1 into /contact/model") +
         ", so that the segments reach beyond theirs";
}

} // namespace host
