// SPDX-License-Identifier: BSD-3-Clause
// Height functions of the host, by name (ents_height_register).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "abi/ents.h"
#include "core/height/height_tree.hpp"

namespace ents {

struct RegisteredHeight {
  std::string name;
  std::int32_t dimension = 0; // surface coordinates
  ents_height_function function = nullptr;
  void* user_data = nullptr;
};

inline constexpr std::size_t longest_height_name = 64, most_registered_heights = 4096;

// Takes a lock for the time of the call. Null function: forget the name. False: there are
// most_registered_heights.
bool register_height(const RegisteredHeight& height);
// False: there is none of this name and dimension; `known` then lists those of the dimension.
bool find_registered_height(std::string_view name, std::int32_t dimension, RegisteredHeight& height,
                            std::vector<std::string>& known);

// What is declared of a function: no_range where nothing is.
struct CallbackBounds {
  double height = ExternalHeight::no_range, slope = ExternalHeight::no_range,
         curvature = ExternalHeight::no_range;
  double feature_length[2] = {Height::unbounded, Height::unbounded};
};
Height callback_height(const RegisteredHeight& registered, const CallbackBounds& bounds);

} // namespace ents
