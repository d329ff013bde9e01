// SPDX-License-Identifier: BSD-3-Clause
// Arguments of the calls around the elements: states, slave surfaces, areas, checks, counts.
#include <gtest/gtest.h>

#include <climits>

#include "support/arguments.hpp"

namespace other_arguments_test {
namespace {

using namespace test;

// An element may be evaluated twice, so that its state must not be written over.
TEST_F(Arguments, StatesDoNotOverlap) {
  const int64_t size = model.layout.state_size;
  std::vector<double> states(static_cast<std::size_t>(4 * size));
  call::state_init(model.get(), int64_t{4}, states.data(), size, nullptr);
  for (const int32_t wanted : {int32_t{ENTS_STATE}, want_all}) {
    input.state_begin = states.data(), input.state_begin_stride = size;
    output.wanted = wanted;
    output.state_end_stride = size;
    for (const int64_t apart : {int64_t{0}, int64_t{1}, size - 1}) {
      output.state_end = states.data() + apart;
      const ents_input in = input;
      const ents_output out = output;
      refused(ENTS_BAD_VALUE, "output.state_end overlaps input.state_begin");
      input = in, output = out;
    }
    output.state_end = states.data() + size;
    EXPECT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{1}, &input, &output, &report), ENTS_OK)
        << report.message;
    reset();
  }
}

// [element][begin | end]: as near as can be, and in no common place.
TEST_F(Arguments, StatesMayLieBetweenEachOther) {
  constexpr int64_t count = 5;
  const int64_t size = model.layout.state_size, most = std::max<int64_t>(3 * size, 32);
  std::vector<double> states(static_cast<std::size_t>(most * (count + 1))),
      ends(static_cast<std::size_t>(count * size));
  for (int i = 0; i < input_count; ++i) input.*inputs[i].stride = 0; // five times the same element
  output.status = nullptr;
  for (const int32_t wanted : {int32_t{ENTS_STATE}, ENTS_STATE | ENTS_GAP_GRADIENT})
    for (const int64_t stride : {2 * size, 2 * size + 1, 3 * size})
      for (int64_t apart = 0; apart < stride; ++apart)
        for (const bool end_first : {false, true})
          for (const int64_t first : {int64_t{0}, int64_t{2}}) {
            double *begin = states.data() + (end_first ? apart : 0),
                   *end = states.data() + (end_first ? 0 : apart);
            call::state_init(model.get(), count, begin, stride, nullptr);
            std::vector<double> gradient(static_cast<std::size_t>(count * model.layout.dofs));
            output.wanted = wanted;
            output.gap_gradient = gradient.data(), output.gap_gradient_stride = model.layout.dofs;
            input.state_begin = begin, input.state_begin_stride = stride;
            output.state_end = ends.data(), output.state_end_stride = size;
            ASSERT_EQ(call::evaluate(model.get(), first, count - first, &input, &output, &report), ENTS_OK)
                << report.message;
            output.state_end = end, output.state_end_stride = stride;
            const int32_t status =
                call::evaluate(model.get(), first, count - first, &input, &output, &report);
            const bool disjoint = apart >= size && apart + size <= stride;
            ASSERT_EQ(status, disjoint ? ENTS_OK : ENTS_BAD_VALUE)
                << "stride " << stride << ", " << apart << " apart";
            for (int64_t e = first; disjoint && e < count; ++e)
              for (int64_t i = 0; i < size; ++i)
                ASSERT_EQ(end[e * stride + i], ends[static_cast<std::size_t>(e * size + i)]);
          }
  reset();
}

TEST_F(Arguments, SlaveSurfaces) {
  // turned about the axis of r = 0, a facet must not cross it
  const double crossing[] = {0.1, 0.0, 1.0, 0.0, -0.9, 1.0};
  const int64_t line[] = {0, 1, 1, 2};
  double areas[3] = {7, 7, 7};
  EXPECT_EQ(call::tributary_areas("line2", int64_t{2}, line, int64_t{3}, crossing, 0.0, areas, &report),
            ENTS_DEGENERATE_SEGMENT);
  for (const double a : areas) EXPECT_EQ(a, 7.0);
  int64_t begin[5] = {7, 7, 7, 7, 7}, nodes[8] = {7, 7, 7, 7, 7, 7, 7, 7};
  double weights[8] = {7, 7, 7, 7, 7, 7, 7, 7}, of_points[4] = {7, 7, 7, 7};
  EXPECT_EQ(
      ents_sampling_points("line2", 2, 2, line, 3, crossing, 0.0, begin, nodes, weights, of_points, &report),
      ENTS_DEGENERATE_SEGMENT);
  for (const double w : weights) EXPECT_EQ(w, 7.0);
  for (const double a : of_points) EXPECT_EQ(a, 7.0);
  ents_combination combination{};
  combination.struct_size = sizeof combination;
  const int64_t from[] = {1, 2}, of[] = {0, 1};
  const double factors[] = {5, 1};
  double point[2] = {7, 7};
  combination.points = 1, combination.begin = from, combination.nodes = of, combination.weights = factors;
  EXPECT_EQ(ents_combine(&combination, 2, 3, crossing, point, &report), ENTS_BAD_VALUE);
  EXPECT_NE(std::string(report.message).find("begin[0] is 1"), std::string::npos) << report.message;
}

// Quadratic facets are shared out by squares of areas, which leave the range of numbers long before the areas
// do.
TEST_F(Arguments, AreasOfAnySize) {
  const int64_t connectivity[] = {0, 1, 2};
  for (const double size : {1.0, 1e-82, 1e-140, 1e78, 1e140}) {
    const double line[] = {0, 0, 2 * size, 0, size, 0};
    double areas[3] = {};
    ASSERT_EQ(
        call::tributary_areas("line3", int64_t{1}, connectivity, int64_t{3}, line, size, areas, &report),
        ENTS_OK)
        << report.message;
    EXPECT_NEAR((areas[0] + areas[1] + areas[2]) / size / size, 2.0, 1e-14) << size;
    EXPECT_NEAR(areas[2] / areas[0], 4.0, 1e-13) << size;
  }
}

// In space the areas are areas, whatever the thickness.
TEST_F(Arguments, ThicknessIsOfThePlaneOnly) {
  const double square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const int64_t connectivity[] = {0, 1, 2, 3};
  for (const double thickness :
       {0.0, 3.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    double areas[4] = {7, 7, 7, 7};
    EXPECT_EQ(call::tributary_areas("quad4", int64_t{1}, connectivity, int64_t{4}, square, thickness, areas,
                                    &report),
              ENTS_OK)
        << report.message;
    for (const double a : areas) EXPECT_DOUBLE_EQ(a, 0.25);
    int64_t begin[2], nodes[4];
    double weights[4], area = 0.0;
    EXPECT_EQ(ents_sampling_points("quad4", 1, 1, connectivity, 4, square, thickness, begin, nodes, weights,
                                   &area, &report),
              ENTS_OK)
        << report.message;
    EXPECT_DOUBLE_EQ(area, 1.0);
    if (thickness >= 0.0 && std::isfinite(thickness)) continue;
    EXPECT_EQ(call::tributary_areas("line2", int64_t{1}, connectivity, int64_t{4}, square, thickness, areas,
                                    &report),
              ENTS_BAD_VALUE);
    EXPECT_NE(std::string(report.message).find("thickness"), std::string::npos) << report.message;
  }
}

// One struct for many segments: what is asked for stays asked for.
TEST_F(Arguments, TheCheckOfASegmentSaysWhatItSamples) {
  const Model line(
      R"({"segment": "line2", "height": {"type": "sine", "amplitude": 0.02, "wave_vector": [30], "phase": 0.3}})");
  const double nodes[] = {-1, 0, 1, 0}, smooth[] = {0, 0.01}, waves[] = {0, 5};
  ents_admissibility few{}, many{}, nine{};
  few.struct_size = many.struct_size = nine.struct_size = sizeof few;
  nine.samples = 9;
  ASSERT_EQ(call::model_check(line.get(), nodes, smooth, &few, &report), ENTS_OK);
  ASSERT_EQ(call::model_check(line.get(), nodes, waves, &many, &report), ENTS_OK);
  ASSERT_EQ(call::model_check(line.get(), nodes, waves, &nine, &report), ENTS_OK);
  EXPECT_LT(few.samples, 20);
  EXPECT_GT(many.samples, 150 * 4);
  EXPECT_GT(many.height_max, 0.0199);
  EXPECT_EQ(nine.samples, 9);
}

TEST_F(Arguments, CountsOfTheOtherFunctions) {
  std::vector<double> state(100);
  const int64_t size = model.layout.state_size;
  for (const int64_t bad : {int64_t{-1}, INT64_MIN, INT64_MAX, INT64_MAX / 2}) {
    EXPECT_EQ(call::state_init(model.get(), bad, state.data(), size, &report), ENTS_BAD_COUNT) << bad;
    EXPECT_NE(std::string(report.message).find("count"), std::string::npos) << report.message;
  }
  for (const int64_t bad : {int64_t{-1}, int64_t{0}, size - 1, INT64_MIN}) {
    EXPECT_EQ(call::state_init(model.get(), int64_t{1}, state.data(), bad, &report), ENTS_BAD_COUNT) << bad;
    EXPECT_NE(std::string(report.message).find("stride"), std::string::npos) << report.message;
  }
  EXPECT_EQ(call::state_init(model.get(), int64_t{3}, state.data(), INT64_MAX, &report), ENTS_BAD_COUNT);
  ents_surface surface{};
  surface.struct_size = sizeof surface;
  surface.master = surface.xi = element[master].data();
  for (const int64_t bad : {int64_t{-1}, INT64_MIN, INT64_MAX}) {
    EXPECT_EQ(call::surface_evaluate(model.get(), bad, &surface, &report), ENTS_BAD_COUNT);
    EXPECT_NE(std::string(report.message).find("count"), std::string::npos) << report.message;
  }
  ents_admissibility result{};
  result.struct_size = sizeof result;
  for (const int32_t bad : {-1, 1, 4097, INT_MAX, INT_MIN}) {
    result.samples = bad;
    EXPECT_EQ(call::model_check(model.get(), element[master].data(), nullptr, &result, &report),
              ENTS_BAD_COUNT);
    EXPECT_NE(std::string(report.message).find("result.samples"), std::string::npos) << report.message;
  }
  ents_model* made = nullptr;
  for (const int64_t bad : {int64_t{-2}, INT64_MIN}) {
    EXPECT_EQ(call::model_create("{}", bad, nullptr, nullptr, int64_t{0}, &made, &report), ENTS_BAD_COUNT);
    EXPECT_NE(std::string(report.message).find("length"), std::string::npos) << report.message;
  }
  EXPECT_EQ(call::model_create("{}", INT64_MAX, nullptr, nullptr, int64_t{0}, &made, &report),
            ENTS_BAD_VALUE);
  for (const int64_t bad : {int64_t{-1}, INT64_MIN, INT64_MAX, int64_t{1} << 31}) {
    EXPECT_EQ(call::model_create("{}", int64_t{-1}, nullptr, nullptr, bad, &made, &report), ENTS_BAD_COUNT);
    EXPECT_NE(std::string(report.message).find("data_count"), std::string::npos) << report.message;
  }
  double values[4] = {};
  ents_data data{};
  data.struct_size = sizeof data;
  data.name = "x";
  data.values = values;
  for (const int64_t bad : {int64_t{-1}, int64_t{0}, INT64_MIN, INT64_MAX, int64_t{1} << 32}) {
    data.rows = data.columns = bad;
    EXPECT_EQ(call::model_create("{}", int64_t{-1}, nullptr, &data, int64_t{1}, &made, &report),
              ENTS_BAD_COUNT)
        << bad;
    EXPECT_NE(std::string(report.message).find("rows"), std::string::npos) << report.message;
  }
  int64_t connectivity[4] = {0, 1, 2, 3};
  double areas[4];
  for (const int64_t bad : {int64_t{-1}, INT64_MIN, INT64_MAX}) {
    EXPECT_EQ(
        call::tributary_areas("quad4", bad, connectivity, 4, element[master].data(), 1.0, areas, &report),
        ENTS_BAD_COUNT);
    EXPECT_EQ(
        call::tributary_areas("quad4", 1, connectivity, bad, element[master].data(), 1.0, areas, &report),
        ENTS_BAD_COUNT);
    connectivity[2] = bad;
    EXPECT_EQ(call::tributary_areas("quad4", 1, connectivity, 4, element[master].data(), 1.0, areas, &report),
              ENTS_BAD_VALUE);
    EXPECT_NE(std::string(report.message).find("connectivity[2]"), std::string::npos) << report.message;
    connectivity[2] = 2;
  }
}

// The reason, and not what follows from it.
TEST(NamedReasons, FacetsAtANegativeRadiusAreNamedAsSuch) {
  const int64_t connectivity[] = {0, 1, 1, 2};
  const double positions[] = {2, 0, 1, 0, -0.5, 0}, gap[3] = {}, pressure[3] = {};
  double areas[3], weights[4];
  int64_t begin[3], nodes[4];
  ents_area area{};
  area.struct_size = sizeof area;
  ents_report report = new_report();
  const auto is_named = [&](int32_t status) {
    EXPECT_EQ(status, ENTS_DEGENERATE_SEGMENT);
    EXPECT_EQ(report.element, 1);
    EXPECT_NE(std::string(report.message).find("facet 1 has its node 2 at the radius -0.5"),
              std::string::npos)
        << report.message;
  };
  is_named(ents_tributary_areas("line2", 2, connectivity, 3, positions, 0.0, areas, &report));
  is_named(ents_sampling_points("line2", 1, 2, connectivity, 3, positions, 0.0, begin, nodes, weights, areas,
                                &report));
  is_named(
      ents_contact_area("line2", 2, connectivity, 3, positions, 0.0, gap, pressure, 0.0, &area, &report));
  EXPECT_EQ(ents_tributary_areas("line2", 2, connectivity, 3, positions, 1.0, areas, &report), ENTS_OK);
}

// A shadow ray that leaves the surface from behind, as with "direction" the way light shines: named.
TEST(NamedReasons, ADirectionFromBehindIsNamed) {
  for (const bool point : {false, true}) {
    const Model model(
        R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 1}}, "projection": )" +
        std::string(point ? R"({"type": "shadow_point", "emitter": [0, -5]}})"
                          : R"({"type": "shadow_direction", "direction": [0, -1]}})"));
    const double slave[] = {0.0, 0.1}, master[] = {-1, 0, 1, 0};
    double residual[6];
    ents_input in{};
    in.struct_size = sizeof in;
    in.slave = slave, in.master = master;
    ents_output out{};
    out.struct_size = sizeof out;
    out.wanted = ENTS_RESIDUAL, out.residual = residual;
    ents_report report = new_report();
    EXPECT_EQ(call::evaluate(model.get(), int64_t{0}, int64_t{1}, &in, &out, &report), ENTS_GRAZING_RAY);
    const std::string message = report.message;
    EXPECT_NE(message.find("from behind (n_e . e = -1)"), std::string::npos) << message;
    EXPECT_NE(message.find(point ? "\"emitter\" lies on the side of the slave nodes" : "turn its sign"),
              std::string::npos)
        << message;
  }
}

} // namespace
} // namespace other_arguments_test
