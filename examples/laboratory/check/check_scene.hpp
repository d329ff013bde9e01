// SPDX-License-Identifier: BSD-3-Clause
// What `ents-lab check` looks at: a model and the segments that it is on, or a scene, which has both, and a
// slave mesh.
#pragma once

#include <memory>

#include "check_mesh.hpp"
#include "commands.hpp"
#include "ents_library.hpp"
#include "resolution.hpp"
#include "toolbox/json_reader.hpp"

namespace host {

struct CheckSubject {
  Json text;                    ///< of the model
  std::filesystem::path folder; ///< where its file names start
  std::unique_ptr<EntsModel> model;
  MasterSurface surface;
  Resolution resolution;   ///< of a scene; else not known
  std::string length_unit; ///< of a scene
};

/// @throws InputError naming the file and the key
CheckSubject read_subject(const EntsLibrary& library, const CheckOptions& options);

} // namespace host
