// SPDX-License-Identifier: BSD-3-Clause
// All normal laws: the force of a model's law at a gap, for a number, a dual number or one number per lane.
#pragma once

#include <iterator>

#include "core/law/exponential.hpp"
#include "core/law/multiplier.hpp"
#include "core/law/power.hpp"
#include "core/law/table.hpp"

namespace ents {

// What a law says of itself, for those who read and check a model.
struct LawEntry {
  NormalKind kind;
  const char* type;
  const LawNumber* numbers;
  std::int32_t count; // of numbers
  Multiplier multiplier;
  bool has_slope, wears, has_scale;
};
#define ENTS_LAW(name, law)                                                                                  \
  {NormalKind::name,          ENTS_ISA::law::type,                                                           \
   ENTS_ISA::law::table,      static_cast<std::int32_t>(std::size(ENTS_ISA::law::table)),                    \
   ENTS_ISA::law::multiplier, ENTS_ISA::law::has_slope,                                                      \
   ENTS_ISA::law::wears,      ENTS_ISA::law::has_scale},
inline constexpr LawEntry law_entries[] = {ENTS_NORMAL_LAWS(ENTS_LAW)};
#undef ENTS_LAW

// Sets the law, but not its numbers.
inline void set_normal_law(const LawEntry& entry, ContactLaw& law) {
  law.normal = entry.kind, law.multiplier = entry.multiplier;
  law.has_slope = entry.has_slope, law.has_scale = entry.has_scale;
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

// The gap [L] from which on there is contact; scale: of the slave node
template <class S> ENTS_INLINE S touching_gap(const ContactLaw& law, const S& scale) {
  S gap(0.0);
  with_law(law.normal, [&](auto type) ENTS_LAMBDA_INLINE { gap = decltype(type)::touching_gap(law, scale); });
  return gap;
}

// Is W'' constant in contact?
ENTS_INLINE bool is_linear(const ContactLaw& law) {
  bool linear = false;
  with_law(law.normal, [&](auto type) ENTS_LAMBDA_INLINE { linear = decltype(type)::is_linear(law); });
  return linear;
}

// multiplier: lambda of the augmented and the multiplier laws, a pressure; scale: of the slave node
template <class S>
ENTS_INLINE NormalForce<S> normal_force(const ContactLaw& law, const S& gap, const S& multiplier,
                                        const S& scale = S(1.0)) {
  NormalForce<S> f{S(0.0), S(0.0), S(0.0), S(1.0) < S(0.0)};
  if (law.normal == NormalKind::none) return f;
  with_law(law.normal, [&](auto type) ENTS_LAMBDA_INLINE {
    f = decltype(type)::template force<S>(law, {gap, multiplier, scale});
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
