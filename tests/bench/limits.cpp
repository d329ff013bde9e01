#include "limits.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <ostream>
#include <string>

#include "abi/call/guard.hpp"
#include "block_kernel.hpp"
#include "interleaved.hpp"
#include "machine.hpp"
#include "operations.hpp"

namespace bench {

namespace {

constexpr std::int64_t guards = 64;

void read_control_word() {
  for (std::int64_t i = 0; i < guards; ++i) {
    const ents::FloatingPointGuard guard;
    asm volatile("" : : : "memory");
  }
}

std::ostream& number(std::ostream& out, double value, int width, int digits) {
  if (!std::isfinite(value)) return out << std::setw(width) << "-";
  return out << std::setw(width) << std::setprecision(digits) << value;
}

int lanes_of(const Job& job) {
  ents_layout layout{};
  layout.struct_size = sizeof layout;
  ents_model_layout(job.model().handle(), &layout, nullptr);
  const std::string set = layout.instruction_set;
  return set == "avx512" ? 8 : set == "avx2" ? 4 : 2;
}

struct Level {
  const char *name, *level;
  bool tangent, friction;
};
constexpr Level levels[] = {
    {"R", "R", false, false}, {"R+K", "RK", true, false}, {"R+K C", "RK", true, true}};

void print_level(std::ostream& out, const Machine& machine, const std::string& basis, bool enriched,
                 const Level& level) {
  const std::string variant =
      std::string(enriched ? "enriched" : "plain") + (level.friction ? "_coulomb" : "");
  Job single({basis, variant, level.level, Call::single}), many({basis, variant, level.level, Call::batch});
  const double singles = static_cast<double>(single.elements().count),
               each = static_cast<double>(many.elements().count);
  const ents::BlockKernel fused = fused_kernel(basis, enriched, level.friction),
                          moving = moving_kernel(basis, enriched, level.friction);
  BlockKernel alone(single), alone_many(many), fused_many(many, fused), moving_many(many, moving);
  const int lanes = lanes_of(many), columns = level.tangent ? many.dofs() + 1 : 1;
  const std::vector<double> seconds = interleaved_seconds(
      {[&] {
         for (std::int64_t e = 0; e < single.elements().count; ++e) single.run();
       },
       [&] { alone.run(1); }, [&] { alone.run_in_turn(1); }, [&] { many.run(); }, [&] { alone_many.run(64); },
       [&] { alone_many.run_in_turn(lanes); },
       [&] { store_columns(many.results(), many.dofs(), columns * many.elements().count); },
       [&] {
         if (moving) moving_many.run(64);
       },
       [&] {
         if (fused) fused_many.run(64);
       }});
  const double operations = operations_of(basis, enriched, level.tangent, level.friction);
  const auto ns = [&](std::size_t piece, double elements) { return 1e9 * seconds[piece] / elements; };
  out << std::left << std::setw(24) << basis + (enriched ? " enriched " : " plain ") + level.name
      << std::right;
  number(out, ns(0, singles), 8, 1);
  number(out, ns(1, singles), 9, 1);
  number(out, ns(2, singles), 9, 1);
  number(out, ns(3, each), 12, 1);
  number(out, ns(4, each), 9, 1);
  number(out, ns(5, each), 9, 1);
  number(out, ns(6, each), 9, 1);
  number(out, moving ? ns(7, each) : std::nan(""), 9, 1);
  number(out, 1e9 * operations / machine.flops, 9, 1);
  number(out, operations, 12, 0);
  number(out, fused ? seconds[4] / seconds[8] : std::nan(""), 9, 2);
  out << std::endl;
}

} // namespace

void run_limits(std::ostream& out) {
  const Machine machine = measure_machine();
  const char* with_fused = fused_kernel("line2", false, false) ? "" : " (cmake -DENTS_BENCH_FUSED=ON)";
  const double guard = 1e9 * interleaved_seconds({read_control_word})[0] / static_cast<double>(guards);
  out << std::fixed << std::setprecision(1)
      << "Calls beside their parts; ns per element (thread CPU time, medians in turns).\n"
         "  call        through the library\n"
         "  kernel      the compiled kernel of the library alone: no check of arguments, strides or handle; "
         "what the call costs more are those, and\n"
         "              the control word of floating point, read twice so that traps, rounding and sticky "
         "flags stay the caller's: "
      << guard
      << " ns\n"
         "  in turn     the same, each call waiting for the last number of the one before: one element's, or "
         "one register of elements', chain of\n"
         "              operations. Where it is as long as the kernel takes, the chain is the limit; where "
         "it is longer, calls overlap already\n"
         "  stores      of residual and tangent column by column in the widest registers, into the same "
         "places, without computing them\n"
         "  moves       inputs into registers, one element to a lane, and residuals out of them, without "
         "computing anything"
      << with_fused
      << "\n"
         "  operations  additions, multiplications, divisions and roots as "
      << 1e-9 * machine.flops
      << " Gflop/s would do them (not fused; divisions and\n"
         "              roots as cheap as additions, nothing that waits, nothing to be read, transposed or "
         "stored)\n"
         "  fused       how many times faster the kernel of 64 is if compiled for this machine with fused "
         "multiply-add, which gives every\n"
         "              machine its own bits"
      << with_fused << "\n\n"
      << std::setw(50) << "single" << std::setw(69) << "of 64"
      << "\n"
      << std::setw(32) << "call" << std::setw(9) << "kernel" << std::setw(9) << "in turn" << std::setw(12)
      << "call" << std::setw(9) << "kernel" << std::setw(9) << "in turn" << std::setw(9) << "stores"
      << std::setw(9) << "moves" << std::setw(9) << "oper." << std::setw(12) << "operations" << std::setw(9)
      << "fused"
      << "\n";
  for (const char* basis : {"line2", "tri3", "quad4", "quad9"})
    for (const bool enriched : {false, true})
      for (const Level& level : levels) print_level(out, machine, basis, enriched, level);
}

} // namespace bench
