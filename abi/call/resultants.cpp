// SPDX-License-Identifier: BSD-3-Clause
// ents_contact_resultants: sums over the slave points of a pair.
#include <cmath>

#include "abi/call/guard.hpp"
#include "abi/call/handle.hpp"

namespace ents {

namespace {

struct PointResults {
  const double *points, *normal, *pressure, *traction, *areas;
  const std::int32_t* flags;
};

std::int32_t check(std::int32_t d, std::int64_t count, const PointResults& of, const double* about,
                   ents_report* report) {
  if (d != 2 && d != 3) return report_message(report, ENTS_BAD_VALUE, -1, "dimension is %d; it is 2 or 3", d);
  if (count < 0 || count > std::int64_t{1} << 50)
    return report_message(report, ENTS_BAD_COUNT, -1, "count = %lld must be 0 .. 2^50",
                          static_cast<long long>(count));
  const struct {
    const char* name;
    const void* array;
  } needed[] = {{"points", of.points},
                {"normal", of.normal},
                {"pressure", of.pressure},
                {"areas", of.areas},
                {"flags", of.flags}};
  for (const auto& a : needed)
    if (!a.array && count > 0)
      return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null", a.name);
  if (about && first_non_finite(about, d) >= 0)
    return report_status(report, ENTS_NON_FINITE, -1, "argument 'about' is not finite");
  for (std::int64_t i = 0; i < count; ++i) {
    const bool presses = of.pressure[i] != 0.0; // NaN, too
    const struct {
      const char* name;
      const double* numbers;
      std::int64_t size;
    } arrays[] = {{"pressure", of.pressure + i, 1},
                  {"areas", of.areas + i, 1},
                  {"points", presses ? of.points + i * d : nullptr, d},
                  {"normal", presses ? of.normal + i * d : nullptr, d},
                  {"traction", of.traction ? of.traction + i * d : nullptr, d}};
    for (const auto& a : arrays)
      if (a.numbers && first_non_finite(a.numbers, a.size) >= 0)
        return report_message(report, ENTS_NON_FINITE, i, "%s of point %lld is NaN or infinite", a.name,
                              static_cast<long long>(i));
  }
  return ENTS_OK;
}

void add_moment(std::int32_t d, const double (&arm)[3], const double (&force)[3], double (&moment)[3]) {
  const double turn = arm[0] * force[1] - arm[1] * force[0];
  if (d == 2) {
    moment[0] += turn;
    return;
  }
  moment[0] += arm[1] * force[2] - arm[2] * force[1];
  moment[1] += arm[2] * force[0] - arm[0] * force[2];
  moment[2] += turn;
}

void add_up(std::int32_t d, std::int64_t count, const PointResults& of, const double* about,
            ents_resultants& sum) {
  double pressing = 0.0;
  sum.deepest = -1;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int32_t flags = of.flags[i];
    const bool contact = (flags & ENTS_FLAG_CONTACT) != 0;
    ++(contact ? sum.contact : sum.open);
    sum.stick += (flags & ENTS_FLAG_STICK) != 0;
    sum.slip += (flags & ENTS_FLAG_SLIP) != 0;
    if (contact) sum.area += of.areas[i];
    const double p = of.pressure[i], push = p * of.areas[i];
    if (p > sum.largest_pressure) sum.largest_pressure = p, sum.deepest = i;
    double arm[3] = {}, force[3] = {};
    for (std::int32_t k = 0; k < d; ++k) {
      const double normal = p != 0.0 ? push * of.normal[i * d + k] : 0.0;
      const double tangential = of.traction ? -of.areas[i] * of.traction[i * d + k] : 0.0;
      sum.normal[k] += normal;
      sum.tangential[k] += tangential;
      force[k] = normal + tangential;
      if (force[k] == 0.0 && p == 0.0) continue; // its place may be anywhere
      arm[k] = of.points[i * d + k] - (about ? about[k] : 0.0);
      sum.centre[k] += push * arm[k];
    }
    add_moment(d, arm, force, sum.moment);
    pressing += push;
  }
  for (std::int32_t k = 0; k < d; ++k)
    sum.centre[k] = (about ? about[k] : 0.0) + (pressing > 0.0 ? sum.centre[k] / pressing : 0.0);
}

} // namespace

} // namespace ents

extern "C" int32_t ents_contact_resultants(int32_t dimension, int64_t count, const double* points,
                                           const double* normal, const double* pressure,
                                           const double* traction, const double* areas, const int32_t* flags,
                                           const double* about, ents_resultants* resultants,
                                           ents_report* report) {
  return ents::entry_point(report, [&] {
    std::int32_t status = ENTS_OK;
    ents_resultants copy;
    const ents_resultants* known = ents::known_struct(resultants, copy, "resultants", status, report);
    if (!known || (status = ents::check_reserved(known->reserved, "resultants", report)) != ENTS_OK)
      return status;
    const ents::FloatingPointGuard guard;
    const ents::PointResults of = {points, normal, pressure, traction, areas, flags};
    if ((status = ents::check(dimension, count, of, about, report)) != ENTS_OK) return status;
    ents_resultants sum{};
    sum.struct_size = known->struct_size;
    ents::add_up(dimension, count, of, about, sum);
    ents::copy_to_caller(sum, resultants);
    return ents::report_ok(report);
  });
}
