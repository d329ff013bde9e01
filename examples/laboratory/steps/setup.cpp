// SPDX-License-Identifier: BSD-3-Clause
// Simulation: from the scene to mesh, equations and pattern.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "areas.hpp"
#include "both_sides.hpp"
#include "half_space.hpp"
#include "indefinite_solver.hpp"
#include "layer_body.hpp"
#include "mesh_size.hpp"
#include "simulation.hpp"
#include "stopwatch.hpp"

namespace host {
namespace {

const std::vector<int>& find_nodes(const Mesh& mesh, const std::string& name, const std::string& where) {
  return named(mesh.node_sets, name, where, "nodes");
}

const std::vector<Face>& find_faces(const Mesh& mesh, const std::string& name, const std::string& where) {
  return named(mesh.face_sets, name, where, "faces");
}

/// Pairs of nodes on opposite sides: equal coordinates but for one axis.
std::vector<std::pair<int, int>> opposite_nodes(const Mesh& mesh, const PeriodicSpec& spec) {
  const std::vector<int>& first = find_nodes(mesh, spec.first, spec.where);
  const std::vector<int>& second = find_nodes(mesh, spec.second, spec.where);
  const auto d = static_cast<std::size_t>(mesh.dimension);
  const auto offset = [&](int a, int b, std::size_t i) { return mesh.node(b)[i] - mesh.node(a)[i]; };
  if (first.size() != second.size())
    throw InputError(spec.where + ": the sides have " + std::to_string(first.size()) + " and " +
                     std::to_string(second.size()) + " nodes; periodic sides have the same mesh");
  // The axis across is the one along which the two centres differ most.
  std::array<double, 3> apart{};
  for (std::size_t n = 0; n < first.size(); ++n)
    for (std::size_t i = 0; i < d; ++i) apart[i] += offset(first[n], second[n], i);
  std::size_t across = 0;
  for (std::size_t i = 1; i < d; ++i)
    if (std::abs(apart[i]) > std::abs(apart[across])) across = i;
  const double tolerance = 1e-9 * std::abs(apart[across]) / static_cast<double>(first.size());
  std::map<std::array<long long, 3>, int> by_place;
  const auto place = [&](int node, int shift, std::size_t axis) {
    std::array<long long, 3> key{};
    for (std::size_t i = 0; i < d; ++i)
      if (i != across) key[i] = std::llround(mesh.node(node)[i] / (4 * tolerance)) + (i == axis ? shift : 0);
    return key;
  };
  for (const int node : first) by_place[place(node, 0, across)] = node;
  std::vector<std::pair<int, int>> pairs;
  for (const int node : second) {
    auto found = by_place.find(place(node, 0, across));
    for (std::size_t axis = 0; axis < d && found == by_place.end(); ++axis) // rounding fell to the other side
      for (const int shift : {-1, 1})
        if (found == by_place.end()) found = by_place.find(place(node, shift, axis));
    if (found == by_place.end())
      throw InputError(spec.where + ": a node of " + spec.second + " has no partner on " + spec.first);
    pairs.emplace_back(node, found->second);
  }
  return pairs;
}

/// Pairs of nodes of two sides that lie in the same places.
std::vector<std::pair<int, int>> glued_nodes(const Mesh& mesh, const PeriodicSpec& spec) {
  const std::vector<int>& first = find_nodes(mesh, spec.first, spec.where);
  const std::vector<int>& second = find_nodes(mesh, spec.second, spec.where);
  const auto d = static_cast<std::size_t>(mesh.dimension);
  double size = 0;
  for (const int node : first)
    for (std::size_t i = 0; i < d; ++i)
      size = std::max(size, std::abs(mesh.node(node)[i] - mesh.node(first.front())[i]));
  const double tolerance = 1e-9 * size;
  std::vector<std::pair<double, int>> sorted; // along x
  for (const int node : first) sorted.emplace_back(mesh.node(node)[0], node);
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::pair<int, int>> pairs;
  for (const int node : second) {
    auto at = std::lower_bound(sorted.begin(), sorted.end(), std::pair{mesh.node(node)[0] - tolerance, 0});
    const auto differs = [&](int other) {
      double largest = 0;
      for (std::size_t i = 0; i < d; ++i)
        largest = std::max(largest, std::abs(mesh.node(node)[i] - mesh.node(other)[i]));
      return largest > tolerance;
    };
    while (at != sorted.end() && at->first <= mesh.node(node)[0] + tolerance && differs(at->second)) ++at;
    if (first.size() != second.size() || at == sorted.end() || differs(at->second))
      throw InputError(spec.where + ": sides that are tied have the same nodes, and " + spec.second +
                       " has others than " + spec.first);
    pairs.emplace_back(node, at->second);
  }
  return pairs;
}

/// Of the nodes along the edges of these faces.
double mean_spacing(const Mesh& mesh, const std::vector<Face>& faces) {
  double sum = 0;
  int edges = 0;
  for (const Face& face : faces)
    for (int a = 0; a < (mesh.dimension == 2 ? 1 : face.count); ++a, ++edges) {
      const auto corner = [&](int i) {
        return mesh.node(face.nodes[static_cast<std::size_t>(i % face.count)]);
      };
      double squared = 0;
      for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.dimension); ++i)
        squared += std::pow(corner(a + 1)[i] - corner(a)[i], 2);
      sum += std::sqrt(squared);
    }
  return sum / edges;
}

/// Adds a value per area of these faces to the dofs of their nodes.
void add_by_area(const Mesh& mesh, const Scene& scene, const std::string& name, const std::string& where,
                 const std::vector<double>& value, std::vector<double>& sum) {
  const auto d = static_cast<std::size_t>(mesh.dimension);
  const std::vector<Face>& faces = find_faces(mesh, name, where + "/faces");
  const std::vector<int> nodes = nodes_of(faces);
  const ElementSetup& setup = scene.parts.front().setup;
  const auto areas =
      tributary_areas(mesh, faces, nodes, setup.thickness, setup.formulation == Formulation::axisymmetric);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (std::size_t i = 0; i < d; ++i)
      sum[static_cast<std::size_t>(nodes[n]) * d + i] += areas[n] * value[i];
}

/// Of the displacements along a layer, which are zero.
const Path layer_path;

} // namespace

Simulation::Simulation(const Scene& scene, const EntsLibrary* library, int divisions,
                       const MasterMaker& maker)
    : scene_(&scene) {
  const Stopwatch watch;
  build_mesh();
  build_equations();
  build_contact(library, divisions, maker);
  // Multipliers make a symmetric system indefinite: nothing for Cholesky.
  const bool symmetric = !contact_ || (contact_->symmetric_tangent() && contact_->multipliers() == 0);
  system_ = std::make_unique<SparseSystem>(equations(), symmetric);
  if (layer_ && !contact_->symmetric_tangent())
    throw InputError(
        scene_->contact->model_where +
        ": with \"element\": \"layer\" the tangent has to be symmetric; project along the normal, or take "
        "the element hex8");
  if (layer_ && contact_->multipliers() > 0 && !contact_->slaves().are_nodes())
    throw InputError(
        scene_->contact->model_where +
        ": with \"element\": \"layer\" multipliers are those of nodes; leave \"sampling\" out, or take "
        "the normal law penalty or augmented");
  solver_ =
      layer_ ? std::make_unique<LayerSolver>(layer_) : LinearSolver::create(symmetric, indefinite_solver());
  bulk_stencils_ = stencils(mesh_, *dofs_);
  now_.displacement.assign(static_cast<std::size_t>(dofs_->dofs()), 0.0);
  if (contact_) {
    now_.multiplier.assign(contact_->multiplier_count(), 0.0);
    now_.parameters = contact_->master().model->defaults();
    contact_->begin_increment(now_);
    auto report = ents_struct<ents_report>();
    contact_->choose(now_, false, report);
    contact_->read_profile();
    first_touch_ = find_first_touch();
  }
  build_pattern();
  timings_.setup += watch.seconds();
  timings_.total += watch.seconds();
}

double Simulation::find_first_touch() {
  if (!contact_->master().translates()) return 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (const double gap : contact_->fields(now_).gap)
    if (gap < smallest) smallest = gap;
  return std::isfinite(smallest) ? smallest : 0;
}

void Simulation::build_mesh() {
  check_mesh_size(*scene_);
  mesh_.dimension = scene_->dimension;
  std::vector<ElementSetup> setups;
  for (const PartSpec& part : scene_->parts) {
    const int index = static_cast<int>(setups.size());
    if (part.layer)
      add_layer(mesh_, part.name, part.lines);
    else
      add_part(mesh_, part, index);
    if (part.crown.radius > 0) round_block(mesh_, part.lines, part.crown);
    setups.push_back(part.setup);
  }
  if (scene_->contact && scene_->contact->body) // displacement and turns of the body
    for (int node = 0; node < 2; ++node)
      mesh_.coordinates.insert(mesh_.coordinates.end(), scene_->contact->body->reference.begin(),
                               scene_->contact->body->reference.begin() + mesh_.dimension);
  bulk_ = std::make_unique<Bulk>(mesh_, setups);
  if (scene_->parts.front().layer)
    layer_ = std::make_shared<LayerBody>(scene_->parts.front().lines, setups.front().material);
}

void Simulation::build_equations() {
  dofs_ = std::make_unique<DofMap>(mesh_.node_count(), mesh_.dimension);
  const auto d = static_cast<std::size_t>(mesh_.dimension);
  const std::size_t total = static_cast<std::size_t>(mesh_.node_count()) * d;
  for (const PeriodicSpec& spec : scene_->periodic)
    for (const auto& [node, owner] : opposite_nodes(mesh_, spec)) dofs_->tie(node, owner);
  for (const PeriodicSpec& spec : scene_->tied)
    for (const auto& [node, owner] : glued_nodes(mesh_, spec)) dofs_->tie(node, owner);
  for (const SupportSpec& support : scene_->supports)
    for (const int node : find_nodes(mesh_, support.nodes, support.where + "/nodes"))
      for (std::size_t i = 0; i < d; ++i)
        if (support.displacement[i]) {
          dofs_->prescribe(node, static_cast<int>(i));
          prescribed_.push_back({static_cast<std::size_t>(node) * d + i, *support.displacement[i],
                                 &support.path, support.turn.empty() ? nullptr : &support});
        }
  if (scene_->half_space) {
    half_space_.assign(total, 0.0);
    std::array<double, 3> direction{}, position{};
    std::copy(scene_->contact->direction.begin(), scene_->contact->direction.end(), direction.begin());
    for (const std::string& name : scene_->half_space->nodes)
      for (const int node : find_nodes(mesh_, name, scene_->half_space->where + "/nodes")) {
        for (std::size_t i = 0; i < 3; ++i) position[i] = mesh_.node(node)[i] - scene_->half_space->point[i];
        const auto displacement = boussinesq(scene_->half_space->material, position, direction);
        for (std::size_t i = 0; i < 3; ++i) {
          dofs_->prescribe(node, static_cast<int>(i));
          half_space_[static_cast<std::size_t>(node) * d + i] = displacement[i];
        }
      }
  }
  for (const Traction& traction : scene_->tractions) {
    loads_.push_back({std::vector<double>(total, 0.0), &traction.path});
    add_by_area(mesh_, *scene_, traction.faces, traction.where, traction.value, loads_.back().force);
  }
  for (const SpringSpec& spring : scene_->springs) {
    springs_.resize(total, 0.0);
    add_by_area(mesh_, *scene_, spring.faces, spring.where, spring.stiffness, springs_);
  }
  if (scene_->contact && scene_->contact->body) {
    const RigidBodySpec& body = *scene_->contact->body;
    const int first = mesh_.node_count() - 2;
    const auto dof = [&](const BodyComponent& c) {
      return static_cast<std::size_t>(first) * d + static_cast<std::size_t>(c.component);
    };
    for (const BodyComponent& c : body.prescribed) {
      dofs_->prescribe(first + c.component / mesh_.dimension, c.component % mesh_.dimension);
      prescribed_.push_back({dof(c), c.value, &c.path, nullptr});
    }
    for (const BodyComponent& c : body.loads) {
      loads_.push_back({std::vector<double>(total, 0.0), &c.path});
      loads_.back().force[dof(c)] = c.value;
    }
    for (const BodyComponent& c : body.springs) {
      springs_.resize(total, 0.0);
      springs_[dof(c)] += c.value;
    }
  }
  for (int node = 0; layer_ && node < mesh_.node_count(); ++node)
    for (const int c : {0, 1}) {
      dofs_->prescribe(node, c);
      prescribed_.push_back(
          {static_cast<std::size_t>(node) * d + static_cast<std::size_t>(c), 0, &layer_path, nullptr});
    }
  if (prescribed_.empty() && half_space_.empty() && springs_.empty())
    throw InputError(scene_->file.string() +
                     ": /supports: nothing holds the bodies, which can move as they like; "
                     "give supports, springs or a half_space");
  dofs_->number();
  if (dofs_->size() == 0) throw InputError(scene_->file.string() + ": /supports leave nothing to solve for");
}

void Simulation::build_contact(const EntsLibrary* library, int divisions, const MasterMaker& maker) {
  if (!scene_->contact) {
    if (divisions > 0)
      throw InputError(scene_->file.string() + ": a scene without contact has no explicit mesh");
    return;
  }
  if (library == nullptr) throw JobError(scene_->file.string() + ": contact needs the library");
  find_faces(mesh_, scene_->contact->slave, scene_->contact->slave_where);
  const std::vector<Face> slaves = slave_faces(mesh_, *scene_->contact);
  exact_axis_ = host::exact_axis(*scene_, *library);
  resolution_ = resolution_of(*scene_, mesh_);
  if (scene_->exact.type == ExactSpec::Type::boundary_elements && divisions == 0 && !maker)
    exact_layer_ = std::make_shared<ExactLayer>(*scene_, *library, mesh_, *dofs_);
  Scene changed; // with the law that follows from the waves that the height leaves out, or from the mesh
  if (scene_->contact->cut_off.wavelength > 0) {
    if (maker || divisions > 0)
      throw InputError(scene_->contact->cut_off.where + ": is for the height itself, no other master");
    removed_waves_ = std::make_shared<RemovedWaves>(*scene_, *library);
    changed = *scene_, changed.contact = removed_waves_->contact();
  }
  if (scene_->contact->hard) {
    changed = *scene_;
    changed.contact->model["contact"]["normal"]["stiffness"] =
        contact_modulus(*scene_) / mean_spacing(mesh_, slaves);
  }
  const Scene& of_master = removed_waves_ || scene_->contact->hard ? changed : *scene_;
  Master master = maker           ? maker(*library, of_master)
                  : divisions > 0 ? explicit_master(*library, of_master, divisions)
                                  : scene_master(*library, of_master, mesh_);
  const ElementSetup& setup = scene_->parts.front().setup;
  const SlaveGeometry geometry{setup.thickness, setup.formulation == Formulation::axisymmetric,
                               scene_->contact->equal_areas};
  const ContactSpec& contact = *of_master.contact;
  SlavePoints points;
  CutSpec cut{slaves, geometry, contact.cut, {}};
  if (!contact.slave_height.is_null())
    cut.surface = std::make_shared<SlaveSurface>(*library, contact, scene_->file.parent_path(), mesh_);
  if (contact.sampling > 0) {
    points = sampling_points(*library, mesh_, slaves, contact.sampling, geometry, contact.slave_where);
    if (cut.surface) cut.surface->raise(points);
  } else if (contact.cut == 0)
    points = slave_nodes(mesh_, *dofs_, slaves, geometry);
  if (removed_waves_) points = removed_waves_->points(std::move(points), mesh_);
  contact_ = std::make_unique<Contact>(std::move(master), contact, mesh_, *dofs_, std::move(points),
                                       std::move(cut), geometry.axisymmetric ? 0 : geometry.thickness);
}

void Simulation::build_pattern() {
  std::vector<const StencilGroup*> groups;
  for (const StencilGroup& group : bulk_stencils_) groups.push_back(&group);
  // In the order in which `evaluate` counts them: bulk, springs.
  StencilGroup springs;
  MatrixPart contact;
  if (!springs_.empty()) {
    springs.dofs = 1;
    for (std::size_t dof = 0; dof < springs_.size(); ++dof) springs.equations.push_back(dofs_->equation(dof));
    groups.push_back(&springs);
  }
  if (contact_) {
    contact_->build_tangent();
    contact.matrix = &contact_->tangent().matrix();
    for (const std::size_t unknown : contact_->tangent().unknowns().dofs)
      contact.equations.push_back(equation(unknown));
  }
  system_->build(groups, contact);
  solver_->analyze(system_->matrix());
  bulk_values_.clear();
  factors_fit_ = false;
  factored_.reset();
}

Sizes Simulation::sizes() const {
  Sizes sizes;
  sizes.nodes = static_cast<std::size_t>(mesh_.node_count());
  for (const ElementGroup& group : mesh_.groups) sizes.elements += group.size();
  sizes.dofs = static_cast<std::size_t>(dofs_->dofs());
  sizes.equations = static_cast<std::size_t>(equations());
  if (contact_) {
    const Master& master = contact_->master();
    sizes.slaves = contact_->slaves().size();
    sizes.master_segments = master.segments();
    sizes.master_dofs =
        (master.net ? master.net->nodes_of_mesh()
                    : std::set<std::int64_t>(master.connectivity.begin(), master.connectivity.end()))
            .size() *
        static_cast<std::size_t>(mesh_.dimension);
  }
  return sizes;
}

} // namespace host
