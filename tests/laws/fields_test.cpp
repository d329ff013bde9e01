// SPDX-License-Identifier: BSD-3-Clause
// Fields: heights whose samples lie in the host's memory.
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "law_elements.hpp"
#include "model_handle.hpp"

namespace laws::fields_test {
namespace {

// A field through samples is the map through them.
TEST(Fields, AFieldIsTheMapOfItsSamples) {
  Random random(13);
  for (const char* boundary : {"periodic", "clamped"})
    for (const int t : {1, 2}) {
      json samples = json::array();
      std::vector<double> numbers;
      for (int j = 0; j < (t == 1 ? 1 : 5); ++j) {
        json row = json::array();
        for (int i = 0; i < 6; ++i) row.push_back(numbers.emplace_back(random.uniform(-0.02, 0.02)));
        samples.push_back(row);
      }
      const json size = t == 1 ? json{2.0} : json{2.0, 2.5}, origin = t == 1 ? json{-1.0} : json{-1.0, -1.0};
      json text = {{"segment", t == 1 ? "line2" : "quad4"}};
      text["height"] = {{"type", "map"},
                        {"values", t == 1 ? samples[0] : samples},
                        {"boundary", boundary},
                        {"size", size},
                        {"origin", origin}};
      const Handle map = make(text);
      text["height"] = {{"type", "field"},      {"name", "f"},  {"points", t == 1 ? json{6} : json{6, 5}},
                        {"boundary", boundary}, {"size", size}, {"origin", origin}};
      const Handle model = make(text);
      std::int64_t length = 0;
      ASSERT_EQ(ents_field_size(model.get(), "f", &length, nullptr), ENTS_OK);
      std::vector<double> block(static_cast<std::size_t>(length));
      ASSERT_EQ(ents_field_init(model.get(), "f", numbers.data(), block.data(), length, nullptr), ENTS_OK);
      ents_data field{};
      field.struct_size = sizeof field, field.name = "f", field.values = block.data(), field.rows = 1,
      field.columns = length;
      ents_model* bound = nullptr;
      ASSERT_EQ(ents_model_bind(model.get(), nullptr, &field, 1, &bound, nullptr), ENTS_OK);
      const std::vector<double> master = t == 1 ? std::vector<double>{-1, 0, 1, 0}
                                                : std::vector<double>{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
      for (int i = 0; i < 100; ++i) {
        const double xi[2] = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
        double a, b, c;
        ents_surface surface{};
        surface.struct_size = sizeof surface, surface.master = master.data(), surface.xi = xi,
        surface.height = &a;
        ASSERT_EQ(ents_surface_evaluate(map.get(), 1, &surface, nullptr), ENTS_OK);
        surface.height = &b;
        ASSERT_EQ(ents_surface_evaluate(bound, 1, &surface, nullptr), ENTS_OK);
        ASSERT_EQ(ents_field_sample(model.get(), "f", block.data(), length, 1, xi, &c, nullptr), ENTS_OK);
        EXPECT_EQ(a, b);
        EXPECT_EQ(a, c);
      }
      ents_model_destroy(&bound, nullptr);
    }
}

} // namespace
} // namespace laws::fields_test
