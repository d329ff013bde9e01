// SPDX-License-Identifier: BSD-3-Clause
// The functions of ents.h as a host calls them whose invalid operations, divisions by zero and overflows
// trap: call::evaluate(...) is ents_evaluate(...) of such a host.
#pragma once

#include <cfenv>

#include "ents.h"

namespace call {

class HostEnvironment {
public:
  HostEnvironment(const HostEnvironment&) = delete;
  HostEnvironment& operator=(const HostEnvironment&) = delete;
  HostEnvironment() {
    std::feclearexcept(FE_ALL_EXCEPT); // a flag that stands would trap at once
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
  }
  ~HostEnvironment() { fedisableexcept(FE_ALL_EXCEPT); }
};

template <class Function, class... Arguments> auto in_host(Function function, Arguments... arguments) {
  [[maybe_unused]] const HostEnvironment host;
  return function(arguments...);
}

template <class... A> int32_t check_contract(A... a) { return in_host(ents_check_contract, a...); }
template <class... A> int32_t height_register(A... a) { return in_host(ents_height_register, a...); }
template <class... A> int32_t model_create(A... a) { return in_host(ents_model_create, a...); }
template <class... A> int32_t model_create_from_file(A... a) {
  return in_host(ents_model_create_from_file, a...);
}
template <class... A> int32_t model_destroy(A... a) { return in_host(ents_model_destroy, a...); }
template <class... A> int32_t model_layout(A... a) { return in_host(ents_model_layout, a...); }
template <class... A> int32_t evaluate(A... a) { return in_host(ents_evaluate, a...); }
template <class... A> int32_t state_init(A... a) { return in_host(ents_state_init, a...); }
template <class... A> int32_t state_augment(A... a) { return in_host(ents_state_augment, a...); }
template <class... A> int32_t state_transfer(A... a) { return in_host(ents_state_transfer, a...); }
template <class... A> int32_t tributary_areas(A... a) { return in_host(ents_tributary_areas, a...); }
template <class... A> int32_t surface_evaluate(A... a) { return in_host(ents_surface_evaluate, a...); }
template <class... A> int32_t model_check(A... a) { return in_host(ents_model_check, a...); }
template <class... A> int32_t surface_check(A... a) { return in_host(ents_surface_check, a...); }
template <class... A> int32_t tree_size(A... a) { return in_host(ents_tree_size, a...); }
template <class... A> int32_t tree_build(A... a) { return in_host(ents_tree_build, a...); }
template <class... A> int32_t tree_refit(A... a) { return in_host(ents_tree_refit, a...); }
template <class... A> int32_t detect(A... a) { return in_host(ents_detect, a...); }

} // namespace call
