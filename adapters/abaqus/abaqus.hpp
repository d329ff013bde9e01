// SPDX-License-Identifier: BSD-3-Clause
// What Abaqus offers its user subroutines: job directory, message file, stop. In other programs that load
// Abaqus subroutines (MOOSE, OOFEM) these functions do not exist; there the directory is the working
// directory and messages go to stderr.
#pragma once

#include <cstddef>
#include <string>

namespace abaqus {

/// JELEM is Abaqus's own number where a deck has parts.
inline constexpr char numbers[] =
    ". With *PART or *INSTANCE Abaqus has numbers of its own: write the area as "
    "property 2, one ELSET per area, or use a flat deck";

/// GETOUTDIR, with a separator at its end.
std::string job_directory();

enum class Severity { information = 1, warning = -1, error = -2 };
/// Into the message file (STDB_ABQERR).
void tell(Severity severity, const char* text);

/// Is this Abaqus, which cuts its increment where PNEWDT asks for it and stops at XIT?
bool is_host();

/// XIT, which does not return. @return false: this program has none
bool stop();

} // namespace abaqus

// Abaqus looks for uel_, since 2024 also for uel, on Windows for UEL; every entry has all the names of its
// system.
#if defined(_WIN32)
#define ENTS_ENTRY(lower, UPPER, parameters) extern "C" __declspec(dllexport) void UPPER parameters
#else
#define ENTS_ENTRY(lower, UPPER, parameters)                                                                 \
  extern "C" __attribute__((visibility("default"))) void lower parameters;                                   \
  extern "C" __attribute__((visibility("default"), alias(#lower))) void lower##_ parameters;                 \
  extern "C" void lower parameters
#endif
