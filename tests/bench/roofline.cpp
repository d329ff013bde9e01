#include "roofline.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <string>
#include <vector>

#include "cases.hpp"
#include "counted.hpp"
#include "stores.hpp"
#include "thread_time.hpp"

namespace bench {

namespace {

// Seconds of one run, the median of 9.
template <class Run> double median_seconds(Run&& run) {
  std::vector<double> seconds;
  for (int i = 0; i < 9; ++i) {
    const double begin = thread_seconds();
    run();
    seconds.push_back(thread_seconds() - begin);
  }
  std::nth_element(seconds.begin(), seconds.begin() + 4, seconds.end());
  return seconds[4];
}

// Multiplications and additions that do not wait for each other, as many as the registers hold; not fused, because the library
// does not fuse either. A macro, because a function that is inlined must not have another target.
#define ENTS_SPIN(name, target, width, chains)                                                              \
  target double name(std::int64_t rounds) {                                                                 \
    typedef double Vector __attribute__((vector_size(8 * width)));                                          \
    Vector a[chains], b[chains];                                                                            \
    _Pragma("GCC unroll 16") for (int i = 0; i < chains; ++i) a[i] = b[i] = Vector{};                                                \
    for (std::int64_t k = 0; k < rounds; ++k) {                                                             \
      _Pragma("GCC unroll 16") for (int i = 0; i < chains; ++i) a[i] = a[i] * 1.0000000001;                                          \
      _Pragma("GCC unroll 16") for (int i = 0; i < chains; ++i) b[i] = b[i] + 1e-10;                                                 \
      _Pragma("GCC unroll 16") for (int i = 0; i < chains; ++i) asm volatile("" : "+v"(a[i]), "+v"(b[i]));                           \
    }                                                                                                       \
    double sum = 0.0;                                                                                       \
    _Pragma("GCC unroll 16") for (int i = 0; i < chains; ++i) sum += a[i][0] + b[i][0];                                              \
    return sum;                                                                                             \
  }
#if defined(__x86_64__)
ENTS_SPIN(spin_portable, , 2, 7)
ENTS_SPIN(spin_avx2, __attribute__((target("avx2"))), 4, 7)
ENTS_SPIN(spin_avx512, __attribute__((target("avx512f"))), 8, 10)
#endif

struct Limits {
  double flops, bytes; // per second
  const char* registers;
};

Limits measure_limits() {
  constexpr std::int64_t rounds = 2000000;
  Limits limits{};
  double (*run)(std::int64_t) = nullptr;
  double each = 0.0; // flops of a round
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) run = spin_avx512, each = 20.0 * 8.0, limits.registers = "64 bytes";
  else if (__builtin_cpu_supports("avx2")) run = spin_avx2, each = 14.0 * 4.0, limits.registers = "32 bytes";
  else run = spin_portable, each = 14.0 * 2.0, limits.registers = "16 bytes";
#endif
  volatile double sink = 0.0;
  if (run) limits.flops = each * static_cast<double>(rounds) / median_seconds([&] { sink = sink + run(rounds); });
  std::vector<double> memory(std::size_t{1} << 25, 1.0); // 256 MiB
  limits.bytes = 8.0 * static_cast<double>(memory.size()) / median_seconds([&] { store_all(memory.data(), memory.size(), sink); });
  return limits;
}

// Operations of residual and tangent of an element of the benchmark, the projection included.
template <class B, bool H> double operations() {
  using namespace ents::counted;
  constexpr int D = B::dim, T = D - 1, N = D * (B::nodes + 1);
  ents::Plan plan{};
  ents::HeightNode node{};
  node.kind = ents::HeightKind::sine;
  node.sine = {0.03, {0.5, 0.5}, 0.3};
  plan.law.normal = ents::NormalKind::penalty;
  plan.law.stiffness = 1.0;
  PairNodes<B, Counted> nodes;
  nodes.has_coordinates = false;
  nodes.height = H ? &node : nullptr;
  // a bent segment under a slave node; natural coordinates of the nodes as a least-squares fit would find them do not matter here
  double corner[9][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}};
  double triangle[3][2] = {{0, 0}, {1, 0}, {0, 1}};
  for (int i = 0; i < B::nodes; ++i) {
    const double* at = B::simplex ? triangle[i] : corner[i];
    if (D == 2) {
      nodes.y[i][0] = (i == 0 ? -1.0 : 1.0) - 0.1;
      nodes.y[i][1] = 0.05 + 0.02 * i;
    } else {
      nodes.y[i][0] = at[0] - 0.2;
      nodes.y[i][1] = at[1] - 0.1;
      nodes.y[i][2] = 0.05 + 0.05 * at[0] * at[1];
    }
  }
  Counted start[T];
  for (Counted& x : start) x = B::simplex ? 0.2 : 0.1;
  Pair<B, H, Counted> pair(nodes, start);
  pair.project();
  for (int a = 0; a < T; ++a) start[a] = pair.xi[a].v + 1e-2;
  Counted::operations = 0;
  Pair<B, H, Counted> counted(nodes, start);
  counted.area = 1.0;
  counted.project();
  counted.arrive();
  counted.press(plan, false);
  if (!counted.ordinary || !counted.contact) return std::nan("");
  Counted residual[N];
  counted.template residual<false>(residual);
  PairTangent<B, H, false, Counted> tangent;
  tangent.evaluate(plan, counted);
  for (int j = 0; j < N; ++j)
    for (int i = j; i < N; ++i) {
      Counted k = 0.0;
      if (i % D == j % D) k = tangent.weights[0][i / D] * tangent.weights[0][j / D];
      const auto row = [i](const auto& array) { return array[i]; };
      tangent.template add_products<Counted>(k, row, j);
    }
  return static_cast<double>(Counted::operations);
}

double seconds_per_element(const Case& c) {
  Job job(c);
  job.run();
  const int calls = c.call == Call::stream ? 1 : 400;
  return median_seconds([&] {
           for (int i = 0; i < calls; ++i) job.run();
         }) /
         (calls * static_cast<double>(job.elements_per_call()));
}

} // namespace

void run_roofline(std::ostream& out) {
  using namespace ents::counted;
  const Limits limits = measure_limits();
  out << std::fixed << std::setprecision(1) << "this machine, one thread: " << 1e-9 * limits.flops
      << " Gflop/s (additions and multiplications, not fused, registers of " << limits.registers << "), stores to memory "
      << 1e-9 * limits.bytes << " GB/s\n\nresidual and tangent; bytes: what is written\n"
      << std::left << std::setw(18) << "" << std::right << std::setw(8) << "flops" << std::setw(8) << "bytes" << std::setw(12)
      << "64: ns" << std::setw(10) << "% flops" << std::setw(14) << "stream: ns" << std::setw(10) << "% stores" << "\n";
  const struct {
    const char *basis, *variant;
    double operations;
    int dofs;
  } rows[] = {{"line2", "plain", operations<Line2, false>(), 6},   {"line2", "enriched", operations<Line2, true>(), 6},
              {"tri3", "plain", operations<Tri3, false>(), 12},    {"tri3", "enriched", operations<Tri3, true>(), 12},
              {"quad4", "plain", operations<Quad4, false>(), 15},  {"quad4", "enriched", operations<Quad4, true>(), 15},
              {"quad9", "plain", operations<Quad9, false>(), 30},  {"quad9", "enriched", operations<Quad9, true>(), 30}};
  for (const auto& row : rows) {
    const double bytes = 8.0 * row.dofs * (row.dofs + 1);
    const double cached = seconds_per_element({row.basis, row.variant, "RK", Call::batch});
    const double streamed = seconds_per_element({row.basis, row.variant, "RK", Call::stream});
    out << std::left << std::setw(18) << std::string(row.basis) + " " + row.variant << std::right << std::setprecision(0) << std::setw(8)
        << row.operations << std::setw(8) << bytes << std::setprecision(1) << std::setw(12) << 1e9 * cached << std::setw(10)
        << 100.0 * row.operations / (limits.flops * cached) << std::setw(14) << 1e9 * streamed << std::setw(10)
        << 100.0 * bytes / (limits.bytes * streamed) << std::endl;
  }
}

} // namespace bench
