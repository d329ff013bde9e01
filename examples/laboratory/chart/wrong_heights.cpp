// SPDX-License-Identifier: BSD-3-Clause
#include "chart/wrong_heights.hpp"

#include <array>

#include "output/table.hpp"
#include "toolbox/error.hpp"
#include "toolbox/json_reader.hpp"

namespace host::chart {
namespace {

using Sentences = std::vector<std::string>;

void add(std::string& text, const std::string& sentence) { text += (text.empty() ? "" : "; ") + sentence; }

std::string joined(const Sentences& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) add(text, sentence);
  return text.empty() ? "nothing" : text;
}

/// Segments of line2 with a local height, and a slave node where it goes wrong.
struct Example {
  std::vector<double> positions;
  std::vector<std::int64_t> connectivity;
  Json height, projection;
  double penetration; ///< that the host expects, for the reach
  std::array<double, 2> slave;
};

std::string example_model(const Example& example) {
  Json model{{"segment", "line2"}, {"master", "rigid"}, {"height", example.height}};
  if (!example.projection.is_null()) model["projection"] = example.projection;
  model["contact"] = {{"normal", {{"type", "penalty"}, {"stiffness", 100}}}};
  return model.dump();
}

/// The whole surface, asked once: what ents_surface_check finds violated.
Sentences asked_first(const EntsModel& model, const Example& example) {
  const ents::Library& library = model.library();
  auto report = ents_struct<ents_report>();
  auto mesh = ents_struct<ents_master_mesh>();
  mesh.segments = static_cast<std::int64_t>(example.connectivity.size() / 2);
  mesh.connectivity = example.connectivity.data();
  mesh.nodes = static_cast<std::int64_t>(example.positions.size() / 2);
  mesh.positions = example.positions.data();
  auto result = ents_struct<ents_surface_admissibility>();
  result.reach = example.penetration;
  const std::int32_t status = library.surface_check(model.get(), &mesh, &result, &report);
  if (status != ENTS_OK) throw JobError("chart: " + describe(library, status, report));
  const std::array<const char*, 10> names{"continuity", "fold",       "edge",   "jump",      "kink",
                                          "wedge",      "projection", "shadow", "occlusion", "crossing"};
  Sentences out;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (result.violated >> k & 1)
      out.push_back(names[k] + std::string(" ") + format_number(result.value[k], 3));
  return out;
}

Sentences on_the_way(const EntsModel& model, const Example& example) {
  const ents::Library& library = model.library();
  auto report = ents_struct<ents_report>();
  const auto require = [&](std::int32_t status) {
    if (status < 0) throw JobError("chart: " + describe(library, status, report));
  };
  auto mesh = ents_struct<ents_master_mesh>();
  mesh.segments = static_cast<std::int64_t>(example.connectivity.size() / 2);
  mesh.connectivity = example.connectivity.data();
  mesh.nodes = static_cast<std::int64_t>(example.positions.size() / 2);
  mesh.positions = example.positions.data();
  std::int64_t size = 0, segment = -1;
  require(library.tree_size(model.get(), mesh.segments, &size, &report));
  std::vector<double> tree(static_cast<std::size_t>(size));
  require(library.tree_build(model.get(), &mesh, tree.data(), size, &report));
  double xi = 0;
  std::int32_t flags = 0;
  auto detection = ents_struct<ents_detection>();
  detection.slave = example.slave.data();
  detection.reach = 10;
  detection.permitted = ENTS_FLAG_LEFT | ENTS_FLAG_BEHIND_EDGE;
  detection.segment = &segment, detection.xi = &xi, detection.flags = &flags;
  require(library.detect(model.get(), &mesh, tree.data(), size, 0, 1, &detection, &report));
  Sentences out;
  if (flags & ENTS_FLAG_AMBIGUOUS) out.push_back("ents_detect: ENTS_FLAG_AMBIGUOUS");
  if (segment < 0) return out;
  double residual[2], tangent[4];
  auto input = ents_struct<ents_input>();
  input.slave = example.slave.data(), input.mesh = &mesh, input.segment = &segment;
  auto output = ents_struct<ents_output>();
  output.wanted = ENTS_RESIDUAL | ENTS_TANGENT;
  output.residual = residual, output.tangent = tangent;
  const std::int32_t status = library.evaluate(model.get(), 0, 1, &input, &output, &report);
  require(status);
  if (status > 0)
    out.push_back("ents_evaluate: status " + std::to_string(status) + ", " + library.status_text(status));
  return out;
}

} // namespace

std::vector<WrongHeight> wrong_heights(const EntsLibrary& library) {
  const std::vector<double> flat{-1, 0, 1, 0};
  const auto sine = [](double amplitude) {
    return Json{{"type", "sine"}, {"amplitude", amplitude}, {"wave_vector", {1}}};
  };
  struct FigurePanel {
    const char *name, *what, *example;
    Example setup;
  };
  const std::vector<FigurePanel> panels{
      {"a",
       "several normal projections within one segment",
       "sine, amplitude 0.3, two waves on a segment of length 2; a node deep under a crest",
       {flat, {0, 1}, sine(0.3), nullptr, 0.2, {0.25, -0.2}}},
      {"b",
       "the master shades itself (shadow projection)",
       "the same sine, rays at 35 degrees; a node behind a crest",
       {flat, {0, 1}, sine(0.3), {{"type", "shadow_direction"}, {"direction", {1, 0.7}}}, 0, {0.4, -0.05}}},
      {"c",
       "the surface is torn between segments",
       "constant height 0.2 on two segments that meet at an angle; a node between them",
       {{-1, 0.3, 0, 0, 1, 0.3}, {0, 1, 1, 2}, {{"type", "constant"}, {"value", 0.2}}, nullptr, 0, {0, 0.1}}},
      {"d",
       "neighbours cross each other",
       "a bump of height 0.6 on each of two segments at a right angle; a node where they overlap",
       {{-1, 1, 0, 0, 1, 1},
        {0, 1, 1, 2},
        {{"type", "polynomial"}, {"coefficients", {0.6, 0, -0.6}}},
        nullptr,
        0,
        {0, 0.4}}},
  };
  std::vector<WrongHeight> rows;
  for (const FigurePanel& panel : panels) {
    const EntsModel model(library, example_model(panel.setup), "", "chart");
    const Sentences first = asked_first(model, panel.setup), later = on_the_way(model, panel.setup);
    rows.push_back({panel.name, panel.what, panel.example, joined(first), joined(later),
                    !first.empty() || !later.empty()});
  }
  return rows;
}

} // namespace host::chart
