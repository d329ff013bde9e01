// The short answer: nanoseconds per element in one table.
#pragma once

#include <benchmark/benchmark.h>

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace bench {

inline constexpr const char* time_counter = "ns_per_element";

// Keeps the medians it is shown, prints nothing.
class Medians : public benchmark::BenchmarkReporter {
public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override;

  // Median of a case, negative if it did not run
  double of(const std::string& name) const;

private:
  std::map<std::string, double> medians_;
};

void print_summary(std::ostream& out, const Medians& medians);

} // namespace bench
