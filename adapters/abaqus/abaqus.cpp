// SPDX-License-Identifier: BSD-3-Clause
#include "abaqus.hpp"

#include <cstdio>
#include <cstring>

#if defined(_WIN32)
#define HOST_FUNCTION(lower, UPPER) UPPER
#define HOST_WEAK
#else
#define JOINED(name) name##_
#define HOST_FUNCTION(lower, UPPER) JOINED(lower)
#define HOST_WEAK __attribute__((weak))
#endif

// Abaqus/Explicit has the same services by other names.
#if defined(ENTS_ABAQUS_EXPLICIT)
#define getoutdir vgetoutdir
#define GETOUTDIR VGETOUTDIR
#define stdb_abqerr xplb_abqerr
#define STDB_ABQERR XPLB_ABQERR
#define xit xplb_exit
#define XIT XPLB_EXIT
#endif

// Fortran routines; lengths of character arguments come last, by value.
extern "C" {
HOST_WEAK void HOST_FUNCTION(getoutdir, GETOUTDIR)(char* directory, int* length, std::size_t capacity);
HOST_WEAK void HOST_FUNCTION(stdb_abqerr, STDB_ABQERR)(const int* severity, const char* text,
                                                       const int* integers, const double* reals,
                                                       const char* words, std::size_t text_length,
                                                       std::size_t word_length);
HOST_WEAK void HOST_FUNCTION(xit, XIT)();
}

namespace abaqus {
namespace {

template <class Function> bool offered(Function* function) {
#if defined(_WIN32)
  (void)function;
  return true;
#else
  return function != nullptr;
#endif
}

} // namespace

std::string job_directory() {
  if (!offered(HOST_FUNCTION(getoutdir, GETOUTDIR))) return "";
  char text[257] = {};
  int length = 0;
  HOST_FUNCTION(getoutdir, GETOUTDIR)(text, &length, 256);
  std::string directory(text, text + (length > 0 && length <= 256 ? length : 0));
  while (!directory.empty() && directory.back() == ' ') directory.pop_back();
  if (!directory.empty() && directory.back() != '/' && directory.back() != '\\') directory += '/';
  return directory;
}

void tell(Severity severity, const char* text) {
  if (!offered(HOST_FUNCTION(stdb_abqerr, STDB_ABQERR))) {
    std::fprintf(stderr, "%s\n", text);
    return;
  }
  char line[501] = {}; // the longest that STDB_ABQERR takes
  std::snprintf(line, sizeof line, "%s", text);
  for (char& c : line)
    if (c == '%') c = ' '; // else the begin of a place holder
  const int level = static_cast<int>(severity), integer = 0;
  const double real = 0;
  HOST_FUNCTION(stdb_abqerr, STDB_ABQERR)(&level, line, &integer, &real, "        ", std::strlen(line), 8);
}

bool is_host() { return offered(HOST_FUNCTION(xit, XIT)); }

bool stop() {
  if (!is_host()) return false;
  HOST_FUNCTION(xit, XIT)();
  return true;
}

} // namespace abaqus
