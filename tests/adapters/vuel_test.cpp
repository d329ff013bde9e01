// SPDX-License-Identifier: BSD-3-Clause
// Abaqus/Explicit VUEL: the selfcheck, for which it needs a tangent that nobody asks for.
#include <gtest/gtest.h>

#include "abaqus_services.hpp"
#include "guarded.hpp"
#include "problem.hpp"

extern "C" void vuel_(int* nblock, double* rhs, double* amass, double* dtime_stable, double* svars,
                      int* nsvars, double* energy, int* nnode, int* ndofel, double* props, int* nprops,
                      int* jprops, int* njprops, double* coords, int* mcrd, double* u, double* du, double* v,
                      double* a, int* jtype, int* jelem, double* time, double* period, double* dtime,
                      double* dtime_previous, int* kstep, int* kinc, int* lflags, double* mass_scale,
                      double* predef, int* npredef, int* jdltyp, double* adlmag);

namespace adapters::vuel_test {
namespace {

/// Internal forces of a block of two, of which the second element is lifted and open.
std::vector<double> forces(const Problem& p, double option) {
  constexpr int block = 2;
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  const std::vector<int>& nodes = p.elements.nodes[0];
  const std::vector<double> u = pressed(p);
  int nblock = block, nnode = static_cast<int>(nodes.size()), d = 3, ndofel = d * nnode,
      nsvars = p.elements.state_size, nprops = 3, none = 0, one = 1, lflags[3] = {17, 1, 2},
      jelem[block] = {501, 502};
  std::vector<double> coords(at(block * ndofel)), total(coords), still(coords);
  for (int b = 0; b < block; ++b)
    for (int node = 0; node < nnode; ++node)
      for (int i = 0; i < d; ++i) {
        const std::size_t from = at(nodes[at(node)] * d + i);
        coords[at(b + block * (node + nnode * i))] = p.elements.reference[from];
        total[at(b + block * (node * d + i))] = u[from] + (b == 1 && node == 0 && i == 2 ? 0.5 : 0);
      }
  Guarded rhs(at(block * ndofel)), stable(block), svars(at(block * nsvars)), energy(12 * block);
  for (std::size_t i = 0; i < svars.size(); ++i) svars[i] = 0;
  double props[3] = {static_cast<double>(p.elements.model), p.elements.area[0], option}, time[2] = {},
         period = 1, dtime = 1e-3, scale[block] = {1, 1};
  vuel_(&nblock, rhs.data(), nullptr, stable.data(), svars.data(), &nsvars, energy.data(), &nnode, &ndofel,
        props, &nprops, nullptr, &none, coords.data(), &d, total.data(), still.data(), still.data(),
        still.data(), &one, jelem, time, &period, &dtime, &dtime, &one, &one, lflags, scale, nullptr, &none,
        nullptr, nullptr);
  for (const Guarded* array : {&rhs, &stable, &svars, &energy}) array->check_guards("an array");
  return {rhs.data(), rhs.data() + rhs.size()};
}

TEST(Vuel, SelfcheckOfEachElement) {
  abaqus_messages();
  const Problem p = problem("quad4_friction");
  const std::vector<double> silent = forces(p, 0);
  EXPECT_TRUE(abaqus_messages().empty());
  EXPECT_EQ(forces(p, 1), silent);
  const auto messages = abaqus_messages();
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(messages[0].severity, 1);
  EXPECT_NE(messages[0].text.find("element 501: selfcheck: "), std::string::npos) << messages[0].text;
  EXPECT_NE(messages[0].text.find("K is the slope of R"), std::string::npos) << messages[0].text;
  EXPECT_NE(messages[1].text.find("element 502: selfcheck: open, gap "), std::string::npos)
      << messages[1].text;
}

} // namespace
} // namespace adapters::vuel_test
