// What is timed: contact elements by basis, height, wanted results and kind of call.
#pragma once

#include <string>
#include <vector>

#include "scene.hpp"

namespace bench {

enum class Call {
  single, // one element per call, 16 different ones in turn: everything stays in the first cache
  batch,  // 64 elements per call
  stream, // 1e5 elements per call, from and to main memory
  various // 4096 per call; not among all_cases(), for those who take the elements
};

struct Case {
  std::string basis;
  std::string variant; // plain, enriched, constant, map, rigid, ...
  std::string level;   // gap, kinematics1, kinematics2, R, RK
  Call call = Call::single;

  std::string name() const; // quad4/enriched/RK/single
};

// Of the variants with friction. The stiffness, per area, is such that some elements stick and some slip.
inline constexpr double friction_coefficient = 0.3, friction_stiffness = 8.0;

// Of all bases, those of the plane first.
std::vector<std::string> basis_names();

// The grid basis x {plain, enriched} x level x call, and what shows that absent things cost nothing.
std::vector<Case> all_cases();

// Elements in contact, ready to be evaluated again and again.
class Job {
public:
  explicit Job(const Case& c);

  // One call; elements follow each other from call to call where there are several in the arrays.
  void run() {
    ents_evaluate(model_.handle(), next_, per_call_, &input_, &output_, nullptr);
    next_ += per_call_;
    if (next_ == elements_.count) next_ = 0;
  }
  std::int64_t elements_per_call() const { return per_call_; }
  double mean_surface_evaluations() const { return surface_evaluations_; }
  double* results() { return storage_.data(); } // RK: [elements][n], then [elements][n][n]

  const ents_input& input() const { return input_; }
  const ents_output& output() const { return output_; }
  const mechanics::Elements& elements() const { return elements_; }
  const mechanics::Model& model() const { return model_; }
  int dimension() const { return model_.dimension(); }
  int dofs() const { return model_.dofs(); }
  double stiffness() const { return scene_.stiffness; }
  const nlohmann::json& height() const { return scene_.height; }
  std::vector<double> projections() const {
    return model_.evaluate(elements_, ENTS_XI).xi;
  } // [elements][d-1]
  bool frictional() const { return !states_.empty(); }
  // With friction: natural coordinates [d-1] of the point where element e stuck
  const double* anchor(std::size_t e) const {
    const std::size_t count = static_cast<std::size_t>(elements_.count);
    return &states_[e * (states_.size() / count) + 3 + elements_.start.size() / count];
  }

private:
  Job(const Case& c, mechanics::Random random);
  void set_anchors(mechanics::Random& random);
  void check_friction(const std::string& name) const;

  mechanics::Scene scene_;
  mechanics::Model model_;
  mechanics::Elements elements_;
  std::vector<double> states_; // with friction
  std::int64_t next_ = 0, per_call_ = 1;
  ents_input input_{};
  ents_output output_{};
  std::vector<double> storage_;
  double surface_evaluations_ = 0.0;
};

} // namespace bench
