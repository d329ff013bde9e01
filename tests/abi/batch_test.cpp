// SPDX-License-Identifier: BSD-3-Clause
// A batch of n elements is n single calls, bit for bit: with packed, padded and shared inputs, in ranges, and
// when some of the elements fail.
#include <gtest/gtest.h>

#include "sample_count.hpp"
#include "support/batch.hpp"

namespace batch_test {
namespace {

using namespace test;

constexpr std::size_t count = batch_size;

// Each element of the batch against a call of its own, which may want more.
void expect_singles(const Model& model, const Batch& batch, std::size_t first, std::size_t last,
                    int32_t wanted = want_all) {
  for (std::size_t e = first; e < last; ++e) {
    Results single(model.layout);
    for (auto& array : single.real) array.assign(array.size(), -7.0);
    single.flags = single.iterations = -7;
    const int32_t status = test::evaluate(model, batch.elements[e], wanted, single);
    const std::size_t s = static_cast<std::size_t>(batch.output.status_stride);
    ASSERT_EQ(batch.integers[0][e * s], single.flags) << e;
    ASSERT_EQ(batch.integers[1][e * s], single.iterations) << e;
    ASSERT_EQ(batch.integers[2][e * s], status) << e;
    for (int i = 0; i < output_count; ++i) {
      if (!(batch.output.wanted & outputs[i].bit)) continue;
      const auto& array = batch.out[static_cast<std::size_t>(i)];
      const std::size_t at = e * batch.stride[static_cast<std::size_t>(i)];
      const std::vector<double> part(array.begin() + static_cast<std::ptrdiff_t>(at),
                                     array.begin() + static_cast<std::ptrdiff_t>(at + single[i].size()));
      ASSERT_TRUE(same_bits(part, single[i])) << outputs[i].name << " of element " << e;
    }
  }
}

TEST(Batch, EveryPatternOfStrides) {
  Random random(81);
  test::Turns turns(7);
  for (const ModelKind& kind : some_kinds()) {
    const Model model(text(kind));
    const std::vector<Element> elements = draw_batch(model, basis(kind.basis), random, true);
    for (unsigned shared = 0; shared < 1u << input_count; ++shared) {
      if (!turns.take()) continue;
      Batch batch(model, elements, shared, shared % 3, random.below(2) == 0 ? want_all : in_blocks);
      const int32_t status = call::evaluate(model.get(), int64_t{0}, static_cast<int64_t>(count),
                                            &batch.input, &batch.output, nullptr);
      ASSERT_GE(status, 0);
      expect_singles(model, batch, 0, count);
      if (HasFatalFailure()) FAIL() << "shared inputs " << shared << " " << text(kind);
    }
  }
}

TEST(Batch, EveryKindOfModelWithoutHistory) {
  Random random(82);
  test::Turns turns(7);
  for (const ModelKind& kind : all_kinds()) {
    if (!turns.take()) continue;
    const Model model(text(kind));
    const std::vector<Element> elements = draw_batch(model, basis(kind.basis), random, false);
    for (const int32_t wanted : {want_all, in_blocks})
      for (const std::size_t padding : {0u, 2u}) {
        Batch batch(model, elements, 0, padding, wanted);
        const int32_t status = call::evaluate(model.get(), int64_t{0}, static_cast<int64_t>(count),
                                              &batch.input, &batch.output, nullptr);
        ASSERT_GE(status, 0);
        expect_singles(model, batch, 0, count);
        if (HasFatalFailure()) FAIL() << "wanted " << wanted << " " << text(kind);
      }
  }
}

TEST(Batch, EveryRange) {
  Random random(83);
  const ModelKind kind = {"quad4", "sum", "normal", "", 6};
  const Model model(text(kind));
  const std::vector<Element> elements = draw_batch(model, basis(kind.basis), random, true);
  for (std::size_t first = 0; first <= count; ++first)
    for (std::size_t last = first; last <= count; ++last) {
      Batch batch(model, elements, 0, 1, last % 2 == 0 ? want_all : in_blocks);
      const int32_t status =
          call::evaluate(model.get(), static_cast<int64_t>(first), static_cast<int64_t>(last - first),
                         &batch.input, &batch.output, nullptr);
      ASSERT_GE(status, 0);
      expect_singles(model, batch, first, last);
      for (std::size_t e = 0; e < count; ++e)
        if (e < first || e >= last) {
          ASSERT_EQ(batch.integers[2][2 * e], -7) << "element " << e << " is outside the range";
        }
    }
}

// Elements that fail in the middle of a batch do not change the others; the first of them is what is
// returned.
TEST(Batch, RecoverableElementsLeaveTheOthersAlone) {
  Random random(84);
  const ModelKind kind = {"quad8", "gaussian"};
  const Model model(text(kind));
  std::vector<Element> elements = draw_batch(model, basis(kind.basis), random, false);
  for (const std::size_t e : {2, 5}) elements[e][master].assign(elements[e][master].size(), 0.5);
  Batch batch(model, elements, 0, 0);
  ents_report report = new_report();
  ASSERT_EQ(call::evaluate(model.get(), int64_t{0}, static_cast<int64_t>(count), &batch.input, &batch.output,
                           &report),
            ENTS_DEGENERATE_SEGMENT);
  EXPECT_EQ(report.element, 2);
  EXPECT_EQ(report.status, ENTS_DEGENERATE_SEGMENT);
  EXPECT_NE(std::string(report.message).find("element 2"), std::string::npos) << report.message;
  EXPECT_GT(report.step_factor, 0.0);
  EXPECT_LT(report.step_factor, 1.0);
  expect_singles(model, batch, 0, count);
}

// Any number in any input of two elements, which are computed beside others in a register: each element has
// the results and the status of a call of its own.
TEST(Batch, AnyNumberInAnyElement) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double special[] = {std::numeric_limits<double>::quiet_NaN(),
                            infinity,
                            -infinity,
                            1e308,
                            -1e308,
                            1e154,
                            -1e30,
                            1e-30,
                            5e-324,
                            -1.0,
                            0.0};
  Random random(87);
  int recoverable = 0, mistakes = 0, fine = 0;
  for (const ModelKind& kind : some_kinds()) {
    const Model model(text(kind));
    const std::vector<Element> good = draw_batch(model, basis(kind.basis), random, true);
    for (int i = 0; i < samples(60); ++i) {
      std::vector<Element> elements = good;
      for (int k = 0; k < 2; ++k) {
        Element& e = elements[static_cast<std::size_t>(random.below(batch_size))];
        std::vector<double>& numbers = e[random.below(input_count)];
        if (numbers.empty()) continue;
        numbers[static_cast<std::size_t>(random.below(static_cast<int>(numbers.size())))] =
            special[random.below(std::size(special))];
      }
      std::size_t before = 0; // elements before the first mistake
      int32_t expected = ENTS_OK;
      for (; before < count && expected >= ENTS_OK; ++before) {
        Results single(model.layout);
        const int32_t status = test::evaluate(model, elements[before], in_blocks, single);
        if (status < ENTS_OK || expected == ENTS_OK) expected = status;
        recoverable += status > ENTS_OK, mistakes += status < ENTS_OK, fine += status == ENTS_OK;
      }
      Batch batch(model, elements, 0, 0, in_blocks);
      ASSERT_EQ(call::evaluate(model.get(), int64_t{0}, static_cast<int64_t>(count), &batch.input,
                               &batch.output, nullptr),
                expected)
          << text(kind);
      expect_singles(model, batch, 0, before - (expected < ENTS_OK), in_blocks);
      if (HasFatalFailure()) FAIL() << text(kind);
    }
  }
  if (sample_divisor == 1) {
    EXPECT_GT(recoverable, 100);
    EXPECT_GT(mistakes, 500);
    EXPECT_GT(fine, 5000);
  }
}

// A caller's mistake ends the batch: elements before it are done, elements after it are not.
TEST(Batch, MistakesEndTheBatch) {
  Random random(85);
  const ModelKind kind = {"line3", "sine"};
  const Model model(text(kind));
  std::vector<Element> elements = draw_batch(model, basis(kind.basis), random, false);
  elements[1][master].assign(elements[1][master].size(), 0.5); // recoverable, before the mistake
  elements[4][master][3] = std::numeric_limits<double>::quiet_NaN();
  Batch batch(model, elements, 0, 0);
  ents_report report = new_report();
  ASSERT_EQ(call::evaluate(model.get(), int64_t{0}, static_cast<int64_t>(count), &batch.input, &batch.output,
                           &report),
            ENTS_NON_FINITE);
  EXPECT_EQ(report.element, 4);
  EXPECT_EQ(report.step_factor, 1.0);
  EXPECT_STREQ(report.message, "input.master[3] of element 4 is NaN");
  expect_singles(model, batch, 0, 5);
  for (std::size_t e = 5; e < count; ++e) EXPECT_EQ(batch.integers[2][e], -7);
}

// A host may keep one array of projections: the results are those of two.
TEST(Batch, XiMayTakeThePlaceOfTheStart) {
  Random random(86);
  const std::vector<double> nodes = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0.1};
  const int64_t connectivity[] = {0, 1, 2, 3};
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = 1, mesh.connectivity = connectivity, mesh.nodes = 4, mesh.positions = nodes.data();
  const Model model(text({"quad4", "sine"}));
  const auto n = static_cast<std::size_t>(model.layout.dofs);
  for (const std::size_t size : {1u, 5u, 63u, 64u, 200u})
    for (const int32_t wanted : {0, int32_t{ENTS_RESIDUAL}, ENTS_RESIDUAL | ENTS_GAP_GRADIENT})
      for (const bool in_mesh : {false, true})
        for (const std::size_t padding : {0u, 3u}) {
          std::vector<double> slaves, start;
          for (std::size_t e = 0; e < size; ++e) {
            slaves.insert(slaves.end(), {random(-0.9, 0.9), random(-0.9, 0.9), random(-0.08, 0.02)});
            for (std::size_t a = 0; a < 2 + padding; ++a)
              start.push_back(a < 2 ? slaves[3 * e + a] + random(-0.1, 0.1) : -7.0);
          }
          slaves[3 * (size / 2)] = 50.0; // one that takes another way
          const std::vector<int64_t> segment(size, 0);
          std::vector<double> apart(start.size(), -7.0), in_place = start, residual[2], gradient[2];
          std::vector<int32_t> iterations[2], status[2];
          for (const std::size_t k : {0u, 1u}) {
            ents_input in{};
            in.struct_size = sizeof in;
            in.slave = slaves.data(), in.slave_stride = 3;
            in.start = k == 0 ? start.data() : in_place.data(),
            in.start_stride = static_cast<int64_t>(2 + padding);
            if (in_mesh)
              in.mesh = &mesh, in.segment = segment.data(), in.segment_stride = 1;
            else
              in.master = nodes.data();
            residual[k].assign(size * n, -7.0), gradient[k] = residual[k], iterations[k].assign(size, -7),
                                                status[k] = iterations[k];
            ents_output out{};
            out.struct_size = sizeof out;
            out.wanted = wanted | ENTS_XI | ENTS_ITERATIONS;
            out.xi = k == 0 ? apart.data() : in_place.data(), out.xi_stride = in.start_stride;
            out.residual = residual[k].data(), out.residual_stride = static_cast<int64_t>(n);
            out.gap_gradient = gradient[k].data(), out.gap_gradient_stride = static_cast<int64_t>(n);
            out.iterations = iterations[k].data(), out.iterations_stride = 1;
            out.status = status[k].data(), out.status_stride = 1;
            ents_report report = new_report();
            ASSERT_GE(call::evaluate(model.get(), int64_t{0}, static_cast<int64_t>(size), &in, &out, &report),
                      ENTS_OK)
                << report.message;
            if (k == 0 || size == 1) continue;
            out.xi = in_place.data() + 1; // in the place of others' starts
            EXPECT_EQ(call::evaluate(model.get(), int64_t{0}, static_cast<int64_t>(size), &in, &out, &report),
                      ENTS_BAD_VALUE);
            EXPECT_NE(std::string(report.message).find("output.xi overlaps input.start"), std::string::npos)
                << report.message;
          }
          for (std::size_t e = 0; e < size; ++e)
            for (std::size_t a = 0; a < 2; ++a) {
              const std::size_t at = e * (2 + padding) + a;
              ASSERT_EQ(in_place[at], status[0][e] == ENTS_OK ? apart[at] : start[at])
                  << size << " " << wanted << " " << e;
            }
          EXPECT_TRUE(same_bits(residual[0], residual[1])) << size << " " << wanted;
          EXPECT_TRUE(same_bits(gradient[0], gradient[1])) << size << " " << wanted;
          EXPECT_EQ(iterations[0], iterations[1]) << size << " " << wanted;
          EXPECT_EQ(status[0], status[1]);
        }
}

} // namespace
} // namespace batch_test
