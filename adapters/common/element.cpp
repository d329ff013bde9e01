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
  double slave_values[3] = {0, 1, 1}; ///< offset, and factors of wear
  bool has_offset = false;
  int options = 0;
  int slave_nodes = 1; ///< of the face that a slave point lies in; 1: the slave is a node
  double weights[largest_slave_nodes] = {1};
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
  std::string text = "1 (selfcheck), 8 (slave point), 16 (may leave its segments), 32 (offset)";
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

/// What is added to the gap: from the table, or property 4 with option 32.
/// @return what is wrong; "" if nothing
std::string read_offset(const Element& e, Arguments& arguments) {
  if (arguments.options & option_offset) {
    const double offset = e.property_count > 3 ? e.properties(3) : std::nan("");
    if (!std::isfinite(offset))
      return e.host->properties +
             std::string("4 is the offset of the gap with option 32, a length: > 0 a clearance, "
                         "< 0 a coating");
    arguments.slave_values[0] = offset;
    arguments.has_offset = true;
  } else if (arguments.row && arguments.model->offsets) {
    arguments.slave_values[0] = arguments.row->offset;
    arguments.has_offset = true;
  }
  return "";
}

/// Properties before those of a slave point and the surface coordinates
int first_properties(const Arguments& arguments) { return arguments.options & option_offset ? 4 : 3; }

/// The slave as a point: from the table, or from properties with option 8.
/// @return what is wrong; "" if nothing
std::string read_slave_point(const Element& e, Arguments& arguments) {
  const LoadedModel& model = *arguments.model;
  if (arguments.options & option_slave_point) {
    const auto entry = [&](int i) { return e.host->properties + std::to_string(i); };
    const int first = first_properties(arguments);
    const double count = e.property_count > first ? e.properties(first) : 0;
    if (!(count >= 1 && count <= largest_slave_nodes) || count != std::floor(count) ||
        e.property_count < first + 1 + count)
      return entry(first + 1) + " is the number of the slave's nodes with option 8, 1 .. " +
             std::to_string(largest_slave_nodes) + ", and as many weights follow";
    arguments.slave_nodes = static_cast<int>(count);
    for (int i = 0; i < arguments.slave_nodes; ++i) arguments.weights[i] = e.properties(first + 1 + i);
    if (const std::string wrong = wrong_weights(arguments.weights, arguments.slave_nodes); !wrong.empty())
      return entry(first + 2) + " and following: " + wrong;
  } else if (arguments.row && model.slave_nodes > 1) {
    arguments.slave_nodes = model.slave_nodes;
    std::copy(arguments.row->weights.begin(), arguments.row->weights.end(), arguments.weights);
  }
  return "";
}

/// @return what is wrong with the element's sizes; "" if nothing
std::string check_sizes(const Element& e, const Arguments& arguments) {
  const LoadedModel& model = *arguments.model;
  const ents_layout& layout = model.layout;
  if (layout.multipliers && !e.host->multipliers)
    return model.file + " has multipliers as unknowns, which this host's elements cannot carry. Take another "
                        "contact.normal.type, "
                        "\"augmented\" for one";
  const int slave_nodes = arguments.slave_nodes,
            needed = slave_nodes + layout.nodes + (layout.multipliers ? 1 : 0);
  if (layout.nodes + slave_nodes > largest_nodes || layout.multipliers > largest_multipliers ||
      layout.state_size > largest_state)
    return model.file + " has " + std::to_string(layout.nodes) + " master nodes; the adapters take " +
           std::to_string(largest_nodes - 1);
  if (e.nodes < needed || (e.nodes > needed && !e.host->spare_nodes))
    return model.file + " needs " + std::to_string(needed) + " nodes, " +
           (slave_nodes == 1 ? std::string("the slave node, ")
                             : std::to_string(slave_nodes) + " of the slave's face, ") +
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
  const int before =
      first_properties(arguments) + (arguments.options & option_slave_point ? 1 + arguments.slave_nodes : 0);
  int count = e.property_count;
  while (count > before && e.properties(count - 1) == 0) --count;
  if (count > before) {
    const auto entry = [&](int i) { return e.host->properties + std::to_string(i); };
    const bool too_few = e.property_count < before + wanted;
    if (too_few || count > before + wanted)
      return entry(before + 1) + " and the following are " +
             std::to_string((too_few ? e.property_count : count) - before) + " surface coordinates, " +
             model.file + " needs " + std::to_string(wanted) + ", " +
             std::to_string(model.layout.parameters) + " for each of its " +
             std::to_string(model.layout.nodes) + " master nodes. Write " + std::to_string(before + wanted) +
             " properties, or " + std::to_string(before);
    for (int i = 0; i < wanted; ++i)
      if (arguments.own_coordinates[i] = e.properties(before + i); !std::isfinite(e.properties(before + i)))
        return entry(before + 1 + i) + ", a surface coordinate, is not finite";
    arguments.surface_coordinates = arguments.own_coordinates;
  }
  if (arguments.row && !arguments.row->surface_coordinates.empty())
    arguments.surface_coordinates = arguments.row->surface_coordinates.data();
  return "";
}

/// @return what is wrong with the element's description; "" if nothing
std::string read(const Element& e, Arguments& arguments) {
  std::string wrong = read_properties(e, arguments);
  if (wrong.empty()) wrong = read_offset(e, arguments);
  if (wrong.empty()) wrong = read_slave_point(e, arguments);
  if (wrong.empty()) wrong = check_sizes(e, arguments);
  if (wrong.empty()) wrong = read_coordinates(e, arguments);
  return wrong;
}

/// Current positions of slave and master nodes, then multipliers. @return all finite
bool gather(const Element& e, const Arguments& arguments, double* unknowns) {
  const ents_layout& layout = arguments.model->layout;
  const auto current = [&](int i, int node) {
    double x = e.position(i, node);
    if (e.displacement) x += e.displacement(i, node);
    if (e.increment) x += e.increment(i, node);
    return x;
  };
  const int slave_nodes = arguments.slave_nodes, host_nodes = slave_nodes + layout.nodes;
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
    *out = e.displacement ? e.displacement(i, host_nodes) : 0.0;
    if (e.increment) *out += e.increment(i, host_nodes);
    finite = finite && std::isfinite(*out);
  }
  return finite;
}

/// Residual and tangent from the library's packed order to the host's, those of a slave point to the nodes of
/// its face in proportion to their weights: all other entries stay zero.
void scatter(const Element& e, const Arguments& arguments, const double* residual, const double* tangent) {
  const ents_layout& layout = arguments.model->layout;
  const int of_nodes = layout.dofs - layout.multipliers, d = layout.dimension,
            slave_nodes = arguments.slave_nodes;
  const auto copies = [&](int i) { return i < d ? slave_nodes : 1; };
  const auto node = [&](int i, int copy) {
    return i < d ? copy : slave_nodes + (i < of_nodes ? i / d - 1 : layout.nodes);
  };
  const auto dof = [&](int i) { return i < of_nodes ? i % d : i - of_nodes; };
  const auto weight = [&](int i, int copy) { return i < d ? arguments.weights[copy] : 1.0; };
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

/// A slave that was in contact at the begin of the increment and is now beyond the border of its segments,
/// below the surface that goes on there: the contact would be lost without a word. (Above it, it has lifted
/// off.)
bool has_left(const Arguments& arguments, const ents_input& input, int32_t flags, double gap) {
  constexpr int32_t left = ENTS_FLAG_OUTSIDE | ENTS_FLAG_CHANGED;
  return input.state_begin && (flags & left) == left && gap < 0 && !(arguments.options & option_may_leave);
}

std::string place_of(const double* slave, int dimension) {
  char text[120];
  std::snprintf(text, sizeof text, dimension == 2 ? "(%.6g, %.6g)" : "(%.6g, %.6g, %.6g)", slave[0], slave[1],
                slave[2]);
  return text;
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
  plain.state_begin = nullptr, plain.slave_values = nullptr;
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
  return value >= 0 && value <= 63 && value == std::floor(value) ? static_cast<int>(value) : -1;
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
  if (!gather(e, arguments, unknowns)) { // a diverged iteration of the host
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
  if (arguments.has_offset) input.slave_values = arguments.slave_values;
  input.state_begin = layout.state_size > 0 ? state_begin : nullptr;
  double start[2];
  if (find_start(model, input, start)) input.start = start;
  int32_t flags = 0;
  const bool checked = (arguments.options & option_selfcheck) && e.tangent;
  double gap = 0, normal[3] = {};
  ents_output output{};
  output.struct_size = sizeof output;
  output.wanted = ENTS_FLAGS | ENTS_GAP | ENTS_RESIDUAL | (e.tangent ? ENTS_TANGENT : 0) |
                  (e.energy ? ENTS_ENERGY : 0) | (e.history_end ? ENTS_STATE : 0) |
                  (checked ? ENTS_NORMAL : 0);
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
  if (has_left(arguments, input, flags, gap)) {
    result.outcome = Outcome::cut;
    result.step_factor = 0.5;
    say(result, e,
        model.file + ": the slave at " + place_of(unknowns, layout.dimension) +
            " was in contact and has left its segments. Write a wider \"patch\", with the segments " +
            "that lie there; if the master ends there, add 16 to " + e.host->properties + "3");
    return result;
  }
  scatter(e, arguments, residual, tangent);
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
