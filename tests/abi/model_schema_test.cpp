// SPDX-License-Identifier: BSD-3-Clause
// model.schema.json and the model reader say the same. From models that use every key, texts are made by
// removing, adding, renaming and replacing one thing; the reader must agree with the schema's verdict. And
// what the reader's own messages list as allowed keys and words is what the schema lists.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "abi/read/height_registry.hpp"
#include "model_errors.hpp"
#include "sample_count.hpp"
#include "schema_models.hpp"
#include "schema_validator.hpp"

namespace model_schema_test {
namespace {

using nlohmann::json;
using Pointer = json::json_pointer;
using namespace ents;
using ents::testing::schema_models;
using ents::testing::SchemaValidator;
using ents::testing::Verdict;

json schema() {
  std::ifstream stream(ENTS_SOURCE_DIR "/abi/model.schema.json");
  return json::parse(stream);
}

class ModelSchema : public ::testing::Test {
protected:
  static std::int32_t wave(void*, std::int32_t order, std::int32_t count, const double*, double* jet) {
    std::fill_n(jet, (order + 1) * count, 0.0);
    return 0;
  }
  void SetUp() override {
    ASSERT_TRUE(register_height({"wave", 1, wave, nullptr}));
    std::filesystem::create_directories(directory_);
    std::ofstream(directory_ / "matrix.txt") << "1 2 3\n4 5 6\n";
    std::ofstream(directory_ / "profile.txt") << "1 2 3\n";
    std::ofstream(directory_ / "scan.txt")
        << "# Width: 3 um\n# Height: 2 um\n# Value units: um\n1 2 3\n4 5 6\n";
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  Verdict read(const json& model) const {
    const NamedData data[] = {{"heights", samples_, 2, 3}, {"profile", samples_, 1, 3}};
    return ents::testing::verdict(model.dump(), directory_, data);
  }

  std::filesystem::path directory_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("ents_model_schema_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
  const double samples_[6] = {1, 2, 3, 4, 5, 6};
};

void every_place(const json& value, const Pointer& pointer,
                 const std::function<void(const Pointer&)>& visit) {
  visit(pointer);
  if (value.is_object())
    for (const auto& [key, child] : value.items()) every_place(child, pointer / key, visit);
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i) every_place(value[i], pointer / i, visit);
}

// What the schema cannot say because it depends on two places of the text, or on a file: the reader's message
// has one of these parts. Everything else that the schema accepts, the reader accepts.
bool depends_on_more(const std::string& message) {
  for (const char* part : {
           "one per surface coordinate of the segment", // as many entries as the segment has coordinates
           "the surface coordinates of this master node",
           "master nodes, write one array for each",
           "the emitter's position",
           "any length but zero",
           "is zero; write any other vector", // 2 in 2D, 3 in 3D, not all zero
           "c[i] of s1^i",
           "strength^2 / (2 energy)", // numbers of a law that do not fit each other
           "strength / stiffness",
           "strength^2 / work",
           "is of a normal law that adheres",
           "whose damage does not weaken shear",
           "is not possible with a normal law that pulls",
           "write both, or neither", // static and kinetic friction
           "beside a table of coefficients",
           "one per slip rate", // tables of coefficients
           "one per pressure",
           "not above the number before it",
           "the rate at which sticking ends",
           "c[i][j] of s1^i s2^j", // coefficients: flat in 2D, rows in 3D
           "numbers, the samples along s1",
           "rows, each an array of numbers",
           "as in row 0",
           "is an array; write a number", // values: the same
           "a clamped map needs at least 2",
           "one row",
           "states no units",
           "\"size\" is missing; the file", // depends on the file or data
           "there is no such file",
           "is not a regular file",
           "no array called",
           "the patch's nodes that this segment has", // as many as the segment has
           "a length from 0 to the pitch",
           "leave nothing of \"pitch\" for the flanks",
           "a length from pitch / 2048 to pitch / 4",
           "has no angle round the axis", // in 2D
           "twice",
           "one for each place", // tables of heat, which rise from 0 and may end in 0
           "not above the number before it",
           "a table begins at 0",
           "the last one is 0",
           "needs friction",
           "it is a part of the whole",        // heat of it
           "has to be the \"by\" of a height", // what flattening scales
           "is not possible with",
           "the height without pressure",
           "has no segment with node",                   // numbered without gaps
           "write a number, or a name that the model's", // "parameters" have
           "is a parameter whose value is",
           "has a parameter without a name",
           "is the name of another field",
           "is empty; write a name for the field",
           "write a whole number of samples",
           "needs a normal law whose pressure follows from the gap",
           "no height function called",
           "are not in order; write the shortest",
           "samples along a surface coordinate of the period",
           "not a power of two",
           "the shortest wavelength has at least 4 samples",
           "have no wave of the period between them",
           "one per wave vector",
           "is longer than all waves", // what a cut-off leaves
           "one per gap",
           "not above the gap before it",
           "not below the pressure before it",
           "the last pressure is 0",
           "is not above \"low\" in each surface coordinate",
           "/height/h: ", // whether a text is an expression
           "/of/2/h: ",
           "samples along each surface coordinate", // as many as the segment has
           "is not a name: write a letter",
           "is taken: u and v are",
       })
    if (message.find(part) != std::string::npos) return true;
  return false;
}

TEST_F(ModelSchema, TheModelsAreValid) {
  const SchemaValidator validator(schema());
  for (const json& model : schema_models()) {
    EXPECT_TRUE(validator.accepts(model)) << model;
    EXPECT_EQ(read(model).status, ENTS_OK) << model << "\n" << read(model).message;
  }
}

// One change anywhere: same verdict.
TEST_F(ModelSchema, ReaderAndSchemaAgreeOnEveryChange) {
  const SchemaValidator validator(schema());
  std::set<json> replacements = {nullptr,
                                 true,
                                 false,
                                 1.5,
                                 1.25,
                                 30,
                                 "text",
                                 "",
                                 0,
                                 1,
                                 -1,
                                 2.5,
                                 1e101,
                                 -1e101,
                                 1e-101,
                                 json::array(),
                                 json::object(),
                                 {1},
                                 {1, 2},
                                 {1, 2, 3},
                                 {0, 0},
                                 {"a"},
                                 {{1, 2}, {3, 4}},
                                 {{1}, {2}},
                                 {{"type", "constant"}, {"value", 1}},
                                 {{"type", "normal"}}};
  // every word of the schema in every place
  every_place(schema(), Pointer(), [&](const Pointer& at) {
    const json value = schema().at(at);
    const std::string path = at.to_string();
    if (value.is_string() && (path.find("/enum/") != std::string::npos || path.ends_with("/const")))
      replacements.insert(value);
  });

  int accepted = 0, refused = 0;
  test::Turns turns(37);
  // change(copy): made of the models whose turn it is
  const auto compare = [&](const json& model, const auto& change) {
    if (!turns.take()) return;
    json changed = model;
    change(changed);
    const Verdict got = read(changed);
    if (validator.accepts(changed)) {
      EXPECT_TRUE(got.status == ENTS_OK || depends_on_more(got.message))
          << changed << "\nreader: " << got.message;
      ++accepted;
    } else {
      EXPECT_NE(got.status, ENTS_OK) << changed << "\nonly the schema refuses";
      ++refused;
    }
  };
  for (const json& model : schema_models())
    every_place(model, Pointer(), [&](const Pointer& at) {
      for (const json& replacement : replacements)
        compare(model, [&](json& changed) { changed[at] = replacement; });
      if (model.at(at).is_array())
        for (const int count : {1, 3, 73})
          compare(model, [&](json& longer) {
            for (int i = 0; i < count; ++i)
              longer[at].push_back(model.at(at).empty() ? json(1) : model.at(at).back());
          });
      if (model.at(at).is_object()) compare(model, [&](json& more) { more[at]["x"] = 1; });
      if (at.empty()) return;
      const Pointer parent = at.parent_pointer();
      if (model.at(parent).is_object()) {
        compare(model, [&](json& fewer) { fewer[parent].erase(at.back()); });
        compare(model, [&](json& renamed) {
          renamed[parent].erase(at.back());
          renamed[parent][at.back() + "s"] = model.at(at);
        });
      } else {
        compare(model, [&](json& fewer) { fewer[parent].erase(std::stoul(at.back())); });
      }
    });
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 1000);
}

std::set<std::string> words_after(const std::string& message, const std::string& start) {
  std::set<std::string> words;
  std::size_t at = message.find(start);
  if (at == std::string::npos) return words;
  while ((at = message.find('"', at)) != std::string::npos) {
    const std::size_t end = message.find('"', at + 1);
    words.insert(message.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return words;
}

// What the reader says it takes is what the schema lists, in every object of every model.
TEST_F(ModelSchema, ReaderTakesNoKeyThatTheSchemaLacks) {
  const SchemaValidator validator(schema());
  for (const json& model : schema_models())
    every_place(model, Pointer(), [&](const Pointer& at) {
      if (!model.at(at).is_object()) return;
      json changed = model;
      changed[at]["no such key"] = 1;
      const std::vector<const json*> described = validator.object_schemas(model, at);
      ASSERT_EQ(described.size(), 1u) << model << " at " << at.to_string();
      if (described[0]->at("additionalProperties").is_object()) return; // names of the user's own
      std::set<std::string> keys, required;
      for (const auto& [key, unused] : described[0]->at("properties").items()) keys.insert(key);
      EXPECT_EQ(words_after(read(changed).message, "llowed here: "), keys) << read(changed).message;

      for (const json& key : described[0]->value("required", json::array())) {
        json fewer = model;
        fewer[at].erase(key.get<std::string>());
        EXPECT_EQ(read(fewer).status, ENTS_UNKNOWN_KEY) << fewer;
      }
    });
}

TEST_F(ModelSchema, ReaderTakesNoWordThatTheSchemaLacks) {
  const json text = schema();
  const auto listed = [&](const json& list) {
    std::set<std::string> words;
    for (const json& word : list) words.insert(word.get<std::string>());
    return words;
  };
  const auto types = [&](const json& branches) { // "type" of every branch of a oneOf
    std::set<std::string> words;
    for (const json& branch : branches) {
      if (branch.contains("type") && branch.at("type") == "null") continue;
      const json& type = branch.at("properties").at("type");
      if (type.contains("const"))
        words.insert(type.at("const"));
      else
        words.merge(listed(type.at("enum")));
    }
    return words;
  };
  const json& keys = text.at("properties");
  const auto read_words = [&](const json& model) { return words_after(read(model).message, "rite "); };
  EXPECT_EQ(read_words({{"segment", 1}}), listed(keys.at("segment").at("enum")));
  EXPECT_EQ(read_words({{"segment", "line2"}, {"tangent", 1}}), listed(keys.at("tangent").at("enum")));
  EXPECT_EQ(read_words({{"segment", "line2"}, {"master", 1}}), listed(keys.at("master").at("enum")));
  EXPECT_EQ(read_words({{"segment", "line2"}, {"projection", {{"type", 1}}}}),
            types(keys.at("projection").at("oneOf")));
  EXPECT_EQ(read_words({{"segment", "line2"}, {"contact", {{"normal", {{"type", 1}}}}}}),
            types(keys.at("contact").at("properties").at("normal").at("oneOf")));
  EXPECT_EQ(
      read_words(
          {{"segment", "line2"},
           {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 1}}}, {"friction", {{"type", 1}}}}}}),
      types(keys.at("contact").at("properties").at("friction").at("oneOf")));
  EXPECT_EQ(read_words({{"segment", "line2"}, {"height", {{"type", 1}}}}),
            types(text.at("$defs").at("height").at("oneOf")));
  EXPECT_EQ(read_words({{"segment", "line2"},
                        {"height", {{"type", "map"}, {"values", {1}}, {"size", {1}}, {"boundary", 1}}}}),
            listed(text.at("$defs").at("boundary").at("enum")));
}

// The models above reach every property of the schema, so the tests above have seen all of it.
TEST_F(ModelSchema, EveryPropertyIsUsed) {
  const json text = schema();
  const SchemaValidator validator(text);
  std::set<std::pair<std::string, std::string>> keys_used;
  for (const json& model : schema_models())
    every_place(model, Pointer(), [&](const Pointer& at) {
      if (!model.at(at).is_object()) return;
      for (const json* object : validator.object_schemas(model, at))
        for (const auto& [key, unused] : model.at(at).items()) keys_used.insert({object->dump(), key});
    });
  every_place(text, Pointer(), [&](const Pointer& at) {
    const json& object = text.at(at);
    if (!object.is_object() || !object.contains("additionalProperties")) return;
    for (const auto& [key, unused] : object.at("properties").items())
      EXPECT_TRUE(keys_used.count({object.dump(), key})) << key << " at " << at.to_string();
  });
}

} // namespace
} // namespace model_schema_test
