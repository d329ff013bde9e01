// CalculiX's contact spring against a quad4.
#include "peer_tables.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "calculix.hpp"
#include "interleaved.hpp"
#include "worst.hpp"

namespace bench {

namespace {

// CalculiX finds the projection by refining a grid down to 1e-8 of natural coordinates; lengths and
// curvatures are of order 1 here.
constexpr double tolerance = 1e-6;
// Its friction neglects what is of the order of (gap + slip) curvature: (0.06 + 0.05) times 0.08 / 0.75^2,
// doubled.
constexpr double tolerance_with_friction = 3e-2;

// The elements of a job as CalculiX's springs. Slip: from the point of the state's anchor to the projection.
std::vector<CalculixSpring> springs_of(const Job& job) {
  const mechanics::Elements& all = job.elements();
  const std::vector<double> xi = job.projections();
  std::vector<CalculixSpring> springs;
  for (std::size_t e = 0; e < static_cast<std::size_t>(all.count); ++e) {
    const double* x = &all.master[12 * e];
    double slip[3] = {};
    if (job.frictional()) {
      const double *anchor = job.anchor(e), *at = &xi[2 * e];
      const auto weight = [](const double* p, int i) {
        constexpr double sign_1[4] = {-1, 1, 1, -1}, sign_2[4] = {-1, -1, 1, 1};
        return 0.25 * (1.0 + sign_1[i] * p[0]) * (1.0 + sign_2[i] * p[1]);
      };
      for (int i = 0; i < 4; ++i)
        for (int c = 0; c < 3; ++c) slip[c] += (weight(at, i) - weight(anchor, i)) * x[3 * i + c];
    }
    springs.emplace_back(&all.slave[3 * e], x, all.area[e], job.stiffness(), slip,
                         job.frictional() ? friction_coefficient : 0.0, friction_stiffness);
  }
  return springs;
}

struct Difference {
  double force, stiffness;
};

// Largest differences relative to the largest entry of the element. Dofs here: slave first; in CalculiX last.
Difference difference(const Job& job, const std::vector<CalculixSpring>& springs, const double* results) {
  Difference worst{0.0, 0.0};
  const auto compare = [](double& relative, double apart, double largest) {
    if (apart != 0.0) test::raise(relative, apart / largest);
  };
  for (std::size_t e = 0; e < springs.size(); ++e) {
    const double *residual = results + 15 * e, *tangent = results + 15 * springs.size() + 225 * e;
    const auto place = [](int dof) { return dof < 12 ? dof + 3 : dof - 12; };
    double apart = 0.0, largest = 0.0, apart_2 = 0.0, largest_2 = 0.0;
    for (int j = 0; j < 15; ++j) {
      const double force = j < 12 ? springs[e].master_force(j / 3)[j % 3] : springs[e].slave_force()[j - 12];
      test::raise(apart, std::abs(force - residual[place(j)]));
      test::raise(largest, std::abs(residual[place(j)]));
      for (int i = 0; i < (job.frictional() ? 15 : j + 1); ++i) {
        const double k = tangent[15 * place(j) + place(i)];
        test::raise(apart_2, std::abs(springs[e].stiffness(i, j) - k));
        test::raise(largest_2, std::abs(k));
      }
    }
    compare(worst.force, apart, largest);
    compare(worst.stiffness, apart_2, largest_2);
  }
  return worst;
}

} // namespace

bool print_calculix(std::ostream& out) {
  out << "residual and tangent of a quad4, projection included; ns per element (thread CPU time, medians in "
         "turns)\n"
         "CalculiX: springforc_n2f and springstiff_n2f, penalty, flat or bent quadrilateral without a "
         "height; "
      << peers_compiled << "\n\n";
  print_peer_head(out, "CalculiX");
  bool same = true;
  std::string agreement;
  for (const bool friction : {false, true}) {
    const std::string coulomb = friction ? "_coulomb" : "";
    Job plain({"quad4", "plain" + coulomb, "RK", Call::single}),
        plain_64({"quad4", "plain" + coulomb, "RK", Call::batch}),
        enriched({"quad4", "enriched" + coulomb, "RK", Call::single}),
        enriched_64({"quad4", "enriched" + coulomb, "RK", Call::batch});
    std::vector<CalculixSpring> springs = springs_of(plain);
    const std::function<void()> calculix = [&springs] {
      for (CalculixSpring& spring : springs) spring.run();
    };
    calculix();
    const Difference d = difference(plain, springs, plain.results());
    same = same && d.force <= (friction ? tolerance_with_friction : tolerance) &&
           d.stiffness <= (friction ? tolerance_with_friction : tolerance);
    const auto slipping = std::count_if(springs.begin(), springs.end(),
                                        [](const CalculixSpring& spring) { return spring.slips(); });
    std::ostringstream line;
    line << "CalculiX on the same " << springs.size() << " plain quad4, "
         << (friction ? "with friction" : "frictionless");
    if (friction) line << " (" << slipping << " slip)";
    line << std::scientific << std::setprecision(1) << ": force differs by " << d.force << ", stiffness by "
         << d.stiffness << "\n";
    agreement += line.str();

    const std::vector<double> seconds =
        interleaved_seconds({calculix, calls(plain), calls(plain_64), calls(enriched), calls(enriched_64)});
    const auto each = [&](std::size_t k, const Job& job) {
      return 1e9 * seconds[k] / static_cast<double>(job.elements().count);
    };
    const double theirs = each(0, plain);
    print_peer_row(out, friction ? "plain, Coulomb" : "plain, frictionless", each(1, plain),
                   each(2, plain_64), theirs);
    print_peer_row(out, friction ? "enriched, Coulomb" : "enriched, frictionless", each(3, enriched),
                   each(4, enriched_64), theirs);
  }
  out << "\n" << agreement;
  if (!same)
    out << std::scientific << "that is more than " << tolerance << " or, with friction, "
        << tolerance_with_friction << ": not the same contact\n";
  return same;
}

} // namespace bench
