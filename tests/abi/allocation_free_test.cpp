// SPDX-License-Identifier: BSD-3-Clause
// Once a model exists nothing needs the heap, a lock or the kernel: not an evaluation, not its errors.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <mutex>

#include "support/element.hpp"
#include "support/memory.hpp"

#if ENTS_TEST_OWN_MALLOC
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace {

using namespace test;

// Everything a host does between reading its models and releasing them, errors included. All memory is there
// before.
class Work {
public:
  explicit Work(const ModelKind& kind) : model_(text(kind)), results_(model_.layout) {
    Random random(3);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < 4; ++i) elements_.push_back(draw(model_, basis(kind.basis), random));
    elements_[1][start].clear(); // searched
    elements_[2][slave][0] = nan;
    elements_[3][slave] = std::vector<double>(elements_[3][slave].size(), 1e9); // far away
    elements_.push_back(elements_[0]);
    elements_[4][master].assign(elements_[4][master].size(), 0.25); // degenerate
    state_.resize(static_cast<std::size_t>(model_.layout.state_size));
    xi_ = elements_[0][start];
    for (const Element& e : elements_) input_.push_back(input_of(e));
    output_ = output_of(results_, want_all);
    element_output_ = output_of(results_, want_element | want_values);
    surface_.struct_size = sizeof surface_;
    surface_.master = elements_[0][master].data();
    surface_.xi = xi_.data();
    surface_.point = results_.real[4].data();
    admissibility_.struct_size = sizeof admissibility_;
  }
  void run() {
    for (const ents_input& input : input_) {
      ents_evaluate(model_.get(), 0, 1, &input, &output_, &report_);
      ents_evaluate(model_.get(), 0, 1, &input, &element_output_, nullptr);
    }
    ents_evaluate(nullptr, 0, 1, &input_[0], &output_, &report_);
    ents_evaluate(model_.get(), 0, -1, &input_[0], &output_, &report_);
    ents_state_init(model_.get(), 1, state_.data(), model_.layout.state_size, &report_);
    ents_surface_evaluate(model_.get(), 1, &surface_, &report_);
    ents_model_layout(model_.get(), &model_.layout, &report_);
    admissibility_.samples = 5;
    ents_model_check(model_.get(), elements_[0][master].data(), nullptr, &admissibility_, &report_);
    ents_status_text(-7);
    ents_check_contract(9, 9, &report_);
  }

private:
  Model model_;
  Results results_;
  std::vector<Element> elements_;
  std::vector<double> state_, xi_;
  std::vector<ents_input> input_;
  ents_output output_, element_output_;
  ents_surface surface_{};
  ents_admissibility admissibility_{};
  ents_report report_ = new_report();
};

TEST(AllocationFree, NoHeapAndNoLocksInAnyEvaluation) {
  for (const ModelKind& kind : all_kinds()) {
    Work work(kind);
    memory_watch(1, 1); // and if anything did allocate, it would fail
    work.run();
    memory_unwatch();
    ASSERT_EQ(memory_allocations(), 0) << text(kind);
    ASSERT_EQ(memory_locks(), 0) << text(kind);
  }
}

#if ENTS_TEST_OWN_MALLOC
// In a process that may do nothing but read, write and exit, any other system call is deadly. (Not with a
// sanitizer, which makes system calls of its own.)
TEST(AllocationFree, NoSystemCallInAnyEvaluation) {
  const auto survives = [](auto&& act) {
    const pid_t child = fork();
    if (child == 0) {
      if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_STRICT) != 0) _exit(2);
      act();
      syscall(SYS_exit, 0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  };
  const int allowed = survives([] {});
  if (WIFEXITED(allowed) && WEXITSTATUS(allowed) == 2)
    return; // the system cannot restrict a process: nothing to learn
  ASSERT_TRUE(WIFEXITED(survives([] {})));
  ASSERT_TRUE(WIFSIGNALED(survives([] { getppid(); }))) << "the restriction does not work";
  for (const ModelKind& kind : some_kinds()) {
    Work work(kind);
    EXPECT_TRUE(WIFEXITED(survives([&] { work.run(); }))) << text(kind);
  }
}

TEST(AllocationFree, TheWatchSees) {
  memory_watch(0, 0);
  {
    std::mutex mutex;
    const std::lock_guard lock(mutex);
    const auto block = std::make_unique<double[]>(7);
  }
  memory_unwatch();
  EXPECT_EQ(memory_allocations(), 1);
  EXPECT_EQ(memory_locks(), 1);
  EXPECT_EQ(memory_left(), 0);
}
#endif

} // namespace
