// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/number_text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

namespace number_text_test {
namespace {

using ents::NumberText;
using ents::read_number;

double read(std::string_view text) {
  double value = std::nan("");
  EXPECT_EQ(read_number(text, value), NumberText::ok) << text;
  return value;
}

TEST(NumberText, ReadsDecimalNumbers) {
  EXPECT_EQ(read("0"), 0.0);
  EXPECT_EQ(read("12"), 12.0);
  EXPECT_EQ(read("+.5"), 0.5);
  EXPECT_EQ(read("-1.8823e-008"), -1.8823e-8);
  EXPECT_EQ(read("1.E5"), 1e5);
  EXPECT_TRUE(std::signbit(read("-0")));
  EXPECT_EQ(read("1" + std::string(400, '0') + "e-400"), 1.0);
}

TEST(NumberText, RefusesEverythingElse) {
  double value = 7.0;
  for (const char* text :
       {"",     "+",   "-",    ".",  "e5", "1e",  "1e+", "nan",   "inf", "-inf", "infinity",
        "0x10", "1,5", "1.5f", "1 ", " 1", "--1", "+-1", "1.2.3", "1d5", "1_000"})
    EXPECT_EQ(read_number(text, value), NumberText::not_a_number) << '"' << text << '"';
  EXPECT_EQ(value, 7.0);
}

TEST(NumberText, TellsTooLargeFromTooSmall) {
  double value = 7.0;
  for (const std::string& text :
       {std::string("1e309"), std::string("-1.8e308"), std::string("0.001e312"), std::string(400, '9'),
        "1" + std::string(400, '0') + ".5", std::string("1e99999999999999999999")})
    EXPECT_EQ(read_number(text, value), NumberText::too_large) << text;
  EXPECT_EQ(value, 7.0);
  for (const std::string& text : {std::string("1e-400"), std::string("-1000e-400"),
                                  "0." + std::string(400, '0') + "1", "0." + std::string(400, '0') + "1e50",
                                  std::string("0e999999"), std::string("1e-99999999999999999999")})
    EXPECT_EQ(read(text), 0.0) << text;
  EXPECT_EQ(read("4.9406564584124654e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(read("1.7976931348623157e308"), std::numeric_limits<double>::max());
}

TEST(NumberText, TextToDoubleToTextToDoubleIsTheSameBits) {
  std::mt19937_64 generator(11);
  char text[40];
  for (int i = 0; i < 200000; ++i) {
    const double value = std::bit_cast<double>(generator());
    if (!std::isfinite(value)) continue;
    std::snprintf(text, sizeof text, "%.17g", value);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(read(text)), std::bit_cast<std::uint64_t>(value)) << text;
  }
}

} // namespace
} // namespace number_text_test
