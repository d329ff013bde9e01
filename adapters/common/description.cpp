// SPDX-License-Identifier: BSD-3-Clause
#include "description.hpp"

#include <algorithm>
#include <cmath>

#include "body.hpp"

namespace ents_adapter {
namespace {

/// The table beside the model.
std::string table_of(const LoadedModel& model) { return model.file.substr(0, model.file.size() - 4) + "txt"; }

/// The options that a host has, for who has taken another.
std::string known_options(const Host& host) {
  std::string text = "1 (selfcheck), 8 (slave point), 16 (may leave its segments), 32 (offset)";
  if (host.options & option_old_displacement) text += ", 2 (displacements lack the increment)";
  if (host.options & option_negative_tangent) text += ", 4 (the opposite sign)";
  return text;
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
      return entry(2) + ", the area, is 0 and there is no line for this element in " + table_of(model) +
             "; write \"ELEMENT AREA\" there, or the area in the deck" + e.host->numbers;
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

/// The temperatures of a model with heat.
/// @return what is wrong; "" if nothing
std::string check_heat(const Element& e, const LoadedModel& model) {
  if (!model.layout.heat || (e.host->temperatures && e.temperature >= 0)) return "";
  const std::string text = model.file + " has \"heat\", which takes a temperature in each node; ";
  if (!e.host->temperatures)
    return text + "this host's elements carry displacements alone. Remove \"heat\" from \"contact\"" +
           e.host->heat;
  const int dofs = e.all_dofs ? e.all_dofs : e.nodes * e.dofs;
  return text + "the element has " + std::to_string(dofs) + " degrees of freedom at " +
         std::to_string(e.nodes) + " nodes. " + e.host->heat;
}

/// The same for a rigid body with a reference node.
std::string check_body(const Element& e, const Arguments& arguments) {
  const LoadedModel& model = *arguments.model;
  const ents_layout& layout = model.layout;
  const std::string table = table_of(model);
  const int d = layout.dimension, slave_nodes = arguments.slave_nodes, needed = slave_nodes + 2;
  const std::string slave = slave_nodes == 1 ? std::string("the slave node")
                                             : std::to_string(slave_nodes) + " nodes of the slave's face";
  if (!arguments.turn_node && !e.reference_turns)
    return table +
           " has a rigid body: the element's last node is its reference node, and has the degrees of "
           "freedom " +
           (d == 2 ? "1, 2, 6" : "1 to 6") + ", the nodes before it " + (d == 2 ? "1, 2" : "1, 2, 3") +
           ". Write them so below *USER ELEMENT";
  if (arguments.turn_node && (e.nodes < needed || (e.nodes > needed && !e.host->spare_nodes)))
    return table + " has a rigid body: the element needs " + std::to_string(needed) + " nodes, " + slave +
           ", the reference node, and one whose displacements are the body's turns" +
           (e.host->rotations ? ", or " + std::to_string(slave_nodes + 1) +
                                    ", without the last, and rotations at the reference node"
                              : std::string()) +
           "; the element has " + std::to_string(e.nodes) + ". Write " + e.host->nodes +
           std::to_string(needed);
  if (arguments.turn_node && !e.host->displacements)
    return table + " has a rigid body: the turns are displacements of a node, and this host passes present "
                   "positions only. Take master nodes of the mesh, or a host that passes displacements";
  if (e.dofs < d || e.coordinates < d)
    return model.file + " is a model in " + std::to_string(d) + "D, the element has " +
           std::to_string(std::min(e.dofs, e.coordinates)) + " coordinates and degrees of freedom a node";
  const int history = layout.state_size + body_history(d, arguments.turn_node);
  if (e.history_size < history)
    return model.file + " with a rigid body needs " + std::to_string(history) +
           " history variables, the element has " + std::to_string(e.history_size) + ". Write " +
           e.host->history + std::to_string(history);
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
  if (std::string wrong = check_heat(e, model); !wrong.empty()) return wrong;
  const int slave_nodes = arguments.slave_nodes;
  if (arguments.body) return check_body(e, arguments);
  const int needed = slave_nodes + layout.nodes + (layout.multipliers ? 1 : 0);
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
           e.host->history + std::to_string(layout.state_size + e.host->own_history);
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

} // namespace

std::string read(const Element& e, Arguments& arguments) {
  std::string wrong = read_properties(e, arguments);
  if (wrong.empty()) wrong = read_offset(e, arguments);
  if (wrong.empty()) wrong = read_slave_point(e, arguments);
  if (wrong.empty() && !arguments.model->body.empty()) {
    arguments.body = true;
    arguments.turn_node = !(e.host->rotations && e.nodes == arguments.slave_nodes + 1);
  }
  if (wrong.empty()) wrong = check_sizes(e, arguments);
  if (wrong.empty()) wrong = read_coordinates(e, arguments);
  return wrong;
}

int options(const Row<const double>& properties, int count) {
  if (count < 3) return 0;
  const double value = properties(2);
  return value >= 0 && value <= 63 && value == std::floor(value) ? static_cast<int>(value) : -1;
}

bool has_left(const Arguments& arguments, const ents_input& input, int32_t flags, double gap) {
  constexpr int32_t left = ENTS_FLAG_OUTSIDE | ENTS_FLAG_CHANGED;
  return input.state_begin && (flags & left) == left && gap < 0 && !(arguments.options & option_may_leave);
}

bool lies_beside(const Arguments& arguments, int32_t flags, double gap, const double* master) {
  if (!arguments.model->patch || !(flags & ENTS_FLAG_OUTSIDE) || (flags & ENTS_FLAG_CONTACT) || !(gap < 0) ||
      (arguments.options & option_may_leave))
    return false;
  const int d = arguments.model->layout.dimension;
  double width = 0;
  for (int node = 1; node < arguments.model->layout.nodes; ++node)
    for (int i = 0; i < d; ++i) width = std::max(width, std::abs(master[d * node + i] - master[i]));
  return -gap <= width;
}

} // namespace ents_adapter
