// SPDX-License-Identifier: BSD-3-Clause
// Laws with tension at positive gaps, from energies: W(0) = - w, w the work of adhesion [F/L], t = W' the tension
// (theory.md, section 4.7).
//   dugdale        tension s over a length w / s (Maugis, J. Colloid Interface Sci. 150 (1992) 243), C1
//   separation     t = (w / d) u e^-u, u = g / d (Xu and Needleman, J. Mech. Phys. Solids 42 (1994) 1397)
//   lennard_jones  t = C (s^3 - s^9 - c (1 - s^2)^2), s = z_0 / (z_0 + g) (Greenwood, Proc. R. Soc. A 453
//                  (1997) 1277; the last term makes it 0 at the range, and keeps place and kind of equilibrium)
// Of a slave node the work of adhesion is r w, r its scale: a map of the adhesion.
#pragma once

#include "core/law/normal_law.hpp"
#include "core/numbers/elementary.hpp"

namespace ents::ENTS_ISA {

// What adhesive laws share.
struct AdhesiveLaw : NormalLaw {
  static constexpr bool wears = false, pulls = true, has_scale = true, adheres = true;

  // r w
  template <class S> static ENTS_INLINE S work(const ContactLaw& law, const S& scale) {
    return scale * law_number<S>(law.number[0], law.rates.normal);
  }
};

struct Dugdale : AdhesiveLaw {
  static constexpr char type[] = "dugdale",
                        formula[] =
                            "Adhesion: pressure -stiffness g for gap g < 0, then a tension that rises "
                            "to strength, stays there, and falls to 0 smoothly around work/strength "
                            "(Maugis 1992). Not with wear.";
  static constexpr LawNumber table[] = {
      {"work", "Work of adhesion [F/L]; a slave node may have a factor of it, ents_input.slave_values[3].",
       LawNumber::positive, true},
      {"strength", "Largest tension [F/L^2]."},
      {"stiffness", "[F/L^3], at least 1.6 strength^2/work."}};
  static constexpr double fall = 0.25; // part of w / s in which the tension falls

  static const char* mistake(const ContactLaw& law) {
    return law.number[2] * law.number[0] >= 1.6 * law.number[1] * law.number[1]
               ? nullptr
               : "has a stiffness with which the tension would rise over more than its work of adhesion; "
                 "write a "
                 "stiffness of at least 1.6 strength^2 / work";
  }
  // The places between which the tension is constant, and where it ends. The area below is the work of
  // adhesion: 2/3 of the rise, all of the middle, half of the fall.
  template <class S> struct Places { S rise, flat, end; };
  template <class S> static ENTS_INLINE Places<S> places(const ContactLaw& law, const S& scale) {
    const S length = work<S>(law, scale) / law.number[1], most = (1.5 - 0.75 * fall) * length;
    S rise(2.0 * law.number[1] / law.number[2]);
    rise = select(rise < most, rise, most); // of a node with little adhesion
    const S middle = length + rise / 3.0;
    return {rise, middle - (0.5 * fall) * length, middle + (0.5 * fall) * length};
  }
  template <class S> static ENTS_INLINE S touching_gap(const ContactLaw& law, const S& scale, const S&) {
    return places(law, scale).end;
  }
  template <class S> static ENTS_INLINE Strength<S> strength(const ContactLaw& law, const S& scale) {
    return {S(law.number[1]), places(law, scale).rise};
  }

  template <class S>
  static ENTS_INLINE NormalForce<S> force(const ContactLaw& law, const NormalPlace<S>& at) {
    const double most = law.number[1], stiffness = law.number[2];
    const Places<S> of = places(law, at.scale);
    const S& g = at.gap;
    const S one(1.0), none(0.0), all = -work<S>(law, at.scale);
    // pressure
    const S deep = select(g < 0.0, g, none);
    // u: of the rise, from 0 to 1
    const S u = clamp(g / of.rise, 0.0, 1.0), left = one - u;
    // v: of the fall
    const S width = of.end - of.flat, v = clamp((g - of.flat) / width, 0.0, 1.0);
    const S falling = v * v * (3.0 - 2.0 * v), middle = clamp_to(g - of.rise, of.flat - of.rise);
    const S tension = most * (one - left * left - falling);
    const S area =
        most * (of.rise * (u * u - u * u * u / 3.0) + middle + width * (v - v * v * v + 0.5 * v * v * v * v));
    const S slope = most * (2.0 * left / of.rise - 6.0 * v * (one - v) / width);
    const Truth<S> presses = g < 0.0;
    return {select(presses, stiffness * deep, tension), select(presses, S(stiffness), slope),
            select(presses, all + 0.5 * stiffness * deep * deep, all + area), g < of.end};
  }

private:
  // x between 0 and `most`
  template <class S> static ENTS_INLINE S clamp_to(const S& x, const S& most) {
    const S above = larger(x, S(0.0));
    return select(above < most, above, most);
  }
};

struct Separation : AdhesiveLaw {
  static constexpr char type[] = "separation",
                        formula[] =
                            "Adhesion: W = -work (1 + u) exp(-u), u = g/length (Xu and Needleman 1994): "
                            "the largest tension work/(e length) is at g = length; none from 25 "
                            "lengths on. Not with wear.";
  static constexpr LawNumber table[] = {
      {"work", "Work of adhesion [F/L]; a slave node may have a factor of it, ents_input.slave_values[3].",
       LawNumber::positive, true},
      {"length", "Gap of the largest tension [L]."}};
  static constexpr double last = 25.0; // lengths: there the tension is 1e-9 of the largest

  template <class S> static ENTS_INLINE S touching_gap(const ContactLaw& law, const S&, const S&) {
    return S(last * law.number[1]);
  }
  template <class S> static ENTS_INLINE Strength<S> strength(const ContactLaw& law, const S& scale) {
    constexpr double e = 2.718281828459045235;
    return {work<S>(law, scale) * (1.0 / (e * law.number[1])), S(law.number[1])};
  }
  template <class S>
  static ENTS_INLINE NormalForce<S> force(const ContactLaw& law, const NormalPlace<S>& at) {
    const double length = law.number[1];
    const S u = at.gap * (1.0 / length), w = work<S>(law, at.scale),
            e = w * exponential(clamp(-u, -last, 200.0));
    return {(u * e) * (1.0 / length), ((1.0 - u) * e) * (1.0 / (length * length)), -((1.0 + u) * e),
            u < last};
  }
};

struct LennardJones : AdhesiveLaw {
  static constexpr char type[] = "lennard_jones",
                        formula[] =
                            "Adhesion: tension (8 work/(3 length)) (s^3 - s^9), s = length/(length + g), "
                            "with a small term that ends it at g = range and factor that keeps the work "
                            "(Lennard-Jones 9-3; Greenwood 1997). Not with wear.";
  static constexpr LawNumber table[] = {
      {"work", "Work of adhesion [F/L]; a slave node may have a factor of it, ents_input.slave_values[3].",
       LawNumber::positive, true},
      {"length",
       "Distance of the surfaces at gap 0 [L]: the largest tension 1.03 work/length is at g = 0.2 length."},
      {"range", "Gap from which on there is no tension [L]."}};
  static constexpr double steepest = 2.0; // s of the deepest place of the formula; a straight line goes on

  template <class S> static ENTS_INLINE S touching_gap(const ContactLaw& law, const S&, const S&) {
    return S(law.number[2]);
  }

  // What the law is without its work: s and c of the last place, and the integral of the tension
  struct Shape {
    double end, cut, scale;
    explicit Shape(const ContactLaw& law) : end(law.number[1] / (law.number[1] + law.number[2])) {
      const double end2 = end * end, room = 1.0 - end2;
      cut = end * end2 * (1.0 + end2 + end2 * end2) / room; // (s^3 - s^9) / (1 - s^2)^2
      scale = 1.0 / (law.number[1] * (energy(end) - energy(1.0)));
    }
    // Of the tension over z / z_0 = 1 / s, up to a constant
    template <class S> ENTS_INLINE S energy(const S& s) const {
      const S s2 = s * s, s4 = s2 * s2;
      return s4 * s4 * 0.125 - 0.5 * s2 - cut * (1.0 / s + 2.0 * s - s * s2 * (1.0 / 3.0));
    }
    template <class S> ENTS_INLINE S tension(const S& s) const {
      const S s2 = s * s, s3 = s * s2, left = 1.0 - s2;
      return s3 - s3 * s3 * s3 - cut * (left * left);
    }
    // by z / z_0
    template <class S> ENTS_INLINE S slope(const S& s) const {
      const S s2 = s * s, s4 = s2 * s2;
      return 9.0 * (s4 * s4 * s2) - 3.0 * s4 - (4.0 * cut) * (s * s2 * (1.0 - s2));
    }
  };

  template <class S> static ENTS_INLINE Strength<S> strength(const ContactLaw& law, const S& scale) {
    const Shape of(law);
    constexpr double s = 0.83268317765560428; // 3^(-1/6)
    return {work<S>(law, scale) * (of.scale * of.tension(s)), S(law.number[1] * (1.0 / s - 1.0))};
  }
  template <class S>
  static ENTS_INLINE NormalForce<S> force(const ContactLaw& law, const NormalPlace<S>& at) {
    const double length = law.number[1], deepest = 1.0 / steepest;
    const Shape of(law);
    const S scale = of.scale * work<S>(law, at.scale), z = 1.0 + at.gap * (1.0 / length);
    const S inside = clamp(z, deepest, 1.0 / of.end), s = 1.0 / inside;
    const S t = of.tension(s), slope = of.slope(s), beyond = select(z < deepest, z - deepest, S(0.0));
    const S energy = of.energy(s) - of.energy(of.end) + beyond * (t + 0.5 * slope * beyond);
    return {scale * (t + slope * beyond), (scale * slope) * (1.0 / length), (scale * length) * energy,
            at.gap < law.number[2]};
  }
};

} // namespace ents::ENTS_ISA
