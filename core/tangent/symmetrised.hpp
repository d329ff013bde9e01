// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace ents {

// (K + K^T) / 2 of a matrix with n columns, `leading` numbers apart
inline void symmetrise(int n, double* out, std::int64_t leading) {
  for (int j = 0; j < n; ++j)
    for (int i = j + 1; i < n; ++i)
      out[j * leading + i] = out[i * leading + j] = 0.5 * (out[j * leading + i] + out[i * leading + j]);
}

} // namespace ents
