// SPDX-License-Identifier: BSD-3-Clause
// The functions of ents.h as a host calls them: call::evaluate(...) is ents_evaluate(...). With
// ENTS_TEST_TRAPS=1 in the environment every call is made by a host whose invalid operations, divisions by
// zero and overflows trap, so that the same tests run twice.
#pragma once

#include <cfenv>
#include <cstdlib>

#include "ents.h"

namespace call {

class HostEnvironment {
public:
  HostEnvironment(const HostEnvironment&) = delete;
  HostEnvironment& operator=(const HostEnvironment&) = delete;
  HostEnvironment() {
    if (!traps()) return;
    std::feclearexcept(FE_ALL_EXCEPT); // a flag that stands would trap at once
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
  }
  ~HostEnvironment() {
    if (traps()) fedisableexcept(FE_ALL_EXCEPT);
  }

private:
  static bool traps() {
    static const bool wanted = std::getenv("ENTS_TEST_TRAPS") != nullptr;
    return wanted;
  }
};

template <class Function, class... Arguments> auto in_host(Function function, Arguments... arguments) {
  [[maybe_unused]] const HostEnvironment host;
  return function(arguments...);
}

template <class... A> int32_t check_contract(A... a) { return in_host(ents_check_contract, a...); }
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

} // namespace call
