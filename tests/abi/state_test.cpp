// SPDX-License-Identifier: BSD-3-Clause
// State blocks: what is not one of this model, version and size is refused, whatever byte of it is wrong; a
// block goes through memory unharmed.
#include <gtest/gtest.h>

#include <limits>

#include "support/element.hpp"

namespace state_test {
namespace {

using namespace test;

class State : public ::testing::Test {
protected:
  State() : random(111) {}
  // An element in contact with friction that has slipped, so that no entry of its state is trivial.
  Element slipped(const Model& model, const Basis& b) {
    Results results(model.layout);
    for (int attempt = 0; attempt < 1000; ++attempt) {
      Element e = with_new_state(model, draw(model, b, random, -0.03, -0.02));
      bool fine = true;
      for (int increment = 0; increment < 3 && fine; ++increment) {
        fine = test::evaluate(model, e, ENTS_STATE, results) == ENTS_OK;
        e[state_begin] = results.of(ENTS_STATE);
        for (double& x : e[slave]) x += random(-0.01, 0.01);
      }
      if (fine && test::evaluate(model, e, want_all, results) == ENTS_OK) return e;
    }
    throw std::runtime_error("no element in contact");
  }
  void expect_refused(const Model& model, const Element& e, const std::string& why) {
    Results results(model.layout);
    ents_report report = new_report();
    EXPECT_EQ(test::evaluate(model, e, want_all, results, &report), ENTS_BAD_STATE) << why;
    EXPECT_EQ(report.element, 0);
    EXPECT_NE(std::string(report.message).find("input.state_begin"), std::string::npos) << report.message;
  }
  Random random;
};

TEST_F(State, UninitialisedBlocksAreRefused) {
  for (const ModelKind& kind : some_kinds()) {
    const Model model(text(kind));
    Element e = with_new_state(model, draw(model, basis(kind.basis), random));
    Results results(model.layout);
    EXPECT_GE(test::evaluate(model, e, want_element, results), 0);
    const auto size = e[state_begin].size();
    e[state_begin].assign(size, 0.0);
    expect_refused(model, e, "zeros");
    e[state_begin].assign(size, 1.0);
    expect_refused(model, e, "ones");
    e[state_begin].assign(size, std::numeric_limits<double>::quiet_NaN());
    expect_refused(model, e, "NaN");
    for (double& v : e[state_begin]) v = random(-1e3, 1e3);
    expect_refused(model, e, "random numbers");
  }
}

// Any single bit of the tag, and any history there is not.
TEST_F(State, EveryBitOfTheTagCounts) {
  const Model model(text({"quad4", "sine", "normal", "", 9}));
  const Element good = slipped(model, basis("quad4"));
  for (int bit = 0; bit < 64; ++bit) {
    Element e = good;
    std::uint64_t word;
    std::memcpy(&word, &e[state_begin][0], sizeof word);
    word ^= std::uint64_t{1} << bit;
    std::memcpy(&e[state_begin][0], &word, sizeof word);
    expect_refused(model, e, "tag, bit " + std::to_string(bit));
  }
  for (const double history : {-1.0, 0.5, 4.0, 1e300, -0.5, 5e-324}) {
    Element e = good;
    e[state_begin][1] = history;
    expect_refused(model, e, "history " + number(history));
  }
  for (std::size_t i = 0; i < good[state_begin].size(); ++i)
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      Element e = good;
      e[state_begin][i] = bad;
      expect_refused(model, e, "entry " + std::to_string(i));
    }
}

// Blocks of models with another number of parameters, with or without friction, with or without multipliers.
TEST_F(State, BlocksOfOtherModelsAreRefused) {
  std::vector<ModelKind> kinds;
  for (const char* b : {"line2", "quad4"})
    for (const std::size_t contact : {0u, 3u, 6u, 9u}) kinds.push_back({b, "none", "normal", "", contact});
  const std::vector<Model> models = make(kinds);
  for (std::size_t i = 0; i < models.size(); ++i)
    for (std::size_t j = 0; j < models.size(); ++j) {
      Element e = draw(models[i], basis(kinds[i].basis), random);
      std::vector<double> foreign(64, 0.0); // long enough for any
      call::state_init(models[j].get(), int64_t{1}, foreign.data(), int64_t{64}, nullptr);
      e[state_begin] = foreign;
      if (i != j) expect_refused(models[i], e, models[j].text() + " for " + models[i].text());
    }
}

// A block cut off at any byte and filled with zeros. Within the tag and the history a cut is seen for
// certain; later numbers of their own have no check, but then the block is at least one of the right kind,
// and the results finite.
TEST_F(State, TruncatedBlocks) {
  for (const std::size_t contact : {0u, 6u, 9u}) {
    const Model model(text({"quad4", "sine", "normal", "", contact}));
    const Element good = slipped(model, basis("quad4"));
    ASSERT_NE(good[state_begin][1], 0.0);
    const std::size_t bytes = good[state_begin].size() * sizeof(double);
    for (std::size_t kept = 0; kept < bytes; ++kept) {
      Element e = good;
      std::memset(reinterpret_cast<char*>(e[state_begin].data()) + kept, 0, bytes - kept);
      if (same_bits(e[state_begin], good[state_begin])) continue;
      // the last bytes of the history are those that say which one it is: cut to nothing it reads "none", a
      // new block's
      const double history = e[state_begin][1];
      if (e[state_begin][0] != good[state_begin][0] ||
          (history != 0.0 && history != 2.0 && history != good[state_begin][1])) {
        expect_refused(model, e, "cut after byte " + std::to_string(kept));
        continue;
      }
      Results results(model.layout);
      const int32_t status = test::evaluate(model, e, want_all, results);
      EXPECT_GE(status, 0) << kept;
      if (status == ENTS_OK) {
        for (const auto& array : results.real) EXPECT_TRUE(all_finite(array)) << kept;
      }
    }
  }
}

// Written out and read back byte by byte, the increment goes on with the same bits.
TEST_F(State, RestartGivesTheSameBits) {
  for (const ModelKind& kind : some_kinds()) {
    const Model model(text(kind));
    Element e = with_history(model, draw(model, basis(kind.basis), random), random);
    std::string file(reinterpret_cast<const char*>(e[state_begin].data()),
                     e[state_begin].size() * sizeof(double));
    Results expected(model.layout), results(model.layout);
    const int32_t status = test::evaluate(model, e, want_all, expected);
    std::memcpy(e[state_begin].data(), file.data(), file.size());
    const Model again(text(kind));
    EXPECT_EQ(test::evaluate(again, e, want_all, results), status);
    EXPECT_TRUE(same_bits(results, expected)) << text(kind);
  }
}

// A slave crosses a groove, open and in small steps: what it is over now is what its start says, or the
// search of the whole segment, and not where it was last seen.
TEST_F(State, OpenDoesNotHoldTheProjection) {
  for (const bool friction : {false, true}) {
    const std::string law =
        friction ? R"(, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 50})" : "";
    const Model model(R"({"segment": "line2", "height": {"type": "polynomial", "coefficients": [0, 0, 3]},
                          "contact": {"normal": {"type": "penalty", "stiffness": 100})" +
                      law + "}}");
    const std::vector<double> nodes = {-1, 0, 1, 0};
    for (const bool started : {false, true})
      for (const bool many : {false, true}) { // one call for eight of them takes other kernels
        const int64_t count = many ? 8 : 1, size = model.layout.state_size;
        std::vector<double> begin(static_cast<std::size_t>(count * size)), end(begin),
            gap(static_cast<std::size_t>(count));
        ents_report report = new_report();
        ASSERT_EQ(call::state_init(model.get(), count, begin.data(), size, &report), ENTS_OK);
        for (const double x :
             {-0.55, -0.2, 0.2, 0.6, 0.72, 0.74}) { // the right flank is at x = 0.707 where y = 1.5
          const double slave[2] = {x, 1.5}, start = x > 0 ? 0.7 : -0.7;
          ents_input in{};
          in.struct_size = sizeof in;
          in.slave = slave, in.master = nodes.data(), in.start = started ? &start : nullptr;
          in.state_begin = begin.data(), in.state_begin_stride = size;
          ents_output out{};
          out.struct_size = sizeof out;
          out.wanted = ENTS_GAP | ENTS_STATE;
          out.gap = gap.data(), out.gap_stride = 1, out.state_end = end.data(), out.state_end_stride = size;
          ASSERT_EQ(call::evaluate(model.get(), int64_t{0}, count, &in, &out, &report), ENTS_OK)
              << report.message;
          for (const double g : gap)
            EXPECT_EQ(g<0, x> 0.707) << x << " " << g << " " << friction << started << many;
          begin = end;
        }
      }
  }
}

TEST_F(State, TransferAndAugmentRefuseForeignBlocks) {
  const Model model(text({"quad4", "none", "normal", "", 9}));
  const std::vector<double> nodes = flat_master(basis("quad4"));
  const auto size = static_cast<std::size_t>(model.layout.state_size);
  std::vector<double> state(size, 0.0), moved(size, -7.0), good(size);
  call::state_init(model.get(), int64_t{1}, good.data(), int64_t{model.layout.state_size}, nullptr);
  ents_report report = new_report();
  EXPECT_EQ(call::state_transfer(model.get(), nodes.data(), nullptr, nodes.data(), nullptr, state.data(),
                                 moved.data(), &report),
            ENTS_BAD_STATE);
  for (const double v : moved) EXPECT_EQ(v, -7.0);
  const auto stride = static_cast<int64_t>(size);
  EXPECT_EQ(call::state_augment(model.get(), 1, good.data(), stride, state.data(), stride, &report),
            ENTS_BAD_STATE);
  EXPECT_EQ(call::state_augment(model.get(), 1, state.data(), stride, good.data(), stride, &report),
            ENTS_BAD_STATE);
  for (const double v : state) EXPECT_EQ(v, 0.0);
  const Model augmented(
      R"({"segment": "line2", "contact": {"normal": {"type": "augmented", "stiffness": 100}}})");
  const auto length = int64_t{augmented.layout.state_size};
  std::vector<double> begin(static_cast<std::size_t>(length)), end;
  call::state_init(augmented.get(), int64_t{1}, begin.data(), length, nullptr);
  end = begin;
  end.back() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(
      call::state_augment(augmented.get(), int64_t{1}, begin.data(), length, end.data(), length, &report),
      ENTS_BAD_STATE);
  EXPECT_EQ(begin.back(), 0.0);
}

// Open near the segment, open so far away that no projection is found, open as a new state: one status.
TEST_F(State, OpenIsOpenWherever) {
  const Model model(R"({"segment": "line3", "contact": {"normal": {"type": "penalty", "stiffness": 100}}})");
  Element e;
  e[master] = {-1, 0, 1, 0, 0, 0.05};
  e[state_begin].resize(static_cast<std::size_t>(model.layout.state_size));
  call::state_init(model.get(), int64_t{1}, e[state_begin].data(), int64_t{model.layout.state_size}, nullptr);
  Results results(model.layout);
  double age = 0.0;
  for (const double x : {0.1, 30.0, 0.1, 0.2, 30.0}) {
    e[slave] = {x, 0.5};
    ASSERT_EQ(test::evaluate(model, e, want_element | ENTS_FLAGS, results), ENTS_OK);
    EXPECT_FALSE(results.flags & (ENTS_FLAG_CHANGED | ENTS_FLAG_CONTACT)) << x;
    EXPECT_EQ(results.of(ENTS_AGE)[0], ++age) << x;
    e[state_begin] = results.of(ENTS_STATE);
  }
  e[slave] = {0.1, 0.0};
  ASSERT_EQ(test::evaluate(model, e, want_element | ENTS_FLAGS, results), ENTS_OK);
  EXPECT_EQ(results.flags & (ENTS_FLAG_CHANGED | ENTS_FLAG_CONTACT), ENTS_FLAG_CHANGED | ENTS_FLAG_CONTACT);
  EXPECT_EQ(results.of(ENTS_AGE)[0], 0.0);
}

// A patch keeps the kernel's state and its segment.
TEST_F(State, PatchesRefuseWhatIsNotFinite) {
  const Model model(
      R"({"segment": "line2", "patch": [[0, 1], [1, 2]], "contact": {"normal": {"type": "penalty", "stiffness": 100}}})");
  Element e;
  e[master] = {0, 0, 1, 0, 2, 0}, e[slave] = {0.5, -0.01};
  e[state_begin].resize(static_cast<std::size_t>(model.layout.state_size));
  call::state_init(model.get(), int64_t{1}, e[state_begin].data(), int64_t{model.layout.state_size}, nullptr);
  Results results(model.layout);
  EXPECT_EQ(test::evaluate(model, e, want_element, results), ENTS_OK);
  e[state_begin] = results.of(ENTS_STATE);
  EXPECT_EQ(test::evaluate(model, e, want_element, results), ENTS_OK);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    e[state_begin][3] = bad;
    EXPECT_EQ(test::evaluate(model, e, want_element, results), ENTS_BAD_STATE);
  }
}

} // namespace
} // namespace state_test
