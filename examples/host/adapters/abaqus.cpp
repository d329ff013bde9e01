// SPDX-License-Identifier: BSD-3-Clause
// Abaqus/Standard and Abaqus/Explicit.
#include <algorithm>
#include <cstring>
#include <limits>

#include "program.hpp"

namespace host::adapters {
namespace {

std::string message; ///< the last one

/// UEL: RHS = -R; SVARS in place.
void call_uel(void* library, UserElement& e) {
  using Uel =
      void(double*, double*, double*, double*, int*, int*, int*, double*, int*, double*, int*, int*, double*,
           double*, double*, double*, int*, double*, double*, int*, int*, int*, double*, int*, int*, double*,
           double*, int*, int*, int*, double*, int*, double*, int*, int*, double*);
  static Uel* const uel = find<Uel>(library, "uel_");
  int ndofel = e.rows(), nrhs = 1, nsvars = e.state_size, nprops = static_cast<int>(e.properties.size()),
      number = e.place + 1, one = 1, none = 0, lflags[7] = {1, 1, 1, 0, 0, 0, 0};
  double energy[8] = {}, time[2] = {}, dtime = 1, params[3] = {}, unused = 0, pnewdt = 1e36, period = 1;
  std::vector<double> still(e.residual.size());
  int nodes = e.nodes;
  if (e.body) { // the turns are those of the reference node, with the same places in all arrays but AMATRX
    nodes = 2;
    ndofel = e.dimension == 2 ? 5 : 9;
    nsvars -= e.dimension == 2 ? 0 : 3;
  }
  uel(e.residual.data(), e.tangent.data(), e.state.data(), energy, &ndofel, &nrhs, &nsvars,
      e.properties.data(), &nprops, e.position.data(), &e.dimension, &nodes, e.displacement.data(),
      still.data(), still.data(), still.data(), &one, time, &dtime, &one, &one, &number, params, &none, &none,
      &unused, &unused, &none, lflags, &ndofel, &unused, &none, &pnewdt, &none, &none, &period);
  e.step_factor = std::min(pnewdt, 1.0);
  for (double& value : e.residual) value = -value;
  if (e.body && e.dimension == 2) // 5 x 5 into 6 x 6: the last dof of the node for the turns is none
    for (int column = 4; column >= 0; --column)
      for (int row = 4; row >= 0; --row) e.tangent[at(row + 6 * column)] = e.tangent[at(row + 5 * column)];
}

/// VUEL: blocks of elements with the block index first; rhs is the internal force. There is no tangent.
void call_vuel(void* library, UserElement& e) {
  using Vuel = void(int*, double*, double*, double*, double*, int*, double*, int*, int*, double*, int*, int*,
                    int*, double*, int*, double*, double*, double*, double*, int*, int*, double*, double*,
                    double*, double*, int*, int*, int*, double*, double*, int*, int*, double*);
  static Vuel* const vuel = find<Vuel>(library, "vuel_");
  constexpr int block = 3, mine = 1; // the neighbours are the same element
  int nblock = block, nsvars = e.state_size, ndofel = e.rows(),
      nprops = static_cast<int>(e.properties.size()), one = 1, none = 0, lflags[3] = {17, 1, 2},
      jelem[block] = {e.place + 1, e.place + 1, e.place + 1};
  double stable[block] = {}, energy[12 * block] = {}, time[2] = {}, period = 1, dtime = 1e-3,
         scale[block] = {1, 1, 1};
  const auto spread = [](const std::vector<double>& values) {
    std::vector<double> wide;
    for (const double value : values) wide.insert(wide.end(), at(block), value);
    return wide;
  };
  std::vector<double> coordinates(at(block * ndofel)),
      u = spread(e.displacement), still(u.size()), svars = spread(e.state),
      rhs(u.size(), std::numeric_limits<double>::quiet_NaN()), mass;
  for (int node = 0; node < e.nodes; ++node) // (block, node, coordinate)
    for (int i = 0; i < e.dimension; ++i)
      for (int b = 0; b < block; ++b)
        coordinates[at(b + block * (node + e.nodes * i))] = e.position[at(node * e.dimension + i)];
  vuel(&nblock, rhs.data(), mass.data(), stable, svars.data(), &nsvars, energy, &e.nodes, &ndofel,
       e.properties.data(), &nprops, nullptr, &none, coordinates.data(), &e.dimension, u.data(), still.data(),
       still.data(), still.data(), &one, jelem, time, &period, &dtime, &dtime, &one, &one, lflags, scale,
       nullptr, &none, nullptr, nullptr);
  for (int i = 0; i < ndofel; ++i) e.residual[at(i)] = rhs[at(mine + block * i)];
  for (int i = 0; i < nsvars; ++i) e.state[at(i)] = svars[at(mine + block * i)];
}

/// The models are in the working directory while an adapter is called.
void answer_directory(char* directory, int* length, std::size_t capacity) {
  std::memset(directory, ' ', capacity);
  directory[0] = '.';
  *length = 1;
}

void keep(const char* text, std::size_t length) { message.assign(text, length); }

} // namespace

const Program abaqus{.name = "abaqus",
                     .file = "libents_abaqus.so",
                     .title = "Abaqus/Standard",
                     .coordinates = true,
                     .call = call_uel};
const Program abaqus_explicit{.name = "abaqus_explicit",
                              .file = "libents_abaqus_explicit.so",
                              .title = "Abaqus/Explicit",
                              .multipliers = false,
                              .cuts = false,
                              .coordinates = true,
                              .tangent = false,
                              .call = call_vuel};

} // namespace host::adapters

ENTS_HOST_SERVICE void getoutdir_(char* directory, int* length, std::size_t capacity) {
  host::adapters::answer_directory(directory, length, capacity);
}
ENTS_HOST_SERVICE void vgetoutdir_(char* directory, int* length, std::size_t capacity) {
  host::adapters::answer_directory(directory, length, capacity);
}
ENTS_HOST_SERVICE void stdb_abqerr_(const int*, const char* text, const int*, const double*, const char*,
                                    std::size_t length, std::size_t) {
  host::adapters::keep(text, length);
}
ENTS_HOST_SERVICE void xplb_abqerr_(const int*, const char* text, const int*, const double*, const char*,
                                    std::size_t length, std::size_t) {
  host::adapters::keep(text, length);
}
ENTS_HOST_SERVICE void xit_() { host::adapters::stopped(host::adapters::abaqus, host::adapters::message); }
ENTS_HOST_SERVICE void xplb_exit_() {
  host::adapters::stopped(host::adapters::abaqus_explicit, host::adapters::message);
}
