// SPDX-License-Identifier: BSD-3-Clause
// Abaqus/Explicit, emulated: the element of interest somewhere in a block of others like it; arrays with the
// block index first.
#include <mutex>

#include "guarded.hpp"
#include "histories.hpp"
#include "other_hosts.hpp"
#include "problem.hpp"

extern "C" void vuel_(int* nblock, double* rhs, double* amass, double* dtime_stable, double* svars,
                      int* nsvars, double* energy, int* nnode, int* ndofel, double* props, int* nprops,
                      int* jprops, int* njprops, double* coords, int* mcrd, double* u, double* du, double* v,
                      double* a, int* jtype, int* jelem, double* time, double* period, double* dtime,
                      double* dtime_previous, int* kstep, int* kinc, int* lflags, double* mass_scale,
                      double* predef, int* npredef, int* jdltyp, double* adlmag);

extern "C" void vexternaldb_(int* lOp, int* i_array, int* niArray, double* r_array, int* nrArray);

namespace adapters {
namespace {

class VuelHost : public HostWithHistory {
public:
  explicit VuelHost(const Elements& elements) : HostWithHistory(elements, 1) {}

  void accept() override {
    HostWithHistory::accept();
    plain().accept();
    int end_of_increment = 4, integers[6] = {100, 100, 1, ++increment_ * 100, 0, 0}, six = 6, three = 3;
    double reals[3] = {};
    vexternaldb_(&end_of_increment, integers, &six, reals, &three);
    if (integers[4] == 2) throw HostStopped("j_int_TerminateAnalysis");
  }
  int number(int element) const override { return 90001 + element; }
  void begin(const std::vector<double>& displacement) override {
    HostWithHistory::begin(displacement);
    if (plain_) plain_->begin(displacement);
  }
  Answer evaluate(int element, const std::vector<double>& displacement) override {
    const int blocks[] = {1, 7, 136};
    int block = blocks[element % 3], d = elements_.dimension, nnode = static_cast<int>(nodes(element).size()),
        ndofel = nnode * d, nsvars = size_, none = 0, one = 1;
    const int mine = block / 2;
    const std::vector<double> x = gather(element, elements_.reference), u = gather(element, displacement),
                              du = gather_change(element, displacement);
    Guarded rhs(at(block * ndofel)), amass(at(block * ndofel * ndofel)), stable(at(block)),
        svars(at(block * nsvars)), energy(at(12 * block));
    std::vector<double> coords(at(block * ndofel)), total(at(block * ndofel)), change(at(block * ndofel)),
        still(at(block * ndofel)), scale(at(block), 1.0);
    for (int b = 0; b < block; ++b) { // the others are lifted so that they do not touch
      for (int node = 0; node < nnode; ++node)
        for (int i = 0; i < d; ++i) {
          coords[at(b + block * (node + nnode * i))] = x[at(node * d + i)];
          change[at(b + block * (node * d + i))] = du[at(node * d + i)];
          total[at(b + block * (node * d + i))] =
              u[at(node * d + i)] + (b != mine && node == 0 && i == d - 1 ? 0.5 : 0.0);
        }
      for (int i = 0; i < nsvars; ++i) svars[at(b + block * i)] = committed(element)[at(i)];
    }
    std::vector<double> props = constants(element);
    int nprops = static_cast<int>(props.size());
    double time[2] = {0, 0}, period = 1, dtime = 1e-3;
    std::vector<int> jelem(at(block));
    for (int b = 0; b < block; ++b) jelem[at(b)] = b == mine ? number(element) : 500001 + b;
    const auto call = [&](int operation) {
      int lflags[3] = {17, 1, operation};
      vuel_(&block, rhs.data(), amass.data(), stable.data(), svars.data(), &nsvars, energy.data(), &nnode,
            &ndofel, props.data(), &nprops, nullptr, &none, coords.data(), &d, total.data(), change.data(),
            still.data(), still.data(), &one, jelem.data(), time, &period, &dtime, &dtime, &one, &one, lflags,
            scale.data(), nullptr, &none, nullptr, nullptr);
    };
    call(1);
    amass.check_written("amass", 0, amass.size());
    rhs.check_untouched("rhs", 0, rhs.size());
    call(3);
    for (int i = 0; i < block * ndofel; ++i)
      if (rhs[at(i)] != 0) throw std::runtime_error("an external load");
    rhs.poison();
    call(2);
    rhs.check_written("rhs", 0, rhs.size()), stable.check_written("dtimeStable", 0, stable.size());
    rhs.check_guards("rhs"), amass.check_guards("amass"), stable.check_guards("dtimeStable"),
        svars.check_guards("svars"), energy.check_guards("energy");
    Answer answer;
    if (elements_.stiffness) answer = plain().evaluate(element, displacement);
    answer.residual.resize(at(ndofel));
    for (int i = 0; i < ndofel; ++i) {
      answer.residual[at(i)] = rhs[at(mine + block * i)];
      for (int b = 0; b < block; ++b)
        if (b != mine && rhs[at(b + block * i)] != 0)
          throw std::runtime_error("an element that does not touch");
    }
    for (int i = 0; i < nsvars; ++i) trial(element)[at(i)] = svars[at(mine + block * i)];
    return answer;
  }

private:
  /// Who knows the stiffness; made when the adapter has accepted the model.
  EmulatedHost& plain() {
    std::call_once(made_, [&] {
      plain_ = plain_host(elements_);
      plain_->begin(begin_);
    });
    return *plain_;
  }

  int increment_ = 0;
  std::once_flag made_;
  std::unique_ptr<EmulatedHost> plain_;
};

} // namespace

std::unique_ptr<EmulatedHost> vuel_host(const Elements& elements) {
  return std::make_unique<VuelHost>(elements);
}

} // namespace adapters
