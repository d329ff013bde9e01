// SPDX-License-Identifier: BSD-3-Clause
// Smoothed master surfaces over the host's facets.
#include <algorithm>
#include <cstring>

#include "abi/entry_point.hpp"
#include "abi/guard.hpp"
#include "core/smoothing/smoothing.hpp"

namespace ents {

namespace {

// The arguments that both functions have in common.
struct Surface {
  const char *facet, *basis;
  std::int32_t ends;
  std::int64_t facets;
  const std::int64_t* connectivity;
  std::int64_t nodes;
};

std::int32_t explain(const Refusal& r, std::int64_t m, ents_report* report) {
  const long long facet = r.facet, other = r.other_facet, node = r.node, end = r.other_node;
  const auto say = [&](const char* format, auto... values) {
    return report_message(report, ENTS_BAD_VALUE, r.facet, format, values...);
  };
  switch (r.reason) {
  case Refusal::repeated_node:
    return say("facet %lld has node %lld twice", facet, node);
  case Refusal::branch:
    if (m == 2)
      return say("more than two facets meet in node %lld: %lld and %lld are two of them", node, facet, other);
    return say(
        "more than two facets meet along the edge of the nodes %lld and %lld: %lld and %lld are two of them",
        node, end, facet, other);
  case Refusal::opposed:
    if (m == 2)
      return say(
          "facets %lld and %lld, which meet in node %lld, are oriented against each other; turn one round",
          facet, other, node);
    return say("facets %lld and %lld, which meet along the edge of the nodes %lld and %lld, are oriented "
               "against each other; "
               "turn one round",
               facet, other, node, end);
  case Refusal::folded:
    return say("only two facets (one is %lld) meet in node %lld inside the surface: it has no normal there; "
               "make one facet of them",
               facet, node);
  case Refusal::touching:
    return say("parts of the surface touch in node %lld alone (one has facet %lld); give each of them a node "
               "of its own",
               node, facet);
  default:
    return say("the mesh is irregular at node %lld (of facet %lld): catmull_rom16 needs four facets in an "
               "inner node, two in one "
               "of a border, one in a corner; bspline16 takes any mesh",
               node, facet);
  }
}

std::int32_t smooth(const Surface& s, Smoothed& out, ents_report* report) {
  if (!s.facet || !s.basis)
    return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null",
                          s.facet ? "basis" : "facet");
  const auto is = [](const char* a, const char* b) { return std::strcmp(a, b) == 0; };
  const bool lines = is(s.facet, "line2") && (is(s.basis, "catmull_rom4") || is(s.basis, "bspline4"));
  const bool regular = is(s.basis, "catmull_rom16");
  const bool triangles = is(s.facet, "tri3") && is(s.basis, "bezier15");
  if (!lines && !triangles && !(is(s.facet, "quad4") && (regular || is(s.basis, "bspline16"))))
    return report_status(
        report, ENTS_BAD_VALUE, -1,
        "arguments 'facet' and 'basis': line2 has catmull_rom4 and bspline4, tri3 has bezier15, quad4 has "
        "catmull_rom16 and bspline16; write one of these pairs");
  if (s.ends != ENTS_ENDS_STRAIGHT && s.ends != ENTS_ENDS_REPEATED)
    return report_message(
        report, ENTS_BAD_VALUE, -1,
        "argument 'ends' is %d; it must be ENTS_ENDS_STRAIGHT (0) or ENTS_ENDS_REPEATED (1)", s.ends);
  if (triangles && s.ends != ENTS_ENDS_STRAIGHT)
    return report_status(report, ENTS_BAD_VALUE, -1, "argument 'ends': tri3 takes ENTS_ENDS_STRAIGHT only");
  constexpr std::int64_t most = std::int64_t{1} << 40;
  if (s.facets < 0 || s.nodes < 0 || s.facets > most || s.nodes > most)
    return report_message(report, ENTS_BAD_COUNT, -1, "facets = %lld, nodes = %lld: both must be 0 .. 2^40",
                          static_cast<long long>(s.facets), static_cast<long long>(s.nodes));
  if (s.facets > 0 && !s.connectivity)
    return report_status(report, ENTS_NULL_ARGUMENT, -1, "argument 'connectivity' is null");
  const std::int64_t m = lines ? 2 : (triangles ? 3 : 4);
  for (std::int64_t i = 0; i < s.facets * m; ++i)
    if (s.connectivity[i] < 0 || s.connectivity[i] >= s.nodes)
      return report_message(report, ENTS_BAD_VALUE, i / m,
                            "connectivity[%lld] = %lld is not a node (0 .. %lld)", static_cast<long long>(i),
                            static_cast<long long>(s.connectivity[i]), static_cast<long long>(s.nodes - 1));
  const Ends ends = s.ends == ENTS_ENDS_STRAIGHT ? Ends::straight : Ends::repeated;
  const Refusal refusal = lines       ? smooth_lines(ends, s.facets, s.connectivity, s.nodes, out)
                          : triangles ? smooth_triangles(s.facets, s.connectivity, s.nodes, out)
                                      : smooth_quads(ends, regular, s.facets, s.connectivity, s.nodes, out);
  return refusal.reason == Refusal::none ? ENTS_OK : explain(refusal, m, report);
}

} // namespace

} // namespace ents

extern "C" {

int32_t ents_smooth_size(const char* facet, const char* basis, int32_t ends, int64_t facets,
                         const int64_t* connectivity, int64_t nodes, int64_t* points, int64_t* terms,
                         ents_report* report) {
  using namespace ents;
  return entry_point(report, [&] {
    const FloatingPointGuard guard;
    if (!points || !terms)
      return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null",
                            points ? "terms" : "points");
    Smoothed surface;
    const std::int32_t status = smooth({facet, basis, ends, facets, connectivity, nodes}, surface, report);
    if (status != ENTS_OK) return status;
    *points = surface.points();
    *terms = surface.begin.back();
    return report_ok(report);
  });
}

int32_t ents_smooth(const char* facet, const char* basis, int32_t ends, int64_t facets,
                    const int64_t* connectivity, int64_t nodes, int64_t points, int64_t terms,
                    int64_t* segment_points, int64_t* begin, int64_t* point_nodes, double* weights,
                    ents_report* report) {
  using namespace ents;
  return entry_point(report, [&] {
    const FloatingPointGuard guard;
    const struct {
      const char* name;
      const void* array;
    } out[] = {{"segment_points", segment_points},
               {"begin", begin},
               {"point_nodes", point_nodes},
               {"weights", weights}};
    for (const auto& o : out)
      if (!o.array) return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null", o.name);
    Smoothed surface;
    const std::int32_t status = smooth({facet, basis, ends, facets, connectivity, nodes}, surface, report);
    if (status != ENTS_OK) return status;
    if (points != surface.points() || terms != surface.begin.back())
      return report_message(
          report, ENTS_BAD_COUNT, -1, "points = %lld, terms = %lld must be %lld, %lld (ents_smooth_size)",
          static_cast<long long>(points), static_cast<long long>(terms),
          static_cast<long long>(surface.points()), static_cast<long long>(surface.begin.back()));
    std::copy(surface.segment_points.begin(), surface.segment_points.end(), segment_points);
    std::copy(surface.begin.begin(), surface.begin.end(), begin);
    std::copy(surface.nodes.begin(), surface.nodes.end(), point_nodes);
    std::copy(surface.weights.begin(), surface.weights.end(), weights);
    return report_ok(report);
  });
}

} // extern "C"
