#include "block_kernel.hpp"

#include <bit>
#include <stdexcept>

namespace bench {

BlockKernel::BlockKernel(const Job& job, ents::BlockKernel pairs)
    : plan_(job.model().handle()->plan), pairs_(pairs ? pairs : plan_.block), count_(job.elements().count) {
  const ents_input& in = job.input();
  const ents_output& out = job.output();
  block_.slave = in.slave, block_.slave_stride = in.slave_stride;
  block_.master = in.master, block_.master_stride = in.master_stride;
  block_.surface_coordinates = in.surface_coordinates,
  block_.surface_coordinates_stride = in.surface_coordinates_stride;
  block_.start = in.start, block_.start_stride = in.start_stride;
  block_.area = in.area, block_.area_stride = in.area_stride;
  block_.state_begin = in.state_begin, block_.state_begin_stride = in.state_begin_stride;
  block_.wanted = out.wanted;
  block_.residual = out.residual, block_.residual_stride = out.residual_stride;
  block_.tangent = out.tangent, block_.tangent_stride = out.tangent_stride;
  block_.leading = plan_.dofs;
  const bool tangent = (out.wanted & ENTS_TANGENT) != 0;
  last_stride_ = tangent ? out.tangent_stride : out.residual_stride;
  last_ = (tangent ? out.tangent : out.residual) + last_stride_ - 1;
}

void BlockKernel::run(std::int32_t some) {
  for (block_.first = 0; block_.first < count_; block_.first += some)
    if (pairs_(plan_, block_, some) != ~std::uint64_t{0} >> (ents::ElementBlock::most - some))
      throw std::runtime_error("an element is not ordinary");
}

void BlockKernel::run_in_turn(std::int32_t some) {
  std::int64_t nothing = 0;
  asm volatile("" : "+r"(nothing)); // the compiler does not know that
  std::int64_t wait = 0;
  for (std::int64_t first = 0; first < count_; first += some) {
    block_.first = first + wait;
    if (pairs_(plan_, block_, some) != ~std::uint64_t{0} >> (ents::ElementBlock::most - some))
      throw std::runtime_error("an element is not ordinary");
    wait = std::bit_cast<std::int64_t>(last_[(first + some - 1) * last_stride_]) & nothing;
  }
}

} // namespace bench
