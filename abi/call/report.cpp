// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdarg>
#include <cstdio>

#include "abi/call/entry_point.hpp"

namespace ents {

namespace {

// Fill the fields the caller's report has; returns the bytes it has for the message.
std::size_t set_report(ents_report* report, std::int32_t status, std::int64_t element) noexcept {
  const auto size = static_cast<std::size_t>(report->struct_size);
  report->status = status;
  if (size >= offsetof(ents_report, step_factor)) report->element = element;
  if (size >= offsetof(ents_report, message)) report->step_factor = status > 0 ? 0.5 : 1.0;
  return size <= offsetof(ents_report, message)
             ? 0
             : std::min(size - offsetof(ents_report, message), sizeof report->message);
}

} // namespace

std::int32_t report_status(ents_report* report, std::int32_t status, std::int64_t element,
                           const char* text) noexcept {
  if (report) {
    const std::size_t room = set_report(report, status, element);
    if (room == 0) return status;
    std::size_t length = std::strlen(text);
    if (length >= room) {
      length = room - 1;
      while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0) == 0x80)
        --length; // whole UTF-8 characters
    }
    std::memcpy(report->message, text, length);
    report->message[length] = '\0';
  }
  return status;
}

std::int32_t report_message(ents_report* report, std::int32_t status, std::int64_t element,
                            const char* format, ...) noexcept {
  if (report) {
    const std::size_t room = set_report(report, status, element);
    if (room == 0) return status;
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(report->message, room, format, arguments);
    va_end(arguments);
  }
  return status;
}

void report_step(ents_report* report, double factor) noexcept {
  if (report && static_cast<std::size_t>(report->struct_size) >= offsetof(ents_report, message))
    report->step_factor = factor;
}

} // namespace ents

extern "C" const char* ents_status_text(int32_t status) {
  switch (status) {
#define ENTS_STATUS_CASE(name, value, text)                                                                  \
  case value:                                                                                                \
    return text;
    ENTS_STATUS_TABLE(ENTS_STATUS_CASE)
#undef ENTS_STATUS_CASE
  default:
    return "unknown status value";
  }
}
