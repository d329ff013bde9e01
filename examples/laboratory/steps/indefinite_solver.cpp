// SPDX-License-Identifier: BSD-3-Clause
#include "indefinite_solver.hpp"

#ifdef ENTS_HOST_MUMPS
#include <limits>
#include <new>
#include <vector>

#include <dmumps_c.h>

namespace host {
namespace {

/// L D L^T of the lower triangle, with pivots of one or two rows.
class IndefiniteSolver final : public LinearSolver {
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
  ~IndefiniteSolver() override { call(-2); }
  IndefiniteSolver(const IndefiniteSolver&) = delete;
  IndefiniteSolver& operator=(const IndefiniteSolver&) = delete;

  std::string name() const override { return "MUMPS L D L^T"; }
  void analyze(const SparseMatrix& matrix) override {
    analyzed_ = false;
    general_->analyze(matrix);
  }
  void take_order(const int* order, int size) override {
    places_.resize(static_cast<std::size_t>(size));
    for (int k = 0; k < size; ++k) places_[static_cast<std::size_t>(order[k])] = k + 1;
    mumps_.icntl[6] = given, mumps_.perm_in = places_.data();
  }
  bool factorize(const SparseMatrix& matrix) override {
    matrix_ = matrix;
    has_factors_ = factorize();
    return has_factors_ || factorize_general();
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) override {
    Eigen::MatrixXd solution;
    if (has_factors_ && solve(right_hand_sides, solution)) return solution;
    if (has_factors_ && !factorize_general())
      return Eigen::MatrixXd::Constant(right_hand_sides.rows(), right_hand_sides.cols(),
                                       std::numeric_limits<double>::quiet_NaN());
    return general_->solve(right_hand_sides);
  }

private:
  /// @return false if the matrix is singular, or the factorisation is given up for another reason
  bool factorize() {
    if (!analyzed_) {
      rows_.clear(), columns_.clear();
      for (int column = 0; column < matrix_.outerSize(); ++column)
        for (SparseMatrix::InnerIterator entry(matrix_, column); entry; ++entry)
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
    const double error = (full * solution - right_hand_sides).norm();
    return mumps_.infog[0] >= 0 &&
           error <= 1e-9 * (matrix_.norm() * solution.norm() + right_hand_sides.norm());
  }
  bool factorize_general() {
    has_factors_ = false;
    return general_->factorize(SparseMatrix(matrix_.selfadjointView<Eigen::Lower>()));
  }

  static constexpr int use_comm_world = -987654, amd = 0, given = 1;
  void call(int job) {
    mumps_.job = job;
    dmumps_c(&mumps_);
    if (mumps_.infog[0] == -13) throw std::bad_alloc();
  }

  DMUMPS_STRUC_C mumps_{};
  SparseMatrix matrix_;
  std::vector<int> rows_, columns_; ///< of the entries, from 1
  std::vector<int> places_;         ///< of the rows among the pivots, from 1
  bool analyzed_ = false, has_factors_ = false;
  std::unique_ptr<LinearSolver> general_ = LinearSolver::create(false);
};

} // namespace

std::unique_ptr<LinearSolver> indefinite_solver() { return std::make_unique<IndefiniteSolver>(); }

} // namespace host
#else
std::unique_ptr<host::LinearSolver> host::indefinite_solver() { return nullptr; }
#endif
