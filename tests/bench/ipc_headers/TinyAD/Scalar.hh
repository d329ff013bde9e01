// Stands in for TinyAD, which the IPC Toolkit's headers name; no function that ents-bench calls uses it.
#pragma once

namespace TinyAD {

struct ScalarBase {
  static void setVariableCount(int) {}
};
template <int variables, typename Number, bool with_hessian> struct Scalar;

} // namespace TinyAD
