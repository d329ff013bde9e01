// SPDX-License-Identifier: BSD-3-Clause
// The scenes of examples/ through the program, as a user runs them.
#pragma once

#include <array>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

#include "toolbox/json_reader.hpp"

namespace host::test {

struct ProgramOutput {
  std::string text; ///< stdout and stderr
  int exit_code = 0;
};

/// A command as typed in a shell.
inline ProgramOutput run_in_shell(const std::string& line) {
  const std::string command = line + " 2>&1";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  ProgramOutput output;
  std::array<char, 4096> part{};
  for (std::size_t count; (count = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    output.text.append(part.data(), count);
  const int status = pclose(pipe);
  output.exit_code = status >= 0 && (status & 0x7f) == 0 ? (status >> 8) & 0xff : -1;
  return output;
}

/// ents-lab with arguments as typed in a shell.
inline ProgramOutput ents_host(const std::string& arguments) {
  return run_in_shell("\"" ENTS_HOST "\" " + arguments);
}

/// The JSON result of a scene of examples/.
inline Json run_scene(const std::string& name, const std::string& options = "") {
  const ProgramOutput output = ents_host("run \"" EXAMPLES "/" + name + "/scene.json\" --json " + options);
  if (output.exit_code != 0) throw std::runtime_error(output.text);
  return Json::parse(output.text);
}

/// A quantity of a step beside its exact value; relative_error is null where nothing is known.
inline const Json& exact(const Json& step, const std::string& name) {
  for (const Json& quantity : step.at("exact"))
    if (quantity.at("name") == name) return quantity;
  throw std::runtime_error("step " + step.at("step").dump() + " has no quantity " + name);
}

inline double relative_error(const Json& step, const std::string& name) {
  return exact(step, name).at("relative_error").get<double>();
}

inline double value(const Json& step, const std::string& name) {
  return exact(step, name).at("value").get<double>();
}

} // namespace host::test
