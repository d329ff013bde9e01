// SPDX-License-Identifier: BSD-3-Clause
// Mistakes of a caller that would give wrong numbers without a word: each is refused, over random surfaces,
// and named.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include "sample_count.hpp"
#include "support/surface.hpp"

namespace silent_mistakes_test {
namespace {

using namespace test;

TEST(SilentMistakes, ATreeOfAnotherHeightIsRefusedUntilItIsRefitted) {
  mechanics::Random random(3);
  int64_t moved = 0;
  for (int trial = 0; trial < samples(200); ++trial) {
    const int d = trial % 2 == 0 ? 2 : 3;
    const Surface surface(random, d);
    const auto with = [&](double amplitude) {
      const std::string height = R"(, "height": {"type": "sine", "amplitude": )" + number(amplitude) +
                                 R"(, "wave_vector": )" + (d == 2 ? "[0.2]" : "[0.2, 0.1]") + "}";
      return Model(text_of(d, penalty, height));
    };
    const double amplitude = random.uniform(0.01, 0.05);
    const Model before = with(amplitude), after = with(amplitude + random.uniform(0.5, 1.0)),
                other_law(before.text());
    std::vector<double> tree = tree_of(before, surface);
    Found found, fresh;
    ents_report report = new_report();
    EXPECT_EQ(detect(other_law, surface, tree, surface.slave, 0.5, found, report),
              ENTS_OK); // boxes are those of the height
    EXPECT_EQ(detect(after, surface, tree, surface.slave, 0.5, found, report), ENTS_BAD_STATE);
    EXPECT_NE(std::strstr(report.message, "ents_tree_refit"), nullptr) << report.message;
    EXPECT_EQ(
        call::tree_refit(after.get(), &surface.mesh, tree.data(), static_cast<int64_t>(tree.size()), nullptr),
        ENTS_OK);
    found = {};
    EXPECT_EQ(detect(after, surface, tree, surface.slave, 0.5, found, report), ENTS_OK);
    EXPECT_EQ(detect(after, surface, tree_of(after, surface), surface.slave, 0.5, fresh, report), ENTS_OK);
    EXPECT_EQ(found.segment, fresh.segment);
    for (const int64_t s : found.segment) moved += s >= 0;
  }
  EXPECT_GT(moved, 0);
}

TEST(SilentMistakes, ATreeWithNaNOrAForeignSegmentIsRefused) {
  mechanics::Random random(5);
  int64_t refused = 0;
  for (int trial = 0; trial < samples(2000); ++trial) {
    const int d = trial % 2 == 0 ? 2 : 3;
    const Surface surface(random, d);
    const Model model(text_of(d, penalty));
    std::vector<double> tree = tree_of(model, surface);
    Found right, found;
    ents_report report = new_report();
    ASSERT_EQ(detect(model, surface, tree, surface.slave, 0.5, right, report), ENTS_OK);
    const std::size_t at = 3 + static_cast<std::size_t>(random.below(static_cast<int>(tree.size()) - 3));
    const double bad[] = {std::numeric_limits<double>::quiet_NaN(), -1.0, 1e300};
    const bool in_order = at < 3 + static_cast<std::size_t>(surface.mesh.segments);
    tree[at] = bad[in_order ? random.below(3) : 0];
    const int32_t status = detect(model, surface, tree, surface.slave, 0.5, found, report);
    refused += status == ENTS_BAD_STATE;
    EXPECT_TRUE(status == ENTS_BAD_STATE ||
                (status == ENTS_OK && found.segment == right.segment)); // or nobody came there
  }
  EXPECT_GT(refused, samples(2000) / 4);
}

TEST(SilentMistakes, TheTwoSidesOfASheetWithoutThicknessAreAmbiguous) {
  mechanics::Random random(7);
  for (int trial = 0; trial < samples(200); ++trial) {
    Surface surface(random, trial % 2 == 0 ? 2 : 3);
    const std::size_t m = surface.dimension == 2 ? 2 : 4;
    const std::vector<int64_t> one_side = surface.connectivity;
    for (std::size_t s = 0; s < one_side.size(); s += m) // backwards
      for (std::size_t i = m; i-- > 0;) surface.connectivity.push_back(one_side[s + i]);
    surface.mesh.connectivity = surface.connectivity.data(), surface.mesh.segments *= 2;
    const Model model(text_of(surface.dimension, penalty));
    Found found;
    ents_report report = new_report();
    ASSERT_EQ(detect(model, surface, tree_of(model, surface), surface.slave, 0.5, found, report), ENTS_OK);
    for (std::size_t i = 0; i < found.segment.size(); ++i)
      if (found.segment[i] >= 0 && std::fabs(found.gap[i]) > 1e-6) {
        EXPECT_NE(found.flags[i] & ENTS_FLAG_AMBIGUOUS, 0);
        EXPECT_GE(found.other[i], 0);
      }
  }
}

TEST(SilentMistakes, ASlaveThatIsAMasterNodeIsNotProjectedOnItsOwnSegments) {
  mechanics::Random random(11);
  for (int trial = 0; trial < samples(200); ++trial) {
    const Surface surface(random, trial % 2 == 0 ? 2 : 3);
    const Model model(text_of(surface.dimension, penalty));
    const std::vector<double> tree = tree_of(model, surface);
    std::vector<int64_t> nodes;
    for (int64_t i = 0; i < surface.mesh.nodes; ++i) nodes.push_back(i);
    Found found;
    ents_report report = new_report();
    ASSERT_EQ(detect(model, surface, tree, surface.positions, 5.0, found, report, nodes.data()), ENTS_OK);
    const int m = surface.dimension == 2 ? 2 : 4;
    for (int64_t i = 0; i < surface.mesh.nodes; ++i) {
      const int64_t s = found.segment[static_cast<std::size_t>(i)];
      for (int k = 0; s >= 0 && k < m; ++k)
        EXPECT_NE(surface.connectivity[static_cast<std::size_t>(s * m + k)], i);
    }
    nodes[0] = surface.mesh.nodes;
    EXPECT_EQ(detect(model, surface, tree, surface.positions, 5.0, found, report, nodes.data()),
              ENTS_BAD_VALUE);
    EXPECT_NE(std::strstr(report.message, "detection.slave_node of node 0"), nullptr) << report.message;
  }
}

TEST(SilentMistakes, PlacesNoticeOtherNodesUnderTheSameSegmentNumbers) {
  mechanics::Random random(13);
  for (int trial = 0; trial < samples(100); ++trial) {
    const int d = trial % 2 == 0 ? 2 : 3;
    Surface surface(random, d);
    const Model model(text_of(d, penalty));
    Found found;
    ents_report report = new_report();
    ASSERT_EQ(detect(model, surface, tree_of(model, surface), surface.slave, 0.5, found, report), ENTS_OK);
    System system(model, surface, random);
    ASSERT_EQ(system.assemble(found.segment, surface.mesh, true, nullptr, nullptr, report), ENTS_OK)
        << report.message;
    // nodes get other numbers, and their positions with them: the same surface
    const auto nodes = static_cast<std::size_t>(surface.mesh.nodes), dim = static_cast<std::size_t>(d);
    std::vector<std::size_t> number(nodes);
    for (std::size_t i = 0; i < nodes; ++i) number[i] = (i * 7 + static_cast<std::size_t>(trial)) % nodes;
    std::vector<double> positions(surface.positions.size());
    for (std::size_t i = 0; i < nodes; ++i)
      for (std::size_t k = 0; k < dim; ++k) positions[number[i] * dim + k] = surface.positions[i * dim + k];
    std::vector<int64_t> connectivity;
    for (const int64_t i : surface.connectivity)
      connectivity.push_back(static_cast<int64_t>(number[static_cast<std::size_t>(i)]));
    ents_master_mesh mesh = surface.mesh;
    mesh.positions = positions.data(), mesh.connectivity = connectivity.data();
    if (std::set<std::size_t>(number.begin(), number.end()).size() != nodes) continue;
    ASSERT_EQ(system.assemble(found.segment, mesh, true, nullptr, nullptr, report), ENTS_OK)
        << report.message;
    const std::vector<double> values = system.values, residual = system.residual;
    ASSERT_EQ(system.assemble(found.segment, mesh, false, nullptr, nullptr, report), ENTS_OK);
    EXPECT_EQ(values, system.values);
    EXPECT_EQ(residual, system.residual);
    // other equations, the same nodes
    std::swap(system.equations.front(), system.equations.back());
    ASSERT_EQ(system.assemble(found.segment, mesh, true, nullptr, nullptr, report), ENTS_OK)
        << report.message;
    const std::vector<double> swapped = system.values;
    ASSERT_EQ(system.assemble(found.segment, mesh, false, nullptr, nullptr, report), ENTS_OK);
    EXPECT_EQ(swapped, system.values);
  }
}

TEST(SilentMistakes, RowsCountedFromOneOrBeyondTheArrayAreRefused) {
  mechanics::Random random(17);
  const Surface surface(random, 3);
  const Model model(text_of(3, penalty));
  Found found;
  ents_report report = new_report();
  ASSERT_EQ(detect(model, surface, tree_of(model, surface), surface.slave, 0.5, found, report), ENTS_OK);
  const auto expect_refused = [&](const char* words, const std::function<void(System&)>& mistake) {
    System system(model, surface, random);
    mistake(system);
    const int32_t status = system.assemble(found.segment, surface.mesh, false, nullptr, nullptr, report);
    EXPECT_LT(status, 0) << words;
    EXPECT_NE(std::strstr(report.message, words), nullptr) << report.message;
  };
  expect_refused("system.row_begin[0] is 1", [](System& s) {
    for (int64_t& begin : s.row_begin) ++begin;
  });
  expect_refused("system.columns", [](System& s) {
    for (int64_t& column : s.columns) ++column;
  });
  expect_refused("has no entry", [](System& s) {
    for (std::size_t i = 1; i + 1 < s.row_begin.size(); ++i) s.row_begin[i] = int64_t{1} << 30;
  });
  expect_refused("system.slave_nodes is 29", [](System& s) {
    s.change = [](ents_system& system) { system.slave_nodes = Surface::slaves - 1; };
  });
  expect_refused("index_size",
                 [](System& s) { s.change = [](ents_system& system) { system.index_size = 4; }; });
}

TEST(SilentMistakes, AStateOfAnotherBasisOrLawIsRefused) {
  const std::vector<std::string> laws = {penalty, coulomb, rough};
  test::Random elements(19);
  const char* bases[] = {"tri3", "quad4", "tri6", "quad9"};
  int64_t refused = 0;
  for (const char* from : bases)
    for (const std::string& from_law : laws)
      for (const char* to : bases)
        for (const std::string& to_law : laws) {
          const Model one(R"({"segment": ")" + std::string(from) + R"(", "contact": )" + from_law + "}");
          const Model two(R"({"segment": ")" + std::string(to) + R"(", "contact": )" + to_law + "}");
          std::vector<double> state(64), end(64);
          ASSERT_EQ(call::state_init(one.get(), int64_t{1}, state.data(), int64_t{64}, nullptr), ENTS_OK);
          const Element element = draw(two, basis(to), elements);
          ents_input in = input_of(element);
          in.state_begin = state.data();
          double gap = 0.0;
          ents_output out{};
          out.struct_size = sizeof out;
          out.wanted = ENTS_GAP | ENTS_STATE, out.gap = &gap, out.state_end = end.data();
          const int32_t status = call::evaluate(two.get(), int64_t{0}, int64_t{1}, &in, &out, nullptr);
          const bool same = std::string(from) == to && from_law == to_law;
          EXPECT_EQ(status == ENTS_BAD_STATE, !same) << from << " " << to << from_law << to_law;
          refused += status == ENTS_BAD_STATE;
        }
  EXPECT_EQ(refused, 12 * 11);
}

TEST(SilentMistakes, FrictionOnAnotherSegmentNeedsATransfer) {
  mechanics::Random random(23);
  int64_t refused = 0, transferred = 0;
  for (int trial = 0; trial < samples(100); ++trial) {
    const int d = trial % 2 == 0 ? 2 : 3;
    const Surface surface(random, d);
    const Model model(text_of(d, coulomb)), frictionless(text_of(d, penalty));
    Found found;
    ents_report report = new_report();
    ASSERT_EQ(detect(model, surface, tree_of(model, surface), surface.slave, 0.5, found, report), ENTS_OK);
    System system(model, surface, random);
    const auto size = static_cast<std::size_t>(model.layout.state_size);
    std::vector<double> begin(size * Surface::slaves), end(begin);
    call::state_init(model.get(), int64_t{Surface::slaves}, begin.data(), static_cast<int64_t>(size),
                     nullptr);
    ASSERT_EQ(system.assemble(found.segment, surface.mesh, false, begin.data(), end.data(), report), ENTS_OK)
        << report.message;
    ASSERT_EQ(system.assemble(found.segment, surface.mesh, false, end.data(), begin.data(), report), ENTS_OK)
        << report.message;
    for (int64_t i = 0; i < Surface::slaves; ++i) {
      const int64_t s = found.segment[static_cast<std::size_t>(i)];
      if (s < 0 || !(end[static_cast<std::size_t>(i) * size + 1] > 1.0)) continue;
      std::vector<int64_t> segment = found.segment;
      segment[static_cast<std::size_t>(i)] = s == 0 ? 1 : s - 1;
      EXPECT_EQ(system.assemble(segment, surface.mesh, false, end.data(), begin.data(), report),
                ENTS_BAD_STATE);
      EXPECT_NE(std::strstr(report.message, "ents_state_transfer"), nullptr) << report.message;
      ++refused;
      const auto master = [&](int64_t of) {
        std::vector<double> out;
        for (int a = 0; a < model.layout.nodes; ++a)
          for (int k = 0; k < d; ++k)
            out.push_back(surface.positions[static_cast<std::size_t>(
                surface.connectivity[static_cast<std::size_t>(of * model.layout.nodes + a)] * d + k)]);
        return out;
      };
      std::vector<double> moved = end;
      const std::size_t at = static_cast<std::size_t>(i) * size;
      if (call::state_transfer(model.get(), master(s).data(), nullptr,
                               master(segment[static_cast<std::size_t>(i)]).data(), nullptr, &end[at],
                               &moved[at], nullptr) != ENTS_OK)
        continue;
      const int32_t status =
          system.assemble(segment, surface.mesh, false, moved.data(), begin.data(), report);
      EXPECT_NE(status, ENTS_BAD_STATE) << report.message;
      ++transferred;
    }
  }
  EXPECT_GT(refused, samples(100));
  EXPECT_GT(transferred, samples(100));
}

// Only the caller knows whether this is the first increment, and the library cannot refuse: README.md says
// what the caller sees.
TEST(SilentMistakes, FrictionWithoutStatesIsNoFrictionAndItsAgeIsZero) {
  test::Random random(29);
  int compared = 0;
  for (const char* base : {"line2", "tri3", "quad4", "quad9"}) {
    const std::string segment = R"({"segment": ")" + std::string(base) + R"(", "contact": )";
    const Model model(segment + coulomb + "}"), frictionless(segment + penalty + "}");
    for (int trial = 0; trial < samples(100); ++trial) {
      Element with = with_new_state(model, draw(model, basis(base), random, -0.03, -0.02));
      Element without = with;
      without[state_begin].clear();
      Results kept(model.layout), lost(model.layout), plain(frictionless.layout);
      const int32_t wanted = ENTS_RESIDUAL | ENTS_STATE | ENTS_FLAGS | ENTS_AGE;
      double friction = 0.0;
      for (int increment = 0; increment < 3; ++increment) {
        if (test::evaluate(model, with, wanted, kept) != ENTS_OK || (kept.flags & ENTS_FLAG_CONTACT) == 0)
          break;
        ASSERT_EQ(test::evaluate(model, without, wanted, lost), ENTS_OK);
        Element none = without;
        ASSERT_EQ(test::evaluate(frictionless, none, ENTS_RESIDUAL, plain), ENTS_OK);
        EXPECT_EQ(lost.of(ENTS_AGE)[0], 0.0) << base << ", increment " << increment;
        for (std::size_t i = 0; i < plain.of(ENTS_RESIDUAL).size(); ++i) {
          EXPECT_NEAR(lost.of(ENTS_RESIDUAL)[i], plain.of(ENTS_RESIDUAL)[i], 1e-14); // forces of order 0.3
          friction = std::max(friction, std::fabs(kept.of(ENTS_RESIDUAL)[i] - plain.of(ENTS_RESIDUAL)[i]));
        }
        EXPECT_EQ(kept.of(ENTS_AGE)[0], increment) << base; // it sticks all the while
        with[state_begin] = kept.of(ENTS_STATE);
        for (double& x : with[slave]) x += random(-1e-4, 1e-4); // sticks
        without[slave] = with[slave];
        if (increment == 2) {
          EXPECT_GT(friction, 1e-6) << base;
          ++compared;
        }
      }
    }
  }
  EXPECT_GT(compared, 3 * samples(100));
}

} // namespace
} // namespace silent_mistakes_test
