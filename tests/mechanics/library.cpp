#include "library.hpp"

#include <stdexcept>

namespace mechanics {

namespace {

std::size_t size(std::int64_t n) { return static_cast<std::size_t>(n); }

const double* data_or_null(const std::vector<double>& v) { return v.empty() ? nullptr : v.data(); }

} // namespace

Model::Model(const std::string& text)
    : model_([&]() -> ents::Model {
        try {
          return ents::Model(text);
        } catch (const ents::Error& error) {
          throw std::runtime_error(std::string(error.what()) + " in " + text);
        }
      }()) {}

void Model::evaluate(const Elements& elements, std::int32_t wanted, Results& r) const {
  const std::int64_t n = elements.count, d = dimension(), t = parameters(), m = nodes(), u = dofs();
  auto in = ents::make<ents_input>();
  in.slave = elements.slave.data();
  in.slave_stride = d;
  in.master = elements.master.data();
  in.master_stride = m * d;
  in.surface_coordinates = data_or_null(elements.surface_coordinates);
  in.surface_coordinates_stride = m * t;
  in.start = data_or_null(elements.start);
  in.start_stride = t;
  in.area = data_or_null(elements.area);
  in.area_stride = 1;

  auto out = ents::make<ents_output>();
  out.wanted = wanted;
  r.statuses.assign(size(n), ENTS_INTERNAL);
  out.status = r.statuses.data();
  out.status_stride = 1;
  const auto want = [&](std::int32_t bit, auto& array, std::int64_t entries, auto*& pointer,
                        std::int64_t& stride) {
    array.clear();
    if (!(wanted & bit)) return;
    array.resize(size(n * entries));
    pointer = array.data();
    stride = entries;
  };
  want(ENTS_XI, r.xi, t, out.xi, out.xi_stride);
  want(ENTS_GAP, r.gap, 1, out.gap, out.gap_stride);
  want(ENTS_NORMAL_GAP, r.normal_gap, 1, out.normal_gap, out.normal_gap_stride);
  want(ENTS_NORMAL, r.normal, d, out.normal, out.normal_stride);
  want(ENTS_POINT, r.point, d, out.point, out.point_stride);
  want(ENTS_GAP_GRADIENT, r.gap_gradient, u, out.gap_gradient, out.gap_gradient_stride);
  want(ENTS_GAP_HESSIAN, r.gap_hessian, u * u, out.gap_hessian, out.gap_hessian_stride);
  want(ENTS_XI_GRADIENT, r.xi_gradient, t * u, out.xi_gradient, out.xi_gradient_stride);
  want(ENTS_XI_HESSIAN, r.xi_hessian, t * u * u, out.xi_hessian, out.xi_hessian_stride);
  want(ENTS_ENERGY, r.energy, 1, out.energy, out.energy_stride);
  want(ENTS_PRESSURE, r.pressure, 1, out.pressure, out.pressure_stride);
  want(ENTS_RESIDUAL, r.residual, u, out.residual, out.residual_stride);
  want(ENTS_TANGENT, r.tangent, u * u, out.tangent, out.tangent_stride);
  want(ENTS_FLAGS, r.flags, 1, out.flags, out.flags_stride);
  want(ENTS_ITERATIONS, r.iterations, 1, out.iterations, out.iterations_stride);

  r.status = ents::call(ents_evaluate, handle(), 0, n, &in, &out).status;
}

Results Model::evaluate(const Elements& elements, std::int32_t wanted) const {
  Results results;
  evaluate(elements, wanted, results);
  return results;
}

SurfacePoints evaluate_surface(const Model& model, const double* master, const double* surface_coordinates,
                               const std::vector<double>& xi) {
  const std::int64_t count = static_cast<std::int64_t>(xi.size()) / model.parameters(), d = model.dimension();
  SurfacePoints points;
  for (auto* v : {&points.point, &points.normal, &points.base_point, &points.base_normal})
    v->resize(size(count * d));
  points.height.resize(size(count));
  auto surface = ents::make<ents_surface>();
  surface.master = master;
  surface.surface_coordinates = surface_coordinates;
  surface.xi = xi.data();
  surface.point = points.point.data();
  surface.normal = points.normal.data();
  surface.height = points.height.data();
  surface.base_point = points.base_point.data();
  surface.base_normal = points.base_normal.data();
  points.status = ents::call(ents_surface_evaluate, model.handle(), count, &surface).status;
  return points;
}

ents_admissibility check_admissibility(const Model& model, const std::vector<double>& master,
                                       const std::vector<double>& surface_coordinates, int samples) {
  auto result = ents::make<ents_admissibility>();
  result.samples = samples;
  ents::require(ents::linked(), ents_model_check, model.handle(), master.data(),
                data_or_null(surface_coordinates), &result);
  return result;
}

} // namespace mechanics
