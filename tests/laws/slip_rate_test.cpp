// SPDX-License-Identifier: BSD-3-Clause
// A coefficient of friction that depends on the slip rate needs the time of the increment.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <string>

#include "law_elements.hpp"
#include "samples.hpp"

namespace laws::slip_rate_test {
namespace {

// Of one element and of many, from a start or from the state alone: the ways through ents_evaluate.
TEST(SlipRate, ForcesWithoutATimeAreRefused) {
  Random random(7);
  std::size_t seen = 0;
  for (const Method& method : methods()) {
    const bool depends = method.name.ends_with("friction_decays") || method.name.ends_with("friction_table");
    if (!depends && method.name != "penalty_coulomb") continue;
    const mechanics::Scene scene = draw_scene(random, mechanics::basis_named("quad4"), "sine", "normal");
    const mechanics::Model model = model_of(scene, method);
    LawElements e = draw(random, scene, model, 9, 0.01);
    for (const double time : {0.1, 0.0, -1.0, 1e101, std::numeric_limits<double>::quiet_NaN()})
      for (const std::int64_t count : {1, 9})
        for (const bool start : {false, true}) {
          LawElements some = e;
          some.at.count = count, some.time_increment = time;
          LawResults r;
          ents_report report;
          const std::int32_t status =
              try_evaluate(model.handle(), some, ENTS_RESIDUAL | ENTS_TANGENT | ENTS_STATE | ENTS_FLAGS, r,
                           report, start ? some.at.start : std::vector<double>());
          if (!depends || time == 0.1) {
            EXPECT_GE(status, 0) << method.name << " " << report.message;
            continue;
          }
          EXPECT_EQ(status, ENTS_BAD_VALUE) << method.name << " " << time << " " << count;
          EXPECT_NE(std::string(report.message).find("input.time_increment"), std::string::npos);
          ++seen;
        }
  }
  EXPECT_EQ(seen, 8u * 4 * 2 * 2);
}

// The struct of a caller from before there was a time: nothing behind it is read (address sanitizer).
TEST(SlipRate, AnOlderStructHasNoTime) {
  Random random(8);
  for (const Method& method : methods()) {
    const bool depends = method.name == "penalty_friction_decays";
    if (!depends && method.name != "penalty_coulomb") continue;
    const mechanics::Scene scene = draw_scene(random, mechanics::basis_named("quad4"), "sine", "normal");
    const mechanics::Model model = model_of(scene, method);
    const LawElements e = draw(random, scene, model, 3, 0.01);
    ents_input in = input_of(e, e.at.start);
    in.struct_size = static_cast<std::int32_t>(offsetof(ents_input, slave_temperature));
    const auto bytes = std::make_unique<unsigned char[]>(static_cast<std::size_t>(in.struct_size));
    std::memcpy(bytes.get(), &in, static_cast<std::size_t>(in.struct_size));
    double residual[3 * 15];
    ents_output out{};
    out.struct_size = sizeof out, out.wanted = ENTS_RESIDUAL;
    out.residual = residual, out.residual_stride = 15;
    EXPECT_EQ(ents_evaluate(model.handle(), 0, 3, reinterpret_cast<const ents_input*>(bytes.get()), &out,
                            nullptr) == ENTS_BAD_VALUE,
              depends);
  }
}

} // namespace
} // namespace laws::slip_rate_test
