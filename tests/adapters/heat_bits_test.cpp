// SPDX-License-Identifier: BSD-3-Clause
// Heat through Abaqus: order, sign and weights of all blocks, against the plain interface.
#include <gtest/gtest.h>

#include "plain_model.hpp"
#include "uel_host.hpp"

namespace adapters::heat_bits_test {
namespace {

using Values = std::vector<double>;

struct Response {
  Values residual, tangent; ///< [dofs], [dofs][dofs] column-major
};

/// The plain interface at the same place. Adapters begin with the projection on the segment without its height.
Response plain(const PlainModel& model, const PlainModel& flat, double area, const Values& x,
               const Values& temperature) {
  const ents_layout& layout = model.layout();
  const int d = layout.dimension;
  Values begin(static_cast<std::size_t>(layout.state_size));
  ents_state_init(model.get(), 1, begin.data(), layout.state_size, nullptr);
  Response r{Values(static_cast<std::size_t>(layout.dofs)),
             Values(static_cast<std::size_t>(layout.dofs * layout.dofs))};
  auto in = ents_struct<ents_input>();
  in.slave = x.data(), in.master = x.data() + d, in.area = &area, in.state_begin = begin.data();
  in.slave_temperature = temperature.data(), in.master_temperature = temperature.data() + 1;
  auto out = ents_struct<ents_output>();
  double start[2];
  out.wanted = ENTS_XI, out.xi = start;
  EXPECT_EQ(ents_evaluate(flat.get(), 0, 1, &in, &out, nullptr), ENTS_OK);
  in.start = start;
  out.wanted = ENTS_RESIDUAL | ENTS_TANGENT, out.residual = r.residual.data(), out.tangent = r.tangent.data();
  auto report = ents_struct<ents_report>();
  EXPECT_EQ(ents_evaluate(model.get(), 0, 1, &in, &out, &report), ENTS_OK) << report.message;
  return r;
}

// Degrees of freedom 1, 2, 3, 11 of five nodes, all blocks; and of a slave point, whose nodes get their weights.
TEST(HeatBits, AbaqusGetsTheBitsOfThePlainInterface) {
  auto text = nlohmann::json::parse(
      R"({"segment": "quad4", "height": {"type": "sine", "amplitude": 0.03, "wave_vector": [0.6, 0.35]},
    "contact": {"normal": {"type": "penalty", "stiffness": 400},
    "heat": {"power": {"coefficient": 4, "pressure": 2, "exponent": 0.95}, "gas": {"conductivity": 0.2, "jump": 0.05}}}})");
  write("ents_813.json", text.dump());
  const PlainModel model(std::string("ents_813.json"));
  text.erase("height");
  const PlainModel flat(text);
  const Values x{0.1, 0.2, -0.05, -1, -1, 0.02, 1.1, -1, 0, 1, 0.9, -0.03, -0.9, 1, 0.01};
  const Values temperature{7, 1, 2, 3, 5};
  for (const double height : {0.0, 0.2}) { // in contact, and open: the gas
    Values moved = x;
    moved[2] += height;
    UelCall c(5, 4, 30);
    c.mcrd = 3;
    c.props = {813, 0.6};
    c.coords = moved;
    for (std::size_t node = 0; node < 5; ++node) c.u.insert(c.u.end(), {0, 0, 0, temperature[node]});
    c.du = c.u;
    c();
    const Response r = plain(model, flat, 0.6, moved, temperature);
    EXPECT_NE(r.residual[3], 0);
    for (std::size_t i = 0; i < 20; ++i) {
      EXPECT_EQ(-c.rhs[i], r.residual[i]) << i;
      for (std::size_t j = 0; j < 20; ++j) EXPECT_EQ(c.amatrx[i + 20 * j], r.tangent[i + 20 * j]) << i << j;
    }
    // The point as the middle of four nodes with temperatures of their own
    UelCall face(8, 4, 30);
    face.mcrd = 3;
    face.props = {813, 0.6, 8, 4, 0.1, 0.2, 0.3, 0.4};
    const double w[4] = {0.1, 0.2, 0.3, 0.4}, temperatures[4] = {1, 9, 4, 9.75};
    for (std::size_t k = 0; k < 4; ++k) {
      const double shift = k == 0 ? 0.4 : k == 1 ? -0.2 : 0;
      face.coords.insert(face.coords.end(), {moved[0] + shift, moved[1] - shift, moved[2]});
      face.u.insert(face.u.end(), {0, 0, 0, temperatures[k]});
    }
    face.coords.insert(face.coords.end(), moved.begin() + 3, moved.end());
    for (std::size_t node = 1; node < 5; ++node) face.u.insert(face.u.end(), {0, 0, 0, temperature[node]});
    face.du = face.u;
    face();
    Values mean = temperature;
    mean[0] = 0.1 * 1 + 0.2 * 9 + 0.3 * 4 + 0.4 * 9.75;
    const Response point = plain(model, flat, 0.6, moved, mean);
    const auto of = [&](std::size_t i) { return i < 16 ? i % 4 : i - 12; };
    const auto weight = [&](std::size_t i) { return i < 16 ? w[i / 4] : 1.0; };
    for (std::size_t i = 0; i < 32; ++i) {
      EXPECT_NEAR(-face.rhs[i], weight(i) * point.residual[of(i)], 1e-12 * 40) << i;
      for (std::size_t j = 0; j < 32; ++j)
        EXPECT_NEAR(face.amatrx[i + 32 * j], weight(i) * weight(j) * point.tangent[of(i) + 20 * of(j)],
                    1e-12 * 1e4)
            << i << " " << j;
    }
  }
}

} // namespace
} // namespace adapters::heat_bits_test
