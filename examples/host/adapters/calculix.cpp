// SPDX-License-Identifier: BSD-3-Clause
// CalculiX (ccx): forces and history in one pass, stiffness in the other.
#include <limits>

#include "program.hpp"

namespace host::adapters {
namespace {

void call_ccx(void* library, UserElement& e) {
  using Force = void(const int*, const int*, const int*, const char*, const double*, const double*,
                     const double*, const int*, const int*, const double*, double*, double*, int*, const int*,
                     const int*, const double*, double*, const int*, std::size_t);
  using Stiffness = void(const int*, const char*, double*, double*, double*, std::size_t);
  static Force* const force = find<Force>(library, "ents_ccx_force_");
  static Stiffness* const stiffness = find<Stiffness>(library, "ents_ccx_stiffness_");
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const int nelem = 1, first = 0, mi[3] = {1, 3, 1}, yes = 1;
  std::string label = "U1E  \x01\x03";
  label += static_cast<char>(e.nodes);
  std::vector<int> kon;
  for (int node = 1; node <= e.nodes; ++node) kon.push_back(node);
  // Node by node: temperature, then three displacements or forces.
  std::vector<double> v(4 * kon.size()), fn(4 * kon.size()), begin = e.state, s(3600, nothing),
                                                             sm(3600, nothing), ff(60, nothing);
  for (std::size_t i = 0; i < e.displacement.size(); ++i) v[4 * (i / 3) + 1 + i % 3] = e.displacement[i];
  double qa[4] = {0, 0, -1, 0};
  int nal = 0;
  force(&nelem, kon.data(), &first, label.data(), e.position.data(), v.data(), v.data(), mi, &first,
        e.properties.data(), fn.data(), qa, &nal, &yes, &yes, begin.data(), e.state.data(), &e.state_size, 8);
  stiffness(&nelem, label.data(), s.data(), sm.data(), ff.data(), 8);
  if (qa[2] > 0) e.step_factor = qa[2];
  const std::size_t rows = e.residual.size();
  for (std::size_t i = 0; i < rows; ++i) {
    e.residual[i] = fn[4 * (i / 3) + 1 + i % 3];
    for (std::size_t j = 0; j < rows; ++j) e.tangent[i + rows * j] = s[i + 60 * j];
  }
}

} // namespace

const Program calculix{.name = "calculix",
                       .file = "libents_calculix.so",
                       .title = "CalculiX",
                       .dimension = 3,
                       .nodes = 20,
                       .call = call_ccx};

} // namespace host::adapters
