// SPDX-License-Identifier: BSD-3-Clause
// The host's floating-point environment - rounding, traps, flags, flush to zero - is as it was after every
// call, on success and on every error.
#include <functional>

#include "sample_count.hpp"
#include "support/element.hpp"
#include "support/floating_point_environment.hpp"

namespace floating_point_environment_test {
namespace {

using namespace test;

TEST(FloatingPointEnvironment, IsKeptByThousandsOfEvaluationsAndTheirErrors) {
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
        if (sample_divisor == 1 && !is_long_taken(random)) continue; // every model, some settings
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
  EXPECT_GE(calls, long_divisor() == 1 ? 10000 : 1);
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
      double boxes[6];
      EXPECT_KEPT(setting, [&] { ents_surface_boxes(m, &s.mesh, boxes, nullptr); });
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

} // namespace
} // namespace floating_point_environment_test
