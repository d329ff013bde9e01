// SPDX-License-Identifier: BSD-3-Clause
// How much stack a call needs: threads of hosts, above all those of Fortran's OpenMP, may have little. A
// thread whose stack was painted calls the library; what is no longer painted was used.
#include <gtest/gtest.h>

#include <pthread.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "support/batch.hpp"

namespace stack_test {
namespace {

using namespace test;

// ents.h, "Rules", tells these numbers.
constexpr std::size_t promised_kib = 256;

std::size_t stack_used(const std::function<void()>& call) {
  constexpr std::size_t size = std::size_t{1} << 20;
  auto* stack = static_cast<unsigned char*>(std::aligned_alloc(4096, size));
  std::fill_n(stack, size, static_cast<unsigned char>(0xa5));
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstack(&attributes, stack, size);
  pthread_t thread;
  const auto run = [](void* f) -> void* {
    (*static_cast<const std::function<void()>*>(f))();
    return nullptr;
  };
  EXPECT_EQ(pthread_create(&thread, &attributes, run, const_cast<std::function<void()>*>(&call)), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  std::size_t untouched = 0;
  while (untouched < size && stack[untouched] == 0xa5) ++untouched;
  std::free(stack);
  return size - untouched;
}

TEST(Stack, NeedsNoMoreThanTheHeaderTells) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "instrumented code has frames of its own";
#endif
  const std::size_t none = stack_used([] {});
  std::size_t most = 0, many = 0;
  Random random(3);
  for (const Basis& b : bases()) {
    const std::string text =
        R"({"segment": ")" + std::string(b.name) + R"(", "height": )" + height("sine", b.dimension) +
        R"(, "contact": {"normal": {"type": "exponential", "pressure": 1, "clearance": 0.2},)"
        R"( "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 5}})";
    const Model model(text + "}");
    const Element element = draw(model, b, random);
    Results results(model.layout);
    std::vector<double> state(static_cast<std::size_t>(model.layout.state_size));
    ents_state_init(model.get(), 1, state.data(), model.layout.state_size, nullptr);
    ents_input in = input_of(element);
    in.state_begin = state.data();
    const ents_output out = output_of(results, want_all);
    const std::size_t evaluate = stack_used([&] { ents_evaluate(model.get(), 0, 1, &in, &out, nullptr); });

    std::vector<int64_t> connectivity;
    std::string nodes;
    for (int i = 0; i < model.layout.nodes; ++i)
      connectivity.push_back(i), nodes += (i ? ", " : "") + std::to_string(i);
    const Model patch(text + R"(, "patch": [[)" + nodes + "]]}");
    const std::size_t patched = stack_used([&] { ents_evaluate(patch.get(), 0, 1, &in, &out, nullptr); });

    ents_master_mesh mesh{};
    mesh.struct_size = sizeof mesh;
    mesh.segments = 1, mesh.nodes = model.layout.nodes, mesh.connectivity = connectivity.data(),
    mesh.positions = element[master].data();
    std::vector<double> tree(1000);
    int64_t size = 0, segment = -1;
    ents_tree_size(model.get(), 1, &size, nullptr);
    ents_tree_build(model.get(), &mesh, tree.data(), size, nullptr);
    double xi[2] = {};
    ents_detection detection{};
    detection.struct_size = sizeof detection;
    detection.slave = element[slave].data(), detection.reach = 1.0, detection.segment = &segment,
    detection.xi = xi;
    const std::size_t detect =
        stack_used([&] { ents_detect(model.get(), &mesh, tree.data(), size, 0, 1, &detection, nullptr); });

    const int64_t n = model.layout.dofs;
    std::vector<int64_t> equations, row_begin, columns;
    for (int64_t i = 0; i < n; ++i) equations.push_back(i), row_begin.push_back(n * i);
    row_begin.push_back(n * n);
    for (int64_t i = 0; i < n * n; ++i) columns.push_back(i % n);
    std::vector<double> residual(static_cast<std::size_t>(n)), values(static_cast<std::size_t>(n * n));
    in.mesh = &mesh, in.master = in.surface_coordinates = nullptr;
    segment = 0;
    in.segment = &segment;
    ents_system system{};
    system.struct_size = sizeof system;
    system.index_size = 8, system.slave_nodes = 1, system.master_nodes = model.layout.nodes, system.rows = n;
    system.slave_equations = equations.data(),
    system.master_equations = equations.data() + model.layout.dimension;
    system.residual = residual.data(), system.row_begin = row_begin.data(), system.columns = columns.data(),
    system.values = values.data();
    const std::size_t assemble =
        stack_used([&] { ents_assemble(model.get(), 0, 1, &in, nullptr, &system, nullptr); });

    // So many tangents that they are written past the caches.
    const int64_t stored = (int64_t{1} << 19) / (n * n) + 64;
    std::vector<double> tangents(static_cast<std::size_t>(stored * n * n));
    const Model ordinary(R"({"segment": ")" + std::string(b.name) +
                         R"(", "contact": {"normal": {"type": "penalty", "stiffness": 9}}})");
    ents_input shared = input_of(element);
    ents_output tangent_alone{};
    tangent_alone.struct_size = sizeof tangent_alone;
    tangent_alone.wanted = ENTS_TANGENT, tangent_alone.tangent = tangents.data(),
    tangent_alone.tangent_stride = n * n;
    const std::size_t stream =
        stack_used([&] { ents_evaluate(ordinary.get(), 0, stored, &shared, &tangent_alone, nullptr); });
    most = std::max(most, stream);

    std::printf("%-14s many %4zu KiB, evaluate %4zu, a patch %4zu, detect %4zu, assemble %4zu\n", b.name,
                (stream - none) >> 10, (evaluate - none) >> 10, (patched - none) >> 10, (detect - none) >> 10,
                (assemble - none) >> 10);
    most = std::max({most, evaluate, patched, detect, assemble});
  }
  for (const ModelKind& kind : all_kinds()) {
    const Model model(test::text(kind));
    Batch batch(model, draw_batch(model, basis(kind.basis), random, true), 0, 0, in_blocks);
    many = std::max(many, stack_used([&] {
                      ents_evaluate(model.get(), 0, batch_size, &batch.input, &batch.output, nullptr);
                    }));
  }
  std::printf("any model, %zu elements %zu KiB\n", batch_size, (many - none) >> 10);
  EXPECT_LE((std::max(most, many) - none) >> 10, promised_kib);
}

} // namespace
} // namespace stack_test
