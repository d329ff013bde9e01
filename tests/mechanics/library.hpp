// The library as these tests use it: arrays of elements in, arrays of results out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ents.hpp"

namespace mechanics {

inline ents_report new_report() { return ents::make<ents_report>(); }

// Inputs of `count` elements, one after the other; an array that is empty is not given to the library.
struct Elements {
  std::int64_t count = 0;
  std::vector<double> slave;               // [count][d]
  std::vector<double> master;              // [count][m][d]
  std::vector<double> surface_coordinates; // [count][m][d-1]
  std::vector<double> start;               // [count][d-1]
  std::vector<double> area;                // [count]
};

inline constexpr std::int32_t kinematics = ENTS_XI | ENTS_GAP | ENTS_NORMAL_GAP | ENTS_NORMAL |
                                           ENTS_GAP_GRADIENT | ENTS_GAP_HESSIAN | ENTS_XI_GRADIENT |
                                           ENTS_XI_HESSIAN;

// Outputs of `count` elements; only what was wanted has entries.
struct Results {
  std::int32_t status = 0; // of the call
  std::vector<std::int32_t> statuses, flags, iterations;
  std::vector<double> xi, gap, normal_gap, normal, point;
  std::vector<double> gap_gradient, gap_hessian, xi_gradient, xi_hessian;
  std::vector<double> energy, pressure, residual, tangent;

  bool ok(std::int64_t e) const { return statuses[static_cast<std::size_t>(e)] == ENTS_OK; }
  bool has_flag(std::int64_t e, std::int32_t flag) const {
    return (flags[static_cast<std::size_t>(e)] & flag) != 0;
  }
};

class Model {
public:
  // Throws std::runtime_error with the library's message when the text is refused.
  explicit Model(const std::string& text);

  int dimension() const { return model_.layout().dimension; }
  int nodes() const { return model_.layout().nodes; }
  int parameters() const { return model_.layout().parameters; }
  int dofs() const { return model_.layout().dofs; }
  const ents_model* handle() const { return model_.get(); }

  // Throws std::runtime_error on a negative status; recoverable ones are in `statuses`.
  void evaluate(const Elements& elements, std::int32_t wanted, Results& results) const;
  Results evaluate(const Elements& elements, std::int32_t wanted) const;

private:
  ents::Model model_;
};

// Points of one segment's enriched surface.
struct SurfacePoints {
  std::int32_t status = 0;
  std::vector<double> point, normal, height, base_point, base_normal;
};
// xi [count][d-1]; surface_coordinates may be null
SurfacePoints evaluate_surface(const Model& model, const double* master, const double* surface_coordinates,
                               const std::vector<double>& xi);

ents_admissibility check_admissibility(const Model& model, const std::vector<double>& master,
                                       const std::vector<double>& surface_coordinates, int samples);

} // namespace mechanics
