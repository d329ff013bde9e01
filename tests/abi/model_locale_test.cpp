// SPDX-License-Identifier: BSD-3-Clause
// Numbers are read the same in a process whose locale writes another decimal point. This program replaces
// localeconv, so that every such locale can be had without installing it; de_DE itself is tried where it is.
#include <gtest/gtest.h>

#include <clocale>
#include <cstdio>

#include "abi/read/surface_file.hpp"
#include "core/height/height.hpp"
#include "model_errors.hpp"

namespace model_locale_test {
namespace {

char decimal_point[8] = ".";
char nothing[1] = "";
int asked = 0;

void expect_numbers() {
  const ents::ModelSpec model = ents::read_model(
      R"({"segment": "line2", "height": {"type": "sine", "amplitude": 0.125, "wave_vector": [2.5e-1]}})");
  const double s[1] = {1.0};
  EXPECT_EQ(ents::ENTS_ISA::evaluate_height(model.height.root(), s).h, 0.125);
  const auto [status, message] =
      ents::testing::verdict(R"({"segment": "line2", "penetration_limit": -1234.5})");
  EXPECT_EQ(message.substr(0, 31), "/penetration_limit: is -1234.5;") << message;
  EXPECT_EQ(ents::testing::verdict(R"({"segment": "line2", "penetration_limit": 1,5})").status,
            ENTS_JSON_SYNTAX);
  EXPECT_EQ(ents::testing::verdict(R"({"segment": "line2", "penetration_limit": 1.5e400})").status,
            ENTS_BAD_VALUE);
  EXPECT_EQ(ents::parse_surface("0.5 1.25\n", "map.txt").values[1], 1.25);
}

TEST(ModelLocale, NumbersKeepTheirPoint) {
  for (const char* point : {",", "\xD9\xAB", "'"}) {
    std::snprintf(decimal_point, sizeof decimal_point, "%s", point);
    asked = 0;
    expect_numbers();
    EXPECT_GT(asked, 0) << "the parser did not see the locale of this test";
  }
  decimal_point[0] = '.';
  for (const char* name : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "tr_TR.UTF-8"})
    if (std::setlocale(LC_ALL, name)) {
      std::snprintf(decimal_point, sizeof decimal_point, ",");
      expect_numbers();
    }
  std::setlocale(LC_ALL, "C");
}

} // namespace

extern "C" struct lconv* localeconv() noexcept {
  static struct lconv convention;
  convention.decimal_point = decimal_point;
  convention.thousands_sep = nothing;
  ++asked;
  return &convention;
}

} // namespace model_locale_test
