#include "savings.hpp"

#include <algorithm>
#include <iomanip>
#include <memory>
#include <ostream>
#include <sstream>
#include <vector>

#include "timed_elements.hpp"

namespace bench {

namespace {

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

Timed timed_of(const char* basis, const Need& need) {
  const int parameters = mechanics::basis_named(basis).parameters();
  Timed timed;
  if (need.height == Height::sine) timed.patch["height"] = sine_height(parameters);
  if (need.height == Height::constant) timed.patch["height"] = {{"type", "constant"}, {"value", 0.03}};
  if (need.rigid) timed.patch["master"] = "rigid";
  if (need.friction)
    timed.patch["contact"]["friction"] = {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 0.8}};
  timed.wanted = ENTS_RESIDUAL | (need.tangent ? ENTS_TANGENT : 0);
  timed.contact = need.contact;
  return timed;
}

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
  std::vector<std::unique_ptr<TimedElements>> scenes;
  std::vector<Clock> clocks; // [scene][call]
  for (const Need& need : needs) {
    TimedElements* e =
        scenes.emplace_back(std::make_unique<TimedElements>(basis, timed_of(basis, need))).get();
    e->prepare_assembly();
    clocks.push_back({[e] { e->evaluate_one_by_one(); }, TimedElements::singles});
    clocks.push_back({[e] { e->evaluate_all(); }, TimedElements::count});
    clocks.push_back({[e] { e->assemble_all(); }, TimedElements::count});
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
