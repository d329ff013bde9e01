// SPDX-License-Identifier: BSD-3-Clause
// Eight threads of a host call its adapter for elements of their own, and meet where the model is read.
// Built with the thread sanitizer, too.
#include <array>
#include <cstring>
#include <fstream>
#include <latch>
#include <thread>

#include <gtest/gtest.h>

#include "../../adapters/common/model_cache.hpp"
#include "hosts.hpp"
#include "problem.hpp"
#include "uel_host.hpp"
#include "uinter_host.hpp"

extern "C" int ents_feap_form(const double* d, const double* xl, const double* ul, const double* du,
                              int number, int nodes, int ndf, int ndm, int nst, int tangent, double factor,
                              const double* begin, double* end, int history, double* s, double* p, char* text,
                              int length);

namespace adapters::threads_test {
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

class InEveryHost : public testing::TestWithParam<HostKind> {};

/// Some increments of all elements, the last of which a thread leaves out. Texture, friction, slip, history.
std::vector<Answer> increments(const HostKind& kind, const Problem& p, bool parallel) {
  const std::unique_ptr<EmulatedHost> host = kind.make(p.elements);
  const std::vector<double> whole = pressed(p);
  constexpr std::size_t threads = 8, rounds = 6, repeats = 3;
  std::vector<Answer> answers(threads * rounds * repeats);
  for (std::size_t round = 0; round < rounds; ++round) {
    std::vector<double> u = whole;
    for (double& value : u) value *= 0.8 + 0.1 * static_cast<double>(round);
    std::latch start(threads);
    const auto work = [&](std::size_t element) {
      if (parallel) start.arrive_and_wait();
      for (std::size_t i = 0; i < repeats; ++i)
        answers[(round * threads + element) * repeats + i] = host->evaluate(static_cast<int>(element), u);
    };
    std::vector<std::thread> pool;
    for (std::size_t element = 0; element < threads; ++element)
      if (parallel)
        pool.emplace_back(work, element);
      else
        work(element);
    for (std::thread& thread : pool) thread.join();
    host->evaluate(static_cast<int>(threads), u); // of the last element there is a history to keep, too
    host->accept();
  }
  return answers;
}

TEST_P(InEveryHost, EightThreadsGiveTheSameBits) {
  const Problem p = problem("quad4_friction");
  ASSERT_EQ(p.elements.nodes.size(), 9u);
  const std::vector<Answer> parallel = increments(GetParam(), p, true),
                            serial = increments(GetParam(), p, false);
  std::size_t forces = 0;
  for (std::size_t i = 0; i < serial.size(); ++i) {
    ASSERT_FALSE(serial[i].residual.empty());
    EXPECT_EQ(parallel[i].residual, serial[i].residual) << i; // == of doubles, none is NaN
    EXPECT_EQ(parallel[i].tangent, serial[i].tangent) << i;
    forces += serial[i].residual[0] != 0;
  }
  EXPECT_GE(forces, serial.size() / 2);
}

INSTANTIATE_TEST_SUITE_P(Threads, InEveryHost, testing::ValuesIn(hosts()),
                         [](const auto& test) { return test.param.name; });

TEST(Threads, EightGiveTheSameBitsInPointsOfUinter) {
  std::ofstream("ents_52.json")
      << R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.8, 0.3]},
    "contact": {"normal": {"type": "penalty", "stiffness": 500}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 300}}})";
  constexpr int threads = 8, rounds = 20;
  std::vector<UinterCall> parallel;
  for (int i = 0; i < threads * rounds; ++i) {
    UinterCall& c = parallel.emplace_back(3);
    c.props[0] = 52;
    c.rdisp[0] = 0.04, c.rdisp[1] = 0.002 * i, c.rdisp[2] = -0.001 * i;
    c.place(0.25, 0.01 * i);
  }
  std::vector<UinterCall> serial = parallel;
  std::vector<std::thread> pool;
  for (int t = 0; t < threads; ++t)
    pool.emplace_back([&, t] {
      for (int i = 0; i < rounds; ++i) parallel[static_cast<std::size_t>(threads * i + t)]();
    });
  for (std::thread& thread : pool) thread.join();
  for (std::size_t i = 0; i < serial.size(); ++i) {
    serial[i]();
    EXPECT_GT(serial[i].stress[0], 0);
    EXPECT_TRUE(same(serial[i].stress, parallel[i].stress, 3));
    EXPECT_TRUE(same(serial[i].ddsddr, parallel[i].ddsddr, 9));
    EXPECT_TRUE(same(serial[i].statev, parallel[i].statev, serial[i].statev.size()));
  }
}

// FEAP's own routine goes through common blocks, one call after the other; what it calls could be called by
// any thread.
TEST(Threads, EightGiveTheSameBitsInWhatElmt07Calls) {
  const Problem p = problem("quad4_friction");
  const std::vector<double> u = pressed(p);
  constexpr int threads = 8, rounds = 20, rows = 15;
  struct Call {
    std::vector<double> s = std::vector<double>(rows * rows), p = std::vector<double>(rows),
                        end = std::vector<double>(64);
  };
  const auto form = [&](int element, double area, Call& call) {
    const auto& nodes = p.elements.nodes[static_cast<std::size_t>(element)];
    std::vector<double> xl, ul, begin(64);
    for (const int node : nodes)
      for (int i = 0; i < 3; ++i) {
        xl.push_back(p.elements.reference[static_cast<std::size_t>(3 * node + i)]);
        ul.push_back(u[static_cast<std::size_t>(3 * node + i)]);
      }
    const double d[3] = {static_cast<double>(p.elements.model), area, 0};
    char text[480];
    ents_feap_form(d, xl.data(), ul.data(), ul.data(), element + 1, 5, 3, 3, rows, 1, 1.0, begin.data(),
                   call.end.data(), p.elements.state_size, call.s.data(), call.p.data(), text, 480);
  };
  std::vector<Call> parallel(threads * rounds), serial(threads * rounds);
  const auto one = [&](std::vector<Call>& calls, int i) {
    form(i % 3, 0.2 + 0.01 * i, calls[static_cast<std::size_t>(i)]);
  };
  std::vector<std::thread> pool;
  for (int t = 0; t < threads; ++t)
    pool.emplace_back([&, t] {
      for (int i = 0; i < rounds; ++i) one(parallel, threads * i + t);
    });
  for (std::thread& thread : pool) thread.join();
  for (int i = 0; i < threads * rounds; ++i) {
    one(serial, i);
    const auto k = static_cast<std::size_t>(i);
    EXPECT_NE(serial[k].p[0], 0);
    EXPECT_EQ(serial[k].p, parallel[k].p);
    EXPECT_EQ(serial[k].s, parallel[k].s);
    EXPECT_EQ(serial[k].end, parallel[k].end);
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
} // namespace adapters::threads_test
