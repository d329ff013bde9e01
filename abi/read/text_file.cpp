// SPDX-License-Identifier: BSD-3-Clause
#include "abi/read/text_file.hpp"

#include <cerrno>
#include <fstream>
#include <new>
#include <system_error>

#include "abi/read/model_error.hpp"

namespace ents {

std::string read_text_file(const std::filesystem::path& path, std::uintmax_t largest) {
  const std::string name = display_name(path);
  const auto failed = [&](const std::string& reason) {
    throw ModelError(ENTS_FILE, printable(name, 200) + ": " + reason);
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) failed("there is no such file");
  if (!std::filesystem::is_regular_file(status)) failed("is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) failed("its size cannot be read");
  if (size > largest)
    failed("has " + std::to_string(size) + " bytes; at most " + std::to_string(largest) + " are read");

  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream && errno == ENOMEM) throw std::bad_alloc(); // the stream itself does not say why
  if (!stream) failed("cannot be opened for reading");
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size)) failed("cannot be read to its end");
  return text;
}

std::filesystem::path path_from_utf8(std::string_view name) {
  if (name.find('\0') != std::string_view::npos)
    throw ModelError(ENTS_FILE, in_quotes(name) + ": a file name holds no zero byte");
  return std::filesystem::path(std::u8string(name.begin(), name.end()));
}

std::string display_name(const std::filesystem::path& path) {
  const std::u8string name = path.u8string();
  return std::string(name.begin(), name.end());
}

} // namespace ents
