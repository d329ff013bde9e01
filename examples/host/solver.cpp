// SPDX-License-Identifier: BSD-3-Clause
#include "solver.hpp"

#include <limits>
#include <new>
#include <vector>

#include <dlfcn.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#ifdef ENTS_HOST_CHOLMOD
#include <Eigen/CholmodSupport>
#endif
#ifdef ENTS_HOST_UMFPACK
#include <Eigen/UmfPackSupport>
#endif
#ifdef ENTS_HOST_MUMPS
#include <dmumps_c.h>
#endif

namespace host {
namespace {

using Matrix = SparseSystem::Matrix;

/// CHOLMOD opens OpenMP regions of its own, whose threads wait for each other longer than they work on the
/// matrices of these scenes (westergaard: half the wall time without them). This program does not link with
/// OpenMP, but a library that it loads may; that one is asked to use one thread.
void keep_to_this_thread() {
  if (void* function = dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"))
    reinterpret_cast<void (*)(int)>(function)(0);
}

/// The solution is that of a matrix beside this one, nearer than 1e-9 of it.
template <class AnyMatrix>
bool solves(const AnyMatrix& matrix, double norm, const Eigen::MatrixXd& solution,
            const Eigen::MatrixXd& right_hand_sides) {
  const double error = (matrix * solution - right_hand_sides).norm();
  return error <= 1e-9 * (norm * solution.norm() + right_hand_sides.norm());
}

/// LU of a matrix with all its entries.
class GeneralSolver final : public LinearSolver {
public:
#ifdef ENTS_HOST_UMFPACK
  using Decomposition = Eigen::UmfPackLU<Matrix>;
  std::string name() const override { return "UMFPACK LU"; }
#else
  using Decomposition = Eigen::SparseLU<Matrix>;
  std::string name() const override { return "Eigen SparseLU"; }
#endif
  // UMFPACK chooses its strategy by the entries: analysed with zeros it gives wrong solutions without an
  // error.
  void analyze(const Matrix&) override { analyzed_ = false; }
  bool factorize(const Matrix& matrix) override {
    if (&matrix != &matrix_) matrix_ = matrix;
    if (!analyzed_) lu_.analyzePattern(matrix_);
    analyzed_ = true;
    lu_.factorize(matrix_);
#ifdef ENTS_HOST_UMFPACK
    if (lu_.umfpackFactorizeReturncode() == UMFPACK_ERROR_out_of_memory)
      throw std::bad_alloc(); // not a singular matrix
#endif
    return lu_.info() == Eigen::Success;
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) override {
    Eigen::MatrixXd solution = lu_.solve(right_hand_sides);
    const double norm = matrix_.norm();
    if (solves(matrix_, norm, solution, right_hand_sides)) return solution;
    analyzed_ = false; // the pivots that were chosen for other entries
    if (factorize(matrix_)) solution = lu_.solve(right_hand_sides);
    if (!solves(matrix_, norm, solution, right_hand_sides))
      solution.setConstant(std::numeric_limits<double>::quiet_NaN());
    return solution;
  }

private:
  Decomposition lu_;
  Matrix matrix_; // of the factors: UMFPACK reads it again when it solves, and the caller's has changed then
  bool analyzed_ = false;
};

#ifdef ENTS_HOST_MUMPS
/// L D L^T of the lower triangle, with pivots of one or two rows.
class IndefiniteSolver {
public:
  IndefiniteSolver() {
    mumps_.par = 1, mumps_.sym = 2, mumps_.comm_fortran = use_comm_world;
    call(-1);
    for (int stream = 0; stream < 4; ++stream) mumps_.icntl[stream] = stream < 3 ? -1 : 0; // no messages
    // Of the pattern alone: with entries in it the factors would depend on the matrix that came first, and a
    // run that was restarted would end with other bits. The ordering of SCOTCH is another one in every run.
    mumps_.icntl[5] = 0, mumps_.icntl[11] = 1;
    mumps_.icntl[6] = amd;
  }
  ~IndefiniteSolver() { call(-2); }
  IndefiniteSolver(const IndefiniteSolver&) = delete;
  IndefiniteSolver& operator=(const IndefiniteSolver&) = delete;

  void forget_pattern() { analyzed_ = false; }
  /// From now on with this ordering of the rows: [equations], the first pivot first.
  void set_order(const int* order, int size) {
    places_.resize(static_cast<std::size_t>(size));
    for (int k = 0; k < size; ++k) places_[static_cast<std::size_t>(order[k])] = k + 1;
    mumps_.icntl[6] = given, mumps_.perm_in = places_.data();
  }

  /// @return false if the matrix is singular, or the factorisation is given up for another reason
  bool factorize(const Matrix& matrix) {
    matrix_ = matrix;
    if (!analyzed_) {
      rows_.clear(), columns_.clear();
      for (int column = 0; column < matrix_.outerSize(); ++column)
        for (Matrix::InnerIterator entry(matrix_, column); entry; ++entry)
          rows_.push_back(static_cast<int>(entry.row()) + 1), columns_.push_back(column + 1);
      mumps_.n = static_cast<int>(matrix_.rows());
      mumps_.nnz = matrix_.nonZeros();
      mumps_.irn = rows_.data(), mumps_.jcn = columns_.data();
      call(1);
      analyzed_ = mumps_.infog[0] >= 0;
      if (!analyzed_) return false;
    }
    mumps_.a = matrix_.valuePtr();
    // Memory is estimated before pivots are known: -8 and -9 ask for more of it, in per cent.
    constexpr int most_percent = 2000;
    do {
      call(2);
      if (mumps_.infog[0] != -8 && mumps_.infog[0] != -9) break;
      mumps_.icntl[13] *= 2;
    } while (mumps_.icntl[13] < most_percent);
    return mumps_.infog[0] >= 0;
  }
  /// @return false if that is no solution
  bool solve(const Eigen::MatrixXd& right_hand_sides, Eigen::MatrixXd& solution) {
    solution = right_hand_sides;
    mumps_.rhs = solution.data();
    mumps_.nrhs = static_cast<int>(solution.cols()), mumps_.lrhs = static_cast<int>(solution.rows());
    call(3);
    const auto full = matrix_.selfadjointView<Eigen::Lower>();
    return mumps_.infog[0] >= 0 && solves(full, matrix_.norm(), solution, right_hand_sides);
  }
  /// The matrix of the factors.
  const Matrix& matrix() const { return matrix_; }

private:
  static constexpr int use_comm_world = -987654, amd = 0, given = 1;
  void call(int job) {
    mumps_.job = job;
    dmumps_c(&mumps_);
    if (mumps_.infog[0] == -13) throw std::bad_alloc();
  }

  DMUMPS_STRUC_C mumps_{};
  Matrix matrix_;
  std::vector<int> rows_, columns_; ///< of the entries, from 1
  std::vector<int> places_;         ///< of the rows among the pivots, from 1
  bool analyzed_ = false;
};
#endif

/// Cholesky of the lower triangle. A tangent that is symmetric and not positive definite (beyond a
/// bifurcation, on the way there during Newton's iteration, or with multipliers) goes to L D L^T, which takes
/// a tenth of the time of LU; to LU where that fails.
class SymmetricSolver final : public LinearSolver {
public:
#ifdef ENTS_HOST_CHOLMOD
  struct Decomposition : Eigen::CholmodSupernodalLLT<Matrix, Eigen::Lower> {
    const int* order() const { return static_cast<const int*>(m_cholmodFactor->Perm); }
  };
  std::string name() const override { return "CHOLMOD supernodal Cholesky"; }
  SymmetricSolver() { cholesky_.cholmod().print = 0; } // an indefinite matrix is no news for the terminal
#else
  using Decomposition = Eigen::SimplicialLLT<Matrix, Eigen::Lower>;
  std::string name() const override { return "Eigen simplicial Cholesky"; }
#endif
  void analyze(const Matrix& matrix) override {
    cholesky_.analyzePattern(matrix);
    check_memory();
    analyzed_general_ = false;
#ifdef ENTS_HOST_MUMPS
    indefinite_.forget_pattern();
#ifdef ENTS_HOST_CHOLMOD
    indefinite_.set_order(cholesky_.order(), static_cast<int>(matrix.rows()));
#endif
#endif
  }
  bool factorize(const Matrix& matrix) override {
    cholesky_.factorize(matrix);
    check_memory();
    factors_ = Factors::cholesky;
    if (cholesky_.info() == Eigen::Success) return true;
#ifdef ENTS_HOST_MUMPS
    factors_ = Factors::indefinite;
    if (indefinite_.factorize(matrix)) return true;
#endif
    return factorize_general(matrix);
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) override {
    if (factors_ == Factors::cholesky) return cholesky_.solve(right_hand_sides);
#ifdef ENTS_HOST_MUMPS
    if (Eigen::MatrixXd solution;
        factors_ == Factors::indefinite && indefinite_.solve(right_hand_sides, solution))
      return solution;
    if (factors_ == Factors::indefinite && !factorize_general(indefinite_.matrix()))
      return Eigen::MatrixXd::Constant(right_hand_sides.rows(), right_hand_sides.cols(),
                                       std::numeric_limits<double>::quiet_NaN());
#endif
    return general_.solve(right_hand_sides);
  }

private:
  /// Without memory there are no factors, of an indefinite matrix neither; but it is no fault of the matrix.
  void check_memory() {
#ifdef ENTS_HOST_CHOLMOD
    const int status = cholesky_.cholmod().status;
    if (status == CHOLMOD_OUT_OF_MEMORY || status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
#endif
  }

  bool factorize_general(const Matrix& matrix) {
    factors_ = Factors::general;
    const Matrix full = matrix.selfadjointView<Eigen::Lower>();
    if (!analyzed_general_) general_.analyze(full);
    analyzed_general_ = true;
    return general_.factorize(full);
  }

  enum class Factors { cholesky, indefinite, general };
  Factors factors_ = Factors::cholesky;
  Decomposition cholesky_;
#ifdef ENTS_HOST_MUMPS
  IndefiniteSolver indefinite_;
#endif
  GeneralSolver general_;
  bool analyzed_general_ = false;
};

} // namespace

std::unique_ptr<LinearSolver> LinearSolver::create(bool symmetric) {
  keep_to_this_thread();
  if (symmetric) return std::make_unique<SymmetricSolver>();
  return std::make_unique<GeneralSolver>();
}

} // namespace host
