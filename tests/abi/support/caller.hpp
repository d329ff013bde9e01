// SPDX-License-Identifier: BSD-3-Clause
// The functions of ents.h as a host calls them whose invalid operations, divisions by zero and overflows
// trap: call::evaluate(...) is ents_evaluate(...) of such a host.
#pragma once

#include <cfenv>

#include "ents.hpp"

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

template <auto function> struct InHost;
template <class Result, class... Arguments, Result (*function)(Arguments...)> struct InHost<function> {
  static Result call(Arguments... arguments) {
    [[maybe_unused]] const HostEnvironment host;
    return function(arguments...);
  }
};

#define ENTS_IN_HOST(name) inline constexpr auto name = &InHost<&ents_##name>::call;
ENTS_FUNCTIONS(ENTS_IN_HOST)
#undef ENTS_IN_HOST

// The same as a table, for the objects of ents.hpp.
inline const ents::Library& library() {
  static const ents::Library table = [] {
    ents::Library functions;
#define ENTS_IN_TABLE(name) functions.name = name;
    ENTS_FUNCTIONS(ENTS_IN_TABLE)
#undef ENTS_IN_TABLE
    return functions;
  }();
  return table;
}

} // namespace call
