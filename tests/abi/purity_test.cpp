// SPDX-License-Identifier: BSD-3-Clause
// An evaluation is a function of its arguments: the same bits in any order, on any thread, alone or in a
// batch, with whatever strides.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <thread>

#include "sample_count.hpp"
#include "support/element.hpp"

namespace purity_test {
namespace {

using namespace test;

// One evaluation of a pool: its model, its element, what is wanted; and its results, as a hash (FNV-1a of all
// bytes).
struct Job {
  const Model* model;
  Element element;
  int32_t wanted;
  std::uint64_t expected = 0;
};

std::uint64_t hash(std::uint64_t h, const void* data, std::size_t bytes) {
  const auto* p = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < bytes; ++i) h = (h ^ p[i]) * 0x100000001b3u;
  return h;
}

std::uint64_t run(const Job& job) {
  Results results(job.model->layout);
  ents_report report = new_report();
  const int32_t status = test::evaluate(*job.model, job.element, job.wanted, results, &report);
  std::uint64_t h = hash(0xcbf29ce484222325u, &status, sizeof status);
  h = hash(h, report.message, std::strlen(report.message));
  h = hash(h, &results.flags, sizeof results.flags);
  h = hash(h, &results.iterations, sizeof results.iterations);
  for (int i = 0; i < output_count; ++i) h = hash(h, results[i].data(), results[i].size() * sizeof(double));
  return h;
}

constexpr int32_t job_masks[] = {want_all, want_element | want_values, ENTS_RESIDUAL, ENTS_GAP | ENTS_XI};

std::vector<Job> make_jobs(const std::vector<Model>& models, const std::vector<ModelKind>& kinds,
                           std::size_t count) {
  Random random(71);
  std::vector<Job> jobs;
  while (jobs.size() < count) {
    const std::size_t k = jobs.size() % models.size();
    Element e = draw(models[k], basis(kinds[k].basis), random);
    if (random.below(3) == 0) e[start].clear();
    if (random.below(3) == 0) e = with_history(models[k], std::move(e), random);
    if (random.below(10) == 0) e[slave][0] = 1e7; // outside, or an error
    jobs.push_back({&models[k], std::move(e), job_masks[random.below(4)]});
  }
  for (Job& job : jobs) job.expected = run(job);
  return jobs;
}

const int calls = static_cast<int>(long_samples(50000));

TEST(Purity, ShuffledOrderGivesTheSameBits) {
  const std::vector<ModelKind> kinds = all_kinds();
  const std::vector<Model> models = make(kinds);
  const std::vector<Job> jobs = make_jobs(models, kinds, 1000);
  Random random(72);
  int different = 0;
  for (int i = 0; i < calls; ++i) {
    const Job& job = jobs[static_cast<std::size_t>(random.below(static_cast<int>(jobs.size())))];
    different += run(job) != job.expected;
  }
  EXPECT_EQ(different, 0);
}

TEST(Purity, AnyNumberOfThreadsGivesTheSameBits) {
  const std::vector<ModelKind> kinds = all_kinds();
  const std::vector<Model> models = make(kinds);
  const std::vector<Job> jobs = make_jobs(models, kinds, 1000);
  for (const int threads : {1, 2, 8}) {
    std::atomic<int> different = 0;
    std::vector<std::thread> pool;
    for (int t = 0; t < threads; ++t)
      pool.emplace_back([&, t] {
        Random random(73 + static_cast<std::uint64_t>(t));
        for (int i = 0; i < calls / threads / 3; ++i) {
          const Job& job = jobs[static_cast<std::size_t>(random.below(static_cast<int>(jobs.size())))];
          different += run(job) != job.expected;
        }
      });
    for (std::thread& thread : pool) thread.join();
    EXPECT_EQ(different, 0) << threads << " threads";
  }
}

// Threads make and release models of their own while others evaluate theirs.
TEST(Purity, ModelsComeAndGoOnOtherThreads) {
  const std::vector<ModelKind> kinds = some_kinds();
  const std::vector<Model> models = make(kinds);
  const std::vector<Job> jobs = make_jobs(models, kinds, 100);
  std::atomic<int> different = 0, failed = 0;
  std::vector<std::thread> pool;
  for (int t = 0; t < 8; ++t)
    pool.emplace_back([&, t] {
      for (std::size_t i = 0; i < 300; ++i) {
        const Job& job = jobs[(7 * i + static_cast<std::size_t>(t)) % jobs.size()];
        if (t % 2 == 0) {
          different += run(job) != job.expected;
        } else {
          ents_model* model = nullptr;
          failed += call::model_create(job.model->text().c_str(), int64_t{-1}, nullptr, nullptr, int64_t{0},
                                       &model, nullptr) != ENTS_OK;
          call::model_destroy(&model, nullptr);
        }
      }
    });
  for (std::thread& thread : pool) thread.join();
  EXPECT_EQ(different, 0);
  EXPECT_EQ(failed, 0);
}

// Two models of the same text are the same; so is one made after thousands of others.
TEST(Purity, SameTextIsTheSameModel) {
  Random random(74);
  for (const ModelKind& kind : some_kinds()) {
    const Model first(text(kind)), second(text(kind));
    const Element e = with_history(first, draw(first, basis(kind.basis), random), random);
    Results a(first.layout), b(second.layout);
    EXPECT_EQ(test::evaluate(first, e, want_all, a), test::evaluate(second, e, want_all, b));
    EXPECT_TRUE(same_bits(a, b)) << text(kind);
  }
}

// What else is wanted does not change a result.
TEST(Purity, WantedOutputsDoNotChangeEachOther) {
  Random random(75);
  for (const ModelKind& kind : all_kinds()) {
    const Model model(text(kind));
    const Element e = draw(model, basis(kind.basis), random);
    Results all(model.layout);
    if (test::evaluate(model, e, want_all, all) != ENTS_OK) continue;
    for (int i = 0; i < output_count; ++i) {
      Results one(model.layout);
      ASSERT_EQ(test::evaluate(model, e, outputs[i].bit, one), ENTS_OK);
      ASSERT_TRUE(same_bits(one[i], all[i])) << outputs[i].name << " " << text(kind);
    }
    Results flags(model.layout);
    ASSERT_EQ(test::evaluate(model, e, ENTS_FLAGS, flags), ENTS_OK);
    ASSERT_EQ(flags.flags, all.flags) << text(kind);
  }
}

} // namespace
} // namespace purity_test
