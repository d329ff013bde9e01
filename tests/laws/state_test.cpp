// The life of a state: begin untouched, cut and uncut increments, augmentation, transfer.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>

#include "law_elements.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace laws::state_test {
namespace {

// A slave node over a flat line2 from (0, 0) to (length, 0), pressed in by 0.01.
struct Slide {
  explicit Slide(const std::string& normal = R"({"type": "penalty", "stiffness": 100})",
                 const std::string& height = "null")
      : model(R"({"segment": "line2", "height": )" + height + R"(, "contact": {"normal": )" + normal +
              R"(, "friction": {"type": "coulomb", "coefficient": 0.5, "stiffness": 50}}})") {
    elements.layout = layout_of(model.handle());
    elements.at.count = 1;
    elements.at.area = {1.0};
    elements.state.resize(static_cast<std::size_t>(elements.layout.state_size));
    elements.multiplier.resize(static_cast<std::size_t>(elements.layout.multipliers));
    ents_state_init(model.handle(), 1, elements.state.data(), elements.layout.state_size, nullptr);
  }
  // surface coordinate: x
  void segment(double from, double to) {
    elements.at.master = {from, 0.0, to, 0.0};
    elements.at.surface_coordinates = {from, to};
  }
  void evaluate_at(double x, double y = -0.01) {
    elements.at.slave = {x, y};
    evaluate(model, elements, ENTS_FLAGS | ENTS_RESIDUAL | ENTS_TRACTION | ENTS_STATE, results);
    ASSERT_EQ(results.status[0], ENTS_OK);
  }
  void commit() { elements.state = results.state; }

  mechanics::Model model;
  LawElements elements;
  LawResults results;
};

TEST(State, SticksThenSlipsAtTheConeAndComesBack) {
  Slide s;
  s.segment(0.0, 1.0);
  s.evaluate_at(0.3);
  EXPECT_EQ(s.results.traction[0], 0.0) << "no anchor before the first contact";
  s.commit();
  s.evaluate_at(0.305);
  EXPECT_NEAR(s.results.traction[0], 50 * 0.005, 1e-13) << "elastic: stiffness times slip";
  s.evaluate_at(0.4);
  EXPECT_NEAR(s.results.traction[0], 0.5 * 1.0, 1e-14) << "mu p";
  s.commit();
  s.evaluate_at(0.4 - 0.01);
  // the anchor lies inside the cone by 4e-15 of xi, half as much of x, and by 1e-13 of the elastic slip
  constexpr double inside = 50 * 0.5 * 4e-15 + 0.5 * 1e-13, rounding = 2e-14;
  EXPECT_NEAR(s.results.traction[0], 0.0, inside + rounding)
      << "unloaded by the elastic slip mu p / stiffness";
}

// An increment begins at the limit where the last one slipped; nothing but rounding has moved since, by other
// starts of the projection. With this stiffness a rounding of xi is 1e-10 of the elastic slip. Penalty with
// normal projection: many at once; others: one by one.
TEST(State, WhatSlippedSticksUntilItMoves) {
  const json friction = {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 1e5}};
  json sheared = friction; // which stays where a pressure that is augmented moves the limit
  sheared["shear_limit"] = 0.01;
  const Method laws[] = {
      {"penalty", coulomb.normal, friction},
      {"exponential", {{"type", "exponential"}, {"pressure", 0.5}, {"clearance", 0.015}}, friction},
      {"augmented", {{"type", "augmented"}, {"stiffness", 100.0}}, sheared}};
  Random random(41);
  std::int64_t slipped = 0, again = 0;
  for (const Method& law : laws)
    for (const Basis& basis : mechanics::all_bases())
      for (const char* projection : mechanics::projections) {
        const mechanics::Scene scene = draw_scene(random, basis, "sine", projection);
        const mechanics::Model model = model_of(scene, law);
        LawElements e = draw(random, scene, model, mechanics::samples(1000), 0.05);
        LawResults before, after;
        evaluate(model, e, ENTS_FLAGS | ENTS_STATE, before);
        e.state = before.state;
        const std::size_t size = static_cast<std::size_t>(e.layout.state_size),
                          t = static_cast<std::size_t>(e.layout.parameters);
        for (std::size_t i = 0; i < before.status.size(); ++i)
          for (std::size_t a = 0; a < t; ++a) e.state[i * size + 3 + a] += random.uniform(-1e-3, 1e-3);
        evaluate(model, e, ENTS_FLAGS, after);
        std::int64_t again_here = 0;
        for (std::size_t i = 0; i < before.status.size(); ++i) {
          if (before.status[i] != ENTS_OK || after.status[i] != ENTS_OK ||
              !(before.flags[i] & ENTS_FLAG_SLIP))
            continue;
          if (e.layout.augmentable && !(before.flags[i] & ENTS_FLAG_SHEAR_LIMIT)) continue;
          ++slipped;
          again_here += (after.flags[i] & ENTS_FLAG_SLIP) &&
                        (!e.layout.augmentable || (after.flags[i] & ENTS_FLAG_SHEAR_LIMIT));
        }
        EXPECT_EQ(again_here, 0) << law.name << ", " << basis.name << ", " << projection;
        again += again_here;
      }
  EXPECT_GT(slipped, mechanics::samples(18000));
  std::cout << slipped << " slipping elements, " << again << " slip again\n";
}

TEST(State, TrialsLeaveNoTrace) {
  Slide once, often;
  for (Slide* s : {&once, &often}) {
    s->segment(0.0, 1.0);
    s->evaluate_at(0.3);
    s->commit();
  }
  for (int i = 0; i < 50; ++i) often.evaluate_at(0.2 + 0.01 * i);
  for (Slide* s : {&once, &often}) s->evaluate_at(0.32);
  EXPECT_EQ(once.results.state, often.results.state);
  EXPECT_EQ(once.results.residual, often.results.residual);
}

// One long segment against a row of ten: the state moves along with ents_state_transfer.
class RowOfSegments : public testing::TestWithParam<const char*> {};
TEST_P(RowOfSegments, SlidesLikeOneLongSegment) {
  const std::string penalty = R"({"type": "penalty", "stiffness": 100})";
  Slide one(penalty, GetParam()), row(penalty, GetParam());
  one.segment(0.0, 10.0);
  double x = 0.45;
  int at = 0;
  row.segment(0.0, 1.0);
  double worst = 0.0;
  for (int increment = 0; increment < 180; ++increment, x += increment % 7 == 3 ? -0.031 : 0.061) {
    if (const int now = static_cast<int>(std::floor(x)); now != at) {
      const std::vector<double> before = row.elements.at.master,
                                coordinates = row.elements.at.surface_coordinates;
      row.segment(now, now + 1);
      std::vector<double> moved(row.elements.state.size());
      ASSERT_EQ(ents_state_transfer(row.model.handle(), before.data(), coordinates.data(),
                                    row.elements.at.master.data(), row.elements.at.surface_coordinates.data(),
                                    row.elements.state.data(), moved.data(), nullptr),
                ENTS_OK);
      row.elements.state = moved;
      at = now;
    }
    one.evaluate_at(x);
    row.evaluate_at(x);
    for (std::size_t k = 0; k < 2; ++k) // the slave's; nodes share differently
      test::raise(worst, std::fabs(one.results.residual[k] - row.results.residual[k]));
    EXPECT_EQ(one.results.flags, row.results.flags) << "increment " << increment;
    one.commit();
    row.commit();
  }
  EXPECT_GT(at, 5);
  EXPECT_LE(worst, 1e-10);
  std::cout << "worst difference of the forces: " << worst << "\n";
}
INSTANTIATE_TEST_SUITE_P(Height, RowOfSegments,
                         testing::Values("null",
                                         R"({"type": "sine", "amplitude": 0.005, "wave_vector": [0.7]})"),
                         [](const auto& parameter) {
                           return parameter.index == 0 ? "plain" : "sine";
                         }); // of x

// Segments of a circle with the angle as surface coordinate: where it jumps from 2 pi to 0, the anchor goes
// on as it does elsewhere.
TEST(State, MovesOverASeamOfTheSurfaceCoordinates) {
  Slide s;
  const double turn = 2.0 * std::acos(-1.0);
  const auto corner = [&](int i) { return std::array{std::cos(turn * i / 16), std::sin(turn * i / 16)}; };
  const auto segment = [&](int i) { // clockwise seen, its normal points outwards
    const auto a = corner(i + 1), b = corner(i);
    return std::array{a[0], a[1], b[0], b[1]};
  };
  std::vector<double> state(s.elements.state.size());
  ents_state_init(s.model.handle(), 1, state.data(), s.elements.layout.state_size, nullptr);
  state[1] = 2.0;
  state[2 + 1] = -1.02; // xi, and the anchor still on the old segment
  state[2 + 2] = -0.98;
  std::vector<double> first;
  for (const double seam : {0.0, 1.0}) {
    const auto before = segment(15), after = segment(0);
    const double old_s[2] = {turn, turn * 15 / 16},
                 new_s[2] = {turn / 16 + (1 - seam) * turn, (1 - seam) * turn};
    std::vector<double> moved(state.size());
    ASSERT_EQ(ents_state_transfer(s.model.handle(), before.data(), old_s, after.data(), new_s, state.data(),
                                  moved.data(), nullptr),
              ENTS_OK);
    EXPECT_NEAR(moved[2 + 1], 0.98, 0.02) << "seam " << seam;
    EXPECT_NEAR(moved[2 + 2], 1.02, 0.02) << "seam " << seam;
    if (first.empty()) first = moved;
    for (const std::size_t i : {3u, 4u}) EXPECT_NEAR(moved[i], first[i], 1e-12) << "seam " << seam;
  }
}

// A smoothed cylinder, angle and height as coordinates: over the seam as from any other segment to the next,
// whatever coordinates of a full turn more would lead to beyond the border.
TEST(State, MovesOverTheSeamOfASmoothedCylinder) {
  for (const int around : {4, 5, 8, 16}) {
    const mechanics::Model model(
        R"({"segment": "bspline16", "master": "rigid",
            "height": {"type": "thread", "pitch": 0.3, "flank_angles": [30, 30], "crest": 0.04, "root": 0.07},
            "contact": {"normal": {"type": "penalty", "stiffness": 100},
                        "friction": {"type": "coulomb", "coefficient": 0.5, "stiffness": 50}}})");
    const ents_layout layout = layout_of(model.handle());
    const double step = 2.0 * std::acos(-1.0) / around;
    const auto segment = [&](int i, std::vector<double>& nodes, std::vector<double>& s) {
      nodes.clear(), s.clear();
      for (int b = 0; b < 4; ++b)
        for (int a = 0; a < 4; ++a) {
          const int column = i + a - 1, place = (column + around) % around;
          nodes.insert(nodes.end(), {std::cos(step * place), std::sin(step * place), 0.5 * b});
          s.insert(s.end(), {step * column, 0.5 * b});
        }
    };
    std::vector<double> state(static_cast<std::size_t>(layout.state_size)), moved(state.size()), old_nodes,
        old_s, new_nodes, new_s;
    ents_state_init(model.handle(), 1, state.data(), layout.state_size, nullptr);
    for (const double direction : {1.0, -1.0}) {
      state[1] = 3.0;
      state[3] = direction * 1.01, state[4] = 0.2, state[5] = direction * 0.6, state[6] = 0.15;
      for (const int from : {1, 0, around - 1, around - 2}) {
        const int to = (from + static_cast<int>(direction) + around) % around;
        segment(from, old_nodes, old_s), segment(to, new_nodes, new_s);
        ASSERT_EQ(ents_state_transfer(model.handle(), old_nodes.data(), old_s.data(), new_nodes.data(),
                                      new_s.data(), state.data(), moved.data(), nullptr),
                  ENTS_OK);
        EXPECT_NEAR(moved[3], direction * -0.99, 1e-9) << around << " from " << from;
        EXPECT_NEAR(moved[5], direction * -1.4, 1e-9) << around << " from " << from;
        EXPECT_NEAR(moved[4], 0.2, 1e-9) << around << " from " << from;
        EXPECT_NEAR(moved[6], 0.15, 1e-9) << around << " from " << from;
      }
    }
  }
}

// Grooves along one direction: the other coordinate is 0 everywhere, so coordinates alone do not say where a
// point is.
TEST(State, MovesWhereCoordinatesAreConstantAlongADirection) {
  for (const char* friction :
       {"", R"(, "friction": {"type": "coulomb", "coefficient": 0.5, "stiffness": 50})"}) {
    const mechanics::Model model(
        R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.01, "wave_vector": [0.5, 0]},
      "contact": {"normal": {"type": "penalty", "stiffness": 100})" +
        std::string(friction) + "}}");
    const ents_layout layout = layout_of(model.handle());
    std::vector<double> state(static_cast<std::size_t>(layout.state_size)), moved(state.size());
    ents_state_init(model.handle(), 1, state.data(), layout.state_size, nullptr);
    state[1] = 2.0;
    for (std::size_t k = 3; k < 3 + (layout.friction ? 4 : 2); k += 2) state[k] = 1.02, state[k + 1] = 0.5;
    const double before[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0},
                 after[12] = {1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0};
    const double old_s[8] = {0, 0, 1, 0, 1, 0, 0, 0}, new_s[8] = {1, 0, 2, 0, 2, 0, 1, 0};
    ASSERT_EQ(
        ents_state_transfer(model.handle(), before, old_s, after, new_s, state.data(), moved.data(), nullptr),
        ENTS_OK)
        << friction;
    for (std::size_t k = 3; k < 3 + (layout.friction ? 4 : 2); k += 2) {
      EXPECT_NEAR(moved[k], -0.98, 1e-9) << friction;
      EXPECT_NEAR(moved[k + 1], 0.5, 1e-9) << friction;
    }
  }
}

// A texture with the same coordinates on every segment: they say nothing of where a point is.
TEST(State, MovesWhereCoordinatesRepeat) {
  for (const int d : {2, 3}) {
    const std::string height = R"("height": {"type": "sine", "amplitude": 0.001, "wave_vector": )" +
                               std::string(d == 2 ? "[1]" : "[1, 0]") + "}";
    const mechanics::Model model(R"({"segment": ")" + std::string(d == 2 ? "line2" : "quad4") + "\", " +
                                 height +
                                 R"(, "contact": {"normal": {"type": "penalty", "stiffness": 100},
                                     "friction": {"type": "coulomb", "coefficient": 0.5, "stiffness": 50}}})");
    const ents_layout layout = layout_of(model.handle());
    std::vector<double> state(static_cast<std::size_t>(layout.state_size)), moved(state.size());
    ents_state_init(model.handle(), 1, state.data(), layout.state_size, nullptr);
    const auto t = static_cast<std::size_t>(d - 1);
    state[1] = 2.0, state[3] = 1.002, state[3 + t] = 0.98; // just beyond the end, the anchor before it
    const double line[2][4] = {{0, 0, 1, 0}, {1, 0, 2, 0}}, line_s[2] = {0, 1};
    const double quad[2][12] = {{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0}},
                 quad_s[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    const double* s = d == 2 ? line_s : quad_s;
    ASSERT_EQ(ents_state_transfer(model.handle(), d == 2 ? line[0] : quad[0], s, d == 2 ? line[1] : quad[1],
                                  s, state.data(), moved.data(), nullptr),
              ENTS_OK);
    EXPECT_NEAR(moved[3], -0.998, 1e-4) << d; // heights repeat with the texture, not beyond the border
    EXPECT_NEAR(moved[3 + t], -1.02, 1e-3) << d;
  }
}

// The anchor just beyond the new segment's edge, on a steep texture: not some other place of the segment that
// is closest to it.
TEST(State, MovesToTheClosestPlaceOfASteepTexture) {
  for (const double amplitude : {0.05, 0.2}) { // slopes 0.6 and 2.5
    const mechanics::Model model(
        R"({"segment": "line2", "height": {"type": "sine", "amplitude": )" + std::to_string(amplitude) +
        R"(, "wave_vector": [1]}, "contact": {"normal": {"type": "penalty", "stiffness": 100},
                                     "friction": {"type": "rough", "stiffness": 10}}})");
    const ents_layout layout = layout_of(model.handle());
    std::vector<double> state(static_cast<std::size_t>(layout.state_size)), moved(state.size());
    const double before[4] = {0, 0, 1, 0}, after[4] = {1, 0, 2, 0};
    for (const double lag : {0.02, 0.06, 0.1}) {
      ents_state_init(model.handle(), 1, state.data(), layout.state_size, nullptr);
      state[1] = 2.0, state[3] = state[4] = 1.0 - lag;
      ASSERT_EQ(ents_state_transfer(model.handle(), before, nullptr, after, nullptr, state.data(),
                                    moved.data(), nullptr),
                ENTS_OK);
      EXPECT_NEAR(moved[4], -1.0 - lag, 1e-9) << amplitude << ", " << lag;
    }
  }
}

// A hundred segments on, where the place that it comes from is not found: an open slave has no history there,
// and one in contact, whose anchor would be lost, asks for a smaller step.
TEST(State, OfAnOpenSlaveMovesAnywhere) {
  const mechanics::Model model(
      R"({"segment": "bspline4", "contact": {"normal": {"type": "penalty", "stiffness": 100},
                                             "friction": {"type": "rough", "stiffness": 10}}})");
  const ents_layout layout = layout_of(model.handle());
  std::vector<double> state(static_cast<std::size_t>(layout.state_size)), moved(state.size());
  const double before[8] = {-1, 0, 0, 0.3, 1, 0.3, 2, 0}, after[8] = {99, 0, 100, 0.3, 101, 0.3, 102, 0};
  for (const double history : {1.0, 2.0, 3.0}) {
    ents_state_init(model.handle(), 1, state.data(), layout.state_size, nullptr);
    state[1] = history, state[3] = state[4] = 0.3;
    const std::int32_t status = ents_state_transfer(model.handle(), before, nullptr, after, nullptr,
                                                    state.data(), moved.data(), nullptr);
    EXPECT_EQ(status, history > 1 ? ENTS_NO_PROJECTION : ENTS_OK) << history;
    if (status != ENTS_OK) continue;
    EXPECT_EQ(moved[1], 0.0) << "where it was is not known from here";
    EXPECT_LE(std::abs(moved[3]), 1.0);
  }
}

// A multiplier may pull for an iteration while the pair is still counted as closed: no friction then, and
// nothing undefined.
TEST(State, AMultiplierThatPullsHasNoFriction) {
  Slide s(R"({"type": "multiplier", "stiffness": 100})");
  s.segment(0.0, 1.0);
  s.elements.multiplier = {1.0, 0.0};
  s.evaluate_at(0.3);
  s.commit();
  for (const double x : {0.3, 0.301}) {
    s.elements.multiplier = {-0.5, 0.0};
    s.evaluate_at(x, -0.1);
    EXPECT_TRUE(s.results.flags[0] & ENTS_FLAG_CONTACT) << x;
    for (const double t : s.results.traction) EXPECT_EQ(t, 0.0) << x;
    for (const double r : s.results.residual) EXPECT_TRUE(std::isfinite(r)) << x;
  }
}

// Heights that wear: the worn model goes on with the state of the old one, anchor and slip included.
TEST(State, GoesOnWithAnotherHeight) {
  const std::string penalty = R"({"type": "penalty", "stiffness": 100})";
  Slide fresh(penalty, R"({"type": "constant", "value": 0.002})"),
      worn(penalty, R"({"type": "constant", "value": 0.001})");
  for (Slide* s : {&fresh, &worn}) s->segment(0.0, 1.0);
  fresh.evaluate_at(0.3);
  fresh.commit();
  fresh.evaluate_at(0.303);
  EXPECT_NEAR(fresh.results.traction[0], 50 * 0.003, 1e-13);
  worn.elements.state = fresh.elements.state;
  worn.evaluate_at(0.303);
  EXPECT_NEAR(worn.results.traction[0], 50 * 0.003, 1e-13);
  EXPECT_NEAR(fresh.results.residual[1] - worn.results.residual[1], -100 * 0.001, 1e-13);
}

// Uzawa: with the slave held at a penetration, multipliers grow by stiffness times gap; the begin of the
// increment stays.
TEST(State, AugmentationMovesTheMultipliersOnly) {
  Slide s(R"({"type": "augmented", "stiffness": 100})");
  s.segment(0.0, 1.0);
  s.evaluate_at(0.3);
  s.commit();
  s.evaluate_at(0.302);
  const std::vector<double> begin = s.elements.state;
  const std::size_t size = begin.size() - 1; // without the number of the segment
  ASSERT_EQ(ents_state_augment(s.model.handle(), 1, s.elements.state.data(), s.elements.layout.state_size,
                               s.results.state.data(), s.elements.layout.state_size, nullptr),
            ENTS_OK);
  EXPECT_NEAR(s.elements.state[size - 2], begin[size - 2] + 1.0, 1e-12);
  for (std::size_t i = 0; i + 2 < size; ++i) EXPECT_EQ(s.elements.state[i], begin[i]) << i;
}

} // namespace
} // namespace laws::state_test
