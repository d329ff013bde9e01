// SPDX-License-Identifier: BSD-3-Clause
// ents_contact_area: places where contact ends that are known, Hertz on coarse meshes, and what must not
// matter.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/caller.hpp"

namespace contact_area_test {
namespace {

constexpr double pi = std::numbers::pi;

template <class... A> int32_t contact_area(A... a) { return call::contact_area(a...); }

/// A slave surface with results at its nodes.
struct CoarseSurface {
  const char* facet = "quad4";
  std::vector<int64_t> connectivity;
  std::vector<double> positions, gap, pressure;
  double thickness = 1, modulus = 1;

  int64_t nodes() const { return static_cast<int64_t>(gap.size()); }
  int64_t facets() const {
    const std::string name = facet;
    return static_cast<int64_t>(connectivity.size()) / (name == "line2" ? 2 : name == "tri3" ? 3 : 4);
  }
  ents_area area() const {
    ents_area result{};
    result.struct_size = sizeof result;
    ents_report report{};
    report.struct_size = sizeof report;
    EXPECT_EQ(contact_area(facet, facets(), connectivity.data(), nodes(), positions.data(), thickness,
                           gap.data(), pressure.data(), modulus, &result, &report),
              ENTS_OK)
        << report.message;
    return result;
  }
};

/// n x n squares of a side in the plane of x and y, as quadrilaterals or two triangles each.
template <class Fields> CoarseSurface sheet(const char* facet, int n, double side, const Fields& fields) {
  CoarseSurface s;
  s.facet = facet;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      s.positions.insert(s.positions.end(), {i * side, j * side, 0});
      const auto [pressure, gap] = fields(i * side, j * side);
      s.pressure.push_back(pressure), s.gap.push_back(gap);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int64_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      if (std::string(facet) == "quad4")
        s.connectivity.insert(s.connectivity.end(), {a, b, c, d});
      else
        s.connectivity.insert(s.connectivity.end(), {a, b, c, a, c, d});
    }
  return s;
}

/// Pressure and gap of Hertz's contact of a sphere at a distance from its axis (Johnson 1985, section 3.4).
struct Hertz {
  double radius, sphere, modulus;
  std::pair<double, double> at(double r) const {
    const double a = radius, peak = 2 * modulus * a / (pi * sphere);
    if (r < a) return {peak * std::sqrt(1 - r * r / (a * a)), 0.};
    const double moved = peak / (2 * modulus * a) *
                         ((2 * a * a - r * r) * std::asin(a / r) + r * a * std::sqrt(1 - a * a / (r * r)));
    return {0., r * r / (2 * sphere) - a * a / sphere + moved};
  }
};

// The fields near a straight border are those that the function takes for granted: exact, wherever it lies.
TEST(ContactArea, ALineEndsWhereItsPressureDoes) {
  for (const double border : {1.01, 1.3, 1.5, 1.77, 1.99})
    for (const double thickness : {2., 0.}) {
      constexpr double modulus = 300, slope = 7;
      CoarseSurface line{"line2", {0, 1, 1, 2, 2, 3}, {0, 5, 1, 5, 2, 5, 3, 5}, {}, {}, thickness, modulus};
      for (const double x : {0., 1., 2., 3.}) {
        line.pressure.push_back(x < border ? slope * std::sqrt(border - x) : 0);
        line.gap.push_back(x < border ? -1e-3 : 4 * slope / (3 * modulus) * std::pow(x - border, 1.5));
      }
      const ents_area area = line.area();
      const auto measure = [&](double x) { return thickness > 0 ? thickness * x : pi * x * x; };
      EXPECT_NEAR(area.zero_line, measure(border), 1e-12);
      EXPECT_EQ(area.estimate, area.zero_line);
      EXPECT_NEAR(area.counted, thickness > 0 ? 2 * 1.5 : pi * (1 + 4. / 3), 1e-12);
      EXPECT_EQ(area.border_corrected, area.counted);
      EXPECT_NEAR(area.surface, measure(3), 1e-12);
    }
}

TEST(ContactArea, AllNothingAndPartsOfIt) {
  for (const char* facet : {"quad4", "tri3"}) {
    const auto all = sheet(facet, 3, 0.5, [](double, double) { return std::pair(2., -0.1); }).area();
    for (const double value : {all.surface, all.counted, all.border_corrected, all.zero_line, all.estimate})
      EXPECT_NEAR(value, 2.25, 1e-14);
    EXPECT_NEAR(all.error, 0, 1e-14);
    EXPECT_EQ(all.peak_drop, 0);
    const auto none = sheet(facet, 3, 0.5, [](double, double) { return std::pair(0., 0.1); }).area();
    for (const double value :
         {none.counted, none.border_corrected, none.zero_line, none.estimate, none.error})
      EXPECT_EQ(value, 0);
    EXPECT_EQ(none.peak_pressure, 0);
    // Without an opposite surface outside, contact ends at the nodes.
    const auto half = sheet(facet, 4, 1, [](double x, double) {
                        return std::pair(x < 2.5 ? 1. : 0., std::numeric_limits<double>::quiet_NaN());
                      }).area();
    EXPECT_NEAR(half.zero_line, 8, 1e-14);
    EXPECT_NEAR(half.counted, 10, 1e-14);
    EXPECT_NEAR(half.counted - half.border_corrected,
                (pi - 1 + std::numbers::ln2) / 24 * (facet[0] == 'q' ? 4 : 4.8), 1e-14);
  }
}

// A circle over meshes of 4 to 10 spacings, its centre anywhere: the zero line is twice to ten times better
// than counting.
TEST(ContactArea, HertzOnCoarseMeshes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (const char* facet : {"quad4", "tri3"})
    for (const double radius : {4., 10., 20.}) {
      double zero_line = 0, counted = 0, bias = 0, outside = 0;
      constexpr int tries = 40;
      for (int i = 0; i < tries; ++i) {
        const double x0 = 25 + share(random), y0 = 25 + share(random), true_radius = radius + share(random);
        const Hertz hertz{true_radius, 500, 1000};
        CoarseSurface s =
            sheet(facet, 50, 1, [&](double x, double y) { return hertz.at(std::hypot(x - x0, y - y0)); });
        s.modulus = hertz.modulus;
        const ents_area area = s.area();
        const double exact = pi * true_radius * true_radius;
        zero_line += std::pow(area.zero_line / exact - 1, 2) / tries,
            bias += (area.zero_line / exact - 1) / tries;
        counted += std::pow(area.counted / exact - 1, 2) / tries;
        outside += std::abs(area.estimate - exact) > area.error;
        EXPECT_NEAR(area.peak_pressure, hertz.at(0).first, 0.02 * hertz.at(0).first);
        EXPECT_LT(area.peak_drop, 0.05 * area.peak_pressure);
      }
      // Chords cut a circle off by 1 / (6 radius^2) of its area; the law's next term is of the same order.
      EXPECT_LT(std::sqrt(zero_line), 0.25 / (radius * radius)) << facet << " " << radius;
      EXPECT_LT(std::abs(bias), 0.25 / (radius * radius)) << facet << " " << radius;
      EXPECT_GT(std::sqrt(counted), std::sqrt(zero_line));
      EXPECT_EQ(outside, 0);
    }
}

// The area of discs by the nodes of a mesh that lies anywhere: its standard deviation is the one that the
// error takes twice where there is no other estimate. 2000 discs know it to 2 %.
TEST(ContactArea, ACountOfNodesScattersAsALatticeDoes) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0, 1);
  double squares = 0, expected = 0;
  for (int i = 0; i < 2000; ++i) {
    const double x0 = 6 + share(random), y0 = 6 + share(random), radius = 4 + share(random);
    CoarseSurface s = sheet("quad4", 13, 1, [&](double x, double y) {
      return std::pair(std::hypot(x - x0, y - y0) < radius ? 1. : 0., 1.);
    });
    s.modulus = 0;
    const ents_area area = s.area();
    squares += std::pow(area.counted - pi * radius * radius, 2);
    expected += std::pow((area.error - (area.counted - area.border_corrected)) / 2, 2);
  }
  EXPECT_NEAR(std::sqrt(expected / squares), 1, 0.06);
}

TEST(ContactArea, UnitsAndPlaceDoNotMatter) {
  const Hertz hertz{5.3, 500, 1000};
  CoarseSurface s =
      sheet("quad4", 16, 1, [&](double x, double y) { return hertz.at(std::hypot(x - 8.2, y - 7.9)); });
  s.modulus = hertz.modulus;
  const ents_area before = s.area();
  for (const double length : {1e-9, 1e6})
    for (const double stress : {1e-6, 1e9}) {
      CoarseSurface t = s;
      for (std::size_t i = 0; i < t.gap.size(); ++i) {
        const double x = s.positions[3 * i], y = s.positions[3 * i + 1];
        t.positions[3 * i] = length * (3 + 0.6 * x), t.positions[3 * i + 1] = length * y;
        t.positions[3 * i + 2] = length * (0.8 * x - 5);
        t.gap[i] *= length, t.pressure[i] *= stress;
      }
      t.modulus *= stress;
      const ents_area after = t.area();
      const double squared = length * length;
      EXPECT_NEAR(after.counted / squared, before.counted, 1e-10 * before.counted);
      EXPECT_NEAR(after.border_corrected / squared, before.border_corrected, 1e-10 * before.counted);
      EXPECT_NEAR(after.zero_line / squared, before.zero_line, 1e-10 * before.counted);
      EXPECT_NEAR(after.error / squared, before.error, 1e-10 * before.counted);
      EXPECT_NEAR(after.peak_drop / stress, before.peak_drop, 1e-10 * before.peak_pressure);
    }
  s.modulus = 0;
  const ents_area without = s.area();
  EXPECT_EQ(without.zero_line, 0);
  EXPECT_EQ(without.estimate, before.border_corrected);
  EXPECT_GT(without.error, without.counted - without.border_corrected);
}

// Neighbours are the nodes at the other end of an edge, not those across a facet.
TEST(ContactArea, APeakOnOneNodeIsNotResolved) {
  const auto peak = [](double far) {
    return sheet("quad4", 2, 1,
                 [&](double x, double y) {
                   return x == 1 && y == 1 ? std::pair(4., 0.) : std::pair(x != 1 && y != 1 ? far : 0., 1.);
                 })
        .area();
  };
  EXPECT_EQ(peak(0).peak_pressure, 4);
  EXPECT_EQ(peak(0).peak_drop, 4);
  EXPECT_EQ(peak(1).peak_drop, 4);
  EXPECT_GT(peak(0).error, 0.2 * peak(0).estimate);
}

// The error is the larger of what the two corrections differ by and half of what they change, and the scatter
// of a count of nodes: here the border has four pairs of nodes.
TEST(ContactArea, ErrorOfAStraightBorder) {
  for (const double pressure : {0.02, 2.}) {
    CoarseSurface s =
        sheet("quad4", 4, 1, [&](double x, double) { return std::pair(x < 2.5 ? pressure : 0., 0.01); });
    const ents_area area = s.area();
    EXPECT_NEAR(area.estimate, (area.border_corrected + area.zero_line) / 2, 1e-14);
    EXPECT_NEAR(area.error,
                std::max(std::abs(area.border_corrected - area.zero_line),
                         std::abs(area.counted - area.estimate) / 2) +
                    std::sqrt(0.0724 * pi / 4 * 4),
                1e-14);
  }
}

// Two opposite corners in contact: joined through the middle if the contacts of the edges reach beyond it.
TEST(ContactArea, OppositeCorners) {
  for (const double pressure : {0.005, 0.01, 0.05, 0.5}) {
    const CoarseSurface edge{"line2", {0, 1}, {0, 0, 1, 0}, {0, 0.01}, {pressure, 0}, 1, 1};
    const double t = edge.area().zero_line;
    const auto corners = sheet("quad4", 1, 1, [&](double x, double y) {
      return x == y ? std::pair(pressure, 0.) : std::pair(0., 0.01);
    });
    EXPECT_NEAR(corners.area().zero_line, t < 0.5 ? t * t : 1 - (1 - t) * (1 - t), 1e-12) << t;
  }
}

TEST(ContactArea, Mistakes) {
  CoarseSurface s = sheet("quad4", 1, 1, [](double, double) { return std::pair(1., 0.); });
  ents_area area{};
  ents_report report{};
  report.struct_size = sizeof report;
  const auto call_with = [&](const auto& change) {
    CoarseSurface t = s;
    area = {};
    area.struct_size = sizeof area;
    change(t, area);
    const ents_area given = area;
    const int32_t status =
        contact_area(t.facet, t.facets(), t.connectivity.data(), t.nodes(), t.positions.data(), t.thickness,
                     t.gap.data(), t.pressure.data(), t.modulus, &area, &report);
    EXPECT_EQ(area.surface, given.surface); // nothing is written
    return status;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(call_with([](CoarseSurface& t, ents_area&) { t.facet = "quad8"; }), ENTS_BAD_VALUE);
  EXPECT_NE(std::string(report.message).find("'facet' must be line2, tri3 or quad4"), std::string::npos);
  EXPECT_EQ(call_with([](CoarseSurface& t, ents_area&) { t.modulus = -1; }), ENTS_BAD_VALUE);
  EXPECT_NE(std::string(report.message).find("'modulus'"), std::string::npos);
  EXPECT_EQ(call_with([](CoarseSurface& t, ents_area&) { t.connectivity[2] = 4; }), ENTS_BAD_VALUE);
  EXPECT_EQ(report.element, 0);
  EXPECT_EQ(call_with([&](CoarseSurface& t, ents_area&) { t.pressure[3] = nan; }), ENTS_NON_FINITE);
  EXPECT_NE(std::string(report.message).find("pressure[3]"), std::string::npos);
  EXPECT_EQ(call_with([&](CoarseSurface& t, ents_area&) { t.positions[4] = nan; }), ENTS_NON_FINITE);
  EXPECT_EQ(call_with([](CoarseSurface&, ents_area& a) { a.struct_size = 3; }), ENTS_STRUCT_SIZE);
  EXPECT_EQ(call_with([](CoarseSurface&, ents_area& a) { a.reserved = 1; }), ENTS_STRUCT_SIZE);
  EXPECT_EQ(call_with([](CoarseSurface& t, ents_area&) { t.positions.assign(t.positions.size(), 0.); }),
            ENTS_DEGENERATE_SEGMENT);
  EXPECT_EQ(report.element, 0);
  EXPECT_EQ(contact_area("quad4", int64_t{-1}, nullptr, int64_t{0}, nullptr, 1., nullptr, nullptr, 1., &area,
                         &report),
            ENTS_BAD_COUNT);
  EXPECT_EQ(contact_area("quad4", int64_t{0}, nullptr, int64_t{0}, nullptr, 1., nullptr, nullptr, 1.,
                         static_cast<ents_area*>(nullptr), &report),
            ENTS_NULL_ARGUMENT);
  for (const char* missing : {"connectivity", "positions", "gap", "pressure"}) {
    area = {};
    area.struct_size = sizeof area;
    const auto given = [&](const char* name, auto* array) {
      return std::string(name) == missing ? nullptr : array;
    };
    EXPECT_EQ(contact_area("quad4", s.facets(), given("connectivity", s.connectivity.data()), s.nodes(),
                           given("positions", s.positions.data()), 1., given("gap", s.gap.data()),
                           given("pressure", s.pressure.data()), 1., &area, &report),
              ENTS_NULL_ARGUMENT);
    EXPECT_NE(std::string(report.message).find(missing), std::string::npos);
  }
}

} // namespace
} // namespace contact_area_test
