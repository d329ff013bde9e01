// SPDX-License-Identifier: BSD-3-Clause
// The heights that are formulas of a few numbers. A new one is a file like theirs, its line here, and the
// model's schema made anew (abi/bindings/schema.py).
#pragma once

#include "core/height/constant.hpp"
#include "core/height/gaussian.hpp"
#include "core/height/sine.hpp"

// X(member of HeightNode, template)
#define ENTS_FORMULA_HEIGHTS(X)                                                                              \
  X(constant, Constant)                                                                                      \
  X(sine, Sine)                                                                                              \
  X(gaussian, Gaussian)
