// SPDX-License-Identifier: BSD-3-Clause
// Smoothed master surfaces over the host's facets.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "abi/call/entry_point.hpp"
#include "abi/call/guard.hpp"
#include "abi/call/handle.hpp"
#include "core/smoothing/mirrored_facets.hpp"
#include "core/smoothing/quasi_interpolation.hpp"

namespace ents {

namespace {

// The arguments that both functions have in common.
struct Surface {
  const char *facet, *basis;
  std::int32_t ends;
  std::int64_t facets;
  const std::int64_t* connectivity;
  std::int64_t nodes;
  const ents_mirror* mirror; // null: none
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

std::int32_t read_planes(const ents_mirror& mirror, int dimension, std::int64_t nodes,
                         std::vector<MirrorPlane>& planes, ents_report* report) {
  if (mirror.planes < 0 || mirror.planes > 6)
    return report_message(report, ENTS_BAD_COUNT, -1, "mirror.planes = %d must be 0 .. 6", mirror.planes);
  if (mirror.planes == 0) return ENTS_OK;
  if (!mirror.axes || !mirror.places || !mirror.positions)
    return report_message(report, ENTS_NULL_ARGUMENT, -1, "mirror.%s is null",
                          !mirror.axes ? "axes" : (!mirror.places ? "places" : "positions"));
  for (std::int32_t i = 0; i < mirror.planes; ++i) {
    if (mirror.axes[i] < 0 || mirror.axes[i] >= dimension)
      return report_message(report, ENTS_BAD_VALUE, -1, "mirror.axes[%d] is %d; it must be 0 .. %d", i,
                            mirror.axes[i], dimension - 1);
    if (!std::isfinite(mirror.places[i]))
      return report_message(report, ENTS_NON_FINITE, -1, "mirror.places[%d] is NaN or infinite", i);
    planes.push_back({mirror.axes[i], mirror.places[i]});
  }
  if (const std::int64_t bad = first_non_finite(mirror.positions, nodes * dimension); bad >= 0)
    return report_message(report, ENTS_NON_FINITE, -1, "mirror.positions of node %lld is NaN or infinite",
                          static_cast<long long>(bad / dimension));
  return ENTS_OK;
}

// With the images in planes of symmetry, if there are any.
std::int32_t smooth_facets(const Surface& s, int corners, Ends ends, bool regular, Smoothed& out,
                           ents_report* report) {
  const auto call = [&](std::int64_t facets, const std::int64_t* connectivity, std::int64_t nodes) {
    return corners == 2   ? smooth_lines(ends, facets, connectivity, nodes, out)
           : corners == 3 ? smooth_triangles(facets, connectivity, nodes, out)
                          : smooth_quads(ends, regular, facets, connectivity, nodes, out);
  };
  std::vector<MirrorPlane> planes;
  const int dimension = corners == 2 ? 2 : 3;
  if (s.mirror)
    if (const std::int32_t status = read_planes(*s.mirror, dimension, s.nodes, planes, report);
        status != ENTS_OK)
      return status;
  if (planes.empty()) {
    const Refusal refusal = call(s.facets, s.connectivity, s.nodes);
    return refusal.reason == Refusal::none ? ENTS_OK : explain(refusal, corners, report);
  }
  MirroredFacets all(corners, dimension, s.facets, s.connectivity, s.nodes, s.mirror->positions);
  std::size_t bad = 0;
  if (const auto outcome = all.add(planes, bad); outcome != MirroredFacets::Outcome::done)
    return report_message(
        report, ENTS_BAD_VALUE, -1,
        "mirror: the facets %s plane %lld (%c = %.9g); a plane of symmetry is one of their borders",
        outcome == MirroredFacets::Outcome::no_node ? "have no node on" : "lie on both sides of",
        static_cast<long long>(bad), "xyz"[planes[bad].axis], planes[bad].place);
  Refusal refusal = call(all.all_facets(), all.connectivity(), all.all_nodes());
  if (refusal.reason != Refusal::none) {
    for (std::int64_t* facet : {&refusal.facet, &refusal.other_facet})
      if (*facet >= 0) *facet %= s.facets;
    for (std::int64_t* node : {&refusal.node, &refusal.other_node})
      if (*node >= 0) *node = all.origin(*node);
    return explain(refusal, corners, report);
  }
  all.fold(out);
  return ENTS_OK;
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
  constexpr Ends all_ends[] = {Ends::straight, Ends::repeated, Ends::quasi_cubic, Ends::quasi_parabolic};
  static_assert(ENTS_ENDS_STRAIGHT == 0 && ENTS_ENDS_REPEATED == 1 && ENTS_ENDS_QUASI_CUBIC == 2 &&
                ENTS_ENDS_QUASI_PARABOLIC == 3);
  if (s.ends < 0 || s.ends > ENTS_ENDS_QUASI_PARABOLIC)
    return report_message(report, ENTS_BAD_VALUE, -1,
                          "argument 'ends' is %d; it must be ENTS_ENDS_STRAIGHT (0), ENTS_ENDS_REPEATED (1), "
                          "ENTS_ENDS_QUASI_CUBIC (2) or ENTS_ENDS_QUASI_PARABOLIC (3)",
                          s.ends);
  if (triangles && s.ends != ENTS_ENDS_STRAIGHT)
    return report_status(report, ENTS_BAD_VALUE, -1, "argument 'ends': tri3 takes ENTS_ENDS_STRAIGHT only");
  const Ends ends = all_ends[s.ends];
  if (is_quasi(ends) && std::strncmp(s.basis, "bspline", 7) != 0)
    return report_message(
        report, ENTS_BAD_VALUE, -1,
        "argument 'ends': quasi-interpolation is for bspline4 and bspline16; %s passes through "
        "the nodes, write ENTS_ENDS_STRAIGHT",
        s.basis);
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
  return smooth_facets(s, static_cast<int>(m), ends, regular, out, report);
}

std::int32_t smooth_size(const Surface& s, std::int64_t* points, std::int64_t* terms, ents_report* report) {
  if (!points || !terms)
    return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null",
                          points ? "terms" : "points");
  Smoothed surface;
  const std::int32_t status = smooth(s, surface, report);
  if (status != ENTS_OK) return status;
  *points = surface.points();
  *terms = surface.begin.back();
  return report_ok(report);
}

struct Output {
  std::int64_t *segment_points, *begin, *point_nodes;
  double* weights;
  std::int32_t* reflected; // null, as shifts: not asked for
  double* shifts;
};

std::int32_t smooth_into(const Surface& s, std::int64_t points, std::int64_t terms, const Output& out,
                         ents_report* report) {
  const struct {
    const char* name;
    const void* array;
  } arrays[] = {{"segment_points", out.segment_points},
                {"begin", out.begin},
                {"point_nodes", out.point_nodes},
                {"weights", out.weights}};
  for (const auto& o : arrays)
    if (!o.array) return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null", o.name);
  Smoothed surface;
  const std::int32_t status = smooth(s, surface, report);
  if (status != ENTS_OK) return status;
  if (points != surface.points() || terms != surface.begin.back())
    return report_message(report, ENTS_BAD_COUNT, -1, "points = %lld, terms = %lld must be %lld, %lld (%s)",
                          static_cast<long long>(points), static_cast<long long>(terms),
                          static_cast<long long>(surface.points()),
                          static_cast<long long>(surface.begin.back()),
                          s.mirror ? "ents_smooth_mirrored_size" : "ents_smooth_size");
  std::copy(surface.segment_points.begin(), surface.segment_points.end(), out.segment_points);
  std::copy(surface.begin.begin(), surface.begin.end(), out.begin);
  std::copy(surface.nodes.begin(), surface.nodes.end(), out.point_nodes);
  std::copy(surface.weights.begin(), surface.weights.end(), out.weights);
  if (!out.reflected) return report_ok(report);
  const std::size_t dimension = std::strcmp(s.facet, "line2") == 0 ? 2 : 3;
  surface.reflected.resize(surface.nodes.size(), 0); // without planes there are none
  surface.shifts.resize(dimension * static_cast<std::size_t>(surface.points()), 0.0);
  std::copy(surface.reflected.begin(), surface.reflected.end(), out.reflected);
  std::copy(surface.shifts.begin(), surface.shifts.end(), out.shifts);
  return report_ok(report);
}

} // namespace

} // namespace ents

extern "C" {

int32_t ents_smooth_mirrored_size(const char* facet, const char* basis, int32_t ends, int64_t facets,
                                  const int64_t* connectivity, int64_t nodes, const ents_mirror* mirror,
                                  int64_t* points, int64_t* terms, ents_report* report) {
  using namespace ents;
  return entry_point(report, [&] {
    const FloatingPointGuard guard;
    ents_mirror copy;
    std::int32_t status = ENTS_OK;
    const ents_mirror* known = known_struct(mirror, copy, "mirror", status, report);
    if (!known) return status;
    return smooth_size({facet, basis, ends, facets, connectivity, nodes, known}, points, terms, report);
  });
}

int32_t ents_smooth_mirrored(const char* facet, const char* basis, int32_t ends, int64_t facets,
                             const int64_t* connectivity, int64_t nodes, const ents_mirror* mirror,
                             int64_t points, int64_t terms, int64_t* segment_points, int64_t* begin,
                             int64_t* point_nodes, double* weights, int32_t* reflected, double* shifts,
                             ents_report* report) {
  using namespace ents;
  return entry_point(report, [&] {
    const FloatingPointGuard guard;
    ents_mirror copy;
    std::int32_t status = ENTS_OK;
    const ents_mirror* known = known_struct(mirror, copy, "mirror", status, report);
    if (!known) return status;
    if (!reflected || !shifts)
      return report_message(report, ENTS_NULL_ARGUMENT, -1, "argument '%s' is null",
                            reflected ? "shifts" : "reflected");
    return smooth_into({facet, basis, ends, facets, connectivity, nodes, known}, points, terms,
                       {segment_points, begin, point_nodes, weights, reflected, shifts}, report);
  });
}

int32_t ents_smooth_size(const char* facet, const char* basis, int32_t ends, int64_t facets,
                         const int64_t* connectivity, int64_t nodes, int64_t* points, int64_t* terms,
                         ents_report* report) {
  using namespace ents;
  return entry_point(report, [&] {
    const FloatingPointGuard guard;
    return smooth_size({facet, basis, ends, facets, connectivity, nodes, nullptr}, points, terms, report);
  });
}

int32_t ents_smooth(const char* facet, const char* basis, int32_t ends, int64_t facets,
                    const int64_t* connectivity, int64_t nodes, int64_t points, int64_t terms,
                    int64_t* segment_points, int64_t* begin, int64_t* point_nodes, double* weights,
                    ents_report* report) {
  using namespace ents;
  return entry_point(report, [&] {
    const FloatingPointGuard guard;
    return smooth_into({facet, basis, ends, facets, connectivity, nodes, nullptr}, points, terms,
                       {segment_points, begin, point_nodes, weights, nullptr, nullptr}, report);
  });
}

} // extern "C"
