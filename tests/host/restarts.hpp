// SPDX-License-Identifier: BSD-3-Clause
// What every run has to keep: a restart goes on with the same bits, and a try that is thrown away leaves none.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support.hpp"

namespace host::test {

inline void expect_same_end(const StepRecord& a, const StepRecord& b, const std::string& when) {
  EXPECT_EQ(a.approach, b.approach) << when;
  EXPECT_EQ(a.worn_slave, b.worn_slave) << when;
  EXPECT_EQ(a.worn_master, b.worn_master) << when;
}

/// The run that goes on from a checkpoint is the run that goes through.
/// @param name   of the scene
/// @param after  steps, counted from 1, after which it is restarted; empty: after all but the last
/// @return the checkpoint of each step, as a file would hold it
inline std::vector<std::string> expect_restarts(const Scene& scene, const std::string& name,
                                                std::vector<std::size_t> after = {}) {
  Simulation whole(scene, &library());
  std::vector<std::string> checkpoints, fingerprints;
  RunObserver observer;
  observer.step_done = [&](const Simulation& simulation, const StepRecord&) {
    checkpoints.push_back(simulation.checkpoint().dump());
    fingerprints.push_back(simulation.fingerprint());
  };
  const StepRecord end = solve(whole, observer).back();
  if (after.empty())
    for (std::size_t step = 1; step < checkpoints.size(); ++step) after.push_back(step);
  for (const std::size_t step : after) {
    const std::string when = name + ", restarted after step " + std::to_string(step);
    Simulation again(scene, &library());
    again.restore(Json::parse(checkpoints.at(step - 1)));
    EXPECT_EQ(again.fingerprint(), fingerprints[step - 1]) << when;
    StepPlan rest;
    rest.first = static_cast<int>(step) + 1;
    expect_same_end(solve(again, {}, rest).back(), end, when);
    EXPECT_EQ(again.fingerprint(), fingerprints.back()) << when;
  }
  return checkpoints;
}

/// Increments that are tried first and thrown away: the run in halves without them has the same bits.
/// @return the last step
inline StepRecord expect_no_bit_of_tries(const Scene& scene, const std::string& name) {
  std::vector<StepRecord> ends;
  std::vector<std::string> fingerprints;
  for (const bool discard : {false, true}) {
    Simulation simulation(scene, &library());
    StepPlan plan;
    plan.cut = StepPlan::Cut::halves, plan.discard = discard;
    ends.push_back(solve(simulation, {}, plan).back());
    fingerprints.push_back(simulation.fingerprint());
  }
  expect_same_end(ends[0], ends[1], name);
  EXPECT_EQ(fingerprints[0], fingerprints[1]) << name;
  return ends[1];
}

} // namespace host::test
