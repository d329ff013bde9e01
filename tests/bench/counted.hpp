// A kernel scalar that counts its operations: the arithmetic of an element, on any processor.
#pragma once

#define ENTS_ISA counted
#include "core/law/friction.hpp"
#include "core/law/laws.hpp"
#include "core/tangent/friction_residual.hpp"
#include "core/tangent/reduced_friction_tangent.hpp"

namespace ents::counted {

struct Counted {
  double v;
  static inline std::int64_t operations = 0; // additions, multiplications, divisions, roots
  Counted() : v(0.0) {}
  Counted(double x) : v(x) {}
  static Counted count(double x) {
    ++operations;
    return x;
  }
  friend Counted operator+(Counted a, Counted b) { return count(a.v + b.v); }
  friend Counted operator-(Counted a, Counted b) { return count(a.v - b.v); }
  friend Counted operator*(Counted a, Counted b) { return count(a.v * b.v); }
  friend Counted operator/(Counted a, Counted b) { return count(a.v / b.v); }
  friend Counted operator-(Counted a) { return a.v * -1.0; }
  friend bool operator<(Counted a, Counted b) { return a.v < b.v; }
  friend bool operator>(Counted a, Counted b) { return a.v > b.v; }
  friend bool operator<=(Counted a, Counted b) { return a.v <= b.v; }
  friend bool operator>=(Counted a, Counted b) { return a.v >= b.v; }
};
inline Counted value_of(Counted a) { return a; }
inline Counted minus_value(Counted a, Counted b) { return a - b; }
inline Counted select(bool c, Counted a, Counted b) { return c ? a : b; }
inline double lane(Counted x, int) { return x.v; }
inline Counted square_root(Counted a) { return Counted::count(square_root(a.v)); }
inline Counted absolute(Counted a) { return absolute(a.v); }
inline Counted power_of_two(Counted n) { return power_of_two(n.v); }
inline void add_quarters(Counted quarters, Counted& sine, Counted& cosine) {
  add_quarters(quarters.v, sine.v, cosine.v);
}
inline void load_cell(const double* coefficients, Counted cell, Counted (&c)[4]) {
  for (int i = 0; i < 4; ++i) c[i] = coefficients[static_cast<std::int64_t>(cell.v) - 1 + i];
}
inline void load_cell(const double* coefficients, std::int64_t row_stride, Counted cell_1, Counted cell_2,
                      Counted (&c)[4][4]) {
  for (int j = 0; j < 4; ++j)
    load_cell(coefficients + (static_cast<std::int64_t>(cell_2.v) - 1 + j) * row_stride, cell_1, c[j]);
}
inline int store_numbers(const Counted& x, double* to) { return *to = x.v, 1; }
inline void load_numbers(const double* from, Counted& x) { x = Counted(*from); }
inline Dual<Counted> operator*(Dual<Counted> a, Counted b) { return {a.v * b, a.d * b}; }
inline Dual<Counted> operator*(Counted a, Dual<Counted> b) { return {a * b.v, a * b.d}; }
inline Dual<Counted> operator+(Dual<Counted> a, Counted b) { return {a.v + b, a.d}; }
inline Dual<Counted> operator+(Counted a, Dual<Counted> b) { return {a + b.v, b.d}; }

} // namespace ents::counted
