// SPDX-License-Identifier: BSD-3-Clause
// Memory of an emulated host: filled with NaN before a call, with guard zones around it that must survive the
// call.
#pragma once

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace adapters {

inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

class Guarded {
public:
  explicit Guarded(std::size_t size) : memory_(size + 2 * zone, guard), size_(size) { poison(); }

  double* data() { return memory_.data() + zone; }
  double& operator[](std::size_t i) { return memory_[zone + i]; }
  std::size_t size() const { return size_; }
  void poison() {
    for (std::size_t i = 0; i < size_; ++i) data()[i] = std::numeric_limits<double>::quiet_NaN();
  }
  /// @throws std::runtime_error if a guard zone was written to
  void check_guards(const char* name) const {
    for (std::size_t i = 0; i < zone; ++i)
      if (memory_[i] != guard || memory_[zone + size_ + i] != guard)
        throw std::runtime_error(std::string("written beyond ") + name);
  }
  /// @throws std::runtime_error if one of the entries was not written
  void check_written(const char* name, std::size_t first, std::size_t count) const {
    for (std::size_t i = first; i < first + count; ++i)
      if (std::isnan(memory_[zone + i]))
        throw std::runtime_error(std::string(name) + "[" + std::to_string(i) + "] was not written");
  }
  /// @throws std::runtime_error if one of the entries was written
  void check_untouched(const char* name, std::size_t first, std::size_t count) const {
    for (std::size_t i = first; i < first + count; ++i)
      if (!std::isnan(memory_[zone + i]))
        throw std::runtime_error(std::string(name) + "[" + std::to_string(i) + "] was written");
  }

private:
  static constexpr std::size_t zone = 64;
  static constexpr double guard = -7.25e77;
  std::vector<double> memory_;
  std::size_t size_;
};

} // namespace adapters
