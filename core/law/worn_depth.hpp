// SPDX-License-Identifier: BSD-3-Clause
// Wear of an element within an increment: what kernels know of it. Its formulas are in wear.hpp, compiled
// apart (laws.cpp).
#pragma once

#include "core/law/normal_force.hpp"
#include "core/law/touch.hpp"
#include "core/numbers/vec.hpp"

namespace ents::ENTS_ISA {

// What an element begins the increment with.
template <class S, int T> struct WornState {
  S depth, pressure;        // w_n of both surfaces, p_n
  S anchor[T], seen;        // xi_n; 1 where it is known, else the element has not slid yet
  S factor, sliding_factor; // of k and of Wear::sliding, for this slave node
};

template <class S, int D> struct WearOfIncrement {
  S slid;             // ds
  S lost = S(0.0);    // w - w_n
  S by_slid = S(0.0); // dW'/dds
  S by_gap;           // dds/dg at a fixed place
  S moved[D - 1];     // D
  Vec<S, D> m;
};

// ds, and what its variation needs
template <class S, int D>
void set_slid(const ContactLaw& law, const WornState<S, D - 1>& begin, const S (&xi)[D - 1],
              const Vec<S, D> (&tangents)[D - 1], const SlipShare<S>& slipping, WearOfIncrement<S, D>& to);
// The force of the law with wear; `to` has ds, and gets the rest. found: see worn_pressure()
template <class S, int D>
NormalForce<S> worn_force(const ContactLaw& law, const S& gap, const S& multiplier,
                          const WornState<S, D - 1>& begin, WearOfIncrement<S, D>& to, Truth<S>& found);

} // namespace ents::ENTS_ISA
