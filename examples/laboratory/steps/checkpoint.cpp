// SPDX-License-Identifier: BSD-3-Clause
// Simulation: everything that later increments depend on, as JSON. Numbers are written with as many digits as
// reading them back to the same bits takes.
#include <limits>

#include "hash.hpp"
#include "last_places.hpp"
#include "simulation.hpp"

namespace host {
namespace {

/// What decides whether a checkpoint fits: the scene without what a user may well change before the run goes
/// on, be it words, be it how it is solved. Steps are compared where they are known, see restart.cpp.
Json physics_of(const Scene& scene) {
  Json json = scene.definition;
  for (const char* key : {"title", "units", "exact", "compare", "variants", "solver"}) json.erase(key);
  if (json.contains("steps")) json["steps"].erase("values"), json["steps"].erase("duration");
  json.erase("history"); // of later steps; the present values are in the checkpoint
  if (scene.contact)
    for (const char* key : {"tangent", "penetration_limit"}) json["contact"]["model"].erase(key);
  return json;
}

/// @throws InputError naming the first thing that differs
void check_same_scene(const JsonValue& theirs, const Scene& scene) {
  const nlohmann::json there = theirs.json(),
                       here = physics_of(scene); // sorted: the order of keys does not matter
  const nlohmann::json changes = nlohmann::json::diff(there, here);
  if (changes.empty()) return;
  const auto text = [&](const nlohmann::json& json) {
    const nlohmann::json::json_pointer place(changes[0].at("path").get<std::string>());
    if (!json.contains(place)) return std::string("not");
    const std::string value = json.at(place).dump();
    return value.size() > 60 ? value.substr(0, 60) + "..." : value;
  };
  theirs.fail(
      "the checkpoint is of another scene: " + changes[0].at("path").get<std::string>() + " is " +
      text(there) + " there and " + text(here) +
      " here; later steps, solver, exact, words, and the model's tangent and penetration_limit may change");
}

} // namespace

Json Simulation::checkpoint() const {
  Json json{{"scene", physics_of(*scene_)},
            {"mesh", mesh_fingerprint()},
            {"master_segments", sizes().master_segments},
            {"load_factor", now_.load_factor},
            {"motion", now_.motion},
            {"force", now_.force},
            {"displacement", now_.displacement},
            {"multiplier", now_.multiplier},
            {"rate", rate_},
            {"factors", factors_json()}};
  if (scene_->contact && scene_->contact->body)
    json["body"] = {{"rotation", now_.rotation}, {"turned", now_.turned}};
  if (contact_) {
    const ContactHistory history = contact_->history();
    json["contact"] = {{"segment", history.at.segment},
                       {"state", history.state},
                       {"xi", history.at.xi},
                       {"pressure", history.pressure},
                       {"traction", history.traction}};
    if (!now_.parameters.empty()) json["contact"]["parameters"] = now_.parameters;
    if (!history.thickness.empty()) json["contact"]["thickness"] = history.thickness;
    if (!history.fields.empty())
      json["contact"]["fields"] = history.fields, json["contact"]["worn_master"] = history.worn_master;
    if (!history.slave_fields.empty())
      json["contact"]["slave_fields"] = history.slave_fields,
      json["contact"]["given_away"] = history.given_away;
  }
  return json;
}

void Simulation::restore(const Json& checkpoint) {
  JsonObject object(JsonValue(checkpoint, "checkpoint: "));
  Configuration at;
  check_same_scene(object.at("scene"), *scene_);
  if (object.at("mesh").string() != mesh_fingerprint())
    object.at("mesh").fail("the checkpoint is of another mesh: a deck has changed");
  if (object.at("master_segments").number() != static_cast<double>(sizes().master_segments))
    object.at("master_segments")
        .fail("the checkpoint is of another master surface, of " +
              object.at("master_segments").json().dump() + " segments, here are " +
              std::to_string(sizes().master_segments) + "; see --explicit");
  at.load_factor = object.at("load_factor").number();
  at.motion = object.at("motion").number();
  at.force = object.at("force").number();
  at.displacement = object.at("displacement").numbers(now_.displacement.size());
  at.multiplier = object.at("multiplier").numbers(now_.multiplier.size());
  const std::vector<double> rate = object.at("rate").numbers();
  if (!rate.empty() && rate.size() != now_.displacement.size())
    object.at("rate").fail("the checkpoint is of another scene: so many numbers are not expected");
  if (scene_->contact && scene_->contact->body) {
    JsonObject body(object.at("body"));
    at.rotation = body.at("rotation").numbers();
    at.turned = body.at("turned").numbers();
    const std::size_t d = static_cast<std::size_t>(mesh_.dimension), turns = d == 2 ? 1 : 3;
    if (at.turned.size() != (at.rotation.empty() ? 0 : turns) ||
        (!at.rotation.empty() && at.rotation.size() != d * d))
      object.at("body").fail(
          "the checkpoint is of another scene: a rotation of so many numbers is not expected");
    body.finish();
  }
  bool fit = false;
  const auto factorize = [&](const ContactHistory& history) {
    const std::optional<Factored> factors = read_factors(object.at("factors"), at, history);
    object.finish();
    fit = factors && factorize_again(*factors);
  };
  if (!contact_) factorize({});
  if (contact_) {
    JsonObject contact(object.at("contact"));
    ContactHistory history;
    for (const JsonValue& item : contact.at("segment").items())
      history.at.segment.push_back(item.integer(-1, std::numeric_limits<int>::max()));
    history.state = contact.at("state").numbers();
    history.at.xi = contact.at("xi").numbers();
    history.pressure = contact.at("pressure").numbers();
    history.traction = contact.at("traction").numbers();
    at.parameters = now_.parameters;
    if (!at.parameters.empty()) at.parameters = contact.at("parameters").numbers(at.parameters.size());
    if (contact.has("thickness")) history.thickness = contact.at("thickness").numbers();
    if (contact.has("fields")) {
      JsonObject fields(contact.at("fields"));
      for (const std::string& name : fields.all_keys()) history.fields[name] = fields.at(name).numbers();
      history.worn_master = contact.at("worn_master").number();
    }
    if (contact.has("slave_fields")) {
      JsonObject fields(contact.at("slave_fields"));
      for (const std::string& name : fields.all_keys())
        history.slave_fields[name] = fields.at(name).numbers();
      history.given_away = contact.at("given_away").numbers();
    }
    contact.finish();
    factorize(history);
    try {
      contact_->restore(history, at);
    } catch (const std::exception& error) {
      throw InputError("checkpoint: " + std::string(error.what()));
    }
    // That of the restored segments.
    if ((!contact_->master().rigid && !fit) || contact_->cuts_again()) build_pattern();
  }
  now_ = at;
  last_.reset();
  rate_ = rate;
  factors_fit_ = fit;
}

Json Simulation::factors_json() const {
  if (!factors_fit_) return nullptr;
  const auto& [at, contact] = *factored_;
  const ContactHistory history = contact_ ? contact_->history() : ContactHistory();
  return {{"displacement", last_places(now_.displacement, at.displacement)},
          {"multiplier", last_places(now_.multiplier, at.multiplier)},
          {"motion", at.motion},
          {"parameters", at.parameters},
          {"rotation", at.rotation},
          {"turned", at.turned},
          {"segment", contact.at.segment},
          {"xi", last_places(history.at.xi, contact.at.xi)},
          {"state", last_places(history.state, contact.state)}};
}

std::optional<Simulation::Factored> Simulation::read_factors(const JsonValue& json, const Configuration& now,
                                                             const ContactHistory& history) const {
  if (json.json().is_null()) return {};
  const auto of_another_scene = [&](const char* what) {
    json.fail("the checkpoint is of another scene: " + std::string(what) + " is not expected");
  };
  if (!keeps_factors()) of_another_scene("an object");
  JsonObject object(json);
  Factored factors{now_, contact_ ? contact_->start() : ElementStart()};
  auto& [at, contact] = factors;
  at.displacement = from_last_places(now.displacement, object.at("displacement"));
  at.multiplier = from_last_places(now.multiplier, object.at("multiplier"));
  at.motion = object.at("motion").number();
  at.parameters = object.at("parameters").numbers(now_.parameters.size());
  at.rotation = object.at("rotation").numbers();
  at.turned = object.at("turned").numbers();
  const bool turns = scene_->contact && scene_->contact->body;
  const std::size_t d = static_cast<std::size_t>(mesh_.dimension), angles = d == 2 ? 1 : 3;
  if (at.turned.size() != (at.rotation.empty() ? 0 : angles) ||
      (!at.rotation.empty() && (!turns || at.rotation.size() != d * d)))
    of_another_scene("a rotation of so many numbers");
  const std::size_t points = contact.at.segment.size();
  contact.at.segment.clear();
  for (const JsonValue& item : object.at("segment").items())
    contact.at.segment.push_back(item.integer(-1, static_cast<int>(sizes().master_segments) - 1));
  const std::size_t xi = contact.at.xi.size(), state = contact.state.size();
  contact.at.xi = from_last_places(history.at.xi, object.at("xi"));
  contact.state = from_last_places(history.state, object.at("state"));
  if (contact.at.xi.size() != xi || contact.state.size() != state)
    of_another_scene("a list of another length");
  // A deformable master's equations are those of the segments.
  if (contact.at.segment.size() != points ||
      (contact_ && !contact_->master().rigid && contact.at.segment != history.at.segment))
    of_another_scene("such a list of segments");
  object.finish();
  return factors;
}

bool Simulation::factorize_again(const Factored& where) {
  factors_fit_ = false;
  try {
    if (contact_) contact_->take(where.contact);
    if (contact_ && !contact_->master().rigid) build_pattern();
    // A scene that was changed may refuse it (penetration_limit): that run makes factors of its own.
    if (!evaluate(where.at, {}, true).ok || !solver_->factorize(system_->matrix())) return false;
  } catch (const JobError& error) { // of the contact: a state block that is not its own
    contact_->begin_increment(now_);
    throw InputError("checkpoint: /factors: " + std::string(error.what()));
  }
  factored_ = where;
  return true;
}

std::string Simulation::mesh_fingerprint() const {
  Hash hash;
  hash.add_all(mesh_.coordinates);
  for (const ElementGroup& group : mesh_.groups) hash.add_all(group.nodes);
  return hash.text();
}

std::string Simulation::fingerprint() const {
  Hash hash;
  hash.add_all(now_.displacement);
  hash.add_all(now_.multiplier);
  hash.add_all(rate_);
  hash.add_all(now_.rotation);
  for (const double value : {now_.motion, now_.force, now_.load_factor}) hash.add(&value, sizeof value);
  if (contact_) {
    const ContactHistory history = contact_->history();
    hash.add_all(history.at.segment);
    hash.add_all(history.state);
    hash.add_all(history.at.xi);
    hash.add_all(history.pressure);
    hash.add_all(history.traction);
    hash.add_all(now_.parameters);
    for (const auto* fields : {&history.fields, &history.slave_fields})
      for (const auto& [name, block] : *fields) hash.add_all(block);
  }
  return hash.text();
}

} // namespace host
