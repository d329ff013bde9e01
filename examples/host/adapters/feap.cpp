// SPDX-License-Identifier: BSD-3-Clause
// FEAPpv: the Fortran routine elmt07 with FEAP's common blocks. Both are in one module (feap/), for a program
// that is built without them can still call the other adapters.
#include <algorithm>
#include <cstdint>
#include <utility>

#include "program.hpp"

namespace host::adapters {
namespace {

// Common blocks of FEAPpv 5.1, as in feap/*.h.
struct Cdata {
  int numnp, numel, nummat, nen, neq, ipr, netyp;
};
struct Eldata {
  double dm;
  int n_el, ma, mct, iel, nel, pstyp, eltyp, elty2, elty3;
};
struct Eltran {
  double bpr[3], ctan[3];
};
struct Hdata {
  std::int64_t nh1, nh2, nh3, ht1, ht2, ht3;
  int nlm;
};
struct Comblk {
  double hr[1024];
  int mr[1024];
};

std::vector<double> material_line; ///< what pinput reads
bool ended = false;

void call_elmt07(void* library, UserElement& e) {
  using Elmt = void(double*, double*, double*, int*, double*, double*, double*, int*, int*, int*, int*);
  static Elmt* const elmt07 = find<Elmt>(library, "elmt07_");
  static auto* const cdata = find<Cdata>(library, "cdata_");
  static auto* const eldata = find<Eldata>(library, "eldata_");
  static auto* const eltran = find<Eltran>(library, "eltran_");
  static auto* const hdata = find<Hdata>(library, "hdata_");
  static auto* const comblk = find<Comblk>(library, "comblk_");
  cdata->nen = e.nodes + 1; // other elements of the job may have more nodes
  eldata->n_el = e.place + 1;
  eldata->nel = e.nodes;
  eltran->ctan[0] = 1;
  int ndf = e.dimension, nst = ndf * cdata->nen, rows = e.rows();
  std::vector<double> d(50), s(at(nst * nst)), p(at(nst)), xl = e.position, ul = e.displacement;
  xl.resize(at(nst)), ul.resize(at(6 * nst));
  const auto request = [&](int isw) {
    elmt07(d.data(), ul.data(), xl.data(), nullptr, nullptr, s.data(), p.data(), &ndf, &ndf, &nst, &isw);
    if (std::exchange(ended, false)) stopped(feap, "plstop; the reason is on standard error");
  };
  material_line = e.properties;
  request(1);
  if (hdata->nh1 != e.state_size) stopped(feap, "another history than that of the scene");
  hdata->nh1 = 1, hdata->nh2 = 101;
  std::copy(e.state.begin(), e.state.end(), comblk->hr + hdata->nh1 - 1);
  request(3);
  std::copy_n(comblk->hr + hdata->nh2 - 1, e.state_size, e.state.begin());
  for (int j = 0; j < rows; ++j) {
    e.residual[at(j)] = -p[at(j)];
    for (int i = 0; i < rows; ++i) e.tangent[at(i + rows * j)] = s[at(i + nst * j)];
  }
}

} // namespace

const Program feap{
    .name = "feap", .file = "ents_host_feap.so", .title = "FEAP", .cuts = false, .call = call_elmt07};

} // namespace host::adapters

ENTS_HOST_SERVICE int pinput_(double* d, int* count) {
  std::copy_n(host::adapters::material_line.begin(), *count, d);
  return 0;
}
/// FEAP stops here; an exception cannot pass through Fortran.
ENTS_HOST_SERVICE void plstop_(int*) { host::adapters::ended = true; }
