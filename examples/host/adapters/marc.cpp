// SPDX-License-Identifier: BSD-3-Clause
// MSC Marc, USELEM with iflag 2: stiffness and forces; state variables come back as increments.
#include "program.hpp"

namespace host::adapters {
namespace {

void call_uselem(void* library, UserElement& e) {
  using Uselem = void(int*, double*, double*, int*, int*, double*, double*, int*, double*, double*, int*,
                      int*, int*, int*, int*, int*, double*, int*, int*, int*, double*, double*, double*,
                      double*, double*, double*, int*, double*, int*);
  static Uselem* const uselem = find<Uselem>(library, "uselem_");
  int number = e.place + 1, one = 1, rows = e.rows(), iflag = 2, none = 0;
  std::vector<double> mass, loads, still(e.residual.size()), change(e.state.size());
  uselem(&number, e.tangent.data(), mass.data(), &e.nodes, &e.dimension, loads.data(), e.residual.data(),
         &one, e.displacement.data(), still.data(), &none, &none, &none, &e.state_size, &none, &none,
         e.position.data(), &e.dimension, &iflag, &rows, e.state.data(), change.data(), nullptr, nullptr,
         nullptr, e.properties.data(), nullptr, nullptr, &none);
  for (std::size_t i = 0; i < change.size(); ++i) e.state[i] += change[i];
}

} // namespace

const Program marc{
    .name = "marc", .file = "libents_marc.so", .title = "MSC Marc", .cuts = false, .call = call_uselem};

} // namespace host::adapters

ENTS_HOST_SERVICE void quit_(int*) {
  host::adapters::stopped(host::adapters::marc, "QUIT; the reason is on standard error");
}
