// Stands in for the IPC Toolkit's logger of the same path, so that spdlog is not needed: silent.
#pragma once

#include <stdexcept>
#include <string>

namespace ipc {

struct Logger {
  template <typename... Arguments> void warn(const Arguments&...) const {}
  template <typename... Arguments> void error(const Arguments&...) const {}
};
inline Logger logger() { return {}; }

template <typename... Arguments>
[[noreturn]] void log_and_throw_error(const std::string& message, const Arguments&...) {
  throw std::runtime_error(message);
}

} // namespace ipc
