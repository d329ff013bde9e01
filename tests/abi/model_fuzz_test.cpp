// SPDX-License-Identifier: BSD-3-Clause
// 100000 damaged model texts and 20000 damaged height-map files: each ends in a model or in a status with a
// clean message, never in a crash (the sanitizer build runs this test, too).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "abi/read/surface_file.hpp"
#include "model_errors.hpp"
#include "sample_count.hpp"

namespace model_fuzz_test {
namespace {

using namespace ents;

const std::vector<std::string> seeds = {
    R"({"segment": "line2", "height": {"type": "sine", "amplitude": 0.02, "wave_vector": [0.9], "phase": 2.9}})",
    R"({"segment": "quad4", "height": {"type": "polynomial", "coefficients": [[0.1, 1e-3], [2]]}, "master": "rigid"})",
    R"({"segment": "tri3", "height": {"type": "sum", "of": [{"type": "constant", "value": 1}, {"type": "product", "of":
       [{"type": "gaussian", "amplitude": -1, "center": [0.1, 0], "width": 0.5}]}]}, "tangent": "small_gap"})",
    R"({"segment": "quad4", "height": {"type": "map", "values": [[1, 2], [3, 4]], "boundary": "clamped", "size": [1, 2], "scale": 2}})",
    R"({"segment": "quad4", "height": {"type": "map", "data": "heights", "boundary": "periodic", "size": [1, 2], "origin": [0, 1]}})",
    R"({"segment": "line2", "height": {"type": "map", "file": "none.txt", "boundary": "periodic", "size": [1]}})",
    R"({"segment": "quad4", "height": {"type": "thread", "pitch": 1.5, "flank_angles": [3, 30], "crest": 0.2, "root": 0.3, "starts": 2, "hand": "left"}})",
    R"({"segment": "line3", "surface_coordinates": [[0], [1], [2]], "projection": {"type": "shadow_point", "emitter": [1, 5]}})",
    R"({"segment": "tri6", "projection": {"type": "shadow_direction", "direction": [0, 0.1, 1]}, "height": null,
       "contact": {"normal": {"type": "penalty", "stiffness": 1e5}}, "penetration_limit": 0.25, "tangent": "first_variation"})"};

const std::vector<std::string> pieces = {"{",
                                         "}",
                                         "[",
                                         "]",
                                         ",",
                                         ":",
                                         "\"",
                                         "\\",
                                         "null",
                                         "true",
                                         "NaN",
                                         "-",
                                         "1e999",
                                         "1e-999",
                                         "0",
                                         "1e101",
                                         "\"type\"",
                                         "\"map\"",
                                         "\"sum\"",
                                         "\"of\"",
                                         "\"values\"",
                                         "\\u0000",
                                         "\\ud800",
                                         "\xFF",
                                         "\xC3",
                                         "\xF0\x9F\x98\x80",
                                         "/",
                                         "~",
                                         "\n",
                                         "\t",
                                         "\x01",
                                         "[[[[[[[[",
                                         "99999999999999999999",
                                         "\"\"",
                                         "[]",
                                         "{}"};

using Generator = std::mt19937_64;

std::size_t below(Generator& generator, std::size_t n) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(generator);
}

std::string damaged(std::string text, Generator& generator, const std::vector<std::string>& all_seeds) {
  for (std::size_t edits = 1 + below(generator, 4); edits > 0; --edits) {
    const std::size_t at = below(generator, text.size() + 1), left = text.size() - at;
    const std::size_t length = left == 0 ? 0 : below(generator, std::min<std::size_t>(left, 12) + 1);
    switch (below(generator, 6)) {
    case 0:
      text.erase(at, length);
      break;
    case 1:
      text.insert(at, pieces[below(generator, pieces.size())]);
      break;
    case 2:
      text.replace(at, length, pieces[below(generator, pieces.size())]);
      break;
    case 3:
      text.insert(at, text.substr(at, length));
      break; // doubled
    case 4:
      if (left > 0) text[at] = static_cast<char>(below(generator, 256));
      break;
    default: { // a part of another text
      const std::string& other = all_seeds[below(generator, all_seeds.size())];
      text.insert(at, other.substr(below(generator, other.size()), 1 + below(generator, 60)));
    }
    }
  }
  return text;
}

void expect_clean(const std::string& message, std::string_view text) {
  EXPECT_FALSE(message.empty()) << text;
  EXPECT_LT(message.size(), 512u) << message;
  for (const char c : message) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << message;
}

TEST(ModelFuzz, DamagedTextsEndInAStatus) {
  const double samples[4] = {1, 2, 3, 4};
  const NamedData data[] = {{"heights", samples, 2, 2}};
  const std::set<std::int32_t> possible = {ENTS_OK, ENTS_JSON_SYNTAX, ENTS_UNKNOWN_KEY, ENTS_BAD_VALUE,
                                           ENTS_FILE};
  std::set<std::int32_t> seen;
  Generator generator(1);
  for (int i = 0; i < (test::sample_divisor > 1 ? 10000 : 100000); ++i) {
    const std::string text = damaged(seeds[below(generator, seeds.size())], generator, seeds);
    const ents::testing::Verdict got = ents::testing::verdict(text, "no such directory", data);
    seen.insert(got.status);
    EXPECT_TRUE(possible.count(got.status)) << text;
    if (got.status != ENTS_OK) expect_clean(got.message, text);
  }
  EXPECT_EQ(seen, possible); // the damage is neither too light nor too heavy
}

TEST(ModelFuzz, DamagedFilesEndInAMessage) {
  const std::vector<std::string> files = {
      "# Channel: Z\n# Width: 10.00 \xC2\xB5m\n# Height: 2 um\n# Value units: m\n1.8823e-008\t2\n3\t4\n",
      "1,2,3\n4,5,6\n", "1;2;3\r\n4;5;6\r\n", "0.5 -1e5\n+2 3\n"};
  int read = 0, refused = 0;
  Generator generator(2);
  for (int i = 0; i < 20000; ++i) {
    const std::string text = damaged(files[below(generator, files.size())], generator, files);
    try {
      const SurfaceFile surface = parse_surface(text, "map.txt");
      EXPECT_EQ(surface.values.size(), static_cast<std::size_t>(surface.rows * surface.columns));
      ++read;
    } catch (const ModelError& error) {
      EXPECT_EQ(error.status, ENTS_FILE);
      expect_clean(error.message, text);
      ++refused;
    }
  }
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 1000);
}

} // namespace
} // namespace model_fuzz_test
