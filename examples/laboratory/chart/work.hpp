// SPDX-License-Identifier: BSD-3-Clause
// Work-precision diagrams: what an error costs. A problem is a scene, solved in many ways; every run gives
// one error and its price.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ents_library.hpp"
#include "run.hpp"
#include "toolbox/json_reader.hpp"

namespace host::chart {

/// The errors at which ways are compared: of pressures, and of contact areas.
inline constexpr double equal_error = 0.01, equal_error_of_area = 0.03;

/// How the surface of the master is told to the library, and where the slave side sees it.
enum class Family {
  enriched, ///< one segment with the height
  layer,    ///< the same on an elastic layer that is known at its surface only, instead of a meshed block
  sampled,  ///< the same, two sampling points per direction and slave face instead of the nodes
  facets,   ///< plain segments through points of the surface
  facets_sampled, ///< the same with sampling points
  facets_cut,     ///< the same, slave faces cut at the borders of the segments
  smoothed,       ///< Catmull-Rom segments through the same points, no height
  on_facets,      ///< the height on plain segments of a curved base
  on_smoothed,    ///< the height on Catmull-Rom segments of a curved base
};
const char* word(Family family);

/// In the order of legends and tables.
inline constexpr Family families[] = {Family::enriched, Family::layer,          Family::sampled,
                                      Family::facets,   Family::facets_sampled, Family::facets_cut,
                                      Family::smoothed, Family::on_facets,      Family::on_smoothed};

/// Way::tangent: the consistent one by automatic differentiation instead of the library's closed form.
inline constexpr const char* automatic_tangent = "automatic";

/// One way to solve a problem.
struct Way {
  Family family = Family::enriched;
  int divisions = 1;                  ///< segments of the master per direction
  std::size_t level = 0;              ///< of the slave mesh, see Problem::levels
  std::string tangent = "consistent"; ///< of the library, or automatic_tangent
  bool counted = false; ///< of a contact area: that of closed nodes or points, not the estimate between them

  bool operator==(const Way&) const = default;
};

/// A slave mesh: what changes in the scene file, by JSON pointers.
struct SlaveMesh {
  std::string name;
  std::vector<std::pair<std::string, Json>> settings;
};

/// A field at the slave points in all load steps beside what it should be.
struct Series {
  std::vector<double> value;
  std::vector<double> truth; ///< of the same size, or empty: that of the reference run
  std::vector<double> weight;
};

/// NaN of no values
double median(std::vector<double> values);

/// Relative L2 error; infinite if the sizes do not fit.
double relative_error(const Series& series, const std::vector<double>& truth);

struct Problem {
  std::string name, title, text;
  std::string quantity; ///< whose error it is
  std::string truth;    ///< what it is held against
  std::string period;   ///< "segments" of what: how a count of segments is to be read
  std::filesystem::path scene;
  std::string variant;                                ///< of the scene; empty: as it is
  std::vector<std::pair<std::string, Json>> settings; ///< changes of the scene for all runs
  std::vector<SlaveMesh> levels;                      ///< coarse to fine
  std::vector<Way> ways;
  double after = -1;          ///< steps up to this value of the control do not count
  bool forces = false;        ///< the motion is given: WorkRun::global is that of the forces
  bool exact = true;          ///< false: the truth is the last way's
  double asked = equal_error; ///< the error that the ways are held against
  /// Changes of the scene file that a way asks for, besides those of its level; may be empty.
  std::function<void(Json&, const Way&)> adapt;
  /// Exact pressure at a place of the reference surface in a step, NaN in steps where nobody knows it; empty
  /// if not `exact`.
  std::function<double(const Scene&, const StepRecord&, const std::array<double, 3>&)> pressure;
  /// Instead of it: adds what a step is compared by. The state is that of the slave nodes, to which forces of
  /// sampling points have gone.
  std::function<void(const StepRecord&, const SurfaceState& nodes, Series&)> against;
  /// Exact share of the slave surface in contact in a step, NaN where nobody knows it; empty: not compared.
  std::function<double(const Scene&, const StepRecord&)> area;
  /// The way that has all the errors of this one but the block's, or but the master's: what is between them
  /// is that share. Nothing: the way's whole error is one share. Empty: shares are not looked at.
  std::function<std::optional<Way>(const Way&)> beside;
};

/// A measured rough surface and a double sine, whose pressures and contact areas are held against boundary
/// elements: errors of block, slave mesh and master together, and apart.
std::vector<Problem> truth_problems(const EntsLibrary& library, const std::filesystem::path& scenes,
                                    bool quick);

/// The problems of the chart.
/// @param scenes  the folder `examples`
/// @param quick   a few runs of each, on the coarsest meshes
std::vector<Problem> work_problems(const std::filesystem::path& scenes, bool quick);

/// What a way needs, and what it is worth.
struct WorkRun {
  Way way;
  std::string failure; ///< of a run that could not be finished; it has no error and no price
  double error = 0;    ///< of the problem's quantity
  double global = 0; ///< of the approach (force given) or the forces (motion given) against the finest facets
                     ///< of the level; NaN: none
  std::size_t slaves = 0, segments = 0, block_dofs = 0, master_dofs = 0;
  int iterations = 0, cuts = 0;
  std::vector<double> cpu, contact_cpu, wall; ///< [s], one for each repetition

  double seconds() const;         ///< median of cpu
  double contact_seconds() const; ///< median of contact_cpu
  double noise() const; ///< of cpu, relative: twice the median distance from the median; a single run: 10 %
  std::size_t dofs() const { return block_dofs + master_dofs; }
};

struct Work {
  Problem problem;
  std::vector<WorkRun> runs; ///< in the order of problem.ways
  std::size_t following =
      0; ///< plain segments that follow the surface itself to equal_error of its amplitude; 0: not known
};

/// Solve a problem in all its ways; the runs are repeated in turns, so that a busy minute hits all of them.
/// @param repetitions  of runs that take less than 1.5 s (if more than one: two more below 0.3 s); longer
///                     ones are solved once
/// @return the quantity of the problem itself, then the contact area and the shares of the error where they
///         are known: other errors of the same runs
std::vector<Work> measure(const Problem& problem, const EntsLibrary& library, int repetitions,
                          const std::function<void(const std::string&)>& progress);

/// The scene of a way.
Scene scene_of(const Problem& problem, const Way& way);

/// The rigid master of a way; empty: the scene's own.
MasterMaker master_of(const Way& way);

/// A block under a sine surface as the text of a deck: n elements per wave, each row of elements twice as
/// high as the one above it. Sets BASE, LEFT, RIGHT (nodes) and TOP (faces).
std::string wavy_block_deck(int n, double amplitude, double wavelength, double depth);

} // namespace host::chart
