// SPDX-License-Identifier: BSD-3-Clause
// ents-host as typed in a shell.
#include <gtest/gtest.h>

#include "program.hpp"

namespace host::test {
namespace {

TEST(Program, NamesACommandItDoesNotKnow) {
  const ProgramOutput output = ents_host("rum scene.json");
  EXPECT_EQ(output.exit_code, 2);
  EXPECT_NE(output.text.find("\"rum\" is not a command; write run"), std::string::npos) << output.text;
}

} // namespace
} // namespace host::test
