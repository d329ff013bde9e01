#include "operations.hpp"

#include <cmath>

#include "counted.hpp"

namespace bench {

namespace {

using namespace ents::counted;

template <class B, bool H> ElementNodes<B, Counted> bent_segment(const ents::HeightNode& height) {
  ElementNodes<B, Counted> nodes(basis_of<B>(ents::Basis::quad9)); // the one that is counted here
  nodes.has_coordinates = false;
  nodes.height = H ? &height : nullptr;
  // natural coordinates of the nodes as a least-squares fit would find them do not matter here
  const double corner[9][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}};
  const double triangle[3][2] = {{0, 0}, {1, 0}, {0, 1}};
  for (int i = 0; i < node_count(nodes.basis); ++i) {
    const double* at = is_simplex(nodes.basis) ? triangle[i] : corner[i];
    if constexpr (B::dim == 2) {
      nodes.y[i][0] = (i == 0 ? -1.0 : 1.0) - 0.1;
      nodes.y[i][1] = 0.05 + 0.02 * i;
    } else {
      nodes.y[i][0] = at[0] - 0.2;
      nodes.y[i][1] = at[1] - 0.1;
      nodes.y[i][2] = 0.05 + 0.05 * at[0] * at[1];
    }
  }
  return nodes;
}

// One entry of the tangent
template <class Tangent> void count_entry(const Tangent& tangent, int i, int j, bool rest) {
  constexpr int D = Tangent::D;
  Counted k = 0.0;
  if (i % D == j % D) {
    if constexpr (std::extent_v<decltype(tangent.weights)> == 1)
      k = tangent.weights[0][i / D] * tangent.weights[0][j / D];
    else
      k = tangent.weights[0][i / D] * tangent.weights[1][j / D] +
          tangent.weights[1][i / D] * tangent.weights[0][j / D];
  }
  const auto row = [i](const auto& array) { return array[i]; };
  if (!rest)
    tangent.template add_products<Counted>(k, row, j);
  else
    tangent.template add_rest<Counted>(k, row, j);
}

// What is symmetric is computed once.
template <class Tangent, class... Pieces>
void count_tangent(const ents::Plan& plan, const Pieces&... pieces) {
  Tangent tangent;
  tangent.evaluate(plan, pieces...);
  if constexpr (Reduced<Tangent>) {
    for (int c = 0; c < Tangent::D; ++c)
      expand_columns(
          tangent, c, [] {}, [](int, int, const auto&) {});
  } else {
    const int dofs = Tangent::D * tangent.places();
    for (int j = 0; j < dofs; ++j) {
      for (int i = Tangent::symmetric ? j : 0; i < dofs; ++i) count_entry(tangent, i, j, false);
      if constexpr (Tangent::has_rest)
        for (int i = 0; i < dofs; ++i) count_entry(tangent, i, j, true);
    }
  }
}

template <class B, bool H> double count(bool wants_tangent, bool friction) {
  constexpr int T = B::dim - 1, N = B::dim * (B::nodes + 1);
  ents::Plan plan{};
  ents::HeightNode node{};
  node.kind = ents::HeightKind::sine;
  node.sine = {0.03, {0.5, 0.5}, 0.3};
  ents::set_normal_law(ents::law_entries[0], plan.law); // penalty
  plan.law.number[0] = 1.0;
  if (friction) {
    plan.law.friction = ents::FrictionKind::coulomb;
    plan.law.friction_coefficient = 0.3;
    plan.law.friction_stiffness = 1.0;
  }
  const ElementNodes<B, Counted> nodes = bent_segment<B, H>(node);
  Counted start[T];
  SlipBegin<Counted, T> begin{};
  for (Counted& x : start) x = is_simplex(nodes.basis) ? 0.2 : 0.1;
  ProjectedPoint<B, H, Counted> at(nodes, start);
  at.project();
  for (int a = 0; a < T; ++a) {
    start[a] = at.xi[a].v + 1e-2;
    begin.from[a] = at.xi[a].v - 1e-2;
  }

  begin.known = 1.0;

  Counted::operations = 0;
  ProjectedPoint<B, H, Counted> point(nodes, start);
  Friction<Counted, B::dim - 1> rub;
  point.area = 1.0;
  point.project();
  point.evaluate_at_solution();
  point.template evaluate_law<Power>(plan, friction);
  if (!point.ordinary || !point.contact) return std::nan("");
  Counted residual[N];
  if (friction) {
    rub.evaluate(plan.law, point.place(), begin, slip_share(begin.clearance, -point.gap),
                 -(point.area * point.per_gap * point.gap));
    friction_residual<false>(point, rub, (point.area * point.per_gap) * point.gap_vector, residual);
    if (wants_tangent) count_tangent<FrictionTangentOf<B, H, false, Counted>>(plan, point, rub);
  } else {
    frictionless_residual<false>(point, residual);
    if (wants_tangent) count_tangent<FrictionlessTangent<B, H, false, Counted>>(plan, point);
  }
  return static_cast<double>(Counted::operations);
}

template <class B> double count(bool enriched, bool tangent, bool friction) {
  return enriched ? count<B, true>(tangent, friction) : count<B, false>(tangent, friction);
}

} // namespace

double operations_of(const std::string& basis, bool enriched, bool tangent, bool friction) {
  if (basis == "line2") return count<Line2>(enriched, tangent, friction);
  if (basis == "tri3") return count<Tri3>(enriched, tangent, friction);
  if (basis == "quad4") return count<Quad4>(enriched, tangent, friction);
  if (basis == "quad9") return count<CountedBasis<3>>(enriched, tangent, friction);
  return std::nan("");
}

} // namespace bench
