// SPDX-License-Identifier: BSD-3-Clause
#include "text_file.hpp"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace host {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, int error) {
  throw std::runtime_error(file.string() + ": cannot be written: " + std::strerror(error));
}

class Descriptor {
public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }
  /// @return 0, or the error that some file systems report no earlier than here
  int close() { return ::close(std::exchange(number_, -1)) == 0 ? 0 : errno; }

private:
  int number_;
};

/// The file that a chain of symbolic links ends in; it need not exist.
fs::path end_of_links(fs::path file) {
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(file, error); ++links) {
    const fs::path to = fs::read_symlink(file, error);
    if (error) break;
    file = to.is_absolute() ? to : file.parent_path() / to;
  }
  return file;
}

/// @return 0 or errno
int write_all(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(descriptor, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    done += static_cast<std::size_t>(count);
  }
  return 0;
}

/// Pipes, devices and some network file systems have nothing to flush.
int flush(int descriptor) {
  if (::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS) return 0;
  return errno;
}

} // namespace

NewFile::NewFile(const fs::path& file, const std::string& text) : named_(file), target_(end_of_links(file)) {
  struct stat old {};
  const bool exists = ::stat(target_.c_str(), &old) == 0;
  if (exists && ::access(target_.c_str(), W_OK) != 0) fail(named_, errno); // someone protects it
  const bool direct = exists && !S_ISREG(old.st_mode);
  if (!direct) beside_ = target_.string() + ".new";
  Descriptor descriptor(
      ::open(direct ? target_.c_str() : beside_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  const bool opened = descriptor.number() >= 0;
  int error = opened ? 0 : errno;
  if (error == 0 && exists && !direct && ::fchmod(descriptor.number(), old.st_mode & 0777) != 0)
    error = errno;
  if (error == 0) error = write_all(descriptor.number(), text);
  if (error == 0) error = flush(descriptor.number());
  if (error == 0) error = descriptor.close();
  if (error == 0) return;
  if (!direct && opened) ::unlink(beside_.c_str());
  fail(named_, error);
}

NewFile::~NewFile() {
  if (!beside_.empty()) ::unlink(beside_.c_str());
}

void NewFile::replace() {
  if (beside_.empty()) return;
  if (::rename(beside_.c_str(), target_.c_str()) != 0) fail(named_, errno);
  beside_.clear();
}

void flush_folder(const fs::path& folder) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.number() < 0) return;
  if (const int error = flush(descriptor.number()); error != 0) fail(folder, error);
}

void write_text(const fs::path& file, const std::string& text) { NewFile(file, text).replace(); }

} // namespace host
