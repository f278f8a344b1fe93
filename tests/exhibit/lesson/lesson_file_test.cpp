// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/lesson_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "core/whole_file.h"
#include "exhibit/lesson/lesson_run.h"
#include "exhibit/lesson/lesson_samples.h"
#include "exhibit/lesson/simulated_student.h"
#include "scene/samples/material_library.h"
#include "support/phrases.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::exhibit {
namespace lesson_file_test {

using ::testing::HasSubstr;

const std::string kHead =
    "id = \"a-lesson\"\ntitle = { en = \"A\", de = \"B\" }\nminutes = 5\nmaterials = [\"mica\", \"gold\"]\n";
const std::string kWords = "words = { en = \"Do.\", de = \"Tu.\" }\n";

std::string step(const std::string& keys) { return "[[step]]\nid = \"one\"\n" + kWords + keys; }

struct Refusal {
  std::string text;
  std::string message;  // expected message, with line and key
};

class LessonFile : public ::testing::TestWithParam<Refusal> {
 protected:
  const support::ScratchFolder folder_;
};

TEST_P(LessonFile, IsRefusedByLineAndKey) {
  const auto lesson = load_lesson(folder_.write("lesson.toml", GetParam().text), support::source("assets"));
  ASSERT_FALSE(lesson.has_value());
  EXPECT_EQ(lesson.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(lesson.error().message, HasSubstr(GetParam().message));
}

const std::string kFit = "scale = \"fit\"\n", kCommon = "scale = \"common\"\n";
const std::string kGold = "particles = \"gold-row\"\n", kPush = "type = \"push\"\n";
const std::string kSoft = "particles = \"scratch-pmma\"\n", kWrite = "type = \"write\"\n";
const std::string kInk = "particles = \"write-ink\"\n";
const std::string kWidth = "width = \"20 nm\"\n";
const std::string kTapping = "[tapping]\nfree_amplitude = \"20 nm\"\n";
const std::string kThreshold = "type = \"threshold\"\nmaterial = \"mica\"\nstaircase = \"weighted\"\n";

INSTANTIATE_TEST_SUITE_P(
    Refusals, LessonFile,
    ::testing::Values(
        Refusal{kHead + kFit + "speed = 3\n" + step("type = \"text\"\n"), "line 6: speed: unknown key; known are id"},
        Refusal{kHead + kFit + step("type = \"text\"\nvolume = 3\n"), "line 10: step.volume: unknown key"},
        Refusal{kHead + kFit + step("type = \"dance\"\n"), "line 9: step.type: dance is unknown; known are text, free"},
        Refusal{kHead + kFit + step("type = \"cycle\"\n"), "step.material: is missing"},
        Refusal{kHead + kFit + step("type = \"cycle\"\nmaterial = \"steel\"\n"),
                "line 10: step.material: steel is none of the lesson's materials: mica, gold"},
        Refusal{kHead + kFit + step("type = \"identify\"\n"), "line 9: step.type: identify needs the lesson's scale"},
        Refusal{kHead + kFit + step(kThreshold + "distance = \"kept\"\n"),
                "on fit every material lets go at the same force"},
        Refusal{kHead + kCommon + step(kThreshold), "step.distance: is missing"},
        Refusal{kHead + kCommon + step(kThreshold + "distance = \"roved\"\n"), "step.rove: is missing"},
        Refusal{kHead + kCommon + step(kThreshold + "distance = \"kept\"\nrove = 0.2\n"),
                "line 13: step.rove: is for distance = \"roved\" alone"},
        Refusal{kHead + kCommon + step(kThreshold + "distance = \"kept\"\nstart = 2.0\n"),
                "step.start: must lie between least and most"},
        Refusal{kHead + kCommon + step("type = \"identify\"\nmaterials = [\"mica\"]\n"),
                "line 10: step.materials: needs two materials or more"},
        Refusal{kHead + kFit + step("type = \"cycle\"\nmaterial = \"mica\"\ntrials = 1000\n"),
                "line 11: step.trials: must be a whole number from 1 to 200"},
        Refusal{kHead + kFit + step("type = \"question\"\nquestionnaire = \"ssq\"\n"), "step.when: is missing"},
        Refusal{kHead + kFit + step("type = \"question\"\nquestionnaire = \"ssq\"\nwhen = \"after\"\n"),
                "line 7: step.id: of this step must end in -after"},
        Refusal{kHead + kFit + step("type = \"question\"\nquestionnaire = \"sus\"\nwhen = \"after\"\n"),
                "step.when: is for the questionnaire ssq alone"},
        Refusal{kHead + kFit + step("type = \"text\"\neach_condition = true\n"),
                "step.each_condition: needs the lesson's conditions"},
        Refusal{kHead + kFit + "conditions = [\"haptics\", \"both\"]\n" + step("type = \"text\"\n"),
                "line 6: conditions: are used by no step"},
        Refusal{kHead + kFit + "conditions = [\"smell\", \"both\"]\n" + step("type = \"text\"\n"),
                "smell is unknown; known are haptics, picture, both, sound"},
        Refusal{kHead + kFit + step("type = \"text\"\nhint_after = \"5 s\"\n"), "needs both hint and hint_after"},
        Refusal{kHead + kFit + step("type = \"text\"\nhint = { en = \"a\", de = \"b\" }\nhint_after = \"5 nm\"\n"),
                "line 11: step.hint_after: "},
        Refusal{kHead + kFit + "[[step]]\nid = \"one\"\ntype = \"text\"\nwords = { en = \"Only\" }\n",
                "step.words.de: is missing"},
        Refusal{
            kHead + kFit + "[[step]]\nid = \"one\"\ntype = \"text\"\nwords = { en = \"a\", de = \"b\", fr = \"c\" }\n",
            "step.words.fr: unknown language"},
        Refusal{kHead + kFit + "[[step]]\nid = \"One\"\ntype = \"text\"\n" + kWords, "lower-case letters"},
        Refusal{kHead + kFit + step("type = \"text\"\n") + step("type = \"text\"\n"), "one is the id of another step"},
        Refusal{"id = \"a\"\ntitle = { en = \"A\", de = \"B\" }\nminutes = 21\nmaterials = [\"mica\"]\n" + kFit +
                    step("type = \"text\"\n"),
                "line 3: minutes: must be a whole number from 1 to 20"},
        Refusal{kHead + kFit + step(kPush + "until = \"pattern\"\n"),
                "line 9: step.type: push needs the lesson's particles"},
        Refusal{kHead + "particles = \"gold-heap\"\n", "line 5: particles: "},
        Refusal{kHead + "particles = \"tube-and-electrodes\"\n",
                "line 5: particles: tube-and-electrodes has rods or islands"},
        Refusal{kHead + kInk + step(kPush + "until = \"pattern\"\n"),
                "step.type: push needs particles, and write-ink has ink"},
        Refusal{kHead + kInk +
                    step("type = \"write\"\nlines = [[\"-400 nm, 0 nm\", \"400 nm, 0 nm\"]]\nwidth = \"20 nm\"\n"),
                "step.width: must lie between 41.5 nm and 166 nm, a quarter of the dot"},
        Refusal{kHead + kSoft + step(kPush + "until = \"pattern\"\n"),
                "line 9: step.type: push needs particles, and scratch-pmma has a soft sample: use write"},
        Refusal{kHead + kGold + step(kWrite), "line 9: step.type: write needs a soft sample or ink: particles = "},
        Refusal{kHead + kFit + step(kWrite), "line 9: step.type: write needs a soft sample"},
        Refusal{kHead + kSoft + step("type = \"cycle\"\n"),
                "line 9: step.type: cycle is for lessons without particles"},
        Refusal{kHead + kSoft + step(kWrite), "step.width: is missing"},
        Refusal{kHead + kSoft + step(kWrite + "width = \"9 nm\"\n"),
                "line 10: step.width: must lie between 10 nm and 40 nm, half and twice the radius of the tip"},
        Refusal{kHead + kSoft + step(kWrite + kWidth + "lines = []\n"),
                "line 11: step.lines: must be 1 to 20 lines such as"},
        Refusal{
            kHead + kSoft + step(kWrite + kWidth + "lines = [[\"0 nm, 0 nm\"]]\n"),
            "line 11: step.lines: must be lines such as [[\"-50 nm, 0 nm\", \"50 nm, 0 nm\"]], each line with 2 to 20"},
        Refusal{kHead + kSoft + step(kWrite + kWidth + "lines = [[\"0 nm, 0 nm\", 3]]\n"),
                "line 11: step.lines: must be lines such as"},
        Refusal{kHead + kSoft + step(kWrite + kWidth + "lines = [[\"0 nm, 0 nm\", \"80 nm, 0 N\"]]\n"),
                "line 11: step.lines: "},
        Refusal{kHead + kSoft + step(kWrite + kWidth + "lines = [[\"0 nm, 0 nm\", \"300 nm, 0 nm\"]]\n"),
                "line 11: step.lines: 300 nm, 0 nm is beyond the sample, on which the tip may be up to 276 nm from"},
        Refusal{kHead + kSoft + step(kWrite + kWidth + "lines = [[\"0 nm, 0 nm\", \"79 nm, 0 nm\"]]\n"),
                "line 11: step.lines: line 1 has a part shorter than 80 nm, four times its width"},
        Refusal{kHead + kSoft +
                    step(kWrite + kWidth +
                         "lines = [[\"-100 nm, 0 nm\", \"100 nm, 0 nm\"], [\"-40 nm, 9 nm\", \"40 nm, 9 nm\"]]\n"),
                "line 11: step.lines: line 2 is nowhere 40 nm or more from all other parts"},
        Refusal{kHead + kSoft + "conditions = [\"both\", \"picture\"]\n" +
                    step(kWrite + kWidth + "lines = [[\"0 nm, 0 nm\", \"80 nm, 0 nm\"]]\neach_condition = true\n"),
                "each_condition: is impossible for lines to be written: the condition picture takes the force away"},
        Refusal{kHead + kGold + kFit, "line 6: scale: is that of the particles"},
        Refusal{kHead + kGold + step("type = \"cycle\"\n"),
                "line 9: step.type: cycle is for lessons without particles"},
        Refusal{kHead + kGold + step(kPush + "until = \"gone\"\n"),
                "line 10: step.until: gone is unknown; known are moved, target, pattern, lost, line, "
                "threshold"},
        Refusal{kHead + kGold + step(kPush + "until = \"pattern\"\nparticle = 1\n"),
                "line 11: step.particle: is of no use with until = \"pattern\""},
        Refusal{kHead + kGold + step(kPush + "until = \"lost\"\nparticle = 6\n"),
                "line 11: step.particle: must be a whole number from 1 to 5"},
        Refusal{kHead + kGold + step(kPush + "until = \"target\"\nparticle = 1\ntarget = 0\n"),
                "line 12: step.target: must be a whole number from 1 to 5"},
        Refusal{kHead + kGold + step(kPush + "until = \"threshold\"\nparticle = 1\n"),
                "step.until: needs a particle with pinned = true, which is pressed for the answer"},
        Refusal{kHead + kGold + step(kPush + "until = \"threshold\"\nparticle = 1\ntarget = 1\n"),
                "step.target: is of no use with until = \"threshold\""},
        Refusal{kHead + kGold + step(kPush + "until = \"line\"\nparticle = 1\ntarget = 9\n"), "step.target"},
        Refusal{kHead + kGold + step(kPush + "until = \"moved\"\nparticle = 1\n"), "step.distance: is missing"},
        Refusal{kHead + kGold + step(kPush + "until = \"moved\"\nparticle = 1\ndistance = \"80\"\n"),
                "line 12: step.distance: "},
        Refusal{kHead + kGold + step(kPush + "until = \"moved\"\nparticle = 1\ndistance = \"400 nm\"\n"),
                "line 12: step.distance: must be more than 0 and at most 380 nm, the side of the field"},
        Refusal{kHead + kGold + "conditions = [\"picture\", \"both\"]\n" +
                    step(kPush + "until = \"pattern\"\neach_condition = true\n"),
                "line 12: step.each_condition: is impossible for a push"},
        Refusal{kHead + kFit + step("type = \"identify\"\nof = \"states\"\nmaterial = \"mica\"\n"),
                "line 10: step.of: states needs the lesson's table [tapping]"},
        Refusal{kHead + kFit + kTapping + step("type = \"cycle\"\nmaterial = \"mica\"\n"),
                "step.type: cycle compares pull-offs, which a lesson with tapping does not have"},
        Refusal{kHead + kFit + kTapping + step("type = \"identify\"\n"), "step.type: identify needs of = \"states\""},
        Refusal{
            kHead + kFit + kTapping + step("type = \"identify\"\nof = \"states\"\nmaterials = [\"mica\", \"gold\"]\n"),
            "step.materials: is of no use here; write material"},
        Refusal{kHead + kFit + "[tapping]\nquality_factor = 400\n", "tapping.free_amplitude: is missing"},
        Refusal{kHead + kFit + "[tapping]\nfree_amplitude = \"20\"\n", "line 7: tapping.free_amplitude: "},
        Refusal{kHead + kFit + "[tapping]\nfree_amplitude = \"20 nm\"\nspring_constant = \"40\"\n",
                "line 8: tapping.spring_constant: "},
        Refusal{kHead + kFit + "[tapping]\nfree_amplitude = \"20 nm\"\nspeed = 1\n",
                "line 8: tapping.speed: unknown key"},
        Refusal{kHead + kGold + kTapping, "tapping: is for lessons without particles"},
        Refusal{kHead + kFit, "step: is missing"},
        Refusal{kHead + "scale = \"atoms\"\n" + step("type = \"text\"\n"), "line 5: scale: atoms is unknown"}));

// A study compares its participants by this digest.
TEST(LessonDigest, IsThatOfTheParticleFileToo) {
  const support::ScratchFolder folder;
  const std::string gold = core::read_file(support::source("assets/particles/gold-row.toml")).value(),
                    set = folder.write("row.toml", gold);
  const std::string lesson = folder.write(
      "lesson.toml", kHead + "particles = \"" + set + "\"\n" + step(kPush + "until = \"lost\"\nparticle = 1\n"));
  const auto digest = [&] {
    const auto loaded = load_lesson(lesson, support::source("assets"));
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded ? loaded->digest : std::string();
  };
  const std::string before = digest();
  EXPECT_EQ(digest(), before);
  folder.write("row.toml", gold + "\n# another set\n");
  EXPECT_NE(digest(), before);
}

// A user's mica trains the hand differently.
TEST(LessonDigest, IsThatOfTheUsersMaterialsToo) {
  const support::ScratchFolder folder;
  const std::string lesson = support::source("assets/lessons/first-touch.toml"), assets = support::source("assets");
  const auto digest = [&](const std::string& materials) {
    const auto loaded = load_lesson(lesson, assets, materials);
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded ? loaded->digest : std::string();
  };
  const std::string soft = folder.write("soft.toml", "soft"), hard = folder.write("hard.toml", "hard");
  EXPECT_NE(digest(soft), digest(""));
  EXPECT_NE(digest(soft), digest(hard));
  EXPECT_EQ(digest(soft), digest(folder.write("copy.toml", "soft")));
  EXPECT_FALSE(load_lesson(lesson, assets, folder.file("none.toml")));
}

TEST(LessonSamples, RefuseALeverThatNoHandCanFeel) {
  const support::ScratchFolder folder;
  const auto lesson =
      load_lesson(folder.write("lesson.toml", kHead + kFit + kTapping + "quality_factor = 5000\n" +
                                                  "resonance = \"300 kHz\"\n" + step("type = \"text\"\n")),
                  support::source("assets"));
  ASSERT_TRUE(lesson) << lesson.error().message;
  const auto samples = lesson_samples(*lesson, scene::load_materials(support::source("assets/materials.toml")).value());
  ASSERT_FALSE(samples.has_value());
  EXPECT_EQ(samples.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(samples.error().message, HasSubstr("tapping: --quality-factor: "));
}

TEST(LessonSamples, RefuseAThresholdThatTheCommonScaleHasNoRoomFor) {
  const support::ScratchFolder folder;
  const auto lesson = load_lesson(
      folder.write("lesson.toml",
                   kHead + kCommon + "[[step]]\nid = \"one\"\n" + kWords +
                       "type = \"threshold\"\nmaterial = \"gold\"\nstaircase = \"weighted\"\ndistance = \"kept\"\n"),
      support::source("assets"));
  ASSERT_TRUE(lesson) << lesson.error().message;
  const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
  const auto samples = lesson_samples(*lesson, library);
  ASSERT_FALSE(samples.has_value());
  EXPECT_THAT(samples.error().message, HasSubstr("add a stronger material"));
}

// Kept: the comparison has 1 + w times the pull-off and both jumps at the same Z, so that they cannot be distinguished
// by distance.
TEST(ComparisonSample, KeepsTheDistancesOrRovesThemAsTheLessonSays) {
  const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
  const auto standard = curves::make_sample_model(curves::ContactSetup{*library.find("si3n4"), {}, {}}).value();
  const auto& before = standard.figures();
  const auto kept = comparison_sample(standard, DistanceCue::Kept, 0.3, 1.0).value().figures();
  EXPECT_NEAR(kept.force_before_joc.si, 1.3 * before.force_before_joc.si, 1e-6 * 1e-9);
  EXPECT_NEAR(kept.z_joc.si, before.z_joc.si, 1e-6 * before.z_joc.si);
  EXPECT_NEAR(kept.z_jtc.si, before.z_jtc.si, 1e-6 * before.z_jtc.si);
  const auto roved = comparison_sample(standard, DistanceCue::Roved, 0.3, 1.25).value().figures();
  EXPECT_NEAR(roved.force_before_joc.si, 1.3 * before.force_before_joc.si, 1e-6 * 1e-9);
  EXPECT_NEAR(roved.z_joc.si, 1.3 / 1.25 * before.z_joc.si, 1e-6 * before.z_joc.si);
}

// E26: why blind identification needs the common scale.
TEST(CommonScale, KeepsTheRatioOfPullOffsWhichFitDoesNot) {
  const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
  const auto mica = curves::make_sample_model(curves::ContactSetup{*library.find("mica"), {}, {}}).value();
  const auto gold = curves::make_sample_model(curves::ContactSetup{*library.find("gold"), {}, {}}).value();
  const double mica_n = mica.figures().force_before_joc.si, gold_n = gold.figures().force_before_joc.si;
  EXPECT_NEAR(gold_n / mica_n / 7.14317584, 1.0, 1e-6);
  EXPECT_NEAR(gold.scaling.hand_force_n(gold_n) / mica.scaling.hand_force_n(mica_n), 1.0, 1e-6);
}

std::vector<std::string> shipped_lessons() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(support::source("assets/lessons"))) {
    paths.push_back(entry.path().string());
  }
  return paths;
}

TEST(ShippedLessons, AreTenThatLoadAndRunToTheirEndInBothLanguages) {
  const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
  std::set<StepKind> kinds;
  std::size_t lessons = 0;
  for (const std::string& path : shipped_lessons()) {
    const auto lesson = load_lesson(path, support::source("assets"));
    ASSERT_TRUE(lesson) << lesson.error().message;
    EXPECT_TRUE(path.ends_with("/" + lesson->id + ".toml")) << path;
    const auto samples = lesson_samples(*lesson, library);
    ASSERT_TRUE(samples) << samples.error().message;
    for (const LessonStep& each : lesson->steps) kinds.insert(each.kind);
    for (const char* language : {"en", "de"}) {
      const Phrases phrases = Phrases::load(test::kPhraseFolder + language + ".toml").value();
      std::set<std::string> seen;
      const auto count = [&](const TrialRow& row) {
        seen.insert(row.step);
        return core::Result<void>{};
      };
      LessonRun run(*lesson, *samples, phrases, {.seed = 3, .order = 1}, count, 0.0);
      EXPECT_EQ(run.prompt(0).title, lesson->title.in(language));
      SimulatedStudent student({.seed = 3}, *lesson, *samples);
      const auto taken = student.take(run);
      ASSERT_TRUE(taken) << taken.error().message;
      EXPECT_EQ(run.end(), LessonEnd::Finished) << path;
      EXPECT_EQ(seen.size(), lesson->steps.size()) << path;
    }
    ++lessons;
  }
  EXPECT_EQ(lessons, 10U);
  EXPECT_EQ(kinds.size(), kStepKinds.size()) << "the lessons show every type of step";
}

}  // namespace lesson_file_test
}  // namespace afm::exhibit
