// SPDX-License-Identifier: BSD-3-Clause
// Contact: what a restart needs, and what it takes back.
#include <algorithm>

#include "contact.hpp"

namespace host {
namespace {

bool fields_fit(const std::map<std::string, std::vector<double>>& theirs,
                const std::map<std::string, std::vector<double>>& ours) {
  return theirs.size() == ours.size() &&
         std::equal(theirs.begin(), theirs.end(), ours.begin(), [](const auto& one, const auto& other) {
           return one.first == other.first && one.second.size() == other.second.size();
         });
}

} // namespace

ContactHistory Contact::history() const {
  const auto& fields = sides_.master.model->fields();
  if (cuts_again()) return {{}, {}, {}, {}, fields, worn_master(), {}, wear_.slave_fields(), {}};
  return {states_.begun, states_.begin,     accepted().pressure,  accepted().traction, fields,
          worn_master(), search_.thickness, wear_.slave_fields(), wear_.given_away};
}

void Contact::check(const ContactHistory& history) const {
  const ContactHistory own = this->history();
  const auto fits = [](const std::vector<double>& theirs, const std::vector<double>& ours) {
    return theirs.size() == ours.size();
  };
  if (history.at.segment.size() != own.at.segment.size() || !fits(history.at.xi, own.at.xi) ||
      !fits(history.state, own.state) || !fits(history.pressure, own.pressure) ||
      !fits(history.traction, own.traction) || !fits(history.thickness, own.thickness) ||
      !fields_fit(history.fields, own.fields) || !fields_fit(history.slave_fields, own.slave_fields) ||
      (!history.given_away.empty() && history.given_away.size() != sides_.points.size()))
    throw InputError("the contact's history is that of another scene: its sizes differ");
  for (const std::int64_t segment : history.at.segment)
    if (segment < -1 || segment >= stride(sides_.master.segments()))
      throw InputError("the contact's history is that of another scene: no such segment");
}

void Contact::take(const ContactHistory& history, const Configuration& begin) {
  states_.begun = history.at;
  states_.begin = history.state;
  states_.accepted.pressure = history.pressure;
  states_.accepted.traction = history.traction;
  sides_.master.model->fields() = history.fields;
  wear_.of_master = history.worn_master;
  search_.thickness = history.thickness;
  wear_.given_away = history.given_away;
  if (!history.slave_fields.empty()) wear_.take_slave_fields(history.slave_fields);
  sides_.unbind();
  wear_.read_depths(states_);
  begin_increment(begin);
}

void Contact::restore(const ContactHistory& history, const Configuration& at) {
  check(history);
  if (cuts_again()) {
    sides_.master.model->fields() = history.fields;
    wear_.take_slave_fields(history.slave_fields);
    sides_.unbind();
    cut_again(at, true);
    return;
  }
  const ContactHistory kept = this->history();
  const Configuration begin = sides_.begin;
  try {
    take(history, at);
    fields(at); // the library refuses a state block that is not its own
  } catch (...) {
    take(kept, begin);
    throw;
  }
}

} // namespace host
