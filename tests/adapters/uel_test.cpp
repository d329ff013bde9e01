// SPDX-License-Identifier: BSD-3-Clause
// Abaqus's protocol of a user element: what LFLAGS asks for is formed, all of it and nothing else.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <utility>

#include <gtest/gtest.h>

#include "uel_fixture.hpp"

namespace adapters::uel_test {
namespace {

bool zero(Guarded& array, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (array[i] != 0) return false; // NaN, too
  return true;
}
bool same(Guarded& a, Guarded& b, std::size_t count) {
  return std::memcmp(a.data(), b.data(), count * sizeof(double)) == 0;
}

TEST_F(Uel, FormsWhatIsAskedFor) {
  UelCall both = request(1);
  both();
  const auto n = static_cast<std::size_t>(both.ndofel);
  EXPECT_FALSE(zero(both.rhs, n));
  EXPECT_FALSE(zero(both.amatrx, n * n));
  EXPECT_NE(both.svars[0], 0);
  EXPECT_GT(both.energy[1], 0);

  UelCall stiffness = request(2);
  stiffness();
  EXPECT_TRUE(same(stiffness.amatrx, both.amatrx, n * n));
  EXPECT_TRUE(zero(stiffness.svars, stiffness.svars.size())) << "history belongs to request 1";

  for (const int what : {5, 6}) { // half-increment residual; mass (there is none) and residual
    UelCall residual = request(what);
    residual();
    EXPECT_TRUE(same(residual.rhs, both.rhs, n)) << what;
    EXPECT_TRUE(zero(residual.amatrx, n * n)) << what;
    EXPECT_TRUE(zero(residual.svars, residual.svars.size())) << what;
  }
  for (const int what : {3, 4, 100}) { // damping, mass, output of a perturbation: nothing
    UelCall nothing = request(what);
    nothing();
    EXPECT_TRUE(zero(nothing.rhs, n)) << what;
    EXPECT_TRUE(zero(nothing.amatrx, n * n)) << what;
    EXPECT_TRUE(zero(nothing.svars, nothing.svars.size())) << what;
  }
  EXPECT_TRUE(abaqus_messages().empty());
}

TEST_F(Uel, BothNamesAreTheSameFunction) {
  EXPECT_EQ(reinterpret_cast<void*>(uel), reinterpret_cast<void*>(uel_));
}

TEST_F(Uel, SecondRightHandSideIsTheLoadWhichIsZero) {
  UelCall c = request(1);
  c.nrhs = 2;
  c();
  for (int i = 0; i < c.ndofel; ++i) EXPECT_EQ(c.rhs[static_cast<std::size_t>(c.mlvarx + i)], 0);
}

TEST_F(Uel, StiffnessIsMinusTheSlopeOfTheRightHandSide) {
  UelCall c = request(1);
  c();
  const double step = 1e-6; // differences: step^2 times third derivatives; roundings: 1e-16 / step
  for (std::size_t column = 0; column < static_cast<std::size_t>(c.ndofel); ++column) {
    UelCall ends[2] = {request(1), request(1)};
    ends[0].u[column] -= step, ends[1].u[column] += step;
    ends[0].du[column] -= step, ends[1].du[column] += step;
    ends[0](), ends[1]();
    for (std::size_t row = 0; row < static_cast<std::size_t>(c.ndofel); ++row)
      EXPECT_NEAR(c.amatrx[row + column * static_cast<std::size_t>(c.ndofel)],
                  -(ends[1].rhs[row] - ends[0].rhs[row]) / (2 * step), 1e-6 * 400);
  }
}

TEST_F(Uel, PerturbationIsLinearAboutTheBaseState) {
  UelCall base = request(2);
  std::fill(base.du.begin(), base.du.end(), 0.0); // nothing has moved since it touched
  base();
  for (const int columns : {1, 2}) { // of a steady state: real and imaginary part
    UelCall c = request(1);
    c.lflags[3] = 1;
    c.nrhs = columns;
    const auto n = static_cast<std::size_t>(c.ndofel), column = static_cast<std::size_t>(c.mlvarx);
    c.du.assign(static_cast<std::size_t>(columns) * column, std::nan(""));
    for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k)
      for (std::size_t i = 0; i < n; ++i)
        c.du[k * column + i] = 1e-3 * static_cast<double>(i * i + 7 * k + 1);
    c();
    EXPECT_TRUE(same(c.amatrx, base.amatrx, n * n));
    EXPECT_TRUE(zero(c.svars, c.svars.size()));
    for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k)
      for (std::size_t i = 0; i < n; ++i) {
        double force = 0;
        for (std::size_t j = 0; j < n; ++j) force -= base.amatrx[i + j * n] * c.du[k * column + j];
        EXPECT_DOUBLE_EQ(c.rhs[k * column + i], force) << "column " << k;
      }
    c.rhs.check_untouched("padding of RHS", columns == 1 ? n : column + n, column - n);
  }
}

TEST_F(Uel, MooseAsksWithNumbersOfItsOwn) {
  UelHost moose(problem_.elements, UelHost::Program::moose_mesh);
  moose.begin(std::vector<double>(problem_.target.size()));
  const auto asked = [&](int what) {
    UelCall c = moose.call(0, pressed(problem_));
    c.lflags[2] = what;
    c();
    return c;
  };
  UelCall reference = request(1), both = asked(0), stiffness = asked(4), residual = asked(5);
  reference();
  const auto n = static_cast<std::size_t>(both.ndofel);
  EXPECT_TRUE(same(both.rhs, reference.rhs, n));
  EXPECT_TRUE(same(residual.rhs, reference.rhs, n));
  EXPECT_TRUE(zero(stiffness.rhs, n));
  EXPECT_TRUE(same(both.amatrx, reference.amatrx, n * n));
  EXPECT_TRUE(same(stiffness.amatrx, reference.amatrx, n * n));
  EXPECT_TRUE(zero(residual.amatrx, n * n));
  for (UelCall* c : {&both, &stiffness, &residual})
    EXPECT_TRUE(same(c->svars, reference.svars, reference.svars.size())) << c->lflags[2];
}

// MOOSE passes the displacements of the last step, Abaqus those of now: with the other's option forces are
// those of another place, and nothing else would tell.
TEST_F(Uel, AnOptionOfAnotherProgramStopsTheJob) {
  UelCall abaqus = request(1);
  abaqus.props.resize(3);
  abaqus.props[2] = 2;
  EXPECT_THROW(abaqus(), HostStopped);
  EXPECT_NE(only_message(-2).find("leave 2 out"), std::string::npos);
  for (const bool null_flags : {false, true}) {
    UelCall moose = request(0);
    moose.null_flags = null_flags;
    EXPECT_THROW(moose(), HostStopped);
    EXPECT_NE(only_message(-2).find("add 2 to property 3"), std::string::npos);
  }
}

TEST_F(Uel, LargestElementNumber) {
  UelCall c = request(1);
  c.jelem = 2147483647;
  c();
  EXPECT_TRUE(abaqus_messages().empty());
}

TEST_F(Uel, DeepPenetrationCutsTheIncrement) {
  const Problem deep = problem("line2_cuts");
  std::vector<double> u(deep.target.size());
  u[static_cast<std::size_t>(deep.elements.nodes[0][0] * 2 + 1)] = -0.4;
  UelCall c = UelHost(deep.elements, UelHost::Program::abaqus).call(0, u);
  c();
  EXPECT_GT(c.pnewdt, 0);
  EXPECT_LT(c.pnewdt, 1);
  EXPECT_TRUE(zero(c.rhs, static_cast<std::size_t>(c.ndofel)));
  EXPECT_TRUE(zero(c.svars, c.svars.size()));
  EXPECT_NE(only_message(1).find("penetration_limit"), std::string::npos);
}

TEST_F(Uel, DeepPenetrationIsToldWhereNoIncrementIsCut) {
  const Problem deep = problem("line2_cuts");
  std::vector<double> u(deep.target.size());
  u[static_cast<std::size_t>(deep.elements.nodes[0][0] * 2 + 1)] = -0.4;
  const auto call = [&](int what, bool perturbation) {
    UelCall c = UelHost(deep.elements, UelHost::Program::abaqus).call(0, u);
    c.lflags[2] = what, c.lflags[3] = perturbation;
    return c;
  };
  for (const auto& [what, perturbation] : {std::pair{2, false}, {6, false}, {1, true}, {2, true}}) {
    UelCall c = call(what, perturbation);
    EXPECT_THROW(c(), HostStopped) << what;
    EXPECT_EQ(c.pnewdt, 1e36);
    const std::string text = only_message(-2);
    EXPECT_NE(text.find("penetration_limit"), std::string::npos) << text;
    EXPECT_NE(text.find("LFLAGS(3) = " + std::to_string(what)), std::string::npos) << text;
  }
  UelCall half = call(5, false);
  half();
  EXPECT_EQ(half.pnewdt, 1e36);
  EXPECT_TRUE(zero(half.rhs, static_cast<std::size_t>(half.ndofel)));
  const std::string text = only_message(-1);
  EXPECT_NE(text.find("penetration_limit"), std::string::npos) << text;
  EXPECT_NE(text.find("half-increment"), std::string::npos) << text;
}

TEST_F(Uel, DivergedIterationCutsTheIncrement) {
  UelCall c = request(1);
  c.u[3] = std::nan("");
  c();
  EXPECT_EQ(c.pnewdt, 0.5);
  EXPECT_TRUE(zero(c.amatrx, c.amatrx.size()));
}

TEST_F(Uel, SelfcheckReportsIntoTheMessageFile) {
  std::ofstream("ents_33.json") // it slips: K is not symmetric
      << R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6, 0.35]},
    "contact": {"normal": {"type": "penalty", "stiffness": 400}, "friction": {"type": "coulomb", "coefficient": 0.02, "stiffness": 200}}})";
  UelCall first = request(1);
  first.props = {33, 0.5};
  first();
  const auto dragged = [&](std::vector<double> props) {
    UelCall call = request(1);
    call.props = std::move(props);
    for (std::size_t i = 0; i < call.svars.size(); ++i) call.svars[i] = first.svars[i];
    call.u[0] += 0.05;
    call();
    return call;
  };
  UelCall c = dragged({33, 0.5, 1});
  const auto n = static_cast<std::size_t>(c.ndofel);
  ASSERT_GT(std::abs(c.amatrx[2 * n] - c.amatrx[2]), 1.0);
  const std::string text = only_message(1);
  EXPECT_NE(text.find("element 90001"), std::string::npos) << text;
  EXPECT_NE(text.find("K is the slope of R"), std::string::npos) << text;
  double errors[3] = {1, 1, 1};
  ASSERT_EQ(std::sscanf(text.c_str() + text.find('='), "= %lf, %lf, %lf", errors, errors + 1, errors + 2), 3)
      << text;
  EXPECT_LT(errors[1], 0.02 * errors[0]); // second order: a tenth of the step leaves a hundredth
  EXPECT_LT(errors[2], 1e-8);             // and roundings over the step, 1e-16 / 1e-6 times a few
  UelCall silent = dragged({33, 0.5});
  EXPECT_TRUE(same(c.amatrx, silent.amatrx, c.amatrx.size()));
}

// A master that is the wrong way round takes what penetrates for open, and nothing else tells its user.
TEST_F(Uel, SelfcheckSaysWhyThereIsNoContact) {
  UelCall c = request(1);
  c.props = {14, 0.5, 1};
  c();
  EXPECT_NE(only_message(1).find("K is the slope of R"), std::string::npos);
  UelCall reversed = request(1);
  reversed.props = {14, 0.5, 1};
  for (int i = 0; i < 3; ++i) { // nodes 1 4 3 2
    std::swap(reversed.coords[static_cast<std::size_t>(6 + i)],
              reversed.coords[static_cast<std::size_t>(12 + i)]);
    std::swap(reversed.u[static_cast<std::size_t>(6 + i)], reversed.u[static_cast<std::size_t>(12 + i)]);
  }
  reversed();
  EXPECT_TRUE(zero(reversed.rhs, static_cast<std::size_t>(reversed.ndofel)));
  const std::string text = only_message(1);
  EXPECT_NE(text.find("open, gap "), std::string::npos) << text;
  EXPECT_NE(text.find("turn the order"), std::string::npos) << text;
  UelCall beside = request(1);
  beside.props = {14, 0.5, 1};
  beside.u[0] += 50;
  beside();
  EXPECT_NE(only_message(1).find("not ahead of this segment"), std::string::npos);
}

TEST_F(Uel, SelfcheckFindsAnApproximateTangent) {
  std::ofstream("ents_31.json")
      << R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6, 0.35]},
    "tangent": "first_variation", "contact": {"normal": {"type": "penalty", "stiffness": 400}}})";
  UelCall c = request(1);
  c.props = {31, 0.5, 1};
  c();
  EXPECT_NE(only_message(1).find("K is NOT the slope of R"), std::string::npos);
}

TEST_F(Uel, AreasAndSurfaceCoordinatesFromTheTable) {
  std::ofstream("ents_32.json")
      << R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6, 0.35]},
    "contact": {"normal": {"type": "penalty", "stiffness": 400}}})";
  std::ofstream("ents_32.txt")
      << "# element area s1 s2 ...\n\n90001, 0.25\n90002\t0.5 0 0  3 0  3 2  0 2 # stretched\n";
  UelCall in_deck = request(1), in_table = request(1);
  in_deck.props = {32, 0.25};
  in_table.props = {32, 0};
  in_deck(), in_table();
  EXPECT_TRUE(same(in_deck.rhs, in_table.rhs, static_cast<std::size_t>(in_deck.ndofel)));

  UelCall stretched = request(1), properties = request(1);
  stretched.props = {32, 0};
  stretched.jelem = 90002;
  properties.props = {32, 0.5, 0, 0, 0, 3, 0, 3, 2, 0, 2};
  stretched(), properties();
  EXPECT_TRUE(same(stretched.rhs, properties.rhs, static_cast<std::size_t>(in_deck.ndofel)));
  EXPECT_FALSE(same(stretched.rhs, in_deck.rhs, static_cast<std::size_t>(in_deck.ndofel)));
}

TEST_F(Uel, ZerosAfterThePropertiesAreNoSurfaceCoordinates) {
  const auto with = [&](std::vector<double> more) {
    UelCall c = request(1);
    c.props = {14, 0.5, 0};
    c.props.insert(c.props.end(), more.begin(), more.end());
    c();
    return c;
  };
  const std::vector<double> s = {0, 0, 3, 0, 3, 2, 0, 2};
  std::vector<double> padded = s;
  padded.resize(37);
  UelCall none = with({}), given = with(s), given_padded = with(padded);
  const auto n = static_cast<std::size_t>(none.ndofel);
  for (const std::size_t zeros : {1u, 5u, 8u, 37u}) {
    UelCall filled = with(std::vector<double>(zeros));
    EXPECT_TRUE(same(filled.rhs, none.rhs, n)) << zeros;
  }
  EXPECT_FALSE(same(given.rhs, none.rhs, n));
  EXPECT_TRUE(same(given.rhs, given_padded.rhs, n));
  EXPECT_TRUE(abaqus_messages().empty());
}

} // namespace
} // namespace adapters::uel_test
