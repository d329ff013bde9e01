// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/contact_json.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "abi/read/json_check.hpp"
#include "abi/read/json_tree.hpp"
#include "core/element/flattening.hpp"
#include "core/law/laws.hpp"

namespace ents {

using nlohmann::json;

double read_law_number(const json& object, const std::string& path, const char* key, const ModelSpec& model,
                       std::uint8_t& bound_to, Range range) {
  const double number =
      read_bound_double(object.at(key), member(path, key), Range::any, model.parameters, bound_to);
  if (bound_to == 0) return read_double(object, path, key, range);
  if (!(number >= least_of(range)))
    fail(ENTS_BAD_VALUE, member(path, key),
         "is a parameter whose value is " + shown(number) +
             (range == Range::positive ? "; it has to be positive" : "; it is not negative"));
  return number;
}

namespace {

// A multiple of 1/2, twice
std::int32_t read_exponent(const json& normal, const std::string& path, const char* key) {
  const double exponent = read_double(normal, path, key, Range::positive);
  if (exponent < 1.0 || exponent > 20.0 || 2.0 * exponent != std::floor(2.0 * exponent))
    fail(ENTS_BAD_VALUE, member(path, key),
         "is " + shown(exponent) + ", not one of 1, 1.5, 2, 2.5 .. 20; write one of them");
  return static_cast<std::int32_t>(2.0 * exponent);
}

void read_table(const json& normal, const std::string& path, const char* gap_key, const char* pressure_key,
                ModelSpec& model) {
  constexpr std::size_t most = 1024;
  const json& gaps = normal.at(gap_key);
  const std::string at_gap = member(path, gap_key), at_pressure = member(path, pressure_key);
  check_array(gaps, at_gap, most, "gaps, rising");
  if (gaps.size() < 2) fail(ENTS_BAD_VALUE, at_gap, "has one number; write 2 to 1024 gaps, rising");
  const std::vector<double> gap = read_vector(gaps, at_gap, gaps.size(), Range::any, "");
  const std::vector<double> pressure =
      read_vector(normal.at(pressure_key), at_pressure, gap.size(), Range::any, "one per gap");
  for (std::size_t i = 1; i < gap.size(); ++i) {
    if (!(gap[i] > gap[i - 1]))
      fail(ENTS_BAD_VALUE, item(at_gap, i),
           "is " + shown(gap[i]) + ", not above the gap before it; write rising gaps");
    if (!(pressure[i] < pressure[i - 1]))
      fail(ENTS_BAD_VALUE, item(at_pressure, i),
           "is " + shown(pressure[i]) + ", not below the pressure before it; write falling pressures");
  }
  if (pressure.back() != 0.0)
    fail(ENTS_BAD_VALUE, item(at_pressure, gap.size() - 1),
         "is " + shown(pressure.back()) + "; the last pressure is 0: contact begins at the last gap");
  model.law_table = make_law_table(gap, pressure);
  for (const LawTable& point : model.law_table)
    if (!std::isfinite(point.force + point.stiffness + point.energy))
      fail(ENTS_BAD_VALUE, at_gap, "has gaps so close to each other that the stiffness is not finite");
}

// By what the law's table says.
void read_normal(const json& normal, const std::string& path, ModelSpec& model) {
  std::vector<std::string_view> types, keys{"type"};
  for (const LawEntry& entry : law_entries) types.push_back(entry.type);
  const LawEntry& entry = law_entries[read_type(normal, path, types)];
  const std::span numbers(entry.numbers, static_cast<std::size_t>(entry.count));
  for (const LawNumber& number : numbers) keys.push_back(number.key);
  check_keys(normal, path, keys, {});
  set_normal_law(entry, model.law);
  const char* gap_key = "";
  double* to = model.law.number;
  for (const LawNumber& number : numbers) switch (number.kind) {
    case LawNumber::positive:
      *to++ = number.named ? read_law_number(normal, path, number.key, model, model.law_binding.normal)
                           : read_double(normal, path, number.key, Range::positive);
      break;
    case LawNumber::exponent:
      model.law.twice_exponent = read_exponent(normal, path, number.key);
      break;
    case LawNumber::rising:
      gap_key = number.key;
      break;
    case LawNumber::falling:
      read_table(normal, path, gap_key, number.key, model);
      break;
    }
  if (const char* mistake = entry.mistake(model.law)) fail(ENTS_BAD_VALUE, path, mistake);
}

// The entry of a law that has been read
const LawEntry& entry_of(NormalKind kind) {
  for (const LawEntry& entry : law_entries)
    if (entry.kind == kind) return entry;
  return law_entries[0];
}

// {"pressures": [...], "slip_rates": [...], "coefficients": [[...], ...]}: a row for each pressure
void read_coefficients(const json& value, const std::string& path, ModelSpec& model) {
  constexpr std::size_t most = 256;
  check_keys(value, path, {"coefficients"}, {"pressures", "slip_rates"});
  const auto read_rising = [&](const char* key, std::vector<double>& to) {
    to.assign(1, 0.0);
    if (!value.contains(key)) return;
    const std::string at = member(path, key);
    check_array(value.at(key), at, most, "numbers, rising");
    to = read_vector(value.at(key), at, value.at(key).size(), Range::not_negative, "");
    if (to.empty()) fail(ENTS_BAD_VALUE, at, "is empty; write rising numbers, or leave the key out");
    for (std::size_t i = 1; i < to.size(); ++i)
      if (!(to[i] > to[i - 1]))
        fail(ENTS_BAD_VALUE, item(at, i),
             "is " + shown(to[i]) + ", not above the number before it; write rising numbers");
  };
  read_rising("pressures", model.friction_pressures);
  read_rising("slip_rates", model.friction_rates);
  if (model.friction_rates.front() != 0.0)
    fail(ENTS_BAD_VALUE, item(member(path, "slip_rates"), 0),
         "is " + shown(model.friction_rates.front()) + "; write 0, the rate at which sticking ends");
  const std::string at = member(path, "coefficients");
  const json& rows = value.at("coefficients");
  check_array(rows, at, most, "rows, one per pressure");
  if (rows.size() != model.friction_pressures.size())
    fail(ENTS_BAD_VALUE, at,
         "has " + std::to_string(rows.size()) + " rows; write one per pressure, " +
             std::to_string(model.friction_pressures.size()));
  ContactLaw& law = model.law;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const double mu : read_vector(rows.at(i), item(at, i), model.friction_rates.size(),
                                       Range::not_negative, "one per slip rate")) {
      model.friction_coefficients.push_back(mu);
      law.friction_coefficient = mu > law.friction_coefficient ? mu : law.friction_coefficient;
    }
  law.varying.kind = VaryingCoefficient::table;
  law.varying.pressures = static_cast<std::int32_t>(model.friction_pressures.size());
  law.varying.rates = static_cast<std::int32_t>(model.friction_rates.size());
}

void read_friction(const json& friction, const std::string& path, ModelSpec& model) {
  ContactLaw& law = model.law;
  const LawEntry& normal = entry_of(law.normal);
  const bool rough = read_type(friction, path, {"coulomb", "rough"}) == 1;
  if (rough) {
    check_keys(friction, path, {"type", "stiffness"}, {});
    law.friction = FrictionKind::rough;
    if (normal.is_damaged)
      fail(ENTS_BAD_VALUE, member(path, "type"),
           "is not possible with the normal law \"" + std::string(normal.type) +
               "\", whose damage does not weaken shear; write \"coulomb\", which acts on the pressure, or no "
               "friction");
  } else {
    check_keys(friction, path, {"type", "coefficient", "stiffness"},
               {"shear_limit", "adhesion", "kinetic", "decay"});
    law.friction = FrictionKind::coulomb;
    const bool decays = friction.contains("kinetic") || friction.contains("decay");
    if (friction.at("coefficient").is_object()) {
      if (decays)
        fail(ENTS_BAD_VALUE, path,
             "has \"kinetic\" or \"decay\" beside a table of coefficients; write one of the two");
      read_coefficients(friction.at("coefficient"), member(path, "coefficient"), model);
    } else {
      law.friction_coefficient = read_law_number(friction, path, "coefficient", model,
                                                 model.law_binding.friction, Range::not_negative);
    }
    if (decays) {
      if (!friction.contains("kinetic") || !friction.contains("decay"))
        fail(ENTS_BAD_VALUE, path, "has one of \"kinetic\" and \"decay\"; write both, or neither");
      law.varying.kind = VaryingCoefficient::decays;
      law.varying.kinetic = read_double(friction, path, "kinetic", Range::not_negative);
      law.varying.decay = read_double(friction, path, "decay", Range::positive);
    }
    law.shear_limit =
        friction.contains("shear_limit") ? read_double(friction, path, "shear_limit", Range::positive) : 0.0;
    if (friction.contains("adhesion"))
      law.rubs_adhering = read_bool(friction.at("adhesion"), member(path, "adhesion"));
    if (law.rubs_adhering && !normal.adheres)
      fail(ENTS_BAD_VALUE, member(path, "adhesion"),
           "is of a normal law that adheres; write \"dugdale\", \"separation\" or \"lennard_jones\" as "
           "/contact/normal/type, or false");
  }
  law.friction_stiffness = read_double(friction, path, "stiffness", Range::positive);
}

void read_wear(const json& wear, const std::string& path, ModelSpec& model) {
  check_keys(wear, path, {"coefficient"}, {"scheme", "slave", "sliding"});
  Wear& law = model.law.wear;
  const auto number = [&](const char* key, std::uint8_t& bound_to) {
    return read_law_number(wear, path, key, model, bound_to, Range::not_negative);
  };
  law.on = true;
  law.coefficient = number("coefficient", model.law_binding.wear);
  if (wear.contains("sliding")) law.sliding = number("sliding", model.law_binding.sliding);
  if (wear.contains("scheme")) {
    constexpr double weights[] = {1.0, 0.5, 0.0};
    law.implicit = weights[read_choice(wear.at("scheme"), member(path, "scheme"),
                                       {"implicit", "trapezoidal", "explicit"})];
  }
  if (wear.contains("slave")) {
    law.slave = read_double(wear, path, "slave", Range::any);
    if (!(law.slave >= 0.0 && law.slave <= 1.0))
      fail(ENTS_BAD_VALUE, member(path, "slave"),
           "is " + shown(law.slave) +
               "; it is the part of the worn depth that the slave surface loses, 0 .. 1");
  }
  if (const LawEntry& entry = entry_of(model.law.normal); !entry.wears)
    fail(ENTS_BAD_VALUE, path, "is not possible with the normal law \"" + std::string(entry.type) + "\"");
  if (model.law.multiplier_is_dof())
    fail(ENTS_BAD_VALUE, path,
         "needs a normal law whose pressure follows from the gap; write \"penalty\", \"power\", "
         "\"exponential\" or \"augmented\" as /contact/normal/type");
}

// Before the height is known: check_flattened() has the rest.
void read_flattening(const json& value, const std::string& path, ModelSpec& model) {
  check_keys(value, path, {"scale", "pressure"}, {"least"});
  Flattening& law = model.law.flattening;
  if (!value.at("scale").is_string())
    fail(ENTS_BAD_VALUE, member(path, "scale"), "is no name of a parameter that scales a part of the height");
  const double scale = read_bound_double(value.at("scale"), member(path, "scale"), Range::any,
                                         model.parameters, law.parameter);
  if (scale != 1.0)
    fail(ENTS_BAD_VALUE, member(path, "scale"),
         "is a parameter whose value is " + shown(scale) + "; write 1, the height without pressure");
  law.pressure = read_double(value, path, "pressure", Range::positive);
  if (value.contains("least")) law.least = read_double(value, path, "least", Range::any);
  if (!(law.least >= 0.0 && law.least < 1.0))
    fail(ENTS_BAD_VALUE, member(path, "least"),
         "is " + shown(law.least) +
             "; it is the part of the height that is left under any pressure, 0 .. < 1");
  if (model.law.multiplier_is_dof() || model.law.wear.on)
    fail(ENTS_BAD_VALUE, path,
         "is not possible with " + std::string(model.law.wear.on ? "\"wear\"" : "multipliers as unknowns"));
  if (model.law.pulls)
    fail(ENTS_BAD_VALUE, path,
         "is not possible with a normal law that pulls, \"" + std::string(entry_of(model.law.normal).type) +
             "\"");
}

} // namespace

void read_contact(const json& value, const std::string& path, ModelSpec& model) {
  check_keys(value, path, {"normal"}, {"friction", "symmetrised", "wear", "offset", "flattening", "heat"});
  read_normal(value.at("normal"), member(path, "normal"), model);
  if (value.contains("friction") && !value.at("friction").is_null())
    read_friction(value.at("friction"), member(path, "friction"), model);
  if (value.contains("wear") && !value.at("wear").is_null())
    read_wear(value.at("wear"), member(path, "wear"), model);
  if (value.contains("offset") && !value.at("offset").is_null()) {
    model.law.has_offset = true;
    model.law.offset = read_bound_double(value.at("offset"), member(path, "offset"), Range::any,
                                         model.parameters, model.law_binding.offset);
  }
  if (value.contains("flattening") && !value.at("flattening").is_null())
    read_flattening(value.at("flattening"), member(path, "flattening"), model);
  if (value.contains("symmetrised"))
    model.law.symmetrised = read_bool(value.at("symmetrised"), member(path, "symmetrised"));
  if (value.contains("heat") && !value.at("heat").is_null())
    read_heat(value.at("heat"), member(path, "heat"), model);
}

void check_flattened(const ModelSpec& model) {
  const std::uint8_t scale = model.law.flattening.parameter;
  if (scale == 0) return;
  bool scales = false, elsewhere = false;
  for (const HeightNode& node : model.height.nodes())
    for (int i = 0; i < 4; ++i)
      if (node.kind != HeightKind::map && node.bound_to[i] == scale)
        (node.kind == HeightKind::constant ? scales : elsewhere) = true;
  const std::string path = "/contact/flattening/scale";
  if (!scales || elsewhere)
    fail(
        ENTS_BAD_VALUE, path,
        "has to be the \"by\" of a height {\"type\": \"scale\", \"by\": ..., \"of\": ...}, and nothing else");
  if (model.height.nodes().size() > most_flattened_nodes)
    fail(ENTS_BAD_VALUE, path,
         "is of a height with more than " + std::to_string(most_flattened_nodes) + " parts");
}

} // namespace ents
