// SPDX-License-Identifier: BSD-3-Clause
// Abaqus/Explicit VUEL, double precision: blocks of elements, the block index first in every array.
#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "../../common/element.hpp"
#include "../../common/patch_watch.hpp"
#include "../abaqus.hpp"

namespace {

using namespace ents_adapter;

constexpr Host host{.nodes = "*USER ELEMENT, NODES=",
                    .history = "*USER ELEMENT, VARIABLES=",
                    .properties = "*UEL PROPERTY, entry ",
                    .directory = abaqus::job_directory,
                    .multipliers = false,
                    .options = common_options | option_negative_tangent,
                    .numbers = abaqus::numbers};

enum Operation { form_mass = 1, form_internal_force = 2, form_external_force = 3 }; // lflags(3)
constexpr int internal_energy = 2;                                                  // energy(:,3)

} // namespace

ENTS_ENTRY(vuel, VUEL,
           (int* nblock, double* rhs, double* amass, double* dtime_stable, double* svars, int* nsvars,
            double* energy, int* nnode, int* ndofel, double* props, int* nprops, int*, int*, double* coords,
            int* mcrd, double* u, double* du, double*, double*, int*, int* jelem, double*, double* period,
            double*, double*, int*, int*, int* lflags, double*, double*, int*, int*, double*)) {
  const std::ptrdiff_t block = *nblock, dofs = *ndofel, nodes = *nnode;
  if (lflags[2] == form_mass) {
    std::fill(amass, amass + block * dofs * dofs, 0.0); // that of the bodies
    return;
  }
  std::fill(rhs, rhs + block * dofs, 0.0);
  if (lflags[2] != form_internal_force) return;
  const int option = options({props}, *nprops);
  std::vector<double> tangent; // which Explicit does not want, but the selfcheck
  if (option > 0 && (option & option_selfcheck)) tangent.resize(static_cast<std::size_t>(dofs * dofs));
  for (std::ptrdiff_t b = 0; b < block; ++b) {
    Element e;
    e.host = &host;
    e.number = jelem[b];
    e.nodes = *nnode;
    e.dofs = *nnode > 0 ? *ndofel / *nnode : 0;
    e.coordinates = *mcrd;
    e.position = {coords + b, block * nodes, block};
    e.displacement = {u + b, block, block * e.dofs};
    e.change = {du + b, block, block * e.dofs};
    e.properties = {props};
    e.property_count = *nprops;
    e.history = {svars + b, block};
    e.history_size = *nsvars;
    e.sign = option > 0 && (option & option_negative_tangent) ? -1 : 1;
    e.residual = {rhs + b, block, block * e.dofs};
    if (!tangent.empty()) e.tangent = {tangent.data(), 1, dofs};
    e.history_end = {svars + b, block};
    e.energy = energy + b + block * internal_energy;
    dtime_stable[b] = *period; // the element has no mass of its own, so no limit either
    const Result result = evaluate(e);
    if (result.outcome == Outcome::done) {
      if (result.message[0]) abaqus::tell(abaqus::Severity::information, result.message);
      continue;
    }
    abaqus::tell(abaqus::Severity::error, result.message); // an explicit increment cannot be repeated
    if (!abaqus::stop()) std::fill(rhs, rhs + block * dofs, std::numeric_limits<double>::quiet_NaN());
    return;
  }
}

/// Ends of increments, of which every hundredth is compared with the patches, and of steps.
ENTS_ENTRY(vexternaldb, VEXTERNALDB, (int* lOp, int* i_array, int*, double*, int*)) {
  constexpr int end_of_increment = 4, end_of_step = 5, every = 100;
  constexpr int increment = 3, status = 4,
                terminate_analysis = 2; // entries of i_array, and a value of the second
  if (*lOp != end_of_step && (*lOp != end_of_increment || i_array[increment] % every != 0)) return;
  const IncrementEnd end = increment_end(host);
  for (const std::string& text : end.warnings) abaqus::tell(abaqus::Severity::warning, text.c_str());
  if (end.lost.empty()) return;
  abaqus::tell(abaqus::Severity::error, end.lost.c_str());
  i_array[status] = terminate_analysis;
}
