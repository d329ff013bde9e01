// SPDX-License-Identifier: BSD-3-Clause
// *COHESIVE BEHAVIOR of an Abaqus deck with its *DAMAGE INITIATION and *DAMAGE EVOLUTION.
#pragma once

#include "contact_pair.hpp"

namespace ents_deck {

/// What bonds surfaces below a *SURFACE INTERACTION.
struct BondStatements {
  const Statement *cohesive = nullptr, *initiation = nullptr, *evolution = nullptr;
};

/// @param range    gap in which a bond forms [L]
/// @param remarks  what the user has to know is added, a sentence each
/// @return "normal" of a model's "contact"
/// @throws Error with the line of what the law does not have: damage by shear, above all
nlohmann::ordered_json cohesive_law(const Source& source, const BondStatements& of, double range,
                                    std::vector<std::string>& remarks);

} // namespace ents_deck
