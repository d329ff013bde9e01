// SPDX-License-Identifier: BSD-3-Clause
// Simulation: everything that later increments depend on, as JSON. Numbers are written with as many digits as
// reading them back to the same bits takes.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

#include "simulation.hpp"

namespace host {
namespace {

/// JSON has no NaN; here it is a projection that is not known yet.
Json numbers_with_gaps(const std::vector<double>& values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(std::isnan(value) ? Json(nullptr) : Json(value));
  return array;
}

std::vector<double> read_numbers_with_gaps(const JsonValue& value) {
  std::vector<double> numbers;
  for (const JsonValue& item : value.items())
    numbers.push_back(item.json().is_null() ? std::numeric_limits<double>::quiet_NaN() : item.number());
  return numbers;
}

} // namespace

Json Simulation::checkpoint() const {
  Json json{{"scene", scene_->file.filename().string()},
            {"load_factor", now_.load_factor},
            {"motion", now_.motion},
            {"force", now_.force},
            {"displacement", now_.displacement},
            {"multiplier", now_.multiplier},
            {"rate", rate_}};
  if (contact_) {
    const ContactHistory history = contact_->history();
    json["contact"] = {{"segment", history.segment},
                       {"state", history.state},
                       {"xi", numbers_with_gaps(history.xi)},
                       {"pressure", history.pressure},
                       {"traction", history.traction}};
  }
  return json;
}

void Simulation::restore(const Json& checkpoint) {
  JsonObject object(JsonValue(checkpoint, "checkpoint: "));
  Configuration at;
  object.at("scene");
  at.load_factor = object.at("load_factor").number();
  at.motion = object.at("motion").number();
  at.force = object.at("force").number();
  at.displacement = object.at("displacement").numbers(now_.displacement.size());
  at.multiplier = object.at("multiplier").numbers(now_.multiplier.size());
  const std::vector<double> rate = object.at("rate").numbers();
  if (!rate.empty() && rate.size() != now_.displacement.size())
    object.at("rate").fail("the checkpoint is of another scene: so many numbers are not expected");
  if (contact_) {
    JsonObject contact(object.at("contact"));
    ContactHistory history;
    for (const JsonValue& item : contact.at("segment").items())
      history.segment.push_back(item.integer(-1, std::numeric_limits<int>::max()));
    history.state = contact.at("state").numbers();
    history.xi = read_numbers_with_gaps(contact.at("xi"));
    history.pressure = contact.at("pressure").numbers();
    history.traction = contact.at("traction").numbers();
    contact.finish();
    try {
      contact_->restore(history, at);
    } catch (const std::exception& error) {
      throw InputError("checkpoint: " + std::string(error.what()));
    }
    if (!contact_->master().rigid) build_pattern(); // that of the restored segments
  }
  object.finish();
  now_ = at;
  rate_ = rate;
  factors_fit_ = false;
}

std::string Simulation::fingerprint() const {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&](const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
  };
  const auto add_all = [&](const auto& values) { add(values.data(), values.size() * sizeof(values[0])); };
  add_all(now_.displacement);
  add_all(now_.multiplier);
  add_all(rate_);
  for (const double value : {now_.motion, now_.force, now_.load_factor}) add(&value, sizeof value);
  if (contact_) {
    const ContactHistory history = contact_->history();
    add_all(history.segment);
    add_all(history.state);
    add_all(history.pressure);
    add_all(history.traction);
  }
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

} // namespace host
