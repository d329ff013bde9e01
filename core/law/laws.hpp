// SPDX-License-Identifier: BSD-3-Clause
// All normal laws, and what normal_force.hpp declares of them: included where they are compiled, where a model
// is read, and in tests of laws alone.
#pragma once

#include <iterator>

#include "core/law/adhesion.hpp"
#include "core/law/exponential.hpp"
#include "core/law/multiplier.hpp"
#include "core/law/power.hpp"
#include "core/law/table.hpp"
#include "core/law/tied.hpp"

namespace ents {

// What a law says of itself, for those who read and check a model.
struct LawEntry {
  NormalKind kind;
  const char* type;
  const LawNumber* numbers;
  std::int32_t count; // of numbers
  Multiplier multiplier;
  bool has_slope, wears, has_scale, pulls, adheres, bonds, is_damaged;
  const char* (*mistake)(const ContactLaw&); // see NormalLaw
};
#define ENTS_LAW(name, law)                                                                                  \
  {NormalKind::name,          ENTS_ISA::law::type,                                                           \
   ENTS_ISA::law::table,      static_cast<std::int32_t>(std::size(ENTS_ISA::law::table)),                    \
   ENTS_ISA::law::multiplier, ENTS_ISA::law::has_slope,                                                      \
   ENTS_ISA::law::wears,      ENTS_ISA::law::has_scale,                                                      \
   ENTS_ISA::law::pulls,      ENTS_ISA::law::adheres,                                                        \
   ENTS_ISA::law::bonds,      ENTS_ISA::law::is_damaged,                                                     \
   ENTS_ISA::law::mistake},
inline constexpr LawEntry law_entries[] = {ENTS_NORMAL_LAWS(ENTS_LAW)};
#undef ENTS_LAW

// Sets the law, but not its numbers.
inline void set_normal_law(const LawEntry& entry, ContactLaw& law) {
  law.normal = entry.kind, law.multiplier = entry.multiplier;
  law.has_slope = entry.has_slope, law.has_scale = entry.has_scale;
  law.pulls = entry.pulls, law.bonds = entry.bonds, law.is_damaged = entry.is_damaged;
}
// What is wrong with the numbers of the law, and what to write; or null
inline const char* mistake_of(const ContactLaw& law) {
  for (const LawEntry& entry : law_entries)
    if (entry.kind == law.normal) return entry.mistake(law);
  return nullptr;
}

namespace ENTS_ISA {

// f(law), an object of the type of this law; `none`: not called
template <class F> ENTS_INLINE void with_law(NormalKind kind, F&& f) {
  switch (kind) {
#define ENTS_LAW(name, law)                                                                                  \
  case NormalKind::name:                                                                                     \
    return f(law{});
    ENTS_NORMAL_LAWS(ENTS_LAW)
#undef ENTS_LAW
  case NormalKind::none:
    break;
  }
}

template <class S> S touching_gap(const ContactLaw& law, const S& scale, const S& bond) {
  S gap(0.0);
  with_law(law.normal,
           [&](auto type) ENTS_LAMBDA_INLINE { gap = decltype(type)::touching_gap(law, scale, bond); });
  return gap;
}
template <class S> Strength<S> strength(const ContactLaw& law, const S& scale) {
  Strength<S> of{S(0.0), S(0.0)};
  with_law(law.normal, [&](auto type) ENTS_LAMBDA_INLINE { of = decltype(type)::strength(law, scale); });
  return of;
}
template <class S> S next_bond(const ContactLaw& law, const S& gap, const S& bond) {
  S next(0.0);
  with_law(law.normal,
           [&](auto type) ENTS_LAMBDA_INLINE { next = decltype(type)::next_bond(law, gap, bond); });
  return next;
}
template <class S> S force_per_gap(const ContactLaw& law, const S& gap) {
  S per_gap(0.0);
  with_law(law.normal, [&](auto type) ENTS_LAMBDA_INLINE {
    per_gap = decltype(type)::template force_per_gap<S>(law, gap);
  });
  return per_gap;
}
template <class S>
NormalForce<S> normal_force(const ContactLaw& law, const S& gap, const S& multiplier, const S& scale,
                            const S& bond) {
  NormalForce<S> f{S(0.0), S(0.0), S(0.0), S(1.0) < S(0.0)};
  if (law.normal == NormalKind::none) return f;
  with_law(law.normal, [&](auto type) ENTS_LAMBDA_INLINE {
    f = decltype(type)::template force<S>(law, {gap, multiplier, scale, bond});
  });
  S open(0.0);
  if (law.multiplier != Multiplier::none)
    open = open_multiplier_energy(law_number<S>(law.number[0], law.rates.normal), multiplier);
  f.force = select(f.contact, f.force, S(0.0));
  f.stiffness = select(f.contact, f.stiffness, S(0.0));
  f.energy = select(f.contact, f.energy, open);
  return f;
}

} // namespace ENTS_ISA
} // namespace ents
