// SPDX-License-Identifier: BSD-3-Clause
// What all hosts share: a slave that is a point of a face, and a slave that leaves its segments.
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "abaqus_services.hpp"
#include "plain_model.hpp"
#include "uel_host.hpp"

namespace adapters::slave_point_test {
namespace {

using Values = std::vector<double>;

struct Random {
  std::mt19937_64 engine{20261124};
  double operator()(double from, double to) {
    return from + (to - from) * (static_cast<double>(engine() >> 11) * 0x1p-53);
  }
};

UelCall call_of(const Values& props, const Values& positions, int d, int state_size) {
  UelCall c(static_cast<int>(positions.size()) / d, d, state_size);
  c.props = props;
  c.coords = positions;
  c.u.assign(positions.size(), 0.0);
  return c;
}

// The force in a point x = sum w_i x_i is w_i R in its nodes, and the stiffness w_i K w_j: compared with the
// plain interface, for random faces, weights and masters, with friction.
TEST(SlavePoint, ForcesAndStiffnessAreThoseOfTheNodes) {
  write("ents_761.json",
        R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6, 0.35]},
    "contact": {"normal": {"type": "penalty", "stiffness": 400}, "friction": {"type": "coulomb", "coefficient": 0.25, "stiffness": 200}}})");
  write("ents_762.json",
        R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6, 0.35]},
    "contact": {"normal": {"type": "penalty", "stiffness": 400}, "friction": {"type": "coulomb", "coefficient": 0.25, "stiffness": 200}}})");
  const PlainModel plain(std::string("ents_761.json"));
  const auto size = static_cast<std::size_t>(plain.layout().state_size);
  Random random;
  std::vector<std::string> lines{"slave_nodes 4"};
  std::vector<Values> all_weights;
  for (int k = 0; k < 20; ++k) {
    Values w;
    const double a = random(-0.8, 0.8), b = random(-0.8, 0.8);
    for (const auto& c : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      w.push_back((1 + a * c.first) * (1 + b * c.second) / 4);
    all_weights.push_back(w);
    char line[200];
    std::snprintf(line, sizeof line, "%d 0.37 %.17g %.17g %.17g %.17g", 90001 + k, w[0], w[1], w[2], w[3]);
    lines.emplace_back(line);
  }
  std::string table;
  for (const auto& line : lines) table += line + "\n";
  write("ents_762.txt", table);

  for (int k = 0; k < 20; ++k) {
    const Values& w = all_weights[static_cast<std::size_t>(k)];
    const double low = random(-0.12, -0.06);
    Values positions, point(3);
    for (const auto& c : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      for (const double x :
           {0.3 * c.first + random(-0.1, 0.1), 0.3 * c.second + random(-0.1, 0.1), low + random(-0.01, 0.01)})
        positions.push_back(x);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 3; ++j) point[j] += w[i] * positions[3 * i + j];
    for (const auto& c : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      for (const double x : {c.first + random(-0.1, 0.1), c.second + random(-0.1, 0.1), random(-0.03, 0.03)})
        positions.push_back(x);

    double residual[15], tangent[15 * 15], area = 0.37;
    Values begin(size), end(size);
    ents_state_init(plain.get(), 1, begin.data(), static_cast<int64_t>(size), nullptr);
    auto in = ents_struct<ents_input>();
    in.slave = point.data(), in.master = positions.data() + 12, in.area = &area,
    in.state_begin = begin.data();
    auto out = ents_struct<ents_output>();
    out.wanted = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_STATE;
    out.residual = residual, out.tangent = tangent, out.state_end = end.data();
    ASSERT_EQ(ents_evaluate(plain.get(), 0, 1, &in, &out, nullptr), ENTS_OK);
    ASSERT_GT(std::abs(residual[2]), 1.0) << "in contact";

    UelCall by_properties =
        call_of({761, 0.37, 8, 4, w[0], w[1], w[2], w[3]}, positions, 3, static_cast<int>(size));
    UelCall by_table = call_of({762, 0}, positions, 3, static_cast<int>(size));
    by_table.jelem = 90001 + k;
    by_properties(), by_table();
    ASSERT_TRUE(abaqus_messages().empty());
    const auto weight = [&](std::size_t dof) { return dof < 12 ? w[dof / 3] : 1.0; };
    const auto packed = [](std::size_t dof) { return dof < 12 ? dof % 3 : dof - 9; };
    for (std::size_t j = 0; j < 24; ++j) {
      const double force = weight(j) * residual[packed(j)];
      EXPECT_NEAR(by_properties.rhs[j], -force, 1e-13 * std::abs(residual[2]));
      EXPECT_EQ(by_properties.rhs[j], by_table.rhs[j]);
      for (std::size_t i = 0; i < 24; ++i)
        EXPECT_NEAR(by_properties.amatrx[i + 24 * j],
                    weight(i) * weight(j) * tangent[packed(i) + 15 * packed(j)], 1e-11);
    }
  }
}

TEST(SlavePoint, MistakesSayWhatToWrite) {
  const char* model = R"({"segment": "quad4", "contact": {"normal": {"type": "penalty", "stiffness": 400}}})";
  const Values positions(24, 0.5);
  int number = 763;
  const auto expect = [&](const Values& more, const std::string& table, const std::string& text) {
    const std::string stem = "ents_" + std::to_string(++number);
    write(stem + ".json", model);
    if (!table.empty()) write(stem + ".txt", table);
    Values props{static_cast<double>(number), table.empty() ? 0.5 : 0.0};
    props.insert(props.end(), more.begin(), more.end());
    UelCall c = call_of(props, positions, 3, 32);
    EXPECT_THROW(c(), HostStopped) << text;
    const std::string message = only_message();
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  expect({8}, "", "entry 4 is the number of the slave's nodes");
  expect({8, 4, 0.25, 0.25}, "", "as many weights follow");
  expect({8, 10, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1}, "", "1 .. 9");
  expect({8, 4, 0.25, 0.25, 0.25, 0.35}, "", "add up to 1.1");
  expect({8, 3, 0.5, 0.25, 0.25}, "", "needs 7 nodes, 3 of the slave's face, 4 master nodes");
  expect({}, "slave_nodes 4\n90001 0.5 0.25 0.25 0.25\n", "line 2: write ELEMENT AREA and 4 weights");
  expect({}, "slave_nodes 4\n90001 0.5 0.25 0.25 0.25 0.5\n", "line 2: the weights");
  expect({}, "slave_nodes 11\n", "line 1: write slave_nodes and a whole number");
  expect({}, "90001 0.5\nslave_nodes 4\n", "line 2: write slave_nodes");
  expect({32}, "", "entry 4 is the offset of the gap");
  expect({}, "offsets\n90001 0.5\n", "line 2: write ELEMENT AREA OFFSET");
  expect({}, "90001 0.5\noffsets\n", "line 2: write offsets alone");
}

// A clearance or a coating of one slave node, from its properties and from the table: the force of a node
// that is so much farther or nearer. With a slave point as well.
TEST(Offset, IsAddedToTheGapOfItsElement) {
  const auto model = [](const char* offset) {
    return std::string(
               R"({"segment": "line2", "contact": {"normal": {"type": "penalty", "stiffness": 400})") +
           offset + "}}";
  };
  write("ents_791.json", model(""));
  write("ents_792.json", model(R"(, "offset": 0)"));
  write("ents_793.json", model(R"(, "offset": 0)"));
  write("ents_793.txt", "offsets\n90001 0.5 -0.03\n90002 0.5 0.02\n");
  write("ents_794.json", model(R"(, "offset": 0)"));
  const auto force = [](const Values& props, double y, bool point, int element) {
    UelCall c = point ? call_of(props, {0, y - 1, 1, y + 1, 0, 0, 1, 0}, 2, 32)
                      : call_of(props, {0.5, y, 0, 0, 1, 0}, 2, 32);
    c.jelem = element;
    c();
    EXPECT_TRUE(abaqus_messages().empty());
    return point ? c.rhs[1] + c.rhs[3] : c.rhs[1];
  };
  for (const double gap : {-0.05, 0.01}) {
    const double near = force({791, 0.5}, gap - 0.03, false, 90001),
                 far = force({791, 0.5}, gap + 0.02, false, 90001);
    EXPECT_NEAR(force({792, 0.5, 32, -0.03}, gap, false, 90001), near, 1e-12);
    EXPECT_NEAR(force({792, 0.5, 32, 0.02}, gap, false, 90001), far, 1e-12);
    EXPECT_NEAR(force({793, 0}, gap, false, 90001), near, 1e-12);
    EXPECT_NEAR(force({793, 0}, gap, false, 90002), far, 1e-12);
    EXPECT_NEAR(force({794, 0.5, 40, -0.03, 2, 0.5, 0.5}, gap, true, 90001), near, 1e-12);
  }
  UelCall c = call_of({791, 0.5, 32, -0.03}, {0.5, -0.01, 0, 0, 1, 0}, 2, 32);
  EXPECT_THROW(c(), HostStopped);
  const std::string message = only_message();
  EXPECT_NE(message.find("write \"offset\": 0"), std::string::npos) << message;
}

/// Two segments from x = 0 to 2, the slave above them; an increment after the other.
class LeftPatch : public testing::Test {
protected:
  LeftPatch() {
    write("ents_760.json", R"({"segment": "line2", "patch": [[0, 1], [1, 2]],
      "contact": {"normal": {"type": "penalty", "stiffness": 400}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 200}}})");
    const PlainModel plain(std::string("ents_760.json"));
    state_.assign(static_cast<std::size_t>(plain.layout().state_size), 0.0);
    abaqus_messages();
  }

  /// @return PNEWDT
  double move(double x, double y, double options = 0) {
    UelCall c =
        call_of({760, 0.5, options}, {1.5, 0.1, 0, 0, 1, 0, 2, 0}, 2, static_cast<int>(state_.size()));
    c.u[0] = x - 1.5, c.u[1] = y - 0.1;
    for (std::size_t i = 0; i < state_.size(); ++i) c.svars[i] = state_[i];
    c();
    force = c.rhs[1];
    for (std::size_t i = 0; i < state_.size(); ++i) state_[i] = c.svars[i];
    return c.pnewdt;
  }

  double force = 0;

private:
  Values state_;
};

TEST_F(LeftPatch, InContactAsksForACut) {
  EXPECT_EQ(move(1.5, -0.02), 1e36);
  EXPECT_NE(force, 0);
  EXPECT_EQ(move(2.3, -0.02), 0.5);
  EXPECT_EQ(force, 0);
  const std::string text = only_message();
  for (const char* part : {"element 90001", "(2.3, -0.02)", "left its segments", "wider \"patch\"",
                           "add 16 to *UEL PROPERTY, entry 3"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST_F(LeftPatch, LiftedOffIsOpen) {
  EXPECT_EQ(move(1.5, -0.02), 1e36);
  EXPECT_EQ(move(2.3, 0.05), 1e36);
  EXPECT_TRUE(abaqus_messages().empty());
}

TEST_F(LeftPatch, NeverNearIsOpen) {
  for (const double x : {3.0, 2.3, 2.1}) EXPECT_EQ(move(x, -0.02), 1e36);
  EXPECT_TRUE(abaqus_messages().empty());
}

TEST_F(LeftPatch, MayBeMeant) {
  EXPECT_EQ(move(1.5, -0.02, 16), 1e36);
  EXPECT_EQ(move(2.3, -0.02, 16), 1e36);
  EXPECT_EQ(force, 0);
  EXPECT_TRUE(abaqus_messages().empty());
}

TEST_F(LeftPatch, SlidesInside) {
  for (const double x : {1.5, 1.1, 0.9, 0.4, 1.9}) {
    EXPECT_EQ(move(x, -0.02), 1e36);
    EXPECT_NE(force, 0) << x;
  }
  EXPECT_TRUE(abaqus_messages().empty());
}

} // namespace
} // namespace adapters::slave_point_test
