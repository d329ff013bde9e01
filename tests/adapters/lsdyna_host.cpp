// SPDX-License-Identifier: BSD-3-Clause
// LS-DYNA, emulated: current coordinates, eight nodes, blocks of 192 elements of which some are used, the
// block index first.
#include <array>

#include "guarded.hpp"
#include "histories.hpp"
#include "other_hosts.hpp"

extern "C" void usld_e101_(double* force, double* stiff, int* ndtot, int* istif, double* x1, double* x2,
                           double* x3, double* x4, double* x5, double* x6, double* x7, double* x8, double* y1,
                           double* y2, double* y3, double* y4, double* y5, double* y6, double* y7, double* y8,
                           double* z1, double* z2, double* z3, double* z4, double* z5, double* z6, double* z7,
                           double* z8, double* xdof, double* dx1, double* dx2, double* dx3, double* dx4,
                           double* dx5, double* dx6, double* dx7, double* dx8, double* dy1, double* dy2,
                           double* dy3, double* dy4, double* dy5, double* dy6, double* dy7, double* dy8,
                           double* dz1, double* dz2, double* dz3, double* dz4, double* dz5, double* dz6,
                           double* dz7, double* dz8, double* dxdof, double* hsv, int* ihsv, int* nhsv,
                           double* cm, int* lmc, double* cmtrx, int* lft, int* llt, double* dener);
extern "C" void adios_(int*) { throw adapters::HostStopped("adios"); }

namespace adapters {
namespace {

constexpr int nlq = 192;

class LsDynaHost : public HostWithHistory {
public:
  explicit LsDynaHost(const Elements& elements) : HostWithHistory(elements, 0) {}

  Answer evaluate(int element, const std::vector<double>& displacement) override {
    // Every second element has NXDOF = 1: x y z and one more, node by node (github.com/jfriedlein/usld_LS-Dyna_Fortran).
    const int dofs = 3 + element % 2;
    int ndtot = 8 * dofs, istif = 1, first = 5 + element, last = 7 + element, nhsv = size_, lmc = 40,
        ihsv = 0;
    const int mine = first,
              used = static_cast<int>(nodes(element).size()); // in the middle; the block counts from 1
    const std::vector<double> x = gather(element, elements_.reference), u = gather(element, displacement);
    const std::vector<double> u_change = gather_change(element, displacement);
    std::array<std::array<std::vector<double>, 8>, 3> now, change;
    for (int i = 0; i < 3; ++i)
      for (int node = 0; node < 8; ++node) {
        const int k = node < used ? node : used - 1; // the last node again and again
        now[at(i)][at(node)].assign(nlq, x[at(3 * k + i)] + u[at(3 * k + i)]);
        change[at(i)][at(node)].assign(nlq, u_change[at(3 * k + i)]);
      }
    Guarded force(at(nlq * ndtot)), stiff(at(nlq * ndtot * ndtot)), hsv(at(nlq * size_)), dener(nlq);
    std::vector<double> cm(40);
    cm[0] = elements_.model, cm[1] = area(element), cm[2] = elements_.options;
    for (int i = 0; i < size_; ++i)
      for (int b = 0; b < nlq; ++b) hsv[at(b + nlq * i)] = committed(element)[at(i)];
    const auto c = [&](int i, int node) { return now[at(i)][at(node)].data(); };
    const auto d = [&](int i, int node) { return change[at(i)][at(node)].data(); };
    usld_e101_(force.data(), stiff.data(), &ndtot, &istif, c(0, 0), c(0, 1), c(0, 2), c(0, 3), c(0, 4),
               c(0, 5), c(0, 6), c(0, 7), c(1, 0), c(1, 1), c(1, 2), c(1, 3), c(1, 4), c(1, 5), c(1, 6),
               c(1, 7), c(2, 0), c(2, 1), c(2, 2), c(2, 3), c(2, 4), c(2, 5), c(2, 6), c(2, 7), nullptr,
               d(0, 0), d(0, 1), d(0, 2), d(0, 3), d(0, 4), d(0, 5), d(0, 6), d(0, 7), d(1, 0), d(1, 1),
               d(1, 2), d(1, 3), d(1, 4), d(1, 5), d(1, 6), d(1, 7), d(2, 0), d(2, 1), d(2, 2), d(2, 3),
               d(2, 4), d(2, 5), d(2, 6), d(2, 7), nullptr, hsv.data(), &ihsv, &nhsv, cm.data(), &lmc,
               nullptr, &first, &last, dener.data());
    for (const Guarded* array : {&force, &stiff, &hsv, &dener}) array->check_guards("an array");
    Answer answer;
    const auto is_used = [&](int i) { return i / dofs < used && i % dofs < 3; };
    for (int j = 0; j < ndtot; ++j) {
      force.check_untouched("force", at(nlq * j), at(first - 1)),
          force.check_written("force", at(nlq * j + first - 1), 3);
      force.check_untouched("force", at(nlq * j + last), at(nlq - last));
      for (int i = 0; i < ndtot; ++i) {
        const double entry = stiff[at(mine + nlq * (i + ndtot * j))];
        if (is_used(i) && is_used(j))
          answer.tangent.push_back(entry);
        else if (entry != 0)
          throw std::runtime_error("a degree of freedom that the element has not");
      }
      if (is_used(j)) answer.residual.push_back(force[at(mine + nlq * j)]);
    }
    for (int i = 0; i < size_; ++i) trial(element)[at(i)] = hsv[at(mine + nlq * i)];
    return answer;
  }
};

} // namespace

std::unique_ptr<EmulatedHost> lsdyna_host(const Elements& elements) {
  return std::make_unique<LsDynaHost>(elements);
}

} // namespace adapters
