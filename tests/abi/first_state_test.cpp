// SPDX-License-Identifier: BSD-3-Clause
// ents_iterate with laws that bond: the first increment begins where the bodies are undeformed.
#include <gtest/gtest.h>

#include "support/surface.hpp"

namespace first_state_test {
namespace {

using namespace test;

// Bonds are those of the undeformed bodies: what opens in the first increment is held. With a state of the begin, and with
// slave_begin; without either there is no bond, as ENTS_NEEDS_FIRST_STATE says.
TEST(FirstState, BondsHoldWhatOpensInTheFirstIncrement) {
  const Model model(
      R"({"segment": "line2", "contact": {"normal": {"type": "tied", "stiffness": 100, "range": 1e-6}}})");
  EXPECT_NE(model.layout.needs & ENTS_NEEDS_FIRST_STATE, 0);
  const double nodes[] = {0, 0, 1, 0}, begin[] = {0.4, 0}, end[] = {0.4, 0.1};
  const int64_t connectivity[] = {0, 1};
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = 1, mesh.nodes = 2, mesh.connectivity = connectivity, mesh.positions = nodes;
  int64_t size = 0;
  call::tree_size(model.get(), mesh.segments, &size, nullptr);
  std::vector<double> tree(static_cast<std::size_t>(size));
  ASSERT_EQ(call::tree_build(model.get(), &mesh, tree.data(), static_cast<int64_t>(tree.size()), nullptr),
            ENTS_OK);
  int64_t segment = -1;
  double xi = 0, area = 1, energy = 0;
  std::vector<double> fresh(static_cast<std::size_t>(model.layout.state_size)), first = fresh, none = fresh;
  call::state_init(model.get(), int64_t{1}, fresh.data(), int64_t{model.layout.state_size}, nullptr);
  const auto iterate = [&](const double* slave, const double* slave_begin, std::vector<double>& from,
                           std::vector<double>& to) {
    ents_detection io{};
    io.struct_size = sizeof io;
    io.slave = slave, io.reach = 0.5, io.segment = &segment, io.xi = &xi;
    ents_input in{};
    in.struct_size = sizeof in;
    in.area = &area, in.state_begin = from.data(), in.slave_begin = slave_begin;
    ents_output out{};
    out.struct_size = sizeof out;
    out.wanted = ENTS_STATE | ENTS_ENERGY, out.state_end = to.data(), out.energy = &energy;
    ents_report report = new_report();
    EXPECT_EQ(call::iterate(model.get(), &mesh, tree.data(), static_cast<int64_t>(tree.size()), int64_t{0},
                            int64_t{1}, &io, &in, &out, nullptr, &report),
              ENTS_OK)
        << report.message;
    return energy;
  };
  constexpr double stored = 100 * 0.1 * 0.1 / 2;
  EXPECT_EQ(iterate(end, nullptr, fresh, none), 0);
  EXPECT_NEAR(iterate(end, begin, fresh, none), stored, 1e-15);
  EXPECT_EQ(iterate(begin, nullptr, fresh, first), 0);
  EXPECT_NEAR(iterate(end, nullptr, first, none), stored, 1e-15);
  EXPECT_NEAR(iterate(end, begin, none, first), stored, 1e-15) << "later increments have it in the state";
}

} // namespace
} // namespace first_state_test
