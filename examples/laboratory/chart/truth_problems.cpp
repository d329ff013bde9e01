// SPDX-License-Identifier: BSD-3-Clause
// Problems of the work-precision diagrams whose truth shares nothing with the library but the heights.
#include <algorithm>
#include <map>
#include <memory>

#include "chart/work.hpp"
#include "exact_layer.hpp"

namespace host::chart {
namespace {

/// The body of `layer`, a scene on an elastic layer, with n x n cells, under the contact of `scene`.
void become_layer(Json& scene, const Json& layer, int n) {
  scene["parts"] = layer.at("parts");
  scene.erase("supports");
  for (const char* axis : {"x", "y"}) scene["parts"][0][axis]["pieces"][0]["divisions"] = n;
}

/// Boundary elements for all runs and problems: the motions of the master are the same in all of them.
class SolvedLayers {
public:
  SolvedLayers(const EntsLibrary& library, const std::filesystem::path& file, const Json& layer, int points) {
    Json json = layer;
    become_layer(json, layer, 2); // its mesh does not matter
    json["exact"] = {{"type", "boundary_elements"}, {"points", points}};
    scene_ = read_scene_text(json.dump(), file);
    simulation_ = std::make_unique<Simulation>(scene_, &library);
  }

  const ExactLayer& layer() const { return *simulation_->exact_layer(); }
  const LayerTruth& at(double motion) {
    const auto found = known_.find(motion);
    return found != known_.end() ? found->second
                                 : known_.emplace(motion, layer().truth(motion)).first->second;
  }

private:
  Scene scene_;
  std::unique_ptr<Simulation> simulation_;
  std::map<double, LayerTruth> known_;
};

/// A scene that is solved with meshed blocks and with layers.
struct TruthScene {
  std::string name, title, text, period, scene;
  std::string block, layer; ///< its variants; empty: the scene as it is
  Json approaches;
  std::vector<int> blocks, layers, facets; ///< cells per side; plain segments per direction
  int points;                              ///< of the boundary elements
};

Problem truth_problem(const EntsLibrary& library, const std::filesystem::path& scenes, const TruthScene& of) {
  Problem p;
  p.scene = scenes / of.scene / "scene.json";
  p.variant = of.block;
  const Json layer = read_variant(p.scene, of.layer);
  p.name = of.name, p.title = of.title, p.text = of.text, p.period = of.period;
  p.forces = true;
  p.settings = {{"/solver", {{"tolerance", 1e-6}}},
                {"/steps", {{"control", "approach"}, {"values", of.approaches}}}};
  const auto divided = [](int n) {
    return std::vector<std::pair<std::string, Json>>{{"/parts/0/x/pieces/0/divisions", n},
                                                     {"/parts/0/y/pieces/0/divisions", n}};
  };
  const auto slaves = [](int n) { return std::to_string((n + 1) * (n + 1)) + " slave nodes, "; };
  // Levels: blocks with the scene's penalty, layers on the same nodes with the same penalty, layers with hard
  // contact.
  std::vector<int> layers = of.blocks;
  layers.insert(layers.end(), of.layers.begin(), of.layers.end());
  const std::size_t blocks = of.blocks.size();
  for (const int n : of.blocks) p.levels.push_back({slaves(n) + "block", divided(n)});
  for (const int n : of.blocks) p.levels.push_back({slaves(n) + "layer with the block's penalty", {}});
  for (const int n : of.layers) p.levels.push_back({slaves(n) + "layer", {}});
  p.adapt = [blocks, layer, layers](Json& scene, const Way& way) {
    if (way.level >= blocks) become_layer(scene, layer, layers[way.level - blocks]);
    if (way.level >= 2 * blocks)
      scene.at("contact").at("model").at("contact")["normal"]["type"] = "augmented_multiplier";
    for (const char* key : {"exact", "compare", "variants"}) scene.erase(key);
  };
  for (std::size_t level = 0; level < blocks; ++level) {
    p.ways.push_back({Family::enriched, 1, level});
    if (level + 1 < blocks) p.ways.push_back({Family::sampled, 1, level});
  }
  for (std::size_t level = blocks; level < p.levels.size(); ++level)
    p.ways.push_back({Family::layer, 1, level});
  const std::size_t finest = p.levels.size() - (of.layers.size() > 1 ? 1 : 0); // too dear for plain segments
  for (std::size_t level = 2 * blocks; level < finest; ++level)
    for (const int n : of.facets) p.ways.push_back({Family::facets, n, level});
  p.beside = [blocks](const Way& way) -> std::optional<Way> {
    switch (way.family) {
    case Family::enriched:
      return Way{Family::layer, 1, way.level + blocks};
    case Family::facets:
      return Way{Family::layer, 1, way.level};
    case Family::layer:
      return std::nullopt;
    default:
      return Way{Family::on_facets, 0, 0}; // points instead of nodes are no share of these three
    }
  };
  const auto truth = std::make_shared<SolvedLayers>(library, p.scene, layer, of.points);
  p.truth = "boundary elements, " + std::to_string(of.points) +
            " points a side, hard contact; a node has what the "
            "cells around it carry";
  p.quantity = "force of every slave node, L2 over the surface and the loads";
  p.against = [truth](const StepRecord& record, const SurfaceState& state, Series& series) {
    const std::vector<double> exact = truth->layer().pressure_at(state, truth->at(record.motion));
    series.value.insert(series.value.end(), state.pressure.begin(), state.pressure.end());
    series.truth.insert(series.truth.end(), exact.begin(), exact.end());
    series.weight.insert(series.weight.end(), state.area.begin(), state.area.end());
  };
  p.area = [truth](const Scene&, const StepRecord& record) { return truth->at(record.motion).fine.fraction; };
  return p;
}

} // namespace

std::vector<Problem> truth_problems(const EntsLibrary& library, const std::filesystem::path& scenes,
                                    bool quick) {
  const TruthScene wave{"wave_truth",
                        "Double sine, partial contact",
                        "A quarter of a wave; three approaches, 10 to 62 % of the area in contact. Blocks of "
                        "hex8 and a penalty, "
                        "or an elastic layer without a mesh below its surface and hard contact.",
                        "one wave per direction",
                        "wavy3d",
                        "",
                        "layer",
                        quick ? Json{0.002} : Json{0.001, 0.002, 0.004},
                        quick ? std::vector<int>{8} : std::vector<int>{8, 16, 24},
                        quick ? std::vector<int>{16} : std::vector<int>{16, 32, 64, 128},
                        quick ? std::vector<int>{15} : std::vector<int>{7, 15, 31, 63},
                        quick ? 64 : 512};
  const TruthScene rough{
      "rough_truth",
      "A measured rough surface",
      "256 x 256 heights on one segment, of which the block covers a quarter; three approaches, 3 to 36 % of "
      "the area in contact. Blocks of hex8 and a penalty, or an elastic layer without a mesh below its "
      "surface "
      "and hard contact.",
      "256 x 256 heights",
      "rough_afm",
      "block",
      "",
      quick ? Json{0.06} : Json{0.03, 0.06, 0.1},
      quick ? std::vector<int>{8} : std::vector<int>{14, 28},
      quick ? std::vector<int>{32} : std::vector<int>{32, 64, 128, 256},
      quick ? std::vector<int>{64} : std::vector<int>{64, 128},
      quick ? 64 : 1024};
  return {truth_problem(library, scenes, wave), truth_problem(library, scenes, rough)};
}

} // namespace host::chart
