// Height functions written a second time, from their definitions (golden/README.md) and the C library, and
// random ones.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "random.hpp"

namespace mechanics {

class Height {
public:
  // The "height" of a model; T surface coordinates
  Height(const nlohmann::json& text, int parameters);

  double operator()(const double* s) const;

  // Number of the cell that s lies in: between its knots a map is a polynomial. 0 for smooth heights.
  long cell(const double* s) const;

private:
  enum class Kind { none, constant, sine, polynomial, gaussian, map, thread, sum, product };
  double turns(const double* s) const;                                  // along the wave vector
  double spline(int a, double s, std::array<double, 4>& weights) const; // returns the first knot

  Kind kind_ = Kind::none;
  int parameters_;
  double value_ = 0.0, phase_ = 0.0, width_ = 1.0;
  std::vector<double> vector_;             // wave vector, center
  std::vector<std::vector<double>> table_; // polynomial [i][j]; spline coefficients [j][i]
  std::vector<double> origin_, spacing_;
  std::vector<int> count_;
  bool periodic_ = false;
  std::vector<Height> parts_;
};

// none constant sine polynomial gaussian sum product map thread
const std::vector<std::string>& height_kinds();

// A height of this kind on a segment of size 2 in s, |h| up to about 0.1: with radii of curvature of 0.2 and
// more it leaves penetrations of 0.1 one clear projection. With s in units of `unit` and h in units of
// `unit`.
nlohmann::json draw_height(Random& random, const std::string& kind, int parameters);

// Several waves across the segment, in one direction or two, or rough samples, or any of the above.
nlohmann::json draw_texture(Random& random, int parameters);

// The same surface in another unit of length: h times height_factor, s times coordinate_factor.
nlohmann::json rescale_height(const nlohmann::json& height, double height_factor, double coordinate_factor);

// -h
nlohmann::json negative_height(const nlohmann::json& height);

} // namespace mechanics
