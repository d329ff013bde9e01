// SPDX-License-Identifier: BSD-3-Clause
// An element over several textured segments answers what a detection on the same segments answers: no slave
// with one clear projection is refused, however deep the texture.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "heights.hpp"
#include "mesh_surface.hpp"
#include "samples.hpp"

namespace mechanics::patch_answers_test {
namespace {

using nlohmann::json;

json draw_deep_texture(Random& random, int parameters) {
  if (random.below(4) == 0)
    return {{"type", "thread"},
            {"pitch", random.uniform(0.15, 0.4)},
            {"flank_angles", {30.0, 30.0}},
            {"crest", 0.03},
            {"root", 0.05}};
  json wave_vector = json::array();
  const double most = random.coin() ? 1.2 : 3.0;
  double steepest = 0.0;
  for (int a = 0; a < parameters; ++a)
    wave_vector.push_back(random.uniform(0.1, most)), steepest += wave_vector.back().get<double>();
  return {{"type", "sine"},
          {"amplitude", random.uniform(0.01, std::min(0.1, 0.15 / steepest))},
          {"wave_vector", wave_vector},
          {"phase", random.uniform(-3.0, 3.0)}};
}

std::int64_t slaves_of_each_basis() {
  const char* text = std::getenv("ENTS_TEST_SLAVES");
  return text ? std::atoll(text) : long_samples(3000);
}

class PatchAnswers : public testing::TestWithParam<const char*> {};

TEST_P(PatchAnswers, AreThoseOfADetection) {
  using clock = std::chrono::steady_clock;
  Random random(31);
  const Basis& basis = basis_named(GetParam());
  const int d = basis.dimension, t = basis.parameters();
  const auto dim = static_cast<std::size_t>(d);
  std::int64_t total = 0, clear = 0, refused = 0, wrong = 0, flagged = 0, accepted_flagged = 0,
               followed_slaves = 0;
  double first_us = 0.0, followed_us = 0.0, longest_us = 0.0;
  while (total < slaves_of_each_basis()) {
    MeshSurface mesh = draw_mesh(random, basis, d == 2 ? 6 : basis.node_count() > 9 ? 4 : 3, 0.05);
    json text{{"segment", basis.name},
              {"height", draw_deep_texture(random, t)},
              {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 7.0}}}}}};
    const double limit = random.coin() ? 0.3 : random.uniform(0.5, 3.0);
    text["penetration_limit"] = limit;
    const bool local = random.coin(); // the texture begins anew on each segment
    const Model single(text.dump());
    json patch = json::array();
    const int m = basis.node_count();
    for (std::int64_t s = 0; s < mesh.segments(); ++s)
      patch.push_back(std::vector<std::int64_t>(mesh.connectivity.begin() + s * m,
                                                mesh.connectivity.begin() + (s + 1) * m));
    text["patch"] = patch;
    const Model whole(text.dump());
    ents_layout layout{};
    layout.struct_size = sizeof layout;
    ents_model_layout(whole.handle(), &layout, nullptr);
    std::vector<double> coordinates(static_cast<std::size_t>(mesh.nodes() * t));
    for (std::size_t i = 0; i < mesh.connectivity.size(); ++i)
      for (int k = 0; k < t; ++k)
        coordinates[static_cast<std::size_t>(mesh.connectivity[i] * t + k)] =
            mesh.surface_coordinates[i * static_cast<std::size_t>(t) + static_cast<std::size_t>(k)];
    if (local) mesh.surface_coordinates.clear();
    Detector detector(single, mesh);
    for (int n = 0; n < 20; ++n, ++total) {
      const std::int64_t segment = random.below(static_cast<int>(mesh.segments()));
      std::vector<double> xi = {random.uniform(-1.0, 1.0)};
      if (t == 2) xi.push_back(random.uniform(-1.0, 1.0));
      if (basis.simplex) xi = {random.uniform(0.0, 0.5), random.uniform(0.0, 0.5)};
      const SurfacePoints at = evaluate_surface(single, mesh.master(segment).data(),
                                                local ? nullptr : mesh.coordinates(segment), xi);
      if (at.status != ENTS_OK) continue;
      const double depth = random.uniform(-0.1, 0.29);
      std::vector<double> slave(dim);
      for (std::size_t k = 0; k < dim; ++k) slave[k] = at.point[k] - depth * at.normal[k];
      Detector::Found found;
      detector.detect(slave, limit, found);
      const bool behind = (found.flags[0] & (ENTS_FLAG_BEHIND_EDGE | ENTS_FLAG_AMBIGUOUS)) != 0;
      std::vector<double> state(static_cast<std::size_t>(layout.state_size)), end(state),
          residual(static_cast<std::size_t>(layout.dofs));
      ents_state_init(whole.handle(), 1, state.data(), layout.state_size, nullptr);
      double gap = 7.0;
      std::int32_t flags = 0;
      ents_input in{};
      in.struct_size = sizeof in;
      in.slave = slave.data(), in.master = mesh.positions.data(), in.state_begin = state.data();
      if (!local) in.surface_coordinates = coordinates.data();
      ents_output out{};
      out.struct_size = sizeof out;
      out.wanted = ENTS_GAP | ENTS_RESIDUAL | ENTS_STATE | ENTS_FLAGS;
      out.gap = &gap, out.residual = residual.data(), out.state_end = end.data(), out.flags = &flags;
      const auto begin = clock::now();
      const std::int32_t status = ents_evaluate(whole.handle(), 0, 1, &in, &out, nullptr);
      const double us = std::chrono::duration<double, std::micro>(clock::now() - begin).count();
      first_us += us;
      if (us > longest_us) longest_us = us;
      ASSERT_GE(status, 0);
      if (behind) {
        ++flagged;
        accepted_flagged += status == ENTS_OK && (flags & ENTS_FLAG_CONTACT) != 0 &&
                            (found.flags[0] & ENTS_FLAG_BEHIND_EDGE) != 0;
        continue;
      }
      if (found.segment[0] < 0) { // open
        wrong += status == ENTS_OK && (flags & ENTS_FLAG_CONTACT) != 0;
        continue;
      }
      ++clear;
      refused += status != ENTS_OK;
      if (status != ENTS_OK)
        std::printf("  status %d, gap %.17g, limit %g, depth %g\n", status, found.gap[0], limit, depth);
      if (status == ENTS_OK && std::fabs(gap - found.gap[0]) > 1e-11) {
        ++wrong;
        std::printf("  gap %.17g, not %.17g, limit %g, depth %g\n", gap, found.gap[0], limit, depth);
      }
      if (status != ENTS_OK || (flags & ENTS_FLAG_CONTACT) == 0) continue; // an open one is searched anew
      ++followed_slaves;
      in.state_begin = end.data(), out.state_end = state.data();
      const auto again = clock::now();
      const std::int32_t followed = ents_evaluate(whole.handle(), 0, 1, &in, &out, nullptr);
      followed_us += std::chrono::duration<double, std::micro>(clock::now() - again).count();
      wrong += followed != ENTS_OK || std::fabs(gap - found.gap[0]) > 1e-11;
    }
  }
  std::printf("%-12s %lld slaves, %lld with one clear answer: %lld refused, %lld wrong; %lld flagged by the "
              "detection, %lld of them in contact. "
              "First %.1f us (longest %.0f), followed %.1f us\n",
              GetParam(), static_cast<long long>(total), static_cast<long long>(clear),
              static_cast<long long>(refused), static_cast<long long>(wrong), static_cast<long long>(flagged),
              static_cast<long long>(accepted_flagged), first_us / static_cast<double>(total), longest_us,
              followed_us / static_cast<double>(followed_slaves));
  EXPECT_GT(clear, total / 2);
  EXPECT_EQ(refused, 0);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(accepted_flagged, 0);
}

// Two segments of a thread, and slaves so deep that the search of one of them takes long: whether it is
// searched first or last.
TEST(PatchOrder, DoesNotMatter) {
  const std::vector<double> nodes = {2, 2, 0, 4, 2, 0, 3, 2, 0, 0, 4, 0, 1, 3,
                                     0, 2, 4, 0, 1, 4, 0, 2, 3, 0, 3, 3, 0};
  const std::vector<double> coordinates = {2, 2, 4, 2, 3, 2, 0, 4, 1, 3, 2, 4, 1, 4, 2, 3, 3, 3};
  json text{
      {"segment", "tri6"},
      {"height",
       {{"type", "thread"}, {"pitch", 0.248}, {"flank_angles", {30, 30}}, {"crest", 0.03}, {"root", 0.05}}},
      {"penetration_limit", 0.3},
      {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 7}}}}}};
  text["patch"] = {{0, 1, 5, 2, 8, 7}, {5, 3, 0, 6, 4, 7}};
  const Model first(text.dump());
  text["patch"] = {{5, 3, 0, 6, 4, 7}, {0, 1, 5, 2, 8, 7}};
  const Model last(text.dump());
  Random random(8);
  int contacts = 0;
  for (int n = 0; n < 40; ++n) {
    std::vector<double> moved = nodes;
    for (double& x : moved) x += random.uniform(-0.05, 0.05);
    const std::vector<double> slave = {random.uniform(2.0, 2.04), random.uniform(3.7, 3.8),
                                       random.uniform(-0.16, -0.13)};
    double gap[2] = {7, 7};
    std::int32_t status[2];
    for (int k = 0; k < 2; ++k) {
      ents_input in{};
      in.struct_size = sizeof in;
      in.slave = slave.data(), in.master = moved.data(), in.surface_coordinates = coordinates.data();
      ents_output out{};
      out.struct_size = sizeof out;
      double residual[30];
      out.wanted = ENTS_GAP | ENTS_RESIDUAL;
      out.gap = &gap[k], out.residual = residual;
      status[k] = ents_evaluate((k == 0 ? first : last).handle(), 0, 1, &in, &out, nullptr);
    }
    EXPECT_TRUE(status[0] == ENTS_OK || status[0] == ENTS_NO_PROJECTION) << n << ", status " << status[0];
    EXPECT_EQ(status[0], status[1]) << n;
    EXPECT_NEAR(gap[0], gap[1], 1e-11) << n;
    contacts += gap[0] < 0;
  }
  EXPECT_GT(contacts, 20);
}

INSTANTIATE_TEST_SUITE_P(Bases, PatchAnswers,
                         testing::Values("line2", "line3", "bspline4", "catmull_rom4", "tri3", "tri6",
                                         "quad4", "quad9", "bspline16"));

} // namespace
} // namespace mechanics::patch_answers_test
