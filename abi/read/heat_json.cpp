// SPDX-License-Identifier: BSD-3-Clause
// "heat" of a model's contact: the parts of the conductance, and the heat of friction.
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "abi/read/contact_json.hpp"
#include "abi/read/json_tree.hpp"

namespace ents {

using nlohmann::json;

namespace {

// Points of {argument_key: [...], "conductances": [...]}
std::vector<ConductancePoint> read_points(const json& table, const std::string& path,
                                          const char* argument_key) {
  constexpr std::size_t most = 1024;
  const std::string at = member(path, argument_key), of = member(path, "conductances");
  check_keys(table, path, {argument_key, "conductances"}, {});
  check_array(table.at(argument_key), at, most, "numbers, rising");
  const std::size_t count = table.at(argument_key).size();
  const std::vector<double> places = read_vector(table.at(argument_key), at, count, Range::not_negative, "");
  const std::vector<double> values =
      read_vector(table.at("conductances"), of, count, Range::not_negative, "one for each place");
  if (count < 2) fail(ENTS_BAD_VALUE, at, "has one number; write 2 to 1024, rising, the first of them 0");
  if (places.front() != 0.0)
    fail(ENTS_BAD_VALUE, item(at, 0), "is " + shown(places.front()) + "; a table begins at 0");
  std::vector<ConductancePoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && !(places[i] > places[i - 1]))
      fail(ENTS_BAD_VALUE, item(at, i),
           "is " + shown(places[i]) + ", not above the number before it; write rising numbers");
    points.push_back({places[i], values[i]});
    if (i > 0 && !std::isfinite((values[i] - values[i - 1]) / (places[i] - places[i - 1])))
      fail(ENTS_BAD_VALUE, item(at, i), "is so close to the number before it that the slope is not finite");
  }
  return points;
}

void read_power(const json& power, const std::string& path, ModelSpec& model) {
  Heat& heat = model.law.heat;
  check_keys(power, path, {"coefficient", "pressure", "exponent"}, {});
  heat.coefficient = read_law_number(power, path, "coefficient", model, model.law_binding.heat_coefficient,
                                     Range::not_negative);
  heat.pressure = read_double(power, path, "pressure", Range::positive);
  heat.exponent = read_double(power, path, "exponent", Range::positive);
  if (!(heat.exponent >= 0.1 && heat.exponent <= 10.0))
    fail(ENTS_BAD_VALUE, member(path, "exponent"), "is " + shown(heat.exponent) + ", not in 0.1 .. 10");
}

void read_friction_heat(const json& friction, const std::string& path, ModelSpec& model) {
  Heat& heat = model.law.heat;
  check_keys(friction, path, {}, {"share", "slave"});
  if (!model.law.has_friction())
    fail(ENTS_BAD_VALUE, path, "needs friction; write \"friction\" beside \"heat\" in \"contact\"");
  heat.share = 1.0;
  if (friction.contains("share"))
    heat.share =
        read_law_number(friction, path, "share", model, model.law_binding.heat_share, Range::not_negative);
  heat.slave = read_double_or(friction, path, "slave", Range::not_negative, 0.5);
  for (const auto& [key, value] : {std::pair{"share", heat.share}, std::pair{"slave", heat.slave}})
    if (!(value <= 1.0))
      fail(ENTS_BAD_VALUE, member(path, key), "is " + shown(value) + "; it is a part of the whole, 0 .. 1");
  heat.has_friction = heat.share != 0.0 || model.law_binding.heat_share != 0;
}

} // namespace

void read_heat(const json& value, const std::string& path, ModelSpec& model) {
  Heat& heat = model.law.heat;
  check_keys(value, path, {}, {"conductance", "power", "table", "clearance", "gas", "friction"});
  if (value.empty())
    fail(ENTS_BAD_VALUE, path,
         "is empty; write \"conductance\", \"power\", \"table\", \"clearance\", \"gas\" or \"friction\"");
  heat.on = true;
  if (value.contains("conductance"))
    heat.constant = read_law_number(value, path, "conductance", model, model.law_binding.heat_constant,
                                    Range::not_negative);
  if (value.contains("power")) read_power(value.at("power"), member(path, "power"), model);
  if (value.contains("table"))
    model.conductance_by_pressure = read_points(value.at("table"), member(path, "table"), "pressures");
  if (value.contains("clearance")) {
    const std::string table = member(path, "clearance");
    model.conductance_by_gap = read_points(value.at("clearance"), table, "gaps");
    if (const double last = model.conductance_by_gap.back().conductance; last != 0.0)
      fail(ENTS_BAD_VALUE, item(member(table, "conductances"), model.conductance_by_gap.size() - 1),
           "is " + shown(last) + "; the last one is 0: beyond the last gap nothing is conducted");
  }
  if (value.contains("gas")) {
    const std::string gas = member(path, "gas");
    check_keys(value.at("gas"), gas, {"conductivity", "jump"}, {});
    heat.conductivity = read_law_number(value.at("gas"), gas, "conductivity", model,
                                        model.law_binding.heat_conductivity, Range::not_negative);
    heat.jump = read_double(value.at("gas"), gas, "jump", Range::positive);
  }
  if (value.contains("friction")) read_friction_heat(value.at("friction"), member(path, "friction"), model);
  if (model.law.flattening.parameter != 0) fail(ENTS_BAD_VALUE, path, "is not possible with \"flattening\"");
  if (model.law.symmetrised)
    fail(ENTS_BAD_VALUE, path,
         "is not possible with \"symmetrised\": temperatures and displacements are not "
         "coupled symmetrically");
}

} // namespace ents
