// SPDX-License-Identifier: BSD-3-Clause
#include "result.hpp"

#include <algorithm>
#include <cmath>

#include "output.hpp"

namespace host {
namespace {

/// What the slave points carry together, of this mesh.
ents_resultants resultants_of(const Contact& contact, const ContactResults& r, int dimension) {
  auto sum = ents::make<ents_resultants>();
  ents::require(ents::linked(), ents_contact_resultants, dimension, ssize_of(contact.points()),
                r.position.data(), r.normal.data(), r.pressure.data(), r.traction.data(),
                contact.areas().data(), r.flags.data(), static_cast<const double*>(nullptr), &sum);
  return sum;
}

Json step_json(Equations& equations, const Step& step) {
  const Scene& scene = equations.scene();
  Json out{
      {"step", step.number}, {"value", step.value}, {"iterations", step.iterations()}, {"cuts", step.cuts}};
  out["wall_time"] = step.wall_time;
  out["increments"] = Json::array();
  for (const Increment& increment : step.increments)
    out["increments"].push_back({{"value", increment.value}, {"residuals", increment.residuals}});
  const Contact* contact = equations.contact();
  if (contact == nullptr) return out;
  const ents_resultants sum = resultants_of(*contact, step.contact, scene.dimension);
  double gap = 0, gap_area = 0;
  for (std::size_t k = 0; k < contact->points(); ++k)
    if (!std::isnan(step.contact.gap[k]))
      gap += contact->areas()[k] * step.contact.gap[k], gap_area += contact->areas()[k];
  double squared = 0; // of what the contact carries: on a body no force is prescribed
  out["contact_force"] = Json::array();
  for (const double component : step.contact.force) {
    out["contact_force"].push_back(component * scene.symmetry_copies);
    squared += component * component;
  }
  const double force = contact->rigid() ? step.force : std::sqrt(squared) * scene.symmetry_copies;
  out["approach"] = step.approach, out["force"] = force;
  out["mean_pressure"] = force / scene.symmetry_copies / equations.slave_area();
  out["contact_fraction"] = sum.area / equations.slave_area();
  out["peak_pressure"] = sum.largest_pressure;
  if (!step.contact.heat.empty()) {
    double power = 0;
    for (const double point : step.contact.heat) power += point;
    out["heat"] = power * scene.symmetry_copies;
    out["friction_heat"] = step.contact.friction_heat * scene.symmetry_copies;
  }
  out["resultants"] = resultants_json(sum, scene.dimension);
  out["mean_gap"] = number(gap / gap_area);
  return out;
}

vtu::Grid bodies(const Equations& equations, const Configuration& at) {
  const Mesh& mesh = equations.mesh();
  vtu::Grid grid = grid_of(mesh, mesh.node_count());
  const Scene& scene = equations.scene();
  const auto begin = at.displacement.begin(),
             temperatures = begin + static_cast<std::ptrdiff_t>(mesh.coordinates.size());
  grid.point_data.push_back(
      {with_unit("displacement", scene.unit_of_length), mesh.dimension, {begin, temperatures}});
  if (scene.heat) {
    vtu::Array& field =
        grid.point_data.emplace_back(vtu::Array{"temperature", 1, {temperatures, at.displacement.end()}});
    for (double& temperature : field.values) temperature += scene.temperature;
  }
  grid.point_data.push_back({with_unit("stress", scene.unit_of_pressure), mesh.dimension == 3 ? 6 : 4,
                             equations.bulk().nodal_stress(at.displacement)});
  return grid;
}

vtu::Grid slave_points(const Equations& equations, const ContactResults& r) {
  const Scene& scene = equations.scene();
  vtu::Grid grid = vtu::point_cloud(scene.dimension, r.position);
  grid.point_data.push_back({with_unit("gap", scene.unit_of_length), 1, r.gap});
  grid.point_data.push_back({with_unit("pressure", scene.unit_of_pressure), 1, r.pressure});
  grid.point_data.push_back({"normal", scene.dimension, r.normal});
  grid.point_data.push_back({with_unit("traction", scene.unit_of_pressure), scene.dimension, r.traction});
  grid.point_data.push_back({with_unit("slip", scene.unit_of_length), 1, r.slip});
  std::vector<double> status; // 0 open, 1 stick (without friction: closed), 2 slip
  for (const std::int32_t flags : r.flags)
    status.push_back((flags & ENTS_FLAG_CONTACT) == 0 ? 0 : (flags & ENTS_FLAG_SLIP) == 0 ? 1 : 2);
  grid.point_data.push_back({"status", 1, std::move(status)});
  if (!r.heat.empty()) grid.point_data.push_back({"heat", 1, r.heat});
  return grid;
}

} // namespace

Json result_json(Equations& equations, const std::vector<Step>& steps, const std::string& failure) {
  const Scene& scene = equations.scene();
  const Mesh& mesh = equations.mesh();
  std::size_t elements = 0;
  for (const ElementGroup& group : mesh.groups) elements += group.size();
  const Contact* contact = equations.contact();
  Json result{{"title", scene.title},
              {"scene", scene.file.string()},
              {"solver", equations.solver_name()},
              {"sizes",
               {{"nodes", mesh.node_count()},
                {"elements", elements},
                {"equations", equations.size()},
                {"contact_elements", contact ? contact->points() : 0},
                {"master_segments", contact ? contact->segments() : 0}}},
              {"failure", failure.empty() ? Json() : Json(failure)}};
  result["steps"] = Json::array();
  for (const Step& step : steps) result["steps"].push_back(step_json(equations, step));
  return result;
}

void write_step(vtu::Series& series, Equations& equations, const Step& step) {
  series.add(step.number, step.value, "bulk", bodies(equations, step.at));
  if (Contact* contact = equations.contact()) {
    series.add(step.number, step.value, "slave", slave_points(equations, step.contact));
    vtu::Grid surface;
    surface.dimension = equations.scene().dimension;
    surface.point_data.push_back({with_unit("height", equations.scene().unit_of_length), 1, {}});
    const double segments = static_cast<double>(contact->segments()); // as smooth as some 40 000 cells allow
    const double divisions = surface.dimension == 2 ? 8000 / segments : std::sqrt(40000 / segments);
    contact->sample_surface(step.at, static_cast<int>(std::clamp(divisions, 2., 400.)), surface);
    series.add(step.number, step.value, "surface", surface);
  }
  series.write_list();
}

} // namespace host
