// What slave points have lost goes into the field of the slave's height: volumes, uniform depths, axisymmetric
// bodies, and what is refused.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "law_elements.hpp"

namespace laws::slave_wear_test {
namespace {

constexpr double two_pi = 6.283185307179586;

json field(int d, int cells, const json& size) {
  const json points = d == 2 ? json{cells + 1} : json{cells + 1, cells + 1};
  return {{"type", "field"},       {"name", "worn"}, {"points", points},
          {"boundary", "clamped"}, {"size", size},   {"origin", d == 2 ? json{0.0} : json{0.0, 0.0}}};
}

// A slave surface of `cells` facets per direction over the unit line or square, stretched by `stretch`; its height is
// a field in the coordinates before the stretch.
struct Surface {
  int d, cells;
  std::string facet;
  std::array<double, 2> stretch{1.0, 1.0};
  mechanics::Model model, contact;
  std::vector<std::int64_t> connectivity, begin, nodes;
  std::vector<double> positions, coordinates, weights, areas, state, block;

  Surface(int dimension, int n, const std::string& shape, int per_direction, double thickness,
          double share = 0.3, std::array<double, 2> stretched = {1.0, 1.0})
      : d(dimension), cells(n), facet(shape), stretch(stretched),
        model(json{{"segment", d == 2 ? "line2" : "quad4"},
                   {"height", field(d, n, d == 2 ? json{1.0} : json{1.0, 1.0})}}
                  .dump()),
        contact(json{{"segment", d == 2 ? "line2" : "quad4"},
                     {"contact",
                      {{"normal", {{"type", "penalty"}, {"stiffness", 100.0}}},
                       {"wear", {{"coefficient", 0.05}, {"slave", share}}}}}}
                    .dump()) {
    const int rows = d == 2 ? 0 : n;
    std::vector<double> places;
    for (int j = 0; j <= rows; ++j)
      for (int i = 0; i <= n; ++i) {
        const double s[2] = {static_cast<double>(i) / n, static_cast<double>(j) / n};
        positions.push_back(stretch[0] * s[0]), places.push_back(s[0]);
        if (d == 3) positions.push_back(stretch[1] * s[1]), places.push_back(s[1]);
        positions.push_back(0.0);
      }
    const auto at = [&](int i, int j) { return static_cast<std::int64_t>(j * (n + 1) + i); };
    for (int j = 0; j < std::max(rows, 1); ++j)
      for (int i = 0; i < n; ++i) {
        if (d == 2) connectivity.insert(connectivity.end(), {at(i, 0), at(i + 1, 0)});
        if (facet == "quad4")
          connectivity.insert(connectivity.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        if (facet == "tri3")
          connectivity.insert(connectivity.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j),
                                                   at(i + 1, j + 1), at(i, j + 1)});
      }
    const std::size_t m = facet == "line2"  ? 2
                          : facet == "tri3" ? 3
                                            : 4,
                      facets = connectivity.size() / m,
                      each = static_cast<std::size_t>(d == 2 ? per_direction : per_direction * per_direction);
    begin.resize(facets * each + 1), areas.resize(facets * each);
    nodes.resize(areas.size() * m), weights.resize(nodes.size());
    ents::call(ents_sampling_points, facet.c_str(), per_direction, static_cast<std::int64_t>(facets),
               connectivity.data(), static_cast<std::int64_t>(places.size()) / (d - 1), positions.data(),
               thickness, begin.data(), nodes.data(), weights.data(), areas.data());
    for (const std::int64_t node : nodes)
      for (int a = 0; a < d - 1; ++a)
        coordinates.push_back(places[static_cast<std::size_t>(node * (d - 1) + a)]);
    state.resize(areas.size() * size());
    ents_state_init(contact.handle(), count(), state.data(), contact_layout().state_size, nullptr);
    std::int64_t length = 0;
    ents::call(ents_field_size, model.handle(), "worn", &length);
    block.resize(static_cast<std::size_t>(length));
    ents::call(ents_field_init, model.handle(), "worn", static_cast<const double*>(nullptr), block.data(),
               length);
  }
  ents_layout contact_layout() const { return layout_of(contact.handle()); }
  std::size_t size() const { return static_cast<std::size_t>(contact_layout().state_size); }
  std::int64_t count() const { return static_cast<std::int64_t>(areas.size()); }
  double& lost(std::size_t point) {
    return state[point * size() + static_cast<std::size_t>(contact_layout().worn)];
  }
  ents_combination combination() const {
    auto c = ents::make<ents_combination>();
    c.points = count(), c.begin = begin.data(), c.nodes = nodes.data(), c.weights = weights.data();
    return c;
  }
  std::int32_t collect(double thickness, double* volume = nullptr, ents_report* report = nullptr) {
    const ents_combination c = combination();
    return ents_wear_collect_slave(contact.handle(), model.handle(), &c, coordinates.data(),
                                   static_cast<std::int64_t>(positions.size()) / d, positions.data(),
                                   thickness, areas.data(), state.data(), contact_layout().state_size, "worn",
                                   block.data(), static_cast<std::int64_t>(block.size()), volume, report);
  }
  double height(double s, double t) const {
    const double at[2] = {s, t};
    double h = 0.0;
    ents::call(ents_field_sample, model.handle(), "worn", block.data(),
               static_cast<std::int64_t>(block.size()), std::int64_t{1}, at, &h);
    return h;
  }
  // of the field over the surface: Simpson's rule is exact for cubics in each cell
  double integral() const {
    const auto weight = [&](int i) {
      return (i == 0 || i == 2 * cells ? 1.0 : i % 2 ? 4.0 : 2.0) / (6.0 * cells);
    };
    double sum = 0.0;
    for (int j = 0; j <= (d == 2 ? 0 : 2 * cells); ++j)
      for (int i = 0; i <= 2 * cells; ++i)
        sum += height(0.5 * i / cells, 0.5 * j / cells) * weight(i) * (d == 2 ? 1.0 : weight(j));
    return sum * stretch[0] * (d == 2 ? 1.0 : stretch[1]);
  }
};

// A depth that is the same everywhere lowers the height by itself, as two Gauss points per direction integrate
// cubics; and any depths lower it by their volume.
TEST(SlaveWear, FieldsLoseTheDepthAndTheVolumeOfTheStates) {
  mechanics::Random random(22);
  for (const char* facet : {"line2", "quad4", "tri3"}) {
    const int d = std::string(facet) == "line2" ? 2 : 3;
    const double thickness = 0.7;
    Surface uniform(d, 6, facet, std::string(facet) == "tri3" ? 8 : 2, thickness, 0.3, {1.5, 0.8});
    double volume = 0.0, area = 0.0;
    for (std::size_t i = 0; i < uniform.areas.size(); ++i) uniform.lost(i) = 1e-3, area += uniform.areas[i];
    ASSERT_EQ(uniform.collect(thickness, &volume), ENTS_OK);
    EXPECT_NEAR(volume, 1e-3 * area, 1e-17);
    const double tolerance =
        std::string(facet) == "tri3" ? 3e-5 : 1e-17; // centroids integrate linear functions
    for (const double s : {0.0, 0.03, 0.31, 0.5, 0.98})
      EXPECT_NEAR(uniform.height(s, 1.0 - s), -1e-3, tolerance) << facet << ", s = " << s;
    for (std::size_t i = 0; i < uniform.areas.size(); ++i) ASSERT_EQ(uniform.lost(i), 0.0);

    Surface random_depth(d, 6, facet, 3, thickness, 0.3, {1.5, 0.8});
    double lost = 0.0;
    for (std::size_t i = 0; i < random_depth.areas.size(); ++i)
      lost += (random_depth.lost(i) = random.uniform(0.0, 1e-3)) * random_depth.areas[i];
    const std::vector<double> before = random_depth.state;
    ASSERT_EQ(random_depth.collect(thickness, &volume), ENTS_OK);
    EXPECT_NEAR(volume, lost, 1e-17);
    EXPECT_NEAR(-random_depth.integral() * (d == 2 ? thickness : 1.0), lost, 1e-16) << facet;
    for (std::size_t i = 0; i < before.size(); ++i) // nothing else in the states changes
      EXPECT_EQ(random_depth.state[i],
                i % random_depth.size() == static_cast<std::size_t>(random_depth.contact_layout().worn)
                    ? 0.0
                    : before[i]);
    const std::vector<double> once = random_depth.block;
    ASSERT_EQ(random_depth.collect(thickness, &volume), ENTS_OK); // nothing is left
    EXPECT_EQ(volume, 0.0);
    for (std::size_t i = 4; i < once.size(); ++i) EXPECT_EQ(random_depth.block[i], once[i]);
  }
}

// Areas are of the full turn, 2 pi r: a uniform depth is one again but for the curvature of r within a facet.
TEST(SlaveWear, AxisymmetricBodies) {
  Surface ring(2, 8, "line2", 4, 0.0);
  double area = 0.0;
  for (std::size_t i = 0; i < ring.areas.size(); ++i) ring.lost(i) = 1e-3, area += ring.areas[i];
  EXPECT_NEAR(area, two_pi / 2.0, 1e-14);
  ASSERT_EQ(ring.collect(0.0), ENTS_OK);
  for (const double r : {0.0, 0.1, 0.55, 1.0}) EXPECT_NEAR(ring.height(r, 0.0), -1e-3, 1e-17) << r;
}

// A point at whose place nothing is lost changes no bit of the field.
TEST(SlaveWear, WithoutAShareNoBitChanges) {
  Surface surface(3, 4, "quad4", 2, 1.0, 0.0);
  const std::vector<double> before = surface.block;
  double volume = 1.0;
  ASSERT_EQ(surface.collect(1.0, &volume), ENTS_OK);
  EXPECT_EQ(volume, 0.0);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(surface.block[i], before[i] + (i == 3 ? 1.0 : 0.0));
}

TEST(SlaveWear, SaysWhatIsWrong) {
  Surface good(3, 3, "quad4", 2, 1.0);
  for (std::size_t i = 0; i < good.areas.size(); ++i) good.lost(i) = 1e-3;
  const std::vector<double> state = good.state, block = good.block;
  ents_combination c = good.combination();
  ents_report report = ents::make<ents_report>();
  struct Arguments {
    const ents_model *contact, *surface;
    const double *coordinates, *positions, *areas;
    double* state;
    double thickness;
    std::int64_t stride, nodes, size;
    const char* name;
  };
  const Arguments right{good.contact.handle(),
                        good.model.handle(),
                        good.coordinates.data(),
                        good.positions.data(),
                        good.areas.data(),
                        good.state.data(),
                        1.0,
                        good.contact_layout().state_size,
                        16,
                        static_cast<std::int64_t>(block.size()),
                        "worn"};
  const auto expect = [&](const Arguments& a, std::int32_t wanted, const char* words) {
    const std::int32_t status = ents_wear_collect_slave(a.contact, a.surface, &c, a.coordinates, a.nodes,
                                                        a.positions, a.thickness, a.areas, a.state, a.stride,
                                                        a.name, good.block.data(), a.size, nullptr, &report);
    EXPECT_EQ(status, wanted) << report.message;
    EXPECT_NE(std::string(report.message).find(words), std::string::npos) << report.message;
    EXPECT_EQ(good.state, state) << words;
    EXPECT_EQ(good.block, block) << words;
  };
  const auto with = [&](auto change) {
    Arguments a = right;
    change(a);
    return a;
  };
  expect(with([](Arguments& a) { a.contact = nullptr; }), ENTS_NULL_ARGUMENT, "'model' is null");
  expect(with([](Arguments& a) { a.positions = nullptr; }), ENTS_NULL_ARGUMENT, "'positions' is null");
  expect(with([](Arguments& a) { a.areas = nullptr; }), ENTS_NULL_ARGUMENT, "'areas' is null");
  expect(with([](Arguments& a) { a.state = nullptr; }), ENTS_NULL_ARGUMENT, "'state' is null");
  expect(with([](Arguments& a) { a.name = "won"; }), ENTS_BAD_VALUE, "no field \"won\"");
  expect(with([](Arguments& a) { a.size = 5; }), ENTS_BAD_COUNT, "size = 5");
  expect(with([](Arguments& a) { a.stride = 1; }), ENTS_BAD_COUNT, "state_stride = 1");
  expect(with([](Arguments& a) { a.nodes = 9; }), ENTS_BAD_VALUE, "nodes are 0 .. 8");
  expect(with([](Arguments& a) { a.coordinates = nullptr; }), ENTS_BAD_VALUE, "give surface coordinates");
  expect(with([&](Arguments& a) { a.contact = good.model.handle(); }), ENTS_BAD_VALUE, "no wear");
  const Surface plane(2, 3, "line2", 2, 1.0);
  expect(with([&](Arguments& a) { a.contact = plane.contact.handle(); }), ENTS_BAD_VALUE,
         "'surface' is in 3D");
  std::vector<double> wrong = good.positions;
  wrong[0] = std::nan("");
  expect(with([&](Arguments& a) { a.positions = wrong.data(); }), ENTS_NON_FINITE, "positions[0] is NaN");
  wrong = good.positions;
  for (std::size_t i = 0; i < wrong.size(); ++i) wrong[i] = 0.0;
  expect(with([&](Arguments& a) { a.positions = wrong.data(); }), ENTS_DEGENERATE_SEGMENT, "has no area");
  const std::vector<double> same(good.coordinates.size(), 0.5);
  expect(with([&](Arguments& a) { a.coordinates = same.data(); }), ENTS_OUT_OF_RANGE,
         "per unit of the surface coordinates");
  wrong = good.areas;
  wrong[5] = std::nan("");
  expect(with([&](Arguments& a) { a.areas = wrong.data(); }), ENTS_OUT_OF_RANGE, "point 5");
  wrong = good.state;
  wrong[7 * good.size()] = 1.0;
  expect(with([&](Arguments& a) { a.state = wrong.data(); }), ENTS_BAD_STATE, "state of point 7");
  good.weights[3] += 1e-6;
  expect(right, ENTS_BAD_VALUE, "are no shape functions");
}

} // namespace
} // namespace laws::slave_wear_test
