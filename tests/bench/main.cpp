// ents-bench: what a contact element costs.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "assembly.hpp"
#include "cases.hpp"
#include "detection.hpp"
#include "differentiation.hpp"
#include "laws.hpp"
#include "limits.hpp"
#include "peers.hpp"
#include "roofline.hpp"
#include "savings.hpp"
#include "streaming.hpp"
#include "summary.hpp"

namespace {

constexpr char summary_cases[] = "/((plain|enriched)/(R|RK)|(plain|enriched)_coulomb/RK)/(single|batch)$";

void print_help() {
  std::puts(R"(usage: ents-bench [--summary] [--benchmark_...]
       ents-bench --detection[=N] | --roofline | --limits | --savings | --laws
       ents-bench --assembly | --differentiation | --peers | --streaming[=N]

Times contact elements through the C ABI, one thread. Every case has a name BASIS/VARIANT/LEVEL/CALL:
  BASIS    line2 line3 catmull_rom4 bspline4 tri3 tri6 quad4 quad8 quad9 catmull_rom16 bspline16 bezier15
  VARIANT  plain (no height), enriched (a sine), plain_coulomb, enriched_coulomb (R and RK; some elements stick, some slip); for
           line2, quad4 and quad9 also constant, map, coordinates (a sine of surface coordinates), rigid (master),
           first_variation, small_gap (tangents; all with the sine), expression, callback (the sine, written
           down, and as a function of the host)
  LEVEL    gap; R residual; RK residual and tangent; kinematics1 xi, gap and first variations; kinematics2 and second ones
  CALL     single: 16 different elements in turn, one per call; batch: 64 per call; stream: 100000 per call (quad9: 25000), through main
           memory; line2, tri3, quad4, quad9
Every element is in contact; its projection starts 1e-2 (natural coordinates) beside the solution and converges to rounding.
Counters: ns_per_element; surface_evaluations, the mean number that the projection takes. Times are CPU times of the thread.

  --detection[=N]                 n slave nodes on surfaces of n = 1000, 10000 .. N segments (1000000 if not given): time and memory
                                  of the search, and their growth
  --roofline                      flop rate and store bandwidth of this machine; flops and bytes of elements, percent of the limits
  --limits                        time of a call beside the times of its kernel, its chain of operations, its stores, its arithmetic
  --savings                       cost of what a scene may not need: height, friction, a master that deforms ...
  --laws                          R + K of every normal law, friction, kind of tangent and patch beside the penalty element; one hard
                                  element among 64; second variations beside R + K
  --streaming[=N]                 array calls of 100, 1000 .. N elements (1000000 if not given; up to 4 GB): cost with results in main memory
                                  beside the floor of its stores, with results in the same places, with these copied, and its growth
  --assembly                      ents_assemble on quad4 surfaces of 10^2 .. 10^6 segments
  --differentiation               closed form against automatic differentiation (Sacado, Eigen) of the same elements; fails if a tangent
                                  differs by more than 1e-9
  --peers                         CalculiX's contact spring against a quad4, the IPC Toolkit's pairs against tri3, quad4 and line2: those
                                  that are built in; says how to build in the others; fails if forces differ from theirs
  --summary                       only R and RK, single and batch, as one table
  --benchmark_filter=REGEX        cases whose name matches, e.g. quad4/enriched
  --benchmark_list_tests          names only
  --benchmark_format=json         on the terminal; --benchmark_out=FILE --benchmark_out_format=json into a file
  --benchmark_repetitions=N       15 if not given; medians are reported
  --benchmark_min_time=SECONDS    of one repetition; 0.02 if not given
Cases are interleaved at random, so that a slow second of the machine does not hit one of them alone
(--benchmark_enable_random_interleaving=false turns this off). The other --benchmark_ flags are those of Google Benchmark.

exit status: 0 done; 1 a case failed; 2 the command line is wrong, or --peers finds nothing built in)");
}

bool case_failed = false;

void register_case(const bench::Case& c) {
  const auto run = [c](benchmark::State& state) {
    std::unique_ptr<bench::Job> job;
    try {
      job = std::make_unique<bench::Job>(c);
    } catch (const std::exception& error) {
      case_failed = true;
      state.SkipWithError(error.what());
      return;
    }
    for (auto _ : state) {
      job->run();
      benchmark::DoNotOptimize(job->results());
      benchmark::ClobberMemory();
    }
    using benchmark::Counter;
    const double elements = static_cast<double>(job->elements_per_call());
    state.counters[bench::time_counter] =
        Counter(1e-9 * elements, Counter::kIsIterationInvariantRate | Counter::kInvert);
    state.counters["surface_evaluations"] = job->mean_surface_evaluations();
  };
  benchmark::RegisterBenchmark(c.name().c_str(), run)->Unit(benchmark::kNanosecond);
}

// Is a flag given by the user?
bool given(int argc, char** argv, const char* flag) {
  for (int i = 1; i < argc; ++i)
    if (std::strncmp(argv[i], flag, std::strlen(flag)) == 0) return true;
  return false;
}

} // namespace

int main(int argc, char** argv) {
  bool summary = false;
  std::vector<std::string> arguments = {argv[0]};
  const std::pair<const char*, const char*> defaults[] = {{"--benchmark_repetitions", "15"},
                                                          {"--benchmark_min_time", "0.02"},
                                                          {"--benchmark_enable_random_interleaving", "true"},
                                                          {"--benchmark_report_aggregates_only", "true"}};
  for (const auto& [flag, value] : defaults)
    if (!given(argc, argv, flag)) arguments.push_back(std::string(flag) + "=" + value);
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--help" || argument == "-h") {
      print_help();
      return 0;
    }
    const std::pair<std::string, void (*)(std::ostream&, std::int64_t)> growing[] = {
        {"--detection", bench::run_detection}, {"--streaming", bench::run_streaming}};
    for (const auto& [flag, run] : growing) {
      if (argument != flag && argument.rfind(flag + "=", 0) != 0) continue;
      const std::int64_t most =
          argument == flag ? 1000000 : std::atoll(argument.substr(flag.size() + 1).c_str());
      if (most < 1000) {
        std::cerr << argument << ": at least 1000 are needed\n";
        return 2;
      }
      run(std::cout, most);
      return 0;
    }
    if (argument == "--assembly") {
      bench::run_assembly(std::cout);
      return 0;
    }
    if (argument == "--differentiation") return bench::run_differentiation(std::cout) ? 0 : 1;
    if (argument == "--peers") return bench::run_peers(std::cout);
    if (argument == "--roofline") {
      bench::run_roofline(std::cout);
      return 0;
    }
    if (argument == "--limits") {
      bench::run_limits(std::cout);
      return 0;
    }
    if (argument == "--laws") {
      bench::run_laws(std::cout);
      return 0;
    }
    if (argument == "--savings") {
      bench::run_savings(std::cout);
      return 0;
    }
    if (argument == "--summary")
      summary = true;
    else
      arguments.push_back(argument);
  }
  if (summary && !given(argc, argv, "--benchmark_filter"))
    arguments.push_back(std::string("--benchmark_filter=") + summary_cases);

  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  pointers.push_back(nullptr);
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return 2;
  for (const bench::Case& c : bench::all_cases()) register_case(c);
  if (!summary) return benchmark::RunSpecifiedBenchmarks() > 0 && !case_failed ? 0 : 1;
  bench::Medians medians;
  if (benchmark::RunSpecifiedBenchmarks(&medians) == 0) return 1;
  bench::print_summary(std::cout, medians);
  return case_failed ? 1 : 0;
}
