// SPDX-License-Identifier: BSD-3-Clause
// MSC Marc, emulated: state variables and their increments, one request a call. What dispt and r are no public manual
// tells: marc_host has total displacements at the end of the increment and internal forces; marc_user_code_host has
// what three public USELEM files have (zia-javanbakht/AFE, uselem01.f: disp + dispt is the total, r is minus the
// internal force).
#include "guarded.hpp"
#include "histories.hpp"
#include "other_hosts.hpp"

extern "C" void uselem_(int* m, double* xk, double* xm, int* nnode, int* ndeg, double* f, double* r,
                        int* jtype, double* dispt, double* disp, int* ndi, int* nshear, int* jpass,
                        int* nstats, int* ngenel, int* intel, double* coord, int* ncrd, int* iflag, int* idss,
                        double* t, double* dt, double* etota, double* gsigs, double* de, double* geom,
                        int* jgeom, double* sigxx, int* nstrmu);
extern "C" void quit_(int*) { throw adapters::HostStopped("quit"); }

namespace adapters {
namespace {

class MarcHost : public HostWithHistory {
public:
  MarcHost(const Elements& elements, bool as_user_code)
      : HostWithHistory(elements, 2), as_user_code_(as_user_code) {}

  Answer evaluate(int element, const std::vector<double>& displacement) override {
    int m = number(element), nnode = static_cast<int>(nodes(element).size()), d = elements_.dimension,
        idss = nnode * d, jtype = -9, none = 0, nstats = size_;
    const auto n = at(idss);
    Guarded xk(n * n), xm(n * n), f(n), r(n), dt(at(size_));
    std::vector<double> x = gather(element, elements_.reference), u = gather(element, displacement),
                        increment = gather_change(element, displacement), t = committed(element);
    for (std::size_t i = 0; as_user_code_ && i < u.size(); ++i) u[i] -= increment[i];
    double geom[8] = {static_cast<double>(elements_.model),
                      area(element),
                      static_cast<double>(elements_.options),
                      1e99,
                      1e99,
                      1e99,
                      1e99,
                      1e99};
    const auto call = [&](int iflag) {
      uselem_(&m, xk.data(), xm.data(), &nnode, &d, f.data(), r.data(), &jtype, u.data(), increment.data(),
              &none, &none, &none, &nstats, &none, &none, x.data(), &d, &iflag, &idss, t.data(), dt.data(),
              nullptr, nullptr, nullptr, geom, nullptr, nullptr, &none);
      for (const Guarded* array : {&xk, &xm, &f, &r, &dt}) array->check_guards("an array");
    };
    Answer answer;
    call(4);
    r.check_written("r", 0, n), xk.check_untouched("xk", 0, n * n);
    answer.residual.assign(r.data(), r.data() + n);
    r.poison();
    call(2);
    xk.check_written("xk", 0, n * n), xm.check_untouched("xm", 0, n * n), f.check_untouched("f", 0, n);
    answer.tangent.assign(xk.data(), xk.data() + n * n);
    for (std::size_t i = 0; i < n; ++i)
      if (r[i] != answer.residual[i]) throw std::runtime_error("r differs between iflag 2 and 4");
    for (int i = 0; i < elements_.state_size; ++i) trial(element)[at(i)] = t[at(i)] + dt[at(i)];
    call(1), call(3);
    f.check_written("f", 0, n), xm.check_written("xm", 0, n * n);
    for (double& force : answer.residual)
      if (as_user_code_) force = -force;
    return answer;
  }
  int number(int element) const override { return element + 1; }
  /// Output of the increment.
  void accept() override {
    HostWithHistory::accept();
    for (int k = 0; k < static_cast<int>(elements_.nodes.size()); ++k) {
      int m = number(k), nnode = static_cast<int>(nodes(k).size()), d = elements_.dimension, idss = nnode * d,
          jtype = -9, none = 0, nstats = size_, output = 5;
      uselem_(&m, nullptr, nullptr, &nnode, &d, nullptr, nullptr, &jtype, nullptr, nullptr, &none, &none,
              &none, &nstats, &none, &none, nullptr, &d, &output, &idss, nullptr, nullptr, nullptr, nullptr,
              nullptr, nullptr, nullptr, nullptr, &none);
    }
  }

private:
  bool as_user_code_;
};

} // namespace

std::unique_ptr<EmulatedHost> marc_host(const Elements& elements) {
  return std::make_unique<MarcHost>(elements, false);
}

std::unique_ptr<EmulatedHost> marc_user_code_host(const Elements& elements) {
  return std::make_unique<MarcHost>(elements, true);
}

} // namespace adapters
