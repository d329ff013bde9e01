// Elements whose tangent comes from automatic differentiation. Their files are compiled for the machine they
// are built on.
#pragma once

namespace bench {

struct DifferentiationInput {
  const double *slave, *master, *start; // [d], [m][d], [d-1]
  double area, stiffness;
  double amplitude, wave_vector[2], phase; // of the sine; turns
};
// residual [n], tangent [n][n]
using DifferentiatedElement = void (*)(const DifferentiationInput&, double* residual, double* tangent);

// basis: line2, tri3, quad4, quad9. Null: this program was built without the library.
DifferentiatedElement element_of_sacado(const char* basis, bool enriched);
DifferentiatedElement element_of_eigen(const char* basis, bool enriched);

} // namespace bench
