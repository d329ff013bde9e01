// SPDX-License-Identifier: BSD-3-Clause
// Ansys MAPDL, UserElem: history is handed back only when keyHisUpd says that the substep has converged.
#include "program.hpp"

namespace host::adapters {
namespace {

void call_userelem(void* library, UserElement& e) {
  using UserElem =
      void(int*, int*, int*, int*, int*, int*, int*, int*, int*, int*, int*, int*, int*, int*, double*,
           double*, double*, int*, int*, double*, int*, int*, double*, int*, double*, double*, double*,
           double*, double*, double*, double*, double*, int*, int*, int*, int*, int*, int*, int*, int*, int*,
           int*, double*, int*, int*, double*, double*, double*, double*, double*, double*, double*, double*,
           double*, int*, double*, int*, double*, int*, double*);
  static UserElem* const userelem = find<UserElem>(library, "userelem_");
  int number = e.place + 1, rows = e.rows(), one = 1, none = 0, nReal = static_cast<int>(e.properties.size()),
      failed = 0, converged = 1;
  double zero = 0, energy = 0;
  const std::size_t n = e.residual.size();
  std::vector<double> still(n), mass(n * n), damping(n * n), stress(n * n), loads(n);
  const auto call = [&](int keep_history) {
    int keyMtx[10] = {keep_history ? 0 : 1, 0, 0, 0, 1, 1};
    userelem(&number, &one, keyMtx, &none, &e.dimension, &e.nodes, nullptr, &one, &rows, &none, &none, &one,
             &none, nullptr, nullptr, nullptr, &zero, &none, &none, nullptr, &none, &nReal,
             e.properties.data(), &e.state_size, e.state.data(), e.position.data(), e.position.data(),
             e.displacement.data(), still.data(), still.data(), still.data(), still.data(), &none, &one, &one,
             &none, &none, &one, &keep_history, &one, &one, &one, &zero, &failed, &converged,
             e.tangent.data(), mass.data(), damping.data(), stress.data(), loads.data(), e.residual.data(),
             &zero, &zero, nullptr, &none, nullptr, &none, nullptr, &one, &energy);
    if (failed) stopped(ansys, "keyEleErr; the reason is on standard error");
  };
  call(0);
  if (!converged) e.step_factor = 0.5; // bisection
  if (converged && e.state_size > 0) call(1);
}

} // namespace

const Program ansys{.name = "ansys",
                    .file = "libents_ansys.so",
                    .title = "Ansys MAPDL",
                    .coordinates = true,
                    .call = call_userelem};

} // namespace host::adapters
