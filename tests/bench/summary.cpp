#include "summary.hpp"

#include <iomanip>
#include <ostream>

#include "cases.hpp"

namespace bench {

void Medians::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Aggregate || run.aggregate_name != "median") continue;
    const auto counter = run.counters.find(time_counter);
    if (counter != run.counters.end()) medians_[run.run_name.function_name] = counter->second.value;
  }
}

double Medians::of(const std::string& name) const {
  const auto found = medians_.find(name);
  return found == medians_.end() ? -1.0 : found->second;
}

namespace {

const char* const kinds_of_call[] = {"single", "batch"};
const char* const variants[] = {"plain", "enriched"};

void print_ratio(std::ostream& out, const Medians& medians, const std::string& above,
                 const std::string& below) {
  const double a = medians.of(above), b = medians.of(below);
  if (a > 0.0 && b > 0.0)
    out << std::setw(9) << a / b;
  else
    out << std::setw(9) << "-";
}

} // namespace

void print_summary(std::ostream& out, const Medians& medians) {
  out << "ns per element (thread CPU time, median); C: with Coulomb friction\n"
      << std::setw(14) << std::left << "" << std::right;
  for (const char* call : kinds_of_call) out << std::setw(54) << call;
  out << "\n" << std::setw(14) << "";
  for (int call = 0; call < 2; ++call)
    for (const char* variant : variants) out << std::setw(27) << variant;
  out << "\n" << std::setw(14) << std::left << "basis" << std::right;
  for (int column = 0; column < 4; ++column)
    out << std::setw(9) << "R" << std::setw(9) << "R+K" << std::setw(9) << "R+K C";
  out << "\n" << std::fixed << std::setprecision(1);
  for (const std::string& basis : basis_names()) {
    out << std::setw(14) << std::left << basis << std::right;
    for (const char* call : kinds_of_call)
      for (const char* variant : variants)
        for (const char* level : {"/R/", "/RK/", "_coulomb/RK/"}) {
          const double value = medians.of(basis + "/" + variant + level + call);
          if (value < 0.0)
            out << std::setw(9) << "-";
          else
            out << std::setw(9) << value;
        }
    out << "\n";
  }
  out << "\nratios of R+K\n" << std::setw(14) << std::left << "basis" << std::right;
  for (const char* name : {"enriched / plain", "Coulomb / none, enriched", "batch / single, enriched"})
    out << std::setw(27) << name;
  out << "\n" << std::setw(14) << "";
  for (int i = 0; i < 2; ++i) out << std::setw(18) << "single" << std::setw(9) << "batch";
  out << std::setw(18) << "none" << std::setw(9) << "Coulomb"
      << "\n"
      << std::setprecision(2);
  for (const std::string& basis : basis_names()) {
    out << std::setw(14) << std::left << basis << std::right;
    out << std::setw(9) << "";
    for (const char* call : kinds_of_call)
      print_ratio(out, medians, basis + "/enriched/RK/" + call, basis + "/plain/RK/" + call);
    out << std::setw(9) << "";
    for (const char* call : kinds_of_call)
      print_ratio(out, medians, basis + "/enriched_coulomb/RK/" + call, basis + "/enriched/RK/" + call);
    out << std::setw(9) << "";
    for (const char* variant : {"/enriched", "/enriched_coulomb"})
      print_ratio(out, medians, basis + variant + "/RK/batch", basis + variant + "/RK/single");
    out << "\n";
  }
}

} // namespace bench
