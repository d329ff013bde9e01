// SPDX-License-Identifier: BSD-3-Clause
// ents-host check: is this enrichment admissible on these segments? Conditions of theory, section 5.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include <Eigen/Geometry>

#include "commands.hpp"
#include "ents_library.hpp"
#include "inp.hpp"
#include "json_reader.hpp"
#include "output/pictures.hpp"
#include "output/table.hpp"
#include "result.hpp"

namespace host {
namespace {

/// The segments of a surface.
struct Segments {
  std::size_t d = 2, m = 2;
  std::vector<double> nodes;               ///< [nodes][d]
  std::vector<int> connectivity;           ///< [segments][m]
  std::vector<double> surface_coordinates; ///< [nodes][d-1] or empty

  std::size_t size() const { return connectivity.size() / m; }
  std::vector<double> gather(std::size_t segment, const std::vector<double>& values, std::size_t width) const {
    std::vector<double> result;
    for (std::size_t a = 0; a < m; ++a) {
      const auto node = static_cast<std::size_t>(connectivity[segment * m + a]);
      result.insert(result.end(), values.begin() + static_cast<std::ptrdiff_t>(node * width),
                    values.begin() + static_cast<std::ptrdiff_t>((node + 1) * width));
    }
    return result;
  }
};

/// One finding: a condition of the theory, its worst value, and where.
struct Finding {
  std::string condition, limit, remark;
  double value = 0;
  bool violated = false;
  std::size_t segment = 0;
  std::array<double, 2> xi{};
  std::vector<double> point; ///< on rho_e
};

/// Natural coordinates of the nodes: a segment of its own, flat and undistorted.
std::vector<double> natural_nodes(const std::string& segment) {
  static const std::map<std::string, std::vector<double>> nodes{
      {"line2", {-1, 1}},
      {"line3", {-1, 1, 0}},
      {"catmull_rom4", {-3, -1, 1, 3}},
      {"bspline4", {-3, -1, 1, 3}},
      {"tri3", {0, 0, 1, 0, 0, 1}},
      {"tri6", {0, 0, 1, 0, 0, 1, .5, 0, .5, .5, 0, .5}},
      {"quad4", {-1, -1, 1, -1, 1, 1, -1, 1}},
      {"quad8", {-1, -1, 1, -1, 1, 1, -1, 1, 0, -1, 1, 0, 0, 1, -1, 0}},
      {"quad9", {-1, -1, 1, -1, 1, 1, -1, 1, 0, -1, 1, 0, 0, 1, -1, 0, 0, 0}}};
  const auto found = nodes.find(segment);
  if (found != nodes.end()) return found->second;
  std::vector<double> patch; // 16-node patches: 4 j + i
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) patch.insert(patch.end(), {2. * i - 3, 2. * j - 3});
  return patch;
}

Segments one_segment(const std::string& name, const ents_layout& layout) {
  Segments segments;
  segments.d = static_cast<std::size_t>(layout.dimension);
  segments.m = static_cast<std::size_t>(layout.nodes);
  const std::vector<double> flat = natural_nodes(name);
  for (std::size_t a = 0; a < segments.m; ++a) {
    for (std::size_t i = 0; i + 1 < segments.d; ++i) segments.nodes.push_back(flat[a * (segments.d - 1) + i]);
    segments.nodes.push_back(0);
    segments.connectivity.push_back(static_cast<int>(a));
  }
  return segments;
}

Segments json_segments(const std::filesystem::path& file, const ents_layout& layout) {
  const Json json = parse_json_file(file);
  JsonObject object(JsonValue(json, file.string() + ": "));
  Segments segments;
  segments.d = static_cast<std::size_t>(layout.dimension);
  segments.m = static_cast<std::size_t>(layout.nodes);
  for (const JsonValue& item : object.at("nodes").items()) {
    const auto node = item.numbers(segments.d);
    segments.nodes.insert(segments.nodes.end(), node.begin(), node.end());
  }
  const int nodes = static_cast<int>(segments.nodes.size() / segments.d);
  for (const JsonValue& item : object.at("segments").items()) {
    const auto entries = item.items();
    if (entries.size() != segments.m)
      item.fail("the model's segment has " + std::to_string(segments.m) + " nodes, here are " +
                std::to_string(entries.size()));
    for (const JsonValue& entry : entries) segments.connectivity.push_back(entry.integer(0, nodes - 1));
  }
  if (object.has("surface_coordinates")) {
    const JsonValue value = object.at("surface_coordinates");
    for (const JsonValue& item : value.items()) {
      const auto s = item.numbers(segments.d - 1);
      segments.surface_coordinates.insert(segments.surface_coordinates.end(), s.begin(), s.end());
    }
    if (segments.surface_coordinates.size() != static_cast<std::size_t>(nodes) * (segments.d - 1))
      value.fail("one entry per node is expected");
  }
  object.finish();
  if (segments.connectivity.empty()) throw InputError(file.string() + ": there are no segments");
  return segments;
}

/// Elements of the deck that have as many nodes as a segment: lines in the plane, shells in space.
Segments deck_segments(const std::filesystem::path& file, const ents_layout& layout) {
  const inp::Deck deck = inp::read(file);
  Segments segments;
  segments.d = static_cast<std::size_t>(layout.dimension);
  segments.m = static_cast<std::size_t>(layout.nodes);
  for (const auto& x : deck.coordinates) segments.nodes.insert(segments.nodes.end(), x.begin(), x.begin() + layout.dimension);
  for (const inp::Element& element : deck.elements)
    if (inp::dimension(element.shape) == layout.dimension - 1 && inp::node_count(element.shape) == layout.nodes)
      segments.connectivity.insert(segments.connectivity.end(), element.nodes.begin(),
                                   element.nodes.begin() + layout.nodes);
  if (segments.connectivity.empty())
    throw InputError(file.string() + ": no element has the " + std::to_string(layout.nodes) +
                     " nodes of the model's segment; write smoothed and higher-order segments as a .json mesh");
  return segments;
}

Segments read_segments(const std::filesystem::path& file, const std::string& name, const ents_layout& layout) {
  if (file.empty()) return one_segment(name, layout);
  if (file.extension() == ".json") return json_segments(file, layout);
  try {
    return deck_segments(file, layout);
  } catch (const inp::Error& error) {
    throw InputError(error.what());
  }
}

/// An edge of a segment: its end nodes and the natural coordinates of its ends (2D: a point).
struct Edge {
  std::size_t segment = 0;
  std::array<double, 2> from{}, to{};
};

/// Edges shared by two segments, by their nodes.
std::vector<std::pair<Edge, Edge>> shared_edges(const Segments& segments, bool triangles) {
  std::map<std::pair<int, int>, Edge> open;
  std::vector<std::pair<Edge, Edge>> pairs;
  const auto add = [&](int a, int b, Edge edge) {
    if (a > b) std::swap(a, b), std::swap(edge.from, edge.to);
    const auto [other, is_new] = open.try_emplace({a, b}, edge);
    if (!is_new) pairs.emplace_back(other->second, edge);
  };
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const int* node = segments.connectivity.data() + s * segments.m;
    if (segments.d == 2) {
      add(node[0], node[0], {s, {-1, 0}, {-1, 0}});
      add(node[1], node[1], {s, {1, 0}, {1, 0}});
    } else if (triangles) {
      add(node[0], node[1], {s, {0, 0}, {1, 0}});
      add(node[1], node[2], {s, {1, 0}, {0, 1}});
      add(node[2], node[0], {s, {0, 1}, {0, 0}});
    } else {
      add(node[0], node[1], {s, {-1, -1}, {1, -1}});
      add(node[1], node[2], {s, {1, -1}, {1, 1}});
      add(node[2], node[3], {s, {1, 1}, {-1, 1}});
      add(node[3], node[0], {s, {-1, 1}, {-1, -1}});
    }
  }
  return pairs;
}

class Checker {
public:
  Checker(const EntsModel& model, const Segments& segments, const std::string& name, bool local, int samples)
      : model_(model), segments_(segments), name_(name), local_(local), samples_(samples) {
    for (std::size_t i = 0; i < segments.d; ++i) {
      double low = INFINITY, high = -INFINITY;
      for (std::size_t n = i; n < segments.nodes.size(); n += segments.d)
        low = std::min(low, segments.nodes[n]), high = std::max(high, segments.nodes[n]);
      size_ = std::max(size_, high - low);
    }
  }

  std::vector<Finding> run() {
    for (std::size_t s = 0; s < segments_.size(); ++s) check_segment(s);
    if (!smoothed()) check_neighbours();
    std::vector<Finding> findings{continuity_, fold_};
    // A segment alone has nothing its border could be torn from; a local height is meant to be repeated.
    if (!smoothed() && local_) findings.push_back(edge_);
    if (!smoothed() && neighbours_) findings.insert(findings.end(), {jump_, wedge_});
    findings.insert(findings.end(), {shadow_, reach_});
    for (Finding& finding : findings)
      if (finding.point.empty() && std::isfinite(finding.value))
        finding.point = point(finding.segment, finding.xi);
    return findings;
  }

private:
  bool smoothed() const { return name_.starts_with("catmull_rom") || name_.starts_with("bspline"); }

  SurfaceSample sample(std::size_t segment, const std::vector<double>& xi) const {
    return sample_surface(model_, segments_.gather(segment, segments_.nodes, segments_.d),
                          segments_.surface_coordinates.empty()
                              ? std::vector<double>{}
                              : segments_.gather(segment, segments_.surface_coordinates, segments_.d - 1),
                          xi);
  }
  std::vector<double> point(std::size_t segment, const std::array<double, 2>& xi) const {
    return sample(segment, {xi.begin(), xi.begin() + static_cast<std::ptrdiff_t>(segments_.d - 1)}).point;
  }

  void check_segment(std::size_t s) {
    auto result = ents_struct<ents_admissibility>();
    result.samples = samples_;
    auto report = ents_struct<ents_report>();
    const std::vector<double> master = segments_.gather(s, segments_.nodes, segments_.d);
    const std::vector<double> coordinates =
        segments_.surface_coordinates.empty()
            ? std::vector<double>{}
            : segments_.gather(s, segments_.surface_coordinates, segments_.d - 1);
    const EntsLibrary& library = model_.library();
    const std::int32_t status = library.model_check(
        model_.get(), master.data(), coordinates.empty() ? nullptr : coordinates.data(), &result, &report);
    if (status < 0) throw InputError("segment " + std::to_string(s) + ": " + describe(library, status, report));
    if (status > 0) throw JobError("segment " + std::to_string(s) + ": " + describe(library, status, report));
    const auto worse = [&](Finding& finding, double value, const double* xi, bool smaller) {
      if (finding.condition.empty() || (smaller ? value < finding.value : value > finding.value)) {
        const bool known = !finding.condition.empty();
        if (!known) finding.condition = " ";
        finding.value = value, finding.segment = s, finding.xi = {xi[0], xi[1]};
      }
    };
    const double here[2] = {0, 0};
    worse(continuity_, result.continuity, here, true);
    worse(fold_, result.fold, result.fold_xi, false);
    worse(edge_, result.edge_height, result.edge_height_xi, false);
    worse(reach_, result.reach, result.reach_xi, true);
    worse(shadow_, result.shadow, result.shadow_xi, true);

    continuity_.condition = "h is twice continuously differentiable";
    continuity_.limit = ">= 2";
    continuity_.violated = continuity_.value < 2;
    continuity_.remark = "the tangent jumps where h'' does; take a smoother height";
    fold_.condition = "rho_e does not fold over itself: max |h| kappa";
    fold_.limit = "< 1";
    fold_.violated = !(fold_.value < 1);
    fold_.remark = "the height exceeds the radius of curvature of rho; lower it, or refine the segments";
    edge_.condition = "local height vanishes on the edges: max |h|";
    edge_.limit = "0";
    edge_.violated = edge_.value > 1e-10 * size_; // rounding of sin(pi) and sums of polynomial terms
    edge_.remark = "the surface jumps from segment to segment; let h vanish, or give surface coordinates";
    shadow_.condition = "no self-shadow: min n_e . e";
    shadow_.limit = "> 0";
    shadow_.violated = !(shadow_.value > 0);
    shadow_.remark = "rays from the emitter meet the back of the surface";
    reach_.condition = "one projection within the reach: min 1/kappa_e";
    reach_.limit = "";
    reach_.remark = "slave nodes closer than this have one projection; for information";
  }

  /// Do neighbours meet, and do they stay apart beside the edge?
  void check_neighbours() {
    const auto pairs = shared_edges(segments_, name_.starts_with("tri"));
    neighbours_ = !pairs.empty();
    jump_.condition = "neighbours meet: largest jump of rho_e at a shared edge";
    jump_.limit = "0";
    jump_.remark = "rho_e = rho + h n jumps with n where h is not zero on the edge; smooth the surface, or let h vanish";
    wedge_.condition = "neighbours do not cross: smallest free angle at a shared edge [degrees]";
    wedge_.limit = "> 0";
    wedge_.remark = "the enriched surfaces of two segments intersect beside their concave edge";
    wedge_.value = 360;
    const std::size_t d = segments_.d, points = d == 2 ? 1 : 33;
    for (const auto& [first, second] : pairs)
      for (std::size_t k = 0; k < points; ++k) {
        const double t = points == 1 ? 0 : static_cast<double>(k) / static_cast<double>(points - 1);
        const std::array<Edge, 2> edges{first, second};
        std::array<Eigen::Vector3d, 2> at, into, normal;
        for (std::size_t e = 0; e < 2; ++e) sample_edge(edges[e], t, at[e], into[e], normal[e]);
        const std::array<double, 2> xi{first.from[0] + t * (first.to[0] - first.from[0]),
                                       first.from[1] + t * (first.to[1] - first.from[1])};
        const double jump = (at[0] - at[1]).norm();
        if (jump > jump_.value) jump_.value = jump, jump_.segment = first.segment, jump_.xi = xi;
        // Free angle: from one surface over the outer side to the other.
        const Eigen::Vector3d outward = (normal[0] + normal[1]).normalized();
        const auto elevation = [&](std::size_t e) {
          const double up = into[e].dot(outward);
          return std::atan2(up, (into[e] - up * outward).norm());
        };
        const double angle = (std::numbers::pi - elevation(0) - elevation(1)) * 180 / std::numbers::pi;
        if (angle < wedge_.value) wedge_.value = angle, wedge_.segment = first.segment, wedge_.xi = xi;
      }
    jump_.violated = jump_.value > 1e-9 * size_;
    wedge_.violated = !(wedge_.value > 0);
  }

  /// Point of rho_e on the edge, direction into the segment along rho_e, and normal of rho.
  void sample_edge(const Edge& edge, double t, Eigen::Vector3d& at, Eigen::Vector3d& into,
                   Eigen::Vector3d& normal) const {
    const std::size_t d = segments_.d;
    const double centre = name_.starts_with("tri") ? 1. / 3 : 0;
    std::array<double, 2> xi{}, inner{};
    for (std::size_t i = 0; i < 2; ++i) {
      xi[i] = edge.from[i] + t * (edge.to[i] - edge.from[i]);
      inner[i] = xi[i] + 1e-4 * ((i + 1 < d ? centre : 0) - xi[i]);
    }
    std::vector<double> both;
    for (const auto& place : {xi, inner})
      both.insert(both.end(), place.begin(), place.begin() + static_cast<std::ptrdiff_t>(d - 1));
    const SurfaceSample values = sample(edge.segment, both);
    Eigen::Vector3d next = Eigen::Vector3d::Zero();
    at.setZero(), normal.setZero();
    for (std::size_t i = 0; i < d; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      at[axis] = values.point[i];
      next[axis] = values.point[d + i];
      normal[axis] = values.base_normal[i];
    }
    into = (next - at).normalized();
    if (d == 3) { // only the part across the edge counts
      std::vector<double> along_xi;
      for (const double step : {-1e-4, 1e-4})
        for (std::size_t i = 0; i < 2; ++i) along_xi.push_back(xi[i] + step * (edge.to[i] - edge.from[i]));
      const SurfaceSample along = sample(edge.segment, along_xi);
      Eigen::Vector3d tangent;
      for (std::size_t i = 0; i < 3; ++i)
        tangent[static_cast<Eigen::Index>(i)] = along.point[3 + i] - along.point[i];
      tangent.normalize();
      into = (into - into.dot(tangent) * tangent).normalized();
    }
  }

  const EntsModel& model_;
  const Segments& segments_;
  std::string name_;
  bool local_;
  int samples_;
  double size_ = 0;
  bool neighbours_ = false;
  Finding continuity_, fold_, edge_, jump_, wedge_, shadow_, reach_;
};

std::string place_text(const Finding& finding, std::size_t d) {
  if (finding.point.empty()) return "";
  std::string text = "segment " + std::to_string(finding.segment) + ", xi = " + format_number(finding.xi[0], 4);
  if (d == 3) text += ", " + format_number(finding.xi[1], 4);
  return text;
}

void draw_check(const EntsModel& model, const Segments& segments, const std::vector<Finding>& findings,
                bool triangles, const std::filesystem::path& folder) {
  // The segment with the first offence, else the first.
  std::size_t segment = 0;
  for (const Finding& finding : findings)
    if (finding.violated) {
      segment = finding.segment;
      break;
    }
  pictures::Surface picture;
  picture.title = "Enriched surface, segment " + std::to_string(segment);
  picture.dimension = static_cast<int>(segments.d);
  picture.columns = segments.d == 2 ? 801 : 161;
  picture.rows = segments.d == 2 ? 1 : 161;
  std::vector<double> xi;
  for (int j = 0; j < picture.rows; ++j)
    for (int i = 0; i < picture.columns; ++i) {
      double s = static_cast<double>(i) / (picture.columns - 1);
      const double t = picture.rows == 1 ? 0 : static_cast<double>(j) / (picture.rows - 1);
      if (triangles)
        s *= 1 - t; // the square collapsed on the triangle
      else
        s = 2 * s - 1;
      xi.push_back(s);
      if (segments.d == 3) xi.push_back(triangles ? t : 2 * t - 1);
    }
  const SurfaceSample sample =
      sample_surface(model, segments.gather(segment, segments.nodes, segments.d),
                     segments.surface_coordinates.empty()
                         ? std::vector<double>{}
                         : segments.gather(segment, segments.surface_coordinates, segments.d - 1),
                     xi);
  picture.enriched = sample.point;
  picture.base = sample.base_point;
  picture.height = sample.height;
  for (const Finding& finding : findings) {
    if (!finding.violated || finding.segment != segment || finding.point.empty()) continue;
    pictures::Place place;
    place.x = finding.point[0], place.y = finding.point[1];
    place.z = segments.d == 3 ? finding.point[2] : 0;
    place.label = finding.condition + " = " + format_number(finding.value, 3);
    picture.places.push_back(place);
  }
  std::filesystem::create_directories(folder);
  const pictures::Outcome outcome = draw(picture, folder, "check");
  if (!outcome.problem.empty()) std::fprintf(stderr, "%s\n", outcome.problem.c_str());
}

} // namespace

int check_command(const CommonOptions& common, const CheckOptions& options) {
  const EntsLibrary library(common.library);
  const EntsModel model(library, options.model);
  const Json text = parse_json_file(options.model);
  const std::string name = text.at("segment").get<std::string>();
  const Segments segments = read_segments(options.mesh, name, model.layout());
  const bool local = model.layout().own_surface_coordinates == 0 && segments.surface_coordinates.empty();
  const std::vector<Finding> findings = Checker(model, segments, name, local, options.samples).run();
  if (!options.out.empty()) draw_check(model, segments, findings, name.starts_with("tri"), options.out);

  const bool admissible =
      std::none_of(findings.begin(), findings.end(), [](const Finding& finding) { return finding.violated; });
  if (common.json) {
    Json result{{"model", options.model.string()},
                {"segments", segments.size()},
                {"admissible", admissible},
                {"conditions", Json::array()}};
    for (const Finding& finding : findings) {
      Json entry{{"condition", finding.condition},
                 {"limit", finding.limit},
                 {"value", std::isfinite(finding.value) ? Json(finding.value) : Json(nullptr)},
                 {"violated", finding.violated},
                 {"segment", finding.segment},
                 {"xi", finding.xi},
                 {"point", finding.point}};
      if (finding.violated) entry["remark"] = finding.remark;
      result["conditions"].push_back(std::move(entry));
    }
    std::printf("%s\n", result.dump(2).c_str());
    return admissible ? 0 : 1;
  }
  Table table;
  table.column("condition").column("worst").column("limit").column("").column("where");
  for (const Finding& finding : findings)
    table.row({finding.condition, std::isinf(finding.value) ? "flat" : format_number(finding.value, 4),
               finding.limit, finding.limit.empty() ? "" : finding.violated ? "FAILS" : "ok",
               place_text(finding, segments.d)});
  std::printf("%s", table.text().c_str());
  for (const Finding& finding : findings) {
    if (!finding.violated) continue;
    std::printf("not admissible: %s is %s (limit %s) at %s: %s\n", finding.condition.c_str(),
                format_number(finding.value, 4).c_str(), finding.limit.c_str(),
                place_text(finding, segments.d).c_str(), finding.remark.c_str());
  }
  if (admissible) std::printf("admissible on %zu %s\n", segments.size(), segments.size() == 1 ? "segment" : "segments");
  return admissible ? 0 : 1;
}

} // namespace host
