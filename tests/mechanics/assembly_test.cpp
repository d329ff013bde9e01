// SPDX-License-Identifier: BSD-3-Clause
// The sum of all elements in a host's equations: against the sums written out.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "combination.hpp"
#include "scene.hpp"
#include "worst.hpp"

namespace mechanics::assembly_test {
namespace {

// A slave surface above a master surface, both drawn at random; points and control points over the nodes of
// both.
struct Case {
  const char* segment;
  bool slave_points;   // combinations of slave nodes
  bool control_points; // combinations of the master's nodes
  const char* contact;
};

constexpr const char* penalty = R"({"normal": {"type": "penalty", "stiffness": 3.0}})";
constexpr const char* multipliers =
    R"({"normal": {"type": "augmented_multiplier", "stiffness": 3.0}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 2.0}})";

constexpr const char* wear = // without friction not symmetric either
    R"({"normal": {"type": "penalty", "stiffness": 3.0}, "wear": {"coefficient": 0.5, "sliding": 0.1}})";

constexpr const char* friction =
    R"({"normal": {"type": "penalty", "stiffness": 3.0}, "friction": {"type": "coulomb", "coefficient": 0.3, "stiffness": 2.0}})";

class Assembly : public testing::TestWithParam<Case> {
protected:
  static constexpr std::int64_t count = 40;

  Assembly()
      : random_(17), surface_(draw_mesh(random_, basis_named(GetParam().segment), 4, 0.1)), model_(text()) {
    const auto d = static_cast<std::size_t>(model_.dimension());
    layout_.struct_size = sizeof layout_;
    ents_model_layout(model_.handle(), &layout_, nullptr);
    // The host's nodes: those of the slave, then those of the master.
    for (std::int64_t i = 0; i < slave_nodes(); ++i) {
      for (std::size_t k = 0; k + 1 < d; ++k) nodes_.push_back(random_.uniform(1.0, 7.0));
      nodes_.push_back(random_.uniform(-0.2, 0.1));
    }
    nodes_.insert(nodes_.end(), surface_.positions.begin(), surface_.positions.end());
    for (std::int64_t i = 0; i < count; ++i)
      if (GetParam().slave_points) {
        const double w = random_.uniform(0.2, 0.8);
        slave_.add({{i, w}, {(i + 1) % slave_nodes(), 1.0 - w}});
      } else {
        slave_.add({{i, 1.0}});
      }
    for (std::int64_t i = 0; i < surface_.nodes(); ++i)
      if (GetParam().control_points)
        control_.add({{slave_nodes() + i, 0.9}, {slave_nodes() + (i + 1) % surface_.nodes(), 0.1}});
      else
        control_.add({{slave_nodes() + i, 1.0}});
    // Every seventh dof of the first half is prescribed, so that there are elements with prescribed dofs and
    // without.
    const auto all = static_cast<std::int64_t>(nodes_.size());
    for (std::int64_t i = 0; i < all; ++i) equations_.push_back(i % 7 == 3 && i < all / 2 ? -1 : rows_++);
    for (std::int64_t i = 0; i < count * layout_.multipliers; ++i) multiplier_equations_.push_back(rows_++);
    multiplier_values_ = random_vector(count * layout_.multipliers, 0.0, 1.0);
    area_ = random_vector(count, 0.5, 1.5);
    detect();
    if (GetParam().contact != penalty) slide();
  }

  static std::string text() {
    return nlohmann::json{{"segment", GetParam().segment},
                          {"border", 0.3},
                          {"contact", nlohmann::json::parse(GetParam().contact)}}
        .dump();
  }
  static std::int64_t slave_nodes() { return count; }
  std::vector<double> random_vector(std::int64_t n, double low, double high) {
    std::vector<double> out;
    for (std::int64_t i = 0; i < n; ++i) out.push_back(random_.uniform(low, high));
    return out;
  }

  void detect() {
    const int d = model_.dimension();
    points_ = slave_.positions(d, nodes_);
    surface_.positions = control_.positions(d, nodes_);
    surface_.surface_coordinates.clear();
    Detector detector(model_, surface_);
    detector.detect(points_, 0.5, found_ = {});
  }

  // States of elements that were in contact, some of them a short way off, some farther.
  void slide() {
    const std::int64_t size = layout_.state_size;
    states_.resize(static_cast<std::size_t>(count * size));
    ASSERT_EQ(ents_state_init(model_.handle(), count, states_.data(), size, nullptr), ENTS_OK);
    const std::int64_t t = model_.parameters();
    for (std::int64_t e = 0; e < count; ++e) {
      double* state = &states_[static_cast<std::size_t>(e * size)];
      state[1] = 2.0; // stick; then age, xi, anchor, slip
      for (std::int64_t a = 0; a < t; ++a) {
        state[3 + a] = found_.xi[static_cast<std::size_t>(e * t + a)];
        const std::int64_t anchor = layout_.worn < 0 ? 3 + t : layout_.worn + 3;
        state[anchor + a] = state[3 + a] + random_.uniform(-0.2, 0.2);
      }
    }
  }

  ents_input input(const ents_master_mesh& mesh) {
    ents_input in{};
    in.struct_size = sizeof in;
    in.slave = points_.data(), in.slave_stride = model_.dimension();
    in.mesh = &mesh, in.segment = found_.segment.data(), in.segment_stride = 1;
    in.start = found_.xi.data(), in.start_stride = model_.parameters();
    in.area = area_.data(), in.area_stride = 1;
    if (layout_.multipliers > 0)
      in.multiplier = multiplier_values_.data(), in.multiplier_stride = layout_.multipliers;
    if (!states_.empty()) in.state_begin = states_.data(), in.state_begin_stride = layout_.state_size;
    return in;
  }

  // P^T R and P^T K P of all elements, full matrices.
  void expect(std::vector<double>& residual, std::vector<double>& tangent) {
    const auto n = static_cast<std::size_t>(layout_.dofs), rows = static_cast<std::size_t>(rows_);
    residual.assign(rows, 0.0), tangent.assign(rows * rows, 0.0);
    coupled_.assign(rows * rows, false);
    const ents_master_mesh mesh = surface_.mesh();
    const ents_input in = input(mesh);
    const std::size_t d = static_cast<std::size_t>(layout_.dimension),
                      first = n - static_cast<std::size_t>(layout_.multipliers);
    for (std::int64_t e = 0; e < count; ++e) {
      const std::int64_t segment = found_.segment[static_cast<std::size_t>(e)];
      if (segment < 0) continue;
      std::vector<double> R(n), K(n * n);
      ents_output out{};
      out.struct_size = sizeof out;
      out.wanted = ENTS_RESIDUAL | ENTS_TANGENT;
      out.residual = R.data() - e * layout_.dofs, out.residual_stride = layout_.dofs;
      out.tangent = K.data() - e * layout_.dofs * layout_.dofs,
      out.tangent_stride = layout_.dofs * layout_.dofs;
      ents_report report = new_report();
      ASSERT_EQ(ents_evaluate(model_.handle(), e, 1, &in, &out, &report), ENTS_OK) << report.message;
      // dof -> (row, weight)
      std::vector<std::vector<std::pair<std::int64_t, double>>> to(n);
      const auto point = [&](std::size_t dof, const Combination& c, std::int64_t i) {
        for (std::int64_t j = c.begin[static_cast<std::size_t>(i)];
             j < c.begin[static_cast<std::size_t>(i) + 1]; ++j)
          for (std::size_t k = 0; k < d; ++k)
            to[dof + k].push_back(
                {equations_[static_cast<std::size_t>(c.nodes[static_cast<std::size_t>(j)]) * d + k],
                 c.weights[static_cast<std::size_t>(j)]});
      };
      point(0, slave_, e);
      for (int a = 0; a < layout_.nodes; ++a)
        point(d * static_cast<std::size_t>(1 + a), control_,
              surface_.connectivity[static_cast<std::size_t>(segment * layout_.nodes + a)]);
      for (std::size_t j = first; j < n; ++j)
        to[j].push_back(
            {multiplier_equations_[static_cast<std::size_t>(e * layout_.multipliers) + j - first], 1.0});
      for (std::size_t i = 0; i < n; ++i)
        for (const auto& [row, v] : to[i]) {
          if (row < 0) continue;
          residual[static_cast<std::size_t>(row)] += v * R[i];
          for (std::size_t j = 0; j < n; ++j)
            for (const auto& [column, w] : to[j])
              if (column >= 0) {
                const std::size_t at =
                    static_cast<std::size_t>(row) * rows + static_cast<std::size_t>(column);
                tangent[at] += v * w * K[j * n + i];
                coupled_[at] = true;
              }
        }
    }
  }

  // Compressed rows that hold what the elements couple, and more; full: the same whatever the elements.
  template <class Index> struct Matrix {
    std::vector<Index> row_begin{0}, columns;
    std::vector<double> values;
  };
  template <class Index> Matrix<Index> pattern(bool full) const {
    Matrix<Index> out;
    for (std::int64_t i = 0; i < rows_; ++i) {
      for (std::int64_t j = 0; j < rows_; ++j)
        if (full || coupled_[static_cast<std::size_t>(i * rows_ + j)] || (i + j) % 3 == 0)
          out.columns.push_back(static_cast<Index>(j));
      out.row_begin.push_back(static_cast<Index>(out.columns.size()));
    }
    out.values.assign(out.columns.size(), 0.0);
    return out;
  }

  // Calls f with the host's equations.
  template <class Index, class F>
  auto with_system(Matrix<Index>& matrix, std::vector<double>& residual, std::vector<std::int64_t>* places,
                   F&& f) {
    const ents_combination slave = slave_.get(), control = control_.get();
    ents_system system{};
    system.struct_size = sizeof system;
    system.index_size = sizeof(Index);
    const std::int64_t d = layout_.dimension;
    if (GetParam().slave_points) system.slave = &slave;
    if (GetParam().control_points) system.master = &control;
    system.slave_nodes = static_cast<std::int64_t>(nodes_.size()) / d;
    system.slave_equations = equations_.data();
    system.master_nodes = GetParam().control_points ? system.slave_nodes : surface_.nodes();
    system.master_equations = equations_.data() + (GetParam().control_points ? 0 : slave_nodes() * d);
    system.multiplier_equations = multiplier_equations_.data();
    system.rows = rows_;
    system.residual = residual.data();
    system.row_begin = matrix.row_begin.data(), system.columns = matrix.columns.data(),
    system.values = matrix.values.data();
    const std::int64_t size = d * (1 + layout_.nodes) * (1 + layout_.nodes) + 1;
    if (places) {
      if (places->empty()) places->assign(static_cast<std::size_t>(count * size), 0);
      system.places = places->data(), system.places_size = size;
    }
    return f(system);
  }
  template <class Index>
  std::int32_t assemble(Matrix<Index>& matrix, std::vector<double>& residual,
                        std::vector<std::int64_t>* places, ents_report& report) {
    const ents_master_mesh mesh = surface_.mesh();
    const ents_input in = input(mesh);
    return with_system(matrix, residual, places, [&](const ents_system& system) {
      return ents_assemble(model_.handle(), 0, count, &in, nullptr, &system, &report);
    });
  }

  template <class Index> void expect_sums(std::vector<std::int64_t>* places) {
    std::vector<double> residual, tangent, assembled(static_cast<std::size_t>(rows_), 0.0);
    expect(residual, tangent);
    Matrix<Index> matrix = pattern<Index>(places != nullptr);
    ents_report report = new_report();
    ASSERT_EQ(assemble(matrix, assembled, places, report), ENTS_OK) << report.message;
    double force = 0.0, stiffness = 0.0, worst = 0.0;
    for (const double r : residual) test::raise(force, std::fabs(r));
    for (const double k : tangent) test::raise(stiffness, std::fabs(k));
    ASSERT_GT(force, 0.01);
    for (std::size_t i = 0; i < residual.size(); ++i)
      test::raise(worst, std::fabs(residual[i] - assembled[i]) / force);
    for (std::int64_t i = 0; i < rows_; ++i)
      for (Index at = matrix.row_begin[static_cast<std::size_t>(i)];
           at < matrix.row_begin[static_cast<std::size_t>(i) + 1]; ++at) {
        const auto k = static_cast<std::size_t>(at);
        const double expected = tangent[static_cast<std::size_t>(i * rows_ + matrix.columns[k])];
        test::raise(worst, std::fabs(matrix.values[k] - expected) / stiffness);
      }
    EXPECT_LT(worst, 1e-14); // the same products, added in another order
  }

  void expect_sums() {
    expect_sums<std::int32_t>(nullptr);
    expect_sums<std::int64_t>(nullptr);
    std::vector<std::int64_t> places;
    expect_sums<std::int64_t>(&places); // finds the places,
    expect_sums<std::int64_t>(&places); // uses them,
    for (std::size_t i = 0; i < static_cast<std::size_t>(slave_nodes() * layout_.dimension);
         i += static_cast<std::size_t>(layout_.dimension))
      nodes_[i] = 8.0 - nodes_[i];
    detect();
    if (GetParam().contact != penalty) slide();
    expect_sums<std::int64_t>(&places); // and finds others where the slaves are on other segments.
  }

  Random random_;
  MeshSurface surface_;
  Model model_;
  ents_layout layout_{};
  std::vector<double> nodes_, points_, area_, multiplier_values_, states_;
  Combination slave_, control_;
  std::vector<std::int64_t> equations_, multiplier_equations_;
  std::int64_t rows_ = 0;
  std::vector<bool> coupled_; // [rows][rows] by an element, as `expect` found
  Detector::Found found_;
};

TEST_P(Assembly, IsTheSumOfTheElements) { expect_sums(); }

// Tangents that are not symmetric
class AssemblyWithFriction : public Assembly {};
TEST_P(AssemblyWithFriction, IsTheSumOfTheElements) {
  std::vector<double> residual, tangent;
  expect(residual, tangent);
  double asymmetry = 0.0;
  for (std::size_t n = static_cast<std::size_t>(rows_), i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      test::raise(asymmetry, std::fabs(tangent[i * n + j] - tangent[j * n + i]));
  EXPECT_GT(asymmetry, 0.01);
  expect_sums();
}

TEST_P(Assembly, IterateIsDetectionAndAssembly) {
  std::vector<double> residual, tangent;
  expect(residual, tangent);
  Matrix<std::int32_t> one = pattern<std::int32_t>(true), two = one;
  std::vector<double> sum(residual.size(), 0.0), in_one(residual.size(), 0.0);
  ents_report report = new_report();
  ASSERT_EQ(assemble(one, sum, nullptr, report), ENTS_OK) << report.message;

  std::int64_t size = 0;
  ents_tree_size(model_.handle(), surface_.segments(), &size, nullptr);
  std::vector<double> tree(static_cast<std::size_t>(size)), xi(found_.xi.size()),
      gap(static_cast<std::size_t>(count), -7.0);
  const ents_master_mesh mesh = surface_.mesh();
  ASSERT_EQ(ents_tree_build(model_.handle(), &mesh, tree.data(), size, &report), ENTS_OK);
  std::vector<std::int64_t> segment(static_cast<std::size_t>(count), -1);
  std::vector<std::int32_t> flags(segment.size()), outcome(segment.size());
  ents_detection detection{};
  detection.struct_size = sizeof detection;
  detection.slave = points_.data(), detection.reach = 0.5;
  detection.segment = segment.data(), detection.xi = xi.data(), detection.flags = flags.data();
  ents_input in = input(mesh);
  in.slave = nullptr, in.mesh = nullptr, in.segment = nullptr, in.start = nullptr;
  in.positions_begin = mesh.positions;
  ents_output out{};
  out.struct_size = sizeof out;
  out.wanted = ENTS_GAP | ENTS_FLAGS;
  out.gap = gap.data(), out.gap_stride = 1, out.flags = outcome.data(), out.flags_stride = 1;
  const auto iterate = [&](const ents_system* system) {
    std::fill(segment.begin(), segment.end(), -1);
    return ents_iterate(model_.handle(), &mesh, tree.data(), size, 0, count, &detection, &in, &out, system,
                        &report);
  };
  with_system(two, in_one, nullptr,
              [&](const ents_system& system) { ASSERT_EQ(iterate(&system), ENTS_OK) << report.message; });
  EXPECT_EQ(segment, found_.segment);
  EXPECT_EQ(in_one, sum);
  EXPECT_EQ(one.values, two.values);
  for (std::size_t i = 0; i < segment.size(); ++i) {
    EXPECT_EQ(segment[i] < 0, (outcome[i] & ENTS_FLAG_OUTSIDE) != 0);
    EXPECT_NEAR(gap[i], segment[i] < 0 ? 0.0 : found_.gap[i], 1e-13);
  }
  std::fill(gap.begin(), gap.end(), -7.0);
  ASSERT_EQ(iterate(nullptr), ENTS_OK) << report.message; // results per element alone
  EXPECT_EQ(std::count(gap.begin(), gap.end(), -7.0), 0);
  in.mesh = &mesh;
  EXPECT_EQ(iterate(nullptr), ENTS_BAD_VALUE);
}

TEST_P(Assembly, NamesTheEntryThatThePatternLacks) {
  std::vector<double> residual, tangent, sum(static_cast<std::size_t>(rows_), 0.0);
  expect(residual, tangent);
  Matrix<std::int64_t> matrix = pattern<std::int64_t>(false);
  // Take an entry away that is in use.
  std::int64_t row = 0;
  std::size_t at = 0;
  for (std::int64_t i = 0; i < rows_; ++i)
    for (auto k = matrix.row_begin[static_cast<std::size_t>(i)];
         k < matrix.row_begin[static_cast<std::size_t>(i) + 1]; ++k)
      if (tangent[static_cast<std::size_t>(i * rows_ + matrix.columns[static_cast<std::size_t>(k)])] != 0.0)
        row = i, at = static_cast<std::size_t>(k);
  const auto column = matrix.columns[at];
  matrix.columns.erase(matrix.columns.begin() + static_cast<std::ptrdiff_t>(at));
  matrix.values.pop_back();
  for (auto i = static_cast<std::size_t>(row) + 1; i < matrix.row_begin.size(); ++i) --matrix.row_begin[i];
  ents_report report = new_report();
  EXPECT_EQ(assemble(matrix, sum, nullptr, report), ENTS_BAD_PATTERN);
  std::ostringstream entry;
  entry << "(" << row << ", " << column << ")";
  EXPECT_NE(std::string(report.message).find(entry.str()), std::string::npos) << report.message;
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  std::string name = info.param.segment;
  name.append(info.param.slave_points ? "_points" : "_nodes");
  if (info.param.control_points) name.append("_combined");
  if (info.param.contact == multipliers) name.append("_multipliers");
  if (info.param.contact == wear) name.append("_wear");
  if (info.param.contact == friction) name.append("_friction");
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Assembly,
    testing::Values(Case{"line2", false, false, penalty}, Case{"line2", true, false, multipliers},
                    Case{"catmull_rom4", true, true, penalty}, Case{"tri3", true, true, penalty},
                    Case{"quad4", false, false, penalty}, Case{"quad4", false, false, multipliers},
                    Case{"quad4", true, true, multipliers}, Case{"bspline16", false, true, penalty},
                    Case{"line2", false, false, wear}, Case{"quad4", false, false, wear}),
    case_name);
INSTANTIATE_TEST_SUITE_P(Kinds, AssemblyWithFriction,
                         testing::Values(Case{"quad4", false, false, friction},
                                         Case{"line2", false, false, friction},
                                         Case{"tri3", true, false, friction}),
                         case_name);

} // namespace
} // namespace mechanics::assembly_test
