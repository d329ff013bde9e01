// Golden vectors (golden/README.md): an independent 100-digit computation from the definitions alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bases.hpp"
#include "library.hpp"
#include "worst.hpp"

namespace mechanics::golden_test {
namespace {

using nlohmann::json;

std::vector<double> flatten(const json& value) {
  std::vector<double> out;
  const auto append = [&](const auto& self, const json& v) -> void {
    if (v.is_array())
      for (const json& entry : v) self(self, entry);
    else
      out.push_back(v.get<double>());
  };
  append(append, value);
  return out;
}

std::vector<json> cases_of(const std::string& basis) {
  std::ifstream file(std::string(ENTS_GOLDEN_DIRECTORY) + "/" + basis + ".json");
  EXPECT_TRUE(file.is_open()) << basis;
  return json::parse(file).at("cases");
}

double largest(const std::vector<double>& v) {
  double m = 0.0;
  for (const double x : v) test::raise(m, std::fabs(x));
  return m;
}

// Largest distance of a node from the first one.
double segment_size(const std::vector<double>& master, int dimension) {
  double size = 0.0;
  for (std::size_t i = 0; i < master.size(); i += static_cast<std::size_t>(dimension)) {
    double square = 0.0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c)
      square += (master[i + c] - master[c]) * (master[i + c] - master[c]);
    test::raise(size, std::sqrt(square));
  }
  return size;
}

struct WorstVector {
  // The reference is exact to the last digit printed, 17 of them. What is left is the rounding of the
  // library: about 1e3 operations in a row at 1.1e-16, and condition numbers of the projection up to 1e2.
  static constexpr double tolerance = 1e-11;
  double error = 0.0;
  std::string where = "nothing compared";
  int compared = 0;

  void compare(const std::string& where_now, const std::vector<double>& got,
               const std::vector<double>& expected, double scale) {
    ASSERT_EQ(got.size(), expected.size()) << where_now;
    double difference = 0.0;
    for (std::size_t i = 0; i < got.size(); ++i) {
      ASSERT_TRUE(std::isfinite(got[i])) << where_now;
      test::raise(difference, std::fabs(got[i] - expected[i]));
    }
    EXPECT_LE(difference, tolerance * scale) << where_now;
    ++compared;
    if (difference > error * scale) {
      error = difference / scale;
      where = where_now;
    }
  }
};

Elements element_of(const json& c, bool with_start) {
  Elements e;
  e.count = 1;
  e.slave = flatten(c.at("slave"));
  e.master = flatten(c.at("master"));
  if (with_start) e.start = flatten(c.at("start"));
  if (c.contains("surface_coordinates")) e.surface_coordinates = flatten(c.at("surface_coordinates"));
  return e;
}

json model_of(const json& c) {
  return {{"segment", c.at("segment")}, {"height", c.at("height")}, {"projection", c.at("projection")}};
}

void compare_kinematics(const json& c, const Elements& e, const Results& r, WorstVector& worst) {
  const std::string name = c.at("name");
  const json& expected = c.at("expected");
  const double size = segment_size(e.master, static_cast<int>(e.slave.size()));
  const auto field = [&](const char* key, const std::vector<double>& got, double scale) {
    const std::vector<double> want = flatten(expected.at(key));
    worst.compare(std::string(key) + " in " + name, got, want, scale > 0.0 ? scale : largest(want));
  };
  field("xi", r.xi, 0.0);
  field("gap", r.gap, size);
  field("normal_gap", r.normal_gap, size);
  field("normal", r.normal, 0.0);
  field("d_gap", r.gap_gradient, 0.0);
  field("d2_gap", r.gap_hessian, 0.0);
  field("d_xi", r.xi_gradient, 0.0);
  field("d2_xi", r.xi_hessian, 0.0);
}

class Golden : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Basis, Golden, testing::ValuesIn(basis_names()),
                         [](const auto& parameter) { return parameter.param; });

TEST_P(Golden, KinematicsFromTheStartValue) {
  WorstVector worst;
  const std::vector<json> cases = cases_of(GetParam());
  for (const json& c : cases) {
    const Elements e = element_of(c, true);
    const Results r = Model(model_of(c).dump()).evaluate(e, kinematics);
    ASSERT_TRUE(r.ok(0)) << c.at("name") << ": " << ents_status_text(r.statuses[0]);
    compare_kinematics(c, e, r, worst);
  }
  EXPECT_EQ(worst.compared, 8 * 8); // cases and quantities
  std::cout << "worst relative error " << worst.error << " (" << worst.where << ")\n";
}

// The search knows no start value. Golden cases have one isolated projection near their start: it is the
// closest point.
TEST_P(Golden, KinematicsFromTheSearch) {
  WorstVector worst;
  for (const json& c : cases_of(GetParam())) {
    const Elements e = element_of(c, false);
    const Results r = Model(model_of(c).dump()).evaluate(e, kinematics | ENTS_FLAGS);
    ASSERT_TRUE(r.ok(0)) << c.at("name") << ": " << ents_status_text(r.statuses[0]);
    EXPECT_TRUE(r.has_flag(0, ENTS_FLAG_SEARCHED)) << c.at("name");
    compare_kinematics(c, e, r, worst);
  }
  EXPECT_EQ(worst.compared, 8 * 8);
  std::cout << "worst relative error " << worst.error << " (" << worst.where << ")\n";
}

// Penalty element from the reference's gap and variations: W = eps A g^2 / 2, R = eps A g dg, K = eps A (dg
// dg^T + g d2g).
TEST_P(Golden, Element) {
  constexpr double stiffness = 250.0, area = 0.75;
  WorstVector worst;
  int in_contact = 0;
  for (const json& c : cases_of(GetParam())) {
    Elements e = element_of(c, true);
    e.area = {area};
    json text = model_of(c);
    text["contact"] = {{"normal", {{"type", "penalty"}, {"stiffness", stiffness}}}};
    const Results r =
        Model(text.dump()).evaluate(e, ENTS_ENERGY | ENTS_PRESSURE | ENTS_RESIDUAL | ENTS_TANGENT);
    ASSERT_TRUE(r.ok(0)) << c.at("name") << ": " << ents_status_text(r.statuses[0]);
    const double gap = std::min(c.at("expected").at("gap").get<double>(), 0.0);
    in_contact += gap < 0.0;
    const double eps = gap < 0.0 ? stiffness * area : 0.0;
    std::vector<double> residual = flatten(c.at("expected").at("d_gap")), dg = residual;
    std::vector<double> tangent = flatten(c.at("expected").at("d2_gap"));
    const std::size_t n = dg.size();
    for (double& f : residual) f *= eps * gap;
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i)
        tangent[j * n + i] = eps * (dg[i] * dg[j] + gap * tangent[j * n + i]);
    const std::string name = c.at("name");
    const double size = segment_size(e.master, static_cast<int>(e.slave.size()));
    const double force = stiffness * area * size; // of a gap as large as the segment, as for the gap itself
    worst.compare("energy in " + name, r.energy, {0.5 * eps * gap * gap}, force * size);
    worst.compare("pressure in " + name, r.pressure, {-eps / area * gap}, force / area);
    worst.compare("residual in " + name, r.residual, residual, force);
    worst.compare("tangent in " + name, r.tangent, tangent, stiffness * area);
  }
  EXPECT_GE(in_contact, 3);
  std::cout << "worst relative error " << worst.error << " (" << worst.where << "), " << in_contact
            << " in contact\n";
}

} // namespace
} // namespace mechanics::golden_test
