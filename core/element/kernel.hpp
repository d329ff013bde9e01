// SPDX-License-Identifier: BSD-3-Clause
// Instantiates the kernels of one basis.
#pragma once

#include "core/element/element.hpp"
#include "core/element/general_element.hpp"
#include "core/element/heat_ingredients.hpp"
#include "core/element/kernel_table.hpp"
#include "core/element/surface_point.hpp"
#include "core/element/transfer.hpp"
#include "core/projection/search.hpp"

namespace ents::ENTS_ISA {

template <class B> const KernelSet& kernels_of() {
  static constexpr KernelSet kernels = {
      {evaluate_element<B, false>, evaluate_element<B, true>},
      {finish_element<B, false>, finish_element<B, true>},
      {evaluate_heat_ingredients<B, false>, evaluate_heat_ingredients<B, true>},
      {evaluate_rest<B, false>, evaluate_rest<B, true>},
      {evaluate_surface_point<B, false>, evaluate_surface_point<B, true>},
      {transfer_state<B, false>, transfer_state<B, true>},
      {project_on_segment<B, false>, project_on_segment<B, true>},
      {closest_border_point<B, false>, closest_border_point<B, true>},
      {segment_box<B, false>, segment_box<B, true>},
      hull_spread<B>};
  return kernels;
}

} // namespace ents::ENTS_ISA
