// SPDX-License-Identifier: BSD-3-Clause
// Laws for kernels that call them out of line, once per instruction set.
#include "core/law/laws.hpp"

#include "core/law/friction.hpp"
#include "core/law/wear.hpp"

namespace ents::ENTS_ISA {

double bond_dissipation(const ContactLaw& law, double begin, double end) {
  double taken = 0.0;
  with_law(law.normal, [&](auto type) { taken = decltype(type)::dissipation(law, begin, end); });
  return taken;
}
bool is_linear(const ContactLaw& law) {
  bool linear = false;
  with_law(law.normal, [&](auto type) { linear = decltype(type)::is_linear(law); });
  return linear;
}

#define ENTS_OF_DIMENSION(S, D, T)                                                                           \
  template void set_slid<S, D>(const ContactLaw&, const WornState<S, T>&, const S(&)[T],                     \
                               const Vec<S, D>(&)[T], const SlipShare<S>&, WearOfIncrement<S, D>&);          \
  template NormalForce<S> worn_force<S, D>(const ContactLaw&, const S&, const S&, const WornState<S, T>&,    \
                                           WearOfIncrement<S, D>&, Truth<S>&);                               \
  template void evaluate_friction<S, T>(const ContactLaw&, const FrictionPlace<S, T>&,                       \
                                        const SlipBegin<S, T>&, const SlipShare<S>&, const S&, const S*,     \
                                        Friction<S, T>&);
#define ENTS_OF_SCALAR(S)                                                                                    \
  template NormalForce<S> normal_force<S>(const ContactLaw&, const S&, const S&, const S&, const S&);        \
  template S force_per_gap<S>(const ContactLaw&, const S&);                                                  \
  template S touching_gap<S>(const ContactLaw&, const S&, const S&);                                         \
  template Strength<S> strength<S>(const ContactLaw&, const S&);                                             \
  template S next_bond<S>(const ContactLaw&, const S&, const S&);                                            \
  ENTS_OF_DIMENSION(S, 2, 1) ENTS_OF_DIMENSION(S, 3, 2)
ENTS_OF_SCALAR(double)
ENTS_OF_SCALAR(Dual<double>)
#if ENTS_REGISTER_WIDTH > 1
ENTS_OF_SCALAR(Lanes<register_width>)
#endif
#undef ENTS_OF_SCALAR
#undef ENTS_OF_DIMENSION

} // namespace ents::ENTS_ISA
