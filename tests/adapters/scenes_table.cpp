// SPDX-License-Identifier: BSD-3-Clause
// Every scene as it is shipped, through every adapter: a table. Half an hour.
//   adapters_scenes_table [SCENE ...]
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "scene_comparison.hpp"

namespace {

void print_help(std::FILE* to) {
  std::fprintf(to, "adapters_scenes_table [SCENE ...]\n\n"
                   "Every scene as it is shipped, or those named, through every adapter: a table in Markdown "
                   "on stdout. 0: the bits of the\n"
                   "library called directly; else by how much motion and forces differ. All scenes take half "
                   "an hour.\n\nScenes:");
  for (const std::string& name : adapters::scene_names()) std::fprintf(to, " %s", name.c_str());
  std::fprintf(to, "\n");
}

} // namespace

int main(int argc, char** argv) try {
  using namespace adapters;
  std::vector<std::string> scenes(argv + 1, argv + argc);
  if (scenes.empty()) scenes = scene_names();
  for (const std::string& scene : scenes) { // all of them before hours are spent on the first
    const std::vector<std::string> known = scene_names();
    if (scene == "--help" || scene == "-h") return print_help(stdout), 0;
    if (std::find(known.begin(), known.end(), scene) != known.end()) continue;
    std::fprintf(stderr, "adapters_scenes_table: no scene \"%s\"\n\n", scene.c_str());
    return print_help(stderr), 2;
  }
  const auto folder = std::filesystem::temp_directory_path() / "ents-scenes-table";
  std::filesystem::create_directories(folder);
  bool good = true;
  std::printf("| scene | iterations | plain: motion | forces | iterations |");
  for (const std::string& adapter : scene_adapters()) std::printf(" %s |", adapter.c_str());
  std::printf("\n|---|---:|---:|---:|---|");
  for (std::size_t i = 0; i < scene_adapters().size(); ++i) std::printf("---|");
  std::printf("\n");
  for (const std::string& scene : scenes) {
    const std::string file = write_scene(scene, Mesh::shipped, folder);
    const SceneResult direct = run_scene(file, "direct"), plain = run_scene(file, "plain");
    if (!direct.refusal.empty() || !plain.refusal.empty())
      throw std::runtime_error(direct.refusal + plain.refusal);
    int iterations = 0;
    for (const auto& step : direct.steps) iterations += step["iterations"].get<int>();
    const Comparison start = compare(plain, direct);
    good = good && start.iterations;
    std::printf("| %s | %d | %.0e | %.0e | %s |", scene.c_str(), iterations, start.motion, start.force,
                start.iterations ? "same" : "OTHER");
    for (const std::string& adapter : scene_adapters()) {
      const SceneResult through = run_scene(file, adapter);
      if (!through.refusal.empty()) {
        std::printf(" %s |", through.refusal.find("/dimension") != std::string::npos
                                 ? "3D only"
                                 : through.refusal.c_str());
        continue;
      }
      const Comparison c = compare(direct, through);
      good = good && c.iterations;
      if (c.bits)
        std::printf(" 0 |");
      else
        std::printf(" %.0e, %.0e%s |", c.motion, c.force, c.iterations ? "" : ", OTHER iterations");
      std::fflush(stdout);
    }
    std::printf("\n");
  }
  return good ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
