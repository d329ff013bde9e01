// SPDX-License-Identifier: BSD-3-Clause
// ents-lab check: is this enrichment admissible on this surface, what does it need, and is the slave mesh of
// a scene fine enough for it? The library judges (ents_surface_check) and decides
// (ents_model_layout), this file prints what they return.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "check_extent.hpp"
#include "check_needs.hpp"
#include "check_picture.hpp"
#include "check_scene.hpp"
#include "commands.hpp"
#include "output/table.hpp"
#include "output_folder.hpp"

namespace host {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// What a condition of the library is called here.
struct Condition {
  int index;
  const char *key, *what, *relation, *none, *remark;
  double unit = 1;
};

constexpr Condition conditions[] = {
    {ENTS_CHECK_CONTINUITY, "continuity", "continuous derivatives of h", ">=", "",
     "the tangent jumps where a derivative of h does; take a smoother height"},
    {ENTS_CHECK_FOLD, "fold", "rho_e does not fold over itself: max |h| kappa", "<", "",
     "the height exceeds the radius of curvature of rho; lower it, or refine the segments"},
    {ENTS_CHECK_EDGE, "edge", "height on the edges of segments: max |h|", "<=", "",
     "a local height (s = xi) has to vanish there, or the surface jumps from segment to segment; or give "
     "surface coordinates"},
    {ENTS_CHECK_JUMP, "jump", "neighbours meet: largest jump of rho_e at an edge", "<=", "",
     "rho_e = rho + h n jumps with n where h is not zero on the edge; smooth the surface, or let h vanish"},
    {ENTS_CHECK_KINK, "kink", "no kink: largest angle of n_e at an edge [degrees]", "<=", "",
     "the force jumps by this angle where a slave node slides over the edge; smooth the surface", degrees},
    {ENTS_CHECK_WEDGE, "wedge", "room between neighbours: smallest free angle at an edge [degrees]", ">", "",
     "the enriched surfaces of two segments overlap beside their concave edge; lower the slope of h there",
     degrees},
    {ENTS_CHECK_PROJECTION, "projection", "one normal projection: least |gap| of a slave with two",
     ">=", "flat", "slave nodes this far away have two projections; lower h or its curvature, or the reach"},
    {ENTS_CHECK_SHADOW, "shadow", "no self-shadow: min n_e . e", ">", "",
     "rays from the emitter meet the back of the surface; turn the rays, or lower the slopes of h"},
    {ENTS_CHECK_OCCLUSION, "occlusion", "all of it is lit: longest ray to a part in its light", "<=", "",
     "another part of the surface stands between this place and the light; a slave node here is projected on "
     "that one"},
    {ENTS_CHECK_CROSSING, "crossing", "segments do not cross: deepest place behind another", "<=", "",
     "enriched segments intersect; lower h, or smooth the surface"},
};

class Answer {
public:
  Answer(const EntsModel& model, const MasterSurface& surface, const CheckOptions& options)
      : result_(ents_struct<ents_surface_admissibility>()), violations_(surface.segments()), d_(surface.d) {
    result_.samples = options.samples;
    result_.reach = options.reach;
    result_.kink = options.kink / degrees;
    result_.violations = violations_.data();
    const ents_master_mesh mesh = surface.mesh();
    auto report = ents_struct<ents_report>();
    const std::int32_t status = model.library().surface_check(model.get(), &mesh, &result_, &report);
    if (status < 0) throw InputError(describe(model.library(), status, report));
    if (status > 0) throw JobError(describe(model.library(), status, report));
  }

  /// Of friction's exact tangent, which has third derivatives of h.
  bool tangent_jumps() const { return result_.value[ENTS_CHECK_CONTINUITY] < 3; }
  bool admissible() const { return result_.violated == 0; }
  bool judged(const Condition& c) const { return ((result_.judged >> c.index) & 1) != 0; }
  bool violated(const Condition& c) const { return ((result_.violated >> c.index) & 1) != 0; }
  /// Is there anything to say? Not of neighbours where a segment is alone, nor of rays where there are none.
  bool known(const Condition& c) const {
    const bool shadow = c.index == ENTS_CHECK_SHADOW || c.index == ENTS_CHECK_OCCLUSION;
    const bool always = c.index == ENTS_CHECK_CONTINUITY || c.index == ENTS_CHECK_CROSSING;
    if (shadow) return judged(c);
    return always || result_.segment[c.index] >= 0;
  }
  double value(const Condition& c) const { return result_.value[c.index] * c.unit; }
  double bound(const Condition& c) const { return result_.bound[c.index] * c.unit; }
  double missing(const Condition& c) const { return result_.missing[c.index] * c.unit; }
  const std::vector<std::int64_t>& violations() const { return violations_; }

  std::string value_text(const Condition& c) const {
    if (c.index == ENTS_CHECK_CONTINUITY) return derivatives(value(c));
    return std::isinf(value(c)) && *c.none != 0 ? c.none : format_number(value(c), 4);
  }
  std::string bound_text(const Condition& c) const {
    if (!judged(c)) return "";
    const std::string number =
        c.index == ENTS_CHECK_CONTINUITY ? derivatives(bound(c)) : format_number(bound(c), 3);
    return std::string(c.relation) + " " + number;
  }
  std::string place(const Condition& c) const {
    if (result_.segment[c.index] < 0) return c.index == ENTS_CHECK_CONTINUITY ? "everywhere" : "";
    std::string text = "segment " + std::to_string(result_.segment[c.index]) + xi(result_.xi[c.index]);
    if (result_.other[c.index] >= 0)
      text += "; segment " + std::to_string(result_.other[c.index]) + xi(result_.other_xi[c.index]);
    return text;
  }
  std::vector<pictures::Place> offences() const {
    std::vector<pictures::Place> places;
    for (const Condition& c : conditions) {
      if (!violated(c) || result_.segment[c.index] < 0) continue;
      const double* x = result_.point[c.index];
      places.push_back(
          {x[0], x[1], x[2], std::string(c.what) + " is " + value_text(c) + ", bound " + bound_text(c)});
    }
    return places;
  }
  Json json(const Condition& c) const {
    const auto coordinates = [&](const double* x, std::size_t size) {
      return std::vector<double>(x, x + size);
    };
    Json entry{{"name", c.key},
               {"condition", c.what},
               {"judged", judged(c)},
               {"violated", violated(c)},
               {"value", std::isfinite(value(c)) ? Json(value(c)) : Json(nullptr)}};
    if (judged(c)) entry["bound"] = bound(c);
    if (violated(c)) entry["missing"] = std::isfinite(missing(c)) ? Json(missing(c)) : Json(nullptr);
    if (result_.segment[c.index] >= 0) {
      entry["segment"] = result_.segment[c.index];
      entry["xi"] = coordinates(result_.xi[c.index], d_ - 1);
      entry["point"] = coordinates(result_.point[c.index], d_);
    }
    if (result_.other[c.index] >= 0) {
      entry["other"] = result_.other[c.index];
      entry["other_xi"] = coordinates(result_.other_xi[c.index], d_ - 1);
    }
    if (violated(c)) entry["remark"] = c.remark;
    return entry;
  }

private:
  static std::string derivatives(double count) {
    return count >= 1000 ? "all" : std::to_string(static_cast<int>(count));
  }
  std::string xi(const double* x) const {
    return ", xi = " + format_number(x[0], 4) + (d_ == 3 ? ", " + format_number(x[1], 4) : "");
  }

  ents_surface_admissibility result_;
  std::vector<std::int64_t> violations_;
  std::size_t d_;
};

void print(const Answer& answer, std::size_t segments, bool friction) {
  Table table;
  table.column("condition").column("worst").column("bound").column("").column("missing").column("where");
  for (const Condition& c : conditions) {
    if (!answer.known(c)) continue;
    table.row({c.what, answer.value_text(c), answer.bound_text(c),
               !answer.judged(c)    ? ""
               : answer.violated(c) ? "FAILS"
                                    : "ok",
               answer.violated(c) ? format_number(answer.missing(c), 3) : "", answer.place(c)});
  }
  std::printf("%s", table.text().c_str());
  for (const Condition& c : conditions)
    if (answer.violated(c))
      std::printf("not admissible: %s is %s (bound %s) at %s: %s\n", c.what, answer.value_text(c).c_str(),
                  answer.bound_text(c).c_str(), answer.place(c).c_str(), c.remark);
  if (friction && answer.tangent_jumps())
    std::printf("note: the third derivatives of h jump between the cells of a map or thread, and with them "
                "the exact tangent of friction: "
                "Newton's iteration does not suffer (examples/laboratory/README.md)\n");
  std::size_t failing = 0;
  for (const std::int64_t bits : answer.violations()) failing += bits != 0;
  if (answer.admissible())
    std::printf("admissible on %zu %s\n", segments, segments == 1 ? "segment" : "segments");
  else if (segments > 1)
    std::printf("%zu of %zu segments fail\n", failing, segments);
}

} // namespace

int check_command(const CommonOptions& common, const CheckOptions& options) {
  const EntsLibrary library(common.library);
  const CheckSubject subject = read_subject(library, options);
  const EntsModel& model = *subject.model;
  const MasterSurface& surface = subject.surface;
  const OutputFolder folder(options.out);
  const Answer answer(model, surface, options);
  const SurfaceExtent extent = extent_of(model, subject.text, subject.folder, surface);
  const bool law = subject.text.contains("contact");
  if (common.json) {
    Json result{{"model", options.model.string()},
                {"segments", surface.segments()},
                {"admissible", answer.admissible()},
                {"conditions", Json::array()},
                {"failing_segments", Json::array()}};
    result.update(needs_json(model.layout(), law));
    result.update(extent_json(extent));
    result["resolution"] = json_of(subject.resolution);
    for (const Condition& c : conditions)
      if (answer.known(c)) result["conditions"].push_back(answer.json(c));
    for (std::size_t s = 0; s < surface.segments(); ++s)
      if (answer.violations()[s] != 0) result["failing_segments"].push_back(s);
    std::printf("%s\n", result.dump(2).c_str());
  } else {
    std::printf("%s%s", describe_needs(model.layout(), law).c_str(), describe(extent).c_str());
    if (const std::string text = describe(subject.resolution, subject.length_unit); !text.empty())
      std::printf("%s%s\n", subject.resolution.too_coarse() ? "warning: " : "", text.c_str());
    print(answer, surface.segments(), (model.layout().needs & ENTS_NEEDS_FRICTION) != 0);
  }
  if (!options.out.empty()) {
    const bool triangles = is_triangle(subject.text.at("segment").get<std::string>());
    const std::string problem =
        draw_check(model, surface, answer.violations(), answer.offences(), triangles, options.out);
    if (!problem.empty()) std::fprintf(stderr, "%s\n", problem.c_str());
  }
  return answer.admissible() ? 0 : 1;
}

} // namespace host
