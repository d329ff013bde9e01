// SPDX-License-Identifier: BSD-3-Clause
// *GAP CONDUCTANCE and *GAP HEAT GENERATION of a deck.
#pragma once

#include "contact_pair.hpp"

namespace ents_deck {

/// @param statements  those of the pair's interaction, with checked keywords
/// @param remarks     what the user has to know of them is added, a sentence each
/// @return "heat" of a model's "contact"; null: there is none
/// @throws Error with the line of a table that no contact element has
nlohmann::ordered_json heat_law(const Source& source, const std::vector<const Statement*>& statements,
                                Program program, bool has_friction, std::vector<std::string>& remarks);

} // namespace ents_deck
