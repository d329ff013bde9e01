// SPDX-License-Identifier: BSD-3-Clause
#include "abaqus_services.hpp"

#include <cstring>
#include <filesystem>
#include <mutex>
#include <utility>

#include "emulated_host.hpp"

namespace {
std::mutex mutex;
std::vector<adapters::AbaqusMessage> messages;
} // namespace

namespace adapters {
std::vector<AbaqusMessage> abaqus_messages() {
  const std::lock_guard lock(mutex);
  return std::exchange(messages, {});
}

std::string only_message() {
  const auto told = abaqus_messages();
  return told.size() == 1 ? told[0].text : std::to_string(told.size()) + " messages";
}
} // namespace adapters

extern "C" {

void getoutdir_(char* directory, int* length, std::size_t capacity) {
  const std::string here = std::filesystem::current_path().string();
  std::memset(directory, ' ', capacity);
  std::memcpy(directory, here.data(), here.size());
  *length = static_cast<int>(here.size());
}

void stdb_abqerr_(const int* severity, const char* text, const int*, const double*, const char*,
                  std::size_t length, std::size_t) {
  const std::lock_guard lock(mutex);
  messages.push_back({*severity, std::string(text, length)});
}

// The same in Abaqus/Explicit.
void vgetoutdir_(char* directory, int* length, std::size_t capacity) {
  getoutdir_(directory, length, capacity);
}
void xplb_abqerr_(const int* severity, const char* text, const int* integers, const double* reals,
                  const char* words, std::size_t length, std::size_t word) {
  stdb_abqerr_(severity, text, integers, reals, words, length, word);
}
void xplb_exit_() { throw adapters::HostStopped("XPLB_EXIT"); }

void xit_() { throw adapters::HostStopped("XIT"); }

} // extern "C"
