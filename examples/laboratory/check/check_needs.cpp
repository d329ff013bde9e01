// SPDX-License-Identifier: BSD-3-Clause
#include "check_needs.hpp"

namespace host {
namespace {

struct Need {
  std::int32_t bit;
  const char *key, *what, *needed, *left_out;
};

constexpr Need all_needs[] = {
    {ENTS_NEEDS_HEIGHT, "height", "a height", "not zero", "zero everywhere"},
    {ENTS_NEEDS_SLOPE, "slope", "slopes of the height", "it varies", "it is constant"},
    {ENTS_NEEDS_CURVED, "curved", "a normal that turns", "curved or warped segments", "flat segments"},
    {ENTS_NEEDS_ITERATION, "iteration", "iterations of the projection", "no closed form", "closed form"},
    {ENTS_NEEDS_MASTER, "master", "forces and stiffness of the master", "it deforms", "it is rigid"},
    {ENTS_NEEDS_FRICTION, "friction", "friction", "in the model", "none in the model"},
    {ENTS_NEEDS_HISTORY, "history", "history", "forces depend on it", "forces follow from positions alone"},
    {ENTS_NEEDS_MULTIPLIERS, "multipliers", "multipliers as unknowns", "in the law", "none in the law"},
    {ENTS_NEEDS_ONE_BY_ONE, "one_by_one", nullptr, nullptr, nullptr}, // a sentence of its own
    {ENTS_NEEDS_TEMPERATURES, "temperatures", "temperatures of the nodes", "heat in the law",
     "no heat in the law"},
    {ENTS_NEEDS_FIRST_STATE, "first_state", "bonds of the undeformed bodies", "in the law",
     "none in the law"},
};

bool has(const ents_layout& layout, const Need& need) { return (layout.needs & need.bit) != 0; }

} // namespace

std::string describe_needs(const ents_layout& layout, bool law) {
  std::string needed, left_out;
  for (const Need& need : all_needs) {
    if (need.what == nullptr) continue;
    if (need.bit == ENTS_NEEDS_SLOPE && (layout.needs & ENTS_NEEDS_HEIGHT) == 0) continue; // slopes of what?
    std::string& list = has(layout, need) ? needed : left_out;
    if (!list.empty()) list += ", ";
    list.append(need.what).append(" (").append(has(layout, need) ? need.needed : need.left_out).append(")");
  }
  const bool one_by_one = (layout.needs & ENTS_NEEDS_ONE_BY_ONE) != 0;
  std::string text = "this scene needs: ";
  text.append(needed.empty() ? "positions alone" : needed).append("\n");
  if (!left_out.empty()) text.append("it does not need: ").append(left_out).append("\n");
  if (!law)
    return text + "kernels: no contact law in the model (its key \"contact\"), so there is no element to "
                  "choose one for\n";
  text.append("kernels: ").append(layout.instruction_set);
  text.append(one_by_one ? ", elements one after the other\n" : ", several elements at once\n");
  text.append("element: ").append(std::to_string(layout.nodes)).append(" master nodes, ");
  text.append(std::to_string(layout.state_size)).append(" history variables in a host's deck\n");
  return text;
}

Json needs_json(const ents_layout& layout, bool law) {
  Json json{{"needs", Json::array()},
            {"does_not_need", Json::array()},
            {"instruction_set", law ? Json(layout.instruction_set) : Json()}};
  for (const Need& need : all_needs) json[has(layout, need) ? "needs" : "does_not_need"].push_back(need.key);
  return json;
}

} // namespace host
