// SPDX-License-Identifier: BSD-3-Clause
// The library as this program calls it, with residual and tangent by automatic differentiation in the place
// of its own: what a host would pay that differentiates its contact elements.
#pragma once

#include "ents_library.hpp"
#include "scene.hpp"

namespace host::chart {

/// One at a time: while it lives, its assemble() belongs to this scene.
class AutomaticTangent {
public:
  /// @param scene  a rigid quad4 master whose height is a sine or a product of sines, with a penalty,
  ///               frictionless
  /// @throws JobError for another scene
  AutomaticTangent(const EntsLibrary& library, const Scene& scene);
  ~AutomaticTangent();
  AutomaticTangent(const AutomaticTangent&) = delete;
  AutomaticTangent& operator=(const AutomaticTangent&) = delete;

  const EntsLibrary& library() const { return library_; }

private:
  EntsLibrary library_;
};

} // namespace host::chart
