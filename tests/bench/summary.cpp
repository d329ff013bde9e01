#include "summary.hpp"

#include <iomanip>
#include <ostream>

#include "bases.hpp"

namespace bench {

void Medians::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Aggregate || run.aggregate_name != "median") continue;
    const auto counter = run.counters.find(nanoseconds);
    if (counter != run.counters.end()) medians_[run.run_name.function_name] = counter->second.value;
  }
}

double Medians::of(const std::string& name) const {
  const auto found = medians_.find(name);
  return found == medians_.end() ? -1.0 : found->second;
}

void print_summary(std::ostream& out, const Medians& medians) {
  const char* calls[] = {"single", "batch"};
  const char* variants[] = {"plain", "enriched"};
  const char* levels[] = {"R", "RK"};
  out << "ns per element (thread CPU time, median)\n" << std::setw(14) << std::left << "" << std::right;
  for (const char* call : calls) out << std::setw(36) << call;
  out << "\n" << std::setw(14) << "";
  for (int call = 0; call < 2; ++call)
    for (const char* variant : variants) out << std::setw(18) << variant;
  out << "\n" << std::setw(14) << std::left << "basis" << std::right;
  for (int column = 0; column < 4; ++column) out << std::setw(9) << "R" << std::setw(9) << "R+K";
  out << "\n" << std::fixed << std::setprecision(1);
  for (const std::string& basis : mechanics::basis_names()) {
    out << std::setw(14) << std::left << basis << std::right;
    for (const char* call : calls)
      for (const char* variant : variants)
        for (const char* level : levels) {
          const double value = medians.of(basis + "/" + variant + "/" + level + "/" + call);
          if (value < 0.0) out << std::setw(9) << "-";
          else out << std::setw(9) << value;
        }
    out << "\n";
  }
}

} // namespace bench
