// SPDX-License-Identifier: BSD-3-Clause
#include "core/element/kernel.hpp"

namespace ents::ENTS_ISA {
template const KernelSet& kernels_of<CountedBasis<3>>();
} // namespace ents::ENTS_ISA
