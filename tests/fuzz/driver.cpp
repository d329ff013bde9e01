// SPDX-License-Identifier: BSD-3-Clause
// Runs a fuzz target without libFuzzer: random changes of the seeds, blindly. It understands the options of
// libFuzzer that the tests use, and like libFuzzer it keeps the input that ended the program:
//   NAME [-max_total_time=SECONDS] [-runs=N] [-seed=N] [-timeout=SECONDS] [-artifact_prefix=PATH]
//        [FILE or FOLDER ...]
// Seeds are run as they are first. Without a time and a number of runs only they are: NAME FILE repeats a
// failure.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

namespace {

using Input = std::string;

Input present;              // what the target is looking at
std::string artifact;       // where to keep it, once it has ended the program; empty: nowhere
std::size_t longest = 4096; // of a changed input; more if a seed is longer

// Only what a signal handler may call.
void keep() {
  if (artifact.empty()) return;
  const int file = open(artifact.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644);
  if (file < 0 || write(file, present.data(), present.size()) != static_cast<ssize_t>(present.size())) return;
  close(file);
  for (const char* text : {"\nthe input that ended this is kept: ", artifact.c_str(), "\n"})
    if (write(2, text, std::char_traits<char>::length(text)) < 0) return;
}

void on_signal(int number) {
  keep();
  std::signal(number, SIG_DFL);
  std::raise(number);
}

class Changes {
public:
  Changes(std::vector<Input> seeds, std::uint64_t seed) : seeds_(std::move(seeds)), random_(seed) {}

  Input next() {
    Input input = seeds_.empty() ? noise() : pick(seeds_);
    for (int changes = 1 << below(5); changes > 0; --changes) change(input);
    if (input.size() > longest) input.resize(longest);
    return input;
  }

private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
  const Input& pick(const std::vector<Input>& list) { return list[below(list.size())]; }
  char byte() { return static_cast<char>(below(256)); }

  Input noise() {
    Input input(below(1024), '\0');
    for (char& one : input) one = byte();
    return input;
  }

  void change(Input& input) {
    static const std::vector<std::string> pieces = {
        "0",      "-1", "1e308", "-1e-308", "1e999", "nan",     "null",
        "true",   "{}", "[]",    "[[",      "\"\"",  "\\u0000", "9223372036854775808",
        "1e-100", "\n", ",",     ";",       "#",     "*"};
    const std::size_t at = below(input.size() + 1);
    const std::size_t some = std::min<std::size_t>(std::size_t{1} << below(7), input.size() - at);
    switch (below(9)) {
    case 0: // a bit
      if (at < input.size()) input[at] = static_cast<char>(input[at] ^ (1 << below(8)));
      break;
    case 1: // a byte
      if (at < input.size()) input[at] = byte();
      break;
    case 2: // bytes more
      for (std::size_t n = std::size_t{1} << below(7); n > 0; --n)
        input.insert(input.begin() + static_cast<std::ptrdiff_t>(at), byte());
      break;
    case 3:
      input.erase(at, some);
      break;
    case 4:
      input.insert(at, input.substr(below(input.size() + 1), some));
      break; // a part again elsewhere
    case 5:
      input.insert(at, pick(pieces));
      break;
    case 6: { // a number by another
      const std::size_t begin = input.find_first_of("0123456789", at);
      if (begin == Input::npos) break;
      const std::size_t end = std::min(input.find_first_not_of("0123456789.eE+-", begin), input.size());
      input.replace(begin, end - begin, pick(pieces));
      break;
    }
    case 7: // the rest of another seed
      if (!seeds_.empty()) {
        const Input& other = pick(seeds_);
        input = input.substr(0, at) + other.substr(below(other.size() + 1));
      }
      break;
    default:
      input.resize(at);
      break; // cut off
    }
  }

  std::vector<Input> seeds_;
  std::mt19937_64 random_;
};

Input read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

int main(int count, char** arguments) {
  namespace fs = std::filesystem;
  double seconds = 0;
  std::uint64_t runs = 0, seed = static_cast<std::uint64_t>(std::time(nullptr)) * 1000003 +
                                 static_cast<std::uint64_t>(getpid());
  unsigned timeout = 20;
  std::string prefix;
  std::vector<Input> seeds;
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    const std::size_t equals = argument.find('=');
    const std::string name = argument.substr(0, equals),
                      value = equals == std::string::npos ? "" : argument.substr(equals + 1);
    if (name == "-max_total_time")
      seconds = std::stod(value);
    else if (name == "-runs")
      runs = std::stoull(value);
    else if (name == "-seed")
      seed = std::stoull(value);
    else if (name == "-timeout")
      timeout = static_cast<unsigned>(std::stoul(value));
    else if (name == "-artifact_prefix")
      prefix = value;
    else if (argument.starts_with("-") || !fs::exists(argument)) {
      std::cerr << "neither an option of this driver nor a file: " << argument << "\n";
      return 2;
    } else if (fs::is_directory(argument)) {
      for (const fs::directory_entry& entry : fs::directory_iterator(argument)) seeds.push_back(read(entry));
    } else {
      seeds.push_back(read(argument));
    }
  }
  if (runs > 0 || seconds > 0) artifact = prefix + "crash-" + std::to_string(seed);
  for (const Input& one : seeds) longest = std::max(longest, 2 * one.size());
  for (const int number : {SIGABRT, SIGALRM, SIGSEGV, SIGFPE, SIGBUS, SIGILL})
    if (!__sanitizer_set_death_callback || number == SIGABRT || number == SIGALRM)
      std::signal(number, on_signal);
  if (__sanitizer_set_death_callback) __sanitizer_set_death_callback(keep);

  const auto look_at = [&](Input input) {
    present = std::move(input);
    alarm(timeout);
    // A copy of exactly its size: a read beyond it is seen by the address sanitizer.
    const std::vector<std::uint8_t> bytes(present.begin(), present.end());
    const std::uint8_t nothing = 0; // libFuzzer gives no null pointer either
    LLVMFuzzerTestOneInput(bytes.empty() ? &nothing : bytes.data(), bytes.size());
    alarm(0);
  };
  for (const Input& one : seeds) look_at(one);
  Changes changes(seeds, seed);
  std::uint64_t done = 0;
  const auto begin = std::chrono::steady_clock::now();
  const auto since = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  while ((runs > 0 || seconds > 0) && (runs == 0 || done < runs) && (seconds == 0 || since() < seconds)) {
    look_at(changes.next());
    ++done;
  }
  std::cout << seeds.size() << " seeds, " << done << " changes of them, -seed=" << seed << "\n";
  return 0;
}
