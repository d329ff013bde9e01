// SPDX-License-Identifier: BSD-3-Clause
// Models for the tests of the C ABI: every basis, every kind of height, every projection.
#pragma once

#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/caller.hpp"

namespace test {

inline ents_report new_report() { return ents::make<ents_report>(); }

// 17 significant digits name a double.
inline std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// A model with its text, called by such a host.
class Model {
public:
  explicit Model(const std::string& text) : text_(text), model_(made(text)), layout(model_.layout()) {}
  const ents_model* get() const { return model_.get(); }
  const std::string& text() const { return text_; }

private:
  static ents::Model made(const std::string& text) try {
    return ents::Model(text, "", {}, call::library());
  } catch (const ents::Error& error) {
    throw std::runtime_error(std::string(error.what()) + " in " + text);
  }
  std::string text_;
  ents::Model model_;

public:
  ents_layout layout;
};

struct Basis {
  const char* name;
  int dimension;
  bool simplex;
  std::vector<std::vector<double>> nodes; // natural coordinates of each node
};

// The node order is that of the README of the golden vectors: corners, mid-sides, centre; rows of patches.
inline const std::vector<Basis>& bases() {
  static const std::vector<Basis> all = [] {
    const std::vector<std::vector<double>> corners = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    std::vector<std::vector<double>> quad8 = corners, quad9, patch;
    quad8.insert(quad8.end(), {{0, -1}, {1, 0}, {0, 1}, {-1, 0}});
    quad9 = quad8;
    quad9.push_back({0, 0});
    for (const double y : {-3, -1, 1, 3})
      for (const double x : {-3, -1, 1, 3}) patch.push_back({x, y});
    const std::vector<std::vector<double>> row = {{-3}, {-1}, {1}, {3}};
    return std::vector<Basis>{
        {"line2", 2, false, {{-1}, {1}}},
        {"line3", 2, false, {{-1}, {1}, {0}}},
        {"catmull_rom4", 2, false, row},
        {"bspline4", 2, false, row},
        {"tri3", 3, true, {{0, 0}, {1, 0}, {0, 1}}},
        {"tri6", 3, true, {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}},
        {"quad4", 3, false, corners},
        {"quad8", 3, false, quad8},
        {"quad9", 3, false, quad9},
        {"catmull_rom16", 3, false, patch},
        {"bspline16", 3, false, patch},
    };
  }();
  return all;
}

inline const Basis& basis(const std::string& name) {
  for (const Basis& b : bases())
    if (name == b.name) return b;
  throw std::runtime_error("no basis " + name);
}

inline const std::vector<std::string>& height_kinds() {
  static const std::vector<std::string> kinds = {"none",     "constant",   "sine",    "polynomial",
                                                 "gaussian", "map",        "product", "sum",
                                                 "thread",   "expression", "window"};
  return kinds;
}

// Heights of about `size` / 30 on segments of about `size`, in the natural coordinates.
inline std::string height(const std::string& kind, int dimension, double size = 1.0) {
  const bool line = dimension == 2;
  const auto n = [&](double factor) { return number(factor * size); };
  const std::string sine = R"({"type": "sine", "amplitude": )" + n(0.03) + R"(, "wave_vector": )" +
                           (line ? "[0.8]" : "[0.8, 0.5]") + R"(, "phase": 0.4})";
  const std::string gaussian = R"({"type": "gaussian", "amplitude": )" + n(-0.04) + R"(, "center": )" +
                               (line ? "[0.1]" : "[0.1, 0.2]") + R"(, "width": 0.6})";
  if (kind == "expression")
    return R"({"type": "expression", "h": "a*sin(2*pi*0.8*u + 0.4)*exp(-0.3*u^2) - a/(2 + )" +
           std::string(line ? "u" : "u*v - sin(v)") + R"#()", "constants": {"a": )#" + n(0.02) + "}}";
  if (kind == "window")
    return R"({"type": "window", "of": )" + sine + R"(, "low": )" + (line ? "[-1.5]" : "[-1.5, -1.6]") +
           R"(, "high": )" + (line ? "[1.5]" : "[1.5, 1.4]") + "}";
  if (kind == "none") return "null";
  if (kind == "constant") return R"({"type": "constant", "value": )" + n(0.02) + "}";
  if (kind == "sine") return sine;
  if (kind == "gaussian") return gaussian;
  if (kind == "polynomial")
    return R"({"type": "polynomial", "coefficients": )" +
           (line ? "[" + n(0.01) + ", " + n(0.02) + ", " + n(-0.03) + ", " + n(0.01) + "]"
                 : "[[" + n(0.01) + ", " + n(-0.02) + "], [" + n(0.02) + "], [" + n(0.01) + ", 0, " +
                       n(0.01) + "]]") +
           "}";
  if (kind == "map")
    return R"({"type": "map", "boundary": )" +
           (line ? R"("periodic", "size": [2.2], "values": [)" + n(0.01) + ", " + n(0.03) + ", " + n(-0.01) +
                       ", " + n(0.02) + "]"
                 : R"("clamped", "size": [2.0, 2.5], "origin": [-1, -1], "values": [[)" + n(0.01) + ", " +
                       n(0.03) + ", " + n(-0.02) + "], [" + n(0.02) + ", " + n(-0.01) + ", " + n(0.01) +
                       "], [" + n(-0.01) + ", 0, " + n(0.02) + "]]") +
           "}";
  if (kind == "product")
    return R"({"type": "product", "of": [)" + sine + R"(, {"type": "constant", "value": 0.9}, )" +
           height("gaussian", dimension, 20.0) + "]}";
  if (kind == "sum") return R"({"type": "sum", "of": [)" + sine + ", " + gaussian + "]}";
  if (kind == "thread") {
    const std::string thread =
        R"({"type": "thread", "pitch": 1.5, "flank_angles": [80, 75], "crest": 0.3, "root": 0.4, "rounding": 0.3)" +
        std::string(line ? "}" : R"(, "turn": 9, "starts": 2})");
    if (size == 1.0) return thread;
    return R"({"type": "product", "of": [)" + thread + R"(, {"type": "constant", "value": )" + n(1.0) + "}]}";
  }
  throw std::runtime_error("no height " + kind);
}

inline const std::vector<std::string>& projection_kinds() {
  static const std::vector<std::string> kinds = {"normal", "shadow_point", "shadow_direction"};
  return kinds;
}

inline std::string projection(const std::string& kind, int dimension, double size = 1.0) {
  const bool line = dimension == 2;
  if (kind == "shadow_point")
    return R"({"type": "shadow_point", "emitter": [)" + number(0.5 * size) + ", " +
           (line ? "" : number(-0.4 * size) + ", ") + number(9.0 * size) + "]}";
  if (kind == "shadow_direction")
    return std::string(R"({"type": "shadow_direction", "direction": )") +
           (line ? "[0.2, 1]" : "[0.2, -0.1, 1]") + "}";
  return R"({"type": "normal"})";
}

// The normal laws, then laws with friction.
inline const std::vector<std::string>& contact_kinds() {
  static const std::vector<std::string> kinds = [] {
    const std::string
        penalty = R"({"type": "penalty", "stiffness": 1000.0})",
        coulomb = R"({"type": "coulomb", "coefficient": 0.3, "stiffness": 500.0})",
        limited = R"({"type": "coulomb", "coefficient": 0.5, "stiffness": 300.0, "shear_limit": 4.0})",
        rough = R"({"type": "rough", "stiffness": 500.0})";
    const auto type = [](const std::string& name) {
      return R"({"type": ")" + name + R"(", "stiffness": 1000.0})";
    };
    const auto law = [](const std::string& normal, const std::string& friction) {
      return R"({"normal": )" + normal + (friction.empty() ? "" : R"(, "friction": )" + friction) + "}";
    };
    return std::vector<std::string>{
        law(penalty, ""),
        law(R"({"type": "power", "coefficient": 2000.0, "exponent": 1.5})", ""),
        law(R"({"type": "exponential", "pressure": 10.0, "clearance": 0.01})", ""),
        law(type("augmented"), ""),
        law(type("augmented_multiplier"), ""),
        law(type("multiplier"), ""),
        law(penalty, coulomb),
        law(penalty, rough),
        law(R"({"type": "power", "coefficient": 2000.0, "exponent": 2})", limited),
        law(type("augmented"), coulomb),
        law(type("augmented_multiplier"), coulomb),
        law(type("multiplier"), limited),
        law(R"({"type": "tied", "stiffness": 1000.0, "range": 0.01})", rough),
        law(R"({"type": "cohesive", "stiffness": 1000.0, "strength": 20.0, "energy": 0.6, "range": 0.01})",
            ""),
        law(R"({"type": "dugdale", "work": 0.1, "strength": 5.0, "stiffness": 1000.0})",
            R"({"type": "coulomb", "coefficient": 0.3, "stiffness": 500.0, "adhesion": true})"),
        law(R"({"type": "separation", "work": 0.1, "length": 0.01})", coulomb),
        law(R"({"type": "lennard_jones", "work": 0.1, "length": 0.01, "range": 0.1})", ""),
    };
  }();
  return kinds;
}

struct ModelKind {
  std::string basis;
  std::string height = "none";
  std::string projection = "normal";
  std::string more = "";   // further keys: ", \"tangent\": \"small_gap\""
  std::size_t contact = 0; // of contact_kinds()
};

inline std::string text(const ModelKind& kind) {
  const int dimension = basis(kind.basis).dimension;
  return R"({"segment": ")" + kind.basis + R"(", "height": )" + height(kind.height, dimension) +
         R"(, "projection": )" + projection(kind.projection, dimension) + R"(, "contact": )" +
         contact_kinds()[kind.contact] + kind.more + "}";
}

// Every basis with every height and every projection; every law, rigid masters and the approximate tangents
// among them.
inline std::vector<ModelKind> all_kinds() {
  const std::vector<std::string> more = {"", R"(, "master": "rigid")", R"(, "tangent": "small_gap")",
                                         R"(, "tangent": "first_variation")", ""};
  std::vector<ModelKind> kinds;
  for (const Basis& b : bases())
    for (const std::string& h : height_kinds())
      for (const std::string& p : projection_kinds())
        kinds.push_back(
            {b.name, h, p, more[kinds.size() % more.size()], (7 * kinds.size()) % contact_kinds().size()});
  return kinds;
}

// A few per basis, all heights, projections and laws among them: for tests that do much with each.
inline std::vector<ModelKind> some_kinds() {
  std::vector<ModelKind> kinds;
  for (std::size_t i = 0; i < bases().size(); ++i)
    for (std::size_t j = 0; j < 3; ++j)
      kinds.push_back({bases()[i].name, height_kinds()[(3 * i + 2 * j) % height_kinds().size()],
                       projection_kinds()[(i + j) % 3], i % 4 == 3 && j == 1 ? R"(, "master": "rigid")" : "",
                       (3 * i + 5 * j) % contact_kinds().size()});
  return kinds;
}

inline std::vector<Model> make(const std::vector<ModelKind>& kinds) {
  std::vector<Model> models;
  for (const ModelKind& kind : kinds) models.emplace_back(text(kind));
  return models;
}

} // namespace test
