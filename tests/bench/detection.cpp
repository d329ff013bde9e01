#include "detection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <ostream>

#include "growth.hpp"
#include "mesh_surface.hpp"
#include "random.hpp"
#include "thread_time.hpp"

namespace bench {

namespace {

using mechanics::Detector;
using mechanics::MeshSurface;
using mechanics::Random;

// ns per item, the fastest of some repetitions: 5 or as many as fit into half a second.
template <class Prepare, class Run> double ns_per_item(std::int64_t items, Prepare&& prepare, Run&& run) {
  double best = std::numeric_limits<double>::infinity(), spent = 0.0;
  for (int i = 0; i < 5 && (i == 0 || spent < 0.5); ++i) {
    prepare();
    const double begin = thread_seconds();
    run();
    const double seconds = thread_seconds() - begin;
    spent += seconds;
    best = std::min(best, seconds);
  }
  return 1e9 * best / static_cast<double>(items);
}

enum Quantity { build, refit, search, follow, nothing, bytes, quantities };
constexpr const char* names[] = {"build", "refit", "search", "follow", "nothing", "bytes"};

std::array<double, quantities> measure(const std::string& basis_name, const mechanics::Model& model,
                                       std::int64_t n) {
  const mechanics::Basis& basis = mechanics::basis_named(basis_name);
  const int d = basis.dimension;
  const std::int64_t cells = basis.simplex ? n / 2 : n;
  const int side =
      d == 2 ? static_cast<int>(n) : static_cast<int>(std::lround(std::sqrt(static_cast<double>(cells))));
  Random random(5);
  const MeshSurface mesh = mechanics::draw_mesh(random, basis, side, 0.1);
  std::vector<double> slaves, far;
  for (std::int64_t i = 0; i < n; ++i) {
    slaves.push_back(random.uniform(0.0, 2.0 * side));
    if (d == 3) slaves.push_back(random.uniform(0.0, 2.0 * side));
    slaves.push_back(random.uniform(-0.1, 0.1));
  }
  far = slaves;
  for (std::size_t i = static_cast<std::size_t>(d) - 1; i < far.size(); i += static_cast<std::size_t>(d))
    far[i] += 10.0;
  const auto none = [] {};
  std::array<double, quantities> result{};
  result[build] = ns_per_item(mesh.segments(), none, [&] { const Detector tree(model, mesh); });
  Detector detector(model, mesh);
  result[refit] = ns_per_item(mesh.segments(), none, [&] { detector.refit(); });
  constexpr double reach = 0.5;
  Detector::Found found;
  result[search] = ns_per_item(
      n, [&] { found = {}; }, [&] { detector.detect(slaves, reach, found); });
  for (double& x : slaves) x += 1e-2;
  const Detector::Found before = found;
  result[follow] = ns_per_item(
      n, [&] { found = before; }, [&] { detector.detect(slaves, reach, found); });
  result[nothing] = ns_per_item(
      n, [&] { found = {}; }, [&] { detector.detect(far, reach, found); });
  result[bytes] = 8.0 * static_cast<double>(detector.size()) / static_cast<double>(mesh.segments());
  return result;
}

} // namespace

void run_detection(std::ostream& out, std::int64_t most) {
  out << "n slave nodes over n segments; build, refit: ns per segment; search, follow, nothing (within "
         "reach): ns per slave "
         "node;\nbytes of the tree per segment; thread CPU time\n";
  for (const std::string basis : {"line2", "tri3", "quad4", "bspline16"})
    for (const bool enriched : {false, true}) {
      const int t = mechanics::basis_named(basis).parameters();
      nlohmann::json text{{"segment", basis}};
      if (enriched)
        text["height"] = {{"type", "sine"},
                          {"amplitude", 0.03},
                          {"wave_vector", std::vector<double>(static_cast<std::size_t>(t), 0.5)}};
      const mechanics::Model model(text.dump());
      out << "\n" << std::left << std::setw(18) << basis + (enriched ? " enriched" : " plain") << std::right;
      for (const char* name : names) out << std::setw(10) << name;
      out << "\n" << std::fixed;
      std::vector<double> x;
      std::vector<std::array<double, quantities>> y;
      for (std::int64_t n = 1000; n <= most; n *= 10) {
        const auto now = measure(basis, model, n);
        out << std::left << std::setw(18) << n << std::right << std::setprecision(0);
        for (const double value : now) out << std::setw(10) << value;
        out << std::endl;
        x.push_back(static_cast<double>(n));
        y.push_back(now);
      }
      if (x.size() < 2) continue;
      out << std::left << std::setw(18) << "slope" << std::right << std::setprecision(2);
      for (int q = 0; q < quantities; ++q) {
        std::vector<double> costs;
        for (std::size_t i = 0; i < x.size(); ++i) costs.push_back(y[i][static_cast<std::size_t>(q)] * x[i]);
        out << std::setw(10) << slope(x, costs);
      }
      out << "\n";
    }
}

} // namespace bench
