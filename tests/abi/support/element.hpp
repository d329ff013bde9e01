// SPDX-License-Identifier: BSD-3-Clause
// One contact element for the tests: its inputs and outputs as arrays of exactly the size they have, and
// elements drawn at random near the surface of a model.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "support/model.hpp"

namespace test {

struct InputArray {
  const char* name;
  const double* ents_input::*pointer;
  int64_t ents_input::*stride;
};
enum InputIndex { slave, master, surface_coordinates, start, area, state_begin, multiplier, input_count };
inline constexpr InputArray inputs[input_count] = {
    {"slave", &ents_input::slave, &ents_input::slave_stride},
    {"master", &ents_input::master, &ents_input::master_stride},
    {"surface_coordinates", &ents_input::surface_coordinates, &ents_input::surface_coordinates_stride},
    {"start", &ents_input::start, &ents_input::start_stride},
    {"area", &ents_input::area, &ents_input::area_stride},
    {"state_begin", &ents_input::state_begin, &ents_input::state_begin_stride},
    {"multiplier", &ents_input::multiplier, &ents_input::multiplier_stride},
};
inline std::size_t size_of_input(const ents_layout& l, int index) {
  const int sizes[input_count] = {l.dimension, l.dimension * l.nodes, l.parameters * l.nodes, l.parameters,
                                  1,           l.state_size,          l.multipliers};
  return static_cast<std::size_t>(sizes[index]);
}

// Outputs of doubles. There are two more of int32_t, flags and iterations.
struct OutputArray {
  int32_t bit;
  const char* name;
  double* ents_output::*pointer;
  int64_t ents_output::*stride;
};
inline constexpr int output_count = 19;
inline constexpr OutputArray outputs[output_count] = {
    {ENTS_XI, "xi", &ents_output::xi, &ents_output::xi_stride},
    {ENTS_GAP, "gap", &ents_output::gap, &ents_output::gap_stride},
    {ENTS_NORMAL_GAP, "normal_gap", &ents_output::normal_gap, &ents_output::normal_gap_stride},
    {ENTS_NORMAL, "normal", &ents_output::normal, &ents_output::normal_stride},
    {ENTS_POINT, "point", &ents_output::point, &ents_output::point_stride},
    {ENTS_GAP_GRADIENT, "gap_gradient", &ents_output::gap_gradient, &ents_output::gap_gradient_stride},
    {ENTS_GAP_HESSIAN, "gap_hessian", &ents_output::gap_hessian, &ents_output::gap_hessian_stride},
    {ENTS_XI_GRADIENT, "xi_gradient", &ents_output::xi_gradient, &ents_output::xi_gradient_stride},
    {ENTS_XI_HESSIAN, "xi_hessian", &ents_output::xi_hessian, &ents_output::xi_hessian_stride},
    {ENTS_ENERGY, "energy", &ents_output::energy, &ents_output::energy_stride},
    {ENTS_PRESSURE, "pressure", &ents_output::pressure, &ents_output::pressure_stride},
    {ENTS_RESIDUAL, "residual", &ents_output::residual, &ents_output::residual_stride},
    {ENTS_TANGENT, "tangent", &ents_output::tangent, &ents_output::tangent_stride},
    {ENTS_STATE, "state_end", &ents_output::state_end, &ents_output::state_end_stride},
    {ENTS_TRACTION, "traction", &ents_output::traction, &ents_output::traction_stride},
    {ENTS_SLIP, "slip", &ents_output::slip, &ents_output::slip_stride},
    {ENTS_AGE, "age", &ents_output::age, &ents_output::age_stride},
    {ENTS_DISSIPATION, "dissipation", &ents_output::dissipation, &ents_output::dissipation_stride},
    {ENTS_FRICTION_ENERGY, "friction_energy", &ents_output::friction_energy,
     &ents_output::friction_energy_stride},
};
inline std::size_t size_of_output(const ents_layout& l, int index) {
  const int all = l.dofs, n = all - l.multipliers, t = l.parameters, d = l.dimension;
  const int sizes[output_count] = {
      t, 1, 1, d, d, n, n * n, t * n, t * n * n, 1, 1, all, all * all, l.state_size, d, 1, 1, 1, 1};
  return static_cast<std::size_t>(sizes[index]);
}

inline constexpr int32_t want_all = (1 << 21) - 1; // all but ENTS_HEAT
inline constexpr int32_t want_element = ENTS_ENERGY | ENTS_PRESSURE | ENTS_RESIDUAL | ENTS_TANGENT |
                                        ENTS_STATE | ENTS_TRACTION | ENTS_SLIP | ENTS_AGE | ENTS_DISSIPATION |
                                        ENTS_FRICTION_ENERGY;
// What an element outside its segment has, too.
inline constexpr int32_t want_values =
    ENTS_XI | ENTS_GAP | ENTS_NORMAL_GAP | ENTS_NORMAL | ENTS_POINT | ENTS_FLAGS | ENTS_ITERATIONS;

struct Element {
  std::array<std::vector<double>, input_count> in; // empty: null
  std::vector<double>& operator[](int index) { return in[static_cast<std::size_t>(index)]; }
  const std::vector<double>& operator[](int index) const { return in[static_cast<std::size_t>(index)]; }
};

struct Results {
  explicit Results(const ents_layout& layout) {
    for (int i = 0; i < output_count; ++i)
      real[static_cast<std::size_t>(i)].resize(size_of_output(layout, i));
  }
  const std::vector<double>& operator[](int index) const { return real[static_cast<std::size_t>(index)]; }
  // By its bit: results.of(ENTS_GAP)
  const std::vector<double>& of(int32_t bit) const {
    int i = 0;
    while (outputs[i].bit != bit) ++i;
    return (*this)[i];
  }
  double gap() const { return of(ENTS_GAP)[0]; }

  std::array<std::vector<double>, output_count> real;
  int32_t flags = 0, iterations = 0, status = 0;
};

inline ents_input input_of(const Element& element) {
  ents_input input{};
  input.struct_size = sizeof input;
  for (int i = 0; i < input_count; ++i) {
    input.*inputs[i].pointer = element[i].empty() ? nullptr : element[i].data();
    input.*inputs[i].stride = static_cast<int64_t>(element[i].size());
  }
  return input;
}

inline ents_output output_of(Results& results, int32_t wanted) {
  ents_output output{};
  output.struct_size = sizeof output;
  output.wanted = wanted;
  for (int i = 0; i < output_count; ++i) {
    output.*outputs[i].pointer = results.real[static_cast<std::size_t>(i)].data();
    output.*outputs[i].stride = static_cast<int64_t>(results[i].size());
  }
  output.flags = &results.flags;
  output.flags_stride = 1;
  output.iterations = &results.iterations;
  output.iterations_stride = 1;
  output.status = &results.status;
  output.status_stride = 1;
  return output;
}

inline int32_t evaluate(const Model& model, const Element& element, int32_t wanted, Results& results,
                        ents_report* report = nullptr) {
  const ents_input input = input_of(element);
  const ents_output output = output_of(results, wanted);
  return call::evaluate(model.get(), int64_t{0}, int64_t{1}, &input, &output, report);
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}
inline bool same_bits(const Results& a, const Results& b) {
  for (int i = 0; i < output_count; ++i)
    if (!same_bits(a[i], b[i])) return false;
  return a.flags == b.flags && a.iterations == b.iterations && a.status == b.status;
}

inline bool all_finite(const std::vector<double>& values) {
  for (const double v : values)
    if (!std::isfinite(v)) return false;
  return true;
}

// Doubles from the generator's own bits: the same on every platform.
class Random {
public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  std::uint64_t bits() { return generator_(); }
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(generator_() >> 11) * 0x1p-53);
  }
  int below(int n) { return static_cast<int>(generator_() % static_cast<std::uint64_t>(n)); }

private:
  std::mt19937_64 generator_;
};

// A proper rotation; row by row. d = 2: the first two rows and columns.
struct Rotation {
  double r[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  void apply(double* x, int d) const {
    double y[3] = {};
    for (int i = 0; i < d; ++i)
      for (int j = 0; j < d; ++j) y[i] += r[i][j] * x[j];
    for (int i = 0; i < d; ++i) x[i] = y[i];
  }
};
// By the angles a (about the third axis, the only one in 2D) and b (about the first one).
inline Rotation rotation(int d, double a, double b) {
  Rotation q;
  const double ca = std::cos(a), sa = std::sin(a);
  if (d == 2) {
    q.r[0][0] = q.r[1][1] = ca;
    q.r[0][1] = -sa;
    q.r[1][0] = sa;
    return q;
  }
  const double cb = std::cos(b), sb = std::sin(b);
  const double r[3][3] = {{ca, -sa * cb, sa * sb}, {sa, ca * cb, -ca * sb}, {0, sb, cb}};
  std::memcpy(q.r, r, sizeof r);
  return q;
}

// The plain segment in the plane of the first d - 1 axes, as [nodes][d].
inline std::vector<double> flat_master(const Basis& b, double size = 1.0) {
  std::vector<double> x;
  for (const auto& node : b.nodes) {
    for (const double c : node) x.push_back(size * c);
    x.push_back(0.0);
  }
  return x;
}

inline std::vector<double> centre(const Basis& b) {
  return std::vector<double>(static_cast<std::size_t>(b.dimension - 1), b.simplex ? 1.0 / 3.0 : 0.0);
}

inline std::vector<double> random_xi(const Basis& b, Random& random, double margin = 0.1) {
  std::vector<double> xi;
  for (int a = 0; a + 1 < b.dimension; ++a) xi.push_back(random(-1.0 + margin, 1.0 - margin));
  if (b.simplex) {
    const double u = random(margin, 1.0 - 2.0 * margin), v = random(margin, 1.0 - margin - u);
    xi = {u, v};
  }
  return xi;
}

// Point and normal of rho_e.
struct SurfacePoint {
  std::vector<double> point, normal;
};
inline SurfacePoint surface_point(const Model& model, const Element& element, const std::vector<double>& xi) {
  const auto d = static_cast<std::size_t>(model.layout.dimension);
  SurfacePoint at{std::vector<double>(d), std::vector<double>(d)};
  ents_surface surface{};
  surface.struct_size = sizeof surface;
  surface.master = element[master].data();
  surface.surface_coordinates =
      element[surface_coordinates].empty() ? nullptr : element[surface_coordinates].data();
  surface.xi = xi.data();
  surface.point = at.point.data();
  surface.normal = at.normal.data();
  if (call::surface_evaluate(model.get(), int64_t{1}, &surface, nullptr) != ENTS_OK)
    throw std::runtime_error("no surface point");
  return at;
}

// A moderately distorted segment of about unit size, turned by a small angle, and a slave node within `low`
// .. `high` of its enriched surface, above or below a point well inside the segment.
inline Element draw(const Model& model, const Basis& b, Random& random, double low = -0.05,
                    double high = 0.02) {
  Element e;
  e[master] = flat_master(b);
  const auto d = static_cast<std::size_t>(b.dimension);
  const Rotation turn = rotation(b.dimension, random(-0.3, 0.3), random(-0.3, 0.3));
  for (std::size_t i = 0; i < b.nodes.size(); ++i) {
    for (std::size_t c = 0; c < d; ++c) e[master][d * i + c] += random(-0.08, 0.08);
    turn.apply(&e[master][d * i], b.dimension);
  }
  if (random.below(2) == 0)
    for (const auto& node : b.nodes)
      for (const double x : node) e[surface_coordinates].push_back(1.1 * x + random(-0.05, 0.05));
  const std::vector<double> xi = random_xi(b, random);
  const SurfacePoint at = surface_point(model, e, xi);
  const double gap = random(low, high);
  for (std::size_t c = 0; c < d; ++c) e[slave].push_back(at.point[c] + gap * at.normal[c]);
  for (const double x : xi) e[start].push_back(x + random(-0.02, 0.02));
  e[area] = {random(0.1, 2.0)};
  for (int i = 0; i < model.layout.multipliers; ++i)
    e[multiplier].push_back(i == 0 ? random(0.0, 20.0) : random(-5.0, 5.0));
  return e;
}

// The same with a state block: a new one.
inline Element with_new_state(const Model& model, Element element) {
  element[state_begin].resize(static_cast<std::size_t>(model.layout.state_size));
  call::state_init(model.get(), int64_t{1}, element[state_begin].data(), int64_t{model.layout.state_size},
                   nullptr);
  return element;
}

// The same with the state of an increment before: the slave has moved on since, so that friction sticks or
// slips.
inline Element with_history(const Model& model, Element element, Random& random) {
  element = with_new_state(model, std::move(element));
  Element before = element;
  for (double& x : before[slave]) x += random(-0.02, 0.02);
  Results results(model.layout);
  if (evaluate(model, before, ENTS_STATE, results) == ENTS_OK) element[state_begin] = results.of(ENTS_STATE);
  return element;
}

} // namespace test
