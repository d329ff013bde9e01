#include "differentiation.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "cases.hpp"
#include "differentiated.hpp"
#include "interleaved.hpp"
#include "worst.hpp"

namespace bench {

namespace {

// The library and its peers evaluate the same numbers in another order: some 1e-13. A derivative that is
// missing is no rounding.
constexpr double tolerance = 1e-9;

// The elements of a job, evaluated with another library's numbers.
class Differentiated {
public:
  Differentiated(const Job& job, DifferentiatedElement element)
      : element_(element), count_(static_cast<std::size_t>(job.elements().count)),
        dofs_(static_cast<std::size_t>(job.dofs())), results_(count_ * dofs_ * (dofs_ + 1)) {
    const mechanics::Elements& all = job.elements();
    for (std::size_t e = 0; e < count_; ++e) {
      DifferentiationInput in{};
      in.slave = &all.slave[e * all.slave.size() / count_];
      in.master = &all.master[e * all.master.size() / count_];
      in.start = &all.start[e * all.start.size() / count_];
      in.area = all.area[e];
      in.stiffness = job.stiffness();
      if (!job.height().is_null()) {
        in.amplitude = job.height().at("amplitude");
        in.phase = job.height().at("phase").get<double>() / (2.0 * std::numbers::pi);
        const std::vector<double> waves = job.height().at("wave_vector");
        std::copy(waves.begin(), waves.end(), in.wave_vector);
      }
      inputs_.push_back(in);
    }
  }
  void run() {
    for (std::size_t e = 0; e < count_; ++e)
      element_(inputs_[e], residual() + e * dofs_, tangent() + e * dofs_ * dofs_);
    asm volatile("" : : "r"(results_.data()) : "memory");
  }
  // Largest difference of an element's residual or tangent, relative to its largest entry
  double difference(const double* results) {
    double worst = 0.0;
    for (const std::size_t size : {dofs_, dofs_ * dofs_}) {
      const double* mine = size == dofs_ ? residual() : tangent();
      for (std::size_t e = 0; e < count_; ++e, mine += size, results += size) {
        double apart = 0.0, largest = 0.0;
        for (std::size_t i = 0; i < size; ++i) {
          test::raise(apart, std::abs(mine[i] - results[i]));
          test::raise(largest, std::abs(results[i]));
        }
        if (apart != 0.0) test::raise(worst, apart / largest);
      }
    }
    return worst;
  }

private:
  double* residual() { return results_.data(); }
  double* tangent() { return results_.data() + count_ * dofs_; }

  DifferentiatedElement element_;
  std::size_t count_, dofs_;
  std::vector<DifferentiationInput> inputs_;
  std::vector<double> results_;
};

struct Peer {
  const char* name;
  DifferentiatedElement (*element_of)(const char* basis, bool enriched);
  const char* absent;
};
constexpr Peer peers[] = {{"Sacado", element_of_sacado,
                           "Sacado is not in this program: its headers were not found when it was built (sh "
                           "examples/setup.sh --with libtrilinos-sacado-dev)"},
                          {"Eigen", element_of_eigen,
                           "Eigen's AutoDiffScalar is not in this program: its headers were not found when "
                           "it was built (sh examples/setup.sh --with libeigen3-dev)"}};

#ifdef ENTS_BENCH_NATIVE
constexpr char compiled[] = "compiled for this machine (-DENTS_BENCH_NATIVE=OFF: as the library is)";
#else
constexpr char compiled[] = "compiled as the library is (-DENTS_BENCH_NATIVE=ON: for this machine)";
#endif

std::ostream& number(std::ostream& out, double value, int width, int digits) {
  if (std::isnan(value)) return out << std::setw(width) << "-";
  return out << std::setw(width) << std::fixed << std::setprecision(digits) << value;
}

} // namespace

bool run_differentiation(std::ostream& out) {
  out << "residual and tangent, frictionless penalty, deformable master; ns per element (thread CPU time, "
         "medians in turns)\n"
         "closed form: the library. Automatic: the same residual written by hand, projection in double "
         "precision by the library's iteration,\n"
         "one step of Newton's method in numbers that carry all derivatives; inputs are not checked;\n"
      << compiled << "\n";
  for (const Peer& peer : peers)
    if (peer.element_of("line2", false) == nullptr) out << peer.absent << "\n";
  out << "\n"
      << std::left << std::setw(18) << "" << std::right << std::setw(20) << "closed form" << std::setw(22)
      << "automatic" << std::setw(26) << "fastest / closed form" << std::setw(14) << "largest\n"
      << std::left << std::setw(18) << "" << std::right << std::setw(10) << "single" << std::setw(10)
      << "of 64" << std::setw(12) << peers[0].name << std::setw(10) << peers[1].name << std::setw(16)
      << "single" << std::setw(10) << "of 64" << std::setw(14) << "difference\n";
  bool same = true;
  for (const char* basis : {"line2", "tri3", "quad4", "quad9"})
    for (const bool enriched : {false, true}) {
      const char* variant = enriched ? "enriched" : "plain";
      Job single({basis, variant, "RK", Call::single}), many({basis, variant, "RK", Call::batch});
      const double singles = static_cast<double>(single.elements().count);
      std::vector<std::function<void()>> pieces{[&] {
                                                  for (std::int64_t e = 0; e < single.elements().count; ++e)
                                                    single.run();
                                                  asm volatile("" : : "r"(single.results()) : "memory");
                                                },
                                                [&] {
                                                  many.run();
                                                  asm volatile("" : : "r"(many.results()) : "memory");
                                                }};
      std::vector<Differentiated> automatic;
      for (const Peer& peer : peers)
        if (const auto element = peer.element_of(basis, enriched)) automatic.emplace_back(single, element);
      double difference = 0.0;
      for (Differentiated& elements : automatic) {
        elements.run();
        const double d = elements.difference(single.results());
        if (!(d <= difference)) difference = d;
        pieces.push_back([&elements] { elements.run(); });
      }
      same = same && difference <= tolerance; // false for a NaN
      const std::vector<double> seconds = interleaved_seconds(pieces);
      const double alone = 1e9 * seconds[0] / singles,
                   of_64 = 1e9 * seconds[1] / static_cast<double>(many.elements().count);
      double fastest = std::nan("");
      out << std::left << std::setw(18) << std::string(basis) + " " + variant << std::right;
      number(number(out, alone, 10, 0), of_64, 10, 0);
      std::size_t k = 2;
      for (const Peer& peer : peers) {
        const double each = peer.element_of(basis, enriched) ? 1e9 * seconds[k++] / singles : std::nan("");
        number(out, each, &peer == peers ? 12 : 10, 0);
        fastest = std::fmin(fastest, each);
      }
      number(number(out, fastest / alone, 16, 1), fastest / of_64, 10, 1);
      out << std::setw(13) << std::scientific << std::setprecision(1) << difference << std::endl;
    }
  if (!same)
    out << "the closed form and its automatic differentiation differ by more than " << tolerance << "\n";
  return same;
}

} // namespace bench
