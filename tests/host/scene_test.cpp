// SPDX-License-Identifier: BSD-3-Clause
// Scenes are read strictly: every mistake is named with its place.
#include "scene.hpp"

#include <gtest/gtest.h>

#include "support.hpp"

namespace host::scene_test {
namespace {

using test::axis;

Json good() {
  return {{"dimension", 2},
          {"formulation", "plane_strain"},
          {"materials", {{"m", {{"law", "linear_elastic"}, {"young", 1}, {"poisson", 0.3}}}}},
          {"parts",
           {{{"name", "b"},
             {"material", "m"},
             {"element", "quad4"},
             {"x", axis(0, 1, 2)},
             {"y", axis(0, 1, 2)}}}},
          {"supports", {{{"nodes", "b.y_min"}, {"x", 0}, {"y", 0}}}},
          {"contact",
           {{"slave", "b.y_max"},
            {"master", {{"nodes", {{1, 1}, {0, 1}}}, {"direction", {0, -2}}}},
            {"model",
             {{"segment", "line2"},
              {"height", nullptr},
              {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 100}}}}}}}}},
          {"steps", {{"control", "approach"}, {"values", {0.1}}}}};
}

TEST(Scene, IsRead) {
  const Scene scene = test::scene_from(good());
  EXPECT_EQ(scene.parts.size(), 1u);
  EXPECT_EQ(scene.contact->direction, (std::vector<double>{0, -1})); // made a unit vector
  EXPECT_EQ(scene.contact->model.at("master"), "rigid");
  EXPECT_EQ(scene.control, Control::approach);
}

struct Mistake {
  std::string name;
  std::function<void(Json&)> make;
  std::vector<std::string> said; ///< words the message must hold
};

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreNamedWithTheirPlace) {
  Json json = good();
  GetParam().make(json);
  try {
    const Scene scene = test::scene_from(json);
    Simulation simulation(scene, &test::library());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    for (const std::string& words : GetParam().said)
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Mistakes,
    testing::Values(
        Mistake{
            "unknown_key", [](Json& j) { j["parts"][0]["colour"] = 1; }, {"test.json", "/parts/0", "colour"}},
        Mistake{"missing_key", [](Json& j) { j["parts"][0].erase("element"); }, {"/parts/0", "element"}},
        Mistake{"wrong_type",
                [](Json& j) { j["materials"]["m"]["young"] = "1"; },
                {"/materials/m/young", "number"}},
        Mistake{
            "not_positive", [](Json& j) { j["materials"]["m"]["young"] = 0; }, {"/materials/m/young", "> 0"}},
        Mistake{"poisson", [](Json& j) { j["materials"]["m"]["poisson"] = 0.5; }, {"/materials/m/poisson"}},
        Mistake{
            "law", [](Json& j) { j["materials"]["m"]["law"] = "mooney"; }, {"/materials/m/law", "neo_hooke"}},
        Mistake{"no_material",
                [](Json& j) { j["parts"][0]["material"] = "steel"; },
                {"/parts/0/material", "steel"}},
        Mistake{"dimension", [](Json& j) { j["dimension"] = 4; }, {"/dimension", "2 to 3"}},
        Mistake{"element", [](Json& j) { j["parts"][0]["element"] = "hex8"; }, {"/parts/0/element", "quad4"}},
        Mistake{
            "grid", [](Json& j) { j["parts"][0]["x"]["pieces"][0]["to"] = -1; }, {"/parts/0/x/pieces/0/to"}},
        Mistake{"same_name", [](Json& j) { j["parts"].push_back(j["parts"][0]); }, {"/parts/1", "already"}},
        Mistake{"no_component",
                [](Json& j) { j["supports"][0].erase("x"), j["supports"][0].erase("y"); },
                {"/supports/0", "component"}},
        Mistake{"no_nodes",
                [](Json& j) { j["supports"][0]["nodes"] = "b.top"; },
                {"/supports/0/nodes", "b.y_max"}},
        Mistake{"no_faces", [](Json& j) { j["contact"]["slave"] = "b.top"; }, {"/contact/slave", "b.y_max"}},
        Mistake{"node_size",
                [](Json& j) {
                  j["contact"]["master"]["nodes"][0] = {1, 2, 3};
                },
                {"/contact/master/nodes/0", "2 numbers"}},
        Mistake{"node_count",
                [](Json& j) {
                  j["contact"]["master"]["nodes"].push_back({2, 2});
                },
                {"/contact/master/nodes", "2", "3"}},
        Mistake{"direction",
                [](Json& j) {
                  j["contact"]["master"]["direction"] = {0, 0};
                },
                {"/contact/master/direction"}},
        Mistake{"model_key",
                [](Json& j) { j["contact"]["model"]["hight"] = nullptr; },
                {"/contact/model", "hight"}},
        Mistake{"model_segment",
                [](Json& j) { j["contact"]["model"]["segment"] = "quad4"; },
                {"/contact/model/segment", "dimension"}},
        Mistake{"model_master",
                [](Json& j) { j["contact"]["model"]["master"] = "deformable"; },
                {"/contact/model"}},
        Mistake{"control", [](Json& j) { j["steps"]["control"] = "speed"; }, {"/steps/control", "approach"}},
        Mistake{"no_steps", [](Json& j) { j["steps"]["values"] = Json::array(); }, {"/steps/values"}},
        Mistake{"negative_force",
                [](Json& j) {
                  j["steps"] = {{"control", "force"}, {"values", {-1}}};
                },
                {"/steps/values"}},
        Mistake{"nothing_to_move",
                [](Json& j) {
                  j["contact"]["master"] = {{"faces", "b.y_min"}};
                },
                {"/steps/control", "rigid"}},
        Mistake{"tolerance",
                [](Json& j) {
                  j["solver"] = {{"tolerance", 10}};
                },
                {"/solver/tolerance", "< 1"}},
        Mistake{"exact_in_space",
                [](Json& j) {
                  j["exact"] = {{"type", "hertz_point"}, {"radius", 1}};
                },
                {"/exact/type", "space", "/dimension is 2"}},
        Mistake{
            "nothing_holds", [](Json& j) { j["supports"] = Json::array(); }, {"/supports", "nothing holds"}},
        Mistake{
            "nothing_given_that_holds", [](Json& j) { j.erase("supports"); }, {"/supports", "nothing holds"}},
        Mistake{"exact",
                [](Json& j) {
                  j["exact"] = {{"type", "hertz_line"}};
                },
                {"/exact", "radius"}},
        Mistake{"half_space",
                [](Json& j) {
                  j["half_space"] = {{"nodes", {"b.x_max"}}};
                },
                {"/half_space"}},
        Mistake{"periodic",
                [](Json& j) {
                  j["periodic"] = {{"b.x_min", "b.y_min", "b"}};
                },
                {"/periodic/0", "pair"}},
        Mistake{"not_periodic",
                [](Json& j) {
                  j["parts"].push_back(j["parts"][0]);
                  j["parts"][1]["name"] = "c";
                  j["parts"][1]["y"] = axis(0, 1, 3);
                  j["periodic"] = Json::array({Json::array({"b.x_min", "c.x_max"})});
                },
                {"/periodic/0", "same mesh"}}),
    [](const auto& test) { return test.param.name; });

TEST(Scene, DuplicateKeysAndSyntaxAreErrors) {
  EXPECT_THROW(read_scene_text(R"({"dimension": 2, "dimension": 3})", "a.json"), InputError);
  try {
    read_scene_text("{\n\"dimension\": 2,\n,}", "a.json");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a.json:3"), std::string::npos) << error.what();
  }
}

TEST(Scene, SpringsHoldWithoutSupports) {
  Json json = good();
  json.erase("supports");
  json["springs"] = {{{"faces", "b.y_min"}, {"stiffness", {1, 1}}}};
  const Scene scene = test::scene_from(json);
  EXPECT_TRUE(scene.supports.empty());
  EXPECT_NO_THROW(Simulation(scene, &test::library()));
}

// One key says what a model's law, its stiffness and its object would.
TEST(Scene, HardContactIsOneKey) {
  Json json = test::shipped("hertz2d");
  json["contact"]["law"] = "hard";
  EXPECT_NE(test::refusal(json).find("/contact/law: the model has a law, too"), std::string::npos);
  Json& law = json["contact"]["model"]["contact"];
  law.erase("normal");
  const Scene hard = test::scene_from(json);
  EXPECT_EQ(hard.contact->model["contact"]["normal"]["type"], "augmented_multiplier");
  law["friction"] = {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 1e4}}; // beside it
  EXPECT_EQ(test::scene_from(json).contact->model["contact"]["friction"]["coefficient"], 0.3);
  json["contact"]["model"].erase("contact");
  EXPECT_EQ(test::scene_from(json).contact->model["contact"], hard.contact->model["contact"]);
  json["contact"]["cut_off"] = 0.1;
  EXPECT_NE(test::refusal(json).find("/contact/law: "), std::string::npos);
  json["contact"].erase("cut_off"), json["contact"]["law"] = "soft";
  EXPECT_NE(test::refusal(json).find("/contact/law: "), std::string::npos);
}

// The three steps of the top README: the model beside the scan is the one of the scene.
TEST(Scene, TheModelBesideTheScanIsTheScenes) {
  const auto file = test::scene_file("rough_afm").parent_path() / "model.json";
  EXPECT_EQ(parse_json_file(file), test::shipped("rough_afm")["contact"]["model"]);
}

TEST(Scene, ShippedScenesAreRead) {
  for (const char* name : {"hertz2d", "hertz3d", "westergaard", "wavy3d", "rough_afm"}) {
    const Scene scene = test::shipped_scene(name);
    EXPECT_FALSE(scene.compare.divisions.empty()) << name;
    EXPECT_EQ(scene.contact->rigid.size() / static_cast<std::size_t>(scene.dimension),
              scene.dimension == 2 ? 2u : 4u)
        << name << ": the master is one segment";
  }
}

} // namespace
} // namespace host::scene_test
