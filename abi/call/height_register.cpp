// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <string_view>

#include "abi/call/entry_point.hpp"
#include "abi/read/height_registry.hpp"

extern "C" int32_t ents_height_register(const char* name, int32_t dimension, ents_height_function function,
                                        void* user_data, ents_report* report) {
  return ents::entry_point(report, [&] {
    if (!name) return ents::report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'name' is null");
    if (dimension < 1 || dimension > 2)
      return ents::report_message(
          report, ENTS_BAD_VALUE, -1,
          "dimension = %d is not 1 (segments that are lines) or 2 (segments that are surfaces)", dimension);
    const std::string_view text(name);
    if (text.empty() || text.size() > ents::longest_height_name)
      return ents::report_message(report, ENTS_BAD_VALUE, -1, "name has %lld characters; write 1 to %d",
                                  static_cast<long long>(text.size()),
                                  static_cast<int>(ents::longest_height_name));
    if (!ents::register_height({std::string(text), dimension, function, user_data}))
      return ents::report_message(report, ENTS_BAD_COUNT, -1,
                                  "%d height functions are registered, and no more are possible",
                                  static_cast<int>(ents::most_registered_heights));
    return ents::report_ok(report);
  });
}
