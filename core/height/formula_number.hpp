// SPDX-License-Identifier: BSD-3-Clause
// What a height that is a formula says of itself. A file that describes one has
//
//   template <class P> struct Sine     its numbers as the formula needs them; P: double, or Dual<double>
//                                      where a number is differentiated by
//     type, formula                    its name in a model, and what the schema says of it
//     table                            its keys, from which the reader and the schema follow
//   set_height(sine, numbers, T)       from the numbers of the table
//   height_jet<T>(sine, s)             h and its derivatives, of any scalar
//   largest_height(sine)               a bound of |h|
//   feature_length(sine, a)            see Height::feature_length
//
// and a line in formulas.hpp.
#pragma once

#include <limits>

#include "core/height/jet.hpp"

namespace ents {

// A number of a formula, or one per surface coordinate.
struct FormulaNumber {
  enum Kind { any, positive, vector };
  const char* key;
  const char* meaning; // in the schema; may be empty
  Kind kind = any;
  bool named = false;                                          // may a parameter of the model stand for it?
  double otherwise = std::numeric_limits<double>::quiet_NaN(); // where the key is absent; NaN: it is required

  constexpr int count() const { return kind == vector ? 2 : 1; } // vectors of one coordinate are padded by 0
  constexpr bool required() const { return !(otherwise == otherwise); }
};

// Numbers of a table, one after the other.
template <int N> constexpr int count_numbers(const FormulaNumber (&table)[N], bool named_only = false) {
  int count = 0;
  for (const FormulaNumber& number : table)
    if (number.named || !named_only) count += number.count();
  return count;
}

inline constexpr int most_formula_numbers = 12;

} // namespace ents
