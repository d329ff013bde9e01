// SPDX-License-Identifier: BSD-3-Clause
// ents_patches.json, which ents-deck writes: whole surfaces of the pairs of a job, and of each slave point the faces
// that its element has. README.md of adapters describes the file.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "../deck/facet_tree.hpp"

namespace ents_adapter {

inline constexpr char patch_file[] = "ents_patches.json";

struct WatchedPoint {
  std::int64_t element = 0; ///< 0: it has none
  ents_deck::Face face;     ///< of the slave, indices into WatchedPair::nodes; a node alone has no shape
  std::vector<double> weights;
  ents_deck::Point normal{}; ///< of the undeformed slave
  std::vector<int> masters;  ///< master nodes of the element, indices into WatchedPair::nodes
  std::vector<int> faces;    ///< of the patch
  ents_deck::Point under{};  ///< below it on the undeformed master
  double beside = 0;         ///< [L] how far beside the master it begins
  bool noted = false;        ///< its element has been evaluated
  bool contact = false;      ///< and carries pressure
};

struct WatchedPair {
  std::string slave, master;
  double slide = 0;                   ///< [L] that the patches are made for
  double lowest = 0;                  ///< [L] of the master's height
  std::vector<ents_deck::Face> faces; ///< of the master, indices into `nodes`
  std::vector<WatchedPoint> points;
  std::vector<std::int64_t> nodes; ///< the host's numbers
  ents_deck::Mesh undeformed, deformed;
  std::vector<char> of_master, noted;         ///< [nodes] bool; noted: the host has told where the node is
  std::unique_ptr<ents_deck::FacetTree> tree; ///< of the undeformed faces
  int most_open = 0;                          ///< points beside their patches, largest number of an increment
};

ents_deck::Point place_of(const ents_deck::Mesh& mesh, const WatchedPoint& point);

/// Edge of a face. @return [L]
double size_of(const ents_deck::Mesh& mesh, const ents_deck::Face& face);

/// @return no pairs if there is no such file
/// @throws std::exception with what is wrong in it
std::vector<WatchedPair> read_patches(const std::string& path);

} // namespace ents_adapter
