// Three slave nodes against one quad4 segment that carries a sine: as one batch, then one by one. client.c
// and client.f90 do the same; all three print the same text. 17 significant digits name a double: same text,
// same bits.
#include "ents.h"

#include <array>
#include <iomanip>
#include <iostream>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

namespace {

constexpr char model_text[] = R"({
  "segment": "quad4",
  "height": {"type": "sine", "amplitude": 0.05, "wave_vector": [0.5, 0.25], "phase": 0.3},
  "projection": {"type": "normal"},
  "contact": {"normal": {"type": "penalty", "stiffness": 1000.0}}
})";

constexpr int elements = 3;
constexpr int dofs = 3 * (1 + 4);

constexpr double slave[elements][3] = {{0.1, 0.2, 0.02}, {-0.4, 0.3, -0.01}, {0.5, -0.6, 0.4}};
constexpr double master[4][3] = {{-1.0, -1.0, 0.1}, {1.2, -1.0, 0.0}, {1.0, 1.0, 0.0}, {-1.0, 0.9, 0.0}};

struct Result {
  std::array<std::int32_t, elements> flags{};
  std::array<double, elements> gap{};
  std::array<double, elements * dofs> residual{};
  std::array<double, elements * dofs * dofs> tangent{};
  bool operator==(const Result&) const = default;
};

void check(std::int32_t status, const ents_report& report) {
  if (status == ENTS_OK) return;
  throw std::runtime_error(std::string(ents_status_text(status)) + " (element " +
                           std::to_string(report.element) + "): " + report.message);
}

struct Destroy {
  void operator()(ents_model* model) const { ents_model_destroy(&model, nullptr); }
};
using Model = std::unique_ptr<ents_model, Destroy>;

Model create(const std::string& text) {
  ents_report report{};
  report.struct_size = sizeof report;
  ents_model* model = nullptr;
  check(ents_check_contract(ENTS_CONTRACT_MAJOR, ENTS_CONTRACT_MINOR, &report), report);
  check(ents_model_create(text.data(), std::ssize(text), nullptr, nullptr, 0, &model, &report), report);
  return Model(model);
}

// Evaluate the elements first .. first + count - 1 into their places in the arrays.
void evaluate(const Model& model, std::int64_t first, std::int64_t count, Result& result) {
  ents_report report{};
  report.struct_size = sizeof report;

  ents_input input{};
  input.struct_size = sizeof input;
  input.slave = slave[0];
  input.slave_stride = 3;
  input.master = master[0]; // stride 0: one segment for all

  ents_output output{};
  output.struct_size = sizeof output;
  output.wanted = ENTS_FLAGS | ENTS_GAP | ENTS_RESIDUAL | ENTS_TANGENT;
  output.gap = result.gap.data();
  output.gap_stride = 1;
  output.residual = result.residual.data();
  output.residual_stride = dofs;
  output.tangent = result.tangent.data();
  output.tangent_stride = dofs * dofs;
  output.flags = result.flags.data();
  output.flags_stride = 1;

  check(ents_evaluate(model.get(), first, count, &input, &output, &report), report);
}

void print(const char* name, int element, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    std::cout << name << ' ' << element << ' ' << i << ' ' << std::setw(24) << values[i] << '\n';
}

} // namespace

int main() try {
  const Model model = create(model_text);
  Result batch, single;
  evaluate(model, 0, elements, batch);
  for (int e = 0; e < elements; ++e) evaluate(model, e, 1, single);
  if (batch != single) throw std::runtime_error("the batch differs from single calls");

  std::cout << std::scientific << std::uppercase << std::setprecision(16);
  for (int e = 0; e < elements; ++e) {
    const auto i = static_cast<std::size_t>(e);
    std::cout << "contact " << e << ' ' << (batch.flags[i] & ENTS_FLAG_CONTACT) << '\n';
    print("gap", e, std::span(batch.gap).subspan(i, 1));
    print("residual", e, std::span(batch.residual).subspan(i * dofs, dofs));
    print("tangent", e, std::span(batch.tangent).subspan(i * dofs * dofs, dofs * dofs));
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
