// SPDX-License-Identifier: BSD-3-Clause
// A scene file of any content is read, or refused with a message that names it: no crash, no other exception,
// no memory beyond what the size of the file explains.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "mesh_size.hpp"
#include "scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const host::Scene scene = host::read_scene_text(text, "fuzz.json");
    host::check_mesh_size(scene);
    // What a run goes on to do with it: copies, and text of it.
    if (host::Json(scene.definition).dump().empty()) std::abort();
  } catch (const host::InputError& error) {
    if (std::string(error.what()).rfind("fuzz.json", 0) == 0) return 0;
    std::cerr << "the message does not begin with the file: " << error.what() << "\n";
    std::abort();
  }
  return 0;
}
