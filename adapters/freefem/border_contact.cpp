// SPDX-License-Identifier: BSD-3-Clause
#include "border_contact.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace freefem {
namespace {

std::int64_t signed_size(std::size_t size) { return static_cast<std::int64_t>(size); }
std::int64_t edges(const Border& border) { return signed_size(border.edges.size() / 2); }
std::int64_t nodes(const Border& border) { return signed_size(border.vertices.size()); }

/// For calls that no smaller step cures: any other status than ENTS_OK is thrown.
template <class... Parameters, class... Arguments>
void require(std::int32_t (*function)(Parameters...), Arguments... arguments) {
  ents::require(ents::linked(), function, arguments...);
}

bool is_text(const std::string& model) {
  const std::size_t first = model.find_first_not_of(" \t\r\n");
  return first != std::string::npos && model[first] == '{';
}

ents::Model read(const std::string& model) {
  require(ents_check_contract, std::int32_t{ENTS_CONTRACT_MAJOR}, std::int32_t{ENTS_CONTRACT_MINOR});
  return is_text(model) ? ents::Model(model) : ents::Model::from_file(model);
}

/// The basis of a smoothed segment that the text names, or "".
std::string smoothed_basis(const std::string& text) {
  for (const char* basis : {"catmull_rom4", "bspline4"})
    if (text.find('"' + std::string(basis) + '"') != std::string::npos) return basis;
  return "";
}

} // namespace

BorderContact::BorderContact(const std::string& model, Border slave, Border master, long vertices,
                             const Options& options)
    : model_(read(model)), slave_(std::move(slave)), master_(std::move(master)),
      components_(model_.layout().node_dofs), dofs_(components_ * vertices), reach_(options.reach) {
  make_segments(basis_of(model), options);
  make_tree(options);
  const std::size_t n = slave_.vertices.size();
  areas_.resize(n);
  require(ents_tributary_areas, "line2", edges(slave_), slave_.edges.data(), nodes(slave_),
          slave_.start.data(), options.thickness, areas_.data());
  segment_.assign(n, -1);
  segment_begin_ = segment_;
  xi_.assign(n, 0.0);
  xi_begin_ = xi_;
  states_ = ents::States(model_, signed_size(n));
}

std::string BorderContact::basis_of(const std::string& model) const {
  std::string text = model;
  if (!is_text(model)) {
    std::ostringstream read;
    read << std::ifstream(model).rdbuf();
    text = read.str();
  }
  const ents_layout& layout = model_.layout();
  const std::string basis = smoothed_basis(text);
  if (layout.dimension != 2 || (layout.nodes != 2 && basis.empty()))
    throw std::runtime_error(
        "the model's \"segment\" must be line2, catmull_rom4 or bspline4: borders have straight edges");
  if (layout.multipliers > 0)
    throw std::runtime_error(
        "the model has multipliers as unknowns, which a space [P1, P1] has no place for: take \"penalty\"");
  return basis;
}

void BorderContact::make_segments(const std::string& basis, const Options& options) {
  if (basis.empty()) {
    segments_ = master_.edges;
    for (std::int64_t i = 0; i < nodes(master_); ++i)
      net_.begin.push_back(i), net_.nodes.push_back(i), net_.weights.push_back(1);
    net_.begin.push_back(nodes(master_));
    return;
  }
  std::int64_t count = 0, terms = 0;
  require(ents_smooth_size, "line2", basis.c_str(), options.ends, edges(master_), master_.edges.data(),
          nodes(master_), &count, &terms);
  segments_.resize(static_cast<std::size_t>(edges(master_) * model_.layout().nodes));
  net_.begin.resize(static_cast<std::size_t>(count + 1));
  net_.nodes.resize(static_cast<std::size_t>(terms));
  net_.weights.resize(static_cast<std::size_t>(terms));
  require(ents_smooth, "line2", basis.c_str(), options.ends, edges(master_), master_.edges.data(),
          nodes(master_), count, terms, segments_.data(), net_.begin.data(), net_.nodes.data(),
          net_.weights.data());
}

void BorderContact::make_tree(const Options& options) {
  const std::vector<double> at_rest(static_cast<std::size_t>(dofs_), 0.0);
  points_ = points_begin_ = control_points(2, positions(master_, at_rest.data()));
  now_ = now_begin_ = positions(slave_, at_rest.data());
  if (options.coordinate > 1) throw std::runtime_error("coordinate: 0 (x) or 1 (y)");
  for (std::size_t a = 0; options.coordinate >= 0 && a < segments_.size(); ++a)
    coordinates_.push_back(
        points_[2 * static_cast<std::size_t>(segments_[a]) + static_cast<std::size_t>(options.coordinate)]);
  mesh_ = ents::make<ents_master_mesh>();
  mesh_.segments = edges(master_), mesh_.connectivity = segments_.data();
  mesh_.nodes = signed_size(points_.size() / 2), mesh_.positions = points_.data();
  mesh_.surface_coordinates = coordinates_.empty() ? nullptr : coordinates_.data();
  tree_ = ents::Tree(model_, mesh_);
  for (std::size_t e = 0; options.reach <= 0 && e < master_.edges.size(); e += 2) {
    const double *a = &master_.start[2 * static_cast<std::size_t>(master_.edges[e])],
                 *b = &master_.start[2 * static_cast<std::size_t>(master_.edges[e + 1])];
    reach_ = std::max(reach_, std::hypot(b[0] - a[0], b[1] - a[1]));
  }
}

std::vector<double> BorderContact::positions(const Border& border, const double* u) const {
  std::vector<double> result = border.start;
  for (std::size_t a = 0; a < border.vertices.size(); ++a)
    for (std::size_t i = 0; i < 2; ++i)
      result[2 * a + i] += u[first_dof(border.vertices[a]) + static_cast<long>(i)];
  return result;
}

std::vector<double> BorderContact::temperatures(const Border& border, const double* u) const {
  std::vector<double> result;
  for (const int vertex : border.vertices) result.push_back(u[first_dof(vertex) + 2]);
  return result;
}

std::vector<double> BorderContact::control_points(std::int32_t values,
                                                  const std::vector<double>& of_nodes) const {
  const ents_combination net = net_.get();
  std::vector<double> result(static_cast<std::size_t>(values * net.points));
  require(ents_combine, &net, values, nodes(master_), of_nodes.data(), result.data());
  return result;
}

/// What a local node of slave k's element is in the mesh: first dof and weight of each vertex.
void BorderContact::terms(std::size_t k, std::size_t local, std::vector<Term>& of) const {
  of.clear();
  if (local == 0) {
    of.push_back({first_dof(slave_.vertices[k]), 1.0});
    return;
  }
  const auto m = static_cast<std::size_t>(model_.layout().nodes);
  const auto point =
      static_cast<std::size_t>(segments_[static_cast<std::size_t>(segment_[k]) * m + local - 1]);
  const auto begin = static_cast<std::size_t>(net_.begin[point]),
             end = static_cast<std::size_t>(net_.begin[point + 1]);
  for (std::size_t j = begin; j < end; ++j)
    of.push_back({first_dof(master_.vertices[static_cast<std::size_t>(net_.nodes[j])]), net_.weights[j]});
}

void BorderContact::require_sizes(long u, long r) const {
  if (u == dofs_ && r == dofs_) return;
  const bool heat = model_.layout().heat != 0;
  throw std::runtime_error(
      "u has " + std::to_string(u) + " entries, and r " + std::to_string(r) + "; the model has " +
      (heat ? "\"heat\": write u[] of a space [P1, P1, P1] on the mesh, two displacements and the temperature"
            : "no \"heat\": write u[] of a space [P1, P1] on the mesh, two displacements") +
      ", " + std::to_string(dofs_) + " entries, and an r of that size");
}

void BorderContact::place(const double* u) {
  now_ = positions(slave_, u);
  points_ = control_points(2, positions(master_, u));
  mesh_.positions = points_.data();
  if (model_.layout().heat) {
    slave_temperatures_ = temperatures(slave_, u);
    point_temperatures_ = control_points(1, temperatures(master_, u));
    mesh_.temperature = point_temperatures_.data();
  }
  tree_.refit(model_, mesh_);
}

ents::Result BorderContact::iterate(double dt, const ents_output& out) {
  auto detection = ents::make<ents_detection>();
  detection.slave = now_.data(), detection.reach = reach_;
  detection.segment = segment_.data(), detection.xi = xi_.data();
  auto in = ents::make<ents_input>();
  in.area = areas_.data(), in.area_stride = 1;
  in.state_begin = states_.begin.data(), in.state_begin_stride = states_.size;
  in.positions_begin = points_begin_.data(), in.slave_begin = now_begin_.data();
  in.slave_temperature = slave_temperatures_.data(), in.slave_temperature_stride = 1;
  in.time_increment = dt;
  try {
    return ents::call(ents_iterate, model_.get(), &mesh_, tree_.data(), tree_.size(), 0,
                      signed_size(areas_.size()), &detection, &in, &out, nullptr);
  } catch (const ents::Error& error) {
    const bool of_time = std::string(error.what()).find("time_increment") != std::string::npos;
    throw std::runtime_error(error.what() + std::string(of_time ? ": write entsForces(..., dt=...)" : ""));
  }
}

Forces BorderContact::evaluate(const double* u, double* r, double dt) {
  place(u);
  const std::size_t n = areas_.size(), dofs = static_cast<std::size_t>(model_.layout().dofs);
  std::vector<double> residual(n * dofs), tangent(n * dofs * dofs);
  std::vector<std::int32_t> flags(n);
  auto out = ents::make<ents_output>();
  out.wanted = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS | ENTS_STATE;
  out.residual = residual.data(), out.residual_stride = signed_size(dofs);
  out.tangent = tangent.data(), out.tangent_stride = signed_size(dofs * dofs);
  out.flags = flags.data(), out.flags_stride = 1;
  out.state_end = states_.end.data(), out.state_end_stride = states_.size;
  const ents::Result done = iterate(dt, out);
  Forces result;
  if (!done.ok()) {
    reject();
    const double factor = done.report.step_factor;
    result.step_factor = factor > 0 && factor < 1 ? factor : 0.5;
    result.message = ents::describe(ents::linked(), done.status, done.report);
    return result;
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (segment_[k] >= 0) // an open gap has no force, but may conduct heat
      add_element(k, residual.data() + k * dofs, tangent.data() + k * dofs * dofs, r, result);
    // An open node is searched anew: it may move over another flank, or leave the master.
    if ((flags[k] & ENTS_FLAG_CONTACT) == 0) segment_[k] = -1;
  }
  return result;
}

void BorderContact::add_element(std::size_t k, const double* residual, const double* tangent, double* r,
                                Forces& to) const {
  const auto dofs = static_cast<std::size_t>(model_.layout().dofs);
  const auto of_node = static_cast<std::size_t>(components_);
  std::vector<Term> rows, columns;
  for (std::size_t a = 0; a < dofs; ++a) {
    const auto i = static_cast<long>(a % of_node);
    terms(k, a / of_node, rows);
    for (const Term& row : rows) r[row.dof + i] += row.weight * residual[a];
    for (std::size_t b = 0; b < dofs; ++b) {
      const double stiffness = tangent[b * dofs + a]; // column-major
      if (stiffness == 0) continue;
      const auto j = static_cast<long>(b % of_node);
      terms(k, b / of_node, columns);
      for (const Term& row : rows)
        for (const Term& column : columns) {
          to.row.push_back(row.dof + i);
          to.column.push_back(column.dof + j);
          to.value.push_back(row.weight * column.weight * stiffness);
        }
    }
  }
}

void BorderContact::accept() {
  segment_begin_ = segment_;
  xi_begin_ = xi_;
  states_.begin = states_.end;
  points_begin_ = points_;
  now_begin_ = now_;
}

void BorderContact::reject() {
  segment_ = segment_begin_;
  xi_ = xi_begin_;
  states_.end = states_.begin;
  points_ = points_begin_;
  now_ = now_begin_;
}

} // namespace freefem
