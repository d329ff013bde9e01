// SPDX-License-Identifier: BSD-3-Clause
// The mistakes people make: each gives its status and a message that names the key, the file or the argument
// and says what to do. (Every rule of the model text: model_json_test.)
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "support/element.hpp"

namespace bad_input_test {
namespace {

using namespace test;

struct Case {
  const char* text;
  int32_t status;
  std::vector<const char*> words; // of the message
};

TEST(BadInput, ModelTexts) {
  const Case cases[] = {
      {R"({"segment": "quad4", "hight": null})", ENTS_UNKNOWN_KEY, {"/hight", "\"height\""}},
      {R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 1, "wave_vector": [1, 0], "phse": 0}})",
       ENTS_UNKNOWN_KEY,
       {"/height/phse", "\"phase\""}},
      {R"({"height": null})", ENTS_UNKNOWN_KEY, {"\"segment\"", "missing"}},
      {R"({"segment": "quad4", "segment": "tri3"})", ENTS_UNKNOWN_KEY, {"/segment", "twice"}},
      {R"({"segment": 4})", ENTS_BAD_VALUE, {"/segment", "a number", "\"quad4\""}},
      {R"({"segment": "quad5"})", ENTS_BAD_VALUE, {"/segment", "\"quad5\"", "\"quad4\""}},
      {R"({"segment": "quad4", "contact": true})", ENTS_BAD_VALUE, {"/contact", "object"}},
      {R"({"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": 0}}})",
       ENTS_BAD_VALUE,
       {"/contact/normal/stiffness", "is 0"}},
      {R"({"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": -5}}})",
       ENTS_BAD_VALUE,
       {"/contact/normal/stiffness", "is -5"}},
      {R"({"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": "1e3"}}})",
       ENTS_BAD_VALUE,
       {"/contact/normal/stiffness", "1e3", "number"}},
      {R"({"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": NaN}}})",
       ENTS_JSON_SYNTAX,
       {"byte offset"}},
      {R"({"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": 1}, "friction": {"type": "coulomb", "coefficient": -0.1, "stiffness": 1}}})",
       ENTS_BAD_VALUE,
       {"/contact/friction/coefficient", "is -0.1"}},
      {R"({"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": 1}, "friction": {"type": "coulomb", "coefficient": 0.1, "stiffness": 0}}})",
       ENTS_BAD_VALUE,
       {"/contact/friction/stiffness", "is 0"}},
      {R"({"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": 1}, "friction": {"type": "coulomb", "coefficient": 0.1, "stiffness": 1, "shear_limit": 0}}})",
       ENTS_BAD_VALUE,
       {"/contact/friction/shear_limit", "is 0"}},
      {R"({"segment": "quad4", "contact": {"normal": {"type": "power", "coefficient": -1, "exponent": 2}}})",
       ENTS_BAD_VALUE,
       {"/contact/normal/coefficient", "is -1"}},
      {R"({"segment": "quad4", "penetration_limit": -1})", ENTS_BAD_VALUE, {"/penetration_limit"}},
      {R"({"segment": "quad4", "penetration_limit": 0})", ENTS_BAD_VALUE, {"/penetration_limit"}},
      {R"({"segment": "quad4", "penetration_limit": 1e999})",
       ENTS_BAD_VALUE,
       {"/penetration_limit", "1e999"}},
      {R"({"segment": "quad4", "projection": {"type": "shadow_direction", "direction": [0, 0, 0]}})",
       ENTS_BAD_VALUE,
       {"/projection/direction", "zero"}},
      {R"({"segment": "quad4", "projection": {"type": "shadow_point", "emitter": [0, 0]}})",
       ENTS_BAD_VALUE,
       {"/projection/emitter", "3 numbers"}},
      {R"({"segment": "line2", "height": {"type": "gaussian", "amplitude": 1, "center": [0], "width": 0}})",
       ENTS_BAD_VALUE,
       {"/height/width"}},
      {R"({"segment": "line2", "surface_coordinates": [[0]]})",
       ENTS_BAD_VALUE,
       {"/surface_coordinates", "2 master nodes"}},
      {R"({"segment": "line2",})", ENTS_JSON_SYNTAX, {"byte offset 20"}},
      {R"({"segment": "line2"} and more)", ENTS_JSON_SYNTAX, {"byte offset"}},
      {"", ENTS_JSON_SYNTAX, {"byte offset 0"}},
      {R"({"segment": "line2", "height": {"type": "map", "file": "no_such_file.txt", "boundary": "clamped", "size": [1]}})",
       ENTS_FILE,
       {"/height/file", "no_such_file.txt", "no such file"}},
      {R"({"segment": "line2", "height": {"type": "map", "data": "scan", "boundary": "clamped", "size": [1]}})",
       ENTS_BAD_VALUE,
       {"/height/data", "\"scan\""}},
  };
  for (const Case& c : cases) {
    ents_model* model = reinterpret_cast<ents_model*>(&model);
    ents_report report = new_report();
    EXPECT_EQ(call::model_create(c.text, int64_t{-1}, nullptr, nullptr, int64_t{0}, &model, &report),
              c.status)
        << c.text;
    EXPECT_EQ(model, nullptr);
    EXPECT_EQ(report.status, c.status);
    EXPECT_EQ(report.element, -1);
    EXPECT_EQ(report.step_factor, 1.0);
    for (const char* word : c.words)
      EXPECT_NE(std::string(report.message).find(word), std::string::npos)
          << word << " is not in: " << report.message;
  }
}

TEST(BadInput, FilesThatAreNotThere) {
  ents_model* model = nullptr;
  ents_report report = new_report();
  EXPECT_EQ(call::model_create_from_file("/no/such/folder/model.json", &model, &report), ENTS_FILE);
  EXPECT_NE(std::string(report.message).find("/no/such/folder/model.json"), std::string::npos)
      << report.message;
  EXPECT_EQ(call::model_create_from_file("/", &model, &report), ENTS_FILE);
  EXPECT_EQ(call::model_create_from_file("", &model, &report), ENTS_FILE);
}

TEST(BadInput, CoordinatesThatAreNotNumbers) {
  Random random(141);
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (const ModelKind& kind : some_kinds()) {
    const Model model(text(kind));
    Element good = draw(model, basis(kind.basis), random);
    if (good[surface_coordinates].empty())
      good[surface_coordinates].resize(size_of_input(model.layout, surface_coordinates), 0.5);
    Results results(model.layout);
    for (int i = 0; i < input_count; ++i)
      for (std::size_t k = 0; k < good[i].size(); ++k)
        for (const double bad : {nan, infinity, -infinity}) {
          Element e = good;
          e[i][k] = bad;
          ents_report report = new_report();
          ASSERT_EQ(test::evaluate(model, e, want_all, results, &report), ENTS_NON_FINITE);
          const std::string expected = std::string("input.") + inputs[i].name + "[" + std::to_string(k) +
                                       "] of element 0 is " + (bad == bad ? "infinite" : "NaN");
          ASSERT_EQ(report.message, expected);
          ASSERT_EQ(report.element, 0);
        }
  }
}

TEST(BadInput, CoordinatesOfTheOtherFunctions) {
  const Model model(text({"quad4", "sine"}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> nodes = flat_master(basis("quad4")), coordinates(8, 0.5), xi = {0.1, 0.2, 0.3, 0.4},
                      point(6);
  ents_surface surface{};
  surface.struct_size = sizeof surface;
  surface.master = nodes.data();
  surface.surface_coordinates = coordinates.data();
  surface.xi = xi.data();
  surface.point = point.data();
  ents_admissibility result{};
  result.struct_size = sizeof result;
  ents_report report = new_report();
  const auto check = [&] {
    return call::model_check(model.get(), nodes.data(), coordinates.data(), &result, &report);
  };
  const auto evaluate = [&] { return call::surface_evaluate(model.get(), int64_t{2}, &surface, &report); };
  const auto expect = [&](double& entry, const std::function<int32_t()>& act, const char* message,
                          int64_t element) {
    const double good = entry;
    entry = nan;
    EXPECT_EQ(act(), ENTS_NON_FINITE);
    EXPECT_STREQ(report.message, message);
    EXPECT_EQ(report.element, element);
    entry = good;
  };
  expect(nodes[7], evaluate, "surface.master[7] is NaN", 0);
  expect(coordinates[3], evaluate, "surface.surface_coordinates[3] is NaN", 0);
  expect(xi[3], evaluate, "surface.xi[3] is NaN", 1);
  expect(nodes[5], check, "master[5] is NaN", -1);
  expect(coordinates[0], check, "surface_coordinates[0] is NaN", -1);
  const int64_t connectivity[] = {0, 1, 2, 3};
  double areas[4];
  expect(
      nodes[2],
      [&] { return call::tributary_areas("quad4", 1, connectivity, 4, nodes.data(), 1.0, areas, &report); },
      "positions[2] is not finite", -1);
}

TEST(BadInput, SegmentsWithoutArea) {
  const Model model(text({"tri3"}));
  Element e;
  e[slave] = {0.2, 0.2, -0.1};
  e[master] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
  Results results(model.layout);
  ents_report report = new_report();
  EXPECT_EQ(test::evaluate(model, e, want_element, results, &report), ENTS_DEGENERATE_SEGMENT);
  EXPECT_NE(std::string(report.message).find("element 0: degenerate segment"), std::string::npos)
      << report.message;
  EXPECT_TRUE(report.step_factor > 0.0 && report.step_factor < 1.0);
  ents_admissibility result{};
  result.struct_size = sizeof result;
  EXPECT_EQ(call::model_check(model.get(), e[master].data(), nullptr, &result, &report),
            ENTS_DEGENERATE_SEGMENT);
  EXPECT_NE(std::string(report.message).find("degenerate segment"), std::string::npos) << report.message;
  const std::vector<double> xi = {0.2, 0.2};
  ents_surface surface{};
  surface.struct_size = sizeof surface;
  surface.master = e[master].data();
  surface.xi = xi.data();
  EXPECT_EQ(call::surface_evaluate(model.get(), int64_t{1}, &surface, &report), ENTS_DEGENERATE_SEGMENT);
  EXPECT_EQ(report.element, 0);
  const std::vector<double> regular = flat_master(basis("tri3")), beyond = {1e308, 1e308};
  double point[3] = {7.0, 7.0, 7.0};
  surface.master = regular.data(), surface.xi = beyond.data(), surface.point = point;
  EXPECT_EQ(call::surface_evaluate(model.get(), int64_t{1}, &surface, &report), ENTS_OUT_OF_RANGE);
  EXPECT_EQ(point[0], 7.0);
  const int64_t connectivity[] = {0, 1, 2};
  double areas[3];
  EXPECT_EQ(call::tributary_areas("tri3", 1, connectivity, 3, e[master].data(), 1.0, areas, &report),
            ENTS_DEGENERATE_SEGMENT);
  EXPECT_NE(std::string(report.message).find("facet 0"), std::string::npos) << report.message;
}

// Messages fit into the report whatever they quote, and end within UTF-8 characters.
TEST(BadInput, LongAndForeignWordsInMessages) {
  for (const std::string& word : {std::string(5000, 'x'), std::string("\xC3\xA4\xC3\xB6\xC3\xBC"),
                                  std::string(300, '/'), std::string("\\u0000\\n\\t%s%n%d")}) {
    ents_model* model = nullptr;
    ents_report report = new_report();
    const std::string t = R"({"segment": "quad4", ")" + word + R"(": 1})";
    EXPECT_EQ(call::model_create(t.c_str(), int64_t{-1}, nullptr, nullptr, int64_t{0}, &model, &report),
              ENTS_UNKNOWN_KEY);
    const std::string message = report.message;
    EXPECT_LT(message.size(), sizeof report.message);
    EXPECT_NE(message.find("unknown key"), std::string::npos) << message;
    for (const char c : message) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) << message;
    EXPECT_NE(static_cast<unsigned char>(message.back()) & 0xC0, 0xC0) << "half a character";
  }
}

} // namespace
} // namespace bad_input_test
