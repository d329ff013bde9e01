// SPDX-License-Identifier: BSD-3-Clause
// One element and its arrays, for tests that spoil an argument.
#pragma once

#include <gtest/gtest.h>

#include "element.hpp"

namespace test {

class Arguments : public ::testing::Test {
protected:
  Arguments() : model(text({"quad4", "sine"})), results(model.layout), random(101) {
    element = draw(model, basis("quad4"), random);
    reset();
  }
  void reset() {
    input = input_of(element);
    output = output_of(results, usual);
    report = new_report();
  }
  // The call is refused with this status; the message names `name`. Then all is as before.
  void refused(int32_t status, const std::string& name, int64_t first = 0, int64_t count = 1) {
    EXPECT_EQ(call::evaluate(model.get(), first, count, &input, &output, &report), status) << name;
    EXPECT_EQ(report.status, status);
    EXPECT_NE(std::string(report.message).find(name), std::string::npos) << report.message;
    EXPECT_EQ(report.step_factor, 1.0);
    reset();
  }

  std::int32_t usual = want_all;
  Model model;
  Results results;
  Random random;
  Element element;
  ents_input input;
  ents_output output;
  ents_report report;
};

} // namespace test
