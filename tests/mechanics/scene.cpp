#include "scene.hpp"

#include <algorithm>
#include <stdexcept>

namespace mechanics {

using nlohmann::json;

namespace {

Vec3 unit(const Vec3& v) { return (1.0 / norm(v)) * v; }

std::array<Vec3, 3> draw_axes(Random& random, int dimension) {
  Vec3 a, b;
  do {
    a = {random.uniform(-1, 1), random.uniform(-1, 1), dimension == 3 ? random.uniform(-1, 1) : 0.0};
    b = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  } while (norm(a) < 0.2 || norm(cross(a, b)) < 0.2);
  a = unit(a);
  if (dimension == 2) return {a, Vec3{-a[1], a[0], 0.0}, Vec3{0.0, 0.0, 1.0}};
  const Vec3 n = unit(cross(a, b));
  return {a, cross(n, a), n};
}

Vec3 in_axes(const Scene& scene, const Vec3& v) {
  return v[0] * scene.axes[0] + v[1] * scene.axes[1] + v[2] * scene.axes[2];
}

void append(std::vector<double>& to, const Vec3& v, int dimension) {
  to.insert(to.end(), v.begin(), v.begin() + dimension);
}

// Natural coordinates well inside the segment
std::array<double, 2> draw_interior(Random& random, const Basis& basis) {
  if (!basis.simplex)
    return {random.uniform(-0.85, 0.85), basis.dimension == 3 ? random.uniform(-0.85, 0.85) : 0.0};
  double x, y;
  do {
    x = random.uniform(0.08, 0.84);
    y = random.uniform(0.08, 0.84);
  } while (x + y > 0.92);
  return {x, y};
}

} // namespace

json Scene::model() const {
  json rays = json::array();
  for (int c = 0; c < basis->dimension; ++c) rays.push_back(ray[static_cast<std::size_t>(c)]);
  json project = {{"type", projection}};
  if (projection == "shadow_point") project["emitter"] = rays;
  if (projection == "shadow_direction") project["direction"] = rays;
  return {{"segment", basis->name},
          {"height", height},
          {"projection", project},
          {"tangent", tangent},
          {"contact", {{"normal", {{"type", "penalty"}, {"stiffness", stiffness}}}}}};
}

Scene draw_scene(Random& random, const Basis& basis, const std::string& height_kind,
                 const std::string& projection) {
  Scene scene;
  scene.basis = &basis;
  const int d = basis.dimension;
  scene.height = draw_height(random, height_kind, basis.parameters());
  scene.projection = projection;
  scene.with_coordinates = random.coin();
  scene.stiffness = std::pow(10.0, random.uniform(-1.0, 4.0));
  scene.axes = draw_axes(random, d);
  scene.origin = {random.uniform(-1, 1), random.uniform(-1, 1), d == 3 ? random.uniform(-1, 1) : 0.0};
  const double up = projection == "shadow_point" ? random.uniform(4.0, 8.0) : random.uniform(0.8, 1.2);
  const double aside = projection == "shadow_point" ? 1.5 : 0.3;
  Vec3 ray{};
  for (int a = 0; a < d - 1; ++a) ray[static_cast<std::size_t>(a)] = random.uniform(-aside, aside);
  ray[static_cast<std::size_t>(d - 1)] = up;
  scene.ray = in_axes(scene, ray);
  if (projection == "shadow_point") scene.ray = scene.ray + scene.origin;
  return scene;
}

Elements draw_elements(Random& random, const Scene& scene, const Model& model, std::int64_t count,
                       double gap_low, double gap_high) {
  const Basis& basis = *scene.basis;
  const int d = basis.dimension, t = basis.parameters(), m = basis.node_count();
  Elements out;
  out.count = count;
  for (std::int64_t e = 0; e < count; ++e) {
    const double size[2] = {random.uniform(0.75, 1.6), random.uniform(0.75, 1.6)};
    const double noise = basis.simplex ? 0.04 : 0.06;
    for (const auto& natural : basis.nodes) {
      Vec3 x{};
      for (int a = 0; a < t; ++a)
        x[static_cast<std::size_t>(a)] =
            size[a] * natural[static_cast<std::size_t>(a)] + random.uniform(-noise, noise);
      x[static_cast<std::size_t>(t)] = random.uniform(-0.08, 0.08);
      append(out.master, scene.origin + in_axes(scene, x), d);
      if (scene.with_coordinates)
        for (int a = 0; a < t; ++a)
          out.surface_coordinates.push_back(0.8 * natural[static_cast<std::size_t>(a)] +
                                            random.uniform(-0.05, 0.05));
    }
    const double* master = &out.master[static_cast<std::size_t>(e * m * d)];
    const double* coordinates =
        scene.with_coordinates ? &out.surface_coordinates[static_cast<std::size_t>(e * m * t)] : nullptr;
    const std::array<double, 2> at = draw_interior(random, basis);
    const SurfacePoints p =
        evaluate_surface(model, master, coordinates, std::vector<double>(at.data(), at.data() + t));
    if (p.status != ENTS_OK) throw std::runtime_error("a drawn segment is degenerate");
    const Vec3 point = vec3(p.point.data(), d);
    Vec3 direction = vec3(p.normal.data(), d);
    if (scene.projection == "shadow_direction") direction = unit(scene.ray);
    if (scene.projection == "shadow_point") direction = unit(scene.ray - point);
    append(out.slave, point + random.uniform(gap_low, gap_high) * direction, d);
    for (int a = 0; a < t; ++a)
      out.start.push_back(at[static_cast<std::size_t>(a)] + random.uniform(-0.02, 0.02));
    out.area.push_back(random.uniform(0.5, 2.0));
  }
  return out;
}

std::vector<double> dofs_of(const Elements& elements, std::int64_t e, const Basis& basis) {
  const std::int64_t d = basis.dimension, m = basis.node_count();
  const double* slave = elements.slave.data() + e * d;
  const double* master = elements.master.data() + e * m * d;
  std::vector<double> u(slave, slave + d);
  u.insert(u.end(), master, master + m * d);
  return u;
}

void set_dofs(Elements& elements, std::int64_t e, const Basis& basis, const double* dofs) {
  const std::int64_t d = basis.dimension, m = basis.node_count();
  std::copy(dofs, dofs + d, elements.slave.data() + e * d);
  std::copy(dofs + d, dofs + d * (m + 1), elements.master.data() + e * m * d);
}

} // namespace mechanics
