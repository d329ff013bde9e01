// SPDX-License-Identifier: BSD-3-Clause
// What a step leaves: fields and sums over the slave surface, and what exact solutions are compared with.
#include <algorithm>
#include <cmath>

#include "conductance.hpp"
#include "merged_places.hpp"
#include "run.hpp"

namespace host {
namespace {

/// Of a rigid body that turns: moment, mean radius of its contact, and which way it turns.
void set_turning(const Simulation& simulation, const StepRecord& record, SurfaceState& state) {
  const auto d = static_cast<std::size_t>(simulation.scene().dimension);
  state.moment = record.fields.moment.back();
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k < record.fields.closed.size(); ++k) {
    const double weight = record.fields.node_forces[k * d + d - 1];
    sum += weight * std::hypot(record.positions[k * d], record.positions[k * d + 1]);
    weights += weight;
  }
  state.mean_radius = weights != 0 ? sum / weights : 0;
  const double now = simulation.now().load_factor;
  for (const BodyComponent& c : simulation.scene().contact->body->prescribed) {
    if (c.component != RigidBodySpec::components(static_cast<int>(d)) - 1) continue;
    const double step = c.value * (c.path.at(now) - c.path.at(now - 1e-6 * (1 + std::abs(now))));
    state.turning = step > 0 ? 1 : step < 0 ? -1 : 0;
  }
}

/// Forces, moment about the origin, area and counts; a point without a projection presses nothing.
ents_resultants resultants_of(const Contact& contact, const StepRecord& record, int dimension) {
  auto sum = ents_struct<ents_resultants>();
  auto report = ents_struct<ents_report>();
  const ContactFields& fields = record.fields;
  const ents::Library& library = contact.master().model->library();
  const std::int32_t status =
      library.contact_resultants(dimension, stride(record.areas.size()), record.positions.data(),
                                 fields.normal.data(), fields.pressure.data(), fields.traction.data(),
                                 record.areas.data(), fields.flags.data(), nullptr, &sum, &report);
  if (status != ENTS_OK) throw JobError("resultants of the contact: " + describe(library, status, report));
  return sum;
}

} // namespace

SurfaceState surface_state(Simulation& simulation, const StepRecord& record) {
  const Contact& contact = *simulation.contact();
  const auto d = static_cast<std::size_t>(simulation.mesh().dimension);
  SurfaceState state;
  for (std::size_t k = 0; k < record.areas.size(); ++k) {
    const double* place = record.places.data() + k * d;
    state.distance.push_back(d == 2
                                 ? distance_from(simulation.exact_axis(), simulation.scene().exact, place[0])
                                 : std::hypot(place[0], place[1]));
  }
  state.load.assign(d, 0.0);
  const std::vector<double> loads = simulation.loads(simulation.now().load_factor);
  for (std::size_t dof = 0; dof < loads.size(); ++dof) state.load[dof % d] += loads[dof];
  for (std::size_t k = 0; k < record.areas.size(); ++k) {
    state.place.push_back(record.places[k * d]);
    state.place_y.push_back(record.places[k * d + 1]);
    state.moved.push_back(record.positions[k * d] - record.places[k * d]);
    state.shear.push_back(record.fields.traction[k * d]);
    state.sticks.push_back(record.fields.closed[k] && (record.fields.flags[k] & ENTS_FLAG_SLIP) == 0);
  }
  state.contact_force = record.fields.force;
  if (simulation.scene().contact->body) set_turning(simulation, record, state);
  state.pressure = record.fields.pressure;
  state.gap = record.fields.gap;
  state.area = record.areas;
  state.closed = record.fields.closed;
  state.approach = record.approach;
  state.force = record.force;
  state.mean_pressure = record.mean_pressure;
  state.slid = contact.slid();
  state.worn_volume = record.worn_slave, state.worn_depth = record.worn_depth;
  state.contact_estimate = record.area.fraction;
  return state;
}

void fill_contact_results(Simulation& simulation, StepRecord& record) {
  Contact* contact = simulation.contact();
  if (contact == nullptr) return;
  const Scene& scene = simulation.scene();
  record.fields = contact->accepted();
  record.contact_force = record.fields.force;
  for (double& component : record.contact_force) component *= scene.symmetry_copies;
  record.moment = record.fields.moment;
  if (const int node = contact->master().body_node; node >= 0) {
    const auto first =
        simulation.now().displacement.begin() + static_cast<std::ptrdiff_t>(node) * scene.dimension;
    record.body_moved.assign(first, first + RigidBodySpec::components(scene.dimension));
    record.body_rotation = simulation.now().rotation;
  }
  record.force = simulation.now().force * scene.symmetry_copies;
  record.approach = simulation.now().motion - simulation.first_touch();
  record.mean_pressure = simulation.now().force / simulation.contact_area();
  if (!contact->master()
           .translates()) { // the load is not ours to prescribe: what the contact carries, in size
    double squared = 0;
    for (const double component : record.contact_force) squared += component * component;
    record.force = std::sqrt(squared);
    record.mean_pressure = record.force / (simulation.contact_area() * scene.symmetry_copies);
  }
  double closed = 0, gap = 0, gap_area = 0;
  record.areas = contact->areas();
  const std::vector<double> positions = contact->positions(simulation.now().displacement);
  const std::vector<std::size_t> points = merge_places(contact->slaves(), record);
  for (std::size_t k = 0; k < record.areas.size(); ++k) {
    const double area = record.areas[k];
    if (record.fields.closed[k]) {
      closed += area;
      record.penetration = std::max(record.penetration, std::abs(record.fields.gap[k]));
    }
    if (!std::isnan(record.fields.gap[k])) gap += area * record.fields.gap[k], gap_area += area;
    record.peak_pressure = std::max(record.peak_pressure, record.fields.pressure[k]);
    const auto position = positions.begin() + static_cast<std::ptrdiff_t>(points[k]) * scene.dimension;
    record.positions.insert(record.positions.end(), position, position + scene.dimension);
    const auto place = contact->slaves().place(points[k], simulation.mesh());
    record.places.insert(record.places.end(), place.begin(), place.begin() + scene.dimension);
  }
  record.resultants = resultants_of(*contact, record, scene.dimension);
  record.contact_fraction = closed / simulation.contact_area();
  if (const RemovedWaves* waves =
          simulation.removed_waves()) { // nodes are closed that are in contact in part
    double area = 0;
    const auto d = static_cast<std::size_t>(scene.dimension);
    for (std::size_t k = 0; k < record.areas.size(); ++k)
      area += record.areas[k] *
              waves->share(record.places[k * d], record.places[k * d + 1], record.fields.pressure[k]);
    record.contact_fraction = record.area.fraction = area / simulation.contact_area();
  } else {
    record.area = estimate_area(simulation, record.fields);
  }
  record.mean_gap = gap / gap_area;
  record.mean_cubed_gap = gap_means(record.fields.gap, record.areas).cubed;
  record.worn_slave = contact->worn_slave() * scene.symmetry_copies;
  record.worn_master = contact->worn_master() * scene.symmetry_copies;
  for (const double depth : record.fields.worn) record.worn_depth = std::max(record.worn_depth, depth);
  record.motion = simulation.now().motion;
  const SurfaceState state = surface_state(simulation, record);
  const ExactLayer* layer = simulation.exact_layer();
  if (layer == nullptr) {
    record.exact = compare_with_exact(scene, state);
    return;
  }
  LayerAnswer answer = layer->compare(layer->truth(record.motion), state);
  if (simulation.removed_waves() != nullptr) // nodes are not what counts
    for (Quantity& q : answer.quantities)
      if (q.name == "contact fraction") q = exact_quantity(q.name, q.unit, record.contact_fraction, q.exact);
  record.exact = std::move(answer.quantities), record.exact_pressure = std::move(answer.pressure);
}

void add_exact_conductance(const Scene& scene, StepRecord& record) {
  if (scene.exact.type != ExactSpec::Type::westergaard) return;
  const double wave = scene.exact.wavelength, height = scene.exact.amplitude;
  const double part = record.mean_pressure / westergaard_full_contact(height, wave, contact_modulus(scene));
  if (!(part < 1)) return;
  record.exact.push_back(
      exact_quantity("h_c lambda / k_s", "", record.conductance * wave, westergaard_conductance(part)));
  record.exact.push_back(exact_quantity("<g^3> / amplitude^3", "",
                                        record.mean_cubed_gap / (height * height * height),
                                        westergaard_cubed_gap(part)));
}

} // namespace host
