// SPDX-License-Identifier: BSD-3-Clause
// FEAP and FEAPpv: what the Fortran routine elmtNN (elmt07.f) calls.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

#include "../common/element.hpp"
#include "../common/limits.hpp"
#include "../common/patch_watch.hpp"

#define FEAP_API extern "C" __attribute__((visibility("default")))

namespace {

using namespace ents_adapter;

constexpr Host host{"nodes of the elements: ", "history variables (set by the element): ",
                    "MATErial, user 7, entry ", [] { return std::string(); }};

Element describe(const double* d, int nodes, int ndf, int ndm) {
  Element e;
  e.host = &host;
  e.nodes = nodes;
  e.dofs = ndf;
  e.coordinates = ndm;
  e.properties = {d};
  e.property_count = 3;
  return e;
}

void keep(const char* message, char* text, int length) {
  std::memset(text, ' ', static_cast<std::size_t>(length));
  const std::size_t size = std::strlen(message);
  std::memcpy(text, message,
              size < static_cast<std::size_t>(length) ? size : static_cast<std::size_t>(length));
}

} // namespace

/// isw 1: history words that the model needs.
/// @param nodes  of the largest element of the job, which may be another one's
/// @return 0; 1: text (blank padded) says why the job should stop
FEAP_API int ents_feap_check(const double* d, int nodes, int ndf, int ndm, int* history, char* text,
                             int length) {
  static constexpr Host any{"nodes of the elements: ", "", "MATErial, user 7, entry ",
                            [] { return std::string(); }, true};
  // Areas from the table are the elements', of which there are none yet.
  const double properties[3] = {d[0], d[1] == 0 ? 1 : d[1], d[2]};
  Element e = describe(properties, nodes, ndf, ndm);
  e.host = &any;
  e.history_size = largest_history;
  const Result result = check(e);
  *history = result.state_size;
  keep(result.message, text, length);
  return result.outcome == Outcome::done ? 0 : 1;
}

/// isw 3, 6: p = -R, s = factor K.
/// @param factor  ctan(1)
/// @return 0; 1: stop; 2: the selfcheck has something to say
FEAP_API int ents_feap_form(const double* d, const double* xl, const double* ul, const double* du, int number,
                            int nodes, int ndf, int ndm, int nst, int tangent, double factor,
                            const double* begin, double* end, int history, double* s, double* p, char* text,
                            int length) {
  Element e = describe(d, nodes, ndf, ndm);
  e.number = number;
  e.position = {xl, 1, ndm};
  e.displacement = {ul, 1, ndf};
  e.change = {du, 1, ndf};
  e.history = {begin};
  e.history_size = history;
  e.sign = -1;
  e.tangent_sign = factor;
  e.residual = {p, 1, ndf};
  if (tangent) e.tangent = {s, 1, nst};
  e.history_end = {end};
  const Result result = evaluate(e);
  keep(result.message, text, length);
  return result.outcome != Outcome::done ? 1 : result.message[0] ? 2 : 0;
}

/// isw 12: the step that TIME ends has converged.
/// @return 0; 1: stop, a contact is lost; 2: there is something to say
FEAP_API int ents_feap_step_end(int number, char* text, int length) {
  const IncrementEnd end = element_converged(host, number);
  std::string words;
  for (const std::string& warning : end.warnings) words += (words.empty() ? "" : "; ") + warning;
  if (!end.lost.empty()) words = end.lost;
  keep(words.c_str(), text, length);
  return !end.lost.empty() ? 1 : words.empty() ? 0 : 2;
}
