// SPDX-License-Identifier: BSD-3-Clause
// Bezier points of one patch as combinations of the nodes around it, dense over the nodes that occur.
#pragma once

#include <cmath>

#include "core/smoothing/quasi_interpolation.hpp"

namespace ents {

class PatchWeights {
public:
  static constexpr std::size_t points = 16; // at most

  // `controls`: what stands for the nodes in the combinations; null: the nodes themselves.
  explicit PatchWeights(const FacetMesh& mesh, const QuadControls* controls = nullptr)
      : mesh_(mesh), controls_(controls), column_(static_cast<std::size_t>(mesh.nodes()), -1) {}

  void clear() {
    for (const std::int64_t node : nodes_) column_[static_cast<std::size_t>(node)] = -1;
    nodes_.clear(), weights_.clear();
  }

  void add(std::size_t point, std::int64_t node, double weight) {
    if (controls_)
      for (const Term& t : controls_->of(node)) add_node(point, t.node, weight * t.weight);
    else if (node >= mesh_.nodes())
      for (const Term& t : mesh_.laid_around()[static_cast<std::size_t>(node - mesh_.nodes())])
        add_node(point, t.node, weight * t.weight);
    else
      add_node(point, node, weight);
  }

  // change(w) of the weights w[points] of each node.
  template <class Change> void for_each_node(Change&& change) {
    for (std::size_t c = 0; c < nodes_.size(); ++c) change(&weights_[points * c]);
  }
  // Terms of value(w) over the nodes.
  template <class Value> Terms combine(Value&& value) const {
    Terms terms;
    for (std::size_t c = 0; c < nodes_.size(); ++c)
      terms.push_back({nodes_[c], value(&weights_[points * c])});
    collect(terms);
    return terms;
  }

private:
  void add_node(std::size_t point, std::int64_t node, double weight) {
    std::int64_t& column = column_[static_cast<std::size_t>(node)];
    if (column < 0) {
      column = static_cast<std::int64_t>(nodes_.size());
      nodes_.push_back(node);
      weights_.resize(weights_.size() + points, 0.0);
    }
    weights_[points * static_cast<std::size_t>(column) + point] += weight;
  }

  const FacetMesh& mesh_;
  const QuadControls* controls_;
  std::vector<std::int64_t> nodes_, column_; // column_[node]: its place in nodes_, or -1
  std::vector<double> weights_;              // [nodes][points]
};

inline double cosine(std::size_t k, std::size_t n) { // of k pi / n
  return std::cos(3.141592653589793 * static_cast<double>(k) / static_cast<double>(n));
}
inline double sine(std::size_t k, std::size_t n) {
  return std::sin(3.141592653589793 * static_cast<double>(k) / static_cast<double>(n));
}

} // namespace ents
