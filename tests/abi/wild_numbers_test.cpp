// SPDX-License-Identifier: BSD-3-Clause
// Counts that no memory has, and states with numbers that no surface has, are refused before they are used.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "support/model.hpp"

namespace wild_numbers_test {
namespace {

using namespace test;

TEST(WildNumbers, OfEquationsAreRefused) {
  const Model model(R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 100}}})");
  const double slave[] = {0.1, -0.01}, positions[] = {-1, 0, 1, 0};
  const int64_t connectivity[] = {0, 1}, segment = 0, of_slave[] = {0, 1}, of_master[] = {2, 3, 4, 5};
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = 1, mesh.nodes = 2, mesh.connectivity = connectivity, mesh.positions = positions;
  ents_input in{};
  in.struct_size = sizeof in;
  in.slave = slave, in.slave_stride = 2, in.mesh = &mesh, in.segment = &segment, in.segment_stride = 1;
  double residual[6] = {}, values[36] = {};
  int64_t places[64] = {}, row_begin[7], columns[36];
  for (int64_t i = 0; i < 36; ++i) columns[i] = i % 6, row_begin[i / 6 + 1] = i + 1;
  row_begin[0] = 0;
  ents_system system{};
  system.struct_size = sizeof system, system.index_size = 8;
  system.slave_nodes = 1, system.master_nodes = 2, system.rows = 6;
  system.slave_equations = of_slave, system.master_equations = of_master;
  system.residual = residual, system.values = values, system.row_begin = row_begin, system.columns = columns;
  system.places = places, system.places_size = 64;
  ents_report report = new_report();
  const auto assemble = [&] { return ents_assemble(model.get(), 0, 1, &in, nullptr, &system, &report); };
  ASSERT_EQ(assemble(), ENTS_OK) << report.message;
  const struct {
    const char* name;
    int64_t ents_system::*count;
  } counts[] = {{"rows", &ents_system::rows},
                {"slave_nodes", &ents_system::slave_nodes},
                {"master_nodes", &ents_system::master_nodes},
                {"places_size", &ents_system::places_size}};
  for (const auto& c : counts)
    for (const int64_t wild : {int64_t{1} << 59, int64_t{-1}}) {
      const int64_t kept = system.*c.count;
      system.*c.count = wild;
      EXPECT_EQ(assemble(), ENTS_BAD_COUNT) << c.name;
      EXPECT_NE(std::strstr(report.message,
                            ("system." + std::string(c.name) + " is " + std::to_string(wild)).c_str()),
                nullptr)
          << report.message;
      system.*c.count = kept;
    }
}

// A state whose worn depth no surface has.
TEST(WildNumbers, OfWornDepthsAreRefused) {
  const Model model(
      R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 100}, "wear": {"coefficient": 0.01}}})");
  for (const int64_t count : {1, 9})
    for (const double depth : {-1e150, -1e200}) {
      const auto size = static_cast<std::size_t>(model.layout.state_size),
                 n = static_cast<std::size_t>(count);
      std::vector<double> begin(n * size), end = begin, slave, master, residual(6 * n);
      std::vector<int32_t> status(n, -99);
      ASSERT_EQ(ents_state_init(model.get(), count, begin.data(), model.layout.state_size, nullptr), ENTS_OK);
      for (std::size_t e = 0; e < n; ++e) {
        slave.insert(slave.end(), {0.1, -0.01});
        master.insert(master.end(), {-1, 0, 1, 0});
        begin[e * size + 1] = 2.0;
        begin[e * size + static_cast<std::size_t>(model.layout.worn)] = depth;
      }
      ents_input in{};
      in.struct_size = sizeof in;
      in.slave = slave.data(), in.slave_stride = 2, in.master = master.data(), in.master_stride = 4;
      in.state_begin = begin.data(), in.state_begin_stride = model.layout.state_size;
      ents_output out{};
      out.struct_size = sizeof out;
      out.wanted = ENTS_RESIDUAL | ENTS_STATE;
      out.residual = residual.data(), out.residual_stride = 6;
      out.state_end = end.data(), out.state_end_stride = model.layout.state_size;
      out.status = status.data(), out.status_stride = 1;
      EXPECT_EQ(ents_evaluate(model.get(), 0, count, &in, &out, nullptr), ENTS_OUT_OF_RANGE) << depth;
      for (const int32_t one : status) EXPECT_EQ(one, ENTS_OUT_OF_RANGE) << depth;
      for (const double x : end) EXPECT_EQ(x, 0.0);
    }
}

} // namespace
} // namespace wild_numbers_test
