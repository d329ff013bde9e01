// SPDX-License-Identifier: BSD-3-Clause
// Jobs of ents-deck: how far the driven motion slides, the folder, numbers of elements, defaults of the programs.
#include <cmath>

#include "deck_text.hpp"
#include "run_job.hpp"
#include "write.hpp"

namespace ents_deck::deck_job_test {
namespace {

Motion motion(const string& steps, const string& before = "") {
  return prescribed_motion(mesh_of(two_blocks() + before + steps));
}

string driven(const string& lines, const string& parameters = "") {
  return "*STEP\n*STATIC\n*BOUNDARY" + parameters + "\n" + lines + "*END STEP\n";
}

// ---- the slide ----

TEST(DeckMotion, HasTheLargestValueOfItsAmplitude) {
  const string amplitude = "*AMPLITUDE, NAME=MOVE, TIME=TOTAL TIME\n0., 0., 1., 4., 2., -1.\n";
  EXPECT_DOUBLE_EQ(motion(driven("NHIGH, 1, 1, 0.5\n", ", AMPLITUDE=move"), amplitude).range[0], 2.5);
  EXPECT_DOUBLE_EQ(motion(driven("NHIGH, 1, 1, 0.5\n"), amplitude).range[0], 0.5);
  EXPECT_NE(error_of([&] {
              motion(driven("NHIGH, 1, 1, 0.5\n", ", AMPLITUDE=NONE"));
            }).find("no *AMPLITUDE, NAME=NONE"),
            string::npos);
  for (const char* unknown : {", USER", ", SUBMODEL", ", TYPE=VELOCITY"})
    EXPECT_EQ(motion(driven("NHIGH, 1, 1, 0.5\n", unknown)).remarks.size(), 1u) << unknown;
}

TEST(DeckMotion, OfTransformedNodesIsInWhicheverDirection) {
  const Motion turned = motion(driven("NHIGH, 1, 1, 0.3\nNHIGH, 2, 2, 0.4\n"),
                               "*TRANSFORM, NSET=NHIGH, TYPE=R\n0.6, 0.8, 0., -0.8, 0.6, 0.\n");
  EXPECT_DOUBLE_EQ(turned.any_direction, 0.5);
  EXPECT_DOUBLE_EQ(length(turned.range), 0);
}

TEST(DeckMotion, OfABodyThatTurnsIsThatOfItsFarthestNode) {
  const string body =
      "*NODE\n901, 1.5, 1.5, 12.\n902, 1.5, 1.5, 12.\n*RIGID BODY, NSET=NHIGH, REF NODE=901, ROT NODE=902\n";
  const double radius = std::hypot(1, 1, 11), slide = 2 * radius * std::sin(0.1);
  EXPECT_NEAR(motion(driven("902, 2, 2, 0.2\n"), body).any_direction, slide, 1e-12);
  EXPECT_NEAR(motion(driven("901, 5, 5, 0.2\n"), body).any_direction, slide, 1e-12);
  EXPECT_FALSE(motion(driven("901, 5, 5, 0.2\n"), body).rotates);
  EXPECT_DOUBLE_EQ(motion(driven("902, 2, 2, 0.2\n"), body).range[1], 0); // no displacement
}

TEST(DeckRun, ReadsTheSlidesThatTheJobAsksFor) {
  write("asked/ents_slide.txt",
        "# step ...\n1 3 open 4 0.5 1.5 S A, M\n0 0 left 1 0.5 1.75 S A, M\n2 1 lost 2 0.5 2.5 S A, M\n"
        "2 1 open 2 0.5 0.5 T, M\n");
  const WantedSlides wanted = wanted_slides("asked");
  EXPECT_EQ(wanted.pressed.at("S A, M"), 2.5);
  EXPECT_EQ(wanted.open.at("S A, M"), 1.5);
  EXPECT_EQ(wanted.pressed.count("T, M"), 0u);
  Options options;
  options.slides["SLAVE, MASTER"] = 0.3; // at least: the deck's own slide is 0.05
  EXPECT_EQ(converted(deck(), options).contacts.at(0).patches.slide, 0.3);
}

// ---- the folder ----

TEST(DeckFolder, IsNewOrThatOfAnEarlierJob) {
  std::filesystem::remove_all("folder");
  check_folder("folder");
  const Job job = converted(deck());
  Options options;
  options.deck = "job/deck.inp";
  options.program = Program::abaqus;
  write_job(job, options, "folder");
  check_folder("folder");
  write("folder/mine.txt", "kept");
  write("folder/ents_9.json", "kept");
  Options other = options;
  other.first_model = 20;
  write_job(converted(deck(), other), other,
            "folder"); // its ents_1.json would be a model that no element has
  EXPECT_FALSE(std::filesystem::exists("folder/ents_1.json"));
  EXPECT_TRUE(std::filesystem::exists("folder/ents_20.json"));
  EXPECT_EQ(content("folder/mine.txt") + content("folder/ents_9.json"), "keptkept");
  write("foreign/mine.txt", "kept");
  EXPECT_NE(error_of([] { check_folder("foreign"); }).find("mine.txt"), string::npos);
  EXPECT_NE(error_of([] { check_folder("foreign/mine.txt"); }).find("is a file; name a folder"),
            string::npos);
}

TEST(DeckFolder, ARefusedJobLeavesNothingBehind) {
  std::filesystem::remove_all("above");
  write("above/outside.inp", "** nothing\n");
  write("above/decks/deck.inp", deck("*STEP", "*INCLUDE, INPUT=../outside.inp\n*STEP"));
  Options options;
  options.deck = "above/decks/deck.inp";
  const Job job = convert(options);
  EXPECT_NE(error_of([&] { files_of_job(job, options, "above/out"); }).find("lies outside"),
            string::npos); // --explain
  EXPECT_NE(error_of([&] { write_job(job, options, "above/out"); }).find("lies outside"), string::npos);
  EXPECT_FALSE(std::filesystem::exists("above/out"));
  // A file that cannot be written: a folder has its name.
  std::filesystem::create_directories("above/full/ents_1.json/x");
  options.deck = "job/deck.inp";
  EXPECT_NE(error_of([&] { write_job(converted(deck()), options, "above/full"); }).find("cannot be written"),
            string::npos);
  EXPECT_FALSE(std::filesystem::exists("above/full/deck.inp"));
}

// ---- numbers and defaults ----

TEST(DeckElements, HaveNumbersThatTheAssemblyHasNot) {
  const string text =
      "*PART, NAME=P\n" + block(1, {0, 0, 0}, {1, 1, 1}, 1, 1, 1, "E") +
      "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=L, PART=P\n*END INSTANCE\n*INSTANCE, NAME=U, PART=P\n"
      "0., 0., 1.\n*END INSTANCE\n*SURFACE, NAME=SLAVE\nU.E, S1\n*SURFACE, NAME=MASTER\nL.E, S2\n"
      "*ELEMENT, TYPE=SPRINGA, ELSET=S\n7, L.5, U.6\n*END ASSEMBLY\n*MATERIAL, NAME=M\n*ELASTIC\n1000., "
      ".3\n" +
      law + pair_of_surfaces + "*STEP\n*STATIC\n*END STEP\n";
  Options options;
  options.program = Program::abaqus;
  EXPECT_EQ(first_free_element(converted(text, options)), 8);
}

// ccx's default stiffness: 50 times the first constant of the first material, whatever law it has.
TEST(DeckLaw, DefaultsAreThoseOfTheFirstMaterial) {
  const string hyper = "*MATERIAL, NAME=R\n*HYPERELASTIC, NEO HOOKE\n0.5, 0.1\n";
  string text = deck("*MATERIAL, NAME=M", hyper + "*MATERIAL, NAME=M");
  text.replace(text.find("PRESSURE-OVERCLOSURE=LINEAR\n1e6\n"), 32,
               "PRESSURE-OVERCLOSURE=HARD\n*FRICTION\n0.2\n");
  const Job job = converted(text);
  const auto contact = job.models.at(0).text.at("contact");
  EXPECT_EQ(contact.at("normal").at("stiffness"), 25.0);
  EXPECT_EQ(contact.at("friction").at("stiffness"), 0.25);
}

// Two blocks that are one at x = 0: in ccx a point in a face may have a node of its own patch, a node alone has no
// contact with itself.
TEST(DeckPoints, OfBodiesThatShareNodes) {
  const string text =
      "*NODE\n1, 0., 0.\n2, 1., 0.\n3, 2., 0.\n4, 0., 1.\n5, 1., 1.\n6, 2., 1.\n7, 1., 1.\n8, 2., 1.\n9, 0., "
      "2.\n"
      "10, 1., 2.\n11, 2., 2.\n*ELEMENT, TYPE=CPE4, ELSET=LOW\n1, 1, 2, 5, 4\n2, 2, 3, 6, 5\n*ELEMENT, "
      "TYPE=CPE4, ELSET=HIGH\n3, 4, 7, 10, 9\n4, 7, 8, 11, 10\n*SURFACE, NAME=SLAVE\nHIGH, S1\n*SURFACE, "
      "NAME=MASTER\nLOW, S3\n" +
      material + law + pair_of_surfaces + "*STEP\n*STATIC\n*END STEP\n";
  Options options;
  options.points = 2;
  EXPECT_EQ(converted(text, options).elements.size(), 4u);
  options.points = 0;
  EXPECT_EQ(converted(text, options).elements.size(), 2u); // of three nodes
  options.program = Program::abaqus;
  EXPECT_NE(error_of([&] {
              converted(text, options);
            }).find("node 4 belongs to slave and master, and a user element"),
            string::npos);
}

// A rigid element is its own surface: it has no thickness, as a shell has.
TEST(DeckFaces, OfRigidElementsAreTaken) {
  const string text = block(101, {0.5, 0.5, 1}, {2.5, 2.5, 2}, 2, 2, 1, "HIGH") +
                      "*NODE\n1, 0., 0., 1.\n2, 3., 0., 1.\n3, 3., 3., 1.\n4, 0., 3., 1.\n*ELEMENT, "
                      "TYPE=R3D4, ELSET=LOW\n1, 1, "
                      "2, 3, 4\n*SURFACE, NAME=SLAVE\nHIGH, S1\n*SURFACE, NAME=MASTER\nLOW, SPOS\n" +
                      material + law + pair_of_surfaces + "*STEP\n*STATIC\n*END STEP\n";
  Options options;
  options.program = Program::abaqus;
  EXPECT_EQ(converted(text, options).elements.size(), 36u);
  string shell = text;
  shell.replace(shell.find("R3D4"), 4, "S4");
  EXPECT_NE(error_of([&] { converted(shell, options); }).find("half a thickness"), string::npos);
}

TEST(DeckPoints, TooFewAreRemarked) {
  const auto remarked = [](std::optional<int> points) {
    Options options;
    options.points = points;
    const Job job = converted(deck(), options);
    for (const string& remark : job.contacts.at(0).remarks)
      if (remark.find("does not carry a uniform pressure") != string::npos) return true;
    return false;
  };
  EXPECT_TRUE(remarked(0));
  EXPECT_TRUE(remarked(1));
  EXPECT_FALSE(remarked(2));
  EXPECT_FALSE(remarked({}));
}

} // namespace
} // namespace ents_deck::deck_job_test
