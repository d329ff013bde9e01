// SPDX-License-Identifier: BSD-3-Clause
#include "text_file.hpp"

#include <fstream>
#include <stdexcept>

namespace host {

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error(file.string() + ": cannot be written (folder, permission or disk?)");
}

} // namespace host
