// SPDX-License-Identifier: BSD-3-Clause
// A random master surface with slaves over it, searched and assembled through the functions of ents.h.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "mechanics/random.hpp"
#include "support/element.hpp"

namespace test {

// A chain of lines or a sheet of quadrilaterals, with slaves over it.
struct Surface {
  explicit Surface(mechanics::Random& random, int d) : dimension(d) {
    const int n = 4;
    for (int j = 0; j < (d == 3 ? n + 1 : 1); ++j)
      for (int i = 0; i <= n; ++i) {
        positions.push_back(i + random.uniform(-0.1, 0.1));
        if (d == 3) positions.push_back(j + random.uniform(-0.1, 0.1));
        positions.push_back(random.uniform(-0.05, 0.05));
      }
    for (int j = 0; j < (d == 3 ? n : 1); ++j)
      for (int i = 0; i < n; ++i) {
        const int64_t a = j * (n + 1) + i;
        if (d == 2)
          connectivity.insert(connectivity.end(), {a, a + 1});
        else
          connectivity.insert(connectivity.end(), {a, a + 1, a + n + 2, a + n + 1});
      }
    mesh.struct_size = sizeof mesh;
    mesh.nodes = static_cast<int64_t>(positions.size()) / d,
    mesh.segments = static_cast<int64_t>(connectivity.size()) / (d == 2 ? 2 : 4);
    mesh.positions = positions.data(), mesh.connectivity = connectivity.data();
    for (int s = 0; s < slaves; ++s) {
      for (int k = 0; k + 1 < d; ++k) slave.push_back(random.uniform(0.5, n - 0.5));
      slave.push_back(random.uniform(-0.1, 0.02));
    }
  }
  Surface(const Surface&) = delete;
  static constexpr int slaves = 30;
  int dimension;
  std::vector<double> positions, slave;
  std::vector<int64_t> connectivity;
  ents_master_mesh mesh{};
};

inline std::string text_of(int d, const std::string& contact, const std::string& more = "") {
  return R"({"segment": ")" + std::string(d == 2 ? "line2" : "quad4") + R"(", "border": 0.1, "contact": )" +
         contact + more + "}";
}
inline const std::string penalty = R"({"normal": {"type": "penalty", "stiffness": 10}})";
inline const std::string coulomb =
    R"({"normal": {"type": "penalty", "stiffness": 10}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 5}})";
inline const std::string rough =
    R"({"normal": {"type": "exponential", "pressure": 1, "clearance": 0.1}, "friction": {"type": "rough", "stiffness": 5}})";

inline std::vector<double> tree_of(const Model& model, const Surface& surface) {
  int64_t size = 0;
  call::tree_size(model.get(), surface.mesh.segments, &size, nullptr);
  std::vector<double> tree(static_cast<std::size_t>(size));
  EXPECT_EQ(call::tree_build(model.get(), &surface.mesh, tree.data(), size, nullptr), ENTS_OK);
  return tree;
}

struct Found {
  std::vector<int64_t> segment, other;
  std::vector<double> xi, gap;
  std::vector<int32_t> flags;
};
inline int32_t detect(const Model& model, const Surface& surface, const std::vector<double>& tree,
                      const std::vector<double>& slave, double reach, Found& out, ents_report& report,
                      const int64_t* slave_node = nullptr) {
  const std::size_t n = slave.size() / static_cast<std::size_t>(surface.dimension);
  out.segment.resize(n, -1), out.other.resize(n), out.xi.resize(2 * n), out.gap.resize(n),
      out.flags.resize(n);
  ents_detection io{};
  io.struct_size = sizeof io;
  io.slave = slave.data(), io.reach = reach, io.segment = out.segment.data(), io.xi = out.xi.data(),
  io.gap = out.gap.data();
  io.flags = out.flags.data(), io.other = out.other.data(), io.slave_node = slave_node;
  return call::detect(model.get(), &surface.mesh, tree.data(), static_cast<int64_t>(tree.size()), int64_t{0},
                      static_cast<int64_t>(n), &io, &report);
}

// The equations of slaves and nodes, some of which are prescribed, in a full matrix.
struct System {
  explicit System(const Model& m, const Surface& s, mechanics::Random& random) : model(m), surface(s) {
    const int d = s.dimension;
    int64_t row = 0;
    for (int64_t i = 0; i < (s.slaves + s.mesh.nodes) * d; ++i)
      equations.push_back(random.below(9) == 0 ? -1 : row++);
    rows = row;
    for (int64_t i = 0; i <= rows; ++i) row_begin.push_back(i * rows);
    for (int64_t i = 0; i < rows; ++i)
      for (int64_t j = 0; j < rows; ++j) columns.push_back(j);
    places.assign(static_cast<std::size_t>(s.slaves * places_size()), 0);
  }
  int64_t places_size() const { return surface.dimension * model.layout.nodes * 100; }
  void clear() {
    values.assign(static_cast<std::size_t>(rows * rows), 0.0);
    residual.assign(static_cast<std::size_t>(rows), 0.0);
  }
  ents_system made(const ents_master_mesh& mesh, bool with_places) {
    ents_system system{};
    system.struct_size = sizeof system;
    system.index_size = 8;
    system.slave_nodes = surface.slaves, system.slave_equations = equations.data();
    system.master_nodes = mesh.nodes,
    system.master_equations = equations.data() + surface.slaves * surface.dimension;
    system.rows = rows, system.residual = residual.data();
    system.row_begin = row_begin.data(), system.columns = columns.data(), system.values = values.data();
    if (with_places) system.places = places.data(), system.places_size = places_size();
    change(system);
    return system;
  }
  // values [rows][rows], residual [rows]
  int32_t assemble(const std::vector<int64_t>& segment, const ents_master_mesh& mesh, bool with_places,
                   const double* state_begin, double* state_end, ents_report& report,
                   const double* start = nullptr) {
    clear();
    ents_input in{};
    in.struct_size = sizeof in;
    in.slave = surface.slave.data(), in.slave_stride = surface.dimension;
    in.mesh = &mesh, in.segment = segment.data(), in.segment_stride = 1;
    in.start = start, in.start_stride = model.layout.parameters;
    in.state_begin = state_begin, in.state_begin_stride = model.layout.state_size;
    ents_output out{};
    out.struct_size = sizeof out;
    out.wanted = state_end ? ENTS_STATE : 0, out.state_end = state_end,
    out.state_end_stride = model.layout.state_size;
    const ents_system system = made(mesh, with_places);
    return call::assemble(model.get(), int64_t{0}, int64_t{surface.slaves}, &in, &out, &system, &report);
  }
  const Model& model;
  const Surface& surface;
  std::vector<int64_t> equations, row_begin, columns, places;
  std::vector<double> values, residual;
  int64_t rows = 0;
  std::function<void(ents_system&)> change = [](ents_system&) {};
};

} // namespace test
