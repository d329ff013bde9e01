// Sacado (Trilinos): forward numbers of fixed size, Sacado::Fad::SFad.
#include "differentiated.hpp"

#ifdef ENTS_BENCH_SACADO
#define TRILINOS_NO_CONFIG_H // or the other parts of Trilinos that Debian built it with, MPI among them, are
                             // wanted, too
#include <Sacado_No_Kokkos.hpp>

#include "differentiated_element.hpp"

namespace bench {

namespace {

template <int N> struct Sacados {
  using Number = Sacado::Fad::SFad<double, ents::differentiation::padded(N)>;
  static Number make(double value, int dof) { return Number(ents::differentiation::padded(N), dof, value); }
  static double value(const Number& x) { return x.val(); }
  static double derivative(const Number& x, int dof) { return x.fastAccessDx(dof); }
  static void set_derivative(Number& x, int dof, double v) { x.fastAccessDx(dof) = v; }
  static Number chain(double value, double slope, const Number& x) {
    Number y(value);
    for (int i = 0; i < ents::differentiation::padded(N); ++i) y.fastAccessDx(i) = slope * x.fastAccessDx(i);
    return y;
  }
};

} // namespace

DifferentiatedElement element_of_sacado(const char* basis, bool enriched) {
  return ents::differentiation::element_of<Sacados>(basis, enriched);
}

} // namespace bench
#else
namespace bench {
DifferentiatedElement element_of_sacado(const char*, bool) { return nullptr; }
} // namespace bench
#endif
