// SPDX-License-Identifier: BSD-3-Clause
// OpenSees, emulated: the functions that it offers loaded elements, and an element's life: INIT, FORM ...
// COMMIT or REVERT.
#include <algorithm>
#include <cstdio>
#include <cstring>

#include "guarded.hpp"
#include "other_hosts.hpp"

extern "C" {
struct modelState {
  double time, dt;
};
struct eleObject {
  int tag, nNode, nDOF, nParam, nState, nMat;
  int* node;
  double *param, *cState, *tState;
  void** mats;
  void (*eleFunctPtr)(eleObject*, modelState*, double*, double*, int*, int*);
};
void entsContact(eleObject*, modelState*, double* tang, double* resid, int* isw, int* error);
}

namespace adapters {
namespace {

/// What the functions below are asked for, by each thread. (OpenSees has one.)
thread_local struct Domain {
  std::vector<int> integers; ///< left on the command line
  std::vector<double> doubles;
  const std::vector<double>*reference = nullptr, *displacement = nullptr, *change = nullptr;
  int dimension = 0;
  int extra = 0; ///< degrees of freedom of node n beside its displacements: extra + n modulo 3; 0: none
  std::string error;
  int mismatches = 0; ///< lines in OpenSees's output: wrong guesses for nodes as its model command makes them

  int dofs(int node) const { return dimension + (extra ? extra - 1 + node % 3 : 0); }
  int usual() const { return dofs(2); } ///< of the model command
} domain;

int nodal(const std::vector<double>& values, const int* node, const int* count, double* data, int wanted) {
  if (*count != wanted) {
    domain.mismatches += wanted == domain.usual();
    return -1;
  }
  for (int i = 0; i < *count; ++i)
    data[i] = i < domain.dimension ? values[at((*node - 1) * domain.dimension + i)]
                                   : 1e30; // a rotation, a pressure
  return 0;
}

class OpenSeesHost : public EmulatedHost {
public:
  OpenSeesHost(const Elements& elements, int extra)
      : EmulatedHost(elements), extra_(extra), zero_(elements.reference.size()) {
    domain.reference = &elements_.reference, domain.displacement = &zero_;
    domain.dimension = elements.dimension, domain.extra = extra, domain.mismatches = 0;
    for (int k = 0; k < static_cast<int>(elements.nodes.size()); ++k) {
      const auto& list = nodes(k);
      domain.integers = {number(k), elements.model, static_cast<int>(list.size())};
      for (const int node : list) domain.integers.push_back(node + 1);
      domain.doubles = {area(k), static_cast<double>(elements.options)};
      objects_.push_back(std::make_unique<eleObject>());
      request(k, 0, nullptr, nullptr);
      int dofs = 0;
      for (const int node : list) dofs += domain.dofs(node + 1);
      if (objects_.back()->nDOF != dofs) throw std::runtime_error("nDOF");
    }
    if (domain.mismatches > 0) throw std::runtime_error("OPS_GetNodeDisp - crd size mismatch");
  }
  ~OpenSeesHost() override {
    for (auto& e : objects_) delete[] e->node, delete[] e->param, delete[] e->cState, delete[] e->tState;
  }

  void begin(const std::vector<double>& displacement) override {
    EmulatedHost::begin(displacement);
    for (int k = 0; k < static_cast<int>(objects_.size()); ++k) request(k, 2, nullptr, nullptr); // REVERT
  }
  Answer evaluate(int element, const std::vector<double>& displacement) override {
    std::vector<double> change = displacement;
    for (std::size_t i = 0; i < begin_.size(); ++i) change[i] -= begin_[i];
    domain.reference = &elements_.reference, domain.displacement = &displacement, domain.change = &change,
    domain.dimension = elements_.dimension, domain.extra = extra_;
    const auto n = at(objects_[at(element)]->nDOF);
    Guarded tang(n * n), resid(n);
    Answer answer;
    try {
      request(element, 3, tang.data(), resid.data());
    } catch (
        const HostStopped&) { // the script repeats the step with half its size, whatever the element thinks
      if (domain.error.find("penetration_limit") == std::string::npos) throw;
      answer.step_factor = 0.5;
      return answer;
    }
    tang.check_guards("tang"), resid.check_guards("resid");
    std::vector<std::size_t> kept; // displacements; nothing acts on what a node has beside them
    std::size_t dof = 0;
    for (const int node : nodes(element))
      for (int i = 0; i < domain.dofs(node + 1); ++i, ++dof) {
        if (i < elements_.dimension) {
          kept.push_back(dof);
        } else {
          if (resid[dof] != 0) throw std::runtime_error("a force on a rotation");
          for (std::size_t j = 0; j < n; ++j)
            if (tang[dof + n * j] != 0 || tang[j + n * dof] != 0)
              throw std::runtime_error("a stiffness of a rotation");
        }
      }
    for (const std::size_t j : kept) {
      answer.residual.push_back(resid[j]);
      for (const std::size_t i : kept) answer.tangent.push_back(tang[i + n * j]);
    }
    request(element, 4, tang.data(), nullptr);
    for (std::size_t i = 0; i < n * n; ++i)
      if (tang[i] != 0) throw std::runtime_error("a mass");
    return answer;
  }
  int number(int element) const override { return 100 + element; }
  void set_history(int element, const std::vector<double>& state) override {
    std::copy(state.begin(), state.end(), objects_[at(element)]->cState);
  }
  std::vector<double> history(int element) override {
    const eleObject& object = *objects_[at(element)];
    return {object.tState, object.tState + object.nState};
  }
  void accept() override {
    for (int k = 0; k < static_cast<int>(objects_.size()); ++k) request(k, 1, nullptr, nullptr);
  }

private:
  void request(int k, int isw, double* tang, double* resid) {
    modelState state{0, -0.1}; // the host's dt has the wrong sign
    int error = 99;
    entsContact(objects_[at(k)].get(), &state, tang, resid, &isw, &error);
    if (error != 0) throw HostStopped(domain.error);
  }

  int extra_;
  std::vector<double> zero_;
  std::vector<std::unique_ptr<eleObject>> objects_;
};

} // namespace

std::unique_ptr<EmulatedHost> opensees_host(const Elements& elements) {
  return std::make_unique<OpenSeesHost>(elements, 0);
}

std::unique_ptr<EmulatedHost> opensees_frame_host(const Elements& elements) {
  return std::make_unique<OpenSeesHost>(elements, 1);
}

} // namespace adapters

extern "C" {

using adapters::domain;

int ops_getintinput_(int* count, int* data) {
  if (domain.integers.size() < static_cast<std::size_t>(*count)) return -1;
  for (int i = 0; i < *count; ++i) data[i] = domain.integers[static_cast<std::size_t>(i)];
  domain.integers.erase(domain.integers.begin(), domain.integers.begin() + *count);
  return 0;
}
int ops_getdoubleinput_(int* count, double* data) {
  if (domain.doubles.size() < static_cast<std::size_t>(*count)) return -1;
  std::memcpy(data, domain.doubles.data(), static_cast<std::size_t>(*count) * sizeof(double));
  return 0;
}
int ops_allocateelement_(eleObject* e, int*, int*) {
  const auto array = [](int size) { // not zeroed
    auto* values = new double[static_cast<std::size_t>(size)];
    for (int i = 0; i < size; ++i) values[i] = -1e99;
    return values;
  };
  e->node = new int[static_cast<std::size_t>(e->nNode)];
  e->param = array(e->nParam), e->cState = array(e->nState), e->tState = array(e->nState);
  return 0;
}
int ops_getnodecrd_(int* node, int* count, double* data) {
  return adapters::nodal(*domain.reference, node, count, data, domain.dimension);
}
int ops_getnodedisp_(int* node, int* count, double* data) {
  return adapters::nodal(*domain.displacement, node, count, data, domain.dofs(*node));
}
int ops_getnodeincrdisp_(int* node, int* count, double* data) {
  return adapters::nodal(*domain.change, node, count, data, domain.dofs(*node));
}
int ops_getndf_() { return domain.usual(); }
int ops_error_(char* text, int length) {
  domain.error.assign(text, static_cast<std::size_t>(length));
  std::fwrite(text, 1, domain.error.size(), stderr);
  return 0;
}

} // extern "C"
