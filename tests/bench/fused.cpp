// The kernels once more for this machine, as they are not built: with multiplications and additions fused
// where the compiler can, which is what equal bits on every machine cost; and without any computation.
#if defined(ENTS_BENCH_FUSED)
#define ENTS_ISA fused
#include "core/element/fast_block.hpp"
#endif

#include "block_kernel.hpp"

namespace bench {

#if defined(ENTS_BENCH_FUSED)
namespace {

// Inputs into lanes, and as many numbers as a residual has out of them.
template <class B, bool H, bool F>
std::uint64_t move_numbers(const ents::Plan& plan, const ents::ElementBlock& block, std::int32_t count) {
  using namespace ents::fused;
  std::uint64_t done = 0;
#if defined(ENTS_HAS_LANES)
  constexpr int D = B::dim, T = D - 1, N = dof_count<B, false>, W = register_width;
  using S = Lanes<W>;
  if constexpr (W > 1)
    for (std::int32_t at = 0; at + W <= count; at += W) {
      const std::int64_t e = block.first + at;
      const LaneInputs<B, H, F, W> in(plan, block, e);
      S r[N];
      for (int c = 0; c < D; ++c) r[c] = in.area;
      const int nodes = node_count(in.nodes.basis);
      for (int a = 0; a < T; ++a) r[a] = F ? in.xi[a] - in.begin.from[a] : in.xi[a];
      if constexpr (F) r[D - 1] = r[D - 1] + in.begin.known;
      for (int i = 0; i < nodes; ++i)
        for (int c = 0; c < D; ++c) r[D * (i + 1) + c] = in.nodes.y[i][c];
      double* out[W];
      for (int k = 0; k < W; ++k) out[k] = block.residual + (e + k) * block.residual_stride;
      write_lanes<N>(
          out, [&](int i) ENTS_LAMBDA_INLINE { return r[i]; }, D * (nodes + 1));
      done |= std::uint64_t{in.known} << at;
    }
#endif
  return done;
}
template <class B> ents::BlockKernel moving_kernel_of(bool enriched, bool friction) {
  if (enriched) return friction ? move_numbers<B, true, true> : move_numbers<B, true, false>;
  return friction ? move_numbers<B, false, true> : move_numbers<B, false, false>;
}

} // namespace

ents::BlockKernel moving_kernel(const std::string& basis, bool enriched, bool friction) {
  using namespace ents::fused;
  if (basis == "line2") return moving_kernel_of<Line2>(enriched, friction);
  if (basis == "tri3") return moving_kernel_of<Tri3>(enriched, friction);
  if (basis == "quad4") return moving_kernel_of<Quad4>(enriched, friction);
  return moving_kernel_of<CountedBasis<3>>(enriched, friction);
}
template <class B> ents::BlockKernel fused_kernel_of(bool enriched, bool friction) {
  using namespace ents::fused;
  if (enriched) return friction ? evaluate_fast<B, true, true> : evaluate_fast<B, true, false>;
  return friction ? evaluate_fast<B, false, true> : evaluate_fast<B, false, false>;
}
ents::BlockKernel fused_kernel(const std::string& basis, bool enriched, bool friction) {
  using namespace ents::fused;
  if (basis == "line2") return fused_kernel_of<Line2>(enriched, friction);
  if (basis == "tri3") return fused_kernel_of<Tri3>(enriched, friction);
  if (basis == "quad4") return fused_kernel_of<Quad4>(enriched, friction);
  return nullptr;
}
#else
ents::BlockKernel fused_kernel(const std::string&, bool, bool) { return nullptr; }
ents::BlockKernel moving_kernel(const std::string&, bool, bool) { return nullptr; }
#endif

} // namespace bench
