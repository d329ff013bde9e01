// SPDX-License-Identifier: BSD-3-Clause
// The problem without an adapter: what every other host has to agree with.
#include <fstream>

#include "plain_model.hpp"
#include "problem.hpp"

namespace adapters {
namespace {

nlohmann::json without_height(const std::string& file) {
  std::ifstream in(file);
  auto model = nlohmann::json::parse(in);
  model["height"] = nullptr;
  return model;
}

class PlainHost : public EmulatedHost {
public:
  explicit PlainHost(const Elements& elements)
      : EmulatedHost(elements), model_("ents_" + std::to_string(elements.model) + ".json"),
        base_(without_height("ents_" + std::to_string(elements.model) + ".json")),
        history_(elements.nodes.size(), std::vector<double>(static_cast<std::size_t>(elements.state_size))),
        trial_(history_) {
    for (auto& state : history_) ents_state_init(model_.get(), 1, state.data(), elements.state_size, nullptr);
  }

  Answer evaluate(int element, const std::vector<double>& displacement) override {
    const auto k = static_cast<std::size_t>(element);
    const std::vector<double> x = gather(element, elements_.reference), u = gather(element, displacement);
    const int d = elements_.dimension, n = static_cast<int>(x.size()), dofs = model_.layout().dofs;
    const std::size_t of_nodes = static_cast<std::size_t>(dofs - model_.layout().multipliers);
    std::vector<double> position(x.size()), residual(static_cast<std::size_t>(dofs)),
        tangent(static_cast<std::size_t>(dofs * dofs));
    for (std::size_t i = 0; i < x.size(); ++i) position[i] = x[i] + u[i];
    auto report = ents_struct<ents_report>();
    auto input = ents_struct<ents_input>();
    input.slave = position.data();
    input.master = position.data() + d;
    input.multiplier = u.data() + of_nodes;
    input.area = &elements_.area[k];
    input.state_begin = history_[k].data();
    auto output = ents_struct<ents_output>();
    output.wanted = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_STATE;
    output.residual = residual.data();
    output.tangent = tangent.data();
    output.state_end = trial_[k].data();
    // Start straight ahead, on the segment without its height.
    auto no_history = input;
    no_history.state_begin = nullptr;
    double start[2];
    auto projection = ents_struct<ents_output>();
    projection.wanted = ENTS_XI;
    projection.xi = start;
    if (ents_evaluate(base_.get(), 0, 1, &no_history, &projection, nullptr) == ENTS_OK) input.start = start;
    int32_t flags = 0;
    output.wanted |= ENTS_FLAGS;
    output.flags = &flags;
    int32_t status = ents_evaluate(model_.get(), 0, 1, &input, &output, &report);
    if (status == 0 && (flags & ENTS_FLAG_NO_BEGIN)) { // its way begins where the increment did
      const std::vector<double> change = gather_change(element, displacement);
      std::vector<double> before = position, state(history_[k]);
      for (std::size_t i = 0; i < before.size(); ++i) before[i] -= change[i];
      std::vector<double> multiplier(u.begin() + static_cast<std::ptrdiff_t>(of_nodes), u.end());
      for (std::size_t i = 0; i < multiplier.size(); ++i) multiplier[i] -= change[of_nodes + i];
      auto at_begin = input;
      at_begin.slave = before.data(), at_begin.master = before.data() + d, at_begin.start = nullptr;
      at_begin.multiplier = multiplier.data();
      auto begin = ents_struct<ents_output>();
      begin.wanted = ENTS_STATE;
      begin.state_end = state.data();
      if (ents_evaluate(model_.get(), 0, 1, &at_begin, &begin, nullptr) == ENTS_OK) {
        input.state_begin = state.data();
        status = ents_evaluate(model_.get(), 0, 1, &input, &output, &report);
      }
    }
    if (status < 0) throw HostStopped(report.message);
    Answer answer;
    answer.step_factor = report.step_factor;
    if (status > 0) return answer;
    // Multipliers follow the nodes; the rest of their node is empty.
    answer.residual.assign(x.size(), 0.0);
    answer.tangent.assign(x.size() * x.size(), 0.0);
    for (int i = 0; i < dofs; ++i) {
      answer.residual[static_cast<std::size_t>(i)] = residual[static_cast<std::size_t>(i)];
      for (int j = 0; j < dofs; ++j)
        answer.tangent[static_cast<std::size_t>(i + n * j)] = tangent[static_cast<std::size_t>(i + dofs * j)];
    }
    return answer;
  }
  void accept() override { history_ = trial_; }
  void set_history(int element, const std::vector<double>& state) override {
    history_[static_cast<std::size_t>(element)] = state;
  }
  std::vector<double> history(int element) override { return trial_[static_cast<std::size_t>(element)]; }

private:
  PlainModel model_, base_;
  std::vector<std::vector<double>> history_, trial_;
};

} // namespace

std::unique_ptr<EmulatedHost> plain_host(const Elements& elements) {
  return std::make_unique<PlainHost>(elements);
}

} // namespace adapters
