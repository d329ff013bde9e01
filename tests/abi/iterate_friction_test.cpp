// SPDX-License-Identifier: BSD-3-Clause
// ents_iterate with friction: it searches, moves states to other segments and assembles, as ents_detect,
// ents_state_transfer and ents_assemble do when a caller calls them in turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "sample_count.hpp"
#include "support/surface.hpp"

namespace iterate_friction_test {
namespace {

using namespace test;

// Slaves that move over a surface whose nodes move, too.
struct Motion {
  Motion(const Model& m, Surface& s, mechanics::Random& random)
      : model(m), surface(s), system(m, s, random), tree(tree_of(m, s)), size(m.layout.state_size),
        begin(states()), segment(Surface::slaves, -1), xi(2 * Surface::slaves), positions_begin(s.positions) {
    call::state_init(model.get(), int64_t{Surface::slaves}, begin.data(), int64_t{size}, nullptr);
  }
  std::vector<double> states() const {
    return std::vector<double>(static_cast<std::size_t>(size) * Surface::slaves);
  }
  void move(mechanics::Random& random) {
    const auto d = static_cast<std::size_t>(surface.dimension);
    for (std::size_t i = 0; i < surface.slave.size(); ++i) {
      double& x = surface.slave[i];
      x += (i + 1) % d == 0 ? random.uniform(-0.005, 0.005) : random.uniform(-0.3, 0.3);
      if ((i + 1) % d != 0) x = std::clamp(x, 0.5, 3.5);
    }
    for (double& x : surface.positions) x += random.uniform(-0.01, 0.01);
    EXPECT_EQ(
        call::tree_refit(model.get(), &surface.mesh, tree.data(), static_cast<int64_t>(tree.size()), nullptr),
        ENTS_OK);
  }
  ents_detection detection() {
    ents_detection io{};
    io.struct_size = sizeof io;
    io.slave = surface.slave.data(), io.reach = 0.5, io.segment = segment.data(), io.xi = xi.data();
    io.permitted = ENTS_FLAG_LEFT | ENTS_FLAG_BEHIND_EDGE;
    return io;
  }
  ents_input rest() const {
    ents_input in{};
    in.struct_size = sizeof in;
    in.state_begin = begin.data(), in.state_begin_stride = size;
    in.positions_begin = positions_begin.data();
    return in;
  }
  ents_output output(std::vector<double>& end, std::vector<int32_t>& status) const {
    ents_output out{};
    out.struct_size = sizeof out;
    out.wanted = ENTS_STATE, out.state_end = end.data(), out.state_end_stride = size;
    out.status = status.data(), out.status_stride = 1;
    return out;
  }
  int32_t iterate(const ents_input& in, const ents_output& out, const ents_system* into) {
    const ents_detection io = detection();
    return call::iterate(model.get(), &surface.mesh, tree.data(), static_cast<int64_t>(tree.size()),
                         int64_t{0}, int64_t{Surface::slaves}, &io, &in, &out, into, &report);
  }
  // The caller moves the states that have to move. Returns how many.
  int moved_by_hand(std::vector<double>& states) {
    const auto master = [&](int64_t of) {
      std::vector<double> nodes;
      for (int a = 0; a < model.layout.nodes; ++a)
        for (int k = 0; k < surface.dimension; ++k)
          nodes.push_back(positions_begin[static_cast<std::size_t>(
              surface.connectivity[static_cast<std::size_t>(of * model.layout.nodes + a)] *
                  surface.dimension +
              k)]);
      return nodes;
    };
    const auto coordinates = [&](int64_t of) {
      return surface.mesh.surface_coordinates
                 ? surface.mesh.surface_coordinates + of * model.layout.nodes * model.layout.parameters
                 : nullptr;
    };
    int count = 0;
    states = begin;
    for (std::size_t i = 0; i < segment.size(); ++i) {
      const double* from = &begin[i * static_cast<std::size_t>(size)];
      const auto old = static_cast<int64_t>(from[size - 1]) - 1;
      if (segment[i] < 0 || old < 0 || segment[i] == old || !(from[1] >= 1.0)) continue; // open ones, too
      EXPECT_EQ(call::state_transfer(model.get(), master(old).data(), coordinates(old),
                                     master(segment[i]).data(), coordinates(segment[i]), from,
                                     &states[i * static_cast<std::size_t>(size)], nullptr),
                ENTS_OK);
      ++count;
    }
    return count;
  }

  const Model& model;
  Surface& surface;
  System system;
  std::vector<double> tree;
  int32_t size;
  std::vector<double> begin;
  std::vector<int64_t> segment;
  std::vector<double> xi, positions_begin;
  ents_report report = new_report();
};

TEST(IterateFriction, IsDetectionTransferAndAssembly) {
  mechanics::Random random(53);
  int moved = 0, contacts = 0;
  for (int trial = 0; trial < samples(60); ++trial) {
    const int d = trial % 2 == 0 ? 2 : 3;
    Surface surface(random, d);
    std::vector<double> s; // of the nodes' first positions
    for (const int64_t node : surface.connectivity)
      for (int k = 0; k + 1 < d; ++k) s.push_back(surface.positions[static_cast<std::size_t>(node * d + k)]);
    if (trial % 4 >= 2) surface.mesh.surface_coordinates = s.data();
    const Model model(text_of(d, trial % 8 < 4 ? coulomb : rough));
    Motion motion(model, surface, random);
    for (int increment = 0; increment < 4; ++increment) {
      std::vector<double> last;
      for (int iteration = 0; iteration < 2; ++iteration) {
        motion.move(random);
        const std::vector<int64_t> before = motion.segment;
        const std::vector<double> xi = motion.xi, begin = motion.begin;
        // by hand
        std::vector<double> end = motion.states(), states;
        std::vector<int32_t> status(Surface::slaves, -9);
        const ents_detection io = motion.detection();
        ASSERT_EQ(call::detect(model.get(), &surface.mesh, motion.tree.data(),
                               static_cast<int64_t>(motion.tree.size()), int64_t{0}, int64_t{Surface::slaves},
                               &io, &motion.report),
                  ENTS_OK)
            << motion.report.message;
        moved += motion.moved_by_hand(states);
        ASSERT_EQ(motion.system.assemble(motion.segment, surface.mesh, false, states.data(), end.data(),
                                         motion.report, motion.xi.data()),
                  ENTS_OK)
            << motion.report.message;
        const std::vector<double> values = motion.system.values, residual = motion.system.residual;
        const std::vector<int64_t> found = motion.segment;
        // in one call, with states that were moved by hand, and with those that were not: the same bits
        std::vector<double> at_once = motion.states(), alone = motion.states();
        const ents_system system = motion.system.made(surface.mesh, false);
        std::vector<double> bits;
        for (const bool by_hand : {true, false}) {
          ents_input in = motion.rest();
          if (by_hand) in.state_begin = states.data();
          motion.segment = before, motion.xi = xi;
          motion.system.clear();
          ASSERT_EQ(motion.iterate(in, motion.output(at_once, status), &system), ENTS_OK)
              << motion.report.message;
          EXPECT_EQ(motion.segment, found);
          EXPECT_EQ(status, std::vector<int32_t>(Surface::slaves, ENTS_OK));
          if (by_hand) {
            bits = motion.system.values, end = at_once;
            // ents_assemble starts the projection from the state: rounding, of forces and stiffnesses of
            // order 1
            for (std::size_t i = 0; i < values.size(); ++i)
              ASSERT_NEAR(motion.system.values[i], values[i], 1e-11);
            for (std::size_t i = 0; i < residual.size(); ++i)
              ASSERT_NEAR(motion.system.residual[i], residual[i], 1e-11);
          }
        }
        EXPECT_EQ(motion.system.values, bits);
        EXPECT_EQ(at_once, end);
        const ents_input in = motion.rest(); // results of the elements alone
        motion.segment = before, motion.xi = xi;
        status.assign(Surface::slaves, -9);
        ASSERT_EQ(motion.iterate(in, motion.output(alone, status), nullptr), ENTS_OK)
            << motion.report.message;
        EXPECT_EQ(alone, end);
        EXPECT_EQ(status, std::vector<int32_t>(Surface::slaves, ENTS_OK));
        EXPECT_EQ(motion.begin, begin) << "the begin of the increment was written over";
        last = end;
      }
      motion.begin = last;
      motion.positions_begin = surface.positions;
      for (std::size_t i = 1; i < last.size(); i += static_cast<std::size_t>(motion.size))
        contacts += last[i] > 1.0;
    }
  }
  EXPECT_GT(moved, samples(60) * 20);
  EXPECT_GT(contacts, samples(60) * 40);
}

// A fresh state with slave_begin is that of an evaluation at the begin, then of the iteration: with friction from the
// touch on, and no flag. Without slave_begin the flag says that there is none.
TEST(IterateFriction, BeginsAtTheTouchWithSlaveBegin) {
  mechanics::Random random(61);
  int touched = 0, unknown = 0;
  for (int trial = 0; trial < samples(40); ++trial) {
    const int d = trial % 2 == 0 ? 2 : 3;
    Surface surface(random, d);
    const Model model(text_of(d, coulomb));
    Motion motion(model, surface, random);
    const std::vector<double> fresh = motion.begin;
    std::vector<double> slave_begin = surface.slave;
    for (std::size_t i = 0; i < slave_begin.size(); ++i)
      slave_begin[i] +=
          (i + 1) % static_cast<std::size_t>(d) == 0 ? random.uniform(0.0, 0.2) : random.uniform(-0.05, 0.05);
    std::vector<int32_t> status(Surface::slaves), flags(Surface::slaves);
    const auto iterate = [&](const ents_input& in, std::vector<double>& end) {
      ents_output out = motion.output(end, status);
      out.wanted |= ENTS_FLAGS;
      out.flags = flags.data(), out.flags_stride = 1;
      std::fill(motion.segment.begin(), motion.segment.end(), -1);
      ASSERT_EQ(motion.iterate(in, out, nullptr), ENTS_OK) << motion.report.message;
    };
    // at the begin, then at the end
    std::vector<double> between = motion.states(), by_hand = between, at_once = between, without = between;
    std::swap(surface.slave, slave_begin);
    iterate(motion.rest(), between);
    std::swap(surface.slave, slave_begin);
    motion.begin = between;
    iterate(motion.rest(), by_hand);
    // at once
    motion.begin = fresh;
    ents_input in = motion.rest();
    in.slave_begin = slave_begin.data();
    iterate(in, at_once);
    for (const int32_t flag : flags) EXPECT_FALSE(flag & ENTS_FLAG_NO_BEGIN);
    iterate(motion.rest(), without);
    for (std::size_t k = 0; k < Surface::slaves; ++k) {
      const auto size = static_cast<std::size_t>(motion.size);
      const double* end = &at_once[k * size];
      if (motion.segment[k] < 0 || end[1] < 2.0) continue;
      // what began on another segment goes on from there by hand, and is looked at from here at once
      if (between[k * size + size - 1] != end[size - 1]) continue;
      if (between[k * size + 1] == 1.0) ++touched;
      for (std::size_t i = 3; i + 1 < size; ++i)
        EXPECT_NEAR(end[i], by_hand[k * size + i], 1e-11) << trial << " " << k;
      EXPECT_EQ(end[1], by_hand[k * size + 1]);
      unknown += (flags[k] & ENTS_FLAG_NO_BEGIN) != 0;
    }
  }
  EXPECT_GT(touched, samples(40) * 5);
  EXPECT_GT(unknown, touched);
}

TEST(IterateFriction, RefusesASlaveBeginThatIsNoNumber) {
  mechanics::Random random(67);
  Surface surface(random, 2);
  const Model model(text_of(2, coulomb));
  Motion motion(model, surface, random);
  std::vector<double> end = motion.states(), slave_begin = surface.slave;
  std::vector<int32_t> status(Surface::slaves);
  ents_input in = motion.rest();
  in.slave_begin = slave_begin.data();
  for (double& x : slave_begin) x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(motion.iterate(in, motion.output(end, status), nullptr), ENTS_NON_FINITE);
  EXPECT_NE(std::strstr(motion.report.message, "slave_begin"), nullptr) << motion.report.message;
}

// The positions of now would move the anchor to another place: those of the begin count.
TEST(IterateFriction, StatesMoveInThePositionsOfTheBegin) {
  mechanics::Random random(59);
  int others = 0;
  for (int trial = 0; trial < samples(20); ++trial) {
    Surface surface(random, 2);
    const Model model(text_of(2, coulomb));
    Motion motion(model, surface, random);
    std::vector<double> end = motion.states(), then = end, now = end;
    std::vector<int32_t> status(Surface::slaves);
    ASSERT_EQ(motion.iterate(motion.rest(), motion.output(end, status), nullptr), ENTS_OK)
        << motion.report.message;
    motion.begin = end;
    motion.move(random);
    motion.move(random);
    const std::vector<int64_t> segment = motion.segment;
    const std::vector<double> xi = motion.xi;
    ents_input in = motion.rest();
    ASSERT_EQ(motion.iterate(in, motion.output(then, status), nullptr), ENTS_OK) << motion.report.message;
    motion.segment = segment, motion.xi = xi;
    in.positions_begin = surface.positions.data();
    ASSERT_EQ(motion.iterate(in, motion.output(now, status), nullptr), ENTS_OK) << motion.report.message;
    others += then != now;
  }
  EXPECT_GT(others, samples(20) / 2);
}

TEST(IterateFriction, RefusesWhatItCannotMove) {
  mechanics::Random random(61);
  Surface surface(random, 2);
  const Model model(text_of(2, coulomb)), rigid(text_of(2, coulomb, R"(, "master": "rigid")"));
  Motion motion(model, surface, random);
  std::vector<double> end = motion.states();
  std::vector<int32_t> status(Surface::slaves, -9);
  ents_input in = motion.rest();
  const ents_output out = motion.output(end, status);
  const auto refused = [&](int32_t expected, const char* words) {
    std::fill(motion.segment.begin(), motion.segment.end(), -1);
    EXPECT_EQ(motion.iterate(in, out, nullptr), expected) << words;
    EXPECT_NE(std::strstr(motion.report.message, words), nullptr) << motion.report.message;
  };
  in.positions_begin = nullptr;
  refused(ENTS_NULL_ARGUMENT, "input.positions_begin is null");
  EXPECT_EQ(motion.segment[0], -1) << "refused before anything is written";
  in = motion.rest();
  ASSERT_EQ(motion.iterate(in, out, nullptr), ENTS_OK) << motion.report.message;
  std::size_t closed = 0; // a slave in contact, and its state
  while (!(end[closed * static_cast<std::size_t>(motion.size) + 1] > 1.0)) ++closed;
  motion.begin = end;
  double& segment = motion.begin[(closed + 1) * static_cast<std::size_t>(motion.size) - 1];
  segment = segment == 1.0 ? 2.0 : segment - 1.0;
  const std::string name = "of element " + std::to_string(closed);
  std::vector<double> nowhere(surface.positions.size(), std::numeric_limits<double>::quiet_NaN());
  in.positions_begin = nowhere.data();
  refused(ENTS_NON_FINITE, "input.positions_begin");
  in = motion.rest();
  std::fill(motion.segment.begin(), motion.segment.end(), -1);
  EXPECT_EQ(motion.iterate(in, out, nullptr), ENTS_OK) << motion.report.message;
  segment = 5.0; // of four
  refused(ENTS_BAD_STATE,
          ("input.state_begin " + name + " was made on segment 4; the mesh has segments 0 .. 3").c_str());
  segment = 0.5; // no number of a segment
  refused(ENTS_BAD_STATE, ("input.state_begin " + name).c_str());
  segment = std::numeric_limits<double>::infinity();
  refused(ENTS_BAD_STATE, ("input.state_begin " + name).c_str());
  // A rigid master needs no positions: what it is has not changed.
  Motion still(rigid, surface, random);
  ents_input without = still.rest();
  without.positions_begin = nullptr;
  EXPECT_EQ(still.iterate(without, still.output(end, status), nullptr), ENTS_OK) << still.report.message;
}

// The anchor has no place on the new segment: a status of the element, as ents_state_transfer has it.
TEST(IterateFriction, AStateThatCannotMoveIsTheElementsStatus) {
  mechanics::Random random(67);
  Surface surface(random, 2);
  const Model model(text_of(2, coulomb));
  Motion motion(model, surface, random);
  std::vector<double> end = motion.states();
  std::vector<int32_t> status(Surface::slaves, -9);
  ASSERT_EQ(motion.iterate(motion.rest(), motion.output(end, status), nullptr), ENTS_OK)
      << motion.report.message;
  motion.begin = end;
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < Surface::slaves && changed.size() < 2; ++i) {
    double* state = &motion.begin[i * static_cast<std::size_t>(motion.size)];
    if (!(state[1] > 1.0)) continue;
    state[motion.size - 1] = state[motion.size - 1] == 1.0 ? 2.0 : 1.0;
    changed.push_back(i);
  }
  ASSERT_EQ(changed.size(), 2u);
  std::vector<double> folded(surface.positions.size(), 1.0); // all nodes in one place: no normal
  for (const bool assembled : {false, true}) {
    ents_input in = motion.rest();
    in.positions_begin = folded.data();
    status.assign(Surface::slaves, -9);
    std::fill(motion.segment.begin(), motion.segment.end(), -1);
    motion.system.clear();
    const ents_system system = motion.system.made(surface.mesh, false);
    EXPECT_EQ(motion.iterate(in, motion.output(end, status), assembled ? &system : nullptr),
              ENTS_DEGENERATE_SEGMENT);
    EXPECT_EQ(motion.report.element, static_cast<int64_t>(changed[0]));
    EXPECT_NE(std::strstr(motion.report.message, "its state cannot move from segment"), nullptr)
        << motion.report.message;
    for (std::size_t i = 0; i < Surface::slaves; ++i)
      EXPECT_EQ(status[i], i == changed[0] || i == changed[1] ? ENTS_DEGENERATE_SEGMENT : ENTS_OK) << i;
  }
}

} // namespace
} // namespace iterate_friction_test
