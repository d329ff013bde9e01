// SPDX-License-Identifier: BSD-3-Clause
#include "element.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include <ents.h>

#include "body.hpp"
#include "description.hpp"
#include "patch_watch.hpp"
#include "selfcheck.hpp"

namespace ents_adapter {
namespace {

void clear(const Element& e) {
  if (e.residual)
    for (int node = 0; node < e.nodes; ++node)
      for (int i = 0; i < e.dofs; ++i) e.residual(i, node) = 0;
  if (e.tangent)
    for (int column = 0; column < e.nodes * e.dofs; ++column)
      for (int row = 0; row < e.nodes * e.dofs; ++row) e.tangent(row, column) = 0;
  if (e.energy) *e.energy = 0;
  if (e.dissipation) *e.dissipation = 0;
}

void say(Result& result, const Element& e, const std::string& text) {
  if (e.number >= 0)
    std::snprintf(result.message, sizeof result.message, "ents, element %lld: %s",
                  static_cast<long long>(e.number), text.c_str());
  else
    std::snprintf(result.message, sizeof result.message, "ents: %s", text.c_str());
}

/// The library's words for a batch of one element, without the number that it has there.
std::string of_one(std::string text) {
  for (const char* number : {"element 0: ", " of element 0"})
    if (const std::size_t at = text.find(number); at != std::string::npos)
      text.erase(at, std::char_traits<char>::length(number));
  return text;
}

Result fail(const Element& e, const std::string& text) {
  Result result;
  result.outcome = Outcome::failed;
  say(result, e, text);
  clear(e);
  return result;
}

/// Current positions of slave and master nodes, then multipliers; with heat, temperatures of slave and master
/// nodes. @return all finite
bool gather(const Element& e, const Arguments& arguments, double* unknowns, double* temperatures) {
  const ents_layout& layout = arguments.model->layout;
  const auto current = [&](int i, int node) { return e.position(i, node) + e.moved(i, node); };
  const int slave_nodes = arguments.slave_nodes,
            host_nodes = slave_nodes + (arguments.body ? 0 : layout.nodes);
  bool finite = true;
  double* out = unknowns;
  for (int i = 0; i < layout.dimension; ++i, ++out) {
    *out = arguments.weights[0] * current(i, 0);
    for (int k = 1; k < slave_nodes; ++k) *out += arguments.weights[k] * current(i, k);
    finite = finite && std::isfinite(*out);
  }
  for (int node = slave_nodes; node < host_nodes; ++node)
    for (int i = 0; i < layout.dimension; ++i, ++out) {
      *out = current(i, node);
      finite = finite && std::isfinite(*out);
    }
  for (int i = 0; i < layout.multipliers; ++i, ++out) {
    *out = e.moved(i, host_nodes);
    finite = finite && std::isfinite(*out);
  }
  if (!layout.heat) return finite;
  *temperatures = 0;
  for (int k = 0; k < slave_nodes; ++k) *temperatures += arguments.weights[k] * e.moved(e.temperature, k);
  for (int node = 0; node < layout.nodes; ++node)
    temperatures[1 + node] = e.moved(e.temperature, slave_nodes + node);
  for (int node = 0; node <= layout.nodes; ++node) finite = finite && std::isfinite(temperatures[node]);
  return finite;
}

/// Residual and tangent from the library's packed order to the host's, those of a slave point to the nodes of
/// its face in proportion to their weights: all other entries stay zero.
void scatter(const Element& e, const Arguments& arguments, const double* residual, const double* tangent) {
  const ents_layout& layout = arguments.model->layout;
  const int of_nodes = layout.dofs - layout.multipliers, d = layout.dimension, n = layout.node_dofs,
            slave_nodes = arguments.slave_nodes;
  const auto copies = [&](int i) { return i < n ? slave_nodes : 1; };
  const auto node = [&](int i, int copy) {
    return i < n ? copy : slave_nodes + (i < of_nodes ? i / n - 1 : layout.nodes);
  };
  const auto dof = [&](int i) { return i >= of_nodes ? i - of_nodes : i % n < d ? i % n : e.temperature; };
  const auto weight = [&](int i, int copy) { return i < n ? arguments.weights[copy] : 1.0; };
  for (int column = 0; column < layout.dofs; ++column)
    for (int c = 0; c < copies(column); ++c) {
      if (e.residual)
        e.residual(dof(column), node(column, c)) = e.sign * weight(column, c) * residual[column];
      if (!e.tangent) continue;
      for (int row = 0; row < layout.dofs; ++row)
        for (int r = 0; r < copies(row); ++r)
          e.tangent(node(row, r) * e.dofs + dof(row), node(column, c) * e.dofs + dof(column)) =
              e.tangent_sign * (weight(row, r) * weight(column, c) * tangent[row + layout.dofs * column]);
    }
}

/// The same of slave point and body: forces, moment, and their derivatives.
void scatter_body(const Element& e, const Arguments& arguments, const double* residual,
                  const double* tangent) {
  const int d = arguments.model->layout.dimension, slave_nodes = arguments.slave_nodes,
            n = 2 * d + turns_of(d);
  const auto copies = [&](int i) { return i < d ? slave_nodes : 1; };
  const auto weight = [&](int i, int copy) { return i < d ? arguments.weights[copy] : 1.0; };
  const auto place = [&](int i, int copy) { // node and dof there
    if (i < d) return std::pair(copy, i);
    if (i < 2 * d || !arguments.turn_node) return std::pair(slave_nodes, i - d);
    return std::pair(slave_nodes + 1, i - 2 * d);
  };
  for (int column = 0; column < n; ++column)
    for (int c = 0; c < copies(column); ++c) {
      const auto [column_node, column_dof] = place(column, c);
      if (e.residual) e.residual(column_dof, column_node) = e.sign * weight(column, c) * residual[column];
      if (!e.tangent) continue;
      for (int row = 0; row < n; ++row)
        for (int r = 0; r < copies(row); ++r) {
          const auto [row_node, row_dof] = place(row, r);
          e.tangent(row_node * e.dofs + row_dof, column_node * e.dofs + column_dof) =
              e.tangent_sign * (weight(row, r) * weight(column, c) * tangent[row + n * column]);
        }
    }
}

std::string place_of(const double* slave, int dimension) {
  char text[120];
  std::snprintf(text, sizeof text, dimension == 2 ? "(%.6g, %.6g)" : "(%.6g, %.6g, %.6g)", slave[0], slave[1],
                slave[2]);
  return text;
}

/// The host's history as a state block; hosts begin with zeros.
/// @return false: the element has none yet
bool begin_state(const Element& e, const LoadedModel& model, double* state) {
  bool any = false;
  for (int i = 0; i < model.layout.state_size; ++i) any = (state[i] = e.history(i)) != 0 || any;
  if (!any) ents_state_init(model.model, 1, state, model.layout.state_size, nullptr);
  return any;
}

/// Projection on the segment without its height. A state in contact overrides it.
/// @return false: there is none, the library shall search
bool find_start(const LoadedModel& model, const ents_input& input, double* start) {
  if (!model.base) return false;
  ents_input plain = input;
  plain.state_begin = nullptr, plain.slave_values = nullptr;
  ents_output output{};
  output.struct_size = sizeof output;
  output.wanted = ENTS_XI;
  output.xi = start;
  return ents_evaluate(model.base, 0, 1, &plain, &output, nullptr) == ENTS_OK;
}

void describe(const Arguments& arguments, Result& result) {
  const ents_layout& layout = arguments.model->layout;
  result.symmetric = layout.symmetric_tangent != 0 && !arguments.body; // finite rotations do not commute
  result.symmetric_forces = arguments.model->symmetric_forces && !arguments.body;
  result.dimension = layout.dimension;
  result.heat = layout.heat != 0;
  result.rigid = layout.dofs - layout.multipliers == layout.node_dofs;
  result.state_size =
      layout.state_size + (arguments.body ? body_history(layout.dimension, arguments.turn_node) : 0);
}

} // namespace

int reference_rotations(const Element& e) {
  Arguments arguments;
  if (e.nodes < 1 || !e.host->rotations) return 0;
  read(e, arguments); // what is wrong is said by who evaluates it
  return arguments.body && !arguments.turn_node ? turns_of(arguments.model->layout.dimension) : 0;
}

void negative_product(const Grid<const double>& matrix, int n, const double* vector, double* result) {
  for (int row = 0; row < n; ++row) {
    double sum = 0;
    for (int column = 0; column < n; ++column) sum += matrix(row, column) * vector[column];
    result[row] = -sum;
  }
}

Result check(const Element& e) {
  Arguments arguments;
  Result result;
  if (const std::string wrong = read(e, arguments); !wrong.empty()) {
    result = fail(e, wrong);
  } else {
    result.message[0] = 0;
  }
  if (arguments.model) describe(arguments, result);
  return result;
}

namespace {

// Where slave and master are: for the library, and the body's pose.
struct Place {
  double unknowns[3 * (1 + largest_body_nodes)]; // slave, master nodes (of a body in its frame), multipliers
  double temperatures[1 + largest_body_nodes];   // slave, master nodes
  Body body;
  bool finite;
};

/// @return "" or what is wrong
std::string place(const Element& e, const Arguments& arguments, Place& at) {
  const LoadedModel& model = *arguments.model;
  const int dimension = model.layout.dimension;
  at.finite = gather(e, arguments, at.unknowns, at.temperatures);
  if (!arguments.body) return "";
  if (std::string wrong = place_body(e, dimension, arguments.slave_nodes, arguments.turn_node,
                                     model.layout.state_size, at.body, at.finite);
      !wrong.empty())
    return wrong;
  if (at.finite) ents_pose_to_body(dimension, &at.body.pose, 1, at.unknowns, at.unknowns, nullptr);
  std::copy(model.body.begin(), model.body.end(), at.unknowns + dimension);
  return "";
}

ents_input input_at(const Element& e, const Arguments& arguments, const Place& at,
                    const double* state_begin) {
  const ents_layout& layout = arguments.model->layout;
  ents_input input{};
  input.struct_size = sizeof input;
  input.slave = at.unknowns;
  input.master = at.unknowns + layout.dimension;
  input.multiplier = layout.multipliers ? at.unknowns + layout.dimension * (layout.nodes + 1) : nullptr;
  input.surface_coordinates = arguments.surface_coordinates;
  input.area = &arguments.area;
  if (arguments.has_offset) input.slave_values = arguments.slave_values;
  input.state_begin = layout.state_size > 0 ? state_begin : nullptr;
  input.time_increment = e.time_increment;
  if (layout.heat) input.slave_temperature = at.temperatures, input.master_temperature = at.temperatures + 1;
  return input;
}

/// The state at the begin of the increment from the positions there, for an element that has none.
/// @return false: the host does not tell them, or there is no projection
bool find_begin(const Element& e, const Arguments& arguments, double* state) {
  if (!e.change) return false;
  Element begin = e;
  begin.undone = e.change, begin.spin = {};
  Place at;
  if (!place(begin, arguments, at).empty() || !at.finite) return false;
  double there[largest_state];
  const ents_input input = input_at(e, arguments, at, state);
  ents_output output{};
  output.struct_size = sizeof output;
  output.wanted = ENTS_STATE;
  output.state_end = there;
  if (ents_evaluate(arguments.model->model, 0, 1, &input, &output, nullptr) != ENTS_OK) return false;
  std::copy(there, there + arguments.model->layout.state_size, state);
  return true;
}

/// What the library answers.
struct Answer {
  double residual[largest_dofs], tangent[largest_dofs * largest_dofs], state_end[largest_state];
  double energy = 0, friction_energy = 0, dissipation = 0, gap = 0, normal[3] = {};
  int32_t flags = 0;
};

/// @param checked  the tangent is compared with differences
ents_output output_into(Answer& answer, const Element& e, bool checked) {
  ents_output output{};
  output.struct_size = sizeof output;
  output.wanted = ENTS_FLAGS | ENTS_GAP | ENTS_RESIDUAL | (e.tangent ? ENTS_TANGENT : 0) |
                  (e.energy ? ENTS_ENERGY | ENTS_FRICTION_ENERGY : 0) |
                  (e.dissipation ? ENTS_DISSIPATION : 0) | (e.history_end ? ENTS_STATE : 0) |
                  (checked ? ENTS_NORMAL : 0);
  output.flags = &answer.flags;
  output.gap = &answer.gap;
  output.normal = answer.normal;
  output.residual = answer.residual;
  output.tangent = answer.tangent;
  output.energy = &answer.energy;
  output.friction_energy = &answer.friction_energy;
  output.dissipation = &answer.dissipation;
  output.state_end = answer.state_end;
  return output;
}

/// The answer in the host's own arrays.
void hand_over(const Element& e, const Arguments& arguments, const Place& at, const Answer& answer) {
  const ents_layout& layout = arguments.model->layout;
  if (arguments.body) {
    double of_body[largest_body_dofs], matrix[largest_body_dofs * largest_body_dofs];
    ents_pose_element(layout.dimension, &at.body.pose, at.unknowns, answer.residual,
                      e.tangent ? answer.tangent : nullptr, of_body, e.tangent ? matrix : nullptr, nullptr);
    if (e.tangent && arguments.turn_node && layout.dimension == 3)
      turn_columns(at.body, matrix, largest_body_dofs);
    scatter_body(e, arguments, of_body, matrix);
  } else {
    scatter(e, arguments, answer.residual, answer.tangent);
  }
  if (e.energy) *e.energy = answer.energy + answer.friction_energy;
  if (e.dissipation) *e.dissipation = answer.dissipation;
  if (e.history_end)
    for (int i = 0; i < layout.state_size; ++i) e.history_end(i) = answer.state_end[i];
  if (e.history_end && arguments.body)
    write_body(e, layout.dimension, arguments.turn_node, layout.state_size, at.body);
}

/// Ask for a smaller increment.
void cut(Result& result, double step_factor) {
  result.outcome = Outcome::cut;
  result.step_factor = step_factor;
}

} // namespace

Result evaluate(const Element& e) {
  Arguments arguments;
  if (const std::string wrong = read(e, arguments); !wrong.empty()) return fail(e, wrong);
  const LoadedModel& model = *arguments.model;
  const ents_layout& layout = model.layout;

  Place at;
  double state_begin[largest_state];
  Answer answer;
  const bool fresh = layout.state_size > 0 && !begin_state(e, model, state_begin);
  clear(e);
  Result result;
  result.message[0] = 0;
  describe(arguments, result);
  if (const std::string wrong = place(e, arguments, at); !wrong.empty()) return fail(e, wrong);
  if (!at.finite) { // a diverged iteration of the host
    cut(result, 0.5);
    say(result, e, "the host's displacements are not finite");
    return result;
  }

  ents_report report{};
  report.struct_size = sizeof report;
  if (fresh && (layout.needs & ENTS_NEEDS_FIRST_STATE) != 0) find_begin(e, arguments, state_begin);
  ents_input input = input_at(e, arguments, at, state_begin);
  double start[2];
  if (find_start(model, input, start)) input.start = start;
  const bool checked = (arguments.options & option_selfcheck) && e.tangent;
  const int32_t& flags = answer.flags;
  ents_output output = output_into(answer, e, checked);
  int32_t status = ents_evaluate(model.model, 0, 1, &input, &output, &report);
  if (status == ENTS_OK && (flags & ENTS_FLAG_NO_BEGIN) && find_begin(e, arguments, state_begin))
    status = ents_evaluate(model.model, 0, 1, &input, &output, &report);
  if (status != ENTS_OK) {
    result.outcome = status > 0 ? Outcome::cut : Outcome::failed;
    result.step_factor = status > 0 ? report.step_factor : 1;
    say(result, e, model.file + ": " + of_one(report.message));
    return result;
  }
  result.contact = (flags & ENTS_FLAG_CONTACT) != 0;
  if (has_left(arguments, input, flags, answer.gap)) {
    cut(result, 0.5);
    result.left = true;
    say(result, e,
        model.file + ": the slave at " + place_of(at.unknowns, layout.dimension) +
            (arguments.body ? " in the frame of the body" : "") +
            " was in contact and has left its segments. Write a wider \"patch\", with the segments " +
            "that lie there; if the master ends there, add 16 to " + e.host->properties + "3");
    return result;
  }
  result.beside = lies_beside(arguments, flags, answer.gap, input.master);
  result.depth = result.beside ? -answer.gap : 0;
  if (e.listed && e.number >= 0 && !arguments.body)
    if (const std::string wrong =
            note(e, model.patch, arguments.slave_nodes, result.contact, result.beside, result.depth);
        !wrong.empty())
      return fail(e, wrong);
  hand_over(e, arguments, at, answer);
  if (checked) {
    char text[512];
    if (result.contact)
      selfcheck(model.model, layout, input, at.unknowns, at.temperatures, answer.tangent, text, sizeof text);
    else
      say_open((flags & ENTS_FLAG_OUTSIDE) == 0, answer.gap, answer.normal, text, sizeof text);
    say(result, e, text);
  }
  return result;
}

} // namespace ents_adapter
