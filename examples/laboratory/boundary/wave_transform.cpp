// SPDX-License-Identifier: BSD-3-Clause
#include "wave_transform.hpp"

#include <cmath>
#include <future>
#include <numbers>
#include <system_error>
#include <thread>
#include <vector>

#include <unsupported/Eigen/FFT>

namespace host {
namespace {

using std::numbers::pi;

using Complex = std::complex<double>;

Eigen::ArrayXd weights_of(Grid grid, Eigen::Index cells) {
  Eigen::ArrayXd weights = Eigen::ArrayXd::Ones(grid == Grid::nodes ? cells + 1 : cells);
  if (grid == Grid::nodes) weights[0] = weights[cells] = 0.5;
  return weights;
}

/// exp(i pi m / (2 n)), m = 0 .. n - 1: half a cell.
std::vector<Complex> half_cell(Eigen::Index n) {
  std::vector<Complex> turn;
  for (Eigen::Index m = 0; m < n; ++m)
    turn.push_back(std::polar(1., pi * static_cast<double>(m) / static_cast<double>(2 * n)));
  return turn;
}

/// Transforms along the columns. The even continuation of a column has real Fourier coefficients: two columns
/// are the real and the imaginary part of one transform.
class Columns {
public:
  Columns(Grid grid, Eigen::Index cells) : grid_(grid), n_(cells) {
    const auto size = static_cast<std::size_t>(2 * n_);
    if (grid_ == Grid::cells) turn_ = half_cell(n_);
    in_.resize(size), out_.resize(size);
  }

  /// Of forces, F^* f without the factors sqrt(a_m / n); nodes: what comes in is f over the weights, times 2.
  void forward(Eigen::ArrayXXd& columns, Eigen::Index begin, Eigen::Index end) {
    for_pairs(columns, begin, end, [this](auto&& in, auto&& out) {
      grid_ == Grid::nodes ? of_nodes(in, out) : of_cells(in, out);
    });
  }
  /// Back with the factors a_m / n, times n; nodes: times 2 n.
  void backward(Eigen::ArrayXXd& columns, Eigen::Index begin, Eigen::Index end) {
    for_pairs(columns, begin, end, [this](auto&& in, auto&& out) {
      grid_ == Grid::nodes ? of_nodes(in, out) : to_cells(in, out);
    });
  }

private:
  template <class Transform>
  void for_pairs(Eigen::ArrayXXd& columns, Eigen::Index begin, Eigen::Index end, const Transform& transform) {
    for (Eigen::Index j = begin; j < end; j += 2) {
      const bool pair = j + 1 < end;
      transform([&](Eigen::Index i) { return Complex(columns(i, j), pair ? columns(i, j + 1) : 0.); },
                [&](Eigen::Index i, const Complex& value) {
                  columns(i, j) = value.real();
                  if (pair) columns(i, j + 1) = value.imag();
                });
    }
  }
  Complex& in(Eigen::Index i) { return in_[static_cast<std::size_t>(i)]; }
  const Complex& out(Eigen::Index i) const { return out_[static_cast<std::size_t>(i)]; }
  const Complex& turn(Eigen::Index i) const { return turn_[static_cast<std::size_t>(i)]; }
  void transform() { fft_.fwd(out_.data(), in_.data(), 2 * n_); }

  template <class In, class Out> void of_nodes(const In& value, const Out& give) {
    for (Eigen::Index i = 0; i <= n_; ++i) {
      in(i) = value(i);
      if (i > 0 && i < n_) in(2 * n_ - i) = in(i);
    }
    transform();
    for (Eigen::Index i = 0; i <= n_; ++i) give(i, out(i));
  }
  template <class In, class Out> void of_cells(const In& value, const Out& give) {
    for (Eigen::Index i = 0; i < n_; ++i) in(i) = in(2 * n_ - 1 - i) = value(i);
    transform();
    for (Eigen::Index m = 0; m < n_; ++m) give(m, 0.5 * std::conj(turn(m)) * out(m));
  }
  template <class In, class Out> void to_cells(const In& value, const Out& give) {
    in(0) = value(0), in(n_) = 0;
    for (Eigen::Index m = 1; m < n_; ++m) { // the sum of both signs of m; the transform has exp(-i ...)
      const Complex mode = value(m);
      in(m) = mode * std::conj(turn(m)), in(2 * n_ - m) = mode * turn(m);
    }
    transform();
    for (Eigen::Index i = 0; i < n_; ++i) give(i, out(i));
  }

  Grid grid_;
  Eigen::Index n_;
  Eigen::FFT<double> fft_;
  std::vector<Complex> turn_, in_, out_;
};

/// All columns of a large field on two threads. The pairs are the same as on one: so are the bits.
template <class Work>
void for_columns(Grid grid, const Eigen::ArrayXXd& field, Eigen::Index cells, const Work& work) {
  const auto part = [&](Eigen::Index begin, Eigen::Index end) {
    Columns columns(grid, cells);
    work(columns, begin, end);
  };
  constexpr Eigen::Index large = 128 * 128;
  if (field.size() < large || std::thread::hardware_concurrency() < 2) return part(0, field.cols());
  const Eigen::Index middle = field.cols() / 4 * 2;
  std::future<void> other;
  try {
    other = std::async(std::launch::async, part, middle, field.cols());
  } catch (const std::system_error&) { // no second thread
    return part(0, field.cols());
  }
  part(0, middle);
  other.get();
}

/// Along both directions of a complex field.
void transform_periodic(Eigen::ArrayXXcd& field, bool back) {
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::Unscaled);
  for (int direction = 0; direction < 2; ++direction) {
    Eigen::VectorXcd column(field.rows());
    for (Eigen::Index j = 0; j < field.cols() && field.rows() > 1; ++j) { // one value is its own transform
      const Eigen::VectorXcd values = field.col(j);
      if (back)
        fft.inv(column.data(), values.data(), values.size());
      else
        fft.fwd(column.data(), values.data(), values.size());
      field.col(j) = column;
    }
    field = Eigen::ArrayXXcd(field.transpose());
  }
}

} // namespace

WaveTransform::WaveTransform(Grid grid, Eigen::Index nx, Eigen::Index ny)
    : grid_(grid), nx_(nx), ny_(ny),
      weights_(weights_of(grid, nx).matrix() * weights_of(grid, ny).matrix().transpose()) {}

double WaveTransform::half_waves(Eigen::Index mode, Eigen::Index cells) const {
  return static_cast<double>(grid_ == Grid::periodic ? 2 * std::min(mode, cells - mode) : mode);
}

Eigen::MatrixXd cosines(Grid grid, Eigen::Index n) {
  const Eigen::Index shift = grid == Grid::cells ? 1 : 0, count = grid == Grid::nodes ? n + 1 : n;
  Eigen::MatrixXd modes(count, count);
  for (Eigen::Index m = 0; m < count; ++m)
    for (Eigen::Index i = 0; i < count; ++i)
      modes(i, m) =
          std::sqrt((m == 0 || m == n ? 1. : 2.) / static_cast<double>(n)) *
          std::cos(pi * static_cast<double>(m * (2 * i + shift) % (4 * n)) / static_cast<double>(2 * n));
  return modes;
}

Eigen::ArrayXXd WaveTransform::filter(const Eigen::ArrayXXd& field,
                                      const Eigen::ArrayXXd& operator_of_modes) const {
  const double cells = static_cast<double>(nx_ * ny_);
  if (grid_ == Grid::periodic) {
    Eigen::ArrayXXcd spectrum = field.cast<Complex>();
    transform_periodic(spectrum, false);
    spectrum *= operator_of_modes / cells;
    transform_periodic(spectrum, true);
    return spectrum.real();
  }
  const auto forward = [&](Eigen::ArrayXXd& values, Eigen::Index cells_along) {
    for_columns(grid_, values, cells_along, [&](Columns& columns, Eigen::Index begin, Eigen::Index end) {
      columns.forward(values, begin, end);
    });
  };
  const auto backward = [&](Eigen::ArrayXXd& values, Eigen::Index cells_along) {
    for_columns(grid_, values, cells_along, [&](Columns& columns, Eigen::Index begin, Eigen::Index end) {
      columns.backward(values, begin, end);
    });
  };
  Eigen::ArrayXXd columns = field / weights_;
  forward(columns, nx_);
  Eigen::ArrayXXd rows = columns.transpose();
  forward(rows, ny_);
  rows *= operator_of_modes.transpose() / (grid_ == Grid::nodes ? 4 * cells : cells);
  backward(rows, ny_);
  columns = rows.transpose();
  backward(columns, nx_);
  return columns;
}

} // namespace host
