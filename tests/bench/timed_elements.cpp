#include "timed_elements.hpp"

namespace bench {

nlohmann::json sine_height(int parameters) {
  return {{"type", "sine"},
          {"amplitude", 0.03},
          {"wave_vector", std::vector<double>(static_cast<std::size_t>(parameters), 0.5)},
          {"phase", 0.3}};
}

namespace {

nlohmann::json text_of(const mechanics::Scene& scene, const Timed& timed) {
  nlohmann::json text = scene.model();
  text.merge_patch(timed.patch);
  if (!timed.normal.is_null()) text["contact"]["normal"] = timed.normal;
  return text;
}

// The places of the elements do not depend on their law.
nlohmann::json text_of_places(const mechanics::Scene& scene, const Timed& timed) {
  Timed places = timed;
  places.normal = nullptr;
  for (const char* key : {"contact", "patch", "master"}) places.patch.erase(key);
  return text_of(scene, places);
}

} // namespace

TimedElements::TimedElements(const char* basis, const Timed& timed) {
  mechanics::Random random(2026);
  mechanics::Scene scene = mechanics::draw_scene(random, mechanics::basis_named(basis), "none", "normal");
  scene.with_coordinates = false;
  const nlohmann::json text = text_of(scene, timed);
  const mechanics::Model places(text_of_places(scene, timed).dump());
  model_ = std::make_unique<mechanics::Model>(text.dump());
  report_.struct_size = sizeof report_;
  layout_.struct_size = sizeof layout_;
  check(ents_model_layout(model_->handle(), &layout_, &report_));
  elements_ = mechanics::draw_elements(random, scene, places, count, timed.contact ? -0.06 : 0.02,
                                       timed.contact ? -0.02 : 0.06);
  const mechanics::Results at = places.evaluate(elements_, ENTS_XI | ENTS_FLAGS | ENTS_RESIDUAL);
  for (std::int64_t e = 0; e < count; ++e)
    if (!at.ok(e) || at.has_flag(e, ENTS_FLAG_CONTACT) != timed.contact)
      throw std::runtime_error(text.dump() + ": wrong elements");
  for (std::size_t i = 0; i < at.xi.size(); ++i)
    elements_.start[i] = at.xi[i] + (random.coin() ? 1e-2 : -1e-2);
  starts_ = elements_.start;
  const bool friction = text["contact"].contains("friction"), patch = text.contains("patch");
  if (friction || patch) set_states(random, timed.contact, friction, patch);

  const std::int64_t d = layout_.dimension, n = layout_.dofs, nodes = n - layout_.multipliers;
  input_.struct_size = sizeof input_;
  input_.slave = elements_.slave.data(), input_.slave_stride = d;
  input_.start = elements_.start.data(), input_.start_stride = layout_.parameters;
  input_.area = elements_.area.data(), input_.area_stride = 1;
  input_.state_begin = states_.empty() ? nullptr : states_.data(),
  input_.state_begin_stride = layout_.state_size;
  multipliers_.assign(static_cast<std::size_t>(layout_.multipliers * count), -1.0); // a pressure
  input_.multiplier = multipliers_.empty() ? nullptr : multipliers_.data();
  input_.multiplier_stride = layout_.multipliers;
  if (layout_.heat != 0) { // of the slave, then of the master's nodes
    const std::int64_t size = 1 + layout_.nodes;
    for (std::int64_t i = 0; i < size * count; ++i) temperatures_.push_back(random.uniform(0.0, 1.0));
    input_.slave_temperature = temperatures_.data(), input_.slave_temperature_stride = size;
    input_.master_temperature = temperatures_.data() + 1, input_.master_temperature_stride = size;
    input_.time_increment = 1.0;
  }
  assembly_input_ = input_; // that of the mesh
  input_.master = elements_.master.data(), input_.master_stride = layout_.nodes * d;
  residual_.assign(static_cast<std::size_t>(n * count), 1.0);
  tangent_.assign(static_cast<std::size_t>(n * n * count), 1.0);
  output_.struct_size = sizeof output_;
  output_.wanted = timed.wanted;
  output_.residual = residual_.data(), output_.residual_stride = n;
  output_.tangent = tangent_.data(), output_.tangent_stride = n * n;
  if ((timed.wanted & ENTS_GAP_HESSIAN) != 0) {
    variations_.assign(static_cast<std::size_t>(nodes * nodes * count), 0.0);
    output_.gap_hessian = variations_.data(), output_.gap_hessian_stride = nodes * nodes;
  }
  evaluate_all();
}

void TimedElements::prepare_assembly() {
  set_system();
  if ((output_.wanted & ENTS_TANGENT) == 0) system_.values = nullptr;
  assemble_all(); // the first call finds the places
}

// In contact before, at points so far from the starts that some elements stick and some slip; or open before.
void TimedElements::set_states(mechanics::Random& random, bool contact, bool friction, bool patch) {
  const std::size_t size = static_cast<std::size_t>(layout_.state_size),
                    t = static_cast<std::size_t>(layout_.parameters);
  states_.resize(size * count);
  check(ents_state_init(model_->handle(), count, states_.data(), layout_.state_size, &report_));
  for (std::size_t e = 0; e < count; ++e) {
    double* state = &states_[e * size];
    state[1] = contact ? 2.0 : 1.0;   // stick, open; then age, xi, anchor, slip
    if (patch) state[size - 1] = 1.0; // on its first segment
    for (std::size_t a = 0; a < t; ++a) {
      state[3 + a] = elements_.start[e * t + a];
      if (friction) state[3 + t + a] = elements_.start[e * t + a] + random.uniform(-0.03, 0.03);
    }
  }
}

// Element e has the equations e n .. e n + n - 1, in the order of its dofs.
void TimedElements::set_system() {
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

} // namespace bench
