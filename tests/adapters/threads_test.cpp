// SPDX-License-Identifier: BSD-3-Clause
// Eight threads of the host call the adapter for elements of their own, and meet where the model is read.
// Built with the thread sanitizer, too.
#include <array>
#include <cstring>
#include <fstream>
#include <latch>
#include <thread>

#include <gtest/gtest.h>

#include "../../adapters/common/model_cache.hpp"
#include "problem.hpp"
#include "uel_host.hpp"

namespace adapters {
namespace {

bool same(Guarded& a, Guarded& b, std::size_t count) {
  return std::memcmp(a.data(), b.data(), count * sizeof(double)) == 0;
}

TEST(Threads, EightGiveTheSameBits) {
  std::ofstream("ents_51.json")
      << R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6, 0.35]},
    "contact": {"normal": {"type": "penalty", "stiffness": 400}, "friction": {"type": "coulomb", "coefficient": 0.25, "stiffness": 200}}})";
  std::ofstream("ents_51.txt") << "90001 0.5\n90002 0.6\n90003 0.7\n";
  const Problem p = problem("quad4_friction");
  const UelHost host(p.elements, UelHost::Program::abaqus);
  const std::vector<double> u = pressed(p);
  constexpr int threads = 8, rounds = 20;
  std::vector<UelCall> parallel, serial;
  for (int i = 0; i < threads * rounds; ++i) {
    parallel.push_back(host.call(i % 3, u));
    parallel.back().props = {51, i % 2 ? 0.0 : 0.2 + 0.01 * i};
    serial.push_back(parallel.back());
  }
  std::vector<std::thread> pool;
  for (int t = 0; t < threads; ++t)
    pool.emplace_back([&, t] {
      for (int i = 0; i < rounds; ++i) parallel[static_cast<std::size_t>(threads * i + t)]();
    });
  for (std::thread& thread : pool) thread.join();
  for (std::size_t i = 0; i < serial.size(); ++i) {
    serial[i]();
    EXPECT_NE(serial[i].rhs[0], 0);
    EXPECT_TRUE(same(serial[i].rhs, parallel[i].rhs, static_cast<std::size_t>(serial[i].ndofel)));
    EXPECT_TRUE(same(serial[i].amatrx, parallel[i].amatrx, serial[i].amatrx.size()));
    EXPECT_TRUE(same(serial[i].svars, parallel[i].svars, serial[i].svars.size()));
  }
}

std::string working_directory() { return ""; }

TEST(Threads, ModelIsReadOnce) {
  for (int number = 701; number < 721; ++number) {
    std::ofstream("ents_" + std::to_string(number) + ".json") << R"({"segment": "line2"})";
    constexpr int threads = 8;
    std::array<const ents_adapter::LoadedModel*, threads> found{};
    std::latch start(threads);
    std::vector<std::thread> pool;
    for (int t = 0; t < threads; ++t)
      pool.emplace_back([&, t] {
        start.arrive_and_wait();
        found[static_cast<std::size_t>(t)] = &ents_adapter::model_number(number, working_directory);
      });
    for (std::thread& thread : pool) thread.join();
    for (const auto* model : found) EXPECT_EQ(model, found[0]);
    EXPECT_NE(found[0]->model, nullptr);
  }
}

} // namespace
} // namespace adapters
