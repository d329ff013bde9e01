// SPDX-License-Identifier: BSD-3-Clause
// What a normal law is. A file that describes one has a struct derived from NormalLaw with
//
//   type, formula      its name in a model, and what the schema says of it
//   table              its keys, from which the reader, the schema and the parameters that may be bound follow
//   force(law, at)     W', W'' and W where there is contact, and whether there is, of any scalar
//
// and a line in laws.hpp. All are functions of numbers: they know no element and no model.
#pragma once

#include "core/law/normal_force.hpp"

namespace ents {

// A key of a law. The first number is ContactLaw::number[0], and a parameter of the model may stand for it.
struct LawNumber {
  enum Kind {
    positive,
    exponent, // a multiple of 1/2, 1 .. 20: ContactLaw::twice_exponent
    rising,   // numbers, with `falling` beside them: ContactLaw::table
    falling
  };
  const char* key;
  const char* meaning; // in the schema; may be empty
  Kind kind = positive;
  bool named = false; // may a parameter of the model stand for it?
};

namespace ENTS_ISA {

// What the law is asked for. multiplier: lambda, a pressure; scale: of the slave node, r of r p(g / r) or of r w;
// bond: of a law that bonds, from the state at the begin of the increment
template <class S> struct NormalPlace { const S &gap, &multiplier, &scale, &bond; };

// What most laws have.
struct NormalLaw {
  static constexpr Multiplier multiplier = Multiplier::none;
  static constexpr bool has_slope = false; // is W' = (W'/g) g with W'' = m W'/g? (power.hpp)
  static constexpr bool wears = true;      // may it stand with wear? Not if W'' falls as the gap does
  static constexpr bool has_scale = false; // has a slave node a scale of its own?
  static constexpr bool pulls = false;     // may W' be positive?
  static constexpr bool adheres = false;   // has it a strength()?
  static constexpr bool bonds =
      false; // has the state a number of it, next_bond() at the end of an increment?
  static constexpr bool is_damaged = false; // does a bond that grows take energy, dissipation()?
  static bool is_linear(const ContactLaw&) { return false; } // is W'' constant in contact?
  // What is wrong with numbers that are positive each, and what to write; or null
  static const char* mistake(const ContactLaw&) { return nullptr; }
  // The gap [L] from which on there is contact; of the scale and the bond of the element
  template <class S> static ENTS_INLINE S touching_gap(const ContactLaw&, const S&, const S&) {
    return S(0.0);
  }
  template <class S> static ENTS_INLINE Strength<S> strength(const ContactLaw&, const S&) {
    return {S(0.0), S(0.0)};
  }
  // W'/g, of a law that has a slope
  template <class S> static ENTS_INLINE S force_per_gap(const ContactLaw&, const S&) { return S(0.0); }
  template <class S> static ENTS_INLINE S next_bond(const ContactLaw&, const S&, const S&) { return S(0.0); }
  static double dissipation(const ContactLaw&, double, double) { return 0.0; } // from one bond to another
};

} // namespace ENTS_ISA
} // namespace ents
