// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a file of heights: refused with a message, or a map whose heights are finite.
#include <cmath>
#include <cstdio>
#include <string>
#include <unistd.h>

#include "ents.h"
#include "fuzz/bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string path = "height_map_fuzz." + std::to_string(getpid()) + ".txt";
  static const std::string text =
      R"({"segment": "quad4", "height": {"type": "map", "boundary": "clamped", "file": ")" + path +
      R"(", "size": [2, 2], "origin": [-1, -1]}})";
  static const int removed_at_exit = std::atexit([] { std::remove(path.c_str()); });
  (void)removed_at_exit;
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) std::abort();
  std::fwrite(data, 1, size, file);
  std::fclose(file);
  ents_report report{};
  report.struct_size = sizeof report;
  ents_model* model = nullptr;
  const std::int32_t made = ents_model_create(text.c_str(), -1, nullptr, nullptr, 0, &model, &report);
  fuzz::require((made == ENTS_OK) == (model != nullptr) && (made == ENTS_OK) == (report.message[0] == '\0'));
  if (!model) return 0;
  const double master[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, xi[] = {0.3, -0.9, 1.0, 1.0};
  double height[2] = {};
  ents_surface surface{};
  surface.struct_size = sizeof surface;
  surface.master = master, surface.xi = xi, surface.height = height;
  if (ents_surface_evaluate(model, 2, &surface, &report) == ENTS_OK)
    fuzz::require(std::isfinite(height[0]) && std::isfinite(height[1]));
  ents_model_destroy(&model, nullptr);
  return 0;
}
