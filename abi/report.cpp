// SPDX-License-Identifier: BSD-3-Clause
#include <cstdarg>
#include <cstdio>

#include "abi/door.hpp"

namespace ents {

namespace {

void set_report(ents_report* report, std::int32_t status, std::int64_t element) noexcept {
  report->status = status;
  report->element = element;
  report->step_factor = status > 0 ? 0.5 : 1.0;
}

} // namespace

std::int32_t report_status(ents_report* report, std::int32_t status, std::int64_t element,
                           const char* text) noexcept {
  if (report) {
    set_report(report, status, element);
    std::size_t length = std::strlen(text);
    if (length >= sizeof report->message) {
      length = sizeof report->message - 1;
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
    set_report(report, status, element);
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(report->message, sizeof report->message, format, arguments);
    va_end(arguments);
  }
  return status;
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
