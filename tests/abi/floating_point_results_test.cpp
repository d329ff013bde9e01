// SPDX-License-Identifier: BSD-3-Clause
// Results do not depend on the host's floating-point environment, and signalling NaNs do not trap.
#include <limits>

#include "sample_count.hpp"
#include "support/batch.hpp"
#include "support/floating_point_environment.hpp"

namespace floating_point_results_test {
namespace {

using namespace test;

TEST(FloatingPointEnvironment, DoesNotChangeResults) {
  Random random(43);
  int compared = 0;
  for (const ModelKind& kind : all_kinds()) {
    if (!test::is_taken(random)) continue;
    // made and evaluated in the setting: the model's own numbers are the same, too
    for (int repeat = 0; repeat < 2; ++repeat) {
      const Model reference(text(kind));
      Element e = draw(reference, basis(kind.basis), random);
      if (repeat == 1) {
        e[start].clear();
        e = with_history(reference, std::move(e), random);
        e[slave][0] += 3e-310; // denormal parts that flushing would drop
      }
      Results expected(reference.layout);
      const int32_t expected_status = test::evaluate(reference, e, want_all, expected);
      for (const Setting& setting : settings) {
        Results results(reference.layout);
        const ents_input input = input_of(e);
        const ents_output output = output_of(results, want_all);
        int32_t status = -1;
        ents_model* model = nullptr;
        const std::string model_text = text(kind);
        in(setting, [&] {
          ents_model_create(model_text.c_str(), -1, nullptr, nullptr, 0, &model, nullptr);
          status = ents_evaluate(model, 0, 1, &input, &output, nullptr);
        });
        ents_model_destroy(&model, nullptr);
        ASSERT_EQ(status, expected_status) << setting.name << " " << model_text;
        ASSERT_TRUE(same_bits(results, expected)) << setting.name << " " << model_text;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, test::samples(4000) / 2);
}

// One element per lane: some far away, from a start elsewhere, with denormal parts, or with another status.
TEST(FloatingPointEnvironment, DoesNotChangeCallsOfMany) {
  Random random(45);
  test::Turns turns(8);
  int compared = 0;
  for (const ModelKind& kind : some_kinds()) {
    if (!turns.take()) continue;
    const Model model(text(kind));
    std::vector<Element> elements = draw_batch(model, basis(kind.basis), random, true);
    for (double& x : elements[3][slave]) x = 1e9;
    for (double& x : elements[5][start]) x += 0.5;
    elements[7][slave][0] += 3e-310;
    elements[9][master].assign(elements[9][master].size(), 0.5);
    const auto evaluate = [&](Batch& batch) {
      return ents_evaluate(model.get(), 0, batch_size, &batch.input, &batch.output, nullptr);
    };
    Batch expected(model, elements, 0, 0, in_blocks);
    const int32_t expected_status = evaluate(expected);
    EXPECT_GE(expected_status, ENTS_OK);
    for (const Setting& setting : settings) {
      Batch batch(model, elements, 0, 0, in_blocks);
      int32_t status = -1;
      EXPECT_KEPT(setting, [&] { status = evaluate(batch); });
      ASSERT_EQ(status, expected_status) << setting.name << " " << text(kind);
      EXPECT_EQ(batch.integers, expected.integers) << setting.name << " " << text(kind);
      for (int i = 0; i < output_count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        EXPECT_TRUE(same_bits(batch.out[at], expected.out[at]))
            << outputs[i].name << ", " << setting.name << " " << text(kind);
      }
      ++compared;
    }
  }
  EXPECT_GT(compared, test::sample_divisor > 1 ? 0 : 250);
}

// Coordinates that are denormal as a whole: flushed they would be one point, and another verdict.
TEST(FloatingPointEnvironment, DenormalInputsGiveTheSameWithFlushToZero) {
  const Model model(R"({"segment": "line2"})");
  Element e;
  e[master] = {-1.0, 0.0, 1.0, 0.0};
  e[slave] = {3e-310, -2e-310};
  Results plain(model.layout), flushed(model.layout);
  ASSERT_EQ(test::evaluate(model, e, want_values, plain), ENTS_OK);
  EXPECT_EQ(plain.gap(), -2e-310);
  const ents_input input = input_of(e);
  const ents_output output = output_of(flushed, want_values);
  in(settings[6], [&] { ents_evaluate(model.get(), 0, 1, &input, &output, nullptr); });
  EXPECT_TRUE(same_bits(plain.of(ENTS_GAP), flushed.of(ENTS_GAP)));
  EXPECT_TRUE(same_bits(plain.of(ENTS_XI), flushed.of(ENTS_XI)));
}

// A signalling NaN - what a debugging host fills fresh memory with - makes even a comparison trap.
TEST(FloatingPointEnvironment, SignallingNaNsDoNotTrap) {
  const double signalling = std::numeric_limits<double>::signaling_NaN();
  const Setting& traps = settings[5];
  const Model model(text({"quad4", "sine", "normal", "", 9}));
  Random random(44);
  const Element good = with_new_state(model, draw(model, basis("quad4"), random));
  Results results(model.layout);
  const ents_output output = output_of(results, want_all);
  int32_t status = 0;
  for (int i = 0; i < input_count; ++i)
    for (std::size_t k = 0; k < good[i].size(); ++k) {
      Element e = good;
      e[i][k] = signalling;
      const ents_input input = input_of(e);
      EXPECT_KEPT(traps, [&] { status = ents_evaluate(model.get(), 0, 1, &input, &output, nullptr); });
      EXPECT_EQ(status, i == state_begin ? ENTS_BAD_STATE : ENTS_NON_FINITE) << inputs[i].name << " " << k;
    }
  const std::vector<double> fresh(64, signalling);
  std::vector<double> state = fresh, moved = fresh;
  const double* nodes = good[master].data();
  const int64_t size = model.layout.state_size;
  EXPECT_KEPT(traps, [&] {
    status = ents_state_augment(model.get(), 1, state.data(), size, fresh.data(), size, nullptr);
  });
  EXPECT_EQ(status, ENTS_BAD_STATE);
  EXPECT_KEPT(traps, [&] {
    status =
        ents_state_transfer(model.get(), nodes, nullptr, nodes, nullptr, fresh.data(), moved.data(), nullptr);
  });
  EXPECT_EQ(status, ENTS_BAD_STATE);
  EXPECT_KEPT(traps, [&] {
    status = ents_state_transfer(model.get(), fresh.data(), nullptr, nodes, nullptr, good[state_begin].data(),
                                 moved.data(), nullptr);
  });
  EXPECT_NE(status, ENTS_OK);
  EXPECT_KEPT(traps, [&] { status = ents_state_init(model.get(), 1, state.data(), size, nullptr); });
  EXPECT_EQ(status, ENTS_OK);
  const std::int64_t connectivity[] = {0, 1, 2, 3};
  double areas[4];
  EXPECT_KEPT(traps, [&] {
    status = ents_tributary_areas("quad4", 1, connectivity, 4, fresh.data(), 1.0, areas, nullptr);
  });
  EXPECT_EQ(status, ENTS_NON_FINITE);
  EXPECT_KEPT(traps, [&] {
    status = ents_tributary_areas("line2", 1, connectivity, 4, nodes, fresh[0], areas, nullptr);
  });
  EXPECT_EQ(status, ENTS_BAD_VALUE);
  ents_admissibility result{};
  result.struct_size = sizeof result;
  EXPECT_KEPT(traps,
              [&] { status = ents_model_check(model.get(), fresh.data(), nullptr, &result, nullptr); });
  EXPECT_EQ(status, ENTS_NON_FINITE);
  ents_surface surface{};
  surface.struct_size = sizeof surface;
  surface.master = nodes;
  surface.xi = fresh.data();
  surface.point = moved.data();
  EXPECT_KEPT(traps, [&] { status = ents_surface_evaluate(model.get(), 1, &surface, nullptr); });
  EXPECT_EQ(status, ENTS_NON_FINITE);
  ents_data data{};
  data.struct_size = sizeof data;
  data.name = "scan";
  data.values = fresh.data();
  data.rows = data.columns = 3;
  const char* t =
      R"({"segment": "quad4", "height": {"type": "map", "data": "scan", "boundary": "periodic", "size": [1, 1]}})";
  ents_model* made = nullptr;
  EXPECT_KEPT(traps, [&] { status = ents_model_create(t, -1, nullptr, &data, 1, &made, nullptr); });
  EXPECT_NE(status, ENTS_OK);
}

// Memory that has not been made a tree may hold anything.
TEST(FloatingPointEnvironment, SignallingNaNsInATreeDoNotTrap) {
  const Setting& traps = settings[5];
  const Model model(R"({"segment": "line2"})");
  const double positions[] = {0, 0, 2, 0}, slave[] = {1, -0.1};
  const int64_t connectivity[] = {0, 1};
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = 1, mesh.connectivity = connectivity, mesh.nodes = 2, mesh.positions = positions;
  int64_t size = 0, segment = -1;
  ASSERT_EQ(ents_tree_size(model.get(), 1, &size, nullptr), ENTS_OK);
  std::vector<double> tree(static_cast<std::size_t>(size), std::numeric_limits<double>::signaling_NaN());
  double xi = 0.0;
  ents_detection detection{};
  detection.struct_size = sizeof detection;
  detection.slave = slave, detection.reach = 1.0, detection.segment = &segment, detection.xi = &xi;
  int32_t status = 0;
  EXPECT_KEPT(
      traps, [&] { status = ents_detect(model.get(), &mesh, tree.data(), size, 0, 1, &detection, nullptr); });
  EXPECT_EQ(status, ENTS_BAD_STATE);
  EXPECT_KEPT(traps, [&] { status = ents_tree_refit(model.get(), &mesh, tree.data(), size, nullptr); });
  EXPECT_EQ(status, ENTS_BAD_STATE);
  EXPECT_KEPT(traps, [&] { status = ents_tree_build(model.get(), &mesh, tree.data(), size, nullptr); });
  EXPECT_EQ(status, ENTS_OK);
  EXPECT_KEPT(
      traps, [&] { status = ents_detect(model.get(), &mesh, tree.data(), size, 0, 1, &detection, nullptr); });
  EXPECT_EQ(status, ENTS_OK);
  EXPECT_EQ(segment, 0);
}

} // namespace
} // namespace floating_point_results_test
