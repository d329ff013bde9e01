// SPDX-License-Identifier: BSD-3-Clause
// Ansys MAPDL with USER300, emulated: history is handed in and out, and kept where keyHisUpd says that the
// substep has converged.
#include "guarded.hpp"
#include "histories.hpp"
#include "other_hosts.hpp"

extern "C" void userelem_(int* elId, int* matId, int* keyMtx, int* lumpm, int* nDim, int* nNodes, int* Nodes,
                          int* nIntPnts, int* nUsrDof, int* kEStress, int* keyAnsMat, int* keySym,
                          int* nKeyOpt, int* KeyOpt, double* temper, double* temperB, double* tRef,
                          int* kTherm, int* nPress, double* Press, int* kPress, int* nReal, double* RealConst,
                          int* nSaveVars, double* saveVars, double* xRef, double* xCur, double* TotValDofs,
                          double* IncValDofs, double* ItrValDofs, double* VelValDofs, double* AccValDofs,
                          int* kfstps, int* nlgeom, int* nrkey, int* outkey, int* elPrint, int* iott,
                          int* keyHisUpd, int* ldstep, int* isubst, int* ieqitr, double* timval,
                          int* keyEleErr, int* keyEleCnv, double* eStiff, double* eMass, double* eDamp,
                          double* eSStiff, double* fExt, double* fInt, double* elVol, double* elMass,
                          double* elCG, int* nRsltBsc, double* RsltBsc, int* nRsltVar, double* RsltVar,
                          int* nElEng, double* elEnergy);

namespace adapters {
namespace {

class AnsysHost : public HostWithHistory {
public:
  explicit AnsysHost(const Elements& elements) : HostWithHistory(elements, 1), last_(elements.nodes.size()) {}

  Answer evaluate(int element, const std::vector<double>& displacement) override {
    return call(element, displacement, 0);
  }
  void accept() override {
    for (int k = 0; k < static_cast<int>(elements_.nodes.size()); ++k) call(k, last_[at(k)], 1);
    HostWithHistory::accept();
  }

  std::vector<double> history(int element) override {
    call(element, last_[at(element)], 1);
    return trial(element);
  }
  int number(int element) const override { return 7000 + element; }

private:
  Answer call(int element, const std::vector<double>& displacement, int keyHisUpd) {
    if (!keyHisUpd) last_[at(element)] = displacement;
    int id = number(element), d = elements_.dimension, nNodes = static_cast<int>(nodes(element).size()),
        nUsrDof = nNodes * d, one = 1, none = 0, nSaveVars = size_, keyEleErr = 99, keyEleCnv = 99;
    int keyMtx[10] = {1, 1, 0, 0, 1, 1, 0, 0, 0, 0};
    const auto n = at(nUsrDof);
    Guarded stiff(n * n), mass(n * n), damp(n * n), sstiff(n * n), fExt(n), fInt(n), save(at(size_)),
        energy(1);
    std::vector<double> x = gather(element, elements_.reference), u = gather(element, displacement),
                        change = gather_change(element, displacement), current(n, 1e99), still(n, 1e99);
    std::vector<double> real = constants(element);
    int nReal = static_cast<int>(real.size());
    double zero = 0;
    for (int i = 0; i < size_; ++i) save[at(i)] = committed(element)[at(i)];
    userelem_(&id, &one, keyMtx, &none, &d, &nNodes, nullptr, &one, &nUsrDof, &none, &none, &one, &none,
              nullptr, nullptr, nullptr, &zero, &none, &none, nullptr, &none, &nReal, real.data(), &nSaveVars,
              save.data(), x.data(), current.data(), u.data(), change.data(), still.data(), still.data(),
              still.data(), &none, &one, &one, &none, &none, &one, &keyHisUpd, &one, &one, &one, &zero,
              &keyEleErr, &keyEleCnv, stiff.data(), mass.data(), damp.data(), sstiff.data(), fExt.data(),
              fInt.data(), &zero, &zero, nullptr, &none, nullptr, &none, nullptr, &one, energy.data());
    for (const Guarded* array : {&stiff, &mass, &damp, &sstiff, &fExt, &fInt, &save, &energy})
      array->check_guards("an array");
    Answer answer;
    if (keyEleErr != 0) throw HostStopped("keyEleErr");
    if (keyEleCnv == 0) { // bisection
      answer.step_factor = 0.5;
      return answer;
    }
    stiff.check_written("eStiff", 0, n * n), mass.check_written("eMass", 0, n * n),
        damp.check_untouched("eDamp", 0, n * n);
    answer.residual.assign(fInt.data(), fInt.data() + n);
    answer.tangent.assign(stiff.data(), stiff.data() + n * n);
    for (std::size_t i = 0; i < n; ++i)
      if (fExt[i] != 0) throw std::runtime_error("a load");
    for (int i = 0; i < size_; ++i) {
      if (!keyHisUpd && save[at(i)] != committed(element)[at(i)])
        throw std::runtime_error("history of an iteration was kept");
      trial(element)[at(i)] = save[at(i)];
    }
    return answer;
  }

  std::vector<std::vector<double>> last_; ///< of each element
};

} // namespace

std::unique_ptr<EmulatedHost> ansys_host(const Elements& elements) {
  return std::make_unique<AnsysHost>(elements);
}

} // namespace adapters
