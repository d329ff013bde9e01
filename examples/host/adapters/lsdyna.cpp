// SPDX-License-Identifier: BSD-3-Clause
// LS-DYNA, usld_e101: blocks of 192 elements with the block index first, current coordinates of eight nodes.
// One element of the block is called; from call to call it is another one.
#include <algorithm>
#include <limits>

#include "program.hpp"

namespace host::adapters {
namespace {

constexpr std::size_t nlq = 192;
constexpr int solid = 8, dofs = 3 * solid, constants = 3;

void call_usld(void* library, UserElement& e) {
  using P = double*;
  using Usld = void(P, P, int*, int*, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P,
                    P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, P, int*,
                    int*, P, int*, P, int*, int*, P);
  static Usld* const usld = find<Usld>(library, "usld_e101_");
  // A megabyte that is not cleared for every element: only the entries of the called one count.
  static std::vector<double> force(nlq * dofs), stiff(nlq * dofs * dofs), hsv, energy(nlq), x(nlq * dofs),
      still(nlq);
  hsv.resize(nlq * e.state.size());
  const auto mine = at(e.place) % nlq;
  const int own = static_cast<int>(mine) + 1; // Fortran counts from 1
  for (int node = 0; node < solid; ++node)    // the last node again and again
    for (int i = 0; i < 3; ++i)
      x[mine + nlq * at(3 * node + i)] = e.position[at(3 * std::min(node, e.nodes - 1) + i)];
  for (std::size_t i = 0; i < e.state.size(); ++i) hsv[mine + nlq * i] = e.state[i];
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < dofs; ++i) force[mine + nlq * i] = nothing;
  for (std::size_t i = 0; i < dofs * dofs; ++i) stiff[mine + nlq * i] = nothing;

  int ndtot = dofs, istif = 1, nhsv = e.state_size, lmc = constants, ihsv = 0, first = own, last = own;
  const auto c = [&](int i, int node) { return x.data() + nlq * at(3 * node + i); };
  double* const d = still.data();
  usld(force.data(), stiff.data(), &ndtot, &istif, c(0, 0), c(0, 1), c(0, 2), c(0, 3), c(0, 4), c(0, 5),
       c(0, 6), c(0, 7), c(1, 0), c(1, 1), c(1, 2), c(1, 3), c(1, 4), c(1, 5), c(1, 6), c(1, 7), c(2, 0),
       c(2, 1), c(2, 2), c(2, 3), c(2, 4), c(2, 5), c(2, 6), c(2, 7), nullptr, d, d, d, d, d, d, d, d, d, d,
       d, d, d, d, d, d, d, d, d, d, d, d, d, d, nullptr, hsv.data(), &ihsv, &nhsv, e.properties.data(), &lmc,
       nullptr, &first, &last, energy.data());
  const int rows = e.rows();
  for (int j = 0; j < rows; ++j) {
    e.residual[at(j)] = force[mine + nlq * at(j)];
    for (int i = 0; i < rows; ++i) e.tangent[at(i + rows * j)] = stiff[mine + nlq * at(i + dofs * j)];
  }
  for (std::size_t i = 0; i < e.state.size(); ++i) e.state[i] = hsv[mine + nlq * i];
}

} // namespace

const Program lsdyna{.name = "lsdyna",
                     .file = "libents_lsdyna.so",
                     .title = "LS-DYNA",
                     .dimension = 3,
                     .nodes = solid,
                     .multipliers = false,
                     .cuts = false,
                     .call = call_usld};

} // namespace host::adapters

ENTS_HOST_SERVICE void adios_(int*) {
  host::adapters::stopped(host::adapters::lsdyna, "ADIOS; the reason is on standard error");
}
