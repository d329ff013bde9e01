// The enriched surface rho_e = rho + h n from its definition, independently of core.
#pragma once

#include <array>
#include <cmath>

#include "bases.hpp"
#include "heights.hpp"

namespace mechanics {

using Vec3 = std::array<double, 3>; // third entry 0 in 2D

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vec3 vec3(const double* v, int dimension) { return {v[0], v[1], dimension == 3 ? v[2] : 0.0}; }

class Surface {
public:
  struct Point {
    Vec3 point;  // rho_e
    Vec3 base;   // rho
    Vec3 normal; // n of rho
    double height;
  };

  // surface_coordinates may be null: s = xi. Nothing is copied but the pointers.
  Surface(const Basis& basis, const Height& height, const double* master, const double* surface_coordinates)
      : basis_(basis), height_(height), master_(master), coordinates_(surface_coordinates) {}

  Point at(const double* xi) const { return at(xi, shape_functions(basis_, xi)); }

  // With the shape functions of xi at hand
  Point at(const double* xi, const Shape& shape) const {
    Point p{};
    Vec3 tangent_1{}, tangent_2{};
    const int d = basis_.dimension;
    for (std::size_t i = 0; i < shape.value.size(); ++i) {
      const Vec3 x = vec3(master_ + d * static_cast<int>(i), d);
      p.base = p.base + shape.value[i] * x;
      tangent_1 = tangent_1 + shape.d1[i] * x;
      tangent_2 = tangent_2 + shape.d2[i] * x;
    }
    // in 2D the tangent turned by +90 degrees is t x (-e_z)
    const Vec3 m = cross(tangent_1, d == 3 ? tangent_2 : Vec3{0.0, 0.0, -1.0});
    p.normal = (1.0 / norm(m)) * m;
    const std::array<double, 2> s = coordinates(xi, shape.value);
    p.height = height_(s.data());
    p.point = p.base + p.height * p.normal;
    return p;
  }

  // s(xi)
  std::array<double, 2> coordinates(const double* xi, const std::vector<double>& shape) const {
    const int t = basis_.parameters();
    std::array<double, 2> s{};
    for (int a = 0; a < t; ++a) {
      const std::size_t k = static_cast<std::size_t>(a);
      if (!coordinates_)
        s[k] = xi[a];
      else
        for (std::size_t i = 0; i < shape.size(); ++i)
          s[k] += shape[i] * coordinates_[t * static_cast<int>(i) + a];
    }
    return s;
  }

private:
  const Basis& basis_;
  const Height& height_;
  const double* master_;
  const double* coordinates_;
};

} // namespace mechanics
