// 64 elements of one model and what a call for them takes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene.hpp"
#include "thread_time.hpp"

namespace bench {

// What is made of the same segments and places on them.
struct Timed {
  nlohmann::json patch = nlohmann::json::object(); // of the model: a JSON merge patch (RFC 7396)
  nlohmann::json normal;                           // its normal law; null: a penalty
  std::int32_t wanted = ENTS_RESIDUAL | ENTS_TANGENT;
  bool contact = true;
};

// A sine of half a wave per unit of s
nlohmann::json sine_height(int parameters);

// 64 elements, the same segments and places on them for all scenes, each with nodes and equations of its own.
class TimedElements {
public:
  TimedElements(const char* basis, const Timed& timed);
  TimedElements(const TimedElements&) = delete;

  void evaluate_one_by_one() { // 16 in turn, as `single` of the other cases
    for (std::int64_t e = 0; e < singles; ++e)
      ents_evaluate(model_->handle(), e, 1, &input_, &output_, nullptr);
  }
  void evaluate(std::int64_t e) { ents_evaluate(model_->handle(), e, 1, &input_, &output_, nullptr); }
  // hard: its start is so bad that the whole segment is searched.
  void set_start(std::int64_t e, bool hard) {
    for (std::int64_t a = 0; a < layout_.parameters; ++a) {
      const auto i = static_cast<std::size_t>(e * layout_.parameters + a);
      elements_.start[i] = hard ? 1e6 : starts_[i];
    }
  }
  void evaluate_all() { check(ents_evaluate(model_->handle(), 0, count, &input_, &output_, &report_)); }
  // To be called before assemble_all()
  void prepare_assembly();
  void assemble_all() {
    check(ents_assemble(model_->handle(), 0, count, &assembly_input_, nullptr, &system_, &report_));
  }
  const ents_layout& layout() const { return layout_; }

  static constexpr std::int64_t count = 64, singles = 16;

private:
  void set_states(mechanics::Random& random, bool contact, bool friction, bool patch);
  void set_system();
  void check(std::int32_t status) const {
    if (status != ENTS_OK) throw std::runtime_error(report_.message);
  }

  std::unique_ptr<mechanics::Model> model_;
  ents_layout layout_{};
  ents_report report_{};
  mechanics::Elements elements_;
  std::vector<double> starts_, states_, residual_, tangent_, values_, multipliers_, variations_,
      temperatures_;
  std::vector<std::int64_t> connectivity_, segment_, slave_equations_, master_equations_, places_;
  std::vector<std::int32_t> row_begin_, columns_;
  ents_input input_{}, assembly_input_{};
  ents_output output_{};
  ents_master_mesh mesh_{};
  ents_system system_{};
};

// One way to call the elements of one scene.
struct Clock {
  std::function<void()> run;
  std::int64_t elements;
  int repetitions = 1;
  std::vector<double> nanoseconds{};

  double seconds() const {
    const double begin = thread_seconds();
    for (int i = 0; i < repetitions; ++i) run();
    return thread_seconds() - begin;
  }
  void calibrate() {
    constexpr double enough = 2e-4;
    while (seconds() < enough) repetitions *= 2;
  }
  void measure() { nanoseconds.push_back(1e9 * seconds() / static_cast<double>(repetitions * elements)); }
  double median() {
    const auto middle = nanoseconds.begin() + static_cast<std::ptrdiff_t>(nanoseconds.size() / 2);
    std::nth_element(nanoseconds.begin(), middle, nanoseconds.end());
    return *middle;
  }
};

} // namespace bench
