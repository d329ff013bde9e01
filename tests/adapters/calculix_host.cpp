// SPDX-License-Identifier: BSD-3-Clause
#include "calculix_host.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "calculix_routines.hpp"
#include "guarded.hpp"

namespace adapters {
CalculixHost::CalculixHost(const Elements& elements, const std::string& element_type)
    : EmulatedHost(elements), co_(elements.reference), nstate_(elements.state_size + 2),
      uel_(element_type == "U1A") {
  if (uel_) setenv("CCX_UEL", ENTS_UEL_LIBRARY, 1);
  for (const auto& element : elements.nodes) {
    ipkon_.push_back(static_cast<int>(kon_.size()));
    for (const int node : element) kon_.push_back(node + 1);
    ielprop_.push_back(static_cast<int>(prop_.size()));
    if (uel_) prop_.insert(prop_.end(), {3, elements.symmetric ? 0.0 : 1.0});
    prop_.insert(prop_.end(), {static_cast<double>(elements.model), elements.area[ipkon_.size() - 1],
                               static_cast<double>(elements.options)});
    lakon_ += element_type + "A \x01\x03";
    lakon_ += static_cast<char>(element.size());
  }
  xstateini_.assign(elements.nodes.size() * at(nstate_), 0.0);
  xstate_ = xstateini_;
  const int ne = static_cast<int>(elements.nodes.size());
  const int nprop = static_cast<int>(prop_.size());
  const int unsymmetric =
      uel_ ? ents_ccx_uel_unsymmetric_(&ne, ipkon_.data(), lakon_.data(), ielprop_.data(), prop_.data())
           : ents_ccx_unsymmetric_(&ne, ipkon_.data(), lakon_.data(), ielprop_.data(), prop_.data(), &nprop);
  if ((unsymmetric == 0) != elements.symmetric) throw std::runtime_error("the solver does not fit the model");
}

void CalculixHost::set_history(int element, const std::vector<double>& state) {
  std::copy(state.begin(), state.end(), xstateini_.begin() + element * nstate_);
}

std::vector<double> CalculixHost::history(int element) {
  return {xstate_.begin() + element * nstate_, xstate_.begin() + (element + 1) * nstate_};
}

Answer CalculixHost::evaluate(int element, const std::vector<double>& displacement) {
  const int nelem = element + 1, nodes_of_mesh = elements_.unknowns() / 3, yes = 1,
            rows = 3 * static_cast<int>(nodes(element).size());
  std::vector<double> v(at(4 * nodes_of_mesh), 1e30), vini = v; // entry 0 of a node is its temperature
  Guarded fn(at(4 * nodes_of_mesh)), s(3600), sm(3600), ff(60);
  for (int node = 0; node < nodes_of_mesh; ++node) {
    fn[at(4 * node)] = 0;
    for (int i = 0; i < 3; ++i)
      v[at(4 * node + 1 + i)] = displacement[at(3 * node + i)], fn[at(4 * node + 1 + i)] = 0,
                          vini[at(4 * node + 1 + i)] = begin_.empty() ? 0 : begin_[at(3 * node + i)];
  }
  double qa[4] = {0, 0, -1, 0};
  int nal = 0;
  const char* label = lakon_.data() + 8 * element;
  const double *before = linear_step_ ? nullptr : xstateini_.data(), time = 0.5, ttime = 1, dtime = 0.25;
  double* after = linear_step_ ? nullptr : xstate_.data();
  if (uel_)
    ents_ccx_uel_force_(&nelem, kon_.data(), ipkon_.data(), label, co_.data(), v.data(), vini.data(), mi_,
                        ielprop_.data(), prop_.data(), fn.data(), qa, &nal, &yes, &yes, before, after,
                        &nstate_, &time, &ttime, &dtime, &yes, &yes, 8);
  else
    ents_ccx_force_(&nelem, kon_.data(), ipkon_.data(), label, co_.data(), v.data(), vini.data(), mi_,
                    ielprop_.data(), prop_.data(), fn.data(), qa, &nal, &yes, &yes, before, after, &nstate_,
                    &dtime, 8);
  ents_ccx_stiffness_(&nelem, label, s.data(), sm.data(), ff.data(), 8);
  Answer answer;
  if (qa[2] > 0 && qa[2] < 1) {
    for (int i = 0; i < rows * rows; ++i)
      if (fn[at(4 * nodes(element)[at(i % rows / 3)] + 1 + i % 3)] != 0 ||
          s[at(i % rows + 60 * (i / rows))] != 0)
        throw std::runtime_error("a cut with forces or a stiffness");
    answer.step_factor = qa[2];
    return answer;
  }
  fn.check_guards("fn"), s.check_guards("s"), sm.check_guards("sm"), ff.check_guards("ff");
  double sum = 0;
  for (int i = 0; i < rows; ++i) {
    answer.residual.push_back(fn[at(4 * nodes(element)[at(i / 3)] + 1 + i % 3)]);
    sum += std::abs(answer.residual.back());
    if (ff[at(i)] != 0) throw std::runtime_error("a load");
  }
  if (nal != rows || std::abs(qa[0] - sum) > 1e-14 * sum) throw std::runtime_error("qa, nal");
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < rows; ++i) {
      answer.tangent.push_back(s[at(i + 60 * j)]);
      if (sm[at(i + 60 * j)] != 0) throw std::runtime_error("a mass");
    }
  s.check_untouched("s beyond the element", at(60 * rows), at(3600 - 60 * rows));
  return answer;
}

} // namespace adapters
