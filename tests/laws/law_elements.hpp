// Random elements of a law with states, anchors and multipliers, near contact.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "differences.hpp"
#include "scene.hpp"

namespace laws {

using mechanics::Basis;
using mechanics::Random;
using nlohmann::json;

struct Method {
  std::string name;
  json normal, friction;
  json wear = nullptr, offset = nullptr, flattening = nullptr, heat = nullptr;
};
inline void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

inline const Method coulomb = {"coulomb",
                               {{"type", "penalty"}, {"stiffness", 100.0}},
                               {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 80.0}}};

// Every normal law with every kind of friction. Lengths are of order 1, gaps of order 0.05.
inline std::vector<Method> methods() {
  const std::vector<json> normals = {{{"type", "penalty"}, {"stiffness", 100.0}},
                                     {{"type", "power"}, {"coefficient", 400.0}, {"exponent", 1.5}},
                                     {{"type", "exponential"}, {"pressure", 0.5}, {"clearance", 0.015}},
                                     {{"type", "augmented"}, {"stiffness", 100.0}},
                                     {{"type", "augmented_multiplier"}, {"stiffness", 100.0}},
                                     {{"type", "multiplier"}, {"stiffness", 100.0}}};
  const std::vector<std::pair<std::string, json>> frictions = {
      {"frictionless", nullptr},
      {"coulomb", {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 80.0}}},
      {"shear_limit", {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 80.0}, {"shear_limit", 0.8}}},
      {"rough", {{"type", "rough"}, {"stiffness", 80.0}}}};
  std::vector<Method> all;
  for (const json& normal : normals)
    for (const auto& [name, friction] : frictions)
      all.push_back({normal["type"].get<std::string>() + "_" + name, normal, friction});
  // Laws that pull, with and without friction; ranges of tension that elements lie in, whose kinks they do not
  const std::vector<json> pulling = {
      {{"type", "tied"}, {"stiffness", 100.0}, {"range", 0.006}},
      {{"type", "cohesive"}, {"stiffness", 100.0}, {"strength", 0.7}, {"energy", 0.02}, {"range", 0.002}},
      {{"type", "dugdale"}, {"work", 0.02}, {"strength", 2.0}, {"stiffness", 400.0}},
      {{"type", "separation"}, {"work", 0.1}, {"length", 0.03}},
      {{"type", "lennard_jones"}, {"work", 0.15}, {"length", 0.15}, {"range", 0.012}}};
  for (const json& normal : pulling)
    for (const auto& [name, friction] : frictions) {
      const std::string type = normal["type"];
      if (name == "rough" && type == "cohesive") continue;
      json own = friction;
      if (name == "shear_limit" && type != "tied" && type != "cohesive") own["adhesion"] = true;
      all.push_back({type + "_" + name, normal, own});
    }
  // Coefficients that vary, between two points of a table, whose kinks no element meets, under a law of the fast block, one of the general block and multipliers
  const json varying[] = {
      {{"type", "coulomb"}, {"coefficient", 0.4}, {"kinetic", 0.15}, {"decay", 0.3}, {"stiffness", 80.0}},
      {{"type", "coulomb"},
       {"coefficient",
        {{"pressures", {0.0, 300.0}},
         {"slip_rates", {0.0, 100.0}},
         {"coefficients", {{0.5, 0.4}, {0.1, 0.05}}}}},
       {"stiffness", 80.0}}};
  for (const std::size_t normal : {0u, 2u, 3u, 4u})
    for (const bool table : {false, true})
      all.push_back(
          {normals[normal]["type"].get<std::string>() + (table ? "_friction_table" : "_friction_decays"),
           normals[normal], varying[table]});
  // Its stiffness has a kink in the middle point, which no element is as deep as.
  const json table = {{"type", "table"}, {"gap", {-0.3, -0.14, 0.002}}, {"pressure", {40, 6, 0}}};
  for (const std::size_t friction : {0u, 1u})
    all.push_back({"table_" + frictions[friction].first, table, frictions[friction].second});
  return all;
}

inline bool pulls(const std::string& normal) {
  for (const char* law : {"tied", "cohesive", "dugdale", "separation", "lennard_jones"})
    if (normal == law) return true;
  return false;
}

// Laws that can wear, frictionless and with friction. About a tenth of the gap is worn off in an increment.
inline std::vector<Method> methods_with_wear() {
  std::vector<Method> all;
  const json wears[] = {{{"coefficient", 0.05}, {"slave", 0.4}},
                        {{"coefficient", 0.05}, {"scheme", "trapezoidal"}, {"sliding", 0.02}},
                        {{"coefficient", 0.05}, {"scheme", "explicit"}, {"slave", 0}}};
  for (const Method& method : methods()) {
    const std::string normal = method.normal["type"];
    if (normal == "table" || normal.ends_with("multiplier") || method.name.ends_with("shear_limit") ||
        method.name.ends_with("rough") || pulls(normal))
      continue;
    for (json wear : wears) {
      if (normal == "exponential") wear["coefficient"] = 0.005; // its pressures are larger
      all.push_back(
          {method.name + "_" + wear.value("scheme", "implicit"), method.normal, method.friction, wear});
    }
  }
  return all;
}
// Every normal law with a clearance or a coating beside its geometry
inline std::vector<Method> methods_with_offset() {
  std::vector<Method> all;
  for (Method method : methods()) {
    if (!method.name.ends_with("coulomb")) continue;
    method.name += "_offset";
    method.offset = all.size() % 2 == 0 && method.normal["type"] != "exponential" ? -0.008 : 0.01;
    all.push_back(method);
  }
  return all;
}
// Laws under which all of the height gives way, to about three quarters at the deepest penetration
inline std::vector<Method> methods_with_flattening() {
  std::vector<Method> all;
  for (Method method : methods()) {
    if (std::string(method.normal["type"]).ends_with("multiplier") ||
        !(method.name.ends_with("coulomb") || method.name == "penalty_frictionless") ||
        pulls(method.normal["type"]))
      continue;
    method.name += "_flattening";
    method.flattening = {{"scale", "flat"}, {"pressure", 20.0}, {"least", 0.3}};
    if (method.normal["type"] == "exponential") method.flattening["pressure"] = 200.0;
    all.push_back(method);
  }
  return all;
}
// Every normal law with heat: through open and closed gaps, and of friction
inline std::vector<Method> methods_with_heat() {
  const json heat = {{"conductance", 0.3},
                     {"power", {{"coefficient", 2.0}, {"pressure", 5.0}, {"exponent", 0.95}}},
                     {"table", {{"pressures", {0, 1e4}}, {"conductances", {0.5, 2e3}}}},
                     {"clearance", {{"gaps", {0, 10}}, {"conductances", {1.5, 0}}}},
                     {"gas", {{"conductivity", 0.1}, {"jump", 0.05}}}};
  std::vector<Method> all;
  std::vector<Method> laws = methods();
  for (const Method& method : methods_with_wear())
    if (method.name.starts_with("penalty")) laws.push_back(method);
  for (Method method : laws) {
    method.name += "_heat";
    method.heat = heat;
    if (pulls(method.normal["type"])) // what depends on the pressure has a kink where it becomes tension
      method.heat.erase("power"), method.heat.erase("table");
    if (!method.friction.is_null()) method.heat["friction"] = {{"share", 0.9}, {"slave", 0.3}};
    all.push_back(method);
  }
  return all;
}
inline std::vector<Method> all_methods() {
  std::vector<Method> all = methods();
  for (const Method& method : methods_with_wear()) all.push_back(method);
  for (const Method& method : methods_with_offset()) all.push_back(method);
  for (const Method& method : methods_with_flattening()) all.push_back(method);
  return all;
}

// Elements with a state that has been in contact at an anchor or, a third of them where friction or wear asks
// for it, open and so touches within the increment; and values of the multiplier dofs and, where the law
// wears, of the slave nodes.
struct LawElements {
  mechanics::Elements at;
  std::vector<double> state, multiplier, slave_values, slave_temperature, master_temperature;
  double time_increment = 0.1;
  ents_layout layout{};
};

inline ents_layout layout_of(const ents_model* model) {
  ents_layout layout{};
  layout.struct_size = sizeof layout;
  if (ents_model_layout(model, &layout, nullptr) != ENTS_OK) throw std::runtime_error("ents_model_layout");
  return layout;
}

// elastic: how far, in natural coordinates, the anchor may lie from the projection
inline LawElements draw(Random& random, const mechanics::Scene& scene, const mechanics::Model& model,
                        std::int64_t count, double elastic) {
  LawElements e;
  e.at = draw_elements(random, scene, model, count, -0.1, 0.02);
  e.layout = layout_of(model.handle());
  const std::size_t n = static_cast<std::size_t>(count), size = static_cast<std::size_t>(e.layout.state_size),
                    t = static_cast<std::size_t>(e.layout.parameters),
                    m = static_cast<std::size_t>(e.layout.multipliers);
  e.at.area.resize(n);
  for (double& area : e.at.area) area = random.uniform(0.2, 1.5);
  e.state.resize(n * size);
  ents_state_init(model.handle(), count, e.state.data(), e.layout.state_size, nullptr);
  e.multiplier.resize(n * m);
  for (std::size_t i = 0; i < n; ++i) {
    double* s = &e.state[i * size];
    const bool touches = (e.layout.friction || e.layout.worn >= 0) && random.uniform(0.0, 1.0) < 1.0 / 3.0;
    s[1] = touches ? 1.0 : 2.0; // open, in contact at the begin of the increment
    std::size_t next = 3;
    for (std::size_t a = 0; a < t; ++a) s[next++] = e.at.start[i * t + a];
    if (e.layout.friction) {
      for (std::size_t a = 0; a < t; ++a)
        s[next++] = e.at.start[i * t + a] + random.uniform(-elastic, elastic);
      s[next++] = random.uniform(0.0, 1.0); // slip so far
    }
    if (e.layout.augmentable) {
      s[next++] = random.uniform(0.0, 3.0);
      const std::size_t end = e.layout.worn < 0 ? size - 1 : static_cast<std::size_t>(e.layout.worn);
      while (next < end) s[next++] = random.uniform(-0.5, 0.5);
    }
    if (e.layout.worn >= 0) {
      s[next++] = random.uniform(0.0, 0.005);
      s[next++] = random.uniform(0.0, 0.002);
      s[next++] = random.uniform(0.0, 3.0);
      for (std::size_t a = 0; a < t; ++a)
        s[next++] = e.at.start[i * t + a] + random.uniform(-elastic, elastic);
    }
    if (next + 2 == size) // before the number of the segment, of a law that bonds: the largest gap so far
      s[next++] = random.uniform(0.0, 1.0) < 0.3 ? 0.0 : random.uniform(0.007, 0.03);
    if (touches) { // a projection from which it comes and, where an anchor would be, its clearance there
      for (std::size_t a = 0; a < t; ++a) s[3 + a] += random.uniform(-elastic, elastic);
      s[e.layout.friction ? 3 + t : static_cast<std::size_t>(e.layout.worn) + 3] = random.uniform(0.02, 0.2);
    }
    if (e.layout.worn >= 0)
      for (const double value :
           {random.uniform(-0.01, 0.01), random.uniform(0.5, 1.5), random.uniform(0.0, 2.0)})
        e.slave_values.push_back(value);
    for (std::size_t k = 0; k < m; ++k)
      e.multiplier[i * m + k] = k == 0 ? random.uniform(0.0, 3.0) : random.uniform(-0.5, 0.5);
  }
  if (e.layout.heat) {
    e.slave_temperature.resize(n);
    e.master_temperature.resize(n * static_cast<std::size_t>(e.layout.nodes));
    for (double& temperature : e.slave_temperature) temperature = random.uniform(0.0, 2.0);
    for (double& temperature : e.master_temperature) temperature = random.uniform(0.0, 2.0);
  }
  return e;
}

struct LawResults {
  std::vector<std::int32_t> status, flags;
  std::vector<double> gap, residual, tangent, pressure, traction, state;
};

// The elements as the library takes them. start: ents_input.start; empty: none
inline ents_input input_of(const LawElements& e, const std::vector<double>& start = {}) {
  const ents_layout& l = e.layout;
  const std::int64_t d = l.dimension;
  ents_input in{};
  in.struct_size = sizeof in;
  in.slave = e.at.slave.data();
  in.slave_stride = d;
  in.master = e.at.master.data();
  in.master_stride = d * l.nodes;
  in.surface_coordinates = e.at.surface_coordinates.empty() ? nullptr : e.at.surface_coordinates.data();
  in.surface_coordinates_stride = l.parameters * l.nodes;
  if (!start.empty()) in.start = start.data(), in.start_stride = l.parameters;
  in.area = e.at.area.data();
  in.area_stride = 1;
  in.state_begin = e.state.data();
  in.state_begin_stride = l.state_size;
  in.multiplier = e.multiplier.data();
  in.multiplier_stride = l.multipliers;
  if (e.layout.heat) {
    in.slave_temperature = e.slave_temperature.data(), in.slave_temperature_stride = 1;
    in.master_temperature = e.master_temperature.data(), in.master_temperature_stride = l.nodes;
  }
  in.time_increment = e.time_increment;
  if (!e.slave_values.empty()) in.slave_values = e.slave_values.data(), in.slave_values_stride = 3;
  return in;
}

// What ents_evaluate returns. start: ents_input.start; empty: none
inline std::int32_t try_evaluate(const ents_model* model, const LawElements& e, std::int32_t wanted,
                                 LawResults& r, ents_report& report, const std::vector<double>& start = {}) {
  const ents_layout& l = e.layout;
  const std::int64_t count = e.at.count, d = l.dimension, n = l.dofs;
  const auto sized = [&](auto& array, std::int64_t entries) {
    array.resize(static_cast<std::size_t>(count * entries));
  };
  sized(r.status, 1);
  sized(r.flags, 1);
  sized(r.residual, n);
  if (wanted & ENTS_TANGENT) sized(r.tangent, n * n);
  sized(r.gap, 1);
  sized(r.pressure, 1);
  sized(r.traction, d);
  sized(r.state, l.state_size);
  const ents_input in = input_of(e, start);
  ents_output out{};
  out.struct_size = sizeof out;
  out.wanted = wanted;
  out.status = r.status.data();
  out.status_stride = 1;
  out.flags = r.flags.data();
  out.flags_stride = 1;
  out.residual = r.residual.data();
  out.residual_stride = n;
  out.tangent = r.tangent.data();
  out.tangent_stride = n * n;
  out.gap = r.gap.data();
  out.gap_stride = 1;
  out.pressure = r.pressure.data();
  out.pressure_stride = 1;
  out.traction = r.traction.data();
  out.traction_stride = d;
  out.state_end = r.state.data();
  out.state_end_stride = l.state_size;
  report = {};
  report.struct_size = sizeof report;
  return ents_evaluate(model, 0, count, &in, &out, &report);
}
inline void evaluate(const ents_model* model, const LawElements& e, std::int32_t wanted, LawResults& r) {
  ents_report report;
  if (try_evaluate(model, e, wanted, r, report) < 0) throw std::runtime_error(report.message);
}
// From a start near the projection: without one an open element has its whole segment searched, each time.
inline void evaluate_near(const ents_model* model, const LawElements& e, std::int32_t wanted, LawResults& r) {
  ents_report report;
  if (try_evaluate(model, e, wanted, r, report, e.at.start) < 0) throw std::runtime_error(report.message);
}
inline void evaluate(const mechanics::Model& model, const LawElements& e, std::int32_t wanted,
                     LawResults& r) {
  evaluate(model.handle(), e, wanted, r);
}

inline mechanics::Model model_of(const mechanics::Scene& scene, const Method& method,
                                 const char* master = "deformable") {
  json text = scene.model();
  text["master"] = master;
  text["contact"] = {{"normal", method.normal}, {"friction", method.friction},     {"wear", method.wear},
                     {"offset", method.offset}, {"flattening", method.flattening}, {"heat", method.heat}};
  if (!method.flattening.is_null()) {
    const json none = {{"type", "constant"}, {"value", 0.01}};
    text["height"] = {
        {"type", "scale"}, {"by", "flat"}, {"of", scene.height.is_null() ? none : scene.height}};
    text["parameters"] = {{"flat", 1.0}};
  }
  return mechanics::Model(text.dump());
}

} // namespace laws
