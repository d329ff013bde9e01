// SPDX-License-Identifier: BSD-3-Clause
// Any mesh, tree and compressed rows: detection and assembly refuse them, or write only where they may.
#include <algorithm>
#include <cmath>
#include <vector>

#include "ents.h"
#include "fuzz/bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static ents_model* const model = [] {
    ents_model* made = nullptr;
    ents_model_create(
        R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.05, "wave_vector": [0.7, 0.4]}, "border": 0.1,
      "contact": {"normal": {"type": "penalty", "stiffness": 10}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 5}}})",
        -1, nullptr, nullptr, 0, &made, nullptr);
    return made;
  }();
  fuzz::Bytes bytes(data, size);
  constexpr int nodes = 9, segments = 4, slaves = 3, d = 3, rows = (slaves + nodes) * d,
                places_size = d * 25 + 1;
  std::vector<std::int64_t> connectivity = {0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, 6, 4, 5, 8, 7};
  std::vector<double> positions, slave;
  for (int i = 0; i < nodes; ++i) positions.insert(positions.end(), {i % 3 - 1.0, i / 3 - 1.0, 0.0});
  for (int i = 0; i < slaves; ++i) slave.insert(slave.end(), {0.5 * i - 0.6, 0.3, -0.01});
  for (int k = bytes.below(8); k > 0; --k)
    connectivity[static_cast<std::size_t>(bytes.below(16))] = bytes.index(nodes);
  for (int k = bytes.below(16); k > 0; --k)
    positions[static_cast<std::size_t>(bytes.below(nodes * d))] = bytes.number();
  for (int k = bytes.below(8); k > 0; --k)
    slave[static_cast<std::size_t>(bytes.below(slaves * d))] = bytes.number();
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = segments, mesh.nodes = nodes, mesh.connectivity = connectivity.data(),
  mesh.positions = positions.data();
  std::int64_t tree_size = 0;
  ents_tree_size(model, segments, &tree_size, nullptr);
  std::vector<double> tree(static_cast<std::size_t>(tree_size));
  if (ents_tree_build(model, &mesh, tree.data(), tree_size, nullptr) != ENTS_OK) return 0;
  for (int k = bytes.below(4); k > 0; --k)
    tree[static_cast<std::size_t>(bytes.index(static_cast<int>(tree.size())) % tree_size + tree_size) %
         tree.size()] = bytes.number();
  std::vector<std::int64_t> segment(slaves, -1), own(slaves, -1);
  for (int k = bytes.below(4); k > 0; --k)
    own[static_cast<std::size_t>(bytes.below(slaves))] = bytes.index(nodes);
  std::vector<double> xi(slaves * 2), gap(slaves);
  ents_detection io{};
  io.struct_size = sizeof io;
  io.slave = slave.data(), io.reach = 1.0, io.segment = segment.data(), io.xi = xi.data(),
  io.gap = gap.data(), io.slave_node = own.data();
  if (ents_detect(model, &mesh, tree.data(), tree_size, 0, slaves, &io, nullptr) != ENTS_OK) return 0;
  for (int i = 0; i < slaves; ++i)
    fuzz::require(segment[static_cast<std::size_t>(i)] >= -1 &&
                  segment[static_cast<std::size_t>(i)] < segments &&
                  std::isfinite(gap[static_cast<std::size_t>(i)]));

  std::vector<std::int64_t> equations, row_begin{0}, columns, places(slaves * places_size);
  for (int i = 0; i < rows; ++i) equations.push_back(bytes.below(16) == 1 ? -1 : i);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < rows; ++j)
      if (bytes.below(64) != 1) columns.push_back(j);
    row_begin.push_back(static_cast<std::int64_t>(columns.size()));
  }
  const auto entries = static_cast<int>(columns.size());
  for (int k = bytes.below(4); k > 0; --k)
    equations[static_cast<std::size_t>(bytes.below(rows))] = bytes.index(rows);
  for (int k = bytes.below(4); k > 0; --k)
    row_begin[static_cast<std::size_t>(bytes.below(rows))] =
        bytes.index(std::min(entries, 200)); // the last stays: it is a size
  for (int k = bytes.below(4); k > 0; --k)
    columns[static_cast<std::size_t>(bytes.below(200))] = bytes.index(rows);
  std::vector<double> residual(rows), values(columns.size());
  ents_input in{};
  in.struct_size = sizeof in;
  in.slave = slave.data(), in.slave_stride = d;
  in.mesh = &mesh, in.segment = segment.data(), in.segment_stride = 1, in.start = xi.data(),
  in.start_stride = 2;
  ents_system system{};
  system.struct_size = sizeof system;
  system.index_size = 8, system.slave_nodes = slaves, system.master_nodes = nodes, system.rows = rows;
  system.slave_equations = equations.data(), system.master_equations = equations.data() + slaves * d;
  system.residual = residual.data(), system.row_begin = row_begin.data(), system.columns = columns.data(),
  system.values = values.data();
  system.places = places.data(), system.places_size = places_size;
  for (int turn = 0; turn < 2; ++turn) {
    ents_assemble(model, 0, slaves, &in, nullptr, &system, nullptr);
    std::swap(connectivity[static_cast<std::size_t>(bytes.below(16))],
              connectivity[static_cast<std::size_t>(bytes.below(16))]); // as a remesher may
  }
  return 0;
}
