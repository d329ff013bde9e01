// SPDX-License-Identifier: BSD-3-Clause
#include "core/law/laws.hpp"

namespace ents {

double bond_dissipation(const ContactLaw& law, double begin, double end) {
  double taken = 0.0;
  ENTS_ISA::with_law(law.normal, [&](auto type) { taken = decltype(type)::dissipation(law, begin, end); });
  return taken;
}

} // namespace ents
