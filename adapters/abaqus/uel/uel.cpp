// SPDX-License-Identifier: BSD-3-Clause
// Abaqus/Standard UEL, and the programs that load one: MOOSE and OOFEM, which pass fewer arguments.
#include <cmath>
#include <limits>
#include <mutex>
#include <string>

#include "../../common/element.hpp"
#include "../../common/patch_watch.hpp"
#include "../abaqus.hpp"

namespace {

using namespace ents_adapter;

constexpr Host host{.nodes = "*USER ELEMENT, NODES=",
                    .history = "*USER ELEMENT, VARIABLES=",
                    .properties = "*UEL PROPERTY, entry ",
                    .directory = abaqus::job_directory,
                    .rotations = true,
                    .temperatures = true,
                    .heat = "Write the degrees of freedom 1, 2, 3, 11 (in the plane 1, 2, 11) for all nodes "
                            "below *USER ELEMENT",
                    .options = common_options | option_old_displacement | option_negative_tangent,
                    .numbers = abaqus::numbers};

/// LFLAGS(3): what is to be formed.
enum class Request {
  residual_and_stiffness = 1,
  stiffness = 2,
  damping = 3,
  mass = 4,
  residual = 5,
  mass_and_residual = 6,
  perturbation_output = 100
};

constexpr int elastic_energy = 1, plastic_energy = 3; ///< in ENERGY, counted from 0

/// MOOSE has numbers of its own there, 0, 4 and 5 for both, stiffness and residual, or passes no LFLAGS.
Request requested(const int* lflags, bool moose) {
  const int what = lflags ? lflags[2] : 0;
  if (moose && what == 4) return Request::stiffness;
  return static_cast<Request>(what ? what : 1);
}

/// MOOSE and Abaqus pass other displacements: an option that is not the host's gives forces of another place.
/// @return what to write; null: nothing is wrong
const char* wrong_host(const int* lflags, bool moose) {
  const int what = lflags ? lflags[2] : 0;
  if (!moose && (what == 0 || (what == 4 && !abaqus::is_host())))
    return "this program is MOOSE (LFLAGS(3) = 0 or 4, or none), which passes the displacements of the last "
           "step: add 2 to property 3";
  if (moose && what == 1)
    return "option 2 of property 3 is for MOOSE, and this program is not (LFLAGS(3) = 1): its displacements "
           "are the present ones, leave 2 out";
  return nullptr;
}

/// Increments, of which the host tells the ends by UEXTERNALDB, or else by a new number in the next call.
struct Increments {
  std::mutex mutex;
  bool has_ends = false; ///< UEXTERNALDB is called
  int step = 0, increment = 0;
  std::string lost; ///< not empty: the job has to end
};

Increments& increments() {
  static Increments& one = *new Increments; // never freed: threads of the host may outlive static objects
  return one;
}

void end_increment(Increments& all) {
  IncrementEnd end = increment_end(host);
  for (const std::string& text : end.warnings) abaqus::tell(abaqus::Severity::warning, text.c_str());
  if (end.lost.empty()) return;
  all.lost = std::move(end.lost);
  abaqus::tell(abaqus::Severity::error, all.lost.c_str());
}

/// An element is called. @return false: a contact has been lost, the job has to end
bool goes_on(const int* step, const int* increment) {
  Increments& all = increments();
  const std::lock_guard lock(all.mutex);
  if (!all.has_ends && step && increment && (*step != all.step || *increment != all.increment)) {
    const bool is_first = all.step == 0 && all.increment == 0;
    all.step = *step, all.increment = *increment;
    if (!is_first) end_increment(all);
  }
  return all.lost.empty();
}

void fill(double value, double* rhs, double* amatrx, int dofs, int columns, int mlvarx) {
  for (int k = 0; rhs && k < columns; ++k)
    for (int i = 0; i < dofs; ++i) rhs[i + static_cast<std::ptrdiff_t>(k) * mlvarx] = value;
  for (std::ptrdiff_t i = 0; amatrx && i < static_cast<std::ptrdiff_t>(dofs) * dofs; ++i) amatrx[i] = value;
}

} // namespace

ENTS_ENTRY(uel, UEL,
           (double* rhs, double* amatrx, double* svars, double* energy, int* ndofel, int* nrhs, int* nsvars,
            double* props, int* nprops, double* coords, int* mcrd, int* nnode, double* u, double* du, double*,
            double*, int*, double*, double* dtime, int* kstep, int* kinc, int* jelem, double*, int*, int*,
            double*, double*, int*, int* lflags, int* mlvarx, double*, int*, double* pnewdt, int*, int*,
            double*)) {
  const int dofs = *ndofel, nodes = *nnode, columns = nrhs && *nrhs > 0 ? *nrhs : 1;
  const int option = options({props}, *nprops);
  const bool moose = option > 0 && (option & option_old_displacement);
  const Request request = requested(lflags, moose);
  const bool perturbation = !moose && lflags && lflags[3] == 1; // MOOSE sets LFLAGS(3) alone
  fill(0, rhs, amatrx, dofs, columns, *mlvarx);
  if (const char* wrong = wrong_host(lflags, moose)) {
    abaqus::tell(abaqus::Severity::error,
                 ("ents, element " + std::to_string(jelem ? *jelem : 0) + ": " + wrong).c_str());
    if (!abaqus::is_host() || !abaqus::stop())
      fill(std::numeric_limits<double>::quiet_NaN(), rhs, amatrx, dofs, columns, *mlvarx);
    return;
  }
  if (!goes_on(kstep, kinc)) {
    if (!abaqus::is_host() || !abaqus::stop())
      fill(std::numeric_limits<double>::quiet_NaN(), rhs, amatrx, dofs, columns, *mlvarx);
    return;
  }
  if (request == Request::damping || request == Request::mass || request == Request::perturbation_output)
    return;

  Element e;
  e.host = &host;
  e.number = jelem ? *jelem : -1;
  e.nodes = nodes;
  e.properties = {props};
  e.property_count = *nprops;
  const int turns = reference_rotations(e);
  e.dofs = nodes > 0 ? (dofs - turns) / nodes : 0;
  e.reference_turns = turns > 0 && dofs == nodes * *mcrd + turns;
  e.coordinates = *mcrd;
  e.all_dofs = dofs;
  if (dofs == nodes * (*mcrd + 1)) e.temperature = *mcrd; // 11, behind the displacements
  // Where no time passes nothing moves, so friction makes no heat: any time will do.
  const bool increment = request == Request::residual_and_stiffness && !perturbation;
  e.time_increment = dtime && (increment || *dtime > 0) ? *dtime : 1;
  e.position = {coords, 1, *mcrd};
  e.displacement = {u, 1, e.dofs};
  if (moose) e.increment = {du, 1, e.dofs};
  static constexpr double nothing = 0.0; // has moved before a perturbation: what touches, touches here
  e.change = perturbation ? Grid<const double>{&nothing, 0, 0} : Grid<const double>{du, 1, e.dofs};
  // Where the host asks for both, DU leads from the begin of the increment to now; in a perturbation it does
  // not.
  if (e.reference_turns && !perturbation) e.spin = {du + dofs - turns};
  e.history = {svars};
  e.history_size = *nsvars;
  double dissipation = 0;
  e.sign = -1; // RHS is external minus internal force
  e.tangent_sign = option > 0 && (option & option_negative_tangent) ? -1 : 1;
  if (request != Request::stiffness && !perturbation) e.residual = {rhs, 1, e.dofs};
  if (request == Request::residual_and_stiffness || request == Request::stiffness)
    e.tangent = {amatrx, 1, dofs};
  // MOOSE asks for residual and stiffness in turn, with the history of before each time: the last one stays.
  if ((request == Request::residual_and_stiffness && !perturbation) || moose) {
    e.history_end = {svars};
    if (energy) e.energy = energy + elastic_energy, e.dissipation = &dissipation;
  }

  const Result result = evaluate(e);
  if (e.dissipation) energy[plastic_energy] += dissipation; // since the begin of the job
  if (result.outcome == Outcome::done) {
    if (result.message[0]) abaqus::tell(abaqus::Severity::information, result.message);
    // About the base state U the forces of the perturbation DU are -K DU.
    for (std::ptrdiff_t k = 0; perturbation && e.tangent && k < columns; ++k)
      negative_product({amatrx, 1, dofs}, dofs, du + k * *mlvarx, rhs + k * *mlvarx);
    return;
  }
  // Abaqus looks at PNEWDT where it asks for both, in a general step. A half-increment residual, from which
  // it chooses the next time step, may lack an element; a stiffness or an initial acceleration may not.
  const bool recoverable = result.outcome == Outcome::cut;
  const bool counts = !abaqus::is_host() || (request == Request::residual_and_stiffness && !perturbation);
  const bool cut = recoverable && counts && pnewdt;
  if (cut) *pnewdt = result.step_factor;
  if (recoverable && !counts) {
    const bool left_out = request == Request::residual;
    const std::string text =
        std::string(result.message) +
        (left_out ? "; left out of the half-increment residual"
                  : "; Abaqus cuts no increment here, LFLAGS(3) = " + std::to_string(lflags[2]) +
                        (perturbation ? " in a perturbation step" : ""));
    abaqus::tell(left_out ? abaqus::Severity::warning : abaqus::Severity::error, text.c_str());
    if (left_out) return;
  } else {
    abaqus::tell(cut ? abaqus::Severity::information : abaqus::Severity::error, result.message);
  }
  // A host that can neither cut nor stop gets numbers that it cannot take for a solution.
  if (!abaqus::is_host() || (!cut && !abaqus::stop()))
    fill(std::numeric_limits<double>::quiet_NaN(), rhs, amatrx, dofs, columns, *mlvarx);
}

/// LOP = 2: the increment has converged. XIT must not be called here: the next call of an element does.
ENTS_ENTRY(uexternaldb, UEXTERNALDB, (int* lop, int*, double*, double*, int*, int*)) {
  constexpr int end = 2;
  Increments& all = increments();
  const std::lock_guard lock(all.mutex);
  all.has_ends = true;
  if (*lop == end && all.lost.empty()) end_increment(all);
}
