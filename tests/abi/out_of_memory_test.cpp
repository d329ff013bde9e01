// SPDX-License-Identifier: BSD-3-Clause
// Memory that runs out at the k-th allocation, for every k: a status, a null handle, nothing leaked, nothing
// thrown, and the next attempt succeeds.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "support/element.hpp"
#include "support/memory.hpp"

namespace out_of_memory_test {
namespace {

using namespace test;

using Create = std::function<int32_t(ents_model**, ents_report*)>;

// `create` succeeds when nothing fails.
void fail_every_allocation(const Create& create) {
  ents_report report = new_report();
  ents_model* model = nullptr;
  ASSERT_EQ(create(&model, &report), ENTS_OK)
      << report.message; // what is set up once in a process is set up now
  call::model_destroy(&model, nullptr);

  memory_watch(0, 0);
  create(&model, &report);
  call::model_destroy(&model, nullptr);
  memory_unwatch();
  const long all = memory_allocations();
  EXPECT_EQ(memory_left(), 0) << "a model that lives and dies leaves memory behind";
  ASSERT_GT(all, 10);

  for (const int forever : {0, 1})
    for (long k = 1; k <= all; ++k) {
      model = reinterpret_cast<ents_model*>(&report); // to be set to null
      memory_watch(k, forever);
      const int32_t status = create(&model, &report);
      memory_unwatch();
      ASSERT_EQ(status, ENTS_NO_MEMORY) << "allocation " << k << " of " << all << ": " << report.message;
      ASSERT_EQ(model, nullptr);
      ASSERT_EQ(report.status, status);
      ASSERT_STREQ(report.message, "out of memory");
      ASSERT_EQ(memory_left(), 0) << "leaked when allocation " << k << " of " << all << " failed";
    }
  EXPECT_EQ(create(&model, &report), ENTS_OK) << report.message;
  EXPECT_EQ(call::model_destroy(&model, &report), ENTS_OK);
}

Create from_text(const std::string& text) {
  return [text](ents_model** model, ents_report* report) {
    return ents_model_create(text.c_str(), -1, nullptr, nullptr, 0, model, report);
  };
}

TEST(OutOfMemory, EveryKindOfModel) {
  for (const ModelKind& kind :
       {ModelKind{"quad4", "none"}, ModelKind{"tri6", "sum", "shadow_point"},
        ModelKind{"line2", "polynomial"},
        ModelKind{"bspline16", "product", "shadow_direction", R"(, "tangent": "small_gap")"}}) {
    SCOPED_TRACE(kind.basis + " " + kind.height);
    fail_every_allocation(from_text(text(kind)));
  }
}

TEST(OutOfMemory, HeightMapsInTheText) {
  fail_every_allocation(from_text(text({"quad4", "map"})));
  fail_every_allocation(from_text(text({"line2", "map"})));
}

const std::string named_map =
    R"({"segment": "quad4", "height": {"type": "map", "data": "scan", "boundary": "periodic",)"
    R"( "size": [2, 2]}})";

TEST(OutOfMemory, HeightMapsInTheCallersMemory) {
  const double values[6] = {0.1, 0.2, 0.3, 0.1, 0.0, 0.2};
  ents_data data{};
  data.struct_size = sizeof data;
  data.name = "scan";
  data.values = values;
  data.rows = 2;
  data.columns = 3;
  fail_every_allocation([&](ents_model** model, ents_report* report) {
    return ents_model_create(named_map.c_str(), -1, nullptr, &data, 1, model, report);
  });
}

// A folder of its own for the files of a test.
class Folder {
public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              (std::string("ents_out_of_memory_") +
               testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return (path_ / name).string();
  }
  std::string name() const { return path_.string(); }

private:
  std::filesystem::path path_;
};

TEST(OutOfMemory, HeightMapsAndModelsInFiles) {
  const Folder folder;
  folder.write(
      "scan.txt",
      "# Width: 2.0 m\n# Height: 2.0 m\n# Value units: m\n0.1\t0.2\t0.1\n0.3\t0.1\t0.0\n0.2 0.1 0.1\n");
  const std::string text =
      R"({"segment": "quad4", "height": {"type": "map", "file": "scan.txt", "boundary": "clamped"}})";
  const std::string path = folder.write("model.json", text), directory = folder.name();
  fail_every_allocation([&](ents_model** model, ents_report* report) {
    return ents_model_create(text.c_str(), -1, directory.c_str(), nullptr, 0, model, report);
  });
  fail_every_allocation([&](ents_model** model, ents_report* report) {
    return ents_model_create_from_file(path.c_str(), model, report);
  });
}

// A message about another mistake needs memory, too: it becomes that status or "out of memory", never
// anything else.
TEST(OutOfMemory, WhileReportingAnotherMistake) {
  const std::pair<const char*, int32_t> texts[] = {
      {R"({"segment": "quad4", "hight": null})", ENTS_UNKNOWN_KEY},
      {R"({"segment": "quad5"})", ENTS_BAD_VALUE},
      {R"({"segment": "quad4",, })", ENTS_JSON_SYNTAX},
      {R"({"segment": "line2", "height": {"type": "map", "file": "nowhere.txt", "boundary": "clamped", "size": [1]}})",
       ENTS_FILE},
  };
  for (const auto& [text, expected] : texts) {
    SCOPED_TRACE(text);
    bool complete = false;
    for (long k = 1; !complete && k < 10000; ++k) {
      ents_model* model = nullptr;
      ents_report report = new_report();
      memory_watch(k, 0);
      const int32_t status = ents_model_create(text, -1, nullptr, nullptr, 0, &model, &report);
      memory_unwatch();
      complete = memory_allocations() < k;
      ASSERT_EQ(model, nullptr);
      ASSERT_EQ(memory_left(), 0) << k;
      ASSERT_TRUE(status == expected || (!complete && status == ENTS_NO_MEMORY))
          << status << " at " << k << ": " << report.message;
    }
    EXPECT_TRUE(complete);
  }
}

// The check of a whole surface allocates: the same there.
TEST(OutOfMemory, SurfaceCheck) {
  const int64_t connectivity[] = {0, 1, 1, 2};
  const double positions[] = {0, 0, 1, 0, 1.5, 1}; // a concave corner: a crossing, and two projections
  ents_master_mesh mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.segments = 2, mesh.nodes = 3;
  mesh.connectivity = connectivity, mesh.positions = positions;
  for (const char* projection :
       {R"({"type": "normal"})", R"({"type": "shadow_direction", "direction": [1, 1]})"}) {
    const Model model(
        std::string(R"({"segment": "line2", "height": {"type": "constant", "value": 0.1}, "projection": )") +
        projection + "}");
    const auto check = [&](ents_report* report) {
      ents_surface_admissibility result{};
      result.struct_size = sizeof result;
      result.reach = 0.5;
      return ents_surface_check(model.get(), &mesh, &result, report);
    };
    ents_report report = new_report();
    ASSERT_EQ(check(&report), ENTS_OK) << report.message;
    memory_watch(0, 0);
    check(&report);
    memory_unwatch();
    const long all = memory_allocations();
    EXPECT_EQ(memory_left(), 0);
    ASSERT_GT(all, 10);
    for (const int forever : {0, 1})
      for (long k = 1; k <= all; ++k) {
        memory_watch(k, forever);
        const int32_t status = check(&report);
        memory_unwatch();
        ASSERT_EQ(status, ENTS_NO_MEMORY) << "allocation " << k << " of " << all << ": " << report.message;
        ASSERT_EQ(memory_left(), 0) << "leaked when allocation " << k << " of " << all << " failed";
      }
    EXPECT_EQ(check(&report), ENTS_OK);
  }
}

// The counters themselves: they see an allocation, and one that fails.
TEST(OutOfMemory, TheWatchSees) {
  memory_watch(2, 0);
  void* first = ::operator new(8);
  bool threw = false;
  try {
    ::operator delete(::operator new(8));
  } catch (const std::bad_alloc&) {
    threw = true;
  }
  memory_unwatch();
  EXPECT_TRUE(threw);
  EXPECT_EQ(memory_left(), 1);
  EXPECT_GE(memory_allocations(), 2);
  ::operator delete(first);
}

} // namespace
} // namespace out_of_memory_test
