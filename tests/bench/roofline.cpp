#include "roofline.hpp"

#include <iomanip>
#include <ostream>
#include <string>

#include "cases.hpp"
#include "interleaved.hpp"
#include "machine.hpp"
#include "operations.hpp"

namespace bench {

void run_roofline(std::ostream& out) {
  const Machine machine = measure_machine();
  out << std::fixed << std::setprecision(1) << "this machine, one thread: " << 1e-9 * machine.flops
      << " Gflop/s (additions and multiplications, not fused, registers of " << machine.registers
      << "), stores to memory " << 1e-9 * machine.bytes
      << " GB/s\n\nresidual and tangent; bytes: what is written\n"
      << std::left << std::setw(18) << "" << std::right << std::setw(8) << "flops" << std::setw(8) << "bytes"
      << std::setw(12) << "64: ns" << std::setw(10) << "% flops" << std::setw(14) << "stream: ns"
      << std::setw(10) << "% stores"
      << "\n";
  for (const char* basis : {"line2", "tri3", "quad4", "quad9"})
    for (const bool enriched : {false, true}) {
      const char* variant = enriched ? "enriched" : "plain";
      Job many({basis, variant, "RK", Call::batch}), stream({basis, variant, "RK", Call::stream});
      const double operations = operations_of(basis, enriched, true, false),
                   bytes = 8.0 * many.dofs() * (many.dofs() + 1);
      const std::vector<double> seconds =
          interleaved_seconds({[&] { many.run(); }, [&] { stream.run(); }}, 9);
      const double cached = seconds[0] / static_cast<double>(many.elements_per_call()),
                   streamed = seconds[1] / static_cast<double>(stream.elements_per_call());
      out << std::left << std::setw(18) << std::string(basis) + " " + variant << std::right
          << std::setprecision(0) << std::setw(8) << operations << std::setw(8) << bytes
          << std::setprecision(1) << std::setw(12) << 1e9 * cached << std::setw(10)
          << 100.0 * operations / (machine.flops * cached) << std::setw(14) << 1e9 * streamed << std::setw(10)
          << 100.0 * bytes / (machine.bytes * streamed) << std::endl;
    }
}

} // namespace bench
