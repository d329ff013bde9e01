// SPDX-License-Identifier: BSD-3-Clause
#include "resolution.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "exact.hpp"
#include "map_file.hpp"
#include "mesh.hpp"
#include "output/table.hpp"
#include "scene.hpp"
#include "smoothing.hpp"

namespace host {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Points of the slave surface and elements of its body that the shortest wave has to have.
constexpr double points_in_wave = 2, elements_in_wave = 8, points_in_tension = 4;

double length_of(const Json& vector) {
  double squared = 0;
  for (const Json& component : vector) squared += std::pow(component.get<double>(), 2);
  return std::sqrt(squared);
}

/// NaN if one of them is.
double shorter(double a, double b) { return std::isnan(a) || std::isnan(b) ? unknown : std::min(a, b); }

double map_wave(const Json& map, const std::filesystem::path& folder, std::size_t directions) {
  const MapSize size = map_size(map, folder, directions);
  if (size.lengths.empty() || size.samples.empty()) return unknown;
  double wave = infinity;
  for (std::size_t i = 0; i < directions; ++i) {
    const double intervals = map.value("boundary", "") == "clamped" ? size.samples[i] - 1 : size.samples[i];
    wave = std::min(wave, 2 * size.lengths[i] / intervals);
  }
  return wave;
}

double weierstrass_wave(const Json& height) {
  return 1 / (length_of(height.at("wave_vector")) *
              std::pow(height.value("ratio", 1.5), height.at("terms").get<double>() - 1));
}

/// Of the nodes at the corners of a plain segment: along its edges, the smallest length for one unit of s.
double length_per_coordinate(const ContactSpec& contact, std::size_t d) {
  const std::string segment = contact.model.value("segment", "");
  if (contact.rigid.empty() || is_smoothed(segment)) return unknown;
  const std::size_t corners = d == 2 ? 2 : segment.starts_with("tri") ? 3 : 4;
  const Json own = find_json(contact.model, "/surface_coordinates");
  double least = infinity;
  for (std::size_t a = 0; a < (d == 2 ? 1 : corners); ++a) {
    const std::size_t b = (a + 1) % corners;
    double length = 0, along = 0;
    for (std::size_t i = 0; i < d; ++i)
      length += std::pow(contact.rigid.at(b * d + i) - contact.rigid.at(a * d + i), 2);
    for (std::size_t i = 0; own.is_array() && i + 1 < d; ++i)
      along += std::pow(own.at(b).at(i).get<double>() - own.at(a).at(i).get<double>(), 2);
    const double natural = corners == 3 ? 1 : 2; // s = xi
    if (along = own.is_array() ? std::sqrt(along) : natural; along > 0)
      least = std::min(least, std::sqrt(length) / along);
  }
  return std::isfinite(least) ? least : unknown;
}

double distance(const Mesh& mesh, int a, int b) {
  double squared = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.dimension); ++i)
    squared += std::pow(mesh.node(b)[i] - mesh.node(a)[i], 2);
  return std::sqrt(squared);
}

/// Along the edges of a face.
double longest_edge(const Mesh& mesh, const Face& face) {
  double longest = 0;
  for (int a = 0; a < (face.count == 2 ? 1 : face.count); ++a)
    longest = std::max(longest, distance(mesh, face.nodes[static_cast<std::size_t>(a)],
                                         face.nodes[static_cast<std::size_t>((a + 1) % face.count)]));
  return longest;
}

/// How far the other nodes of the elements at these faces lie from the faces, at most.
double largest_depth(const Mesh& mesh, const std::vector<Face>& faces) {
  if (mesh.groups.empty()) return 0;
  std::map<std::set<int>, double> depth; // by the nodes of the face
  std::set<int> on_surface;
  for (const Face& face : faces) {
    depth[{face.nodes.begin(), face.nodes.begin() + face.count}] = 0;
    on_surface.insert(face.nodes.begin(), face.nodes.begin() + face.count);
  }
  double largest = 0;
  for (const ElementGroup& group : mesh.groups)
    for (std::size_t e = 0; e < group.size(); ++e) {
      std::set<int> of_face;
      for (const int node : group.element(e))
        if (on_surface.contains(node)) of_face.insert(node);
      if (!depth.contains(of_face)) continue;
      for (const int node :
           group.element(e)) { // each inner node is as deep as it is far from its nearest one
        double nearest = of_face.contains(node) ? 0 : infinity;
        for (const int other : of_face) nearest = std::min(nearest, distance(mesh, node, other));
        largest = std::max(largest, nearest);
      }
    }
  return largest;
}

} // namespace

double shortest_wave(const Json& height, const std::filesystem::path& folder, std::size_t directions) {
  if (height.is_null()) return infinity;
  const std::string type = height.at("type").get<std::string>();
  double wave = unknown;
  if (type == "constant" || type == "polynomial") return infinity;
  if (type == "sine") {
    const double number = length_of(height.at("wave_vector"));
    return number > 0 ? 1 / number : infinity;
  }
  if (type == "gaussian") return 2 * std::numbers::pi * height.at("width").get<double>(); // steepest slopes
  if (type == "scale" || type == "shift" || type == "window")
    return shortest_wave(height.at("of"), folder, directions);
  if (type == "sum" || type == "product") {
    double number = 0; // the waves of a product have the sums of the wave numbers
    wave = infinity;
    for (const Json& part : height.at("of")) {
      const double one = shortest_wave(part, folder, directions);
      wave = shorter(wave, one), number += 1 / one;
    }
    return type == "sum" || !(number > 0) ? wave : 1 / number;
  }
  if (type == "map") wave = map_wave(height, folder, directions);
  if (type == "roughness") wave = height.at("wavelengths").at(0).get<double>();
  if (type == "weierstrass") wave = weierstrass_wave(height);
  if (type == "fourier") {
    wave = infinity;
    for (const Json& vector : height.at("wave_vectors")) wave = std::min(wave, 1 / length_of(vector));
  }
  return height.contains("cut_off") ? std::max(wave, height.at("cut_off").get<double>()) : wave;
}

double Resolution::spacing_needed() const { return wave / points_in_wave; }
double Resolution::element_needed() const { return wave / elements_in_wave; }

double Resolution::tension_needed() const { return tension / points_in_tension; }

bool Resolution::too_coarse_for_tension() const { return spacing > tension_needed() * (1 + 1e-9); }

bool Resolution::too_coarse_for_waves() const {
  constexpr double rounding = 1 + 1e-9;
  return spacing > spacing_needed() * rounding ||
         (depth > 0 && std::max(spacing, depth) > element_needed() * rounding);
}
bool Resolution::too_coarse() const { return too_coarse_for_waves() || too_coarse_for_tension(); }

double tension_length(const Json& model, double modulus) {
  const Json law = find_json(model, "/contact/normal");
  if (!law.is_object() || !law.contains("work")) return infinity;
  Json work = law.at("work");
  if (work.is_string()) work = find_json(model, ("/parameters/" + work.get<std::string>()).c_str());
  if (!work.is_number()) return infinity;
  const double w = work.get<double>();
  const std::string type = law.value("type", "");
  const double strength = type == "dugdale" ? law.at("strength").get<double>()
                          : type == "separation"
                              ? w / (std::numbers::e * law.at("length").get<double>())
                              : 16 / (9 * std::sqrt(3.0)) * w / law.at("length").get<double>();
  return std::numbers::pi / 4 * modulus * w / (strength * strength);
}

Resolution resolution_of(const Scene& scene, const Mesh& mesh) {
  Resolution found;
  if (!scene.contact || !mesh.face_sets.contains(scene.contact->slave)) return found;
  const ContactSpec& contact = *scene.contact;
  const std::vector<Face>& faces = mesh.face_sets.at(contact.slave);
  for (const Face& face : faces) found.spacing = std::max(found.spacing, longest_edge(mesh, face));
  found.spacing /= std::max({1, contact.sampling, contact.cut});
  if (!contact.rigid.empty()) found.tension = tension_length(contact.model, contact_modulus(scene));
  const auto d = static_cast<std::size_t>(scene.dimension);
  const double scale = length_per_coordinate(contact, d);
  if (std::isnan(scale)) return found;
  double wave = shortest_wave(find_json(contact.model, "/height"), scene.file.parent_path(), d - 1);
  if (contact.cut_off.wavelength > 0) wave = std::max(wave, contact.cut_off.wavelength);
  found.wave = scale * wave;
  if (std::isfinite(found.wave)) found.depth = largest_depth(mesh, faces);
  return found;
}

std::string describe(const Resolution& found, const std::string& unit) {
  const auto length = [&](double value) {
    return format_number(value, 3) + (unit.empty() ? "" : " ") + unit;
  };
  std::string tension;
  if (std::isfinite(found.tension)) {
    tension = "the tension of the law acts over " + length(found.tension) + " beside the contact";
    if (found.too_coarse_for_tension())
      tension += ". The mesh is too coarse for it, slave points will jump one by one: take nodes at most " +
                 length(found.tension_needed()) +
                 " apart, a quarter of that, or a law of the same work with less strength";
  }
  if (!std::isfinite(found.wave)) return tension;
  if (!tension.empty()) tension = "; " + tension;
  std::string text = "the shortest wave of the height is " + length(found.wave) +
                     " long; slave nodes lie up to " + length(found.spacing) + " apart";
  if (found.depth > 0) text += ", the elements below them are up to " + length(found.depth) + " deep";
  if (!found.too_coarse_for_waves()) return text + ": fine enough" + tension;
  text += ". The mesh is too coarse for this surface: ";
  if (found.depth > 0)
    text += "elements have to be at most " + length(found.element_needed()) +
            " wide and deep, an eighth of that wave, or the element \"layer\" takes the place of the mesh, "
            "with nodes ";
  else
    text += "take nodes ";
  return text + "at most " + length(found.spacing_needed()) +
         " apart, half of that wave; or leave shorter waves out with the key cut_off" + tension;
}

Json json_of(const Resolution& found) {
  return {{"shortest_wave", std::isfinite(found.wave) ? Json(found.wave) : Json()},
          {"slave_spacing", found.spacing},
          {"element_depth", found.depth},
          {"tension_length", std::isfinite(found.tension) ? Json(found.tension) : Json()},
          {"too_coarse", found.too_coarse()}};
}

} // namespace host
