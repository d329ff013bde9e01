#include "laws.hpp"

#include <iomanip>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "interleaved.hpp"
#include "timed_elements.hpp"

namespace bench {

namespace {

using nlohmann::json;

// A way to evaluate the same elements
struct Way {
  const char* name;
  json normal, patch = json::object();
};

json stiff(const char* type) { return {{"type", type}, {"stiffness", 50.0}}; }

json conductance_of_pressure() {
  return {{"power", {{"coefficient", 3.0}, {"pressure", 1.0}, {"exponent", 0.95}}}};
}

std::vector<Way> ways(int nodes) {
  json patch = json::array({json::array()});
  for (int i = 0; i < nodes; ++i) patch[0].push_back(i);
  return {
      {"penalty", stiff("penalty")},
      {"power", {{"type", "power"}, {"coefficient", 300.0}, {"exponent", 2.0}}},
      {"exponential", {{"type", "exponential"}, {"pressure", 0.1}, {"clearance", 0.02}}},
      {"augmented", stiff("augmented")},
      {"augmented_multiplier", stiff("augmented_multiplier")},
      {"multiplier", stiff("multiplier")},
      {"symmetrised", stiff("penalty"), {{"contact", {{"symmetrised", true}}}}},
      {"small_gap", stiff("penalty"), {{"tangent", "small_gap"}}},
      {"first_variation", stiff("penalty"), {{"tangent", "first_variation"}}},
      {"rigid master", stiff("penalty"), {{"master", "rigid"}}},
      {"patch of one", stiff("penalty"), {{"patch", patch}}},
      {"heat", stiff("penalty"), {{"contact", {{"heat", {{"conductance", 3.0}}}}}}},
      {"heat, of pressure", stiff("penalty"), {{"contact", {{"heat", conductance_of_pressure()}}}}},
  };
}

const std::pair<const char*, json> frictions[] = {
    {"none", nullptr},
    {"coulomb", {{"type", "coulomb"}, {"coefficient", 0.3}, {"stiffness", 0.8}}},
    {"rough", {{"type", "rough"}, {"stiffness", 0.8}}},
};

Timed timed_of(const char* basis, const Way& way, const json& friction, bool enriched) {
  Timed timed;
  timed.normal = way.normal;
  timed.patch = way.patch;
  if (!friction.is_null()) timed.patch["contact"]["friction"] = friction;
  if (enriched) timed.patch["height"] = sine_height(mechanics::basis_named(basis).parameters());
  return timed;
}

void print_basis(std::ostream& out, const char* basis, bool enriched) {
  out << "\n" << std::left << std::setw(24) << (std::string(basis) + (enriched ? " enriched" : " plain"));
  for (const auto& friction : frictions) out << std::setw(26) << friction.first;
  out << "\n" << std::setw(24) << "";
  for (std::size_t i = 0; i < std::size(frictions); ++i) out << std::setw(26) << "one     ratio   64   ratio";
  out << std::right << "\n";
  const std::vector<Way> all = ways(static_cast<int>(mechanics::basis_named(basis).nodes.size()));
  std::vector<std::unique_ptr<TimedElements>> elements; // [way][friction], null: not possible
  std::vector<std::function<void()>> pieces;
  for (const Way& way : all)
    for (const auto& friction : frictions) {
      auto& e = elements.emplace_back();
      if (friction.second.is_null() || std::string(way.name) != "patch of one" ||
          std::string(friction.first) != "rough")
        e = std::make_unique<TimedElements>(basis, timed_of(basis, way, friction.second, enriched));
      TimedElements* here = e.get();
      pieces.push_back(here ? std::function<void()>([here] { here->evaluate_one_by_one(); }) : [] {});
      pieces.push_back(here ? std::function<void()>([here] { here->evaluate_all(); }) : [] {});
    }
  const std::vector<double> seconds = interleaved_seconds(pieces, 9, 1e-3);
  constexpr std::size_t kinds = 2, columns = kinds * std::size(frictions);
  constexpr double per[kinds] = {1e9 / TimedElements::singles, 1e9 / TimedElements::count};
  for (std::size_t w = 0; w < all.size(); ++w) {
    out << std::left << std::setw(24) << all[w].name << std::right << std::fixed;
    for (std::size_t c = 0; c < columns; ++c) {
      if (!elements[w * std::size(frictions) + c / kinds]) {
        out << std::setw(13) << "-";
        continue;
      }
      out << std::setw(7) << std::setprecision(0) << per[c % kinds] * seconds[w * columns + c] << std::setw(6)
          << std::setprecision(2) << seconds[w * columns + c] / seconds[c];
    }
    out << "\n";
  }
}

// ns of a call of 64 of which one starts so far from its projection that it needs the search; and of a call
// of 64 and one of the hard one after it, which finds the caches as it does among the 64. All calls write to
// the same arrays: where these lie takes part of the time.
void print_mixed(std::ostream& out, const char* basis) {
  Way penalty{"penalty", stiff("penalty")};
  TimedElements elements(basis, timed_of(basis, penalty, nullptr, true));
  const auto all = [&](bool hard) {
    elements.set_start(17, hard);
    elements.evaluate_all();
  };
  const auto alone = [&] {
    elements.set_start(17, true);
    elements.evaluate(17);
  };
  const auto s = interleaved_seconds({[&] { all(false); }, [&] { all(true); }, alone,
                                      [&] {
                                        all(false);
                                        alone();
                                      }});
  out << std::left << std::setw(24) << (std::string(basis) + " enriched") << std::right << std::fixed
      << std::setprecision(0) << std::setw(10) << 1e9 * s[0] << std::setw(12) << 1e9 * s[1] << std::setw(16)
      << 1e9 * s[2] << std::setw(12) << 1e9 * (s[3] - s[0]) << std::setw(12) << std::setprecision(2)
      << (s[1] - s[0]) / (s[3] - s[0]) << "\n";
}

void print_variations(std::ostream& out, const char* basis) {
  Way penalty{"penalty", stiff("penalty")};
  Timed timed = timed_of(basis, penalty, nullptr, true);
  TimedElements forces(basis, timed);
  timed.wanted = ENTS_GAP_HESSIAN;
  TimedElements hessian(basis, timed);
  timed.wanted |= ENTS_RESIDUAL | ENTS_TANGENT;
  TimedElements both(basis, timed);
  const auto s =
      interleaved_seconds({[&] { forces.evaluate_one_by_one(); }, [&] { hessian.evaluate_one_by_one(); },
                           [&] { both.evaluate_one_by_one(); }});
  constexpr double per = 1e9 / TimedElements::singles;
  out << std::left << std::setw(24) << (std::string(basis) + " enriched") << std::right << std::fixed
      << std::setprecision(0) << std::setw(10) << per * s[0] << std::setw(12) << per * s[1] << std::setw(12)
      << per * s[2] << std::setw(12) << std::setprecision(2) << s[2] / (s[0] + s[1]) << "\n";
}

} // namespace

void run_laws(std::ostream& out) {
  constexpr const char* bases[] = {"line2", "tri3", "quad4", "quad9", "bspline16"};
  out << "R + K, ns per element (thread CPU time, medians, interleaved) in calls of one and of 64, and ratio "
         "to the\n"
         "penalty element of the same basis, height and friction\n";
  for (const char* basis : bases)
    for (const bool enriched : {false, true}) print_basis(out, basis, enriched);
  out << "\nOne hard element, which needs the search, in a call of 64 (R + K, ns per call):\n"
      << std::setw(34) << "64 easy" << std::setw(12) << "one hard" << std::setw(16) << "it alone"
      << std::setw(12) << "after 64" << std::setw(12) << "added/after"
      << "\n";
  for (const char* basis : bases) print_mixed(out, basis);
  out << "\nSecond variations beside R + K, ns per element, one a call:\n"
      << std::setw(34) << "R + K" << std::setw(12) << "D2g" << std::setw(12) << "together" << std::setw(12)
      << "/ apart"
      << "\n";
  for (const char* basis : bases) print_variations(out, basis);
}

} // namespace bench
