// SPDX-License-Identifier: BSD-3-Clause
// Once a model exists nothing needs the heap, a lock or the kernel: not an evaluation, not its errors.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <mutex>

#include "support/batch.hpp"
#include "support/memory.hpp"

#if ENTS_TEST_OWN_MALLOC
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace allocation_free_test {
namespace {

using namespace test;

// Everything a host does between reading its models and releasing them, errors included. All memory is there
// before.
class Work {
public:
  explicit Work(const ModelKind& kind) : Work(kind, Random(3)) {}
  Work(const ModelKind& kind, Random random)
      : model_(text(kind)), results_(model_.layout),
        many_(model_, draw_batch(model_, basis(kind.basis), random, true), 0, 0, in_blocks) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < 4; ++i) elements_.push_back(draw(model_, basis(kind.basis), random));
    elements_[1][start].clear(); // searched
    elements_[2][slave][0] = nan;
    elements_[3][slave] = std::vector<double>(elements_[3][slave].size(), 1e9); // far away
    elements_.push_back(elements_[0]);
    elements_[4][master].assign(elements_[4][master].size(), 0.25); // degenerate
    for (std::vector<double>* state : {&state_, &begin_, &end_, &moved_}) {
      state->resize(static_cast<std::size_t>(model_.layout.state_size));
      ents_state_init(model_.get(), 1, state->data(), model_.layout.state_size, nullptr);
    }
    xi_ = elements_[0][start];
    for (const Element& e : elements_) input_.push_back(input_of(e));
    output_ = output_of(results_, want_all);
    element_output_ = output_of(results_, want_element | want_values);
    surface_.struct_size = sizeof surface_;
    surface_.master = elements_[0][master].data();
    surface_.xi = xi_.data();
    surface_.point = results_.real[4].data();
    admissibility_.struct_size = sizeof admissibility_;
    for (int i = 0; i < model_.layout.nodes; ++i) connectivity_.push_back(i);
    mesh_.struct_size = sizeof mesh_;
    mesh_.segments = 1, mesh_.connectivity = connectivity_.data();
    mesh_.nodes = model_.layout.nodes, mesh_.positions = elements_[0][master].data();
    int64_t size = 0;
    ents_tree_size(model_.get(), 1, &size, nullptr);
    tree_.resize(static_cast<std::size_t>(size));
    ents_tree_build(model_.get(), &mesh_, tree_.data(), size, nullptr);
    detection_.struct_size = sizeof detection_;
    detection_.slave = elements_[0][slave].data(), detection_.reach = 1;
    detection_.segment = &segment_, detection_.xi = xi_.data(), detection_.flags = &found_;
    prepare_system();
  }
  void run() {
    for (const ents_input& input : input_) {
      ents_evaluate(model_.get(), 0, 1, &input, &output_, &report_);
      ents_evaluate(model_.get(), 0, 1, &input, &element_output_, nullptr);
    }
    done_.many +=
        ents_evaluate(model_.get(), 0, batch_size, &many_.input, &many_.output, &report_) >= ENTS_OK;
    ents_evaluate(nullptr, 0, 1, &input_[0], &output_, &report_);
    ents_evaluate(model_.get(), 0, -1, &input_[0], &output_, &report_);
    ents_state_init(model_.get(), 1, state_.data(), model_.layout.state_size, &report_);
    ents_surface_evaluate(model_.get(), 1, &surface_, &report_);
    ents_model_layout(model_.get(), &model_.layout, &report_);
    admissibility_.samples = 5;
    ents_model_check(model_.get(), elements_[0][master].data(), nullptr, &admissibility_, &report_);
    ents_tree_refit(model_.get(), &mesh_, tree_.data(), static_cast<int64_t>(tree_.size()), &report_);
    double boxes[6];
    ents_surface_boxes(model_.get(), &mesh_, boxes, &report_);
    for (const int64_t before : {-1, 0}) {
      segment_ = before;
      ents_detect(model_.get(), &mesh_, tree_.data(), static_cast<int64_t>(tree_.size()), 0, 1, &detection_,
                  &report_);
    }
    iterate();
    ents_status_text(-7);
    ents_check_contract(9, 9, &report_);
  }

  // What of an iteration ended in ENTS_OK
  struct Done {
    int many = 0, combined = 0, assembled = 0, iterated = 0, augmented = 0, transferred = 0;
  };
  const Done& done() const { return done_; }

private:
  // The host's nodes: the slave, then those of the master; each of its points is one of them. All is coupled
  // with all.
  void prepare_system() {
    const int64_t d = model_.layout.dimension, m = model_.layout.nodes, dofs = d * (1 + m);
    rows_ = dofs + model_.layout.multipliers;
    positions_ = elements_[0][slave];
    positions_.insert(positions_.end(), elements_[0][master].begin(), elements_[0][master].end());
    points_.resize(elements_[0][master].size());
    weights_.assign(static_cast<std::size_t>(m), 1.0);
    residual_.resize(static_cast<std::size_t>(rows_));
    values_.resize(static_cast<std::size_t>(rows_ * rows_));
    places_.resize(static_cast<std::size_t>(d * (1 + m) * (1 + m) + 1));
    for (int64_t i = 0; i <= m; ++i) numbers_.push_back(i);
    for (int64_t i = 0; i < rows_; ++i) equations_.push_back(i);
    for (int64_t i = 0; i <= rows_; ++i) row_begin_.push_back(i * rows_);
    for (int64_t i = 0; i < rows_ * rows_; ++i) columns_.push_back(i % rows_);
    slave_point_.struct_size = control_points_.struct_size = sizeof slave_point_;
    slave_point_.points = 1, control_points_.points = m;
    slave_point_.begin = control_points_.begin = numbers_.data();
    slave_point_.nodes = numbers_.data(), control_points_.nodes = numbers_.data() + 1;
    slave_point_.weights = control_points_.weights = weights_.data();
    for (ents_system* system : {&by_points_, &by_nodes_}) {
      system->struct_size = sizeof *system, system->index_size = 8;
      system->multiplier_equations = equations_.data() + dofs;
      system->rows = rows_, system->residual = residual_.data(), system->values = values_.data();
      system->row_begin = row_begin_.data(), system->columns = columns_.data();
    }
    by_points_.slave = &slave_point_, by_points_.master = &control_points_;
    by_points_.slave_nodes = by_points_.master_nodes = 1 + m;
    by_points_.slave_equations = by_points_.master_equations = equations_.data();
    by_nodes_.slave_nodes = 1, by_nodes_.slave_equations = equations_.data();
    by_nodes_.master_nodes = m, by_nodes_.master_equations = equations_.data() + d;
    by_nodes_.places = places_.data(), by_nodes_.places_size = static_cast<int64_t>(places_.size());
    found_input_ = input_[0];
    found_input_.slave = found_input_.master = found_input_.surface_coordinates = found_input_.start =
        nullptr;
    found_input_.state_begin = begin_.data(), found_input_.state_begin_stride = model_.layout.state_size;
    found_output_.struct_size = sizeof found_output_;
    found_output_.wanted = ENTS_STATE;
    found_output_.state_end = end_.data(), found_output_.state_end_stride = model_.layout.state_size;
  }

  void iterate() {
    const ents_model* model = model_.get();
    const int64_t m = model_.layout.nodes, size = model_.layout.state_size;
    ents_input input = found_input_;
    input.slave = elements_[0][slave].data(), input.mesh = &mesh_, input.segment = &segment_,
    input.segment_stride = 1;
    done_.combined += ents_combine(&control_points_, model_.layout.dimension, 1 + m, positions_.data(),
                                   points_.data(), &report_) == ENTS_OK;
    for (ents_system* system : {&by_points_, &by_nodes_, &by_nodes_}) { // finds places, then uses them
      done_.assembled += ents_assemble(model, 0, 1, &input, &found_output_, system, &report_) == ENTS_OK;
      done_.iterated += ents_iterate(model, &mesh_, tree_.data(), static_cast<int64_t>(tree_.size()), 0, 1,
                                     &detection_, &found_input_, &found_output_, system, &report_) == ENTS_OK;
    }
    by_nodes_.rows = 1; // too few for the equations
    ents_assemble(model, 0, 1, &input, &found_output_, &by_nodes_, &report_);
    by_nodes_.rows = rows_;
    done_.augmented +=
        ents_state_augment(model, 1, begin_.data(), size, end_.data(), size, &report_) == ENTS_OK;
    const double* nodes = elements_[0][master].data();
    done_.transferred += ents_state_transfer(model, nodes, nullptr, nodes, nullptr, end_.data(),
                                             moved_.data(), &report_) == ENTS_OK;
  }

  Model model_;
  Results results_;
  Batch many_;
  std::vector<Element> elements_;
  std::vector<double> state_, begin_, end_, moved_, xi_, tree_, positions_, points_, weights_, residual_,
      values_;
  std::vector<int64_t> connectivity_, numbers_, equations_, row_begin_, columns_, places_;
  int64_t segment_ = -1, rows_ = 0;
  int32_t found_ = 0;
  ents_combination slave_point_{}, control_points_{};
  ents_system by_points_{}, by_nodes_{};
  ents_input found_input_{};
  ents_output found_output_{};
  Done done_;
  ents_master_mesh mesh_{};
  ents_detection detection_{};
  std::vector<ents_input> input_;
  ents_output output_, element_output_;
  ents_surface surface_{};
  ents_admissibility admissibility_{};
  ents_report report_ = new_report();
};

TEST(AllocationFree, NoHeapAndNoLocksInAnyEvaluation) {
  Work::Done all;
  int kinds = 0;
  for (const ModelKind& kind : all_kinds()) {
    Work work(kind);
    memory_watch(1, 1); // and if anything did allocate, it would fail
    work.run();
    memory_unwatch();
    ASSERT_EQ(memory_allocations(), 0) << text(kind);
    ASSERT_EQ(memory_locks(), 0) << text(kind);
    ++kinds;
    all.many += work.done().many, all.combined += work.done().combined,
        all.assembled += work.done().assembled, all.iterated += work.done().iterated;
    all.augmented += work.done().augmented, all.transferred += work.done().transferred;
  }
  // All but what a law refuses: to iterate with friction, to augment what has no multipliers
  EXPECT_EQ(all.many, kinds);
  EXPECT_EQ(all.combined, kinds);
  EXPECT_EQ(all.assembled, 3 * kinds);
  EXPECT_GT(all.iterated, kinds);
  EXPECT_GT(all.augmented, kinds / 10);
  EXPECT_GT(all.transferred, kinds / 2);
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
    GTEST_SKIP() << "this system cannot restrict a process to reading, writing and leaving (seccomp)";
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
} // namespace allocation_free_test
