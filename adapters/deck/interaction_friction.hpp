// SPDX-License-Identifier: BSD-3-Clause
// *FRICTION: coefficients that are numbers, or depend on slip rate and pressure (Abaqus).
#pragma once

#include "contact_pair.hpp"

namespace ents_deck {

/// @param stiffness  of the normal law [F/L^3]
/// @param is_tied    ccx's TIED, whose coefficient is irrelevant: it sticks
/// @param remarks    what the user has to know is added, a sentence each
/// @return "friction" of a model's "contact"; null: frictionless
/// @throws Error with the line of a coefficient, decay or table that is missing or out of range
nlohmann::ordered_json friction_law(const Mesh& mesh, const Statement& s, double stiffness, Program program,
                                    const Bodies& bodies, bool is_tied, std::vector<std::string>& remarks);

} // namespace ents_deck
