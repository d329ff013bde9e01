// The IPC Toolkit's vertex before a triangle or an edge against tri3, quad4 and line2.
#include "peer_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <iomanip>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "bases.hpp"
#include "interleaved.hpp"
#include "ipc_pair.hpp"
#include "worst.hpp"

namespace bench {

namespace {

// Lengths are of order 1, gaps 0.02 and more: rounding, amplified by 50 in the direction, by 50^2 in second
// derivatives.
constexpr double tolerance = 1e-11;

using Pairs = std::vector<IpcPair>;

// The elements of a plain line2 or tri3 job as pairs, the slave node where it is. Velocity: with friction,
// from the point of the state's anchor to the projection, in a unit of time.
Pairs pairs_of(const Job& job) {
  const mechanics::Elements& all = job.elements();
  const std::size_t d = static_cast<std::size_t>(job.dimension());
  const mechanics::Basis& basis = mechanics::basis_named(d == 2 ? "line2" : "tri3");
  const std::vector<double> xi = job.projections();
  Pairs pairs;
  for (std::size_t e = 0; e < static_cast<std::size_t>(all.count); ++e) {
    const double* x = &all.master[d * d * e];
    std::array<double, 3> slip{};
    if (job.frictional()) {
      const std::vector<double> from = shape_values(basis, job.anchor(e)),
                                to = shape_values(basis, &xi[(d - 1) * e]);
      for (std::size_t i = 0; i < d; ++i)
        for (std::size_t c = 0; c < d; ++c) slip[c] += (to[i] - from[i]) * x[d * i + c];
    }
    pairs.emplace_back(static_cast<int>(d), &all.slave[d * e], x, all.area[e], job.stiffness(), slip.data(),
                       friction_coefficient);
  }
  return pairs;
}

// Clamped log barrier b(s) = -(s - s0)^2 ln(s / s0) of the squared distance s (Li et al. 2020, equation 6)
double barrier_slope(double s, double s0) { return (s0 - s) * (2.0 * std::log(s / s0) - s0 / s + 1.0); }
double barrier_curvature(double s, double s0) {
  return (s0 / s + 2.0) * s0 / s - 2.0 * std::log(s / s0) - 3.0;
}

double norm(const double* v, std::size_t size) {
  double sum = 0.0;
  for (std::size_t i = 0; i < size; ++i) sum += v[i] * v[i];
  return std::sqrt(sum);
}

struct Difference {
  double apart = 0.0, largest = 0.0;
  void add(double theirs, double expected) {
    test::raise(apart, std::abs(theirs - expected));
    test::raise(largest, std::abs(expected));
  }
  double relative() const { return apart / largest; }
};

// The energy of a plain element is E = k A gap^2 / 2, that of a pair k A b(gap^2): with residual R and
// tangent K of E its gradient is 2 b' R, its Hessian 2 b' K + 4 b'' / (k A) R R^T.
bool compare_barrier(std::ostream& out, const Job& job, const Pairs& pairs, const double* results) {
  const std::size_t n = static_cast<std::size_t>(job.dofs()), d = static_cast<std::size_t>(job.dimension());
  const double s0 = IpcPair::barrier_distance * IpcPair::barrier_distance;
  double gradient = 0.0, hessian = 0.0;
  for (std::size_t e = 0; e < pairs.size(); ++e) {
    const double *residual = results + n * e, *tangent = results + n * pairs.size() + n * n * e;
    const double stiffness = job.stiffness() * job.elements().area[e], gap = norm(residual, d) / stiffness;
    const double slope = barrier_slope(gap * gap, s0), curvature = barrier_curvature(gap * gap, s0);
    const std::vector<double> g = pairs[e].barrier_gradient(), h = pairs[e].barrier_hessian();
    Difference first, second;
    for (std::size_t i = 0; i < n; ++i) {
      first.add(g.at(i), 2.0 * slope * residual[i]);
      for (std::size_t j = 0; j < n; ++j)
        second.add(h.at(n * j + i), 2.0 * slope * tangent[n * i + j] +
                                        4.0 * curvature / stiffness * residual[i] * residual[j]);
    }
    test::raise(gradient, first.relative());
    test::raise(hessian, second.relative());
  }
  out << "IPC Toolkit on the same " << pairs.size() << " plain " << (d == 2 ? "line2" : "tri3")
      << ", frictionless: gradient differs by " << gradient << ", Hessian by " << hessian << "\n";
  return gradient <= tolerance && hessian <= tolerance;
}

// Nodal forces along the surface have the directions of theirs and, where both slide, the same ratio to the
// normal force. Only the library's have a part along the normal, too: its couple balances that of friction
// over the gap.
bool compare_friction(std::ostream& out, const Pairs& pairs, const double* results) {
  const std::size_t n = 12;
  double direction = 0.0, ratio = 0.0;
  int sliding = 0;
  for (std::size_t e = 0; e < pairs.size(); ++e) {
    const double* residual = results + n * e;
    const std::vector<double> g = pairs[e].barrier_gradient(), theirs = pairs[e].friction();
    const double their_normal = norm(g.data(), 3), their_tangential = norm(theirs.data(), 3);
    std::array<double, 12> along{};
    double normal = 0.0; // of the slave node
    for (std::size_t node = 4; node-- > 0;) {
      normal = 0.0;
      for (std::size_t c = 0; c < 3; ++c) normal += residual[3 * node + c] * g[c] / their_normal;
      for (std::size_t c = 0; c < 3; ++c)
        along[3 * node + c] = residual[3 * node + c] - normal * g[c] / their_normal;
    }
    const double tangential = norm(along.data(), 3);
    Difference apart;
    for (std::size_t i = 0; i < n; ++i) apart.add(-theirs[i] / their_tangential, along[i] / tangential);
    test::raise(direction, apart.relative());
    const double limit = friction_coefficient * (1.0 - 1e-9);
    const double ours = tangential / std::abs(normal), other = their_tangential / their_normal;
    if (ours < limit || other < limit) continue;
    ++sliding;
    test::raise(ratio, std::abs(ours - other) / friction_coefficient);
  }
  out << "with friction (" << sliding << " slide in both): directions along the surface differ by "
      << direction << ", ratio to the normal force by " << ratio << "\n";
  return sliding > 0 && direction <= tolerance && ratio <= tolerance;
}

struct Peer {
  std::string name;
  std::function<void(const IpcPair&)> run;
  bool rows = true; // else only its time is wanted
};

// Rows of each peer that wants them; returns the peers' nanoseconds.
std::vector<double> print_rows(std::ostream& out, const Pairs& pairs, const std::vector<Peer>& peers,
                               const std::vector<std::pair<std::string, std::string>>& ours) {
  std::deque<Job> jobs; // single, of 64 of each
  std::vector<std::function<void()>> pieces;
  std::vector<double> counts;
  for (const Peer& peer : peers) {
    pieces.push_back([&pairs, &peer] {
      for (const IpcPair& pair : pairs) peer.run(pair);
    });
    counts.push_back(static_cast<double>(pairs.size()));
  }
  for (const auto& [basis, variant] : ours)
    for (const Call call : {Call::single, Call::batch}) {
      jobs.emplace_back(Case{basis, variant, "RK", call});
      pieces.push_back(calls(jobs.back()));
      counts.push_back(static_cast<double>(jobs.back().elements().count));
    }
  std::vector<double> each = interleaved_seconds(pieces);
  for (std::size_t k = 0; k < each.size(); ++k) each[k] *= 1e9 / counts[k];
  for (std::size_t p = 0; p < peers.size(); ++p) {
    if (!peers[p].rows) continue;
    out << peers[p].name << "\n";
    for (std::size_t k = 0; k < ours.size(); ++k) {
      const std::string& variant = ours[k].second;
      const std::string name = "  " + ours[k].first + " " + variant.substr(0, variant.find('_')) +
                               (variant.find('_') == std::string::npos ? "" : ", Coulomb");
      print_peer_row(out, name, each[peers.size() + 2 * k], each[peers.size() + 2 * k + 1], each[p]);
    }
  }
  each.resize(peers.size());
  return each;
}

} // namespace

bool print_ipc(std::ostream& out) {
  Job tri3({"tri3", "plain", "RK", Call::single}), line2({"line2", "plain", "RK", Call::single}),
      coulomb({"tri3", "plain_coulomb", "RK", Call::single});
  for (Job* job : {&tri3, &line2, &coulomb}) std::invoke(calls(*job));
  const Pairs faces = pairs_of(tri3), edges = pairs_of(line2), sliding = pairs_of(coulomb);

  out << "residual and tangent, projection included; ns per element (thread CPU time, medians in turns)\n"
         "IPC Toolkit: BarrierPotential and FrictionPotential of a pair that is found already, Hessians "
         "not projected, the penetration taken for a distance; "
      << peers_compiled << "\n\n";
  print_peer_head(out, "IPC");
  print_rows(
      out, faces,
      {{"vertex and face: barrier's gradient and Hessian", [](const IpcPair& pair) { pair.barrier(); }}},
      {{"tri3", "plain"}, {"tri3", "enriched"}, {"quad4", "plain"}, {"quad4", "enriched"}});
  print_rows(out, edges,
             {{"vertex and edge, in the plane: barrier's gradient and Hessian",
               [](const IpcPair& pair) { pair.barrier(); }}},
             {{"line2", "plain"}, {"line2", "enriched"}});
  const std::vector<double> parts = print_rows(
      out, sliding,
      {{"vertex and face: barrier's gradient and Hessian, friction force, its Jacobians by velocities and "
        "displacements",
        [](const IpcPair& pair) {
          pair.barrier();
          pair.friction_force();
          pair.jacobian_by_velocities();
          pair.jacobian_by_displacements();
        }},
       {"vertex and face: barrier's and lagged friction's gradient and Hessian (no derivatives of "
        "the normal force and of the basis)",
        [](const IpcPair& pair) {
          pair.barrier();
          pair.lagged_friction();
        }},
       {"", [](const IpcPair& pair) { pair.barrier(); }, false},
       {"", [](const IpcPair& pair) { pair.friction_force(); }, false},
       {"", [](const IpcPair& pair) { pair.jacobian_by_velocities(); }, false},
       {"", [](const IpcPair& pair) { pair.jacobian_by_displacements(); }, false},
       {"", [](const IpcPair& pair) { pair.lagged_friction(); }, false}},
      {{"tri3", "plain_coulomb"},
       {"tri3", "enriched_coulomb"},
       {"quad4", "plain_coulomb"},
       {"quad4", "enriched_coulomb"}});
  out << std::setprecision(0) << "\nvertex and face, parts: barrier " << parts[2] << ", friction force "
      << parts[3] << ", its Jacobian by velocities " << parts[4] << ", by displacements " << parts[5]
      << ", lagged friction " << parts[6] << "\n\n"
      << std::scientific << std::setprecision(1);
  bool same = compare_barrier(out, tri3, faces, tri3.results());
  same = compare_barrier(out, line2, edges, line2.results()) && same;
  same = compare_friction(out, sliding, coulomb.results()) && same;
  if (!same) out << "that is more than " << tolerance << ": not the same contact\n";
  return same;
}

} // namespace bench
