// SPDX-License-Identifier: BSD-3-Clause
// Elements of a UEL, as Abaqus asks for them.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "abaqus_services.hpp"
#include "problem.hpp"
#include "uel_host.hpp"

namespace adapters {

class Uel : public testing::Test {
protected:
  void SetUp() override { abaqus_messages(); }

  Problem problem_ = problem("quad4_friction");
  UelHost host_{problem_.elements, UelHost::Program::abaqus};

  UelCall request(int what, int element = 0) {
    UelCall c = host_.call(element, pressed(problem_));
    c.lflags[2] = what;
    return c;
  }
  std::string only_message(int severity) {
    const auto messages = abaqus_messages();
    if (messages.size() != 1) return std::to_string(messages.size()) + " messages";
    EXPECT_EQ(messages[0].severity, severity);
    EXPECT_LE(messages[0].text.size(), 500u);
    return messages[0].text;
  }
};

} // namespace adapters
