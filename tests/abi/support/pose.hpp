// SPDX-License-Identifier: BSD-3-Clause
// Three sizes times three rotations in which every degenerate or borderline case gets the same verdict.
#pragma once

#include <functional>

#include <gtest/gtest.h>

#include "sample_count.hpp"
#include "support/element.hpp"

namespace test {

struct Pose {
  double size;
  Rotation turn;
};

// Three sizes times three rotations.
inline std::vector<Pose> poses(int d) {
  std::vector<Pose> all;
  for (const double size : {1e-6, 1.0, 1e6})
    for (const Rotation& turn : {rotation(d, 0.0, 0.0), rotation(d, 0.7, -1.1), rotation(d, 2.9, 2.3)})
      all.push_back({size, turn});
  if (sample_divisor > 1) return {all[4]}; // turned, of unit size
  return all;
}

// The element as drawn in unit size in the plane of the first axes, in a pose.
inline Element posed(Element e, const Pose& pose, int d) {
  for (const int i : {slave, master})
    for (std::size_t k = 0; k < e[i].size(); k += static_cast<std::size_t>(d)) {
      for (std::size_t c = 0; c < static_cast<std::size_t>(d); ++c) e[i][k + c] *= pose.size;
      pose.turn.apply(&e[i][k], d);
    }
  return e;
}

inline std::string vector_text(const std::vector<double>& v) {
  std::string text = "[";
  for (std::size_t i = 0; i < v.size(); ++i) text += (i ? ", " : "") + number(v[i]);
  return text + "]";
}

// A model whose lengths and ray are in the pose. Heights as in support/model.hpp.
inline Model
model_in(const Pose& pose, const Basis& b, const std::string& height_kind, const std::string& projection_kind,
         const std::string& more = "",
         const std::string& contact = R"({"normal": {"type": "penalty", "stiffness": 1000.0}})") {
  const int d = b.dimension;
  std::vector<double> ray = d == 2 ? std::vector<double>{0.2, 1.0} : std::vector<double>{0.2, -0.1, 1.0};
  std::string way = R"({"type": "normal"})";
  if (projection_kind == "shadow_point") {
    for (double& r : ray) r *= 9.0 * pose.size;
    pose.turn.apply(ray.data(), d);
    way = R"({"type": "shadow_point", "emitter": )" + vector_text(ray) + "}";
  } else if (projection_kind == "shadow_direction") {
    pose.turn.apply(ray.data(), d);
    way = R"({"type": "shadow_direction", "direction": )" + vector_text(ray) + "}";
  }
  return Model(R"({"segment": ")" + std::string(b.name) + R"(", "height": )" +
               height(height_kind, d, pose.size) + R"(, "projection": )" + way + R"(, "contact": )" +
               contact + more + "}");
}

// Every basis, with and without height, every projection, every pose.
inline void everywhere(
    const std::function<void(const Basis&, const std::string&, const std::string&, const Pose&)>& visit) {
  for (const Basis& b : bases())
    for (const char* h : {"none", "sine"})
      for (const std::string& p : projection_kinds())
        for (const Pose& pose : poses(b.dimension)) {
          SCOPED_TRACE(std::string(b.name) + " " + h + " " + p + " size " + number(pose.size));
          visit(b, h, p, pose);
        }
}

inline bool all_zero(const std::vector<double>& v) {
  for (const double x : v)
    if (x != 0.0) return false;
  return true;
}

inline std::vector<double> above_centre(const Basis& b, double gap) {
  std::vector<double> x = centre(b);
  x.push_back(gap);
  return x;
}

} // namespace test
