// SPDX-License-Identifier: BSD-3-Clause
// What every function of ents.h does with its arguments before and after its work: it checks the sizes of
// structs, fills the caller's report, and turns exceptions into statuses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>

#include "abi/ents.h"

namespace ents {

// Write a report as far as it reaches (an older caller's is shorter); `text` is cut to the report's room.
// Returns the status. A null report is skipped.
std::int32_t report_status(ents_report* report, std::int32_t status, std::int64_t element,
                           const char* text) noexcept;

// The same with a printf-like message (only %s, %d, %lld, %g are used: the C locale's decimal point
// does not matter for what is printed).
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
std::int32_t
report_message(ents_report* report, std::int32_t status, std::int64_t element, const char* format,
               ...) noexcept;
// After a message: how much of the increment to take.
void report_step(ents_report* report, double factor) noexcept;

inline constexpr std::int32_t smallest_struct = 8; // struct_size and one more field
inline constexpr std::int32_t largest_struct =
    1 << 16; // no struct will ever be larger: a wild size is not read

// A size that some version of the struct may have: between the limits, and a multiple of its alignment as
// every sizeof.
template <class Struct> constexpr bool possible_size(std::int32_t size) noexcept {
  return size >= smallest_struct && size <= largest_struct &&
         size % static_cast<std::int32_t>(alignof(Struct)) == 0;
}

// Are the fields of a newer caller that this library does not know zero?
template <class Struct> bool zero_tail(const Struct* caller) noexcept {
  const unsigned char* bytes = reinterpret_cast<const unsigned char*>(caller);
  for (std::int32_t i = sizeof(Struct); i < caller->struct_size; ++i)
    if (bytes[i] != 0) return false;
  return true;
}

// Is the report itself usable? Null is.
inline bool report_usable(const ents_report* report) noexcept {
  return !report || report->struct_size == static_cast<std::int32_t>(sizeof(ents_report)) ||
         (possible_size<ents_report>(report->struct_size) && zero_tail(report));
}

inline std::int32_t report_ok(ents_report* report) noexcept {
  if (report) {
    if (report->struct_size < static_cast<std::int32_t>(sizeof(ents_report)))
      return report_status(report, ENTS_OK, -1, "");
    report->status = ENTS_OK;
    report->element = -1;
    report->step_factor = 1.0;
    report->message[0] = '\0';
  }
  return ENTS_OK;
}

// The caller's struct as this library knows it: itself when the sizes agree, a zero-extended copy when it
// is older, itself when it is newer with a zero tail. Null, with the report written, otherwise.
template <class Struct>
const Struct* known_struct(const Struct* caller, Struct& copy, const char* name, std::int32_t& status,
                           ents_report* report) noexcept {
  constexpr std::int32_t known = static_cast<std::int32_t>(sizeof(Struct));
  if (!caller) {
    status = report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null", name);
    return nullptr;
  }
  const std::int32_t size = caller->struct_size;
  if (size == known) return caller;
  if (!possible_size<Struct>(size)) {
    status = report_message(report, ENTS_STRUCT_SIZE, -1,
                            "%s.struct_size is %d; set it to sizeof (%d in this library)", name, size, known);
    return nullptr;
  }
  if (size < known) {
    std::memset(&copy, 0, sizeof copy);
    std::memcpy(&copy, caller, static_cast<std::size_t>(size));
    return &copy;
  }
  if (!zero_tail(caller)) {
    status = report_message(
        report, ENTS_STRUCT_SIZE, -1,
        "%s uses fields that this library (struct_size %d) does not know; zero them or update ents", name,
        known);
    return nullptr;
  }
  return caller;
}

// A field kept for later versions holds zero: what stands there by chance must not get a meaning one day.
inline std::int32_t check_reserved(std::int32_t reserved, const char* name, ents_report* report) noexcept {
  if (reserved == 0) return ENTS_OK;
  return report_message(report, ENTS_STRUCT_SIZE, -1, "%s.reserved is %d; zero the struct before filling it",
                        name, reserved);
}

// Write a filled struct back into the caller's, as far as the caller's reaches.
template <class Struct> void copy_to_caller(Struct& filled, Struct* caller) noexcept {
  const std::int32_t size = caller->struct_size;
  filled.struct_size = size;
  std::memcpy(caller, &filled,
              size < static_cast<std::int32_t>(sizeof filled) ? static_cast<std::size_t>(size)
                                                              : sizeof filled);
}

// Run an entry point's body; what it throws becomes a status.
template <class Body> std::int32_t entry_point(ents_report* report, Body&& body) noexcept {
  if (!report_usable(report)) return ENTS_STRUCT_SIZE;
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return report_status(report, ENTS_NO_MEMORY, -1, "out of memory");
  } catch (const std::exception& e) {
    return report_status(report, ENTS_INTERNAL, -1, e.what());
  } catch (...) {
    return report_status(report, ENTS_INTERNAL, -1, "unknown exception");
  }
}

} // namespace ents
