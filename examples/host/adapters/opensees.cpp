// SPDX-License-Identifier: BSD-3-Clause
// OpenSees, a loaded C element. Its history lives in the element; here an element lives for one evaluation:
// INIT with the words of its command, FORM, DELETE.
#include <algorithm>

#include "program.hpp"

extern "C" {
// Of OpenSees's elementAPI.h.
struct modelState {
  double time, dt;
};
struct eleObject {
  int tag, nNode, nDOF, nParam, nState, nMat;
  int* node;
  double *param, *cState, *tState;
  void** mats;
  void (*eleFunctPtr)(eleObject*, modelState*, double*, double*, int*, int*);
};
}

namespace host::adapters {
namespace {

enum Request { initialise = 0, revert = 2, form = 3, remove = 6 };

/// What OpenSees's functions answer while an element is being called.
struct Domain {
  std::vector<int> integers; ///< words of the command that are left
  std::vector<double> doubles;
  const UserElement* element = nullptr;
  std::vector<int> nodes;
  std::vector<double> param, committed, trial;
  std::string error;
} domain;

template <class T> int take(std::vector<T>& words, int count, T* data) {
  if (words.size() < at(count)) return -1;
  std::copy_n(words.begin(), count, data);
  words.erase(words.begin(), words.begin() + count);
  return 0;
}

int nodal(const std::vector<double>& values, int node, int count, double* data) {
  if (count != domain.element->dimension) return -1;
  std::copy_n(values.begin() + (node - 1) * count, count, data);
  return 0;
}

void call_element(void* library, UserElement& e) {
  using Function = void(eleObject*, modelState*, double*, double*, int*, int*);
  static Function* const function = find<Function>(library, "entsContact");
  eleObject element{};
  modelState state{0, -1};
  const auto request = [&](int isw, double* tang, double* resid) {
    int error = 0;
    function(&element, &state, tang, resid, &isw, &error);
    return error;
  };
  domain.integers = {e.place + 1, static_cast<int>(e.properties[0]), e.nodes};
  for (int node = 1; node <= e.nodes; ++node) domain.integers.push_back(node);
  domain.doubles = {e.properties[1], e.properties[2]};
  domain.element = &e;
  if (request(initialise, nullptr, nullptr) != 0) stopped(opensees, domain.error);
  if (element.nDOF != e.rows() || element.nState != e.state_size)
    stopped(opensees, "another element than that of the scene");
  domain.committed = e.state;
  element.cState = domain.committed.data();
  request(revert, nullptr, nullptr);
  // The script repeats a step that fails with half its size, whatever has failed.
  if (request(form, e.tangent.data(), e.residual.data()) != 0) e.step_factor = 0.5;
  e.state = domain.trial;
  request(remove, nullptr, nullptr);
}

} // namespace

const Program opensees{
    .name = "opensees", .file = "entsContact.so", .title = "OpenSees", .nodes = 18, .call = call_element};

} // namespace host::adapters

using host::adapters::at;
using host::adapters::domain;

ENTS_HOST_SERVICE int ops_getintinput_(int* count, int* data) {
  return host::adapters::take(domain.integers, *count, data);
}
ENTS_HOST_SERVICE int ops_getdoubleinput_(int* count, double* data) {
  return host::adapters::take(domain.doubles, *count, data);
}
ENTS_HOST_SERVICE int ops_allocateelement_(eleObject* element, int*, int*) {
  const double unset = -1e99; // OpenSees's memory is not zeroed
  domain.nodes.assign(at(element->nNode), -1);
  domain.param.assign(at(element->nParam), unset);
  domain.committed.assign(at(element->nState), unset);
  domain.trial.assign(at(element->nState), unset);
  element->node = domain.nodes.data();
  element->param = domain.param.data();
  element->cState = domain.committed.data();
  element->tState = domain.trial.data();
  return 0;
}
ENTS_HOST_SERVICE int ops_getnodecrd_(int* node, int* count, double* data) {
  return host::adapters::nodal(domain.element->position, *node, *count, data);
}
ENTS_HOST_SERVICE int ops_getnodedisp_(int* node, int* count, double* data) {
  return host::adapters::nodal(domain.element->displacement, *node, *count, data);
}
/// The history says where the element was: nothing has moved since.
ENTS_HOST_SERVICE int ops_getnodeincrdisp_(int*, int* count, double* data) {
  std::fill(data, data + *count, 0.0);
  return 0;
}
ENTS_HOST_SERVICE int ops_error_(char* text, int length) {
  domain.error.assign(text, at(length));
  while (!domain.error.empty() && domain.error.back() == '\n') domain.error.pop_back();
  return 0;
}
