// SPDX-License-Identifier: BSD-3-Clause
#include "chart/careful_host.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <Eigen/LU>

#include "chart/master_check.hpp"
#include "spectrum.hpp"

namespace host::chart {
namespace {

constexpr int most_iterations = 25;
constexpr int most_halvings = 6; // of a nominal increment

/// Where the node is, and on which branch.
struct State {
  Vec x;
  std::int64_t segment = -1;
  double xi[2] = {0, 0};
  bool closed = false;
  bool soft = false; ///< the contact takes away stiffness: an instability may be near
};

/// The contact at a trial position.
struct Contact {
  Vec force;
  Mat tangent;
  bool closed = false;
};

/// Why an increment failed.
struct Obstacle {
  End end = End::diverged;
  std::int32_t status = 0;
};

class CarefulHost {
public:
  CarefulHost(const EntsLibrary& library, const Press& press, const Rules& rules)
      : library_(library), press_(press), rules_(rules) {}

  Outcome run() {
    const double each = press_.dimension == 3 ? 16 : 32; // samples of a wave
    const int per_segment =
        press_.height.is_null() ? 1 : static_cast<int>(std::ceil(each / press_.wavelength));
    model_ = std::make_unique<EntsModel>(library_, model_text(press_, 0), "", "chart");
    points_ = sample_master(*model_, press_, per_segment);
    if (rules_.check || rules_.reach) {
      const MasterCheck check = check_master(*model_, press_, points_);
      if (rules_.check && !admissible(check)) return outcome_;
      if (rules_.reach && press_.method.projection == ProjectionKind::normal && std::isfinite(check.reach)) {
        limit_ = check.reach;
        model_ = std::make_unique<EntsModel>(library_, model_text(press_, limit_), "", "chart");
      }
    }
    const double size = segment_size();
    longest_move_ = std::min(quarter_wave(per_segment), size);
    if (!std::isfinite(limit_)) limit_ = size; // what the element assumes if nothing is said
    if (press_.method.tangent == TangentKind::small_gap) {
      Press exact = press_;
      exact.method.tangent = TangentKind::consistent;
      exact_ = std::make_unique<EntsModel>(library_, model_text(exact, limit_), "", "chart");
    }
    describe_mesh();
    walk();
    return outcome_;
  }

private:
  bool admissible(const MasterCheck& check) {
    End& end = outcome_.end;
    if (check.degenerate || check.fold >= 1)
      end = End::fold;
    else if (press_.local && check.edge_height > 1e-9)
      end = End::edge; // of segments of length 1: rounding
    else if (check.crossing)
      end = End::crossing;
    else if (check.shadow <= 0)
      end = End::self_shadow;
    return end == End::solved;
  }

  /// A quarter of the shortest wave, as it is on rho_e: a height above a hollow segment shortens it.
  double quarter_wave(int per_segment) const {
    const double quarter = 0.25 * press_.wavelength;
    if (press_.height.is_null()) return quarter;
    const auto d = static_cast<std::size_t>(press_.dimension);
    const auto stride = static_cast<std::size_t>(std::lround(quarter * per_segment));
    const std::size_t row = static_cast<std::size_t>(per_segment) + 1,
                      rows = points_.point.size() / (d * row);
    double least = quarter;
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i + stride < row; ++i) {
        double square = 0;
        for (std::size_t k = 0; k < d; ++k) {
          const double* point = points_.point.data() + (j * row + i) * d + k;
          square += std::pow(point[stride * d] - point[0], 2);
        }
        least = std::min(least, std::sqrt(square));
      }
    return least;
  }

  double segment_size() const {
    double least = INFINITY;
    for (std::int64_t s = 0; s < press_.row.segments(); ++s) {
      const std::vector<double> nodes = segment_nodes(press_, s);
      const auto d = static_cast<std::size_t>(press_.dimension), m = nodes.size() / d;
      const std::size_t first = d * (m == 16            ? 5
                                     : m == 4 && d == 2 ? 1
                                                        : 0); // of the segment's own two nodes
      double square = 0;
      for (std::size_t k = 0; k < d; ++k) square += std::pow(nodes[first + d + k] - nodes[first + k], 2);
      least = std::min(least, std::sqrt(square));
    }
    return least;
  }

  void describe_mesh() {
    const SegmentRow& row = press_.row;
    mesh_ = ents_struct<ents_master_mesh>();
    mesh_.segments = row.segments();
    mesh_.connectivity = row.connectivity.data();
    mesh_.nodes = static_cast<std::int64_t>(row.positions.size()) / press_.dimension;
    mesh_.positions = row.positions.data();
    mesh_.surface_coordinates = row.surface_coordinates.empty() ? nullptr : row.surface_coordinates.data();
    std::int64_t size = 0;
    require(library_.tree_size(model_->get(), mesh_.segments, &size, &report_));
    tree_.resize(static_cast<std::size_t>(size));
    require(library_.tree_build(model_->get(), &mesh_, tree_.data(), size, &report_));
  }

  void require(std::int32_t status) const {
    if (status != ENTS_OK) throw JobError("chart: " + describe(library_, status, report_));
  }

  /// Nominal increments; what fails is halved, what succeeds is doubled again.
  void walk() {
    State state;
    state.x = press_.anchor(0);
    constexpr int whole = 1 << most_halvings;
    const int end = press_.increments * whole;
    int at = 0, length = whole;
    while (at < end) {
      State next = state;
      const double from = static_cast<double>(at) / end, to = static_cast<double>(at + length) / end;
      std::optional<Obstacle> obstacle = attempt(to, state, next);
      if (!obstacle && rules_.stable && (state.soft || next.soft) && !halves_agree(from, to, state, next))
        obstacle = Obstacle{End::unstable};
      if (obstacle) {
        if (length == 1) {
          outcome_.end = obstacle->end, outcome_.status = obstacle->status;
          return;
        }
        length /= 2;
        ++outcome_.cuts;
        continue;
      }
      state = next;
      at += length;
      if (at % whole == 0) outcome_.levels.push_back({at / whole, state.x});
      if (length < whole && at % (2 * length) == 0) length *= 2;
    }
  }

  /// Newton's method from `begin` at the load t.
  std::optional<Obstacle> attempt(double t, const State& begin, State& next) {
    const Vec anchor = press_.anchor(t);
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      Contact contact;
      if (const auto obstacle = touch(begin, next, contact)) return obstacle;
      ++outcome_.iterations;
      const Vec spring = press_.spring().cwiseProduct(next.x - anchor), residual = spring + contact.force;
      const Mat tangent = Mat(press_.spring().asDiagonal()) + contact.tangent;
      // relative to the forces, or to those of a hundredth of a segment
      const double scale = std::max({spring.norm(), contact.force.norm(), 0.01});
      // positions of order 1 have a rounding of 1e-16, which the penalty turns into a force
      if (residual.norm() <= 1e-10 * scale + 1e-15 * press_.penalty) return judge(begin, next);
      Vec step = -tangent.partialPivLu().solve(residual);
      if (!step.allFinite()) return Obstacle{End::diverged};
      if (rules_.move && step.norm() > longest_move_) step *= longest_move_ / step.norm();
      next.x += step;
      if (!(next.x.norm() < 1e3)) return Obstacle{End::diverged};
    }
    return Obstacle{End::diverged};
  }

  /// May a converged increment be believed? Whatever tangent Newton's method took, stability is a matter of
  /// the exact one.
  std::optional<Obstacle> judge(const State& begin, State& next) {
    if (rules_.move && (next.x - begin.x).norm() > longest_move_) return Obstacle{End::jump};
    next.soft = false;
    if (!rules_.stable || !next.closed) return std::nullopt;
    const Mat body = press_.spring().asDiagonal();
    const Spectrum spectrum = spectrum_of(Mat(body + exact_tangent(next)));
    const double least = spectrum.values[0];
    if (!(least > 0)) return Obstacle{End::unstable};
    const Vec mode = spectrum.vectors.col(0);
    next.soft = least < 0.75 * mode.dot(body * mode);
    return std::nullopt;
  }

  /// Near an instability there are two ways to go, and a long step may take the wrong one: the two halves of
  /// the increment must end where the whole one does.
  bool halves_agree(double from, double to, const State& begin, const State& whole) {
    State first = begin, second;
    if (attempt(0.5 * (from + to), begin, first)) return false;
    second = first;
    return !attempt(to, first, second) &&
           (second.x - whole.x).norm() < 1e-6; // of a segment; ways part by much more
  }

  Mat exact_tangent(const State& state) const {
    auto input = ents_struct<ents_input>();
    input.slave = state.x.data(), input.mesh = &mesh_, input.segment = &state.segment, input.start = state.xi;
    auto output = ents_struct<ents_output>();
    const auto d = press_.dimension;
    double tangent[9];
    output.wanted = ENTS_TANGENT, output.tangent = tangent;
    auto report = ents_struct<ents_report>();
    const EntsModel& model = exact_ ? *exact_ : *model_;
    if (library_.evaluate(model.get(), 0, 1, &input, &output, &report) != ENTS_OK)
      return Mat::Constant(d, d, NAN);
    return Eigen::Map<const Eigen::MatrixXd>(tangent, d, d);
  }

  /// Detection and contact at next.x. The branch is that of the begin of the increment, whatever the iterates
  /// did.
  std::optional<Obstacle> touch(const State& begin, State& next, Contact& contact) {
    const auto d = press_.dimension;
    contact.force = Vec::Zero(d), contact.tangent = Mat::Zero(d, d);
    const bool follow = begin.segment >= 0 && (begin.closed || !rules_.anew);
    if (const auto obstacle = detect(begin, follow, next, contact)) return obstacle;
    if (follow && rules_.anew && !contact.closed) return detect(begin, false, next, contact);
    return std::nullopt;
  }

  std::optional<Obstacle> detect(const State& begin, bool follow, State& next, Contact& contact) {
    next.segment = follow ? begin.segment : -1;
    std::copy(begin.xi, begin.xi + 2, next.xi);
    next.closed = contact.closed = false;
    double gap = 0;
    std::int32_t flags = 0;
    auto detection = ents_struct<ents_detection>();
    detection.slave = next.x.data();
    detection.reach = 10;                                         // the whole row
    detection.permitted = ENTS_FLAG_LEFT | ENTS_FLAG_BEHIND_EDGE; // looked at below
    detection.segment = &next.segment, detection.xi = next.xi, detection.gap = &gap, detection.flags = &flags;
    require(library_.detect(model_->get(), &mesh_, tree_.data(), static_cast<std::int64_t>(tree_.size()), 0,
                            1, &detection, &report_));
    if (next.segment < 0)
      return rules_.behind && (flags & ENTS_FLAG_BEHIND_EDGE) ? std::optional(Obstacle{End::behind})
                                                              : std::nullopt;
    if (gap >= 0) return std::nullopt;
    if (rules_.flags && (flags & ENTS_FLAG_AMBIGUOUS)) return Obstacle{End::ambiguous};
    return evaluate(next, contact);
  }

  /// The element's own force and tangent, or those built from gap and gradient.
  std::optional<Obstacle> evaluate(State& next, Contact& contact) {
    auto input = ents_struct<ents_input>();
    input.slave = next.x.data();
    input.mesh = &mesh_;
    input.segment = &next.segment;
    input.start = next.xi;
    const auto d = static_cast<std::size_t>(press_.dimension);
    double gap = 0, xi[2], gradient[3], normal[3], residual[3], tangent[9];
    std::int32_t flags = 0;
    auto output = ents_struct<ents_output>();
    const bool own = press_.method.tangent == TangentKind::first_variation;
    output.wanted = ENTS_XI | ENTS_GAP | ENTS_FLAGS |
                    (own ? ENTS_GAP_GRADIENT | ENTS_NORMAL : ENTS_RESIDUAL | ENTS_TANGENT);
    output.xi = xi, output.gap = &gap, output.flags = &flags, output.gap_gradient = gradient,
    output.normal = normal;
    output.residual = residual, output.tangent = tangent;
    const std::int32_t status = library_.evaluate(model_->get(), 0, 1, &input, &output, &report_);
    if (status < 0) require(status);
    if (status > 0) return Obstacle{End::status, status};
    if (own) {
      // what the element refuses, a host that builds its own has to refuse itself
      if (rules_.reach && -gap > limit_) return Obstacle{End::status, ENTS_DEEP_PENETRATION};
      if (rules_.flags && (flags & ENTS_FLAG_FAR_SIDE)) return Obstacle{End::ambiguous};
      if (rules_.flags && press_.method.projection == ProjectionKind::shadow && normal[d - 1] <= 1e-6)
        return Obstacle{End::status, ENTS_GRAZING_RAY};
    }
    contact.closed = next.closed =
        gap < 0 && (own ? !(flags & ENTS_FLAG_OUTSIDE) : (flags & ENTS_FLAG_CONTACT) != 0);
    std::copy(xi, xi + d - 1, next.xi);
    if (!contact.closed) return std::nullopt;
    for (std::size_t i = 0; i < d; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      contact.force[row] = own ? press_.penalty * gap * gradient[i] : residual[i];
      for (std::size_t j = 0; j < d; ++j)
        contact.tangent(row, static_cast<Eigen::Index>(j)) =
            own ? press_.penalty * gradient[i] * gradient[j] : tangent[j * d + i];
    }
    return std::nullopt;
  }

  const EntsLibrary& library_;
  const Press& press_;
  Rules rules_;
  std::unique_ptr<EntsModel> model_,
      exact_; ///< exact_: with the consistent tangent, if model_ has another one
  MasterPoints points_;
  ents_master_mesh mesh_{};
  std::vector<double> tree_;
  double limit_ = INFINITY;        ///< of penetration
  double longest_move_ = INFINITY; ///< in an increment
  ents_report report_ = ents_struct<ents_report>();
  Outcome outcome_;
};

} // namespace

const char* word(End end) {
  switch (end) {
  case End::solved:
    return "solved";
  case End::fold:
    return "rho_e folds (check: |h| kappa >= 1)";
  case End::edge:
    return "torn (check: h at the edges)";
  case End::self_shadow:
    return "self-shadow (check: n_e . e)";
  case End::crossing:
    return "rho_e crosses itself (host)";
  case End::status:
    return "status";
  case End::ambiguous:
    return "ambiguous (flag of ents_detect or ents_evaluate)";
  case End::behind:
    return "behind a corner (host)";
  case End::jump:
    return "jumps (host: moves too far)";
  case End::unstable:
    return "unstable (host: tangent not positive, or halves of a step end elsewhere)";
  case End::diverged:
    break;
  }
  return "diverged";
}

bool is_flag(End end) { return end != End::solved && end != End::diverged; }

Outcome solve(const EntsLibrary& library, const Press& press, const Rules& rules) {
  return CarefulHost(library, press, rules).run();
}

} // namespace host::chart
