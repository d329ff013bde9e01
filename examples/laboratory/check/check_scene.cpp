// SPDX-License-Identifier: BSD-3-Clause
#include "check_scene.hpp"

#include "simulation.hpp"

namespace host {
namespace {

CheckSubject model_subject(const EntsLibrary& library, const CheckOptions& options, const Json& text) {
  CheckSubject subject;
  subject.text = text, subject.folder = options.model.parent_path();
  subject.model = std::make_unique<EntsModel>(library, options.model);
  if (text.contains("patch"))
    throw InputError(options.model.string() +
                     ": /patch: the segments are those of --mesh here; leave the key out");
  if (!options.variant.empty())
    throw InputError(options.model.string() + ": --variant: this is a model; only a scene has variants");
  subject.surface =
      read_surface(options.mesh, text.at("segment").get<std::string>(), subject.model->layout());
  return subject;
}

/// The segments of a scene's master in the reference configuration.
MasterSurface surface_of(const Simulation& simulation, const ents_layout& layout) {
  const Master& master = simulation.contact()->master();
  MasterSurface surface;
  surface.d = static_cast<std::size_t>(layout.dimension);
  surface.m = static_cast<std::size_t>(layout.nodes);
  surface.nodes = master.rigid ? master.positions : simulation.mesh().coordinates;
  if (master.net) surface.nodes = master.net->positions(surface.nodes);
  surface.connectivity = master.connectivity;
  surface.surface_coordinates = master.surface_coordinates;
  return surface;
}

CheckSubject scene_subject(const EntsLibrary& library, const CheckOptions& options) {
  if (!options.mesh.empty())
    throw InputError(options.model.string() +
                     ": --mesh: this is a scene, which says where the segments are; leave the option out");
  Scene scene = read_scene(options.model, options.variant);
  if (!scene.contact) throw InputError(options.model.string() + ": /contact: there is nothing to check");
  const CutOff cut_off = scene.contact->cut_off;
  if (cut_off.wavelength > 0) { // its law takes long, and does not matter here
    scene.contact->cut_off = {};
    scene.contact->model["contact"]["normal"] = {{"type", "penalty"}, {"stiffness", 1}};
  }
  scene.exact = {};
  const Simulation simulation(scene, &library);
  ContactSpec& contact = *scene.contact;
  if (cut_off.wavelength > 0) contact.model.erase("contact"), contact.cut_off = cut_off;
  CheckSubject subject;
  subject.text = contact.model, subject.folder = scene.file.parent_path();
  subject.model =
      std::make_unique<EntsModel>(library, contact.model.dump(), subject.folder, contact.model_where);
  subject.surface = surface_of(simulation, subject.model->layout());
  subject.resolution = resolution_of(scene, simulation.mesh());
  subject.length_unit = scene.units.length;
  return subject;
}

} // namespace

CheckSubject read_subject(const EntsLibrary& library, const CheckOptions& options) {
  const Json text = parse_json_file(options.model);
  return text.contains("parts") ? scene_subject(library, options) : model_subject(library, options, text);
}

} // namespace host
