// Eigen: AutoDiffScalar with a vector of fixed size.
#include "differentiated.hpp"

#ifdef ENTS_BENCH_EIGEN
#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include "differentiated_element.hpp"

namespace bench {

namespace {

template <int N> struct Eigens {
  using Derivatives = Eigen::Matrix<double, ents::differentiation::padded(N), 1>;
  using Number = Eigen::AutoDiffScalar<Derivatives>;
  static Number make(double value, int dof) { return Number(value, ents::differentiation::padded(N), dof); }
  static double value(const Number& x) { return x.value(); }
  static double derivative(const Number& x, int dof) { return x.derivatives()[dof]; }
  static void set_derivative(Number& x, int dof, double v) { x.derivatives()[dof] = v; }
  static Number chain(double value, double slope, const Number& x) {
    return Number(value, slope * x.derivatives());
  }
};

} // namespace

DifferentiatedElement element_of_eigen(const char* basis, bool enriched) {
  return ents::differentiation::element_of<Eigens>(basis, enriched);
}

} // namespace bench
#else
namespace bench {
DifferentiatedElement element_of_eigen(const char*, bool) { return nullptr; }
} // namespace bench
#endif
