// SPDX-License-Identifier: BSD-3-Clause
#include "border_contact.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace freefem {
namespace {

template <class Struct> Struct made() {
  Struct result{};
  result.struct_size = static_cast<std::int32_t>(sizeof(Struct));
  return result;
}

std::int64_t signed_size(std::size_t size) { return static_cast<std::int64_t>(size); }
std::int64_t edges(const Border& border) { return signed_size(border.edges.size() / 2); }
std::int64_t nodes(const Border& border) { return signed_size(border.vertices.size()); }

/// Mistakes end here; recoverable statuses are the caller's.
std::int32_t check(std::int32_t status, const ents_report& report) {
  if (status < 0) throw std::runtime_error(report.message);
  return status;
}

/// For calls that no smaller step cures: any other status than ENTS_OK ends here.
void require(std::int32_t status, const ents_report& report) {
  if (check(status, report) != ENTS_OK) throw std::runtime_error(report.message);
}

/// The basis of a smoothed segment that the text names, or "".
std::string smoothed_basis(const std::string& text) {
  for (const char* basis : {"catmull_rom4", "bspline4"})
    if (text.find('"' + std::string(basis) + '"') != std::string::npos) return basis;
  return "";
}

} // namespace

BorderContact::BorderContact(const std::string& model, Border slave, Border master, long dofs,
                             const Options& options)
    : slave_(std::move(slave)), master_(std::move(master)), dofs_(dofs), reach_(options.reach) {
  auto report = made<ents_report>();
  require(ents_check_contract(ENTS_CONTRACT_MAJOR, ENTS_CONTRACT_MINOR, &report), report);
  make_segments(read_model(model), options);
  make_tree(options);
  const std::size_t n = slave_.vertices.size();
  areas_.resize(n);
  require(ents_tributary_areas("line2", edges(slave_), slave_.edges.data(), nodes(slave_),
                               slave_.start.data(), options.thickness, areas_.data(), &report),
          report);
  segment_.assign(n, -1);
  segment_begin_ = segment_;
  xi_.assign(n, 0.0);
  xi_begin_ = xi_;
  state_begin_.assign(n * static_cast<std::size_t>(layout_.state_size), 0.0);
  require(ents_state_init(model_.get(), signed_size(n), state_begin_.data(), layout_.state_size, &report),
          report);
  state_end_ = state_begin_;
}

std::string BorderContact::read_model(const std::string& model) {
  auto report = made<ents_report>();
  std::string text = model;
  ents_model* created = nullptr;
  const std::size_t first = model.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && model[first] == '{') {
    require(
        ents_model_create(model.data(), signed_size(model.size()), nullptr, nullptr, 0, &created, &report),
        report);
  } else {
    require(ents_model_create_from_file(model.c_str(), &created, &report), report);
    std::ostringstream read;
    read << std::ifstream(model).rdbuf();
    text = read.str();
  }
  model_.reset(created);
  layout_ = made<ents_layout>();
  require(ents_model_layout(model_.get(), &layout_, &report), report);
  const std::string basis = smoothed_basis(text);
  if (layout_.dimension != 2 || (layout_.nodes != 2 && basis.empty()))
    throw std::runtime_error(
        "the model's \"segment\" must be line2, catmull_rom4 or bspline4: borders have straight edges");
  if (layout_.multipliers > 0)
    throw std::runtime_error(
        "the model has multipliers as unknowns, which a space [P1, P1] has no place for: take \"penalty\"");
  if (layout_.heat)
    throw std::runtime_error(
        "the model has \"heat\", which takes a temperature in each node, and a space [P1, P1] "
        "has displacements alone: remove \"heat\" from \"contact\"");
  return basis;
}

void BorderContact::make_segments(const std::string& basis, const Options& options) {
  auto report = made<ents_report>();
  if (basis.empty()) {
    segments_ = master_.edges;
    for (std::int64_t i = 0; i < nodes(master_); ++i)
      begin_.push_back(i), of_.push_back(i), weights_.push_back(1);
    begin_.push_back(nodes(master_));
  } else {
    std::int64_t count = 0, terms = 0;
    require(ents_smooth_size("line2", basis.c_str(), options.ends, edges(master_), master_.edges.data(),
                             nodes(master_), &count, &terms, &report),
            report);
    segments_.resize(static_cast<std::size_t>(edges(master_) * layout_.nodes));
    begin_.resize(static_cast<std::size_t>(count + 1));
    of_.resize(static_cast<std::size_t>(terms));
    weights_.resize(static_cast<std::size_t>(terms));
    require(ents_smooth("line2", basis.c_str(), options.ends, edges(master_), master_.edges.data(),
                        nodes(master_), count, terms, segments_.data(), begin_.data(), of_.data(),
                        weights_.data(), &report),
            report);
  }
}

void BorderContact::make_tree(const Options& options) {
  auto report = made<ents_report>();
  const std::vector<double> at_rest(static_cast<std::size_t>(dofs_), 0.0);
  points_ = points_begin_ = points(at_rest.data());
  now_ = now_begin_ = positions(slave_, at_rest.data());
  if (options.coordinate > 1) throw std::runtime_error("coordinate: 0 (x) or 1 (y)");
  for (std::size_t a = 0; options.coordinate >= 0 && a < segments_.size(); ++a)
    coordinates_.push_back(
        points_[2 * static_cast<std::size_t>(segments_[a]) + static_cast<std::size_t>(options.coordinate)]);
  mesh_ = made<ents_master_mesh>();
  mesh_.segments = edges(master_), mesh_.connectivity = segments_.data();
  mesh_.nodes = signed_size(points_.size() / 2), mesh_.positions = points_.data();
  mesh_.surface_coordinates = coordinates_.empty() ? nullptr : coordinates_.data();
  std::int64_t size = 0;
  require(ents_tree_size(model_.get(), mesh_.segments, &size, &report), report);
  tree_.resize(static_cast<std::size_t>(size));
  require(ents_tree_build(model_.get(), &mesh_, tree_.data(), size, &report), report);
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
      result[2 * a + i] += u[2 * static_cast<std::size_t>(border.vertices[a]) + i];
  return result;
}

std::vector<double> BorderContact::points(const double* u) const {
  const std::vector<double> now = positions(master_, u);
  auto combination = made<ents_combination>();
  combination.points = signed_size(begin_.size()) - 1;
  combination.begin = begin_.data(), combination.nodes = of_.data(), combination.weights = weights_.data();
  std::vector<double> result(2 * static_cast<std::size_t>(combination.points));
  auto report = made<ents_report>();
  require(ents_combine(&combination, 2, nodes(master_), now.data(), result.data(), &report), report);
  return result;
}

/// The begin of the increment, as the slave's present segment sees it. Returns a status that is not negative.
std::int32_t BorderContact::transfer(std::size_t k, double* state, ents_report& report) const {
  const auto size = static_cast<std::size_t>(layout_.state_size), m = static_cast<std::size_t>(layout_.nodes);
  if (segment_begin_[k] < 0)
    return check(ents_state_init(model_.get(), 1, state, layout_.state_size, &report), report);
  if (segment_begin_[k] == segment_[k]) {
    std::copy_n(state_begin_.data() + k * size, size, state);
    return ENTS_OK;
  }
  std::vector<double> from, to;
  const auto gather = [&](std::int64_t segment, std::vector<double>& into) {
    for (std::size_t a = 0; a < m; ++a) {
      const auto point = static_cast<std::size_t>(segments_[static_cast<std::size_t>(segment) * m + a]);
      into.insert(into.end(), {points_begin_[2 * point], points_begin_[2 * point + 1]});
    }
    return coordinates_.empty() ? nullptr : coordinates_.data() + static_cast<std::size_t>(segment) * m;
  };
  const double *old_coordinates = gather(segment_begin_[k], from), *coordinates = gather(segment_[k], to);
  return check(ents_state_transfer(model_.get(), from.data(), old_coordinates, to.data(), coordinates,
                                   state_begin_.data() + k * size, state, &report),
               report);
}

/// The state of a slave that was open at the begin of the increment, as its present segment sees it there: what
/// touches within the increment slips from there. False: not known.
bool BorderContact::find_begin(std::size_t k, double* state) const {
  ents_master_mesh mesh = mesh_;
  mesh.positions = points_begin_.data();
  std::vector<double> end(static_cast<std::size_t>(layout_.state_size));
  auto in = made<ents_input>();
  in.slave = now_begin_.data() + 2 * k;
  in.mesh = &mesh, in.segment = &segment_[k];
  in.start = &xi_[k], in.area = &areas_[k], in.state_begin = state;
  auto out = made<ents_output>();
  out.wanted = ENTS_STATE, out.state_end = end.data();
  auto report = made<ents_report>();
  if (check(ents_evaluate(model_.get(), 0, 1, &in, &out, &report), report) != ENTS_OK) return false;
  std::copy(end.begin(), end.end(), state);
  return true;
}

/// What a local node of slave k's element is in the mesh: first dof and weight of each vertex.
void BorderContact::terms(std::size_t k, std::size_t local, std::vector<Term>& of) const {
  of.clear();
  if (local == 0) {
    of.push_back({2L * slave_.vertices[k], 1.0});
    return;
  }
  const auto m = static_cast<std::size_t>(layout_.nodes);
  const auto point =
      static_cast<std::size_t>(segments_[static_cast<std::size_t>(segment_[k]) * m + local - 1]);
  for (auto j = static_cast<std::size_t>(begin_[point]); j < static_cast<std::size_t>(begin_[point + 1]); ++j)
    of.push_back({2L * master_.vertices[static_cast<std::size_t>(of_[j])], weights_[j]});
}

Forces BorderContact::evaluate(const double* u, double* r) {
  Forces result;
  auto report = made<ents_report>();
  const auto cut = [&](const ents_report& why) {
    reject();
    result = {};
    result.step_factor = why.step_factor > 0 && why.step_factor < 1 ? why.step_factor : 0.5;
    result.message = why.message;
    return result;
  };
  const std::size_t n = slave_.vertices.size(), size = static_cast<std::size_t>(layout_.state_size),
                    dofs = static_cast<std::size_t>(layout_.dofs);
  const std::vector<double> slave = now_ = positions(slave_, u);
  points_ = points(u);
  mesh_.positions = points_.data();
  require(ents_tree_refit(model_.get(), &mesh_, tree_.data(), signed_size(tree_.size()), &report), report);
  std::vector<std::int32_t> flags(n);
  auto detection = made<ents_detection>();
  detection.slave = slave.data(), detection.reach = reach_;
  detection.segment = segment_.data(), detection.xi = xi_.data(), detection.flags = flags.data();
  if (check(ents_detect(model_.get(), &mesh_, tree_.data(), signed_size(tree_.size()), 0, signed_size(n),
                        &detection, &report),
            report) != ENTS_OK)
    return cut(report);

  std::vector<std::size_t> closed;
  std::vector<std::int64_t> segment;
  std::vector<double> position, xi, area, state(n * size);
  for (std::size_t k = 0; k < n; ++k) {
    if ((flags[k] & ENTS_FLAG_BEHIND_EDGE) != 0) {
      constexpr char why[] = "a slave node is behind an edge between segments: smaller steps, a wider "
                             "border, or a smoothed segment";
      std::copy(std::begin(why), std::end(why), report.message);
      return cut(report);
    }
    if (segment_[k] < 0) continue;
    double* const of_slave = state.data() + closed.size() * size;
    if (transfer(k, of_slave, report) != ENTS_OK) return cut(report);
    if (undeformed_ && (layout_.needs & ENTS_NEEDS_FIRST_STATE) != 0) find_begin(k, of_slave);
    closed.push_back(k);
    segment.push_back(segment_[k]);
    position.insert(position.end(), {slave[2 * k], slave[2 * k + 1]});
    xi.push_back(xi_[k]);
    area.push_back(areas_[k]);
  }

  std::vector<double> residual(closed.size() * dofs), tangent(closed.size() * dofs * dofs),
      end(closed.size() * size);
  std::vector<std::int32_t> outcome(closed.size());
  auto in = made<ents_input>();
  in.slave = position.data(), in.slave_stride = 2;
  in.start = xi.data(), in.start_stride = 1;
  in.area = area.data(), in.area_stride = 1;
  in.mesh = &mesh_, in.segment = segment.data(), in.segment_stride = 1;
  auto out = made<ents_output>();
  out.wanted = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_FLAGS;
  out.flags = outcome.data(), out.flags_stride = 1;
  out.residual = residual.data(), out.residual_stride = signed_size(dofs);
  out.tangent = tangent.data(), out.tangent_stride = signed_size(dofs * dofs);
  if (size > 0) {
    in.state_begin = state.data(), in.state_begin_stride = signed_size(size);
    out.wanted |= ENTS_STATE;
    out.state_end = end.data(), out.state_end_stride = signed_size(size);
  }
  const auto evaluate_all = [&] {
    return check(ents_evaluate(model_.get(), 0, signed_size(closed.size()), &in, &out, &report), report);
  };
  if (evaluate_all() != ENTS_OK) return cut(report);
  bool found = false;
  for (std::size_t e = 0; e < closed.size(); ++e)
    if ((outcome[e] & ENTS_FLAG_NO_BEGIN) != 0)
      found = find_begin(closed[e], state.data() + e * size) || found;
  if (found && evaluate_all() != ENTS_OK) return cut(report);

  for (std::size_t e = 0; e < closed.size(); ++e) {
    std::copy_n(end.data() + e * size, size, state_end_.data() + closed[e] * size);
    add_element(closed[e], residual.data() + e * dofs, tangent.data() + e * dofs * dofs, r, result);
    // An open node is searched anew: it may move over another flank, or leave the master.
    if ((outcome[e] & ENTS_FLAG_CONTACT) == 0) segment_[closed[e]] = -1;
  }
  return result;
}

void BorderContact::add_element(std::size_t k, const double* residual, const double* tangent, double* r,
                                Forces& to) const {
  const auto dofs = static_cast<std::size_t>(layout_.dofs);
  std::vector<Term> rows, columns;
  for (std::size_t a = 0; a < dofs; ++a) {
    terms(k, a / 2, rows);
    for (const Term& row : rows) r[row.dof + static_cast<long>(a % 2)] += row.weight * residual[a];
    for (std::size_t b = 0; b < dofs; ++b) {
      const double stiffness = tangent[b * dofs + a]; // column-major
      if (stiffness == 0) continue;
      terms(k, b / 2, columns);
      for (const Term& row : rows)
        for (const Term& column : columns) {
          to.row.push_back(row.dof + static_cast<long>(a % 2));
          to.column.push_back(column.dof + static_cast<long>(b % 2));
          to.value.push_back(row.weight * column.weight * stiffness);
        }
    }
  }
}

void BorderContact::accept() {
  segment_begin_ = segment_;
  xi_begin_ = xi_;
  state_begin_ = state_end_;
  points_begin_ = points_;
  now_begin_ = now_;
  undeformed_ = false;
}

void BorderContact::reject() {
  segment_ = segment_begin_;
  xi_ = xi_begin_;
  state_end_ = state_begin_;
  points_ = points_begin_;
  now_ = now_begin_;
}

} // namespace freefem
