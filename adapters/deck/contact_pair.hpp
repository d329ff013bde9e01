// SPDX-License-Identifier: BSD-3-Clause
// What a deck says about its contact: pairs, laws, steps; and what of it cannot be done with user elements.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "faces.hpp"
#include "keywords.hpp"
#include "mesh.hpp"

namespace ents_deck {

struct ContactPair {
  std::string slave, master, interaction;
  const Statement* statement = nullptr; ///< *CONTACT PAIR; null: named on the command line alone
  Place line;                           ///< its data line
  std::optional<double> adjust;         ///< [L] ADJUST=
};

/// All of *CONTACT PAIR, in the order of the deck, as they are written.
std::vector<ContactPair> contact_pairs(const Mesh& mesh);

/// The statement of a pair that becomes elements.
/// @return what the user has to know of its parameters, a sentence each
/// @throws Error with the line of what contact elements cannot do
std::vector<std::string> check_pair(const Mesh& mesh, const ContactPair& pair, Program program);

/// What a law needs to know where the deck leaves a number to the program.
struct Bodies {
  double first_constant =
      0; ///< of the first material, whatever its law: what ccx's defaults take; 0: there is none
  bool first_is_young = true;
  double largest_young = 0;
  double face_size = 0; ///< mean size of the master's faces, [L]
};
Bodies bodies_of(const Mesh& mesh);

struct Law {
  nlohmann::ordered_json contact;   ///< key "contact" of a model
  std::vector<std::string> remarks; ///< what was chosen, a sentence each
  double clearance = 0;             ///< [L] gap at which the pressure begins
};

/// *SURFACE BEHAVIOR and *FRICTION of the pair's interaction.
/// @param stiffness  [F/L^3] instead of the deck's or of the proposal
/// @throws Error with the line for TIED and for tables and behaviours that no law fits
Law law_of(const Mesh& mesh, const ContactPair& pair, const Bodies& bodies, Program program,
           std::optional<double> stiffness);

struct Motion {
  Point
      range{}; ///< [L] of prescribed displacements over all steps, per direction, with the largest values of
               ///< their amplitudes: what one body may slide over the other
  double any_direction =
      0; ///< [L] more, of directions that are not the axes': *TRANSFORM, rigid bodies that turn
  bool rotates = false;             ///< other rotations are prescribed, too: they are not counted
  std::vector<std::string> remarks; ///< of motions that the deck does not tell, a sentence each
};
Motion prescribed_motion(const Mesh& mesh);

/// Refuses *MODEL CHANGE of elements whose faces are in contact: contact elements would act on what is removed.
/// @throws Error
void check_elements_stay(const Mesh& mesh, const Side& side);

} // namespace ents_deck
