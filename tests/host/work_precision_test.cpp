// SPDX-License-Identifier: BSD-3-Clause
// Work-precision diagrams: fronts, sentences and masters, each against what is known beforehand.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "chart/automatic_tangent.hpp"
#include "chart/following.hpp"
#include "chart/pareto.hpp"
#include "chart/truth_table.hpp"
#include "chart/work.hpp"
#include "chart/work_json.hpp"
#include "support.hpp"
#include "worst.hpp"

namespace host::chart::work_precision_test {
namespace {

using test::library;

/// A run as if it had been solved; the noise is twice the spread of its repetitions.
WorkRun made(Family family, int divisions, double error, double seconds, double spread = 0) {
  WorkRun run;
  run.way = {family, divisions, 0, "consistent"};
  run.error = error;
  run.cpu = {seconds * (1 - spread), seconds, seconds * (1 + spread)};
  run.contact_cpu = {0.01 * seconds};
  run.segments = static_cast<std::size_t>(divisions);
  return run;
}

Work made(std::vector<WorkRun> runs) {
  Work work;
  work.problem.levels = {{"8 slave nodes", {}}};
  work.runs = std::move(runs);
  return work;
}

TEST(WorkPrecision, FrontHasNoRunThatAnotherBeats) {
  const Work work = made({made(Family::facets, 8, 0.1, 1), made(Family::facets, 64, 0.02, 3),
                          made(Family::enriched, 1, 0.01, 2), made(Family::smoothed, 16, 0.01, 4),
                          made(Family::facets, 512, 0, 9)});
  const auto front = pareto_front(work.runs, [](const WorkRun& run) { return run.seconds(); });
  ASSERT_EQ(front.size(), 2u); // the truth itself has no error and no place
  EXPECT_EQ(front[0], &work.runs[0]);
  EXPECT_EQ(front[1], &work.runs[2]);
}

TEST(WorkPrecision, AdviceFollowsTheRuns) {
  Work work = made({made(Family::facets, 8, 0.1, 1), made(Family::facets, 64, 0.009, 3),
                    made(Family::enriched, 1, 0.009, 2)});
  const std::string before = advice(work, {0.01}).at(0);
  EXPECT_EQ(before, "For an error of 1 % take enriched, one segment, 8 slave nodes: 2.0 s; plain segments "
                    "(64), 8 slave nodes, takes 1.5 times as long.");
  std::swap(work.runs[1].cpu, work.runs[2].cpu);
  EXPECT_EQ(advice(work, {0.01}).at(0).substr(0, 39), "For an error of 1 % take plain segments");
  EXPECT_TRUE(advice(work, {0.001}).empty());                    // nothing reaches it
  ASSERT_EQ(advice(work, {0.05, 0.02, 0.01, 0.001}).size(), 1u); // one answer for all that have it
  EXPECT_EQ(advice(work, {0.05, 0.02, 0.01, 0.001}).at(0).substr(0, 32), "For an error of 5 % to 1 % take ");
}

// An elastic master has a few enriched segments: the legend must not call them one.
TEST(WorkPrecision, LegendsCountEnrichedSegments) {
  const Work one = made({made(Family::enriched, 1, 0.009, 2), made(Family::facets, 8, 0.1, 1)});
  const Work some = made({made(Family::enriched, 1, 0.009, 2), made(Family::enriched, 4, 0.01, 2)});
  EXPECT_EQ(family_name({&one}, Family::enriched), "enriched, one segment");
  EXPECT_EQ(family_name({&one, &some}, Family::enriched), "enriched, 1-4 segments");
  EXPECT_EQ(family_name({&one, &some}, Family::facets), "plain segments");
  EXPECT_EQ(family_name({&one, &some}, Family::smoothed), "");
  EXPECT_EQ(families_json({&one, &some})[0], Json({0, "enriched, 1-4 segments"}));
  EXPECT_EQ(work_json({some})[0].at("runs")[1].at("way"), "enriched, 4 segments");
}

// Times that differ by less than their repetitions do are not told apart.
TEST(WorkPrecision, NoiseIsNoAdvantage) {
  const Work loud =
      made({made(Family::facets, 64, 0.009, 2.1, 0.2), made(Family::enriched, 1, 0.009, 2, 0.2)});
  EXPECT_NE(advice(loud, {0.01}).at(0).find("the same time within the noise"), std::string::npos);
  const Work slow =
      made({made(Family::facets, 64, 0.009, 2, 0.2), made(Family::enriched, 1, 0.009, 2.1, 0.2)});
  EXPECT_EQ(equal_accuracy(slow, 0.01).faster, 0);
  const Work quiet = made({made(Family::facets, 64, 0.009, 2), made(Family::enriched, 1, 0.009, 2.4)});
  EXPECT_EQ(equal_accuracy(quiet, 0.01).faster, 1);
}

TEST(WorkPrecision, EqualAccuracyCountsWhatReachesIt) {
  const Work work = made({made(Family::facets, 8, 0.1, 1), made(Family::facets, 64, 0.009, 3),
                          made(Family::facets, 128, 0.005, 2.5), made(Family::enriched, 1, 0.009, 2)});
  const EqualAccuracy at = equal_accuracy(work, 0.01);
  EXPECT_EQ(at.fewest_facets, &work.runs[1]);
  EXPECT_EQ(at.cheapest_facets, &work.runs[2]);
  EXPECT_EQ(at.enriched, &work.runs[3]);
  EXPECT_EQ(at.fewest_smoothed, nullptr);
  const Work same = made({made(Family::enriched, 4, 0.009, 2), made(Family::enriched, 1, 0.009, 2.05)});
  EXPECT_EQ(equal_accuracy(same, 0.01).enriched, &same.runs[1]); // the time is the same: fewer segments
  EXPECT_EQ(at.reaching, 2);
}

// The table of what each method needs: each price is the least of the runs that reach the asked error; a
// method that does not reach it has the prices of its closest run.
TEST(WorkPrecision, PricesOfMethodsAreThoseOfTheRunsThatReachTheError) {
  Work work = made({made(Family::facets, 64, 0.009, 3), made(Family::facets, 128, 0.005, 2),
                    made(Family::facets, 8, 0.1, 1), made(Family::enriched, 1, 0.02, 4),
                    made(Family::enriched, 1, 0.05, 1)});
  work.runs[0].block_dofs = 70, work.runs[1].block_dofs = 60, work.runs[3].block_dofs = 50;
  const std::vector<MethodPrice> methods = method_prices(work);
  ASSERT_EQ(methods.size(), 2u);
  EXPECT_EQ(methods[0].family, Family::enriched);
  EXPECT_FALSE(methods[0].reached);
  EXPECT_EQ(methods[0].best, &work.runs[3]);
  EXPECT_EQ(methods[0].dofs, 50u);
  EXPECT_EQ(methods[0].seconds, 4);
  EXPECT_TRUE(methods[1].reached);
  EXPECT_EQ(methods[1].segments, 64u);
  EXPECT_EQ(methods[1].dofs, 60u);
  EXPECT_EQ(methods[1].seconds, 2);
  EXPECT_EQ(truth_sentence(work), "plain segments is the fastest to reach 1 %, in 2.0 s. Not reached here: "
                                  "enriched, one segment.");
  work.problem.exact = false;
  EXPECT_TRUE(method_prices(work).empty()); // held against a run of its own, which is no truth
}

TEST(WorkPrecision, PairsOfRunsAreCompared) {
  Work work = made({made(Family::facets, 8, 0.01, 1), made(Family::facets, 8, 0.04, 1),
                    made(Family::facets_cut, 8, 0.03, 6), made(Family::facets_sampled, 8, 0.02, 2),
                    made(Family::facets_sampled, 16, 0.001, 2)});
  work.runs[1].way.counted = true;
  const std::vector<std::string> lines = comparisons(work);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0],
            "The area corrected between the nodes has 0.25 times the error (median of 1 pair, smaller "
            "in 1) of the counted one.");
  EXPECT_EQ(lines[1],
            "Plain segments with cut faces have 1.5 times the error (median of 1 pair, smaller in 0) of "
            "those with sampling points on the same meshes, and take 3.0 times as long.");
}

const Problem& problem(const std::vector<Problem>& problems, const std::string& name) {
  return *std::find_if(problems.begin(), problems.end(), [&](const Problem& at) { return at.name == name; });
}

// What block, slave mesh and master add: differences of the fields of two runs, of the truth; a layer's share
// is its whole error.
TEST(WorkPrecision, SharesOfBlockAndMaster) {
  Problem at = truth_problems(library(), EXAMPLES, true).front();
  ASSERT_EQ(at.name, "wave_truth");
  std::vector<Series> fields; // of the run that warms up, then of all ways: one step each
  at.against = [&fields, against = at.against](const StepRecord& record, const SurfaceState& state,
                                               Series& to) {
    against(record, state, to);
    fields.push_back(to);
  };
  const std::vector<Work> works = measure(at, library(), 1, [](const std::string&) {});
  ASSERT_EQ(works.size(), 3u);
  ASSERT_EQ(fields.size(), 1 + at.ways.size());
  const auto index = [&](Family family, std::size_t level) {
    return static_cast<std::size_t>(
        std::find(at.ways.begin(), at.ways.end(), Way{family, family == Family::facets ? 15 : 1, level}) -
        at.ways.begin());
  };
  const auto share = [&](std::size_t way) {
    for (const WorkRun& run : works[2].runs)
      if (run.way == at.ways.at(way)) return run.error;
    ADD_FAILURE() << "no share of way " << way;
    return 0.0;
  };
  const auto apart = [&](std::size_t way, std::size_t beside) {
    const Series &a = fields.at(1 + way), &b = fields.at(1 + beside);
    double difference = 0, whole = 0;
    for (std::size_t k = 0; k < a.value.size(); ++k)
      difference += a.weight[k] * std::pow(a.value[k] - b.value[k], 2),
          whole += a.weight[k] * std::pow(a.truth[k], 2);
    return std::sqrt(difference / whole);
  };
  const std::size_t block = index(Family::enriched, 0), same = index(Family::layer, 1),
                    fine = index(Family::layer, 2), plain = index(Family::facets, 2);
  EXPECT_NEAR(share(block), apart(block, same), 1e-12);
  EXPECT_NEAR(share(plain), apart(plain, fine), 1e-12);
  EXPECT_EQ(share(same), works[0].runs.at(same).error);
  EXPECT_LT(share(fine), 0.5 * share(same)); // half the spacing
}

// Faces that are cut have other points in each step: what they give to the nodes is the step's force, up to
// the slope of the sphere (1 - cos 0.02).
TEST(WorkPrecision, PointsOfCutFacesAreThoseOfTheirStep) {
  const std::vector<Problem> problems = work_problems(EXAMPLES, true);
  Problem at = problem(problems, "hertz3d");
  at.ways = {{Family::facets_cut, 23, 0}};
  at.pressure = {}, at.area = {};
  int steps = 0;
  at.against = [&steps](const StepRecord& record, const SurfaceState& state, Series&) {
    double force = 0;
    for (std::size_t k = 0; k < state.area.size(); ++k) force += 4 * state.area[k] * state.pressure[k];
    EXPECT_NEAR(force / record.force, 1, 2e-4) << "step " << record.step;
    ++steps;
  };
  measure(at, library(), 1, [](const std::string&) {});
  EXPECT_EQ(steps, 4); // two, and two of the run that warms up
}

TEST(WorkPrecision, ErrorIsWeighted) {
  EXPECT_DOUBLE_EQ(relative_error({{1, 3}, {}, {1, 4}}, {1, 2}), std::sqrt(4 * 1. / (1 * 1 + 4 * 4)));
  EXPECT_TRUE(std::isinf(relative_error({{1}, {}, {1}}, {1, 2})));
}

// A cosine's chord is off by 1 - cos(pi / n) of the amplitude at a crest between two nodes, n in a wave; in
// 3D the product of two is off by sin^2(pi / n) beside a crest at a node.
TEST(WorkPrecision, SegmentsThatFollowASine) {
  const std::vector<Problem> problems = work_problems(EXAMPLES, true);
  const Scene line = scene_of(problem(problems, "westergaard"), {}),
              sheet = scene_of(problem(problems, "wavy3d"), {});
  for (const double share : {0.05, 0.01, 0.002}) {
    const double per_wave = std::numbers::pi / std::acos(1 - share),
                 per_wave_3d = std::numbers::pi / std::asin(std::sqrt(share));
    const auto found = static_cast<double>(segments_that_follow(library(), line, share));
    EXPECT_NEAR(found, 1.5 * per_wave, 1.5) << share;
    const double found_3d = std::sqrt(static_cast<double>(segments_that_follow(library(), sheet, share)));
    EXPECT_NEAR(found_3d, per_wave_3d, 1.5) << share;
    EXPECT_EQ(found_3d, std::round(found_3d));
  }
  Scene flat = line;
  flat.contact->model["height"] = nullptr;
  EXPECT_EQ(segments_that_follow(library(), flat, 0.01), 0u);
}

/// rho_e at xi of a segment of a master.
std::vector<double> point(const Master& master, std::size_t segment, double xi) {
  const auto m = static_cast<std::size_t>(master.model->layout().nodes);
  std::vector<double> positions, coordinates;
  for (std::size_t a = segment * m; a < (segment + 1) * m; ++a) {
    const double* node = master.positions.data() + 2 * master.connectivity[a];
    positions.insert(positions.end(), node, node + 2);
    if (!master.surface_coordinates.empty()) coordinates.push_back(master.surface_coordinates[a]);
  }
  return sample_surface(*master.model, positions, coordinates, {xi}).point;
}

// Catmull-Rom segments through equidistant points of a parabola are the parabola: height and base together
// are the one enriched segment's surface, to rounding of numbers of order 1.
TEST(WorkPrecision, SmoothedBaseCarriesTheSameSurface) {
  const std::vector<Problem> problems = work_problems(EXAMPLES, true);
  const Problem& texture = problem(problems, "texture");
  const Scene scene = scene_of(texture, {});
  const EntsModel one(library(), scene.contact->model.dump(), scene.file.parent_path(), "test");
  constexpr int n = 8;
  const Master several = master_of({Family::on_smoothed, n, 0, "consistent"})(library(), scene);
  for (std::size_t k = 0; k < n; ++k)
    for (const double xi : {-1., -0.3, 0.4, 1.}) {
      const double whole = 2 * (static_cast<double>(k) + 0.5 * (1 + xi)) / n - 1;
      const std::vector<double> expected = sample_surface(one, scene.contact->rigid, {}, {whole}).point,
                                found = point(several, k, xi);
      EXPECT_NEAR(found[0], expected[0], 1e-14);
      EXPECT_NEAR(found[1], expected[1], 1e-14);
    }
}

// Smoothed segments come closer with the third power of their length (Catmull-Rom's slopes are second order):
// 8 from one mesh to the next, 7 allowed for the terms behind.
TEST(WorkPrecision, SmoothedSegmentsAreThirdOrder) {
  const std::vector<Problem> problems = work_problems(EXAMPLES, true);
  const Scene scene = scene_of(problem(problems, "westergaard"), {});
  std::vector<double> worst;
  for (const int n : {30, 60, 120}) {
    const Master master = master_of({Family::smoothed, n, 0, "consistent"})(library(), scene);
    double largest = 0;
    for (std::size_t k = 2; k + 2 < static_cast<std::size_t>(n); ++k)
      for (const double xi : {-0.7, -0.5, 0.3, 0.7}) {
        const std::vector<double> at = point(master, k, xi);
        ::test::raise(largest, std::abs(at[1] - (0.0005 - 0.0005 * std::cos(2 * 3.141592653589793 * at[0]))));
      }
    worst.push_back(largest);
  }
  EXPECT_GT(worst[0] / worst[1], 7);
  EXPECT_GT(worst[1] / worst[2], 7);
}

// The differentiated element is the library's: slave nodes all over the scene's segment, one corner raised,
// pressed in by up to the amplitude. Coordinates and the distances that come from them are of order 1, so
// that both round the gap by some 1e-15 and the residual by that times the stiffness; a tangent is made of
// some hundred operations on numbers of its own size.
TEST(WorkPrecision, AutomaticTangentIsTheClosedOne) {
  const std::vector<Problem> problems = work_problems(EXAMPLES, true);
  const Scene scene = scene_of(problem(problems, "wavy3d"), {});
  Json text = scene.contact->model;
  text["master"] = "rigid";
  const EntsModel model(library(), text.dump(), scene.file.parent_path(), "test");
  const AutomaticTangent automatic(library(), scene);
  std::vector<double> master = scene.contact->rigid;
  master[2] += 0.1; // not flat any more: the normal turns
  std::mt19937 random(5);
  std::uniform_real_distribution<double> inside(-0.9, 0.9), depth(-0.002, 0.0);
  int touching = 0;
  for (int k = 0; k < 200; ++k) {
    const std::vector<double> start{inside(random), inside(random)};
    const SurfaceSample at = sample_surface(model, master, {}, start);
    double slave[3], area = 0.7;
    const double gap = depth(random);
    for (std::size_t c = 0; c < 3; ++c) slave[c] = at.point[c] + gap * at.normal[c];
    struct Results {
      double residual[3], tangent[9], xi[2];
      std::int32_t flags = 0;
    } results[2];
    for (const EntsLibrary* way : {&library(), &automatic.library()}) {
      Results& r = results[way == &library() ? 0 : 1];
      auto in = ents_struct<ents_input>();
      in.slave = slave, in.slave_stride = 3;
      in.master = master.data();
      in.start = start.data(), in.start_stride = 2;
      in.area = &area, in.area_stride = 1;
      auto out = ents_struct<ents_output>();
      out.wanted = ENTS_RESIDUAL | ENTS_TANGENT | ENTS_XI | ENTS_FLAGS;
      out.residual = r.residual, out.residual_stride = 3;
      out.tangent = r.tangent, out.tangent_stride = 9, out.tangent_leading_dimension = 3;
      out.xi = r.xi, out.xi_stride = 2;
      out.flags = &r.flags, out.flags_stride = 1;
      ASSERT_EQ(way->evaluate(model.get(), 0, 1, &in, &out, nullptr), ENTS_OK);
    }
    ASSERT_EQ(results[0].flags, results[1].flags);
    touching += (results[0].flags & ENTS_FLAG_CONTACT) != 0;
    const double largest = *std::max_element(results[0].tangent, results[0].tangent + 9);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(results[1].residual[i], results[0].residual[i], 4e-15 * largest);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(results[1].tangent[i], results[0].tangent[i], 1e-13 * largest);
  }
  EXPECT_GT(touching, 150);
}

// All ways of the quick chart are solved; on the same slave mesh finer plain segments are better, and none is
// better than the enriched segment they come close to.
TEST(WorkPrecision, PlainSegmentsConvergeToTheEnrichedOne) {
  for (const Problem& at : work_problems(EXAMPLES, true)) {
    const std::vector<Work> works = measure(at, library(), 1, [](const std::string&) {});
    const Work& work = works.front();
    const WorkRun *enriched = nullptr, *coarse = nullptr, *fine = nullptr, *automatic = nullptr;
    for (const WorkRun& run : work.runs) {
      EXPECT_EQ(run.failure, "") << at.name << ", " << word(run.way.family) << " " << run.way.divisions;
      if (run.way.tangent == automatic_tangent) automatic = &run;
      if (run.way.family == Family::enriched && enriched == nullptr) enriched = &run;
      if (run.way.family != Family::facets) continue;
      if (coarse == nullptr) coarse = &run;
      fine = &run;
    }
    ASSERT_TRUE(enriched != nullptr && fine != nullptr && fine != coarse) << at.name;
    EXPECT_EQ(automatic != nullptr, at.name == "wavy3d");
    if (automatic != nullptr) { // the same steps: the errors differ by what Newton's tolerance of 1e-6 leaves
      EXPECT_EQ(automatic->iterations, enriched->iterations);
      EXPECT_NEAR(automatic->error, enriched->error, 1e-6);
    }
    EXPECT_LT(fine->error, coarse->error) << at.name;
    EXPECT_LT(enriched->error, coarse->error) << at.name;
    if (at.exact) {
      EXPECT_LE(enriched->error, fine->error) << at.name;
    }
    EXPECT_EQ(works.size(), at.area ? 2u : 1u);
    for (const WorkRun& run : works.back().runs) // the area is that of the closed form
      if (at.area && run.way.family == Family::enriched) {
        EXPECT_LT(run.error, run.way.counted ? 0.15 : equal_error_of_area) << at.name;
      }
  }
}

} // namespace
} // namespace host::chart::work_precision_test
