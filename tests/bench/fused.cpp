// The kernels once more, as they are not built: multiplications and additions fused where the compiler can, for this machine. What
// equal bits on every machine cost.
#if defined(ENTS_BENCH_FUSED)
#define ENTS_ISA fused
#include "core/pair_table.hpp"
#endif

#include "block_kernel.hpp"

namespace bench {

#if defined(ENTS_BENCH_FUSED)
ents::PairKernel fused_kernel(const std::string& basis, bool enriched, bool friction) {
  using namespace ents::fused;
  if (basis == "line2") return pair_kernels_of<Line2>.of[enriched][friction];
  if (basis == "tri3") return pair_kernels_of<Tri3>.of[enriched][friction];
  if (basis == "quad4") return pair_kernels_of<Quad4>.of[enriched][friction];
  return nullptr;
}
#else
ents::PairKernel fused_kernel(const std::string&, bool, bool) { return nullptr; }
#endif

} // namespace bench
