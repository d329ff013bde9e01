// SPDX-License-Identifier: BSD-3-Clause
// OpenSees: element entsContact, loaded at run time from entsContact.so. The interface is that of OpenSees's
// elementAPI.h.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "../common/element.hpp"
#include "../common/limits.hpp"
#include "../common/patch_watch.hpp"

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
int ops_getnodeincrdisp_(int* node, int* count, double* data); // trial minus committed
int ops_error_(char* text, int length);
__attribute__((weak)) int ops_getndf_(); // of the last model command; the oldest releases lack it

} // extern "C"

namespace {

using namespace ents_adapter;

constexpr Host host{"element entsContact tag k nodes..., with nodes: ", "", "element entsContact, property ",
                    [] { return std::string(); }};

enum Request { initialise = 0, commit = 1, revert = 2, form = 3, mass = 4, revert_to_start = 5 };
constexpr int largest_nodes = 18, largest_dofs = 3 * largest_nodes,
              parameters = 4; // k, area, options, dimension; then the degrees of freedom of each node
constexpr int largest_node_dofs = 7;

int tell(const char* text) {
  char line[1100];
  std::snprintf(line, sizeof line, "%s\n", text);
  ops_error_(line, static_cast<int>(std::strlen(line)));
  return -1;
}

/// Degrees of freedom of a node: frames in the plane have 3, shells and frames in space 6, u-p elements one
/// more than displacements. The displacements come first. OpenSees tells no node's number, but refuses any other
/// one and prints "crd size mismatch" each time: the first guess is that of the script's model command.
/// @return 0: no number fits
int dofs_of(int node, int dimension) {
  const int usual = ops_getndf_ ? ops_getndf_() : dimension;
  for (const int count : {usual, dimension, dimension == 2 ? 3 : 6, 4, 3, 5, 6, 7}) {
    if (count < dimension || count > largest_node_dofs) continue;
    std::array<double, largest_node_dofs> values;
    int asked = count;
    if (ops_getnodedisp_(&node, &asked, values.data()) == 0) return count;
  }
  return 0;
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
  e.history_size = largest_history;
  const Result result = check(e);
  if (result.outcome != Outcome::done) return tell(result.message);
  int dofs[largest_nodes], all = 0;
  for (int i = 0; i < head[2]; ++i) {
    dofs[i] = dofs_of(nodes[i], result.dimension);
    if (dofs[i] == 0) {
      char text[160];
      std::snprintf(text, sizeof text,
                    "ents: node %d of element %d does not exist before the element, or has fewer degrees of "
                    "freedom than the model has dimensions, %d",
                    nodes[i], head[0], result.dimension);
      return tell(text);
    }
    all += dofs[i];
  }
  ele->tag = head[0];
  ele->nNode = head[2];
  ele->nDOF = all;
  ele->nParam = parameters + head[2];
  ele->nState = result.state_size;
  ele->nMat = 0;
  int no_material = 0, no_type = 0;
  if (ops_allocateelement_(ele, &no_material, &no_type) != 0) return tell("ents: out of memory");
  std::copy(nodes, nodes + head[2], ele->node);
  std::copy(properties, properties + 3, ele->param);
  ele->param[3] = result.dimension;
  std::copy(dofs, dofs + head[2], ele->param + parameters);
  std::fill(ele->cState, ele->cState + ele->nState, 0.0);
  std::fill(ele->tState, ele->tState + ele->nState, 0.0);
  return 0;
}

/// OpenSees passes over what an element answers to COMMIT: every FORM after it is refused.
std::string& lost_contact() {
  static std::string& one = *new std::string;
  return one;
}

int commit_element(eleObject* ele) {
  std::copy(ele->tState, ele->tState + ele->nState, ele->cState);
  const IncrementEnd end = element_converged(host, ele->tag);
  for (const std::string& text : end.warnings) tell(text.c_str());
  if (end.lost.empty()) return 0;
  lost_contact() = end.lost;
  return tell(end.lost.c_str());
}

int evaluate_element(eleObject* ele, double* tang, double* resid) {
  if (!lost_contact().empty()) return tell(lost_contact().c_str());
  int d = static_cast<int>(ele->param[3]);
  double position[largest_dofs], displacement[largest_dofs], change[largest_dofs], residual[largest_dofs],
      tangent[largest_dofs * largest_dofs];
  int begin[largest_nodes]; // of the nodes' degrees of freedom in the host's arrays
  for (int node = 0, at = 0; node < ele->nNode; ++node) {
    std::array<double, largest_node_dofs> values{}, increments{};
    int dofs = static_cast<int>(ele->param[parameters + node]);
    if (ops_getnodecrd_(&ele->node[node], &d, position + d * node) != 0 ||
        ops_getnodedisp_(&ele->node[node], &dofs, values.data()) != 0 ||
        ops_getnodeincrdisp_(&ele->node[node], &dofs, increments.data()) != 0)
      return tell(
          "ents: the nodes of entsContact need the coordinates of the model, 2 in 2D, 3 in 3D, and their "
          "displacements as first degrees of freedom");
    std::copy(values.begin(), values.begin() + d, displacement + d * node);
    std::copy(increments.begin(), increments.begin() + d, change + d * node);
    begin[node] = at;
    at += dofs;
  }
  const int rows = d * ele->nNode;
  Element e;
  e.host = &host;
  e.number = ele->tag;
  e.nodes = ele->nNode;
  e.dofs = e.coordinates = d;
  e.position = {position, 1, d};
  e.displacement = {displacement, 1, d};
  e.change = {change, 1, d};
  e.properties = {ele->param};
  e.property_count = 3;
  e.history = {ele->cState};
  e.history_size = ele->nState;
  e.residual = {residual, 1, d};
  e.tangent = {tangent, 1, rows};
  e.history_end = {ele->tState};
  const Result result = evaluate(e);
  if (result.message[0]) tell(result.message);
  std::fill(resid, resid + ele->nDOF, 0.0);
  std::fill(tang, tang + ele->nDOF * ele->nDOF, 0.0);
  const auto host_dof = [&](int i) { return begin[i / d] + i % d; };
  for (int column = 0; column < rows; ++column) {
    resid[host_dof(column)] = residual[column];
    for (int row = 0; row < rows; ++row)
      tang[host_dof(row) + ele->nDOF * host_dof(column)] = tangent[row + rows * column];
  }
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
    *error = commit_element(ele);
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
