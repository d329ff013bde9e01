// SPDX-License-Identifier: BSD-3-Clause
// The commands of ents-lab. Each returns its exit code: 0 done, 1 the job failed; wrong input is thrown
// as InputError and becomes 2.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace host {

class EntsLibrary;
struct Scene;

struct CommonOptions {
  std::filesystem::path library; ///< of libents.so; empty: next to the program, else the system's
  bool json = false;             ///< result as JSON on stdout, and nothing else there
};

struct RunOptions {
  std::filesystem::path scene, out;   ///< out empty: no files
  int explicit_divisions = 0;         ///< > 0: the master as an explicit mesh of plain segments
  bool compare = false;               ///< the scene against explicit meshes
  std::vector<int> compare_divisions; ///< empty: the scene's own list
  /// Puts other functions in the place of the library's before a model is made; empty: they stay
  std::function<void(const Scene&, EntsLibrary&)> prepare;
  bool pictures = true;
  std::string variant;           ///< of the scene; empty: the scene as it is
  bool nodes = false;            ///< fields of the slave nodes in the JSON result
  std::string cut;               ///< "", "halves", "random"
  std::optional<unsigned> seed;  ///< of random cuts
  bool discard = false;          ///< try other increments first and throw them away
  int last_step = 0;             ///< 0: all
  std::filesystem::path restart; ///< checkpoint to continue from
};
int run_command(const CommonOptions& common, const RunOptions& options);

/// One scene as it is and with explicit meshes; part of `run`.
int compare_command(const CommonOptions& common, const RunOptions& options);

struct VariantsOptions {
  std::filesystem::path scene;
};
/// A scene and all its variants: one row each.
int variants_command(const CommonOptions& common, const VariantsOptions& options);

struct SublawOptions {
  std::filesystem::path scan, out;   ///< a height map, a model or a scene; out empty: no files
  double from = 0, to = 0;           ///< waves between these lengths; to = 0: all shorter ones
  double modulus = 0, poisson = 0.3; ///< E* [F/L^2], and nu of the bodies
  double conductivity = 0;           ///< k_s of the interface; 0: no conductance in the model
  double unit = 0;                   ///< of a map in metres: the model's length unit; 0: as it is
  std::vector<double> size;          ///< of the surface; empty: it says so itself
  int points = 0, realisations = 0;  ///< 0: as many as the waves need; four of a spectrum
  bool pictures = true;
};
/// The short waves of a surface as a law: the part of a model.
int sublaw_command(const CommonOptions& common, const SublawOptions& options);

struct VerifyOptions {
  std::vector<std::filesystem::path> files;
  double tolerance = 1e-10;
};
int verify_command(const CommonOptions& common, const VerifyOptions& options);

struct CheckOptions {
  std::filesystem::path model, mesh, out; ///< model: or a scene
  std::string variant;                    ///< of the scene; empty: as it is
  int samples = 0;                        ///< 0: as fine as the height asks for
  double reach = 0;                       ///< 0: the model's penetration_limit, if it has one
  double kink = 0;                        ///< degrees; 0: not judged
};
int check_command(const CommonOptions& common, const CheckOptions& options);

struct ChartOptions {
  std::filesystem::path out;     ///< empty: results go to the terminal only
  std::filesystem::path scenes;  ///< the folder examples; empty: found from the program's folder
  bool quick = false;            ///< a few points of each map, a few runs of each scene
  std::vector<std::string> only; ///< names of scenes: no others, and no maps; empty: all
  bool pictures = true;
};
/// What an error costs, by work-precision diagrams, and where each method works, by maps over pairs of
/// parameters.
int chart_command(const CommonOptions& common, const ChartOptions& options);

} // namespace host
