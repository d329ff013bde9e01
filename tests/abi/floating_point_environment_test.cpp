// SPDX-License-Identifier: BSD-3-Clause
// The host's floating-point environment - rounding, traps, flags, flush to zero - is as it was after every
// call, on success and on every error, and the results do not depend on it.
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <functional>
#include <limits>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "sample_count.hpp"
#include "support/batch.hpp"

namespace floating_point_environment_test {
namespace {

using namespace test;

// Everything a host can see or set.
struct Environment {
  int rounding = 0, traps = 0, flags = 0;
  unsigned control = 0; // MXCSR, sticky flags included
  bool operator==(const Environment&) const = default;
};

Environment current() {
  Environment e;
  e.rounding = std::fegetround();
  e.traps = fegetexcept();
  e.flags = std::fetestexcept(FE_ALL_EXCEPT);
#if defined(__SSE2__)
  e.control = _mm_getcsr();
#endif
  return e;
}

struct Setting {
  const char* name;
  int rounding;
  int traps;
  bool flush; // results and inputs that are denormal count as 0
  int raised; // flags that stand already (without traps: a standing flag would trap)
};
constexpr int usual_traps = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
const Setting settings[] = {
    {"default", FE_TONEAREST, 0, false, 0},
    {"upward", FE_UPWARD, 0, false, 0},
    {"downward", FE_DOWNWARD, 0, false, 0},
    {"towards zero", FE_TOWARDZERO, 0, false, 0},
    {"traps", FE_TONEAREST, usual_traps, false, 0},
    {"all traps, upward", FE_UPWARD, FE_ALL_EXCEPT, false, 0},
    {"flush to zero", FE_TONEAREST, 0, true, 0},
    {"flush to zero, downward, traps, flags", FE_DOWNWARD, FE_UNDERFLOW, true, FE_INVALID | FE_INEXACT},
    {"flags", FE_TONEAREST, 0, false, FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW | FE_UNDERFLOW | FE_INEXACT},
};

// `body` in a setting; nothing else of the test may run in it. Returns the environments just before and
// after.
template <class Body> std::pair<Environment, Environment> in(const Setting& setting, Body&& body) {
  std::fenv_t saved;
  std::fegetenv(&saved);
  fedisableexcept(FE_ALL_EXCEPT);
  std::feclearexcept(FE_ALL_EXCEPT);
  std::feraiseexcept(setting.raised);
  std::fesetround(setting.rounding);
#if defined(__SSE2__)
  if (setting.flush) _mm_setcsr(_mm_getcsr() | 0x8040u); // FTZ and DAZ
#endif
  feenableexcept(setting.traps);
  const Environment before = current();
  body();
  const Environment after = current();
  std::fesetenv(&saved);
  return {before, after};
}

#define EXPECT_KEPT(setting, body)                                                                           \
  do {                                                                                                       \
    const auto environments = in(setting, body);                                                             \
    EXPECT_EQ(environments.first.rounding, environments.second.rounding) << (setting).name;                  \
    EXPECT_EQ(environments.first.traps, environments.second.traps) << (setting).name;                        \
    EXPECT_EQ(environments.first.flags, environments.second.flags) << (setting).name;                        \
    EXPECT_EQ(environments.first.control, environments.second.control) << (setting).name;                    \
  } while (false)

TEST(FloatingPointEnvironment, IsKeptByTenThousandEvaluationsAndTheirErrors) {
  Random random(41);
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                        1e308, 5e-324};
  int calls = 0, failed = 0;
  for (const ModelKind& kind : all_kinds()) {
    if (!is_taken(random)) continue;
    const Model model(text(kind));
    Results results(model.layout);
    for (const Setting& setting : settings)
      for (int repeat = 0; repeat < 5; ++repeat) {
        Element e = draw(model, basis(kind.basis), random);
        if (repeat == 1) e[start].clear();
        if (repeat == 2) e[slave][0] = bad[random.below(4)];
        if (repeat == 3) e[master].assign(e[master].size(), 0.5);
        if (repeat == 4) e = with_history(model, std::move(e), random);
        const ents_input input = input_of(e);
        const ents_output output = output_of(results, want_all);
        int32_t status = 0;
        EXPECT_KEPT(setting, [&] { status = ents_evaluate(model.get(), 0, 1, &input, &output, nullptr); });
        ++calls;
        failed += status != ENTS_OK;
      }
  }
  EXPECT_GE(calls, sample_divisor == 1 ? 10000 : 1);
  EXPECT_GT(failed, calls / 4);
  EXPECT_LT(failed, 3 * calls / 4);
}

// A slave over one quad4 as a host sees it: a tree, equations of nodes, an iteration.
struct OneSegment {
  OneSegment(const Model& its_model, std::vector<double> slave_position, std::vector<double> nodes)
      : model(its_model), slave(std::move(slave_position)), positions(std::move(nodes)),
        state(size(model.layout.state_size)), end(state.size()), residual(15), values(15 * 15),
        points(positions.size()) {
    mesh.struct_size = sizeof mesh;
    mesh.segments = 1, mesh.nodes = 4, mesh.connectivity = connectivity, mesh.positions = positions.data();
    detection.struct_size = sizeof detection;
    detection.slave = slave.data(), detection.reach = 1.0, detection.segment = &segment, detection.xi = xi,
    detection.flags = &found;
    ents_state_init(model.get(), 1, state.data(), model.layout.state_size, nullptr);
    output.struct_size = sizeof output;
    output.wanted = ENTS_STATE, output.state_end = end.data(),
    output.state_end_stride = model.layout.state_size;
    combination.struct_size = sizeof combination;
    combination.points = 4, combination.begin = numbers, combination.nodes = numbers,
    combination.weights = weights;
    for (std::int64_t i = 0; i < 16; ++i) row_begin[i] = 15 * i;
    for (std::int64_t i = 0; i < 15 * 15; ++i) columns.push_back(i % 15);
    for (std::int64_t i = 0; i < 15; ++i) equations[i] = i;
    system.struct_size = sizeof system;
    system.index_size = 8, system.slave_nodes = 1, system.slave_equations = equations,
    system.master = &combination;
    system.master_nodes = 4, system.master_equations = equations + 3, system.rows = 15,
    system.residual = residual.data();
    system.row_begin = row_begin, system.columns = columns.data(), system.values = values.data();
  }
  static std::size_t size(std::int64_t n) { return static_cast<std::size_t>(n); }
  ents_input input(bool of_detection) const {
    ents_input in{};
    in.struct_size = sizeof in;
    in.state_begin = state.data(), in.state_begin_stride = model.layout.state_size;
    if (!of_detection) in.slave = slave.data(), in.mesh = &mesh, in.segment = &segment, in.start = xi;
    return in;
  }

  const Model& model;
  std::vector<double> slave, positions, state, end, residual, values, points, tree;
  const std::int64_t connectivity[4] = {0, 1, 2, 3}, numbers[5] = {0, 1, 2, 3, 4};
  const double weights[4] = {1.0, 1.0, 1.0, 1.0};
  std::int64_t segment = -1, row_begin[16] = {}, equations[15] = {};
  std::vector<std::int64_t> columns;
  std::int32_t found = 0;
  double xi[2] = {0.0, 0.0};
  ents_master_mesh mesh{};
  ents_detection detection{};
  ents_output output{};
  ents_combination combination{};
  ents_system system{};
};

TEST(FloatingPointEnvironment, IsKeptByFunctionsOfWholeSurfaces) {
  const Model model(text({"quad4", "sine", "normal", "", 3})); // its multipliers live in the state
  Random random(45);
  const Element e = draw(model, basis("quad4"), random);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Setting& setting : settings)
    for (const double scale : {1.0, 1e200, 0.0, nan}) {
      SCOPED_TRACE(scale);
      std::vector<double> nodes = e[master];
      for (double& x : nodes) x *= scale;
      OneSegment s(model, e[slave], nodes);
      const ents_model* m = model.get();
      const std::int64_t facet[] = {0, 1, 2, 3};
      std::int32_t status = 0;
      std::int64_t size = 0;
      EXPECT_KEPT(setting, [&] { status = ents_tree_size(m, 1, &size, nullptr); });
      EXPECT_EQ(status, ENTS_OK);
      s.tree.resize(OneSegment::size(size));
      double* const tree = s.tree.data();
      EXPECT_KEPT(setting, [&] { status = ents_tree_build(m, &s.mesh, tree, size, nullptr); });
      EXPECT_EQ(status == ENTS_OK, std::isfinite(scale)) << status;
      EXPECT_KEPT(setting, [&] { ents_tree_refit(m, &s.mesh, tree, size, nullptr); });
      EXPECT_KEPT(setting,
                  [&] { status = ents_detect(m, &s.mesh, tree, size, 0, 1, &s.detection, nullptr); });
      EXPECT_TRUE(scale != 1.0 || (status == ENTS_OK && s.segment == 0)) << status;
      const ents_input of_mesh = s.input(false), of_detection = s.input(true);
      EXPECT_KEPT(setting, [&] { status = ents_assemble(m, 0, 1, &of_mesh, &s.output, &s.system, nullptr); });
      EXPECT_TRUE(scale != 1.0 || status == ENTS_OK) << status;
      EXPECT_KEPT(setting, [&] {
        status = ents_iterate(m, &s.mesh, tree, size, 0, 1, &s.detection, &of_detection, &s.output, &s.system,
                              nullptr);
      });
      EXPECT_TRUE(scale != 1.0 || status == ENTS_OK) << status;
      const std::int64_t block = model.layout.state_size;
      EXPECT_KEPT(setting, [&] {
        status = ents_state_augment(m, 1, s.state.data(), block, s.end.data(), block, nullptr);
      });
      EXPECT_TRUE(scale != 1.0 || status == ENTS_OK) << status;
      EXPECT_KEPT(setting, [&] {
        status = ents_combine(&s.combination, 3, 4, nodes.data(), s.points.data(), nullptr);
      });
      EXPECT_TRUE(scale != 1.0 || status == ENTS_OK) << status;
      std::int64_t begin[5], of_points[16];
      double shares[16], areas[4];
      EXPECT_KEPT(setting, [&] {
        status = ents_sampling_points("quad4", 2, 1, facet, 4, nodes.data(), 1.0, begin, of_points, shares,
                                      areas, nullptr);
      });
      EXPECT_TRUE(scale != 1.0 || status == ENTS_OK) << status;
      ents_surface_admissibility result{};
      result.struct_size = sizeof result;
      result.samples = 5;
      EXPECT_KEPT(setting, [&] { status = ents_surface_check(m, &s.mesh, &result, nullptr); });
      EXPECT_TRUE(scale != 1.0 || status == ENTS_OK) << status;
    }
}

TEST(FloatingPointEnvironment, IsKeptByFunctionsWithoutAModel) {
  const std::int64_t facet[] = {0, 1, 2, 3}, twice[] = {0, 1, 1, 3};
  for (const Setting& setting : settings) {
    ents_report report = new_report();
    std::int32_t status = 0;
    for (const std::int64_t* connectivity : {facet, twice}) {
      std::int64_t points = 0, terms = 0;
      EXPECT_KEPT(setting, [&] {
        status = ents_smooth_size("quad4", "bspline16", ENTS_ENDS_STRAIGHT, 1, connectivity, 4, &points,
                                  &terms, &report);
      });
      EXPECT_EQ(status, connectivity == facet ? ENTS_OK : ENTS_BAD_VALUE) << report.message;
      std::vector<std::int64_t> of_segment(16), begin(static_cast<std::size_t>(points + 1)),
          nodes(static_cast<std::size_t>(terms));
      std::vector<double> weights(nodes.size());
      EXPECT_KEPT(setting, [&] {
        status = ents_smooth("quad4", "bspline16", ENTS_ENDS_STRAIGHT, 1, connectivity, 4, points, terms,
                             of_segment.data(), begin.data(), nodes.data(), weights.data(), &report);
      });
      EXPECT_EQ(status == ENTS_OK, connectivity == facet) << report.message;
    }
    ents_model* made = nullptr;
    EXPECT_KEPT(setting, [&] { status = ents_model_create_from_file("no such file", &made, &report); });
    EXPECT_EQ(status, ENTS_FILE);
    EXPECT_KEPT(setting, [&] { ents_check_contract(9, 9, &report); });
    EXPECT_KEPT(setting, [&] { ents_status_text(ENTS_BAD_VALUE); });
    EXPECT_KEPT(setting, [&] { ents_version(); });
  }
}

TEST(FloatingPointEnvironment, IsKeptByFunctionsOfAModel) {
  const std::string good = text({"quad4", "map", "shadow_point"});
  const std::string texts[] = {good, R"({"segment": "quad5"})",
                               R"({"segment": "line2", "penetration_limit": 1e999})",
                               R"({"segment": "line2", "penetration_limit": 1e-320})", "{"};
  const Model model(good);
  Random random(42);
  Element e = draw(model, basis("quad4"), random);
  const std::vector<double> xi = {0.3, 0.2};
  for (const Setting& setting : settings) {
    for (const std::string& t : texts) {
      ents_model* made = nullptr;
      ents_report report = new_report();
      EXPECT_KEPT(setting, [&] { ents_model_create(t.c_str(), -1, nullptr, nullptr, 0, &made, &report); });
      EXPECT_EQ(made != nullptr, t == good) << report.message;
      EXPECT_KEPT(setting, [&] { ents_model_destroy(&made, &report); });
    }
    for (const double scale : {1.0, 1e200, 0.0}) {
      std::vector<double> nodes = e[master], point(3),
                          state(static_cast<std::size_t>(model.layout.state_size));
      for (double& x : nodes) x *= scale;
      ents_surface surface{};
      surface.struct_size = sizeof surface;
      surface.master = nodes.data();
      surface.xi = xi.data();
      surface.point = point.data();
      ents_admissibility result{};
      result.struct_size = sizeof result;
      ents_layout layout{};
      layout.struct_size = sizeof layout;
      EXPECT_KEPT(setting, [&] { ents_surface_evaluate(model.get(), 1, &surface, nullptr); });
      EXPECT_KEPT(setting, [&] { ents_model_check(model.get(), nodes.data(), nullptr, &result, nullptr); });
      EXPECT_KEPT(setting,
                  [&] { ents_state_init(model.get(), 1, state.data(), model.layout.state_size, nullptr); });
      EXPECT_KEPT(setting, [&] { ents_model_layout(model.get(), &layout, nullptr); });
      std::vector<double> moved = state;
      EXPECT_KEPT(setting, [&] {
        ents_state_transfer(model.get(), nodes.data(), nullptr, nodes.data(), nullptr, state.data(),
                            moved.data(), nullptr);
      });
      const std::int64_t connectivity[] = {0, 1, 2, 3};
      double areas[4];
      EXPECT_KEPT(setting, [&] {
        ents_tributary_areas("quad4", 1, connectivity, 4, nodes.data(), 1.0, areas, nullptr);
      });
    }
  }
}

TEST(FloatingPointEnvironment, DoesNotChangeResults) {
  Random random(43);
  int compared = 0;
  for (const ModelKind& kind : all_kinds()) {
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
  EXPECT_GT(compared, 4000);
}

// One element per lane: some far away, from a start elsewhere, with denormal parts, or with another status.
TEST(FloatingPointEnvironment, DoesNotChangeCallsOfMany) {
  Random random(45);
  int compared = 0;
  for (const ModelKind& kind : some_kinds()) {
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
  EXPECT_GT(compared, 250);
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
} // namespace floating_point_environment_test
