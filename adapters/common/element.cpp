// SPDX-License-Identifier: BSD-3-Clause
#include "element.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <ents.h>

#include "limits.hpp"
#include "model_cache.hpp"
#include "selfcheck.hpp"

namespace ents_adapter {
namespace {

/// What the library needs to know of one element.
struct Arguments {
  const LoadedModel* model = nullptr;
  const ElementRow* row = nullptr; ///< of the table, if it has one for this element
  double area = 0;
  int options = 0;
  const double* surface_coordinates = nullptr; ///< null: the model's own, else s = xi
  double own_coordinates[2 * (largest_nodes - 1)];
};

void clear(const Element& e) {
  if (e.residual)
    for (int node = 0; node < e.nodes; ++node)
      for (int i = 0; i < e.dofs; ++i) e.residual(i, node) = 0;
  if (e.tangent)
    for (int column = 0; column < e.nodes * e.dofs; ++column)
      for (int row = 0; row < e.nodes * e.dofs; ++row) e.tangent(row, column) = 0;
  if (e.energy) *e.energy = 0;
}

void say(Result& result, const Element& e, const std::string& text) {
  if (e.number >= 0)
    std::snprintf(result.message, sizeof result.message, "ents, element %lld: %s",
                  static_cast<long long>(e.number), text.c_str());
  else
    std::snprintf(result.message, sizeof result.message, "ents: %s", text.c_str());
}

/// The options that a host has, for who has taken another.
std::string known_options(const Host& host) {
  std::string text = "1 (selfcheck)";
  if (host.options & option_old_displacement) text += ", 2 (displacements lack the increment)";
  if (host.options & option_negative_tangent) text += ", 4 (the opposite sign)";
  return text;
}

Result fail(const Element& e, const std::string& text) {
  Result result;
  result.outcome = Outcome::failed;
  say(result, e, text);
  clear(e);
  return result;
}

/// @return what is wrong with the numbers of the deck; "" if nothing
std::string read_properties(const Element& e, Arguments& arguments) {
  const auto entry = [&](int i) { return e.host->properties + std::to_string(i); };
  if (!e.properties || e.property_count < 2)
    return "two properties at least are needed, the model's number k (file ents_k.json) and the area: "
           "write " +
           entry(1) + " and 2";
  const double number = e.properties(0), area = e.properties(1);
  if (!(number >= 1 && number <= largest_model_number) || number != std::floor(number))
    return entry(1) + " is " + std::to_string(number) + "; write the model's number k, 1 .. " +
           std::to_string(largest_model_number) + ", of the file ents_k.json";
  if (!(area >= 0) || !std::isfinite(area))
    return entry(2) + " is " + std::to_string(area) + "; write the tributary area of the slave node, > 0" +
           (e.listed ? ", or 0 to take it from ents_" + std::to_string(static_cast<int>(number)) + ".txt"
                     : std::string());
  arguments.options = options(e.properties, e.property_count);
  if (arguments.options < 0 || (arguments.options & ~e.host->options))
    return entry(3) + " is " + std::to_string(e.properties(2)) + "; write 0 or the sum of options, here " +
           known_options(*e.host);

  const LoadedModel& model = model_number(static_cast<int>(number), e.host->directory);
  if (!model.model) return model.error;
  arguments.model = &model;
  arguments.area = area;
  arguments.row = e.listed && e.number >= 0 ? model.row(e.number) : nullptr;
  if (area == 0) {
    if (!e.listed)
      return entry(2) + " is 0; write the tributary area of the slave node: there is no table, because this "
                        "host does not tell the elements' numbers";
    if (!arguments.row)
      return entry(2) + ", the area, is 0 and there is no line for this element in " +
             model.file.substr(0, model.file.size() - 4) +
             "txt; write \"ELEMENT AREA\" there, or the area in the deck" + e.host->numbers;
    arguments.area = arguments.row->area;
  }
  return "";
}

/// @return what is wrong with the element's sizes; "" if nothing
std::string check_sizes(const Element& e, const LoadedModel& model) {
  const ents_layout& layout = model.layout;
  if (layout.multipliers && !e.host->multipliers)
    return model.file + " has multipliers as unknowns, which this host's elements cannot carry. Take another "
                        "contact.normal.type, "
                        "\"augmented\" for one";
  const int needed = 1 + layout.nodes + (layout.multipliers ? 1 : 0);
  if (layout.nodes + 1 > largest_nodes || layout.multipliers > largest_multipliers ||
      layout.state_size > largest_state)
    return model.file + " has " + std::to_string(layout.nodes) + " master nodes; the adapters take " +
           std::to_string(largest_nodes - 1);
  if (e.nodes < needed || (e.nodes > needed && !e.host->spare_nodes))
    return model.file + " needs " + std::to_string(needed) + " nodes, the slave node, " +
           std::to_string(layout.nodes) + " master nodes" +
           (layout.multipliers ? ", one that carries multipliers" : "") + "; the element has " +
           std::to_string(e.nodes) + ". Write " + e.host->nodes + std::to_string(needed);
  if (e.dofs < layout.dimension || e.coordinates < layout.dimension)
    return model.file + " is a model in " + std::to_string(layout.dimension) + "D, the element has " +
           std::to_string(std::min(e.dofs, e.coordinates)) + " coordinates and degrees of freedom a node";
  if (e.history_size < layout.state_size)
    return model.file + " needs " + std::to_string(layout.state_size) +
           " history variables, the element has " + std::to_string(e.history_size) + ". Write " +
           e.host->history + std::to_string(layout.state_size);
  return "";
}

/// Surface coordinates of the deck, or of the table, which goes before.
/// @return what is wrong with them; "" if nothing
std::string read_coordinates(const Element& e, Arguments& arguments) {
  const LoadedModel& model = *arguments.model;
  const int wanted = model.layout.nodes * model.layout.parameters;
  // Hosts with a fixed number of properties fill up with zeros: a segment without extent is none given.
  int count = e.property_count;
  while (count > 3 && e.properties(count - 1) == 0) --count;
  if (count > 3) {
    const auto entry = [&](int i) { return e.host->properties + std::to_string(i); };
    const bool too_few = e.property_count < 3 + wanted;
    if (too_few || count > 3 + wanted)
      return entry(4) + " and the following are " + std::to_string((too_few ? e.property_count : count) - 3) +
             " surface coordinates, " + model.file + " needs " + std::to_string(wanted) + ", " +
             std::to_string(model.layout.parameters) + " for each of its " +
             std::to_string(model.layout.nodes) + " master nodes. Write " + std::to_string(3 + wanted) +
             " properties, or 3";
    for (int i = 0; i < wanted; ++i)
      if (arguments.own_coordinates[i] = e.properties(3 + i); !std::isfinite(e.properties(3 + i)))
        return entry(4 + i) + ", a surface coordinate, is not finite";
    arguments.surface_coordinates = arguments.own_coordinates;
  }
  if (arguments.row && !arguments.row->surface_coordinates.empty())
    arguments.surface_coordinates = arguments.row->surface_coordinates.data();
  return "";
}

/// @return what is wrong with the element's description; "" if nothing
std::string read(const Element& e, Arguments& arguments) {
  std::string wrong = read_properties(e, arguments);
  if (wrong.empty()) wrong = check_sizes(e, *arguments.model);
  if (wrong.empty()) wrong = read_coordinates(e, arguments);
  return wrong;
}

/// Current positions of slave and master nodes, then multipliers. @return all finite
bool gather(const Element& e, const ents_layout& layout, double* unknowns) {
  bool finite = true;
  double* out = unknowns;
  for (int node = 0; node <= layout.nodes; ++node)
    for (int i = 0; i < layout.dimension; ++i, ++out) {
      *out = e.position(i, node);
      if (e.displacement) *out += e.displacement(i, node);
      if (e.increment) *out += e.increment(i, node);
      finite = finite && std::isfinite(*out);
    }
  for (int i = 0; i < layout.multipliers; ++i, ++out) {
    *out = e.displacement ? e.displacement(i, layout.nodes + 1) : 0.0;
    if (e.increment) *out += e.increment(i, layout.nodes + 1);
    finite = finite && std::isfinite(*out);
  }
  return finite;
}

/// Residual and tangent from the library's packed order to the host's: all other entries stay zero.
void scatter(const Element& e, const ents_layout& layout, const double* residual, const double* tangent) {
  const int of_nodes = layout.dofs - layout.multipliers;
  const auto node = [&](int i) { return i < of_nodes ? i / layout.dimension : layout.nodes + 1; };
  const auto dof = [&](int i) { return i < of_nodes ? i % layout.dimension : i - of_nodes; };
  for (int column = 0; column < layout.dofs; ++column) {
    if (e.residual) e.residual(dof(column), node(column)) = e.sign * residual[column];
    if (e.tangent)
      for (int row = 0; row < layout.dofs; ++row)
        e.tangent(node(row) * e.dofs + dof(row), node(column) * e.dofs + dof(column)) =
            e.tangent_sign * tangent[row + layout.dofs * column];
  }
}

/// The host's history as a state block; hosts begin with zeros.
void begin_state(const Element& e, const LoadedModel& model, double* state) {
  bool any = false;
  for (int i = 0; i < model.layout.state_size; ++i) any = (state[i] = e.history(i)) != 0 || any;
  if (!any) ents_state_init(model.model, 1, state, model.layout.state_size, nullptr);
}

/// Projection on the segment without its height. A state in contact overrides it.
/// @return false: there is none, the library shall search
bool find_start(const LoadedModel& model, const ents_input& input, double* start) {
  if (!model.base) return false;
  ents_input plain = input;
  plain.state_begin = nullptr;
  ents_output output{};
  output.struct_size = sizeof output;
  output.wanted = ENTS_XI;
  output.xi = start;
  return ents_evaluate(model.base, 0, 1, &plain, &output, nullptr) == ENTS_OK;
}

void describe(const ents_layout& layout, Result& result) {
  result.symmetric = layout.symmetric_tangent != 0;
  result.dimension = layout.dimension;
  result.state_size = layout.state_size;
}

} // namespace

int options(const Row<const double>& properties, int count) {
  if (count < 3) return 0;
  const double value = properties(2);
  return value >= 0 && value <= 7 && value == std::floor(value) ? static_cast<int>(value) : -1;
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
  if (arguments.model) describe(arguments.model->layout, result);
  return result;
}

Result evaluate(const Element& e) {
  Arguments arguments;
  if (const std::string wrong = read(e, arguments); !wrong.empty()) return fail(e, wrong);
  const LoadedModel& model = *arguments.model;
  const ents_layout& layout = model.layout;

  double unknowns[largest_dofs], state_begin[largest_state], state_end[largest_state];
  double residual[largest_dofs], tangent[largest_dofs * largest_dofs], energy = 0;
  if (layout.state_size > 0) begin_state(e, model, state_begin);
  clear(e);
  Result result;
  result.message[0] = 0;
  describe(layout, result);
  if (!gather(e, layout, unknowns)) { // a diverged iteration of the host
    result.outcome = Outcome::cut;
    result.step_factor = 0.5;
    say(result, e, "the host's displacements are not finite");
    return result;
  }

  ents_report report{};
  report.struct_size = sizeof report;
  ents_input input{};
  input.struct_size = sizeof input;
  input.slave = unknowns;
  input.master = unknowns + layout.dimension;
  input.multiplier = layout.multipliers ? unknowns + layout.dimension * (layout.nodes + 1) : nullptr;
  input.surface_coordinates = arguments.surface_coordinates;
  input.area = &arguments.area;
  input.state_begin = layout.state_size > 0 ? state_begin : nullptr;
  double start[2];
  if (find_start(model, input, start)) input.start = start;
  int32_t flags = 0;
  const bool checked = (arguments.options & option_selfcheck) && e.tangent;
  double gap = 0, normal[3] = {};
  ents_output output{};
  output.struct_size = sizeof output;
  output.wanted = ENTS_FLAGS | ENTS_RESIDUAL | (e.tangent ? ENTS_TANGENT : 0) | (e.energy ? ENTS_ENERGY : 0) |
                  (e.history_end ? ENTS_STATE : 0) | (checked ? ENTS_GAP | ENTS_NORMAL : 0);
  output.flags = &flags;
  output.gap = &gap;
  output.normal = normal;
  output.residual = residual;
  output.tangent = tangent;
  output.energy = &energy;
  output.state_end = state_end;
  if (const int32_t status = ents_evaluate(model.model, 0, 1, &input, &output, &report); status != ENTS_OK) {
    result.outcome = status > 0 ? Outcome::cut : Outcome::failed;
    result.step_factor = status > 0 ? report.step_factor : 1;
    say(result, e, model.file + ": " + report.message);
    return result;
  }
  result.contact = (flags & ENTS_FLAG_CONTACT) != 0;
  scatter(e, layout, residual, tangent);
  if (e.energy) *e.energy = energy;
  if (e.history_end)
    for (int i = 0; i < layout.state_size; ++i) e.history_end(i) = state_end[i];
  if (checked) {
    char text[512];
    if (result.contact)
      selfcheck(model.model, layout, input, unknowns, tangent, text, sizeof text);
    else
      say_open((flags & ENTS_FLAG_OUTSIDE) == 0, gap, normal, text, sizeof text);
    say(result, e, text);
  }
  return result;
}

} // namespace ents_adapter
