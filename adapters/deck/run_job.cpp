// SPDX-License-Identifier: BSD-3-Clause
#include "run_job.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

namespace ents_deck {
namespace {

using std::string;
using Path = std::filesystem::path;

constexpr int most_runs = 12;
constexpr const char* log_name = "ccx.log";

string program_of(const RunRequest& request) {
  if (!request.ccx.empty()) {
    if (!std::filesystem::exists(request.ccx))
      throw Error("--ccx " + request.ccx + ": there is no such program");
    return std::filesystem::absolute(request.ccx).string();
  }
  std::error_code error;
  const Path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const Path beside = self.parent_path().parent_path() / "calculix" / "ccx_ents";
  if (!error && std::filesystem::exists(beside)) return beside.string();
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (string folder; std::getline(folders, folder, ':');)
    if (std::filesystem::exists(Path(folder) / "ccx_ents")) return (Path(folder) / "ccx_ents").string();
  throw Error(
      "ccx_ents, which is ccx with U1E, is neither beside this program nor on the search path: sh "
      "adapters/calculix/run.sh --only-build builds it (of the packages: ents-ccx), or name it with --ccx");
}

string last_line(const Path& file) {
  std::ifstream stream(file, std::ios::binary);
  string out;
  for (string line; std::getline(stream, line);)
    if (line.find_first_of("0123456789") != string::npos) out = line;
  return out;
}

/// The line of ccx's .sta as words: step, increment, attempt, iterations, total time ...
string progress(const Path& sta) {
  std::istringstream words(last_line(sta));
  string step, increment, attempt, iterations, time;
  if (!(words >> step >> increment >> attempt >> iterations >> time)) return "";
  return "step " + step + ", increment " + increment + ", time " + time;
}

/// Solves the job, with a line about each increment where one is done. @return ccx's exit status is 0
bool solve(const string& program, const Path& folder, const string& job) {
  for (const char* end : {".sta", ".dat", ".frd"}) std::filesystem::remove(folder / (job + end));
  const string command = "cd " + quoted(folder.string()) + " && " + quoted(program) + " " + quoted(job) +
                         " > " + log_name + " 2>&1";
  std::atomic<int> status{-1};
  std::thread ccx([&] { status = std::system(command.c_str()) == 0 ? 0 : 1; });
  string shown_last;
  for (bool running = true; running;) {
    running = status < 0;
    if (const string now = progress(folder / (job + ".sta")); !now.empty() && now != shown_last) {
      std::printf("          %s\n", now.c_str());
      std::fflush(stdout);
      shown_last = now;
    }
    if (running) std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  ccx.join();
  return status == 0;
}

/// What ccx said: its first error, else its last words.
string complaint(const Path& log) {
  std::ifstream stream(log, std::ios::binary);
  string error, last;
  for (string line; std::getline(stream, line);) {
    if (line.find_first_not_of(" \r") == string::npos) continue;
    if (error.empty() && line.find("*ERROR") != string::npos) error = line;
    last = line;
  }
  return string(trimmed(error.empty() ? last : error));
}

} // namespace

string quoted(const string& word) {
  string out = "'";
  for (const char c : word) out += c == '\'' ? string("'\\''") : string(1, c);
  return out + "'";
}

WantedSlides wanted_slides(const Path& folder) {
  WantedSlides out;
  std::ifstream stream(folder / "ents_slide.txt", std::ios::binary);
  for (string line; std::getline(stream, line);) {
    std::istringstream words(line);
    string step, increment, kind, points, pair;
    double beyond = 0, slide = 0;
    if (line.starts_with('#') || !(words >> step >> increment >> kind >> points >> beyond >> slide)) continue;
    std::getline(words >> std::ws, pair);
    double& largest = (kind == "open" ? out.open : out.pressed)[pair];
    largest = std::max(largest, slide);
  }
  return out;
}

int run_job(RunRequest request, const std::function<void(const Options&, bool)>& write) {
  const string program = program_of(request), job = request.options.deck.stem().string();
  for (int run = 1; run <= most_runs; ++run) {
    write(request.options, run == 1);
    std::filesystem::remove(request.out / "ents_slide.txt");
    std::printf("run %d     %s %s\n", run, program.c_str(), job.c_str());
    std::fflush(stdout);
    const bool solved = solve(program, request.out, job);
    const WantedSlides wanted = wanted_slides(request.out);
    if (solved) {
      for (const auto& [pair, slide] : wanted.open)
        std::printf(
            "note      pair %s: some slave points were open beside their patches; none was pressed into the "
            "master there (ents_slide.txt)\n",
            pair.c_str());
      std::printf("solved    %s\n", (request.out / (job + ".frd")).string().c_str());
      return 0;
    }
    const string log = (request.out / log_name).string();
    bool grows = false;
    for (const auto& [pair, pressed] : wanted.pressed) {
      const auto open = wanted.open.find(pair);
      const double slide = open == wanted.open.end() ? pressed : std::max(pressed, open->second);
      double& now = request.options.slides[pair];
      if (slide <= 1.01 * now) continue;
      std::printf("          pair %s: slave points have left their patches; their slide is %s now\n",
                  pair.c_str(), shown(slide).c_str());
      now = slide;
      grows = true;
    }
    if (grows) continue;
    std::fprintf(stderr, "ents-deck: %s did not solve the job: %s (whole output: %s)\n", program.c_str(),
                 complaint(log).c_str(), log.c_str());
    return 1;
  }
  std::fprintf(stderr,
               "ents-deck: after %d runs slave points still leave their patches (%s); write --slide\n",
               most_runs, (request.out / "ents_slide.txt").string().c_str());
  return 1;
}

} // namespace ents_deck
