// SPDX-License-Identifier: BSD-3-Clause
// A number that differs whenever a bit of what went into it does (FNV-1a, 64 bits).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace host {

class Hash {
public:
  template <class Values> void add_all(const Values& values) {
    add(values.data(), values.size() * sizeof(values[0]));
  }
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash_ = (hash_ ^ bytes[i]) * 1099511628211u;
  }
  /// Hexadecimal, 16 digits.
  std::string text() const {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash_));
    return text;
  }

private:
  std::uint64_t hash_ = 14695981039346656037u;
};

} // namespace host
