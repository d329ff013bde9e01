// SPDX-License-Identifier: BSD-3-Clause
// The pictures of a run: what a person would rather look at than read.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "friction_pictures.hpp"
#include "output/pictures.hpp"
#include "result.hpp"

namespace host {
namespace {

using pictures::Chart;
using pictures::Curve;
using pictures::Style;
using std::numbers::pi;

const Quantity* find(const StepRecord& record, const std::string& name) {
  for (const Quantity& quantity : record.exact)
    if (quantity.name == name) return &quantity;
  return nullptr;
}

std::string mesh_note(const Simulation& simulation) {
  const Sizes sizes = simulation.sizes();
  return std::to_string(sizes.slaves) + " slave nodes, " + std::to_string(sizes.master_segments) +
         (sizes.master_segments == 1 ? " segment" : " segments");
}

/// Nodal pressures of the last step against the distance from the axis, with the exact distribution.
Chart pressure_profile(Simulation& simulation, const StepRecord& record) {
  const Scene& scene = simulation.scene();
  const ElementSetup& setup = scene.parts.front().setup;
  const double modulus = setup.material.contact_modulus();
  const SurfaceState state = surface_state(simulation, record);
  Chart chart;
  chart.title = "Contact pressure, last step";
  chart.x = {scene.dimension == 2 ? "x" : "distance from the axis", scene.units.length};
  chart.y = {"pressure", scene.units.pressure};
  std::vector<std::size_t> order(state.distance.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return state.distance[a] < state.distance[b]; });
  double edge = 0;
  for (const std::size_t k : order)
    if (state.closed[k]) edge = state.distance[k];

  Curve exact{"exact", {}, {}, Style::exact};
  double end = 0;
  const auto pressure = [&](double x) {
    switch (scene.exact.type) {
    case ExactSpec::Type::hertz_line: {
      const HertzLine reference = hertz_line(state.force / setup.thickness, scene.exact.radius, modulus);
      end = reference.half_width;
      return hertz_pressure(reference.peak_pressure, 1, x);
    }
    case ExactSpec::Type::hertz_point: {
      const HertzPoint reference = hertz_point(state.approach, scene.exact.radius, modulus);
      end = reference.radius;
      return hertz_pressure(reference.peak_pressure, 1, x);
    }
    case ExactSpec::Type::westergaard: {
      const double full = westergaard_full_contact(scene.exact.amplitude, scene.exact.wavelength, modulus);
      end = westergaard_half_width(full, state.mean_pressure, scene.exact.wavelength);
      return westergaard_pressure(full, state.mean_pressure, x * end, scene.exact.wavelength);
    }
    default:
      return 0.;
    }
  };
  for (int i = 0; i <= 400; ++i) {
    const double x = i / 400.;
    exact.y.push_back(pressure(x));
    exact.x.push_back(x * end);
  }
  if (end > 0) chart.curves.push_back(exact);
  Curve computed{"computed (slave nodes)", {}, {}, Style::points};
  for (const std::size_t k : order)
    if (state.distance[k] <= 1.3 * std::max(edge, end)) {
      computed.x.push_back(state.distance[k]);
      computed.y.push_back(state.pressure[k]);
    }
  chart.curves.push_back(computed);
  chart.subtitle = mesh_note(simulation);
  return chart;
}

/// Numbers of the slave nodes along the surface of a body in the plane: over x or y, along which it extends
/// farther.
/// @param record  of a step with these slave nodes
/// @param of      curves and their names
Chart along_surface(Simulation& simulation, const StepRecord& record,
                    const std::vector<std::pair<std::string, std::vector<double>>>& of) {
  const Scene& scene = simulation.scene();
  std::vector<std::array<double, 3>> places(record.areas.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    for (std::size_t c = 0; c < 2; ++c) places[k][c] = record.places[2 * k + c];
  const auto extent = [&](std::size_t c) {
    const auto [low, high] =
        std::minmax_element(places.begin(), places.end(), [&](auto& a, auto& b) { return a[c] < b[c]; });
    return (*high)[c] - (*low)[c];
  };
  const std::size_t axis = extent(1) > extent(0) ? 1 : 0;
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return places[a][axis] < places[b][axis]; });
  Chart chart;
  chart.subtitle = scene.title + "; " + mesh_note(simulation);
  chart.x = {axis == 0 ? "x of the slave nodes" : "y of the slave nodes", scene.units.length};
  for (const auto& [name, values] : of) {
    Curve curve{name, {}, {}, Style::line};
    for (const std::size_t k : order) {
      curve.x.push_back(places[k][axis]);
      curve.y.push_back(values[k]);
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

/// Cuts the x-axis to where a curve of the chart is not zero, and three tenths of that beside it.
void show_where_not_zero(Chart& chart, const Curve& curve) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (curve.y[i] != 0) low = std::min(low, curve.x[i]), high = std::max(high, curve.x[i]);
  if (!(high > low)) return;
  chart.x.min = std::max(low - 0.3 * (high - low), curve.x.front());
  chart.x.max = std::min(high + 0.3 * (high - low), curve.x.back());
}

Chart pressure_along_surface(Simulation& simulation, const StepRecord& record) {
  Chart chart = along_surface(simulation, record, {{"", record.fields.pressure}});
  show_where_not_zero(chart, chart.curves.back());
  chart.title = "Contact pressure, last step";
  chart.y = {"pressure", simulation.scene().units.pressure, false, 0};
  return chart;
}

/// What the slave has lost, at five steps of the run.
Chart worn_profile(Simulation& simulation, const std::vector<StepRecord>& records) {
  std::vector<std::pair<std::string, std::vector<double>>> profiles;
  const std::size_t last = records.size() - 1;
  for (std::size_t i = 0; i <= 4; ++i) {
    const StepRecord& record = records[i * last / 4];
    std::vector<double> profile;
    for (const double depth : record.fields.worn) profile.push_back(-depth);
    const std::string name = "step " + std::to_string(record.step);
    if (profiles.empty() || profiles.back().first != name) profiles.emplace_back(name, std::move(profile));
  }
  Chart chart = along_surface(simulation, records.back(), profiles);
  show_where_not_zero(chart, chart.curves.back());
  chart.title = "Worn profile of the slave surface";
  chart.y = {"worn off", simulation.scene().units.length};
  return chart;
}

Chart westergaard_curve(const Simulation& simulation, const std::vector<StepRecord>& records) {
  Chart chart;
  chart.title = "Mean pressure against contact width";
  chart.subtitle = "Westergaard: mean pressure / p* = sin²(π a/λ); " + mesh_note(simulation);
  chart.x = {"a/λ", "", false, 0, 0.5};
  chart.y = {"mean pressure / p*", "", false, 0, 1.05};
  Curve exact{"exact", {}, {}, Style::exact}, computed{"computed", {}, {}, Style::points};
  for (int i = 0; i <= 200; ++i) {
    exact.x.push_back(i / 400.);
    exact.y.push_back(std::pow(std::sin(pi * i / 400.), 2));
  }
  for (const StepRecord& record : records) {
    const Quantity* width = find(record, "half-width / lambda");
    const Quantity* mean = find(record, "mean pressure / p*");
    if (width == nullptr || mean == nullptr) continue;
    computed.x.push_back(width->value);
    computed.y.push_back(mean->value);
  }
  chart.curves = {exact, computed};
  return chart;
}

Chart force_curve(const Simulation& simulation, const std::vector<StepRecord>& records) {
  const Scene& scene = simulation.scene();
  const double modulus = scene.parts.front().setup.material.contact_modulus();
  Chart chart;
  chart.title = "Force against approach";
  chart.subtitle = "Hertz: F = 4/3 E* √(R δ³); " + mesh_note(simulation);
  chart.x = {"approach", scene.units.length, false, 0};
  chart.y = {"force", scene.units.force, false, 0};
  Curve exact{"exact", {}, {}, Style::exact}, computed{"computed", {}, {}, Style::points};
  for (int i = 0; i <= 200; ++i) {
    const double approach = records.back().approach * i / 200;
    exact.x.push_back(approach);
    exact.y.push_back(i == 0 ? 0 : hertz_point(approach, scene.exact.radius, modulus).force);
  }
  for (const StepRecord& record : records) {
    computed.x.push_back(record.approach);
    computed.y.push_back(record.force);
  }
  chart.curves = {exact, computed};
  return chart;
}

/// Contact fraction or mean gap of all steps against the mean pressure, or against the step where that is held.
Chart against_pressure(const Simulation& simulation, const std::vector<StepRecord>& records, bool gap) {
  const Scene& scene = simulation.scene();
  const double first = records.front().mean_pressure;
  const bool held = records.size() > 1 && std::all_of(records.begin(), records.end(), [&](auto& record) {
                      return std::abs(record.mean_pressure - first) <= 1e-3 * std::abs(first);
                    });
  Chart chart;
  chart.title = std::string(gap ? "Mean gap" : "Contact fraction") +
                (held ? " over the steps" : " against mean pressure");
  chart.subtitle = mesh_note(simulation);
  chart.x =
      held ? pictures::Axis{"step", ""} : pictures::Axis{"mean pressure", scene.units.pressure, false, 0};
  chart.y = gap ? pictures::Axis{"mean gap", scene.units.length, false, 0}
                : pictures::Axis{"contact area / apparent area", "%", false, 0};
  Curve curve;
  for (const StepRecord& record : records) {
    curve.x.push_back(held ? record.step : record.mean_pressure);
    curve.y.push_back(gap ? record.mean_gap : 100 * record.contact_fraction);
  }
  if (*std::min_element(curve.y.begin(), curve.y.end()) < 0) chart.y.min = pictures::automatic; // worn off
  chart.curves = {curve};
  if (gap) return chart;
  Curve estimate{"computed, corrected between the nodes", curve.x, {}, Style::line};
  for (const StepRecord& record : records) estimate.y.push_back(100 * record.area.fraction);
  if (std::isfinite(estimate.y.front())) {
    chart.curves[0].label = "computed (slave nodes)";
    chart.curves.push_back(estimate);
  }
  if (simulation.exact_layer() == nullptr) return chart;
  chart.curves[0].label = "computed (slave nodes)";
  Curve exact{"boundary elements, hard contact", {}, {}, Style::exact};
  for (const StepRecord& record : records)
    for (const Quantity& quantity : record.exact) {
      if (quantity.name == "mean pressure") exact.x.push_back(held ? record.step : quantity.exact);
      if (quantity.name == "contact fraction") exact.y.push_back(100 * quantity.exact);
    }
  chart.curves.push_back(exact);
  return chart;
}

/// Heights of the surface of ONE rigid segment that lie over a rectangle, measured along the motion of the
/// master; without values unless the surface's points form a grid along x and y there (a flat quad4 parallel
/// to the axes).
pictures::Map height_map(const Simulation& simulation, const Contact& contact, pictures::Maps& frame) {
  pictures::Map map;
  const Master& master = contact.master();
  if (!master.rigid || master.segments() != 1 || master.triangles || simulation.mesh().dimension != 3)
    return map;
  const SurfaceSample sample = sample_surface(*master.model, master.positions, {}, even_grid(2, 512));
  // xi_1 may run along either axis: the points' own coordinates sort them.
  const auto grid_line = [&](double position) {
    return std::llround(position / (1e-6 * (frame.x_max - frame.x_min)));
  };
  std::map<std::pair<long long, long long>, double> heights; // by y, then x
  std::map<long long, int> columns, rows;
  for (std::size_t k = 0; k < sample.height.size(); ++k) {
    const double x = sample.point[3 * k], y = sample.point[3 * k + 1];
    const double margin = 1e-6 * (frame.x_max - frame.x_min);
    if (x < frame.x_min - margin || x > frame.x_max + margin || y < frame.y_min - margin ||
        y > frame.y_max + margin)
      continue;
    heights[{grid_line(y), grid_line(x)}] = sample.height[k];
    ++columns[grid_line(x)], ++rows[grid_line(y)];
  }
  if (heights.empty() || columns.size() * rows.size() != heights.size()) return map;
  map.title = "height of the rigid surface", map.unit = simulation.scene().units.length;
  map.columns = static_cast<int>(columns.size()), map.rows = static_cast<int>(rows.size());
  map.at_nodes = true, map.palette = pictures::Map::Palette::cividis;
  for (const auto& [place, height] : heights) map.values.push_back(height);
  return map;
}

/// Fields on slave nodes that form a regular grid; no maps otherwise.
pictures::Maps surface_maps(Simulation& simulation, const StepRecord& record) {
  pictures::Maps maps;
  const Scene& scene = simulation.scene();
  if (scene.dimension != 3) return maps;
  const std::size_t slaves = record.areas.size();
  std::map<double, int> columns, rows;
  for (std::size_t k = 0; k < slaves; ++k) {
    columns.emplace(record.places[3 * k], 0);
    rows.emplace(record.places[3 * k + 1], 0);
  }
  if (columns.size() * rows.size() != slaves || columns.size() < 3 || rows.size() < 3) return maps;
  const auto regular = [](std::map<double, int>& axis) {
    const double step = (axis.rbegin()->first - axis.begin()->first) / static_cast<double>(axis.size() - 1);
    int index = 0;
    bool even = true;
    for (auto& [position, number] : axis) {
      even = even && std::abs(position - axis.begin()->first - index * step) < 1e-6 * step;
      number = index++;
    }
    return even;
  };
  if (!regular(columns) || !regular(rows)) return maps;
  maps.title = scene.title;
  const double estimate = record.area.fraction; // the count of nodes is too large
  maps.subtitle =
      "mean pressure " + format_number(record.mean_pressure, 3) + " " + scene.units.pressure + ", contact " +
      format_number(100 * (std::isfinite(estimate) ? estimate : record.contact_fraction), 3) + " %";
  maps.unit = scene.units.length;
  maps.x_min = columns.begin()->first, maps.x_max = columns.rbegin()->first;
  maps.y_min = rows.begin()->first, maps.y_max = rows.rbegin()->first;
  pictures::Map pressure;
  pressure.title = "contact pressure", pressure.unit = scene.units.pressure;
  pressure.blank_zero = pressure.at_nodes = true, pressure.clip = 0.99;
  pressure.columns = static_cast<int>(columns.size()), pressure.rows = static_cast<int>(rows.size());
  pressure.values.assign(slaves, 0.0);
  pictures::Map difference = pressure;
  difference.title = "pressure - boundary elements";
  difference.blank_zero = false, difference.palette = pictures::Map::Palette::diverging;
  for (std::size_t k = 0; k < slaves; ++k) {
    const auto at = static_cast<std::size_t>(rows.at(record.places[3 * k + 1]) * pressure.columns +
                                             columns.at(record.places[3 * k]));
    pressure.values[at] = record.fields.pressure[k];
    if (!record.exact_pressure.empty())
      difference.values[at] = record.fields.pressure[k] - record.exact_pressure[k];
  }
  pictures::Map height = height_map(simulation, *simulation.contact(), maps);
  if (!height.values.empty()) maps.maps.push_back(std::move(height));
  maps.maps.push_back(std::move(pressure));
  if (!record.exact_pressure.empty()) maps.maps.push_back(std::move(difference));
  return maps;
}

/// What is drawn of this kind of scene.
void add_pictures(Simulation& simulation, const std::vector<StepRecord>& records, pictures::Pictures& drawn) {
  std::vector<std::vector<double>> residuals;
  std::vector<std::string> labels;
  const std::size_t every = 1 + records.size() / 13; // of many steps a dozen
  for (std::size_t i = records.size() % every; i < records.size(); i += every) {
    residuals.push_back(records[i].increments.back().residuals);
    labels.push_back("step " + std::to_string(records[i].step));
  }
  drawn.add("residuals", pictures::residual_history("Newton's iteration", residuals, labels));
  if (simulation.contact() == nullptr) return;
  const ExactSpec::Type type = simulation.scene().exact.type;
  const bool along_line = type != ExactSpec::Type::none && type != ExactSpec::Type::double_sine &&
                          type != ExactSpec::Type::boundary_elements &&
                          type != ExactSpec::Type::worn_cylinder; // the exact pressure
  if (simulation.scene().control == Control::load_factor && records.size() > 1)
    drawn.add("force", force_history(simulation.scene(), records));
  if (type == ExactSpec::Type::screw) drawn.add("torque", screw_torque_history(simulation.scene(), records));
  if (type == ExactSpec::Type::slope || type == ExactSpec::Type::screw) return;
  if (type == ExactSpec::Type::cattaneo) {
    drawn.add("traction", partial_slip_profile(simulation, records.back()));
    return;
  }
  if (simulation.scene().dimension == 2 && !records.back().fields.worn.empty())
    drawn.add("worn", worn_profile(simulation, records));
  if ((type == ExactSpec::Type::none || type == ExactSpec::Type::worn_cylinder) &&
      simulation.scene().dimension == 2)
    drawn.add("pressure", pressure_along_surface(simulation, records.back()));
  if (along_line) drawn.add("pressure", pressure_profile(simulation, records.back()));
  if (type == ExactSpec::Type::westergaard) drawn.add("westergaard", westergaard_curve(simulation, records));
  if (type == ExactSpec::Type::hertz_point) drawn.add("force", force_curve(simulation, records));
  if (simulation.scene().control != Control::load_factor && !along_line) {
    drawn.add("contact_fraction", against_pressure(simulation, records, false));
    drawn.add("mean_gap", against_pressure(simulation, records, true));
    if (const pictures::Maps maps = surface_maps(simulation, records.back()); !maps.maps.empty())
      drawn.add("pressure_map", maps);
  }
}

} // namespace

std::string draw_pictures(Simulation& simulation, const std::vector<StepRecord>& records,
                          const std::filesystem::path& folder) {
  pictures::Pictures drawn;
  add_pictures(simulation, records, drawn);
  return drawn.draw(folder);
}

std::string draw_comparison(const Scene& scene, const Comparison& comparison,
                            const std::filesystem::path& folder) {
  Chart chart;
  chart.title = "Explicit mesh of plain segments against one enriched segment";
  chart.subtitle = scene.title;
  chart.x = {"segments per direction", "", true};
  chart.y = {"relative difference of the surface displacement", "", true};
  Curve curve{"explicit mesh", {}, {}, Style::both, true};
  for (const CompareRow& row : comparison.explicit_meshes) {
    curve.x.push_back(row.divisions);
    curve.y.push_back(row.difference);
  }
  chart.curves = {curve};
  chart.slope_triangle = 2;
  pictures::Pictures drawn;
  drawn.add("compare", chart);
  return drawn.draw(folder);
}

} // namespace host
