// SPDX-License-Identifier: BSD-3-Clause
#include "check.hpp"

#include <cmath>
#include <cstdio>

namespace host {

int check_surface(const Contact& contact, const std::string& unit_of_length) {
  const ents_master_mesh mesh = contact.mesh();
  auto result = ents::make<ents_surface_admissibility>();
  ents::require(ents::linked(), ents_surface_check, contact.model().get(), &mesh, &result);
  std::printf("%lld segments, height %g to %g %s, %d samples per direction\n",
              static_cast<long long>(mesh.segments), result.height_min, result.height_max,
              unit_of_length.c_str(), result.samples);
#define HOST_CONDITION(name, index, text) {index, text},
  static constexpr struct {
    int index;
    const char* text;
  } conditions[] = {ENTS_CONDITION_TABLE(HOST_CONDITION)};
#undef HOST_CONDITION
  for (const auto& [index, text] : conditions) {
    const bool judged = (result.judged >> index & 1) != 0, violated = (result.violated >> index & 1) != 0;
    if (!judged && !std::isfinite(result.value[index])) continue;
    std::printf("%-9s %11.4g  %s", violated ? "violated" : judged ? "holds" : "", result.value[index], text);
    if (violated && result.segment[index] >= 0)
      std::printf(" (segment %lld)", static_cast<long long>(result.segment[index]));
    std::printf("\n");
  }
  return result.violated != 0 ? 1 : 0;
}

} // namespace host
