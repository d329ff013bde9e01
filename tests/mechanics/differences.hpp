// Directional derivatives of what the library returns, by central differences of fourth order:
//   f'(u) v = [ 8 (f(u + t v) - f(u - t v)) - (f(u + 2 t v) - f(u - 2 t v)) ] / (12 t) + t^4 / 30 f^(5)
#pragma once

#include <vector>

#include "scene.hpp"
#include "worst.hpp"

namespace mechanics {

inline constexpr int stencil_points = 4;
inline constexpr double stencil_offsets[stencil_points] = {-2.0, -1.0, 1.0, 2.0};

// One random direction per element, all dofs, entries in -1 .. 1.
inline std::vector<double> draw_directions(Random& random, std::int64_t count, int dofs) {
  std::vector<double> v(static_cast<std::size_t>(count * dofs));
  for (double& entry : v) entry = random.uniform(-1.0, 1.0);
  return v;
}

// Elements u + offset v for every offset, [count][offsets]; projected from `start`, so that all stay with the
// projection of the element in the middle.
inline Elements displaced(const Elements& centres, const Basis& basis, const std::vector<double>& directions,
                          const std::vector<double>& offsets, const std::vector<double>& start) {
  const std::size_t n = static_cast<std::size_t>(centres.count), points = offsets.size();
  const std::size_t dofs = static_cast<std::size_t>(basis.dofs()),
                    t = static_cast<std::size_t>(basis.parameters());
  const std::size_t d = static_cast<std::size_t>(basis.dimension), md = dofs - d, mt = md / d * t;
  Elements out;
  out.count = static_cast<std::int64_t>(n * points);
  out.slave.resize(n * points * d);
  out.master.resize(n * points * md);
  const auto repeat = [&](const std::vector<double>& from, std::vector<double>& to, std::size_t entries) {
    if (from.empty()) return;
    to.reserve(n * points * entries);
    for (std::size_t e = 0; e < n; ++e)
      for (std::size_t k = 0; k < points; ++k)
        to.insert(to.end(), from.data() + e * entries, from.data() + (e + 1) * entries);
  };
  repeat(centres.surface_coordinates, out.surface_coordinates, mt);
  repeat(centres.area, out.area, 1);
  repeat(start, out.start, t);
  for (std::size_t e = 0; e < n; ++e)
    for (std::size_t k = 0; k < points; ++k) {
      const double* v = &directions[e * dofs];
      for (std::size_t i = 0; i < d; ++i)
        out.slave[(e * points + k) * d + i] = centres.slave[e * d + i] + offsets[k] * v[i];
      for (std::size_t i = 0; i < md; ++i)
        out.master[(e * points + k) * md + i] = centres.master[e * md + i] + offsets[k] * v[d + i];
    }
  return out;
}

inline Elements stencil(const Elements& centres, const Basis& basis, const std::vector<double>& directions,
                        double t, const std::vector<double>& start) {
  std::vector<double> offsets;
  for (const double offset : stencil_offsets) offsets.push_back(offset * t);
  return displaced(centres, basis, directions, offsets, start);
}

// f: value at the first stencil point; those at the next ones lie `stride` entries apart.
inline double difference(const double* f, std::size_t stride, double t) {
  return (8.0 * (f[2 * stride] - f[stride]) - (f[3 * stride] - f[0])) / (12.0 * t);
}

// (matrix . v)_i of a symmetric matrix
inline double times_direction(const double* matrix, const double* v, std::size_t n, std::size_t i) {
  double sum = 0.0;
  for (std::size_t j = 0; j < n; ++j) sum += matrix[i * n + j] * v[j];
  return sum;
}

inline double largest_entry(const double* v, std::size_t n) {
  double m = 0.0;
  for (std::size_t i = 0; i < n; ++i) test::raise(m, std::fabs(v[i]));
  return m;
}

// Do all points first .. first + count - 1 lie in the same cell of the height's map? Between two cells its
// third derivative jumps, and no difference converges faster than that allows.
inline bool in_one_cell(const Height& height, const Basis& basis, const Elements& points,
                        const Results& at_points, std::size_t first, std::size_t count) {
  const std::size_t t = static_cast<std::size_t>(basis.parameters()),
                    m = static_cast<std::size_t>(basis.node_count());
  long cell = 0;
  for (std::size_t k = first; k < first + count; ++k) {
    const double* coordinates =
        points.surface_coordinates.empty() ? nullptr : &points.surface_coordinates[k * m * t];
    const double* xi = &at_points.xi[k * t];
    const Surface surface(basis, height, nullptr, coordinates);
    const std::array<double, 2> s = surface.coordinates(xi, shape_values(basis, xi));
    const long now = height.cell(s.data());
    if (k > first && now != cell) return false;
    cell = now;
  }
  return true;
}

} // namespace mechanics
