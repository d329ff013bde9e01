// SPDX-License-Identifier: BSD-3-Clause
// A rigid master with a reference node in a UEL: rotations at the reference node, as Abaqus has them, and
// turns that are displacements of a node, for every host.
#include <cmath>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "abaqus_services.hpp"
#include "plain_model.hpp"
#include "uel_host.hpp"

namespace adapters::body_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Values = std::vector<double>;

Matrix3d turn(const Vector3d& spin) {
  return spin.norm() == 0 ? Matrix3d::Identity()
                          : Eigen::AngleAxisd(spin.norm(), spin.normalized()).toRotationMatrix();
}

Vector3d vector_of(const Matrix3d& rotation) {
  const Eigen::AngleAxisd axis(rotation);
  return axis.angle() * axis.axis();
}

const char* const model_text = R"({"segment": "quad4", "master": "rigid",
  "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6, 0.35]},
  "contact": {"normal": {"type": "penalty", "stiffness": 400},
              "friction": {"type": "coulomb", "coefficient": 0.25, "stiffness": 200}}})";
const char* const plane_text = R"({"segment": "line2", "master": "rigid",
  "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6]},
  "contact": {"normal": {"type": "penalty", "stiffness": 400}}})";
const char* const body_text = "body -1 -1 0.1\nbody 1 -1 0\nbody 1.1 1 0\nbody -1 1 0\n";

/// An element in space in the middle of an increment.
struct Motion {
  bool turn_node = false;
  int slave_nodes = 1;                     ///< 4: the point in the middle of a face
  Matrix3d begin = turn({0.5, -1.2, 0.7}); ///< of the increment
  Vector3d turned{0.1, 0.2, -0.4};         ///< then
  Vector3d spin{0.3, -0.2, 0.4};           ///< since
  Vector3d reference{2, 1, -1}, moved{0.3, -0.1, 0.2}, in_body{0.2, -0.1, -0.02};

  int state_size() const {
    static const PlainModel plain(std::string("ents_811.json"));
    return plain.layout().state_size;
  }
  Matrix3d rotation() const { return turn(spin) * begin; }

  UelCall call() const {
    const int nodes = slave_nodes + (turn_node ? 2 : 1), state = state_size();
    UelCall c(nodes, 3, state + (turn_node ? 12 : 9), turn_node ? 0 : 3);
    c.props = {811, 0.7};
    if (slave_nodes > 1) c.props = {811, 0.7, 8, 4, 0.25, 0.25, 0.25, 0.25};
    const Vector3d slave = reference + moved + rotation() * in_body;
    for (int k = 0; k < slave_nodes; ++k) {
      const double a = slave_nodes == 1   ? 0
                       : k == 0 || k == 3 ? -0.2
                                          : 0.2,
                   b = slave_nodes == 1 ? 0
                       : k < 2          ? -0.2
                                        : 0.2;
      for (const double x : {slave[0] + a, slave[1] + b, slave[2]}) c.coords.push_back(x - 0.05);
    }
    c.coords.insert(c.coords.end(), reference.data(), reference.data() + 3);
    if (turn_node) c.coords.insert(c.coords.end(), {7, 8, 9}); // it may be anywhere
    c.u.assign(static_cast<std::size_t>(3 * slave_nodes), 0.05);
    c.u.insert(c.u.end(), moved.data(), moved.data() + 3);
    for (int i = 0; i < 3; ++i)
      c.u.push_back(turn_node ? turned[i] + spin[i] : 1e3 + i); // UR is not looked at
    c.du.assign(static_cast<std::size_t>(c.ndofel), 0.0);       // only turns belong to this increment
    for (std::size_t i = 0; i < 3; ++i)
      c.du[static_cast<std::size_t>(c.ndofel) - 3 + i] = spin[static_cast<Eigen::Index>(i)];
    const auto at = static_cast<std::size_t>(state);
    for (std::size_t i = 0; i < 9; ++i)
      c.svars[at + i] = begin(static_cast<int>(i / 3), static_cast<int>(i % 3));
    for (std::size_t i = 0; i < 3 && turn_node; ++i)
      c.svars[at + 9 + i] = turned[static_cast<Eigen::Index>(i)];
    return c;
  }
};

class RigidBodyElement : public testing::Test {
protected:
  RigidBodyElement() {
    write("ents_811.json", model_text);
    write("ents_811.txt", body_text);
    write("ents_812.json", plane_text);
    write("ents_812.txt", "body -1 0.1\nbody 1 0\n");
    abaqus_messages();
  }
};

TEST_F(RigidBodyElement, HasTheForcesAndTheMomentOfThePlainInterface) {
  const PlainModel plain(std::string("ents_811.json"));
  for (const bool turn_node : {false, true}) {
    Motion motion;
    motion.turn_node = turn_node;
    UelCall c = motion.call();
    c();
    ASSERT_TRUE(abaqus_messages().empty());
    const Values master{-1, -1, 0.1, 1, -1, 0, 1.1, 1, 0, -1, 1, 0};
    double residual[3], tangent[9], of_body[9], matrix[81], area = 0.7;
    Values begin(static_cast<std::size_t>(motion.state_size())), fresh = begin;
    ents_state_init(plain.get(), 1, fresh.data(), motion.state_size(), nullptr);
    const Vector3d before = motion.begin.transpose() * motion.rotation() * motion.in_body;
    auto in = ents_struct<ents_input>();
    in.slave = before.data(), in.master = master.data(), in.area = &area, in.state_begin = fresh.data();
    auto first = ents_struct<ents_output>();
    first.wanted = ENTS_STATE, first.state_end = begin.data();
    ASSERT_EQ(ents_evaluate(plain.get(), 0, 1, &in, &first, nullptr), ENTS_OK);
    in.slave = motion.in_body.data(), in.state_begin = begin.data();
    auto out = ents_struct<ents_output>();
    out.wanted = ENTS_RESIDUAL | ENTS_TANGENT;
    out.residual = residual, out.tangent = tangent;
    ASSERT_EQ(ents_evaluate(plain.get(), 0, 1, &in, &out, nullptr), ENTS_OK);
    auto pose = ents_struct<ents_pose>();
    ents_pose_init(3, &pose, nullptr);
    const Matrix3d q = motion.rotation();
    for (int i = 0; i < 9; ++i) pose.turn[i] = q(i / 3, i % 3);
    ASSERT_EQ(ents_pose_element(3, &pose, motion.in_body.data(), residual, tangent, of_body, matrix, nullptr),
              ENTS_OK);
    ASSERT_GT(std::hypot(residual[0], residual[1], residual[2]), 1) << "in contact";
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(c.rhs[i], -of_body[i], 1e-12);
    for (std::size_t i = 0; i < 54; ++i) EXPECT_NEAR(c.amatrx[i], matrix[i], 1e-10);
    for (std::size_t i = 54; i < 81 && !turn_node; ++i) EXPECT_NEAR(c.amatrx[i], matrix[i], 1e-10);
    EXPECT_GT(c.energy[1], 0);
  }
}

// Abaqus corrects its rotations by spins; nodes for turns are corrected by sums.
TEST_F(RigidBodyElement, StiffnessIsMinusTheSlopeOfTheRightHandSide) {
  for (const int slave_nodes : {1, 4})
    for (const bool turn_node : {false, true}) {
      Motion motion;
      motion.turn_node = turn_node, motion.slave_nodes = slave_nodes;
      UelCall c = motion.call();
      c();
      const auto n = static_cast<std::size_t>(c.ndofel);
      double largest = 0;
      for (std::size_t i = 0; i < n * n; ++i) largest = std::max(largest, std::abs(c.amatrx[i]));
      ASSERT_GT(largest, 10) << "in contact";
      const double step = 1e-6;
      for (std::size_t column = 0; column < n; ++column) {
        UelCall ends[2] = {motion.call(), motion.call()};
        for (int side = 0; side < 2; ++side) {
          const double change = side == 0 ? -step : step;
          ends[side].u[column] += change;
          ends[side].du[column] += change;
          if (column + 3 >= n && !turn_node) {
            Vector3d small = Vector3d::Zero();
            small[static_cast<Eigen::Index>(column + 3 - n)] = change;
            const Vector3d spin = vector_of(turn(small) * turn(motion.spin));
            for (std::size_t i = 0; i < 3; ++i) ends[side].du[n - 3 + i] = spin[static_cast<Eigen::Index>(i)];
          }
          ends[side]();
        }
        for (std::size_t row = 0; row < n; ++row)
          EXPECT_NEAR(c.amatrx[row + column * n], -(ends[1].rhs[row] - ends[0].rhs[row]) / (2 * step),
                      1e-7 * largest)
              << slave_nodes << turn_node << ": " << row << ", " << column;
      }
      EXPECT_TRUE(abaqus_messages().empty());
    }
}

// In the plane: dofs 1, 2, 6, or the first displacement of a node; no history but the model's.
TEST_F(RigidBodyElement, InThePlaneHasOneTurn) {
  const PlainModel plain(std::string("ents_812.json"));
  const double angle = 2.5;
  const auto call = [&](bool turn_node, int column, double change) {
    UelCall c(turn_node ? 3 : 2, 2, plain.layout().state_size + 1, turn_node ? 0 : 1);
    c.props = {812, 0.7};
    const double x = 0.2, y = -0.02;
    c.coords = {3 + x * std::cos(angle) - y * std::sin(angle), 1 + x * std::sin(angle) + y * std::cos(angle),
                3, 1};
    c.u = {0, 0, 0, 0, angle};
    if (turn_node) c.coords.insert(c.coords.end(), {5, 5}), c.u.push_back(1e3);
    if (column >= 0) c.u[static_cast<std::size_t>(column)] += change;
    c();
    return c;
  };
  UelCall one = call(false, -1, 0), other = call(true, -1, 0);
  EXPECT_GT(std::hypot(one.rhs[0], one.rhs[1]), 1);
  EXPECT_NEAR(one.rhs[4], -(one.coords[0] - 3) * one.rhs[1] + (one.coords[1] - 1) * one.rhs[0], 1e-12);
  for (int column = 0; column < 5; ++column) {
    UelCall low = call(false, column, -1e-6), high = call(false, column, 1e-6);
    EXPECT_EQ(one.rhs[static_cast<std::size_t>(column)], other.rhs[static_cast<std::size_t>(column)]);
    for (int row = 0; row < 5; ++row) {
      const auto r = static_cast<std::size_t>(row), c = static_cast<std::size_t>(column);
      EXPECT_NEAR(one.amatrx[r + 5 * c], -(high.rhs[r] - low.rhs[r]) / 2e-6, 1e-4);
      EXPECT_EQ(one.amatrx[r + 5 * c], other.amatrx[r + 6 * c]);
    }
  }
  EXPECT_TRUE(abaqus_messages().empty());
}

// The element keeps the body's rotation from increment to increment: products of spins, for any number of
// turns.
TEST_F(RigidBodyElement, KeepsTheRotation) {
  for (const bool turn_node : {false, true}) {
    Motion motion;
    motion.turn_node = turn_node;
    motion.begin = Matrix3d::Identity(), motion.turned = Vector3d::Zero();
    Matrix3d expected = Matrix3d::Identity();
    Values svars;
    for (int increment = 0; increment < 400; ++increment) {
      motion.spin = increment % 2 == 0 ? Vector3d(0.3, -0.2, 0.4) : Vector3d(-0.1, 0.5, 0.2);
      motion.begin = expected;
      UelCall c = motion.call();
      for (std::size_t i = 0; i < c.svars.size(); ++i)
        c.svars[i] = svars.empty() ? 0 : svars[i]; // Abaqus begins with zeros
      c();
      svars.clear();
      for (std::size_t i = 0; i < c.svars.size(); ++i) svars.push_back(c.svars[i]);
      expected = motion.rotation();
      motion.turned += motion.spin;
    }
    EXPECT_TRUE(abaqus_messages().empty());
    const auto at = static_cast<std::size_t>(motion.state_size());
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_NEAR(svars[at + i], expected(static_cast<int>(i / 3), static_cast<int>(i % 3)), 1e-12);
    for (std::size_t i = 0; i < 3 && turn_node; ++i)
      EXPECT_EQ(svars[at + 9 + i], motion.turned[static_cast<Eigen::Index>(i)]);
  }
}

TEST_F(RigidBodyElement, MistakesSayWhatToWrite) {
  int number = 813;
  const auto expect = [&](const std::string& model, const std::string& table,
                          const std::function<void(UelCall&)>& edit, const std::string& text) {
    const std::string stem = "ents_" + std::to_string(++number);
    write(stem + ".json", model), write(stem + ".txt", table);
    UelCall c = Motion().call();
    c.props[0] = number;
    edit(c);
    EXPECT_THROW(c(), HostStopped) << text;
    const std::string message = only_message();
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  const auto none = [](UelCall&) {};
  std::string deformable = model_text, three = body_text;
  deformable.erase(deformable.find("\"master\""), std::string("\"master\": \"rigid\",").size());
  three.erase(three.rfind("body"));
  expect(deformable, body_text, none, "line 1: write \"master\": \"rigid\" into");
  expect(model_text, three, none, "the body has 3 lines");
  expect(model_text, "90001 0.5\nbody 0 0 0\n", none, "line 2: write body and the 3 coordinates");
  expect(model_text, "body 0 0\n", none, "line 1: write body and the 3 coordinates");
  expect(
      model_text, body_text, [](UelCall& c) { c.ndofel = 6; }, "degrees of freedom 1 to 6");
  expect(
      model_text, body_text, [](UelCall& c) { c.nsvars -= 1; }, "with a rigid body needs");
  expect(
      model_text, body_text,
      [](UelCall& c) {
        UelCall other(5, 3, 40);
        other.props = c.props;
        other.coords.assign(15, 0.0), other.u = other.coords;
        c = other;
      },
      "3 nodes, the slave node, the reference node, and one whose displacements");
  expect(
      model_text, body_text, [](UelCall& c) { c.svars[c.svars.size() - 1] = 3; }, "are no rotation");
}

} // namespace
} // namespace adapters::body_test
