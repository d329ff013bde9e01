// SPDX-License-Identifier: BSD-3-Clause
#include "toolbox/solver.hpp"

#include <limits>
#include <new>

#include <dlfcn.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#ifdef ENTS_HOST_CHOLMOD
#include <Eigen/CholmodSupport>
#endif
#ifdef ENTS_HOST_UMFPACK
#include <Eigen/UmfPackSupport>
#endif

namespace host {
namespace {

/// CHOLMOD opens OpenMP regions of its own, whose threads wait for each other longer than they work on the
/// matrices of these scenes (westergaard: half the wall time without them). This program does not link with
/// OpenMP, but a library that it loads may; that one is asked to use one thread.
void keep_to_this_thread() {
  if (void* function = dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"))
    reinterpret_cast<void (*)(int)>(function)(0);
}

/// Factors of one iteration are freed before the next ones are made: memory that goes back to the system in
/// between is cleared by it each time, which takes up to a sixth of a scene's time.
void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

/// LU of a matrix with all its entries.
class GeneralSolver final : public LinearSolver {
public:
  /// @param lower  the matrices hold their lower triangle only
  explicit GeneralSolver(bool lower) : lower_(lower) {}
#ifdef ENTS_HOST_UMFPACK
  using Decomposition = Eigen::UmfPackLU<SparseMatrix>;
  std::string name() const override { return "UMFPACK LU"; }
#else
  using Decomposition = Eigen::SparseLU<SparseMatrix>;
  std::string name() const override { return "Eigen SparseLU"; }
#endif
  // UMFPACK chooses its strategy by the entries: analysed with zeros it gives wrong solutions without an
  // error.
  void analyze(const SparseMatrix&) override { analyzed_ = false; }
  bool factorize(const SparseMatrix& matrix) override {
    matrix_ = lower_ ? SparseMatrix(matrix.selfadjointView<Eigen::Lower>()) : matrix;
    return factorize();
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) override {
    Eigen::MatrixXd solution = lu_.solve(right_hand_sides);
    if (is_solution(solution, right_hand_sides)) return solution;
    analyzed_ = false; // the pivots that were chosen for other entries
    if (factorize()) solution = lu_.solve(right_hand_sides);
    if (!is_solution(solution, right_hand_sides))
      solution.setConstant(std::numeric_limits<double>::quiet_NaN());
    return solution;
  }

private:
  bool factorize() {
    if (!analyzed_) lu_.analyzePattern(matrix_);
    analyzed_ = true;
    lu_.factorize(matrix_);
#ifdef ENTS_HOST_UMFPACK
    if (lu_.umfpackFactorizeReturncode() == UMFPACK_ERROR_out_of_memory)
      throw std::bad_alloc(); // not a singular matrix
#endif
    return lu_.info() == Eigen::Success;
  }
  /// Of a matrix beside this one, nearer than 1e-9 of it.
  bool is_solution(const Eigen::MatrixXd& solution, const Eigen::MatrixXd& right_hand_sides) const {
    const double error = (matrix_ * solution - right_hand_sides).norm();
    return error <= 1e-9 * (matrix_.norm() * solution.norm() + right_hand_sides.norm());
  }

  Decomposition lu_;
  SparseMatrix
      matrix_; // of the factors: UMFPACK reads it again when it solves, and the caller's has changed then
  bool lower_, analyzed_ = false;
};

/// Cholesky of the lower triangle. A tangent that is symmetric and not positive definite (beyond a
/// bifurcation, or on the way there during Newton's iteration) goes to another solver.
class SymmetricSolver final : public LinearSolver {
public:
#ifdef ENTS_HOST_CHOLMOD
  struct Decomposition : Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Lower> {
    const int* order() const { return static_cast<const int*>(m_cholmodFactor->Perm); }
  };
  std::string name() const override { return "CHOLMOD supernodal Cholesky"; }
#else
  using Decomposition = Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower>;
  std::string name() const override { return "Eigen simplicial Cholesky"; }
#endif
  explicit SymmetricSolver(std::unique_ptr<LinearSolver> indefinite) : indefinite_(std::move(indefinite)) {
#ifdef ENTS_HOST_CHOLMOD
    cholesky_.cholmod().print = 0; // an indefinite matrix is no news for the terminal
#endif
  }
  void analyze(const SparseMatrix& matrix) override {
    cholesky_.analyzePattern(matrix);
    check_memory();
#ifdef ENTS_HOST_CHOLMOD
    indefinite_->take_order(cholesky_.order(), static_cast<int>(matrix.rows()));
#endif
    indefinite_->analyze(matrix);
  }
  bool factorize(const SparseMatrix& matrix) override {
    cholesky_.factorize(matrix);
    check_memory();
    definite_ = cholesky_.info() == Eigen::Success;
    return definite_ || indefinite_->factorize(matrix);
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) override {
    if (!definite_) return indefinite_->solve(right_hand_sides);
    return cholesky_.solve(right_hand_sides);
  }
  bool indefinite() const override { return !definite_; }

private:
  /// Without memory there are no factors, of an indefinite matrix neither; but it is no fault of the matrix.
  void check_memory() {
#ifdef ENTS_HOST_CHOLMOD
    const int status = cholesky_.cholmod().status;
    if (status == CHOLMOD_OUT_OF_MEMORY || status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
#endif
  }

  Decomposition cholesky_;
  std::unique_ptr<LinearSolver> indefinite_;
  bool definite_ = true;
};

} // namespace

std::unique_ptr<LinearSolver> LinearSolver::create(bool symmetric, std::unique_ptr<LinearSolver> indefinite) {
  keep_to_this_thread();
  keep_memory();
  if (!symmetric) return std::make_unique<GeneralSolver>(false);
  if (!indefinite) indefinite = std::make_unique<GeneralSolver>(true);
  return std::make_unique<SymmetricSolver>(std::move(indefinite));
}

} // namespace host
