// SPDX-License-Identifier: BSD-3-Clause
// Contact: what it is made of, and the order in which an increment takes it.
#include "contact.hpp"

#include <map>
#include <numeric>

namespace host {
namespace {

/// A stiffness of the model's contact law; 1 where the law has none.
double stiffness_of(const Json& model, const char* law) {
  const Json found = find_json(model, ("/contact/" + std::string(law) + "/stiffness").c_str());
  return found.is_number() ? found.get<double>() : 1;
}

} // namespace

Contact::Contact(Master master, const ContactSpec& spec, const Mesh& mesh, const DofMap& dofs,
                 SlavePoints points, CutSpec cut, double thickness)
    : sides_(std::move(master), mesh, dofs, std::move(points), std::move(cut),
             find_json(spec.model, "/contact/wear/sliding")),
      values_(sides_, spec, sides_.d == 2 && thickness == 0 && sides_.slides()), search_(sides_, spec),
      states_(sides_), wear_(sides_, spec.wear_factor, thickness), tangent_(sides_),
      normal_stiffness_(stiffness_of(spec.model, "normal")),
      tangential_stiffness_(stiffness_of(spec.model, "friction")) {
  const Json normal = find_json(spec.model, "/contact/normal/type");
  for (const char* law : {"dugdale", "separation", "lennard_jones", "cohesive"})
    pulls_ = pulls_ || normal == law;
  // Detection takes a rigid segment without a normal for one that no slave projects on; those of bodies have
  // elements behind them.
  std::vector<double> nodes(sides_.m * sides_.d);
  const std::vector<double> centre(sides_.parameters, sides_.master.triangles ? 1. / 3 : 0.);
  for (std::size_t s = 0; sides_.master.rigid && s < sides_.master.segments(); ++s) {
    sides_.gather(stride(s), nodes);
    sample_surface(*sides_.master.model, nodes, std::vector<double>(sides_.m * sides_.parameters), centre);
  }
  reset_points();
}

void Contact::reset_points() {
  tangent_.reset();
  states_.reset();
  at_ = states_.begun;
  changes_.found = at_.segment;
}

double Contact::total_area() const { return std::accumulate(areas().begin(), areas().end(), 0.0); }

double Contact::multiplier_scale(std::size_t index) const {
  return index % multipliers() == 0 ? normal_stiffness_ : tangential_stiffness_;
}

ents_input Contact::input(const ents_master_mesh& where) const {
  auto in = ents_struct<ents_input>();
  in.slave = sides_.slave_now.data(), in.slave_stride = stride(sides_.d);
  in.mesh = &where;
  in.segment = at_.segment.data(), in.segment_stride = 1;
  in.start = at_.xi.data(), in.start_stride = stride(sides_.parameters);
  in.area = areas().data(), in.area_stride = 1;
  in.time_increment = time_increment_;
  if (sides_.state_size > 0)
    in.state_begin = states_.in.data(), in.state_begin_stride = stride(sides_.state_size);
  if (multipliers() > 0)
    in.multiplier = sides_.multiplier_now.data(), in.multiplier_stride = stride(multipliers());
  if (!values_.empty()) in.slave_values = values_.data(), in.slave_values_stride = stride(values_.each());
  return in;
}

void Contact::begin_increment(const Configuration& begin) {
  sides_.begin_increment(begin, has_history() || search_.one_surface());
  search_.begin_increment(begin);
  states_.begin_increment();
  wear_.begin_increment(accepted().pressure, values_);
  changes_.begin_increment(accepted().pressure);
  at_ = states_.begun;
  auto report = ents_struct<ents_report>();
  states_.move(at_, time_increment_, report); // what could not be moved is reported by the next search
}

bool Contact::choose(const Configuration& at, bool only_lost, ents_report& report) {
  const std::vector<std::int64_t> before = at_.segment;
  report.status = ENTS_OK;
  sides_.place(at);
  search_.find(at, changes_.closed, only_lost, states_.begun, accepted().pressure, at_);
  if (at_.segment != before) states_.move(at_, time_increment_, report);
  return !tangent_.is_for(at_.segment);
}

void Contact::read_profile() {
  if (!sides_.master.profile) return;
  const std::size_t size = sides_.parameters;
  std::map<std::int64_t, std::vector<std::size_t>> points; // of each segment
  for (std::size_t k = 0; k < slaves().size(); ++k) {
    if (at_.segment[k] < 0)
      throw JobError("\"enrichment\": \"gap_only\": the slave point near node " +
                     std::to_string(slaves().nodes[k * slaves().nodes_per_point]) +
                     " is over no segment of the master at the beginning; let the master reach farther");
    points[at_.segment[k]].push_back(k);
  }
  for (const auto& [segment, found] : points) {
    std::vector<double> xi;
    for (const std::size_t k : found)
      xi.insert(xi.end(), at_.xi.data() + k * size, at_.xi.data() + (k + 1) * size);
    const SurfaceSample sample = sides_.sample(*sides_.master.profile, segment, xi);
    for (std::size_t i = 0; i < found.size(); ++i) values_.offset(found[i]) = -sample.height[i];
  }
}

bool Contact::cut_again(const Configuration& begin, bool again) {
  if (!cuts_again() || !sides_.cut_points_at(begin, again)) return false;
  reset_points();
  begin_increment(begin);
  auto report = ents_struct<ents_report>();
  choose(begin, false, report);
  states_.accepted = fields(begin);
  states_.begin = states_.in; // those of elements without history
  states_.begun = at_;
  begin_increment(begin);
  tangent_.forget();
  return true;
}

double Contact::augment(const Configuration& at, double enough) {
  return states_.augment(fields(at), normal_stiffness_, tangential_stiffness_, enough);
}

void Contact::accept(const Configuration& at) {
  states_.accept(at_, fields(at));
  wear_.read_depths(states_);
  wear_.open_gaps(states_);
  const ents_master_mesh where = sides_.mesh();
  wear_.collect(input(where), states_);
  begin_increment(at);
}

} // namespace host
