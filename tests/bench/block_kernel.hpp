// The library's kernel of ordinary elements, as ents_evaluate calls it after its checks of the arguments.
#pragma once

#include "abi/call/handle.hpp"
#include "cases.hpp"

namespace bench {

class BlockKernel {
public:
  // pairs: null: the job's own. The job must outlive it.
  explicit BlockKernel(const Job& job, ents::BlockKernel pairs = nullptr);

  // All elements of the job, `some` per call. Throws if one is not ordinary.
  void run(std::int32_t some);
  // The same, and each call waits for the last number that the call before it wrote.
  void run_in_turn(std::int32_t some);

private:
  const ents::Plan& plan_;
  ents::BlockKernel pairs_;
  ents::ElementBlock block_{};
  std::int64_t count_;
  const double* last_; // of element 0
  std::int64_t last_stride_;
};

// Compiled with fused multiply-add; null where it is not built in (-DENTS_BENCH_FUSED=ON).
ents::BlockKernel fused_kernel(const std::string& basis, bool enriched, bool friction);
// Reads what the kernel reads and writes residuals of the same size, computing nothing; null as above.
ents::BlockKernel moving_kernel(const std::string& basis, bool enriched, bool friction);

} // namespace bench
