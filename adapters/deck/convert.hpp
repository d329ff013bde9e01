// SPDX-License-Identifier: BSD-3-Clause
// From a deck and its contact pairs to contact elements and their models: what all host programs share.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "contact_pair.hpp"
#include "patches.hpp"

namespace ents_deck {

struct Options {
  std::filesystem::path deck, model, coordinate_file;
  std::vector<std::pair<std::string, std::string>> pairs; ///< slave, master; empty: all of the deck
  Program program = Program::calculix;
  std::optional<double> slide, stiffness;
  std::map<std::string, double> slides; ///< [L] by pair ("SLAVE, MASTER"), at least; where `slide` is absent
  std::optional<int> points; ///< per direction of a slave face; 0: its nodes. Absent: as TYPE= of the pair
  int first_model = 1;       ///< k of the first ents_k.json
  std::string coordinates;   ///< "": s = xi; "xy" ...; "cylinder x|y|z"; "file"
};

/// A file ents_k.json and the elements that have it.
struct Model {
  int number = 0;
  nlohmann::ordered_json text;
  int slave_nodes = 1, master_nodes = 0, parameters = 0, state_size = 0;

  int nodes() const { return slave_nodes + master_nodes; }
  bool symmetric = true;
};

struct ContactElement {
  SlavePoint slave;
  std::vector<int> masters;                ///< indices into Mesh::nodes
  std::vector<double> surface_coordinates; ///< [masters][parameters]; empty: those of the model, or s = xi
  int model = 0;                           ///< index into Job::models
};

/// One converted pair, with what its report and its picture need.
struct Contact {
  ContactPair pair;
  Side slave, master;
  std::vector<SlavePoint> points;
  Patches patches;
  nlohmann::ordered_json model;                      ///< without a patch, for the shape of the first face
  std::vector<std::vector<double>> face_coordinates; ///< [master.faces] of [m][parameters], or empty
  std::vector<std::string> remarks;
  bool plane_coordinates = false; ///< of each patch: friction without height
  double touch = 0;               ///< [L] a gap up to this is none
  double rise =
      0; ///< [L] added to the height of the written models, so that nodes on the master begin in contact
  std::size_t first_element = 0, element_count = 0;
};

struct Move { ///< a node that ADJUST= puts on the master surface
  int node = 0;
  Point to{};
};

struct Job {
  Mesh mesh;
  std::vector<Model> models;
  std::vector<ContactElement> elements;
  std::vector<Contact> contacts;
  std::vector<Move> moves;
  bool coordinates_in_elements = false;
};

/// @throws Error
Job convert(const Options& options);

int dimension_of(const Side& master); ///< 2 or 3

} // namespace ents_deck
