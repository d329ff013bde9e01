#include "savings.hpp"

#include <algorithm>
#include <functional>
#include <iomanip>
#include <memory>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "scene.hpp"
#include "thread_time.hpp"

namespace bench {

namespace {

using nlohmann::json;

enum class Height { sine, constant, none };

// A scene, by what it has.
struct Need {
  const char* name;
  Height height = Height::sine;
  bool rigid = false, friction = true, tangent = true, contact = true;
};

constexpr Need needs[] = {
    {"everything"},
    {"constant height", Height::constant},
    {"no height", Height::none},
    {"rigid master", Height::sine, true},
    {"frictionless", Height::sine, false, false},
    {"residual alone", Height::sine, false, true, false},
    {"open", Height::sine, false, true, true, false},
    {"no height, frictionless", Height::none, false, false},
    {"no height, frictionless, residual alone", Height::none, false, false, false},
    {"no height, frictionless, open", Height::none, false, false, true, false},
    {"nothing of all this", Height::none, true, false, false, false},
};

constexpr const char* need_names[] = {"height",   "slope",   "curved",      "iteration", "master",
                                      "friction", "history", "multipliers", "one_by_one"};

// 64 elements, the same segments and places on them for all scenes, each with nodes and equations of its own.
class Elements {
public:
  Elements(const char* basis, const Need& need) : Elements(basis, need, mechanics::Random(2026)) {}
  Elements(const Elements&) = delete;

  void evaluate_one_by_one() { // 16 in turn, as `single` of the other cases
    for (std::int64_t e = 0; e < singles; ++e)
      ents_evaluate(model_->handle(), e, 1, &input_, &output_, nullptr);
  }
  void evaluate_all() { check(ents_evaluate(model_->handle(), 0, count, &input_, &output_, &report_)); }
  void assemble_all() {
    check(ents_assemble(model_->handle(), 0, count, &assembly_input_, nullptr, &system_, &report_));
  }
  const ents_layout& layout() const { return layout_; }

  static constexpr std::int64_t count = 64, singles = 16;

private:
  Elements(const char* basis, const Need& need, mechanics::Random random);
  void set_anchors(mechanics::Random& random, bool contact);
  void set_system();
  void check(std::int32_t status) const {
    if (status != ENTS_OK) throw std::runtime_error(report_.message);
  }

  std::unique_ptr<mechanics::Model> model_;
  ents_layout layout_{};
  ents_report report_{};
  mechanics::Elements elements_;
  std::vector<double> states_, residual_, tangent_, values_;
  std::vector<std::int64_t> connectivity_, segment_, slave_equations_, master_equations_, places_;
  std::vector<std::int32_t> row_begin_, columns_;
  ents_input input_{}, assembly_input_{};
  ents_output output_{};
  ents_master_mesh mesh_{};
  ents_system system_{};
};

std::string text_of(const mechanics::Scene& scene, const Need& need) {
  json text = scene.model();
  const std::vector<double> wave(static_cast<std::size_t>(scene.basis->parameters()), 0.5);
  if (need.height == Height::sine)
    text["height"] = {{"type", "sine"}, {"amplitude", 0.03}, {"wave_vector", wave}, {"phase", 0.3}};
  if (need.height == Height::constant) text["height"] = {{"type", "constant"}, {"value", 0.03}};
  if (need.rigid) text["master"] = "rigid";
  if (need.friction)
    text["contact"]["friction"] = {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 0.8}};
  return text.dump();
}

Elements::Elements(const char* basis, const Need& need, mechanics::Random random) {
  mechanics::Scene scene = mechanics::draw_scene(random, mechanics::basis_named(basis), "none", "normal");
  scene.with_coordinates = false;
  model_ = std::make_unique<mechanics::Model>(text_of(scene, need));
  report_.struct_size = sizeof report_;
  layout_.struct_size = sizeof layout_;
  check(ents_model_layout(model_->handle(), &layout_, &report_));
  elements_ = mechanics::draw_elements(random, scene, *model_, count, need.contact ? -0.06 : 0.02,
                                       need.contact ? -0.02 : 0.06);
  const mechanics::Results at = model_->evaluate(elements_, ENTS_XI | ENTS_FLAGS | ENTS_RESIDUAL);
  for (std::int64_t e = 0; e < count; ++e)
    if (!at.ok(e) || at.has_flag(e, ENTS_FLAG_CONTACT) != need.contact)
      throw std::runtime_error(std::string(need.name) + ": wrong elements");
  for (std::size_t i = 0; i < at.xi.size(); ++i)
    elements_.start[i] = at.xi[i] + (random.coin() ? 1e-2 : -1e-2);
  if (need.friction) set_anchors(random, need.contact);

  const std::int64_t d = layout_.dimension, n = layout_.dofs;
  input_.struct_size = sizeof input_;
  input_.slave = elements_.slave.data(), input_.slave_stride = d;
  input_.start = elements_.start.data(), input_.start_stride = layout_.parameters;
  input_.area = elements_.area.data(), input_.area_stride = 1;
  input_.state_begin = states_.empty() ? nullptr : states_.data(),
  input_.state_begin_stride = layout_.state_size;
  assembly_input_ = input_; // that of the mesh
  input_.master = elements_.master.data(), input_.master_stride = layout_.nodes * d;
  residual_.assign(static_cast<std::size_t>(n * count), 1.0);
  tangent_.assign(static_cast<std::size_t>(n * n * count), 1.0);
  output_.struct_size = sizeof output_;
  output_.wanted = ENTS_RESIDUAL | (need.tangent ? ENTS_TANGENT : 0);
  output_.residual = residual_.data(), output_.residual_stride = n;
  output_.tangent = tangent_.data(), output_.tangent_stride = n * n;
  set_system();
  if (!need.tangent) system_.values = nullptr;
  evaluate_all();
  assemble_all(); // the first call finds the places
}

// In contact before, at points so far from the starts that some elements stick and some slip; or open before.
void Elements::set_anchors(mechanics::Random& random, bool contact) {
  const std::size_t size = static_cast<std::size_t>(layout_.state_size),
                    t = static_cast<std::size_t>(layout_.parameters);
  states_.resize(size * count);
  check(ents_state_init(model_->handle(), count, states_.data(), layout_.state_size, &report_));
  for (std::size_t e = 0; e < count; ++e) {
    double* state = &states_[e * size];
    state[1] = contact ? 2.0 : 1.0; // stick, open; then age, xi, anchor, slip
    for (std::size_t a = 0; a < t; ++a) {
      state[3 + a] = elements_.start[e * t + a];
      state[3 + t + a] = elements_.start[e * t + a] + random.uniform(-0.03, 0.03);
    }
  }
}

// Element e has the equations e n .. e n + n - 1, in the order of its dofs.
void Elements::set_system() {
  const std::int64_t d = layout_.dimension, m = layout_.nodes, n = layout_.dofs;
  for (std::int64_t e = 0; e < count; ++e) {
    segment_.push_back(e);
    for (std::int64_t i = 0; i < m; ++i) connectivity_.push_back(e * m + i);
    for (std::int64_t c = 0; c < d; ++c) slave_equations_.push_back(e * n + c);
    for (std::int64_t c = 0; c < m * d; ++c) master_equations_.push_back(n > d ? e * n + d + c : -1);
    for (std::int64_t row = 0; row < n; ++row) {
      row_begin_.push_back(static_cast<std::int32_t>(columns_.size()));
      for (std::int64_t c = 0; c < n; ++c) columns_.push_back(static_cast<std::int32_t>(e * n + c));
    }
  }
  row_begin_.push_back(static_cast<std::int32_t>(columns_.size()));
  values_.resize(columns_.size());
  mesh_.struct_size = sizeof mesh_;
  mesh_.segments = count, mesh_.connectivity = connectivity_.data();
  mesh_.nodes = count * m, mesh_.positions = elements_.master.data();
  assembly_input_.mesh = &mesh_;
  assembly_input_.segment = segment_.data(), assembly_input_.segment_stride = 1;
  system_.struct_size = sizeof system_;
  system_.index_size = 4;
  system_.slave_nodes = count, system_.slave_equations = slave_equations_.data();
  system_.master_nodes = mesh_.nodes, system_.master_equations = master_equations_.data();
  system_.rows = count * n;
  system_.residual = residual_.data(), system_.values = values_.data();
  system_.row_begin = row_begin_.data(), system_.columns = columns_.data();
  system_.places_size = d * (m + 1) * (m + 1) + 1;
  places_.resize(static_cast<std::size_t>(system_.places_size * count));
  system_.places = places_.data();
}

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

std::string left_out(std::int32_t full, std::int32_t now) {
  std::string text;
  for (int bit = 0; bit < 9; ++bit) {
    if (((full ^ now) >> bit & 1) == 0) continue;
    if (!text.empty()) text += ' ';
    text += (full >> bit & 1) != 0 ? '-' : '+';
    text += need_names[bit];
  }
  return text;
}

constexpr int calls = 3, rounds = 41;
constexpr const char* call_names[calls] = {"single", "64 a call", "assembled"};
constexpr double noise = 1.05; // medians of two runs differ by less

void print_basis(std::ostream& out, const char* basis, std::ostream& more_expensive) {
  std::vector<std::unique_ptr<Elements>> scenes;
  std::vector<Clock> clocks; // [scene][call]
  for (const Need& need : needs) {
    Elements* e = scenes.emplace_back(std::make_unique<Elements>(basis, need)).get();
    clocks.push_back({[e] { e->evaluate_one_by_one(); }, Elements::singles});
    clocks.push_back({[e] { e->evaluate_all(); }, Elements::count});
    clocks.push_back({[e] { e->assemble_all(); }, Elements::count});
  }
  for (Clock& clock : clocks) clock.calibrate();
  for (int round = 0; round < rounds; ++round)
    for (Clock& clock : clocks) clock.measure();

  out << "\n" << std::left << std::setw(41) << basis << std::right;
  for (const char* call : call_names) out << std::setw(11) << call << std::setw(7) << "ratio";
  out << "   kernels   needs\n";
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const ents_layout& layout = scenes[s]->layout();
    out << std::left << std::setw(41) << needs[s].name << std::right << std::fixed;
    for (std::size_t c = 0; c < calls; ++c) {
      const double now = clocks[calls * s + c].median(), ratio = now / clocks[c].median();
      out << std::setw(11) << std::setprecision(1) << now << std::setw(7) << std::setprecision(2) << ratio;
      if (ratio > noise)
        more_expensive << "  " << needs[s].name << " (" << basis << ", " << call_names[c] << "): " << ratio
                       << "\n";
    }
    out << "   " << std::left << std::setw(10) << layout.instruction_set
        << left_out(s == 0 ? 0 : scenes[0]->layout().needs, layout.needs) << std::right << "\n";
  }
}

} // namespace

void run_savings(std::ostream& out) {
  out << "What a scene does not need is not computed: everything (a sine, a master that deforms, Coulomb "
         "friction,\n"
         "residual and tangent, contact), then without some of it. ns per element (thread CPU time, "
         "medians,\n"
         "interleaved) and ratio to everything; evaluated in calls of one and of 64 elements, and 64 "
         "assembled by\n"
         "ents_assemble. needs: what ents_layout says of the model: of everything (+), then what is left out "
         "(-) or\n"
         "comes in (+); a tangent that is not asked for and a slave that is open are a matter of the call\n";
  std::ostringstream more_expensive;
  more_expensive << std::fixed << std::setprecision(2);
  for (const char* basis : {"line2", "tri3", "quad4"}) print_basis(out, basis, more_expensive);
  if (!more_expensive.str().empty()) out << "\ncosts more than everything:\n" << more_expensive.str();
}

} // namespace bench
