// SPDX-License-Identifier: BSD-3-Clause
// Programs that call an Abaqus UEL, emulated: Abaqus/Standard, MOOSE's AbaqusUserElement and
// AbaqusUELMeshUserElement, and OOFEM's AbaqusUserElement.
#pragma once

#include "emulated_host.hpp"
#include "guarded.hpp"

extern "C" {
using UelFunction = void(double* rhs, double* amatrx, double* svars, double* energy, int* ndofel, int* nrhs,
                         int* nsvars, double* props, int* nprops, double* coords, int* mcrd, int* nnode,
                         double* u, double* du, double* v, double* a, int* jtype, double* time, double* dtime,
                         int* kstep, int* kinc, int* jelem, double* params, int* ndload, int* jdltyp,
                         double* adlmag, double* predef, int* npredf, int* lflags, int* mlvarx,
                         double* ddlmag, int* mdload, double* pnewdt, int* jprops, int* njprop,
                         double* period);
UelFunction uel, uel_;
void uexternaldb_(int* lop, int* lrestart, double* time, double* dtime, int* kstep, int* kinc);
}

namespace adapters {

/// Arguments of one call, as Abaqus passes them: two columns of RHS apart by MLVARX > NDOFEL, outputs
/// poisoned, guard zones.
struct UelCall {
  /// @param rotations  of the last node, behind its other degrees of freedom
  UelCall(int nodes, int dofs_per_node, int variables, int rotations = 0)
      : nnode(nodes), ndofel(nodes * dofs_per_node + rotations), mlvarx(ndofel + 5), nsvars(variables),
        mcrd(dofs_per_node), rhs(2 * static_cast<std::size_t>(mlvarx)),
        amatrx(static_cast<std::size_t>(ndofel) * static_cast<std::size_t>(ndofel)),
        svars(static_cast<std::size_t>(variables)), energy(8) {
    for (std::size_t i = 0; i < svars.size(); ++i) svars[i] = 0;
    for (std::size_t i = 0; i < 8; ++i) energy[i] = 0;
  }

  int nnode, ndofel, mlvarx, nsvars, mcrd, nrhs = 1, jelem = 90001, kstep = 1, kinc = 1, jtype = 101;
  Guarded rhs, amatrx, svars, energy;
  std::vector<double> props, coords, u, du;
  std::vector<int> lflags{1, 1, 1, 0, 0, 0, 0};
  double pnewdt = 1e36, dtime = 0.5;
  bool null_flags = false;

  /// Call, and check the guard zones.
  void operator()(UelFunction* function = uel_);
};

class UelHost : public EmulatedHost {
public:
  enum class Program { abaqus, moose, moose_mesh, oofem };
  UelHost(const Elements& elements, Program program);

  Answer evaluate(int element, const std::vector<double>& displacement) override;
  void accept() override;
  void set_history(int element, const std::vector<double>& state) override;
  std::vector<double> history(int element) override { return trial_[static_cast<std::size_t>(element)]; }
  int number(int element) const override { return 90001 + element; }
  UelCall call(int element, const std::vector<double>& displacement) const;

private:
  Program program_;
  int increment_ = 1;
  std::vector<std::vector<double>> committed_, trial_; ///< SVARS
};

} // namespace adapters
