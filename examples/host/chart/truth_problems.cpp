// SPDX-License-Identifier: BSD-3-Clause
// Problems of the work-precision diagrams whose truth shares nothing with the library but the heights.
#include <algorithm>
#include <map>
#include <memory>

#include "chart/work.hpp"
#include "exact_layer.hpp"

namespace host::chart {
namespace {

/// The layer variant of a scene with n x n nodes.
void become_layer(Json& scene, int n) {
  const Json variant = scene.at("variants").at("layer");
  scene.merge_patch(variant);
  for (const char* axis : {"x", "y"}) scene["parts"][0][axis]["pieces"][0]["divisions"] = n;
}

/// Boundary elements for all runs and problems: the motions of the master are the same in all of them.
class Truth {
public:
  Truth(const EntsLibrary& library, const std::filesystem::path& file, int points) {
    Json json = parse_json_file(file);
    become_layer(json, 2); // its mesh does not matter
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

} // namespace

std::vector<Problem> truth_problems(const EntsLibrary& library, const std::filesystem::path& scenes,
                                    bool quick) {
  Problem p;
  p.scene = scenes / "rough_afm" / "scene.json";
  p.text = "256 x 256 heights on one segment, of which the block covers a quarter; three approaches, 3 to 36 "
           "% of the "
           "area in contact. Blocks of hex8 and a penalty, or an elastic layer without a mesh below its "
           "surface and hard contact.";
  p.period = "256 x 256 heights";
  p.forces = true;
  p.settings = {{"/solver", {{"tolerance", 1e-6}}},
                {"/steps/values", quick ? Json{0.06} : Json{0.03, 0.06, 0.1}}};
  const auto divided = [](int n) {
    return std::vector<std::pair<std::string, Json>>{{"/parts/0/x/pieces/0/divisions", n},
                                                     {"/parts/0/y/pieces/0/divisions", n}};
  };
  const std::vector<int> blocks = quick ? std::vector<int>{8} : std::vector<int>{14, 28},
                         layers = quick ? std::vector<int>{32} : std::vector<int>{32, 64, 128, 256};
  for (const int n : blocks)
    p.levels.push_back({std::to_string((n + 1) * (n + 1)) + " slave nodes, block", divided(n)});
  for (const int n : layers)
    p.levels.push_back({std::to_string((n + 1) * (n + 1)) + " slave nodes, layer", {}});
  p.adapt = [blocks, layers](Json& scene, const Way& way) {
    if (way.level >= blocks.size()) become_layer(scene, layers[way.level - blocks.size()]);
    for (const char* key : {"exact", "compare", "variants"}) scene.erase(key);
  };
  for (std::size_t level = 0; level < blocks.size(); ++level) {
    p.ways.push_back({Family::enriched, 1, level});
    if (level + 1 < blocks.size()) p.ways.push_back({Family::sampled, 1, level});
  }
  for (std::size_t level = blocks.size(); level < p.levels.size(); ++level)
    p.ways.push_back({Family::layer, 1, level});
  for (const int n : quick ? std::vector<int>{64} : std::vector<int>{64, 128})
    p.ways.push_back({Family::facets, n, quick ? p.levels.size() - 1 : p.levels.size() - 2});

  const auto truth = std::make_shared<Truth>(library, p.scene, quick ? 64 : 1024);
  const std::string held =
      "boundary elements, " + std::string(quick ? "64" : "1024") + " points a side, hard contact";
  Problem field = p, area = p;
  field.name = "rough_pressure",
  field.title = "A measured rough surface: the pressure field against the truth";
  field.quantity = "force of every slave node, L2 over the surface and the loads";
  field.truth = held + ": what the cells around the node carry";
  field.against = [truth](const StepRecord& record, const SurfaceState& state, Series& series) {
    const std::vector<double> exact = truth->layer().pressure_at(state, truth->at(record.motion));
    series.value.insert(series.value.end(), state.pressure.begin(), state.pressure.end());
    series.truth.insert(series.truth.end(), exact.begin(), exact.end());
    series.weight.insert(series.weight.end(), state.area.begin(), state.area.end());
  };
  std::erase_if(area.ways,
                [](const Way& way) { return way.family == Family::sampled; }); // the correction needs nodes
  area.name = "rough_area", area.title = "A measured rough surface: the contact area against the truth";
  area.quantity = "area in contact, corrected by its border, over the loads";
  area.truth = held;
  area.against = [truth](const StepRecord& record, const SurfaceState&, Series& series) {
    series.value.push_back(record.area.fraction);
    series.truth.push_back(truth->at(record.motion).fine.fraction);
    series.weight.push_back(1);
  };
  return {field, area};
}

} // namespace host::chart
