// SPDX-License-Identifier: BSD-3-Clause
#include "library.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>

#include <ents.hpp>

namespace ents_deck {
namespace {

using std::string;

/// What the library refuses, with what it was asked of.
template <class Ask> auto as_ours(const string& what, Ask ask) {
  try {
    return ask();
  } catch (const ents::Error& error) {
    throw Error(what + ": " + error.report.message);
  }
}

/// The contact's model for faces of a shape.
nlohmann::ordered_json text_for(const Contact& contact, Shape shape) {
  auto out = contact.model;
  out["segment"] = segment_name(shape);
  return out;
}

ents::Model model_of(const nlohmann::ordered_json& json) {
  return as_ours("the model", [&] { return ents::Model(json.dump()); });
}

/// The master surface as the library takes it.
struct Master {
  std::vector<int64_t> connectivity;
  std::vector<double> positions, coordinates;
  std::vector<int> faces; ///< [segments] of the contact's master
  std::unordered_map<int, int64_t> index;
  ents_master_mesh mesh = ents::make<ents_master_mesh>();

  /// The faces of one shape: a model has one.
  Master(const Mesh& deck, const Contact& contact, Shape shape, std::size_t d) {
    for (std::size_t f = 0; f < contact.master.faces.size(); ++f) {
      const Face& face = contact.master.faces[f];
      if (face.shape != shape) continue;
      faces.push_back(static_cast<int>(f));
      for (const int node : face.nodes) add(deck, node, d), connectivity.push_back(index.at(node));
      if (contact.face_coordinates.empty()) continue;
      coordinates.insert(coordinates.end(), contact.face_coordinates[f].begin(),
                         contact.face_coordinates[f].end());
    }
    mesh.segments = static_cast<int64_t>(faces.size());
    mesh.connectivity = connectivity.data();
    mesh.nodes = static_cast<int64_t>(index.size());
    mesh.positions = positions.data();
    mesh.surface_coordinates = coordinates.empty() ? nullptr : coordinates.data();
  }

private:
  void add(const Mesh& deck, int node, std::size_t d) {
    if (!index.emplace(node, static_cast<int64_t>(index.size())).second) return;
    const Point& x = deck.nodes[static_cast<std::size_t>(node)].x;
    positions.insert(positions.end(), x.begin(), x.begin() + static_cast<std::ptrdiff_t>(d));
  }
};

void judge(const ents_surface_admissibility& found, const std::vector<int>& faces, Admissibility& out) {
#define ENTS_DECK_CONDITION(name, value, text) {value, text},
  static const std::vector<std::pair<int, const char*>> conditions{ENTS_CONDITION_TABLE(ENTS_DECK_CONDITION)};
#undef ENTS_DECK_CONDITION
  for (const auto& [i, text] : conditions) {
    if ((found.violated >> i & 1) == 0) continue;
    char line[300];
    const bool somewhere = found.segment[i] >= 0;
    std::snprintf(line, sizeof line, "%s; it is %.3g, by %.3g too bad%s%s", text, found.value[i],
                  found.missing[i], somewhere ? ", on face " : "",
                  somewhere ? std::to_string(faces[static_cast<std::size_t>(found.segment[i])] + 1).c_str()
                            : "");
    out.violations.emplace_back(line);
  }
}

} // namespace

Model checked_model(nlohmann::ordered_json text, int number, int slave_nodes) {
  if (number > 9999)
    throw Error(
        "the faces meet in more than 9999 different ways, which is as many models as elements can name");
  const ents_layout layout = model_of(text).layout();
  Model out;
  out.number = number;
  out.text = std::move(text);
  out.slave_nodes = slave_nodes;
  out.master_nodes = layout.nodes;
  out.parameters = layout.parameters;
  out.state_size = layout.state_size;
  out.symmetric = layout.symmetric_tangent != 0;
  if (layout.multipliers)
    throw Error("the model's contact has multipliers as unknowns, for which every element needs a node of "
                "its own; take \"penalty\" or \"augmented\"");
  if (!out.text.contains("contact")) throw Error("the model has no \"contact\"");
  return out;
}

namespace {

/// Samples per direction and face: about this many in all, so that a large master takes seconds.
constexpr double wanted_samples = 3e4;

/// Jumps between faces that meet at an angle, and crossings there, are those of the mesh: they count from
/// this part of the height's range on.
constexpr double counting_jump = 1e-3;

void check(const Mesh& mesh, const Contact& contact, Shape shape, Admissibility& out) {
  const ents::Model model = model_of(text_for(contact, shape));
  const Master master(mesh, contact, shape, static_cast<std::size_t>(model.layout().dimension));
  auto surface = ents::make<ents_surface_admissibility>();
  const double per_face = wanted_samples / static_cast<double>(master.faces.size());
  surface.samples = static_cast<int32_t>(
      std::clamp(dimension_of(contact.master) == 2 ? per_face : std::sqrt(per_face), 3.0, 257.0));
  as_ours("the master '" + contact.pair.master + "'",
          [&] { ents::require(ents::linked(), ents_surface_check, model.get(), &master.mesh, &surface); });
  for (const int condition : {ENTS_CHECK_JUMP, ENTS_CHECK_CROSSING, ENTS_CHECK_EDGE})
    if (surface.missing[condition] <= counting_jump * (surface.height_max - surface.height_min))
      surface.violated &= ~(int64_t{1} << condition);
  judge(surface, master.faces, out);
  out.lowest = std::min(out.lowest, surface.height_min);
  out.highest = std::max(out.highest, surface.height_max);
}

/// Gaps of points on the face below them, from their projection on the face without height on: as the
/// elements begin.
void find(const Mesh& mesh, const Contact& contact, Shape shape, double touch, Findings& out) {
  auto text = text_for(contact, shape);
  text["border"] = 0.5;
  const ents::Model model = model_of(text);
  text["height"] = nullptr;
  const ents::Model plain = model_of(text);
  const auto d = static_cast<std::size_t>(model.layout().dimension);
  for (const Patch& patch : contact.patches.list) {
    const Face& face = contact.master.faces[static_cast<std::size_t>(patch.face)];
    if (face.shape != shape) continue;
    std::vector<double> master;
    for (const int node : face.nodes) {
      const Point& x = mesh.nodes[static_cast<std::size_t>(node)].x;
      master.insert(master.end(), x.begin(), x.begin() + static_cast<std::ptrdiff_t>(d));
    }
    double xi[2], gap = 0;
    auto input = ents::make<ents_input>();
    input.slave = contact.points[static_cast<std::size_t>(patch.slave)].x.data();
    input.master = master.data();
    auto output = ents::make<ents_output>();
    output.wanted = ENTS_XI;
    output.xi = xi;
    if (ents_evaluate(plain.get(), 0, 1, &input, &output, nullptr) != ENTS_OK) continue;
    if (!contact.face_coordinates.empty())
      input.surface_coordinates = contact.face_coordinates[static_cast<std::size_t>(patch.face)].data();
    input.start = xi;
    output.wanted = ENTS_GAP;
    output.gap = &gap;
    if (ents_evaluate(model.get(), 0, 1, &input, &output, nullptr) != ENTS_OK) continue;
    ++out.near;
    if (std::abs(gap) <= touch)
      ++out.touching, out.widest_touch = std::max(out.widest_touch, gap);
    else if (gap < 0)
      ++out.penetrating, out.deepest = std::max(out.deepest, -gap);
    else
      out.nearest = std::min(out.nearest, gap);
  }
}

} // namespace

Findings findings_of(const Mesh& mesh, const Contact& contact, double touch) {
  Findings out;
  out.nearest = std::numeric_limits<double>::infinity();
  std::set<Shape> shapes;
  for (const Face& face : contact.master.faces) shapes.insert(face.shape);
  for (const Shape shape : shapes) find(mesh, contact, shape, touch, out);
  return out;
}

Admissibility admissibility_of(const Mesh& mesh, const Contact& contact) {
  Admissibility out;
  if (!has_height(contact)) return out;
  std::set<Shape> shapes;
  for (const Face& face : contact.master.faces) shapes.insert(face.shape);
  for (const Shape shape : shapes) check(mesh, contact, shape, out);
  return out;
}

bool has_height(const Contact& contact) {
  return contact.model.contains("height") && !contact.model["height"].is_null();
}

SampledSurface sampled(const Mesh& mesh, const Contact& contact, int n) {
  SampledSurface out;
  std::map<Shape, ents::Model> models;
  const auto d = static_cast<std::size_t>(dimension_of(contact.master));
  for (std::size_t f = 0; f < contact.master.faces.size(); ++f) {
    const Face& face = contact.master.faces[f];
    if (models.count(face.shape) == 0) models.emplace(face.shape, model_of(text_for(contact, face.shape)));
    const ents::Model& model = models.at(face.shape);
    std::vector<double> nodes, xi;
    for (const int node : face.nodes) {
      const Point& x = mesh.nodes[static_cast<std::size_t>(node)].x;
      nodes.insert(nodes.end(), x.begin(), x.begin() + static_cast<std::ptrdiff_t>(d));
    }
    const bool triangle = corner_count(face.shape) == 3;
    const auto at = [&](int i) { return triangle ? double(i) / n : 2.0 * i / n - 1; };
    const int first = static_cast<int>(out.points.size());
    std::vector<std::vector<int>> number(static_cast<std::size_t>(n + 1));
    int next = first;
    for (int j = 0; j <= (d == 2 ? 0 : n); ++j)
      for (int i = 0; i <= (triangle ? n - j : n); ++i) {
        xi.push_back(at(i));
        if (d == 3) xi.push_back(at(j));
        number[static_cast<std::size_t>(j)].push_back(next++);
      }
    const auto count = static_cast<std::size_t>(next - first);
    std::vector<double> points(count * d), heights(count);
    auto surface = ents::make<ents_surface>();
    surface.master = nodes.data();
    surface.surface_coordinates =
        contact.face_coordinates.empty() ? nullptr : contact.face_coordinates[f].data();
    surface.xi = xi.data();
    surface.point = points.data();
    surface.height = heights.data();
    if (ents_surface_evaluate(model.get(), static_cast<int64_t>(count), &surface, nullptr) != ENTS_OK)
      continue; // said by the check
    for (std::size_t i = 0; i < count; ++i) {
      Point p{};
      for (std::size_t k = 0; k < d; ++k) p[k] = points[i * d + k];
      out.points.push_back(p);
      out.heights.push_back(heights[i]);
    }
    if (d == 2)
      for (int i = 0; i < n; ++i) out.cells.push_back({first + i, first + i + 1});
    for (std::size_t j = 0; d == 3 && j < static_cast<std::size_t>(n); ++j)
      for (std::size_t i = 0; i + 1 < number[j].size(); ++i) {
        const bool right = i + 1 < number[j + 1].size();
        if (!triangle) {
          out.cells.push_back({number[j][i], number[j][i + 1], number[j + 1][i + 1], number[j + 1][i]});
        } else {
          out.cells.push_back({number[j][i], number[j][i + 1], number[j + 1][i]});
          if (right) out.cells.push_back({number[j][i + 1], number[j + 1][i + 1], number[j + 1][i]});
        }
      }
  }
  return out;
}

} // namespace ents_deck
