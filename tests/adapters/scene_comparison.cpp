// SPDX-License-Identifier: BSD-3-Clause
#include "scene_comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>

namespace adapters {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

struct SceneKind {
  const char *name, *folder;
  double refinement; ///< of the coarse mesh
  int last_step;     ///< of the coarse one; 0: all
  const char* variant = nullptr;
};
constexpr SceneKind kinds[] = {
    {"hertz2d", "hertz2d", 0.5, 0},
    {"hertz3d", "hertz3d", 0.5, 2},
    {"westergaard", "westergaard", 0.5, 4},
    {"wavy3d", "wavy3d", 0.5, 0},
    {"rough_afm", "rough_afm", 0.2, 3, "block"},
    {"cattaneo_mindlin", "cattaneo_mindlin", 0.5, 0},
    {"ironing", "ironing", 1, 12},
    {"slope", "slope", 1, 0},
    {"chatter", "chatter", 1, 0},
    {"patch_test", "patch_test", 1, 0},
    {"thread", "thread", 1, 0},
    {"wavy3d_friction", "wavy3d", 0.5, 3},
    {"cattaneo_soft", "cattaneo_mindlin", 0.5, 0},
};

Json read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return Json::parse(in);
}

/// Cells of a graded axis: twice the size is the square of their ratio.
void refine(Json& part, double factor) {
  for (const char* axis : {"x", "y", "z"})
    if (part.contains(axis))
      for (Json& piece : part[axis]["pieces"]) {
        piece["divisions"] =
            std::max(1, static_cast<int>(std::lround(factor * piece["divisions"].get<int>())));
        if (piece.contains("growth")) piece["growth"] = std::pow(piece["growth"].get<double>(), 1 / factor);
      }
}

void make_paths_absolute(Json& value, const fs::path& directory) {
  for (const char* key : {"file", "deck"})
    if (value.is_object() && value.contains(key))
      value[key] = (directory / value[key].get<std::string>()).string();
  if (value.is_structured())
    for (Json& part : value) make_paths_absolute(part, directory);
}

} // namespace

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const SceneKind& kind : kinds)
    if (std::string(kind.name) != "cattaneo_soft") names.emplace_back(kind.name);
  return names;
}

std::vector<std::string> scene_adapters() {
  return {"abaqus", "abaqus_explicit", "ansys", "calculix", "feap", "lsdyna", "marc", "opensees"};
}

std::string write_scene(const std::string& name, Mesh mesh, const fs::path& folder, bool symmetrised) {
  const auto found =
      std::find_if(std::begin(kinds), std::end(kinds), [&](const SceneKind& k) { return k.name == name; });
  if (found == std::end(kinds)) {
    std::string names;
    for (const SceneKind& k : kinds) names += (names.empty() ? "" : ", ") + std::string(k.name);
    throw std::invalid_argument("no scene \"" + name + "\"; there are: " + names);
  }
  const SceneKind& kind = *found;
  const fs::path source = fs::path(ENTS_EXAMPLES) / kind.folder;
  Json scene = read(source / "scene.json");
  make_paths_absolute(scene, source);
  if (kind.variant != nullptr) {
    scene.merge_patch(Json(scene["variants"][kind.variant]));
    scene.erase("variants");
  }
  Json& model = scene["contact"]["model"];
  if (name == "chatter")
    scene.merge_patch(Json(scene["variants"]["exponential"])); // the scene itself is made not to end
  if (name == "wavy3d_friction") { // its bottom is drawn along: most nodes slip, some stick
    model["contact"] = {{"normal", {{"type", "penalty"}, {"stiffness", 1e5}}},
                        {"friction", {{"type", "coulomb"}, {"coefficient", 0.05}, {"stiffness", 1e4}}}};
    scene["supports"] = Json::array({{{"nodes", "block.z_min"}, {"x", 0.002}, {"y", 0.001}, {"z", 0}}});
    scene["symmetry_copies"] = 1;
    scene.erase("exact");
    scene.erase("variants");                // without friction
    scene["solver"]["max_iterations"] = 60; // a step that is cut for want of iterations has another path
  }
  // Its bodies touch in one node with a gap of 0, whose last bit would decide whether this one is in contact.
  if (std::string(kind.folder) == "cattaneo_mindlin") scene["parts"][1]["y"]["from"] = 1e-9;
  // Friction's stiffness times roundings of xi is 2.3e-11 of the forces, where projections start elsewhere;
  // the tolerance is 2e-11, and the last bits of the solver's library would decide on iterations.
  if (name == "slope") model["contact"]["friction"]["stiffness"] = 1e4;
  if (name == "cattaneo_soft")
    for (const char* law : {"normal", "friction"}) model["contact"][law]["stiffness"] = 1e4;
  if (symmetrised) model["contact"]["symmetrised"] = true;
  if (mesh == Mesh::coarse) {
    for (Json& part : scene["parts"]) refine(part, kind.refinement);
    Json& values = scene["steps"]["values"];
    if (kind.last_step > 0 && values[0].is_number())
      while (values.size() > static_cast<std::size_t>(kind.last_step)) values.erase(values.size() - 1);
    if (name == "ironing") values = {{{"to", 1}, {"count", 4}}, {{"to", 1.08}, {"count", 8}}};
  }
  const fs::path file = folder / (name + (symmetrised ? "_symmetrised" : "") + ".json");
  std::ofstream(file) << scene.dump(1);
  return file.string();
}

SceneResult run_scene(const std::string& file, const std::string& adapter, const std::string& options) {
  const fs::path errors =
      fs::temp_directory_path() / ("ents-scene-" + std::to_string(std::random_device{}()) + ".errors");
  const std::string command = "\"" ENTS_SCENE_HOST "\" \"" + file + "\" --json --nodes --adapter " + adapter +
                              " " + options + " 2>\"" + errors.string() + "\"";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::array<char, 65536> part;
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), pipe))
    text.append(part.data(), size);
  SceneResult result;
  const int status = pclose(pipe);
  std::ifstream in(errors);
  const std::string said(std::istreambuf_iterator<char>(in), {});
  in.close();
  fs::remove(errors);
  if (status != 0) {
    result.refusal = said;
    if (result.refusal.empty())
      throw std::runtime_error(command + ": ended with status " + std::to_string(status));
    return result;
  }
  Json json = Json::parse(text);
  result.seconds = json["wall_time"]["total"];
  result.fingerprint = json["fingerprint"];
  result.steps = std::move(json["steps"]);
  for (Json& step : result.steps) step.erase("wall_time");
  return result;
}

Comparison compare(const SceneResult& a, const SceneResult& b) {
  Comparison c;
  c.bits = a.fingerprint == b.fingerprint && a.steps == b.steps;
  c.iterations = a.steps.size() == b.steps.size();
  if (!c.iterations) throw std::runtime_error("another number of steps");
  const auto largest = [](const Json& values) {
    double size = 0;
    for (const Json& value : values) size = std::max(size, std::abs(value.get<double>()));
    return size;
  };
  const auto keep = [](double& worst, const Json& x, const Json& y, double size) {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (const double difference = std::abs(x[i].get<double>() - y[i].get<double>()); difference > 0)
        worst = std::max(worst, difference / size);
  };
  for (std::size_t k = 0; k < a.steps.size(); ++k) {
    const Json &x = a.steps[k], &y = b.steps[k], &p = x["nodes"], &q = y["nodes"];
    c.iterations = c.iterations && x["iterations"] == y["iterations"] && x["cuts"].size() == y["cuts"].size();
    const double size = largest(p["position"]), pressure = largest(p["pressure"]);
    keep(c.motion, p["position"], q["position"], size);
    keep(c.motion, Json::array({x["approach"]}), Json::array({y["approach"]}), size);
    keep(c.force, p["pressure"], q["pressure"], pressure);
    keep(c.force, p["traction"], q["traction"], pressure);
  }
  return c;
}

} // namespace adapters
