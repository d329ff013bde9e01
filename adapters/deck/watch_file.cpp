// SPDX-License-Identifier: BSD-3-Clause
// ents_patches.json: what the adapters need to notice a slave point that is beside its patch.
#include "write.hpp"

#include <set>

#include "library.hpp"

namespace ents_deck {

nlohmann::ordered_json watched(const Job& job) {
  nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
  std::set<int> used;
  const auto ids = [&](const std::vector<int>& nodes) {
    used.insert(nodes.begin(), nodes.end());
    nlohmann::ordered_json out = nlohmann::ordered_json::array();
    for (const int node : nodes) out.push_back(job.mesh.nodes[static_cast<std::size_t>(node)].id);
    return out;
  };
  const std::int64_t first = first_free_element(job);
  for (const Contact& contact : job.contacts) {
    nlohmann::ordered_json faces = nlohmann::ordered_json::array(), points = nlohmann::ordered_json::array();
    for (const Face& face : contact.master.faces)
      faces.push_back({segment_name(face.shape), ids(face.nodes)});
    std::vector<const Patch*> patch_of(contact.points.size());
    std::vector<std::int64_t> element_of(contact.points.size());
    for (std::size_t i = 0; i < contact.patches.list.size(); ++i) {
      const auto point = static_cast<std::size_t>(contact.patches.list[i].slave);
      patch_of[point] = &contact.patches.list[i];
      element_of[point] = first + static_cast<std::int64_t>(contact.first_element + i);
    }
    for (std::size_t i = 0; i < contact.points.size(); ++i) {
      const SlavePoint& point = contact.points[i];
      points.push_back({{"element", element_of[i]}, // 0: it has none
                        {"nodes", ids(point.nodes)},
                        {"weights", point.weights},
                        {"normal", point.normal},
                        {"masters", patch_of[i] ? ids(patch_of[i]->nodes) : nlohmann::ordered_json::array()},
                        {"faces", patch_of[i] ? nlohmann::ordered_json(patch_of[i]->faces)
                                              : nlohmann::ordered_json::array()}});
    }
    const Admissibility heights = admissibility_of(job.mesh, contact);
    pairs.push_back({{"slave", contact.pair.slave},
                     {"master", contact.pair.master},
                     {"slide", contact.patches.slide},
                     {"lowest", heights.lowest + contact.rise},
                     {"faces", std::move(faces)},
                     {"points", std::move(points)}});
  }
  nlohmann::ordered_json nodes = nlohmann::ordered_json::array();
  for (const int node : used) {
    const Node& at = job.mesh.nodes[static_cast<std::size_t>(node)];
    nodes.push_back({at.id, at.x[0], at.x[1], at.x[2]});
  }
  return {{"nodes", std::move(nodes)}, {"pairs", std::move(pairs)}};
}

} // namespace ents_deck
