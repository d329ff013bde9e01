// SPDX-License-Identifier: BSD-3-Clause
// ents_suggest: a stiffness to begin with, and the time step that it allows.
#include <cmath>

#include "abi/call/guard.hpp"
#include "abi/call/handle.hpp"

namespace ents {

namespace {

constexpr double moduli_per_spacing = 30.0; // abi/README.md, "Penalty": 10 to 100

std::int32_t check(double modulus, double spacing, double area, double slave_mass, double master_mass,
                   ents_report* report) {
  const struct {
    const char* name;
    double value;
    bool positive;
  } numbers[] = {{"modulus", modulus, true},
                 {"spacing", spacing, true},
                 {"area", area, slave_mass > 0.0},
                 {"slave_mass", slave_mass, false},
                 {"master_mass", master_mass, false}};
  for (const auto& n : numbers) {
    if (!std::isfinite(n.value))
      return report_message(report, ENTS_NON_FINITE, -1, "argument '%s' is not finite", n.name);
    if (n.value < 0.0 || (n.positive && !(n.value > 0.0)))
      return report_message(report, ENTS_BAD_VALUE, -1, "%s = %g; it is %s", n.name, n.value,
                            n.positive ? "positive" : "not negative");
  }
  return ENTS_OK;
}

} // namespace

} // namespace ents

extern "C" int32_t ents_suggest(double modulus, double spacing, double area, double slave_mass,
                                double master_mass, ents_suggestion* suggestion, ents_report* report) {
  return ents::entry_point(report, [&] {
    std::int32_t status = ENTS_OK;
    ents_suggestion copy;
    const ents_suggestion* known = ents::known_struct(suggestion, copy, "suggestion", status, report);
    if (!known || (status = ents::check_reserved(known->reserved, "suggestion", report)) != ENTS_OK)
      return status;
    const ents::FloatingPointGuard guard;
    if ((status = ents::check(modulus, spacing, area, slave_mass, master_mass, report)) != ENTS_OK)
      return status;
    ents_suggestion out{};
    out.struct_size = known->struct_size;
    out.normal_stiffness = out.tangential_stiffness = ents::moduli_per_spacing * modulus / spacing;
    if (slave_mass > 0.0) {
      const double inverse = 1.0 / slave_mass + (master_mass > 0.0 ? 1.0 / master_mass : 0.0);
      out.time_step = 2.0 / std::sqrt(out.normal_stiffness * area * inverse);
    }
    if (!std::isfinite(out.normal_stiffness) || !std::isfinite(out.time_step))
      return ents::report_status(report, ENTS_OUT_OF_RANGE, -1,
                                 "modulus / spacing exceeds the range of double precision");
    ents::copy_to_caller(out, suggestion);
    return ents::report_ok(report);
  });
}
