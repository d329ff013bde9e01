// A dense sweep of a segment, refined where it finds minima: finds what a search must find, without
// derivatives.
#pragma once

#include <algorithm>
#include <limits>

#include "surface.hpp"

namespace mechanics {

// Regular points of the natural domain with their shape functions, computed once per basis.
class Grid {
public:
  Grid(const Basis& basis, int points_per_direction) : basis_(basis), n_(points_per_direction) {
    for (int j = 0; j < (basis.dimension == 3 ? n_ : 1); ++j)
      for (int i = 0; i < n_; ++i) {
        std::array<double, 2> at = {place(i), basis.dimension == 3 ? place(j) : 0.0};
        xi.push_back(at);
        inside.push_back(!basis.simplex || at[0] + at[1] <= 1.0 + 1e-12);
        shape.push_back(shape_functions(basis, at.data()));
      }
  }

  double spacing() const { return place(1) - place(0); }
  int columns() const { return n_; }
  int rows() const { return basis_.dimension == 3 ? n_ : 1; }

  std::vector<std::array<double, 2>> xi;
  std::vector<bool> inside; // of a triangle
  std::vector<Shape> shape;

private:
  double place(int i) const {
    const double u = i / (n_ - 1.0);
    return basis_.simplex ? u : 2.0 * u - 1.0;
  }
  const Basis& basis_;
  int n_;
};

inline bool in_domain(const Basis& basis, const std::array<double, 2>& xi) {
  if (basis.simplex) return xi[0] >= 0.0 && xi[1] >= 0.0 && xi[0] + xi[1] <= 1.0;
  return std::max(std::fabs(xi[0]), std::fabs(xi[1])) <= 1.0;
}

struct Minimum {
  double distance = std::numeric_limits<double>::infinity();
  std::array<double, 2> xi{};
};

// The local minima of the distance from `slave`, refined, those of the best `most` samples; the closest
// first.
inline std::vector<Minimum> sweep_minima(const Grid& grid, const Basis& basis, const Surface& surface,
                                         const Vec3& slave, std::size_t most) {
  const auto distance = [&](const std::array<double, 2>& xi) {
    return in_domain(basis, xi) ? norm(slave - surface.at(xi.data()).point)
                                : std::numeric_limits<double>::infinity();
  };
  std::vector<double> sampled(grid.xi.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < sampled.size(); ++k)
    if (grid.inside[k]) sampled[k] = norm(slave - surface.at(grid.xi[k].data(), grid.shape[k]).point);
  std::vector<Minimum> minima;
  const int columns = grid.columns(), rows = grid.rows();
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const std::size_t own = static_cast<std::size_t>(j * columns + i);
      bool lowest = sampled[own] < std::numeric_limits<double>::infinity();
      for (int b = std::max(j - 1, 0); b <= std::min(j + 1, rows - 1); ++b)
        for (int a = std::max(i - 1, 0); a <= std::min(i + 1, columns - 1); ++a)
          lowest = lowest && sampled[own] <= sampled[static_cast<std::size_t>(b * columns + a)];
      if (lowest) minima.push_back({sampled[own], grid.xi[own]});
    }
  const auto closer = [](const Minimum& a, const Minimum& b) { return a.distance < b.distance; };
  std::sort(minima.begin(), minima.end(), closer);
  minima.resize(std::min(minima.size(), most));
  // Compass search: walk to the best of the neighbours, else halve the step. The distance is quadratic at its
  // minimum: steps of 3e-7 give it to 1e-12.
  for (Minimum& m : minima)
    for (double step = 0.5 * grid.spacing(); step > 3e-7;) {
      Minimum best = m;
      for (int b = rows > 1 ? -1 : 0; b <= (rows > 1 ? 1 : 0); ++b)
        for (int a = -1; a <= 1; ++a) {
          const std::array<double, 2> xi = {m.xi[0] + a * step, m.xi[1] + b * step};
          const double now = distance(xi);
          if (now < best.distance) best = {now, xi};
        }
      if (best.distance < m.distance)
        m = best;
      else
        step *= 0.5;
    }
  std::sort(minima.begin(), minima.end(), closer);
  return minima;
}

} // namespace mechanics
