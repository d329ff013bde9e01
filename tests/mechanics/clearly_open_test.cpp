// SPDX-License-Identifier: BSD-3-Clause
// The sum of many elements leaves out those that are clearly open.
#include <gtest/gtest.h>

#include "scene.hpp"

namespace mechanics::clearly_open_test {
namespace {

// Where nothing is wanted but the sum, elements that are clearly open are not projected. The sum is the same
// to the last bit.
TEST(ClearlyOpen, AddsNothing) {
  constexpr std::int64_t size = 400;
  std::int64_t contact = 0;
  for (const char* name : {"line2", "tri3", "quad4"})
    for (const char* height : {"none", "sine", "polynomial"})
      for (int sample = 0; sample < 40; ++sample) {
        Random random(static_cast<std::uint64_t>(sample));
        const Basis& basis = basis_named(name);
        Scene scene = draw_scene(random, basis, height, "normal");
        scene.with_coordinates = false;
        nlohmann::json text = scene.model();
        text["border"] = random.uniform(0.0, 0.3);
        const Model model(text.dump());
        Elements elements = draw_elements(random, scene, model, size, -0.1, 0.1);
        const std::int64_t d = basis.dimension, m = basis.node_count(), n = d * (m + 1);
        for (std::int64_t e = 0; e < size; e += 3) // far away, too
          for (std::int64_t c = 0; c < d; ++c)
            elements.slave[static_cast<std::size_t>(e * d + c)] += random.uniform(-1.0, 1.0);
        // every element has nodes and equations of its own
        std::vector<std::int64_t> segment, connectivity, slave_equations, master_equations;
        std::vector<std::int32_t> row_begin{0}, columns;
        for (std::int64_t e = 0; e < size; ++e) {
          segment.push_back(e);
          for (std::int64_t i = 0; i < m; ++i) connectivity.push_back(e * m + i);
          for (std::int64_t c = 0; c < n; ++c)
            (c < d ? slave_equations : master_equations).push_back(e * n + c);
          for (std::int64_t i = 0; i < n; ++i) {
            for (std::int64_t j = 0; j < n; ++j) columns.push_back(static_cast<std::int32_t>(e * n + j));
            row_begin.push_back(static_cast<std::int32_t>(columns.size()));
          }
        }
        ents_master_mesh mesh{};
        mesh.struct_size = sizeof mesh;
        mesh.segments = size, mesh.connectivity = connectivity.data();
        mesh.nodes = size * m, mesh.positions = elements.master.data();
        ents_input in{};
        in.struct_size = sizeof in;
        in.slave = elements.slave.data(), in.slave_stride = d;
        in.start = elements.start.data(), in.start_stride = d - 1;
        in.mesh = &mesh, in.segment = segment.data(), in.segment_stride = 1;
        const auto sum = [&](bool results, std::vector<double>& residual, std::vector<double>& values,
                             std::vector<std::int32_t>& flags) {
          residual.assign(static_cast<std::size_t>(size * n), 0.0), values.assign(columns.size(), 0.0);
          std::vector<std::int32_t> status(static_cast<std::size_t>(size), -1);
          flags.assign(static_cast<std::size_t>(size), 0);
          ents_system system{};
          system.struct_size = sizeof system;
          system.index_size = 4;
          system.slave_nodes = size, system.slave_equations = slave_equations.data();
          system.master_nodes = size * m, system.master_equations = master_equations.data();
          system.rows = size * n, system.residual = residual.data();
          system.row_begin = row_begin.data(), system.columns = columns.data(), system.values = values.data();
          ents_output out{};
          out.struct_size = sizeof out;
          out.wanted = results ? ENTS_FLAGS : 0;
          out.flags = flags.data(), out.flags_stride = 1;
          out.status = status.data(), out.status_stride = 1;
          ents_report report = new_report();
          EXPECT_GE(ents_assemble(model.handle(), 0, size, &in, &out, &system, &report), ENTS_OK)
              << report.message;
          return status;
        };
        std::vector<double> residual, values, all_residual, all_values;
        std::vector<std::int32_t> flags, none;
        const std::vector<std::int32_t> status = sum(true, all_residual, all_values, flags),
                                        brief = sum(false, residual, values, none);
        ASSERT_EQ(residual, all_residual) << name << " " << height << " " << sample;
        ASSERT_EQ(values, all_values) << name << " " << height << " " << sample;
        for (std::size_t e = 0; e < static_cast<std::size_t>(size); ++e) {
          contact += flags[e] & ENTS_FLAG_CONTACT;
          ASSERT_TRUE(brief[e] == status[e] || brief[e] == ENTS_OK)
              << name << " " << height << " element " << e;
        }
      }
  EXPECT_GT(contact, 20000);
}

} // namespace
} // namespace mechanics::clearly_open_test
