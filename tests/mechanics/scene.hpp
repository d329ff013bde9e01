// Random contact elements, drawn like the golden vectors (moderately distorted segments, slave nodes near the
// surface), but in any orientation.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bases.hpp"
#include "library.hpp"
#include "random.hpp"
#include "surface.hpp"

namespace mechanics {

// What elements of one model have in common.
struct Scene {
  const Basis* basis = nullptr;
  nlohmann::json height;         // "height" of the model
  std::string projection;        // normal, shadow_point, shadow_direction
  Vec3 ray{};                    // emitter or direction
  bool with_coordinates = false; // elements carry surface coordinates of their own
  double stiffness = 1.0;        // of the penalty
  std::string tangent = "consistent";
  std::array<Vec3, 3> axes{}; // the segments lie near the plane of the first d-1 of them
  Vec3 origin{};

  nlohmann::json model() const; // with "contact"
};

inline constexpr const char* projections[] = {"normal", "shadow_point", "shadow_direction"};

Scene draw_scene(Random& random, const Basis& basis, const std::string& height_kind,
                 const std::string& projection);

// `count` elements whose slave node lies at a gap drawn from [gap_low, gap_high] over a random point in the
// segment's interior, and that point as start of the projection, up to 0.02.
Elements draw_elements(Random& random, const Scene& scene, const Model& model, std::int64_t count,
                       double gap_low, double gap_high);

// The dofs (slave, master nodes) of element e, and back.
std::vector<double> dofs_of(const Elements& elements, std::int64_t e, const Basis& basis);
void set_dofs(Elements& elements, std::int64_t e, const Basis& basis, const double* dofs);

} // namespace mechanics
