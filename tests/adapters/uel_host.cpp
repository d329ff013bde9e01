// SPDX-License-Identifier: BSD-3-Clause
#include "uel_host.hpp"

#include <algorithm>
#include <cmath>

namespace adapters {

void UelCall::operator()(UelFunction* function) {
  int nprops = static_cast<int>(props.size()), zero = 0, one = 1;
  double time[2] = {0.5, 1.5}, period = 1, params[3] = {}, adlmag = 0;
  std::vector<double> still(static_cast<std::size_t>(ndofel), 0.0),
      predef(2 * static_cast<std::size_t>(nnode));
  du.resize(static_cast<std::size_t>(nrhs * mlvarx), std::numeric_limits<double>::quiet_NaN());
  function(rhs.data(), amatrx.data(), svars.data(), energy.data(), &ndofel, &nrhs, &nsvars, props.data(),
           &nprops, coords.data(), &mcrd, &nnode, u.data(), du.data(), still.data(), still.data(), &jtype,
           time, &dtime, &kstep, &kinc, &jelem, null_flags ? nullptr : params, &zero, nullptr,
           null_flags ? nullptr : &adlmag, predef.data(), &one, null_flags ? nullptr : lflags.data(), &mlvarx,
           nullptr, &zero, &pnewdt, null_flags ? nullptr : &zero, &zero, &period);
  rhs.check_guards("RHS");
  rhs.check_untouched("padding of RHS", static_cast<std::size_t>(ndofel),
                      static_cast<std::size_t>(mlvarx - ndofel));
  amatrx.check_guards("AMATRX");
  svars.check_guards("SVARS");
  energy.check_guards("ENERGY");
}

UelHost::UelHost(const Elements& elements, Program program)
    : EmulatedHost(elements), program_(program),
      committed_(elements.nodes.size(),
                 std::vector<double>(static_cast<std::size_t>(elements.state_size) + 1)),
      trial_(committed_) {}

UelCall UelHost::call(int element, const std::vector<double>& displacement) const {
  const int d = elements_.dimension;
  // The turns of a rigid body are those of its reference node; in the plane it has one.
  UelCall c(elements_.body ? 2 : static_cast<int>(nodes(element).size()), d, elements_.state_size + 1,
            !elements_.body ? 0
            : d == 2        ? 1
                            : 3);
  c.coords = gather(element, elements_.reference);
  c.u = gather(element, displacement);
  const std::vector<double> old = begin_.empty() ? std::vector<double>(c.u.size()) : gather(element, begin_);
  c.du = gather_change(element, displacement);
  c.props = constants(element);
  for (std::size_t i = 0; i < c.svars.size(); ++i)
    c.svars[i] = committed_[static_cast<std::size_t>(element)][i];
  c.jelem = number(element);
  c.kinc = increment_;
  switch (program_) {
  case Program::abaqus:
    break;
  case Program::moose: // U is the old solution, DU leads to the present one
  case Program::moose_mesh:
    c.u = old;
    c.props.push_back(2);
    c.null_flags = program_ == Program::moose;
    c.lflags = {1, 1, 0, 1, 1}; // but for the third they are what the stack has there
    c.kstep = c.kinc = 0;
    c.pnewdt = 0.123;
    break;
  case Program::oofem:
    c.nrhs = 2;
    c.lflags = {1, 0, 1, 0, 0};
    c.pnewdt = 0;
    c.mlvarx = c.ndofel;
    break;
  }
  return c;
}

/// Abaqus calls UEXTERNALDB at the end of an increment; the others have no such call.
void UelHost::accept() {
  committed_ = trial_;
  if (program_ == Program::abaqus) {
    int lop = 2, none = 0, step = 1;
    double time[2] = {0.5, 1.5}, dtime = 0.5;
    uexternaldb_(&lop, &none, time, &dtime, &step, &increment_);
  }
  ++increment_;
}

void UelHost::set_history(int element, const std::vector<double>& state) {
  std::copy(state.begin(), state.end(), committed_[static_cast<std::size_t>(element)].begin());
}

Answer UelHost::evaluate(int element, const std::vector<double>& displacement) {
  UelCall c = call(element, displacement);
  if (program_ == Program::moose_mesh) { // stiffness, then residual: each from the history of before
    c.lflags[2] = 4;
    c();
    UelCall residual = call(element, displacement);
    residual.lflags[2] = 5;
    residual();
    for (std::size_t i = 0; i < static_cast<std::size_t>(c.ndofel); ++i) {
      if (c.rhs[i] != 0 && !std::isnan(c.rhs[i]))
        throw std::runtime_error("a residual besides the stiffness");
      c.rhs[i] = residual.rhs[i];
    }
    for (std::size_t i = 0; i < c.svars.size(); ++i) c.svars[i] = residual.svars[i];
  } else {
    c();
  }
  Answer answer;
  const auto n = static_cast<std::size_t>(c.ndofel);
  if (program_ == Program::abaqus && c.pnewdt < 1) { // the others do not look at it
    answer.step_factor = c.pnewdt;
    return answer;
  }
  if (std::isnan(c.rhs[0])) throw HostStopped("the residual is not finite");
  c.rhs.check_written("RHS", 0, n);
  c.amatrx.check_written("AMATRX", 0, n * n);
  for (std::size_t i = 0; i < n; ++i) answer.residual.push_back(-c.rhs[i]);
  for (std::size_t i = 0; i < n * n; ++i) answer.tangent.push_back(c.amatrx[i]);
  // Degrees of freedom that the element does not have: those of a node of the turns in the plane.
  const std::size_t rows = at(elements_.dimension) * nodes(element).size();
  for (std::size_t column = n; n < rows && column-- > 0;)
    answer.tangent.insert(answer.tangent.begin() + static_cast<std::ptrdiff_t>(n * (column + 1)), rows - n,
                          0.0);
  answer.residual.resize(rows), answer.tangent.resize(rows * rows);
  auto& trial = trial_[static_cast<std::size_t>(element)];
  for (std::size_t i = 0; i < trial.size(); ++i) trial[i] = c.svars[i];
  return answer;
}

} // namespace adapters
