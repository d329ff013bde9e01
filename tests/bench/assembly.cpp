#include "assembly.hpp"

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <set>
#include <stdexcept>

#include "growth.hpp"
#include "mesh_surface.hpp"
#include "thread_time.hpp"

namespace bench {

namespace {

using mechanics::MeshSurface;
using mechanics::Model;

// A surface, slave nodes just below it, and the equations of both: slaves first.
struct Problem {
  MeshSurface mesh;
  std::vector<double> slave, start, residual, values;
  std::vector<std::int64_t> segment, slave_equations, master_equations, places;
  std::vector<std::int32_t> row_begin{0}, columns;
  std::int64_t count = 0;

  Problem(const Model& model, int side) {
    mechanics::Random random(7);
    mesh = mechanics::draw_mesh(random, mechanics::basis_named("quad4"), side, 0.1);
    count = mesh.segments();
    for (std::int64_t e = 0; e < count; ++e) {
      const double xi[2] = {random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6)};
      const std::vector<double> master = mesh.master(e);
      const auto at = mechanics::evaluate_surface(model, master.data(), nullptr, {xi[0], xi[1]});
      for (std::size_t c = 0; c < 3; ++c) slave.push_back(at.point[c] - 0.03 * at.normal[c]);
      start.insert(start.end(), {xi[0] + 1e-2, xi[1] - 1e-2});
      segment.push_back(e);
    }
    for (std::int64_t i = 0; i < 3 * count; ++i) slave_equations.push_back(i);
    for (std::int64_t i = 0; i < 3 * mesh.nodes(); ++i) master_equations.push_back(3 * count + i);
    std::vector<std::set<std::int64_t>> neighbours(
        static_cast<std::size_t>(count + mesh.nodes())); // nodes by node
    for (std::int64_t e = 0; e < count; ++e) {
      std::int64_t nodes[5] = {e};
      for (int i = 0; i < 4; ++i)
        nodes[i + 1] = count + mesh.connectivity[static_cast<std::size_t>(4 * e + i)];
      for (const std::int64_t a : nodes)
        neighbours[static_cast<std::size_t>(a)].insert(std::begin(nodes), std::end(nodes));
    }
    for (const auto& of_node : neighbours)
      for (int c = 0; c < 3; ++c) {
        for (const std::int64_t b : of_node)
          for (int k = 0; k < 3; ++k) columns.push_back(static_cast<std::int32_t>(3 * b + k));
        row_begin.push_back(static_cast<std::int32_t>(columns.size()));
      }
    residual.resize(row_begin.size() - 1);
    values.resize(columns.size());
    places.resize(static_cast<std::size_t>(76 * count));
  }
};

template <class Run> double nanoseconds(const Problem& p, Run&& run, std::int64_t times = 1) {
  const double begin = thread_seconds();
  for (std::int64_t i = 0; i < times; ++i) run();
  return 1e9 * (thread_seconds() - begin) / static_cast<double>(p.count * times);
}
// Of few elements many times: the clock itself takes half a microsecond.
template <class Run> double median_nanoseconds(const Problem& p, Run&& run) {
  std::vector<double> all;
  for (int i = 0; i < 7; ++i) all.push_back(nanoseconds(p, run, std::max<std::int64_t>(1, 100000 / p.count)));
  std::nth_element(all.begin(), all.begin() + 3, all.end());
  return all[3];
}

} // namespace

void run_assembly(std::ostream& out) {
  out << "ents_assemble, residual and tangent of quad4 elements into compressed rows (32-bit indices), a "
         "slave node per segment\n"
         "ns per element: first call, later calls, evaluation alone (64 elements per call), the difference; "
         "additions: of nothing to the\n"
         "entries of the matrix that an element has, at the places known from the first call: what no "
         "scatter is faster than; thread CPU time\n";
  for (const bool enriched : {false, true}) {
    nlohmann::json text{{"segment", "quad4"},
                        {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", 1.0}}}}}};
    if (enriched) text["height"] = {{"type", "sine"}, {"amplitude", 0.03}, {"wave_vector", {0.5, 0.5}}};
    const Model model(text.dump());
    out << "\n" << std::left << std::setw(12) << (enriched ? "enriched" : "plain") << std::right;
    for (const char* name : {"first", "later", "evaluation", "scatter", "additions"})
      out << std::setw(12) << name;
    out << "\n" << std::fixed << std::setprecision(0);
    std::vector<double> sizes, later_seconds;
    for (const int side : {10, 32, 100, 316, 1000}) {
      Problem p(model, side);
      const ents_master_mesh mesh = p.mesh.mesh();
      ents_input in{};
      in.struct_size = sizeof in;
      in.slave = p.slave.data(), in.slave_stride = 3;
      in.start = p.start.data(), in.start_stride = 2;
      in.mesh = &mesh, in.segment = p.segment.data(), in.segment_stride = 1;
      ents_system system{};
      system.struct_size = sizeof system;
      system.index_size = 4;
      system.slave_nodes = p.count, system.slave_equations = p.slave_equations.data();
      system.master_nodes = p.mesh.nodes(), system.master_equations = p.master_equations.data();
      system.rows = static_cast<std::int64_t>(p.residual.size());
      system.residual = p.residual.data();
      system.row_begin = p.row_begin.data(), system.columns = p.columns.data(),
      system.values = p.values.data();
      system.places = p.places.data(), system.places_size = 76;
      ents_report report{};
      report.struct_size = sizeof report;
      const auto assemble = [&] {
        if (ents_assemble(model.handle(), 0, p.count, &in, nullptr, &system, &report) != ENTS_OK)
          throw std::runtime_error(report.message);
      };
      double residual[64 * 15], tangent[64 * 225];
      ents_output results{};
      results.struct_size = sizeof results;
      results.wanted = ENTS_RESIDUAL | ENTS_TANGENT;
      results.residual = residual, results.residual_stride = 15;
      results.tangent = tangent, results.tangent_stride = 225;
      const auto evaluate = [&] {
        ents_input some = in;
        for (std::int64_t e = 0; e < p.count; e += 64) {
          some.slave = in.slave + 3 * e, some.start = in.start + 2 * e, some.segment = in.segment + e;
          if (ents_evaluate(model.handle(), 0, std::min<std::int64_t>(64, p.count - e), &some, &results,
                            &report) != ENTS_OK)
            throw std::runtime_error(report.message);
        }
      };
      const auto add = [&] { // 75 pieces of rows, three entries each
        for (std::int64_t e = 0; e < p.count; ++e)
          for (const std::int64_t *place = &p.places[static_cast<std::size_t>(76 * e + 1)], *end = place + 75;
               place < end; ++place)
            for (int c = 0; c < 3; ++c) p.values[static_cast<std::size_t>(*place - 1 + c)] += 0.0;
        asm volatile("" : : "r"(p.values.data()) : "memory");
      };
      const double first = nanoseconds(p, assemble), later = median_nanoseconds(p, assemble),
                   alone = median_nanoseconds(p, evaluate), additions = median_nanoseconds(p, add);
      out << std::left << std::setw(12) << p.count << std::right << std::setw(12) << first << std::setw(12)
          << later << std::setw(12) << alone << std::setw(12) << later - alone << std::setw(12) << additions
          << std::endl;
      sizes.push_back(static_cast<double>(p.count));
      later_seconds.push_back(later * sizes.back());
    }
    out << "slope of later calls over the number of elements: " << std::setprecision(2)
        << slope(sizes, later_seconds) << "\n";
  }
}

} // namespace bench
