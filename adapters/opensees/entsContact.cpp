// SPDX-License-Identifier: BSD-3-Clause
// OpenSees: element entsContact, loaded at run time from entsContact.so. The interface is that of OpenSees's
// elementAPI.h.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <vector>

#include "../common/element.hpp"

extern "C" {

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

int ops_getintinput_(int* count, int* data);
int ops_getdoubleinput_(int* count, double* data);
int ops_allocateelement_(eleObject* element, int* material_tags, int* material_type);
int ops_getnodecrd_(int* node, int* count, double* data);
int ops_getnodedisp_(int* node, int* count, double* data);
int ops_error_(char* text, int length);

} // extern "C"

namespace {

using namespace ents_adapter;

constexpr Host host{"element entsContact tag k nodes..., with nodes: ", "", "element entsContact, property ",
                    [] { return std::string(); }};

enum Request { initialise = 0, commit = 1, revert = 2, form = 3, mass = 4, revert_to_start = 5 };
constexpr int largest_nodes = 18, largest_dofs = 3 * largest_nodes,
              parameters = 4; // k, area, options, dimension

int tell(const char* text) {
  char line[1100];
  std::snprintf(line, sizeof line, "%s\n", text);
  ops_error_(line, static_cast<int>(std::strlen(line)));
  return -1;
}

/// element entsContact tag k number_of_nodes nodes... area options
int read(eleObject* ele) {
  int head[3], nodes[largest_nodes], three = 3, two = 2;
  if (ops_getintinput_(&three, head) != 0 || head[2] < 1 || head[2] > largest_nodes)
    return tell("ents: write element entsContact tag k number_of_nodes nodes... area options");
  int count = head[2];
  double numbers[2];
  if (ops_getintinput_(&count, nodes) != 0 || ops_getdoubleinput_(&two, numbers) != 0)
    return tell("ents: write element entsContact tag k number_of_nodes nodes... area options");

  const double properties[3] = {static_cast<double>(head[1]), numbers[0], numbers[1]};
  Element e;
  e.host = &host;
  e.number = head[0];
  e.nodes = head[2];
  e.dofs = e.coordinates = 3;
  e.properties = {properties};
  e.property_count = 3;
  e.history_size = 64;
  const Result result = check(e);
  if (result.outcome != Outcome::done) return tell(result.message);
  ele->tag = head[0];
  ele->nNode = head[2];
  ele->nDOF = head[2] * result.dimension;
  ele->nParam = parameters;
  ele->nState = result.state_size;
  ele->nMat = 0;
  int no_material = 0, no_type = 0;
  if (ops_allocateelement_(ele, &no_material, &no_type) != 0) return tell("ents: out of memory");
  std::copy(nodes, nodes + head[2], ele->node);
  std::copy(properties, properties + 3, ele->param);
  ele->param[3] = result.dimension;
  std::fill(ele->cState, ele->cState + ele->nState, 0.0);
  std::fill(ele->tState, ele->tState + ele->nState, 0.0);
  return 0;
}

int evaluate_element(eleObject* ele, double* tang, double* resid) {
  int d = static_cast<int>(ele->param[3]);
  double position[largest_dofs], displacement[largest_dofs];
  for (int node = 0; node < ele->nNode; ++node)
    if (ops_getnodecrd_(&ele->node[node], &d, position + d * node) != 0 ||
        ops_getnodedisp_(&ele->node[node], &d, displacement + d * node) != 0)
      return tell("ents: the nodes of entsContact need the coordinates and degrees of freedom of the model: "
                  "2 each in 2D, 3 in 3D");
  Element e;
  e.host = &host;
  e.number = ele->tag;
  e.nodes = ele->nNode;
  e.dofs = e.coordinates = d;
  e.position = {position, 1, d};
  e.displacement = {displacement, 1, d};
  e.properties = {ele->param};
  e.property_count = 3;
  e.history = {ele->cState};
  e.history_size = ele->nState;
  e.residual = {resid, 1, d};
  e.tangent = {tang, 1, ele->nDOF};
  e.history_end = {ele->tState};
  const Result result = evaluate(e);
  if (result.message[0]) tell(result.message);
  return result.outcome == Outcome::done ? 0 : -1; // the script's algorithm cuts the step
}

} // namespace

extern "C" __attribute__((visibility("default"))) void entsContact(eleObject* ele, modelState*, double* tang,
                                                                   double* resid, int* isw, int* error) {
  *error = 0;
  switch (*isw) {
  case initialise:
    *error = read(ele);
    break;
  case commit:
    std::copy(ele->tState, ele->tState + ele->nState, ele->cState);
    break;
  case revert:
    std::copy(ele->cState, ele->cState + ele->nState, ele->tState);
    break;
  case form:
    *error = evaluate_element(ele, tang, resid);
    break;
  case mass:
    std::fill(tang, tang + ele->nDOF * ele->nDOF, 0.0);
    break;
  case revert_to_start:
    std::fill(ele->cState, ele->cState + ele->nState, 0.0);
    std::fill(ele->tState, ele->tState + ele->nState, 0.0);
    break;
  default:
    break;
  }
}
