#include "cases.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace bench {

namespace {

using mechanics::Basis;
using mechanics::Random;
using mechanics::Scene;
using nlohmann::json;

const char* call_name(Call call) {
  switch (call) {
  case Call::single:
    return "single";
  case Call::batch:
    return "batch";
  case Call::various:
    return "various";
  default:
    return "stream";
  }
}

std::int32_t wanted(const std::string& level) {
  constexpr std::int32_t first = ENTS_XI | ENTS_GAP | ENTS_NORMAL | ENTS_GAP_GRADIENT | ENTS_XI_GRADIENT;
  if (level == "gap") return ENTS_GAP;
  if (level == "kinematics1") return first;
  if (level == "kinematics2") return first | ENTS_GAP_HESSIAN | ENTS_XI_HESSIAN;
  if (level == "R") return ENTS_RESIDUAL;
  if (level == "RK") return ENTS_RESIDUAL | ENTS_TANGENT;
  throw std::invalid_argument(level);
}

bool has_height(const std::string& variant) { return variant != "plain" && variant != "plain_coulomb"; }
bool has_friction(const std::string& variant) {
  return variant == "plain_coulomb" || variant == "enriched_coulomb";
}

// The same wave as a function of the host: what anyone would write, or generate from a formula.
std::int32_t wave(void* parameters, std::int32_t order, std::int32_t count, const double* s, double* jet) {
  const int t = *static_cast<const int*>(parameters);
  constexpr double pi = 3.14159265358979323846;
  for (std::int32_t n = 0; n < count; ++n) {
    const double x = pi * (t == 1 ? s[n] : s[n] + s[count + n]) + 0.3;
    const double h = 0.03 * std::sin(x), h1 = pi * 0.03 * std::cos(x), h2 = -pi * pi * h, h3 = -pi * pi * h1;
    const double by_order[4] = {h, h1, h2, h3};
    int at = 0;
    for (int d = 0; d <= order; ++d)
      for (int j = 0; j <= (t == 1 ? 0 : d); ++j) jet[at++ * count + n] = by_order[d];
  }
  return 0;
}

// One wave per segment, so gentle that the projection is unique.
json height_of(const std::string& variant, int parameters, Random& random) {
  if (!has_height(variant)) return nullptr;
  if (variant == "constant" || variant == "map") return mechanics::draw_height(random, variant, parameters);
  if (variant == "expression")
    return {{"type", "expression"},
            {"h", parameters == 1 ? "a*sin(2*pi*0.5*u + 0.3)" : "a*sin(2*pi*(0.5*u + 0.5*v) + 0.3)"},
            {"constants", {{"a", 0.03}}}};
  if (variant == "callback") {
    static int one = 1, two = 2;
    ents_height_register("wave", parameters, wave, parameters == 1 ? &one : &two, nullptr);
    return {{"type", "callback"}, {"name", "wave"}, {"bound", 0.03}, {"slope", 0.1}, {"curvature", 0.3}};
  }
  return {{"type", "sine"},
          {"amplitude", 0.03},
          {"wave_vector", std::vector<double>(static_cast<std::size_t>(parameters), 0.5)},
          {"phase", 0.3}};
}

// Fixed pseudo-random elements: the same in every run.
Scene scene_of(const Case& c, Random& random) {
  Scene scene = mechanics::draw_scene(random, mechanics::basis_named(c.basis), "none", "normal");
  scene.with_coordinates = c.variant == "coordinates";
  scene.height = height_of(c.variant, scene.basis->parameters(), random);
  if (c.variant == "first_variation" || c.variant == "small_gap") scene.tangent = c.variant;
  return scene;
}

std::string text_of(const Case& c, const Scene& scene) {
  json text = scene.model();
  if (c.variant == "rigid") text["master"] = "rigid";
  if (has_friction(c.variant))
    text["contact"]["friction"] = {
        {"type", "coulomb"}, {"coefficient", friction_coefficient}, {"stiffness", friction_stiffness}};
  return text.dump();
}

std::int64_t count_of(const Case& c) {
  if (c.call == Call::various) return 4096;
  if (c.call == Call::stream) return c.basis == "quad9" ? 25000 : 100000;
  return c.call == Call::single ? 16 : 64;
}

} // namespace

std::string Case::name() const { return basis + "/" + variant + "/" + level + "/" + call_name(call); }

std::vector<std::string> basis_names() { return mechanics::all_basis_names(); }

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const std::string& basis : basis_names())
    for (const char* variant : {"plain", "enriched", "plain_coulomb", "enriched_coulomb"}) {
      for (const Call call : {Call::single, Call::batch})
        for (const char* level : {"gap", "R", "RK", "kinematics1", "kinematics2"})
          if (!has_friction(variant) || level[0] == 'R') cases.push_back({basis, variant, level, call});
    }
  for (const char* basis : {"line2", "tri3", "quad4", "quad9"})
    for (const char* variant : {"plain", "enriched", "plain_coulomb", "enriched_coulomb"})
      for (const char* level : {"R", "RK"}) cases.push_back({basis, variant, level, Call::stream});
  for (const char* basis : {"line2", "quad4", "quad9"})
    for (const char* variant : {"constant", "map", "coordinates", "rigid", "first_variation", "small_gap",
                                "expression", "callback"})
      for (const Call call : {Call::single, Call::batch})
        for (const char* level : {"R", "RK"}) cases.push_back({basis, variant, level, call});
  return cases;
}

Job::Job(const Case& c) : Job(c, Random(2026)) {}

// In contact before, at points so far from the starts that some elements stick and some slip.
void Job::set_anchors(Random& random) {
  ents_layout layout{};
  layout.struct_size = sizeof layout;
  ents_model_layout(model_.handle(), &layout, nullptr);
  const std::size_t size = static_cast<std::size_t>(layout.state_size),
                    t = static_cast<std::size_t>(layout.parameters);
  states_.resize(size * static_cast<std::size_t>(elements_.count));
  ents_state_init(model_.handle(), elements_.count, states_.data(), layout.state_size, nullptr);
  for (std::size_t e = 0; e < static_cast<std::size_t>(elements_.count); ++e) {
    double* state = &states_[e * size];
    state[1] = 2.0; // stick; then age, xi, anchor, slip
    for (std::size_t a = 0; a < t; ++a) {
      state[3 + a] = elements_.start[e * t + a];
      state[3 + t + a] = elements_.start[e * t + a] + random.uniform(-0.03, 0.03);
    }
  }
}

Job::Job(const Case& c, Random random)
    : scene_(scene_of(c, random)), model_(text_of(c, scene_)),
      elements_(mechanics::draw_elements(random, scene_, model_, count_of(c), -0.06, -0.02)) {
  per_call_ = c.call == Call::single ? 1 : elements_.count;
  const std::int32_t wants = wanted(c.level);

  // Start 1e-2 away from the projection, in a random direction.
  const mechanics::Results at = model_.evaluate(elements_, ENTS_XI | ENTS_FLAGS | ENTS_RESIDUAL);
  for (std::int64_t e = 0; e < elements_.count; ++e)
    if (!at.ok(e) || !at.has_flag(e, ENTS_FLAG_CONTACT))
      throw std::runtime_error(c.name() + ": an element is not in contact");
  for (std::size_t i = 0; i < at.xi.size(); ++i)
    elements_.start[i] = at.xi[i] + (random.coin() ? 1e-2 : -1e-2);
  if (has_friction(c.variant)) set_anchors(random);
  const std::vector<std::int32_t> evaluations =
      model_.evaluate(elements_, wants | ENTS_ITERATIONS).iterations;
  surface_evaluations_ =
      std::accumulate(evaluations.begin(), evaluations.end(), 0.0) / static_cast<double>(elements_.count);

  const std::int64_t d = model_.dimension(), t = model_.parameters(), m = model_.nodes(), n = model_.dofs();
  input_.struct_size = sizeof input_;
  input_.slave = elements_.slave.data();
  input_.slave_stride = d;
  input_.master = elements_.master.data();
  input_.master_stride = m * d;
  input_.surface_coordinates =
      elements_.surface_coordinates.empty() ? nullptr : elements_.surface_coordinates.data();
  input_.surface_coordinates_stride = m * t;
  input_.start = elements_.start.data();
  input_.start_stride = t;
  input_.area = elements_.area.data();
  input_.area_stride = 1;
  input_.state_begin = states_.empty() ? nullptr : states_.data();
  input_.state_begin_stride = static_cast<std::int64_t>(states_.size()) / elements_.count;

  // Outputs one behind the other, as a host's element loop has them; written once here, so that no page is
  // new when timed.
  output_.struct_size = sizeof output_;
  output_.wanted = wants;
  const std::pair<std::int32_t, std::int64_t> sizes[] = {{ENTS_XI, t},
                                                         {ENTS_GAP, 1},
                                                         {ENTS_NORMAL, d},
                                                         {ENTS_GAP_GRADIENT, n},
                                                         {ENTS_XI_GRADIENT, t * n},
                                                         {ENTS_GAP_HESSIAN, n * n},
                                                         {ENTS_XI_HESSIAN, t * n * n},
                                                         {ENTS_RESIDUAL, n},
                                                         {ENTS_TANGENT, n * n}};
  std::int64_t total = 0;
  for (const auto& [bit, entries] : sizes)
    if (wants & bit) total += entries * elements_.count;
  storage_.assign(static_cast<std::size_t>(total), 1.0);
  double* position = storage_.data();
  for (const auto& [bit, entries] : sizes) {
    if (!(wants & bit)) continue;
    const auto place = [&](double*& pointer, std::int64_t& stride) {
      pointer = position;
      stride = entries;
    };
    switch (bit) {
    case ENTS_XI:
      place(output_.xi, output_.xi_stride);
      break;
    case ENTS_GAP:
      place(output_.gap, output_.gap_stride);
      break;
    case ENTS_NORMAL:
      place(output_.normal, output_.normal_stride);
      break;
    case ENTS_GAP_GRADIENT:
      place(output_.gap_gradient, output_.gap_gradient_stride);
      break;
    case ENTS_XI_GRADIENT:
      place(output_.xi_gradient, output_.xi_gradient_stride);
      break;
    case ENTS_GAP_HESSIAN:
      place(output_.gap_hessian, output_.gap_hessian_stride);
      break;
    case ENTS_XI_HESSIAN:
      place(output_.xi_hessian, output_.xi_hessian_stride);
      break;
    case ENTS_RESIDUAL:
      place(output_.residual, output_.residual_stride);
      break;
    default:
      place(output_.tangent, output_.tangent_stride);
      break;
    }
    position += entries * elements_.count;
  }
  if (ents_evaluate(model_.handle(), 0, elements_.count, &input_, &output_, nullptr) != ENTS_OK)
    throw std::runtime_error(c.name() + ": an element fails");
  if (frictional()) check_friction(c.name());
}

void Job::check_friction(const std::string& name) const {
  std::vector<std::int32_t> flags(static_cast<std::size_t>(elements_.count));
  ents_output output{};
  output.struct_size = sizeof output;
  output.wanted = ENTS_FLAGS;
  output.flags = flags.data();
  output.flags_stride = 1;
  if (ents_evaluate(model_.handle(), 0, elements_.count, &input_, &output, nullptr) != ENTS_OK)
    throw std::runtime_error(name + ": no flags");
  for (const std::int32_t flag : {ENTS_FLAG_STICK, ENTS_FLAG_SLIP})
    if (std::none_of(flags.begin(), flags.end(), [flag](std::int32_t f) { return (f & flag) != 0; }))
      throw std::runtime_error(name +
                               (flag == ENTS_FLAG_STICK ? ": no element sticks" : ": no element slips"));
}

} // namespace bench
