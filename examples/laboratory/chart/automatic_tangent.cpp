// SPDX-License-Identifier: BSD-3-Clause
// The library finds the projection xi, in double precision, and says what is in contact. From there, with
// d = x_s - rho_e:
//   r_a(xi, x_s) = rho_e,a . d = 0  in numbers with derivatives along xi and x_s   ->  d xi / d x_s
//                                   (implicit function theorem)
//   R = A eps d                     in numbers with derivatives along x_s          ->  K
#include "chart/automatic_tangent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/AutoDiff>
#include <utility>
#include <vector>

#include "own_elements.hpp"
#include "toolbox/error.hpp"

namespace host::chart {
namespace {

template <int N> using Number = Eigen::AutoDiffScalar<Eigen::Matrix<double, N, 1>>;
template <class S> using Vector = std::array<S, 3>;

struct Sine {
  double amplitude = 1, wave[2] = {}, phase = 0; // wave in turns, phase in radians
};

/// What `assemble` cannot be told by its arguments.
struct Element {
  decltype(&ents_assemble) assemble = nullptr; // the library's own
  ents_layout layout{};
  double stiffness = 0;
  double coordinates[4][2] = {};
  std::vector<Sine> sines; // h is their product
};
Element element; // of the one AutomaticTangent

template <class S> S dot(const Vector<S>& a, const Vector<S>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class S> Vector<S> cross(const Vector<S>& a, const Vector<S>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// rho_e and its tangents at xi.
template <class S> struct SurfacePlace { Vector<S> point, tangent[2]; };

template <class S> SurfacePlace<S> surface(const double* master, const std::array<S, 2>& xi) {
  constexpr double side[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const S zero(0.0);
  Vector<S> rho{zero, zero, zero}, a[2]{rho, rho}, a12 = rho;
  S s[2]{zero, zero}, ds[2][2]{{zero, zero}, {zero, zero}}; // surface coordinates, ds[direction][of]
  for (int i = 0; i < 4; ++i) {
    const S f = 0.5 * (1.0 + side[i][0] * xi[0]), g = 0.5 * (1.0 + side[i][1] * xi[1]), N = f * g;
    const S dN[2] = {0.5 * side[i][0] * g, 0.5 * side[i][1] * f};
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = master[3 * i + static_cast<int>(c)];
      rho[c] += x * N;
      a[0][c] += x * dN[0];
      a[1][c] += x * dN[1];
      a12[c] += S(0.25 * side[i][0] * side[i][1] * x);
    }
    for (int c = 0; c < 2; ++c) {
      s[c] += element.coordinates[i][c] * N;
      for (int k = 0; k < 2; ++k) ds[k][c] += element.coordinates[i][c] * dN[k];
    }
  }
  S h(1.0), slope[2]{zero, zero};
  for (const Sine& sine : element.sines) {
    using std::cos, std::sin;
    constexpr double turn = 2 * std::numbers::pi;
    const S angle = turn * (sine.wave[0] * s[0] + sine.wave[1] * s[1]) + sine.phase;
    const S value = sine.amplitude * sin(angle), rate = (turn * sine.amplitude) * cos(angle);
    for (int k = 0; k < 2; ++k)
      slope[k] = slope[k] * value + h * rate * (sine.wave[0] * ds[k][0] + sine.wave[1] * ds[k][1]);
    h = h * value;
  }
  const Vector<S> m = cross(a[0], a[1]);
  using std::sqrt;
  const S size = sqrt(dot(m, m));
  Vector<S> n;
  for (std::size_t c = 0; c < 3; ++c) n[c] = m[c] / size;
  SurfacePlace<S> at;
  for (std::size_t c = 0; c < 3; ++c) at.point[c] = rho[c] + h * n[c];
  const Vector<S> m1[2] = {cross(a[0], a12), cross(a12, a[1])};
  for (std::size_t k = 0; k < 2; ++k) {
    const S along = dot(n, m1[k]);
    for (std::size_t c = 0; c < 3; ++c)
      at.tangent[k][c] = a[k][c] + slope[k] * n[c] + h * (m1[k][c] - along * n[c]) / size;
  }
  return at;
}

/// R and K of a slave node in contact at xi. K column by column.
void differentiate(const double* slave, const double* master, double area, const double* xi, double* residual,
                   double* tangent) {
  using Five = Number<5>; // xi, x_s
  using Three = Number<3>;
  const SurfacePlace<Five> at = surface<Five>(master, {Five(xi[0], 5, 0), Five(xi[1], 5, 1)});
  Vector<Five> d;
  for (std::size_t c = 0; c < 3; ++c) d[c] = Five(slave[c], 5, 2 + static_cast<int>(c)) - at.point[c];
  const Five r[2] = {dot(at.tangent[0], d), dot(at.tangent[1], d)};
  Eigen::Matrix2d by_xi;
  Eigen::Matrix<double, 2, 3> by_slave;
  for (int a = 0; a < 2; ++a) {
    by_xi.row(a) = r[a].derivatives().head<2>();
    by_slave.row(a) = r[a].derivatives().tail<3>();
  }
  const Eigen::Matrix<double, 2, 3> rates = -by_xi.inverse() * by_slave;
  const SurfacePlace<Three> moved = surface<Three>(
      master, {Three(xi[0], rates.row(0).transpose()), Three(xi[1], rates.row(1).transpose())});
  for (std::size_t c = 0; c < 3; ++c) {
    const Three force =
        (area * element.stiffness) * (Three(slave[c], 3, static_cast<int>(c)) - moved.point[c]);
    residual[c] = force.value();
    for (std::size_t j = 0; j < 3; ++j)
      tangent[3 * j + c] = force.derivatives()[static_cast<Eigen::Index>(j)];
  }
}

std::int32_t assemble_automatically(const ents_model* model, std::int64_t first, std::int64_t count,
                                    const ents_input* input, const ents_output* output,
                                    const ents_system* system, ents_report* report) {
  if (system->values == nullptr) return element.assemble(model, first, count, input, output, system, report);
  ents_system no_forces = *system;
  no_forces.residual = no_forces.values = nullptr;
  ents_output rest = *output;
  std::vector<double> xi(2 * static_cast<std::size_t>(first + count)), pressure(xi.size());
  rest.wanted |=
      ENTS_XI | ENTS_PRESSURE; // something of the law has to be asked for, or nothing would be in contact
  rest.xi = xi.data(), rest.xi_stride = 2;
  rest.pressure = pressure.data(), rest.pressure_stride = 1;
  const std::int32_t status = element.assemble(model, first, count, input, &rest, &no_forces, report);
  if (status != ENTS_OK) return status;
  OwnElements elements(element.layout, *input, *system);
  for (std::int64_t e = first; e < first + count; ++e) {
    if ((output->flags[e * output->flags_stride] & ENTS_FLAG_CONTACT) == 0) continue;
    const ents_input in = elements.input(e);
    double residual[3], tangent[9];
    differentiate(in.slave, in.master, *in.area, xi.data() + 2 * e, residual, tangent);
    elements.add(e, residual, tangent);
  }
  return ENTS_OK;
}

Sine sine_of(const Json& height) {
  if (height.at("type") != "sine")
    throw JobError("automatic tangent: the height is no sine and no product of sines");
  Sine sine;
  sine.amplitude = height.at("amplitude").get<double>();
  sine.phase = height.value("phase", 0.0);
  for (std::size_t c = 0; c < 2; ++c) sine.wave[c] = height.at("wave_vector").at(c).get<double>();
  return sine;
}

Element element_of(const Scene& scene) {
  const Json& model = scene.contact->model;
  if (scene.contact->rigid.empty() || model.at("segment") != "quad4" || model.contains("projection") ||
      model.at("contact").contains("friction") || model.at("contact").at("normal").at("type") != "penalty" ||
      model.at("contact").at("normal").size() != 2)
    throw JobError("automatic tangent: only for a rigid quad4 with a penalty, without friction");
  Element found;
  found.stiffness = model.at("contact").at("normal").at("stiffness").get<double>();
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t c = 0; c < 2; ++c)
      found.coordinates[i][c] = model.at("surface_coordinates").at(i).at(c).get<double>();
  const Json& height = model.at("height");
  if (height.at("type") == "product")
    for (const Json& factor : height.at("of")) found.sines.push_back(sine_of(factor));
  else
    found.sines = {sine_of(height)};
  return found;
}

} // namespace

AutomaticTangent::AutomaticTangent(const EntsLibrary& library, const Scene& scene)
    : library_(library.path()) {
  element = element_of(scene);
  element.layout =
      EntsModel(library, scene.contact->model.dump(), scene.file.parent_path(), scene.contact->model_where)
          .layout();
  element.assemble = std::exchange(library_.assemble, assemble_automatically);
}
AutomaticTangent::~AutomaticTangent() { element = {}; }

} // namespace host::chart
