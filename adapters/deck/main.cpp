// SPDX-License-Identifier: BSD-3-Clause
// ents-deck: the command line, and what it says.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <numeric>

#include <CLI/CLI.hpp>

#include "convert.hpp"
#include "library.hpp"
#include "picture.hpp"
#include "point_counts.hpp"
#include "run_job.hpp"
#include "write.hpp"

namespace {

using namespace ents_deck;
using std::string;

struct CommandLine {
  Options options;
  std::vector<string> pairs, coordinates;
  string program, out, ccx;
  double slide = -1, stiffness = 0;
  int points = -1;
  bool explain = false, pictures = true, solve = false;
};

string counted(std::size_t n, const string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

/// CLI11's own check prints the largest double with all its digits.
CLI::Validator number_from(double least, bool itself) {
  return CLI::Validator(
      [least, itself](string& text) {
        double value = 0;
        if (parse(text, value) && (value > least || (itself && value == least))) return string();
        return "expected a number " + string(itself ? "from " : "above ") + shown(least) + ", found '" +
               text + "'";
      },
      "");
}

/// SLAVE,MASTER; names with commas cannot be named.
std::pair<string, string> pair_of(const string& text) {
  const std::size_t comma = text.find(',');
  if (comma == string::npos || comma == 0 || comma + 1 == text.size())
    throw Error("--pair " + text + ": expected SLAVE,MASTER");
  return {string(trimmed(text.substr(0, comma))), string(trimmed(text.substr(comma + 1)))};
}

void read_coordinates(CommandLine& line) {
  const auto& words = line.coordinates;
  if (words.empty()) return;
  const auto axis = [](const string& w) { return w == "x" || w == "y" || w == "z"; };
  if (words.size() == 2 && words[0] == "cylinder" && axis(words[1])) {
    line.options.coordinates = "cylinder " + words[1];
  } else if (words.size() == 1 &&
             (axis(words[0]) || (words[0].size() == 2 && axis(words[0].substr(0, 1)) &&
                                 axis(words[0].substr(1)) && words[0][0] != words[0][1]))) {
    line.options.coordinates = words[0];
  } else if (words.size() == 1 && std::filesystem::is_regular_file(words[0])) {
    line.options.coordinates = "file";
    line.options.coordinate_file = words[0];
  } else {
    throw Error("--coordinates: expected two letters such as xy, \"cylinder z\", or a file with lines \"NODE "
                "S1 S2\"");
  }
}

void report(const Job& job, const Contact& contact, const Findings& found, const Admissibility& surface,
            Program program) {
  const auto& patches = contact.patches;
  std::printf("pair %s (slave), %s (master)%s\n", contact.pair.slave.c_str(), contact.pair.master.c_str(),
              contact.pair.statement ? (" of " + job.mesh.source.at(contact.pair.line)).c_str() : "");
  const bool points = contact.points[0].nodes.size() > 1;
  std::printf("  slave     %s, one per %s, on %s%s\n", counted(contact.element_count, "element").c_str(),
              points ? "point inside of a face" : "node", counted(contact.slave.faces.size(), "face").c_str(),
              patches.left_out
                  ? (" (" + counted(static_cast<std::size_t>(patches.left_out), points ? "point" : "node") +
                     " beside the master left out)")
                        .c_str()
                  : "");
  double area = 0;
  for (std::size_t i = 0; i < contact.element_count; ++i)
    area += job.elements[contact.first_element + i].slave.area;
  std::printf("  areas     %s in all\n", shown(area).c_str());
  std::printf("  master    %s; elements of at most %d nodes (%s: %d), slide %s%s\n",
              counted(contact.master.faces.size(), "face").c_str(), patches.widest,
              program == Program::calculix ? "ccx" : "Abaqus", program == Program::calculix ? 20 : 33,
              shown(patches.slide).c_str(),
              std::isfinite(patches.reserve)
                  ? (", and at least " + shown(patches.reserve) + " to a patch's border").c_str()
                  : ", and every patch is the whole surface");
  std::printf("  law       %s\n", contact.model.at("contact").dump().c_str());
  std::printf(
      "  gaps      %s ahead of the surface: %d on it, %d penetrate%s%s\n",
      counted(static_cast<std::size_t>(found.near), points ? "point" : "node").c_str(), found.touching,
      found.penetrating, found.penetrating ? (" (by up to " + shown(found.deepest) + ")").c_str() : "",
      std::isfinite(found.nearest) ? (", the nearest other gap is " + shown(found.nearest)).c_str() : "");
  if (has_height(contact))
    std::printf("  height    from %s to %s\n", shown(surface.lowest).c_str(), shown(surface.highest).c_str());
  for (const string& violation : surface.violations) std::printf("  NOT ADMISSIBLE  %s\n", violation.c_str());
  for (const string& remark : contact.remarks) std::printf("  note      %s\n", remark.c_str());
}

/// Options as the program takes them. @throws Error
void read_options(CommandLine& line) {
  for (const string& pair : line.pairs) line.options.pairs.push_back(pair_of(pair));
  read_coordinates(line);
  line.options.program = line.program == "abaqus" ? Program::abaqus : Program::calculix;
  if (line.slide >= 0) line.options.slide = line.slide;
  if (line.points >= 0) line.options.points = line.points;
  if (line.stiffness > 0) line.options.stiffness = line.stiffness;
}

/// @return the surfaces are admissible
bool report(const Job& job, const Options& options) {
  bool admissible = true;
  for (const Contact& contact : job.contacts) {
    const Findings found = findings_of(job.mesh, contact, 2 * contact.touch);
    const Admissibility surface = admissibility_of(job.mesh, contact);
    report(job, contact, found, surface, options.program);
    admissible = admissible && surface.violations.empty();
  }
  const bool friction =
      std::any_of(job.models.begin(), job.models.end(), [](const Model& m) { return !m.symmetric; });
  const auto first = static_cast<long long>(first_free_element(job));
  int nodes = 0, states = 0;
  for (const Model& m : job.models)
    nodes = std::max(nodes, m.nodes()), states = std::max(states, m.state_size);
  std::printf("elements  %lld .. %lld, %s, at most %d nodes and %d history variables%s\n", first,
              first + static_cast<long long>(job.elements.size()) - 1,
              counted(job.models.size(), "model").c_str(), nodes, states,
              friction ? ", unsymmetric stiffness" : "");
  return admissible;
}

void write(const Job& job, const CommandLine& line, bool admissible) {
  const auto files = write_job(job, line.options, line.out);
  std::printf("deck      %s\n", files.front().string().c_str());
  if (line.pictures) {
    const Pictures pictures = draw(job, line.out);
    std::printf("pictures ");
    for (const auto& file : pictures.files) std::printf(" %s", file.string().c_str());
    std::printf("%s%s\n", pictures.problem.empty() ? "" : "; ", pictures.problem.c_str());
  }
  if (!admissible)
    std::printf(
        "The surface is NOT ADMISSIBLE, see above: results near these places are not to be trusted.\n");
}

int translate(CommandLine& line) {
  read_options(line);
  if (!line.explain) check_folder(line.out);
  const Job job = convert(line.options);
  const bool admissible = report(job, line.options);
  if (line.explain) {
    files_of_job(job, line.options,
                 line.out.empty() ? "ents-deck.explained" : line.out); // refuses what the run refuses
    std::printf("nothing is written (--explain)\n");
    return 0;
  }
  write(job, line, admissible);
  const string name = line.options.deck.stem().string();
  std::printf("next      %s\n",
              line.options.program == Program::calculix
                  ? ("cd " + line.out + " && ccx_ents " + name +
                     "   (sh adapters/calculix/run.sh --only-build makes build/calculix/ccx_ents)")
                        .c_str()
                  : ("cd " + line.out + " && abaqus job=" + name +
                     " user=...   with libents_abaqus.so as user library (adapters/abaqus/uel)")
                        .c_str());
  return 0;
}

int solve(CommandLine& line) {
  read_options(line);
  if (line.out.empty()) line.out = line.options.deck.stem().string() + "_ents";
  check_folder(line.out);
  return run_job({line.options, line.out, line.ccx}, [&](const Options& options, bool first) {
    line.options = options;
    const Job job = convert(options);
    if (first) {
      write(job, line, report(job, options));
      return;
    }
    write_job(job, options, line.out);
  });
}

int program(int argc, char** argv) {
  CommandLine line;
  line.solve = argc > 1 && string(argv[1]) == "run";
  if (line.solve) --argc, ++argv;
  CLI::App app{"Contact pairs of an Abaqus or CalculiX deck become contact elements of ents.\n", "ents-deck"};
  app.footer("Every line of the deck but those of the pairs stays as it is, byte for byte. Exit codes: 0 "
             "done, 2 the command line or the deck is wrong,\n"
             "or asks for what contact elements cannot do (the message names file and line).\n\n"
             "Examples:\n"
             "  ents-deck run job.inp                                translates, solves with ccx_ents, and "
             "makes patches "
             "larger where they were too small\n"
             "  ents-deck job.inp --for calculix --out job_ents\n"
             "  ents-deck job.inp --pair SLAVE,MASTER --model scan.json --coordinates xy --for abaqus --out "
             "job_ents\n"
             "  ents-deck job.inp --for calculix --explain");
  app.add_option("deck", line.options.deck, "deck (.inp) as its program or mesher wrote it")
      ->required()
      ->type_name("FILE");
  app.add_option("--pair", line.pairs,
                 "surfaces of a *CONTACT PAIR, or surfaces or sets of a deck without one [all pairs]")
      ->type_name("SLAVE,MASTER");
  app.add_option("--model", line.options.model,
                 "model with height, law ...; what it does not say comes from the deck [no height]")
      ->type_name("FILE");
  app.add_option("--for", line.program, "calculix or abaqus [run: calculix]")
      ->required(!line.solve)
      ->check(CLI::IsMember({"calculix", "abaqus"}))
      ->type_name("PROGRAM");
  if (line.solve)
    app.add_option("--ccx", line.ccx, "ccx with U1E [ccx_ents of the build folder, or of the search path]")
        ->type_name("PROGRAM");
  app.add_option("--points", line.points,
                 "elements per direction of a slave face, at points inside of it; 0: one per slave node [3, "
                 "7 on quadratic faces, 8 in the plane, more over finer masters; nodes where the slave is of "
                 "nodes alone]")
      ->check(CLI::Range(0, most_points))
      ->type_name("N");
  app.add_option("--first-model", line.options.first_model,
                 "k of the first ents_k.json, for jobs that have others [1]")
      ->check(CLI::Range(1, 9000))
      ->type_name("K");
  CLI::Option* out = app.add_option("--out", line.out, "folder of the new job")->type_name("DIR");
  app.add_option("--slide", line.slide, "how far slave nodes slide [from the deck's *BOUNDARY]")
      ->check(number_from(0, true))
      ->type_name("LENGTH");
  app.add_option("--stiffness", line.stiffness, "of a penalty law [*SURFACE BEHAVIOR, or a proposal]")
      ->check(number_from(0, false))
      ->type_name("NUMBER");
  app.add_option("--coordinates", line.coordinates,
                 "surface coordinates of the height: xy, yz ... (positions), cylinder x|y|z (angle, height), "
                 "or a file \"NODE S1 S2\" [natural coordinates of each face]")
      ->expected(1, 2)
      ->type_name("HOW");
  app.add_flag("--explain", line.explain, "say what would be done and write nothing");
  app.add_flag_callback(
      "--no-pictures", [&] { line.pictures = false; }, "leave the pictures out");
  try {
    app.parse(argc, argv);
    if (!line.solve && !line.explain && out->count() == 0)
      throw CLI::RequiredError("--out DIR (or --explain)");
    if (line.solve && (line.explain || line.program == "abaqus"))
      throw CLI::ValidationError("run", "solves with ccx: leave --explain and --for abaqus out");
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error); // --help
    std::fprintf(stderr, "ents-deck: %s\nents-deck --help lists what there is\n", error.what());
    return 2;
  }
  try {
    return line.solve ? solve(line) : translate(line);
  } catch (const Error& error) {
    std::fprintf(stderr, "ents-deck: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ents-deck: %s\n", error.what());
    return 1;
  }
}

} // namespace

int main(int argc, char** argv) {
  const int code = program(argc, argv);
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  std::fprintf(stderr, "ents-deck: stdout cannot be written: %s\n", std::strerror(errno));
  return code == 0 ? 1 : code;
}
