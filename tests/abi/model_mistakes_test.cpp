// SPDX-License-Identifier: BSD-3-Clause
// The model reader: every mistake gets its status, path and advice; nesting and sizes have limits.
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "abi/read/json_text.hpp"
#include "abi/read/model_json.hpp"
#include "model_errors.hpp"

namespace model_mistakes_test {
namespace {

using namespace ents;
using ents::testing::verdict;

std::string with_height(const std::string& segment, const std::string& height) {
  return R"({"segment": ")" + segment + R"(", "height": )" + height + "}";
}

struct Mistake {
  const char* text;
  std::int32_t status;
  const char* start;
  const char* part;
};

void expect_mistakes(const std::vector<Mistake>& mistakes) {
  for (const Mistake& m : mistakes) {
    const auto [status, message] = verdict(m.text);
    EXPECT_EQ(status, m.status) << m.text << "\n" << message;
    EXPECT_EQ(message.substr(0, std::string(m.start).size()), m.start) << m.text;
    EXPECT_NE(message.find(m.part), std::string::npos) << m.text << "\n" << message;
    EXPECT_LT(message.size(), 512u) << "longer than the message of a report";
  }
}

TEST(ModelJson, SyntaxErrorsGiveTheByteOffset) {
  expect_mistakes({
      {"", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 0", "unexpected end of input"},
      {"{", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 1", "line 1, column"},
      {R"({"segment":"quad4",})", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 19", "'}'"},
      {R"({"segment":"quad4"} x)", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 20",
       "expected end of input"},
      {R"({"segment":"quad4"}{})", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 19",
       "expected end of input"},
      {R"({"penetration_limit":NaN})", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 21",
       "NaN and Infinity"},
      {R"({"penetration_limit":Infinity})", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 21",
       "NaN and Infinity"},
      {R"({"penetration_limit":-Infinity})", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 22",
       "not JSON"},
      {R"({"penetration_limit":01})", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 22",
       "not JSON"},
      {R"({"penetration_limit":1.})", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 23",
       "not JSON"},
      {"{'segment':'quad4'}", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 1",
       "string literal"},
      {"{\"segment\":\"quad4\" // why\n}", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 19",
       "not JSON"},
      {"{\"segment\":\"\xFF\"}", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 12",
       "ill-formed UTF-8"},
      {"{\"segment\":\"a\nb\"}", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 13",
       "control character"},
      {R"({"segment":"\ud800"})", ENTS_JSON_SYNTAX, "the model text is not JSON at byte offset 18",
       "surrogate"},
  });
  const auto [status, message] = verdict(std::string_view("{\"segment\":\"quad4\"}\0", 20));
  EXPECT_EQ(status, ENTS_JSON_SYNTAX);
  EXPECT_NE(message.find("byte offset 19: zero byte"), std::string::npos) << message;
}

TEST(ModelJson, MistakesNameThePathAndTheWayOut) {
  expect_mistakes({
      {"[]", ENTS_BAD_VALUE, "model: is an array", "\"segment\""},
      {"null", ENTS_BAD_VALUE, "model: is null", "write an object"},
      {"{}", ENTS_UNKNOWN_KEY, "model: the key \"segment\" is missing", ""},
      {R"({"segment":"quad4","heigth":null})", ENTS_UNKNOWN_KEY, "/heigth: unknown key",
       "did you mean \"height\"?"},
      {R"({"segment":"quad4","zzz":null})", ENTS_UNKNOWN_KEY, "/zzz: unknown key",
       "allowed here: \"segment\", \"height\""},
      {R"({"segment":"quad4","a/b~c":null})", ENTS_UNKNOWN_KEY, "/a~1b~0c: unknown key", ""},
      {R"({"segment":"quad4","segment":"quad4"})", ENTS_UNKNOWN_KEY, "/segment: the key stands twice", ""},
      {R"({"segment":"quad4","height":{"type":"sum","of":[{"type":"constant","value":1,"value":2}]}})",
       ENTS_UNKNOWN_KEY, "/height/of/0/value: the key stands twice", ""},
      {R"({"segment":"quad5"})", ENTS_BAD_VALUE, "/segment: is \"quad5\"; did you mean \"quad4\"?",
       "\"bspline16\""},
      {R"({"segment":4})", ENTS_BAD_VALUE, "/segment: is a number; write \"line2\"", ""},
      {R"({"segment":null})", ENTS_BAD_VALUE, "/segment: is null", ""},
      {R"({"segment":"line2","height":[]})", ENTS_BAD_VALUE,
       "/height: is an array; write an object with \"type\"", ""},
      {R"({"segment":"line2","height":{}})", ENTS_UNKNOWN_KEY, "/height: the key \"type\" is missing",
       "\"gaussian\""},
      {R"({"segment":"line2","height":{"type":"sinus"}})", ENTS_BAD_VALUE, "/height/type: is \"sinus\"",
       "\"sine\""},
      {R"({"segment":"line2","height":{"type":"xyz"}})", ENTS_BAD_VALUE,
       "/height/type: is \"xyz\"; write \"constant\"", ""},
      {R"({"segment":"line2","height":{"type":"constant"}})", ENTS_UNKNOWN_KEY,
       "/height: the key \"value\" is missing", ""},
      {R"({"segment":"line2","height":{"type":"constant","value":1,"phase":0}})", ENTS_UNKNOWN_KEY,
       "/height/phase: unknown key", "\"value\""},
      {R"({"segment":"line2","height":{"type":"constant","value":"1"}})", ENTS_BAD_VALUE,
       "/height/value: is the text \"1\"; write a number", ""},
      {R"({"segment":"line2","height":{"type":"constant","value":true}})", ENTS_BAD_VALUE,
       "/height/value: is true or false", ""},
      {R"({"segment":"line2","height":{"type":"constant","value":1e101}})", ENTS_BAD_VALUE,
       "/height/value: is 1e+101; write a number from -1e100", ""},
      {R"({"segment":"line2","height":{"type":"constant","value":1e400}})", ENTS_BAD_VALUE,
       "/height/value: 1e400 is outside", ""},
      {R"({"segment":"line2","height":{"type":"sine","amplitude":1,"wave_vector":[1,2],"phase":0}})",
       ENTS_BAD_VALUE, "/height/wave_vector: has 2 entries; write an array of 1 number",
       "one per surface coordinate"},
      {R"({"segment":"tri3","height":{"type":"sine","amplitude":1,"wave_vector":[1],"phase":0}})",
       ENTS_BAD_VALUE, "/height/wave_vector: has 1 entry; write an array of 2 numbers", ""},
      {R"({"segment":"tri3","height":{"type":"sine","amplitude":1,"wave_vector":[1,null],"phase":0}})",
       ENTS_BAD_VALUE, "/height/wave_vector/1: is null", ""},
      {R"({"segment":"line2","height":{"type":"polynomial","coefficients":[[1]]}})", ENTS_BAD_VALUE,
       "/height/coefficients/0: is an array", ""},
      {R"({"segment":"tri3","height":{"type":"polynomial","coefficients":[1]}})", ENTS_BAD_VALUE,
       "/height/coefficients/0: is a number", "c[i][j]"},
      {R"({"segment":"tri3","height":{"type":"polynomial","coefficients":[]}})", ENTS_BAD_VALUE,
       "/height/coefficients: has 0 entries", "1 to 64"},
      {R"({"segment":"tri3","height":{"type":"polynomial","coefficients":[[1],[]]}})", ENTS_BAD_VALUE,
       "/height/coefficients/1: has 0 entries", ""},
      {R"({"segment":"line2","height":{"type":"sum","of":[{"type":"constant","value":1},{"type":"gaussian","amplitude":1,"center":[0],"width":0}]}})",
       ENTS_BAD_VALUE, "/height/of/1/width: is 0.0; write a number from 1e-100", ""},
      {R"({"segment":"line2","height":{"type":"thread","pitch":1,"flank_angles":[30],"crest":0,"root":0}})",
       ENTS_BAD_VALUE, "/height/flank_angles: has 1 entry; write an array of 2 numbers",
       "the flank that rises"},
      {R"({"segment":"line2","height":{"type":"thread","pitch":1,"flank_angles":[30,0],"crest":0,"root":0}})",
       ENTS_BAD_VALUE, "/height/flank_angles/1: is 0.0; write degrees from 0.1 to 89", ""},
      {R"({"segment":"line2","height":{"type":"thread","pitch":1,"flank_angles":[30,30],"crest":0.6,"root":0.4}})",
       ENTS_BAD_VALUE, "/height: \"crest\" and \"root\" leave nothing of \"pitch\"", ""},
      {R"({"segment":"line2","height":{"type":"thread","pitch":1,"flank_angles":[30,30],"crest":0,"root":1.5}})",
       ENTS_BAD_VALUE, "/height/root: is 1.5; write a length from 0 to the pitch", ""},
      {R"({"segment":"line2","height":{"type":"thread","pitch":1,"flank_angles":[30,30],"crest":0,"root":0,"rounding":0.3}})",
       ENTS_BAD_VALUE, "/height/rounding: is 0.3; write a length from pitch / 2048 to pitch / 4", ""},
      {R"({"segment":"line2","height":{"type":"thread","pitch":1,"flank_angles":[30,30],"crest":0,"root":0,"hand":"left"}})",
       ENTS_BAD_VALUE, "/height/hand: a line segment has no angle round the axis", "remove this key"},
      {R"({"segment":"quad4","height":{"type":"thread","pitch":1,"flank_angles":[30,30],"crest":0,"root":0,"starts":1.5}})",
       ENTS_BAD_VALUE, "/height/starts: is 1.5; write a whole number", ""},
      {R"({"segment":"quad4","height":{"type":"thread","pitch":1,"flank_angles":[30,30],"crest":0,"root":0,"hand":"wrong"}})",
       ENTS_BAD_VALUE, "/height/hand: is \"wrong\"; write \"right\" or \"left\"", ""},
      {R"({"segment":"line2","height":{"type":"sum","of":[]}})", ENTS_BAD_VALUE, "/height/of: has 0 entries",
       ""},
      {R"({"segment":"line2","height":{"type":"product","of":{}}})", ENTS_BAD_VALUE,
       "/height/of: is an object; write an array of height objects", ""},
      {R"({"segment":"line2","surface_coordinates":[[0]]})", ENTS_BAD_VALUE,
       "/surface_coordinates: has 1 entries; line2 has 2 master nodes", ""},
      {R"({"segment":"line2","surface_coordinates":[[0],[1,2]]})", ENTS_BAD_VALUE,
       "/surface_coordinates/1: has 2 entries", ""},
      {R"({"segment":"line2","surface_coordinates":[0,1]})", ENTS_BAD_VALUE,
       "/surface_coordinates/0: is a number", ""},
      {R"({"segment":"line2","surface_coordinates":null})", ENTS_BAD_VALUE, "/surface_coordinates: is null",
       ""},
      {R"({"segment":"line2","projection":"normal"})", ENTS_BAD_VALUE,
       "/projection: is the text \"normal\"; write an object", ""},
      {R"({"segment":"line2","projection":{"type":"normal","emitter":[0,0]}})", ENTS_UNKNOWN_KEY,
       "/projection/emitter: unknown key", ""},
      {R"({"segment":"line2","projection":{"type":"shadow_point"}})", ENTS_UNKNOWN_KEY,
       "/projection: the key \"emitter\" is missing", ""},
      {R"({"segment":"line2","projection":{"type":"shadow_point","emitter":[0,0,0]}})", ENTS_BAD_VALUE,
       "/projection/emitter: has 3 entries; write an array of 2", ""},
      {R"({"segment":"tri3","projection":{"type":"shadow_direction","direction":[0,0,0]}})", ENTS_BAD_VALUE,
       "/projection/direction: is zero", ""},
      {R"({"segment":"line2","contact":{}})", ENTS_UNKNOWN_KEY, "/contact: the key \"normal\" is missing",
       ""},
      {R"({"segment":"line2","contact":{"normal":{"type":"penalty","stiffness":0}}})", ENTS_BAD_VALUE,
       "/contact/normal/stiffness: is 0.0", ""},
      {R"({"segment":"line2","contact":{"normal":{"type":"penalty","stiffness":-1}}})", ENTS_BAD_VALUE,
       "/contact/normal/stiffness: is -1.0", ""},
      {R"({"segment":"line2","contact":{"normal":{"type":"barrier"}}})", ENTS_BAD_VALUE,
       "/contact/normal/type: is \"barrier\"", "\"penalty\""},
      {R"({"segment":"line2","contact":{"normal":{"type":"penalty","stiffness":1},"frictoin":{}}})",
       ENTS_UNKNOWN_KEY, "/contact/frictoin: unknown key", "did you mean \"friction\"?"},
      {R"({"segment":"line2","contact":{"normal":{"type":"penalty","stiffness":1},"friction":{}}})",
       ENTS_UNKNOWN_KEY, "/contact/friction: the key \"type\" is missing", "\"coulomb\""},
      {R"({"segment":"line2","contact":{"normal":{"type":"power","coefficient":1,"exponent":1.3}}})",
       ENTS_BAD_VALUE, "/contact/normal/exponent: is 1.3, not one of", ""},
      {R"({"segment":"line2","contact":{"normal":{"type":"penalty","stiffness":1},"symmetrised":1}})",
       ENTS_BAD_VALUE, "/contact/symmetrised: is a number; write true or false", ""},
      {R"({"segment":"line2","tangent":"exact"})", ENTS_BAD_VALUE, "/tangent: is \"exact\"",
       "\"consistent\""},
      {R"({"segment":"line2","master":"stiff"})", ENTS_BAD_VALUE, "/master: is \"stiff\"", "\"rigid\""},
      {R"({"segment":"line2","penetration_limit":0})", ENTS_BAD_VALUE, "/penetration_limit: is 0.0", ""},
      {R"({"segment":"line2","border":0.6})", ENTS_BAD_VALUE, "/border: is 0.6, not in 1e-9 .. 0.5", ""},
  });
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

TEST(ModelJson, NestingHasALimit) {
  for (const char* open : {"[", "{\"a\":"}) {
    EXPECT_EQ(verdict(repeated(open, 1000000)).status, ENTS_BAD_VALUE);
    EXPECT_EQ(verdict(repeated(open, 33)).status, ENTS_BAD_VALUE);
    EXPECT_EQ(verdict(repeated(open, 32)).status, ENTS_JSON_SYNTAX);
  }
  const auto [status, message] = verdict(repeated("[0,", 40));
  EXPECT_EQ(message.substr(0, 9), "/1/1/1/1/") << message;
  EXPECT_NE(message.find("deeper than 32"), std::string::npos) << message;

  const auto nested = [](int levels) { // of sums; the constant is one level more
    return with_height("line2", repeated(R"({"type":"sum","of":[)", levels) +
                                    R"({"type":"constant","value":1})" + repeated("]}", levels));
  };
  EXPECT_EQ(verdict(nested(max_height_depth - 1)).status, ENTS_OK);
  const auto [too_deep, advice] = verdict(nested(max_height_depth));
  EXPECT_EQ(too_deep, ENTS_BAD_VALUE);
  EXPECT_NE(advice.find("at most 8 levels deep"), std::string::npos) << advice;
}

TEST(ModelJson, SizesHaveLimits) {
  const auto [size_status, size_message] = verdict(std::string(largest_json_text + 1, ' '));
  EXPECT_EQ(size_status, ENTS_BAD_VALUE);
  EXPECT_NE(size_message.find("67108865 bytes"), std::string::npos) << size_message;
  EXPECT_EQ(
      verdict(with_height("line2", R"({"type":"polynomial","coefficients":[0)" + repeated(",0", 64) + "]}"))
          .status,
      ENTS_BAD_VALUE);
  EXPECT_EQ(
      verdict(with_height("line2", R"({"type":"polynomial","coefficients":[0)" + repeated(",0", 63) + "]}"))
          .status,
      ENTS_OK);
  // a text as long as that stays out of the message
  const auto [status, message] = verdict(R"({"segment":")" + std::string(1 << 20, 'x') + R"("})");
  EXPECT_EQ(status, ENTS_BAD_VALUE);
  EXPECT_LT(message.size(), 512u);
  EXPECT_LT(verdict(R"({")" + std::string(1 << 20, 'x') + R"(":1})").message.size(), 512u);
  EXPECT_LT(verdict(R"({")" + std::string(1 << 20, 'x')).message.size(), 512u);
}

} // namespace
} // namespace model_mistakes_test
