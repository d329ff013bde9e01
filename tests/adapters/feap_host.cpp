// SPDX-License-Identifier: BSD-3-Clause
// FEAPpv, emulated: common blocks, history in hr at nh1 and nh2, s and p zeroed by the host. Elements have
// room for more nodes than they use.
#include <algorithm>
#include <cstdint>
#include <mutex>

#include "guarded.hpp"
#include "other_hosts.hpp"

extern "C" {
extern struct { int numnp, numel, nummat, nen, neq, ipr, netyp; } cdata_;
extern struct {
  double dm;
  int n_el, ma, mct, iel, nel, pstyp, eltyp, elty2, elty3;
} eldata_;
extern struct { double bpr[3], ctan[3]; } eltran_;
extern struct {
  std::int64_t nh1, nh2, nh3, ht1, ht2, ht3;
  int nlm;
} hdata_;
extern struct {
  double hr[1024];
  int mr[1024];
} comblk_;
void elmt07_(double* d, double* ul, double* xl, int* ix, double* tl, double* s, double* p, int* ndf, int* ndm,
             int* nst, int* isw);
}

namespace adapters {
namespace {

std::vector<double> material_line; ///< what pinput reads

class FeapHost : public EmulatedHost {
public:
  explicit FeapHost(const Elements& elements)
      : EmulatedHost(elements), d_(elements.nodes.size(), std::vector<double>(50)) {
    cdata_.nen = static_cast<int>(elements.nodes[0].size()) + 1;
    for (int k = 0; k < static_cast<int>(d_.size()); ++k) {
      material_line = {static_cast<double>(elements.model), area(k), static_cast<double>(elements.options)};
      call(k, 1, nullptr, nullptr, nullptr, nullptr);
      words_ = static_cast<int>(hdata_.nh1);
    }
    committed_.assign(d_.size(), std::vector<double>(at(words_), -1e99));
    trial_ = committed_;
    for (int k = 0; k < static_cast<int>(d_.size()); ++k) {
      history_in(k);
      call(k, 14, nullptr, nullptr, nullptr, nullptr);
      history_out(k);
    }
    committed_ = trial_;
  }

  Answer evaluate(int element, const std::vector<double>& displacement) override {
    static std::mutex common_blocks; // FEAP has one thread
    const std::lock_guard lock(common_blocks);
    cdata_.nen = static_cast<int>(nodes(element).size()) + 1;
    const int ndf = elements_.dimension, nst = ndf * cdata_.nen, rows = ndf * (cdata_.nen - 1);
    std::vector<double> xl = gather(element, elements_.reference), ul = gather(element, displacement);
    const std::vector<double> change = gather_change(element, displacement);
    xl.resize(at(nst), 1e99), ul.resize(at(6 * nst), 1e99);
    std::copy(change.begin(), change.end(), ul.begin() + nst);
    Guarded s(at(nst * nst)), p(at(nst));
    const auto zero = [](Guarded& array) { std::fill(array.data(), array.data() + array.size(), 0.0); };
    zero(s), zero(p);
    history_in(element);
    eltran_.ctan[0] = 1;
    call(element, 6, xl.data(), ul.data(), s.data(), p.data());
    Answer answer;
    for (int i = 0; i < rows; ++i) answer.residual.push_back(-p[at(i)]);
    for (std::size_t i = 0; i < s.size(); ++i)
      if (s[i] != 0) throw std::runtime_error("a tangent that was not asked for");
    zero(p);
    call(element, 3, xl.data(), ul.data(), s.data(), p.data());
    s.check_guards("s"), p.check_guards("p");
    for (int j = 0; j < nst; ++j)
      for (int i = 0; i < nst; ++i)
        if (i < rows && j < rows)
          answer.tangent.push_back(s[at(i + nst * j)]);
        else if (s[at(i + nst * j)] != 0)
          throw std::runtime_error("a node that the element has not");
    for (int i = 0; i < rows; ++i)
      if (-p[at(i)] != answer.residual[at(i)]) throw std::runtime_error("p differs between isw 3 and 6");
    history_out(element);
    return answer;
  }
  int number(int element) const override { return element + 1; }
  void set_history(int element, const std::vector<double>& state) override {
    std::copy(state.begin(), state.end(), committed_[at(element)].begin());
  }
  std::vector<double> history(int element) override { return trial_[at(element)]; }
  /// TIME calls all elements with isw 12 before the next step.
  void accept() override {
    committed_ = trial_;
    for (int k = 0; k < static_cast<int>(d_.size()); ++k) call(k, 12, nullptr, nullptr, nullptr, nullptr);
  }

private:
  void call(int k, int isw, double* xl, double* ul, double* s, double* p) {
    eldata_.n_el = k + 1;
    eldata_.nel = static_cast<int>(nodes(k).size());
    int ndf = elements_.dimension, ndm = ndf, nst = ndf * cdata_.nen;
    elmt07_(d_[at(k)].data(), ul, xl, nullptr, nullptr, s, p, &ndf, &ndm, &nst, &isw);
  }
  void history_in(int k) {
    hdata_.nh1 = 200, hdata_.nh2 = 300;
    std::copy(committed_[at(k)].begin(), committed_[at(k)].end(), comblk_.hr + hdata_.nh1 - 1);
    std::copy(trial_[at(k)].begin(), trial_[at(k)].end(), comblk_.hr + hdata_.nh2 - 1);
  }
  void history_out(int k) { std::copy_n(comblk_.hr + hdata_.nh2 - 1, words_, trial_[at(k)].begin()); }

  std::vector<std::vector<double>> d_, committed_, trial_;
  int words_ = 0;
};

} // namespace

std::unique_ptr<EmulatedHost> feap_host(const Elements& elements) {
  return std::make_unique<FeapHost>(elements);
}

} // namespace adapters

extern "C" {

int pinput_(double* d, int* count) {
  std::copy_n(adapters::material_line.begin(), *count, d);
  return 0;
}
void plstop_(int*) { throw adapters::HostStopped("plstop"); }

} // extern "C"
