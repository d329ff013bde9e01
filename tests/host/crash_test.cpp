// SPDX-License-Identifier: BSD-3-Clause
// A run that is killed, whose disk is full, or whose checkpoint was damaged: no checkpoint is lost, a restart
// ends with the same bits, and the series of results is whole. `host_crash_test --long` tries 500 kills, 50
// full disks, 100000 mutations.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <thread>

#include <fcntl.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "output_folder.hpp"
#include "program.hpp"
#include "restart.hpp"
#include "sliding.hpp"

namespace host::test::crash_test {
namespace {

namespace fs = std::filesystem;

struct Counts {
  int kills = 12, full_disks = 4, mutations = 2000;
} counts;

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A block that is pressed on a slab and dragged over several of its segments: friction and its history.
Json scene_json() {
  Json json = sliding(penalty, coulomb);
  json["steps"]["values"] = {{{"to", 1}, {"count", 2}}, {{"to", 3}, {"count", 14}}};
  return json;
}
constexpr int steps = 16;

/// A program that runs beside this one.
class Process {
public:
  /// @param largest  size of the files that it can write, in bytes; 0: as large as they are
  Process(const std::vector<std::string>& arguments, const fs::path& output, rlim_t largest = 0)
      : output_(output) {
    std::vector<char*> words;
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    id_ = fork();
    if (id_ != 0) return;
    const int to = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    dup2(to, STDOUT_FILENO);
    dup2(to, STDERR_FILENO);
    const rlimit limit{largest, largest};
    if (largest > 0) setrlimit(RLIMIT_FSIZE, &limit);
    execv(words[0], words.data());
    _exit(127);
  }
  void kill_it() const { kill(id_, SIGKILL); }
  /// @return its exit code; -1: a signal
  int wait() const {
    int status = 0;
    waitpid(id_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string text() const { return bytes_of(output_); }

private:
  fs::path output_;
  pid_t id_;
};

class Crash : public testing::Test {
protected:
  Crash()
      : root_(fs::temp_directory_path() / ("ents_crash_" + std::to_string(getpid()))),
        whole_(root_ / "whole") {
    fs::remove_all(root_);
    fs::create_directories(root_);
    std::ofstream(root_ / "scene.json") << scene_json().dump();
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(run(whole_).wait(), 0);
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    for (const auto& entry : fs::directory_iterator(whole_))
      if (entry.path().extension() == ".vtu" || entry.path().extension() == ".pvd")
        series_[entry.path().filename()] = bytes_of(entry.path());
    fingerprint_ = parse_json_file(whole_ / "result.json").at("fingerprint").get<std::string>();
  }
  ~Crash() override { fs::remove_all(root_); }

  Process run(const fs::path& out, const fs::path& restart = {}, rlim_t largest = 0) const {
    std::vector<std::string> words{ENTS_HOST,       "run",   (root_ / "scene.json").string(),
                                   "--no-pictures", "--out", out.string()};
    if (!restart.empty()) words.insert(words.end(), {"--restart", restart.string()});
    return {words, root_ / "output.txt", largest};
  }
  /// The last step that result.pvd lists; 0: there is none.
  static int last_listed(const fs::path& folder) {
    const std::string text = bytes_of(folder / "result.pvd");
    int last = 0;
    for (int step = 1; step <= steps; ++step) {
      char name[32];
      std::snprintf(name, sizeof name, "result_bulk_%04d.vtu", step);
      if (text.find(name) != text.npos) last = step;
    }
    return last;
  }
  /// The files of this run are those of a run that was not stopped.
  void expect_whole(const fs::path& folder, const std::string& what) const {
    EXPECT_EQ(parse_json_file(folder / "result.json").at("fingerprint"), fingerprint_) << what;
    for (const auto& [name, bytes] : series_)
      EXPECT_EQ(bytes_of(folder / name) == bytes, true) << what << ": " << name;
  }

  fs::path root_, whole_;
  std::map<std::string, std::string> series_; ///< file name -> what it holds
  std::string fingerprint_;
  double seconds_ = 0;
};

TEST_F(Crash, KilledAtRandomMoments) {
  Random random(1);
  const fs::path out = root_ / "out", checkpoint = out / checkpoint_name;
  int kills = 0, restarts = 0, runs = 0;
  while (kills < counts.kills && !HasFailure()) { // a run is killed until it gets to its end
    fs::remove_all(out);
    double patience = 1; // longer where the machine has other work to do and a run does not get on
    std::string before;
    for (bool ended = false; !ended && !HasFailure(); ++runs) {
      const bool restart = fs::exists(checkpoint);
      restarts += restart;
      // After its last checkpoint a run has its result to write: the step before it leads there once more.
      const bool solved = restart && parse_json_file(checkpoint).at("step") == steps;
      const Process process = run(out, solved    ? out / checkpoint_before_name
                                       : restart ? checkpoint
                                                 : fs::path());
      const double wait = random.uniform(0, 0.5) * seconds_ * patience;
      std::this_thread::sleep_for(std::chrono::duration<double>(wait));
      if (kills < counts.kills) process.kill_it(); // the last one may end
      const int code = process.wait();
      const std::string what = "kill " + std::to_string(kills);
      ended = code == 0;
      kills += code == -1;
      ASSERT_TRUE(ended || code == -1) << what << ": " << process.text();
      ASSERT_EQ(process.text().find("warning"), std::string::npos) << what << ": " << process.text();
      if (last_listed(out) > 1) {
        ASSERT_TRUE(fs::exists(checkpoint)) << what;
      }
      const std::string now = bytes_of(checkpoint);
      patience = now == before ? 1.3 * patience : 1;
      before = now;
    }
    if (fs::exists(out / "result.json")) expect_whole(out, "after " + std::to_string(kills) + " kills");
  }
  std::printf("%d kills of %d runs, %d restarts from a checkpoint\n", kills, runs, restarts);
  EXPECT_GT(restarts, counts.kills / 4); // else it is not checkpoints that were tried
}

TEST_F(Crash, FullDisks) {
  Random random(2);
  const fs::path disk = root_ / "disk";
  fs::create_directories(disk);
  const bool mounted = mount("ents", disk.c_str(), "tmpfs", 0, "size=1m") == 0;
  if (mounted) umount(disk.c_str());
  double bytes = 0, largest = 0;
  for (const auto& entry : fs::directory_iterator(whole_)) {
    bytes += static_cast<double>(entry.file_size());
    largest = std::max(largest, static_cast<double>(entry.file_size()));
  }
  int checkpoints = 0;
  for (int i = 0; i < counts.full_disks && !HasFailure(); ++i) {
    const std::string what = "disk " + std::to_string(i);
    const fs::path out = disk / "out";
    const auto room = static_cast<rlim_t>(random.uniform(0.1, 0.95) * (mounted ? bytes : largest));
    if (mounted) {
      ASSERT_EQ(mount("ents", disk.c_str(), "tmpfs", 0, ("size=" + std::to_string(room)).c_str()), 0);
    } else {
      fs::remove_all(out);
    }
    const Process full = run(out, {}, mounted ? 0 : room);
    const int code = full.wait();
    const std::string text = full.text();
    EXPECT_EQ(code, 1) << what << text;
    EXPECT_NE(text.find("wall time"), std::string::npos) << what << text; // the table all the same
    EXPECT_NE(text.find(mounted ? "No space left" : "File too large"), std::string::npos) << what << text;
    EXPECT_TRUE(last_listed(out) < 2 || fs::exists(out / checkpoint_name)) << what << text;
    for (const auto& entry : fs::directory_iterator(out))
      EXPECT_NE(entry.path().extension(), ".new") << what << entry.path();
    if (mounted) {
      ASSERT_EQ(mount("ents", disk.c_str(), "tmpfs", MS_REMOUNT, "size=64m"), 0);
    }
    if (fs::exists(out / checkpoint_name)) { // the newest, elsewhere: no work is lost
      ++checkpoints;
      const fs::path other = root_ / "other";
      const bool finished = parse_json_file(out / checkpoint_name).at("step") == steps;
      const Process rest = run(other, out / checkpoint_name);
      EXPECT_EQ(rest.wait(), finished ? 2 : 0) << what << rest.text();
      if (!finished) {
        EXPECT_EQ(parse_json_file(other / "result.json").at("fingerprint"), fingerprint_) << what;
      }
      fs::remove_all(other);
    }
    // Here, as the message says: the files that are missing are written, too.
    const auto named = text.rfind("--restart ");
    fs::path restart;
    if (named != text.npos) restart = text.substr(named + 10, text.find(' ', named + 10) - named - 10);
    const Process again = run(out, restart);
    EXPECT_EQ(again.wait(), 0) << what << again.text();
    EXPECT_EQ(again.text().find("warning"), std::string::npos) << what << again.text();
    expect_whole(out, what + " " + restart.string() + "\n" + text);
    if (mounted) umount2(disk.c_str(), MNT_DETACH);
  }
  std::printf("%d full disks (%s), %d with a checkpoint\n", counts.full_disks,
              mounted ? "tmpfs" : "limit on files", checkpoints);
  EXPECT_GE(checkpoints, counts.full_disks / 4);
}

/// The text with bytes flipped, replaced, taken away, doubled or put elsewhere.
std::string mutated(std::string text, Random& random) {
  const auto below = [&](std::size_t end) {
    return std::min(static_cast<std::size_t>(random.uniform(0, static_cast<double>(end))), end - 1);
  };
  for (auto times = 1 + below(3); times > 0 && text.size() > 20; --times) {
    const std::size_t at = below(text.size()), length = std::min(1 + below(20), text.size() - at);
    switch (below(7)) {
    case 0:
      text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
      break;
    case 1:
      text[at] = static_cast<char>(below(256));
      break;
    case 2:
      text[at] = static_cast<char>('0' + below(10));
      break;
    case 3:
      text.erase(at, length);
      break;
    case 4:
      text.insert(at, text.substr(at, length));
      break;
    case 5:
      text.insert(below(text.size()), text.substr(at, length));
      break;
    default:
      text.resize(at);
      break;
    }
  }
  return text;
}

TEST_F(Crash, MutatedCheckpoints) {
  Random random(3);
  const Scene scene = read_scene(root_ / "scene.json");
  Simulation simulation(scene, &library());
  const fs::path file = root_ / checkpoint_name;
  StepPlan half;
  half.last = steps / 2;
  solve(simulation, {}, half);
  const std::string good = checkpoint_text(simulation, half.last), fingerprint = simulation.fingerprint();
  int same = 0, accepted = 0;
  for (int i = 0; i < counts.mutations && !HasFailure(); ++i) {
    const std::string text = mutated(good, random);
    fs::remove(file); // to write over a file waits for the disk
    std::ofstream(file, std::ios::binary) << text;
    try {
      EXPECT_EQ(read_checkpoint(file, simulation), half.last);
      (text == good ? same : accepted) += 1;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(checkpoint_name), std::string::npos) << error.what();
    }
    EXPECT_EQ(simulation.fingerprint(), fingerprint) << "mutation " << i; // refused: nothing has changed
  }
  std::printf("%d mutations, %d of them change nothing, %d only how numbers and spaces are written\n",
              counts.mutations, same, accepted);
  std::ofstream(file, std::ios::binary) << good;
  EXPECT_EQ(read_checkpoint(file, simulation), half.last);
}

// What stands beside it is named.
TEST_F(Crash, ADamagedOrLastCheckpointNamesTheOneBefore) {
  const fs::path checkpoint = whole_ / checkpoint_name;
  const Process finished = run(whole_, checkpoint);
  EXPECT_EQ(finished.wait(), 2);
  for (const std::string& word :
       {std::string("the run is finished"), (whole_ / checkpoint_before_name).string()})
    EXPECT_NE(finished.text().find(word), std::string::npos) << finished.text();
  std::string text = bytes_of(checkpoint);
  text[text.find("\"motion\":") + 9] = '1';
  std::ofstream(checkpoint, std::ios::binary) << text;
  const Process refused = run(whole_, checkpoint);
  EXPECT_EQ(refused.wait(), 2);
  for (const std::string& word :
       {checkpoint.string() + ": the checkpoint is damaged", (whole_ / checkpoint_before_name).string()})
    EXPECT_NE(refused.text().find(word), std::string::npos) << refused.text();
  const Process before = run(whole_, whole_ / checkpoint_before_name);
  EXPECT_EQ(before.wait(), 0) << before.text();
  expect_whole(whole_, "from the checkpoint before");
}

TEST_F(Crash, TwoRunsDoNotWriteIntoOneFolder) {
  const std::map<std::string, std::string> before = series_;
  {
    const OutputFolder first(whole_);
    const Process second = run(whole_);
    EXPECT_EQ(second.wait(), 2);
    EXPECT_NE(
        second.text().find("--out: " + whole_.string() + ": another ents-lab is writing into this folder"),
        std::string::npos)
        << second.text();
    expect_whole(whole_, "beside the second run"); // nothing was removed
  }
  EXPECT_EQ(run(whole_).wait(), 0);
}

} // namespace
} // namespace host::test::crash_test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  for (int i = 1; i < argc; ++i)
    if (std::string(argv[i]) == "--long") host::test::crash_test::counts = {500, 50, 100000};
  return RUN_ALL_TESTS();
}
