// SPDX-License-Identifier: Apache-2.0
// `touchafm particles` as people run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/whole_file.h"
#include "curves/image_file.h"
#include "support/places.h"
#include "support/programs/run_touchafm.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace particles_program_test {

using support::expect_refusal;
using support::ProgramResult;
using testing::HasSubstr;

ProgramResult particles(const std::string& arguments) {
  return support::run_program(support::touchafm() + " particles " + arguments);
}

TEST(ParticlesCommand, PushesTheGoldOfTheBuiltInSet) {
  const ProgramResult result = particles("gold-row --json --samples 50");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["states"].size(), 50U);
  EXPECT_EQ(json["moves"].size(), 7U);
  const auto& particles = json["particles"];
  ASSERT_EQ(particles.size(), 5U);
  // the first is pushed to the right as far as the tip goes, and two more later; the others stay
  EXPECT_NEAR(particles[0]["end_m"][0].get<double>(), 40e-9 + 40.2e-9, 1e-9);
  EXPECT_GT(particles[1]["end_m"][0].get<double>(), 290e-9);
  EXPECT_NEAR(particles[2]["end_m"][0].get<double>(), 330e-9 + 0.974 * 20e-9, 2e-9);
  EXPECT_EQ(particles[3]["end_m"], particles[3]["start_m"]);
  EXPECT_EQ(particles[4]["end_m"], particles[4]["start_m"]);
  // at the end of the second move the sphere slides at half of its threshold at rest
  const auto& pushed = json["moves"][1];
  EXPECT_EQ(pushed["state"], "slides");
  const double lateral = std::hypot(pushed["lateral_N"][0].get<double>(), pushed["lateral_N"][1].get<double>());
  const auto& figures = json["species"][0]["figures"];
  EXPECT_NEAR(lateral, figures["threshold_moving_N"].get<double>(), 1e-6 * lateral);
  EXPECT_LT(pushed["lateral_N"][0].get<double>(), 0.0);
  EXPECT_GE(json["least_certificate_J"].get<double>(), -1e-12 * json["moves"].back()["given_J"].get<double>());
  // the hand's work is lost, since nothing is stored any more; among several spheres to the order of a sub-step
  const auto& last = json["moves"].back();
  EXPECT_NEAR(last["work_J"].get<double>(), last["lost_J"].get<double>(), 0.02 * last["lost_J"].get<double>());
  EXPECT_EQ(last["state"], "free");
  EXPECT_EQ(json["species"][0]["sources"].size(), 12U);
}

TEST(ParticlesCommand, DragsSpheresThatStickToTheTip) {
  const ProgramResult result = particles("sticky-tip --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  // the sphere follows the tip back by 60 nm less the stretch of lever and contact, and stays where the tip is lifted
  const auto& sphere = json["particles"][0];
  EXPECT_NEAR(sphere["end_m"][0].get<double>(), -100e-9, 8e-9);
  const auto& dragged = json["moves"][2];
  EXPECT_EQ(dragged["state"], "slides");
  EXPECT_LT(dragged["normal_N"].get<double>(), 0.0);
  EXPECT_GT(dragged["lateral_N"][0].get<double>(), 0.0);
  const auto& last = json["moves"].back();
  EXPECT_EQ(last["state"], "free");
  EXPECT_EQ(last["attached"], 1);
  EXPECT_EQ(last["dragged"], 1);
  EXPECT_EQ(last["torn"], 1);
  const auto& figures = json["species"][0]["figures"]["tip_adhesion"];
  EXPECT_NEAR(figures["pull_off_on_flank_N"].get<double>(), 1.4904e-9, 1e-12);
  EXPECT_EQ(last["torn_at_N"], figures["pull_off_on_top_N"]);
  EXPECT_GT(last["torn_lost_J"].get<double>(), 0.0);
  EXPECT_LE(last["torn_lost_J"].get<double>(), last["lost_J"].get<double>());
  EXPECT_EQ(figures["drags"], true);
  EXPECT_NEAR(figures["lifted_from_J_per_m2"].get<double>(), 0.35, 1e-12);
  EXPECT_THAT(particles("sticky-tip").out, HasSubstr("tip adhesion: held 1 time, dragged "));
  EXPECT_TRUE(
      nlohmann::json::parse(particles("gold-row --json").out)["species"][0]["figures"]["tip_adhesion"].is_null());
}

TEST(ParticlesCommand, PicksASphereUpAndSetsItDownOnAPad) {
  const ProgramResult result = particles("pick-and-place --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  const auto& moves = json["moves"];
  ASSERT_EQ(moves.size(), 6U);
  EXPECT_EQ(moves[2]["state"], "carried");
  EXPECT_EQ(moves[2]["lifted"], 1);
  EXPECT_EQ(moves[2]["lift_N"], 0.0);
  const auto& figures = json["species"][0]["figures"];
  EXPECT_NEAR(moves[2]["lifted_at_N"].get<double>(), figures["adhesion_N"].get<double>(), 1e-15);
  EXPECT_EQ(figures["tip_adhesion"]["lifts"], true);
  EXPECT_EQ(moves[3]["state"], "carried");
  EXPECT_EQ(moves[4]["set_down"], 1);
  EXPECT_EQ(moves[5]["state"], "free");
  EXPECT_EQ(moves[5]["torn"], 1);
  EXPECT_EQ(moves[5]["lifted"], 1);
  // the sphere is on the pad, while those below its path have not moved
  EXPECT_NEAR(json["particles"][0]["end_m"][0].get<double>(), 200e-9, 4e-9);
  EXPECT_NEAR(json["particles"][0]["end_m"][1].get<double>(), -20e-9, 4e-9);
  for (const std::size_t other : {1U, 2U, 3U}) {
    EXPECT_EQ(json["particles"][other]["end_m"], json["particles"][other]["start_m"]);
  }
  EXPECT_GE(json["least_certificate_J"].get<double>(), -1e-12 * moves[5]["given_J"].get<double>());
  EXPECT_EQ(json["pattern"]["done"], true);
  EXPECT_EQ(json["task"]["done"], true);
  EXPECT_THAT(particles("pick-and-place").out, HasSubstr("lifted 1 time, set down 1 time"));
}

TEST(ParticlesCommand, SaysHowFarThePatternIs) {
  const ProgramResult result = particles("gold-row --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  ASSERT_EQ(json["targets_m"].size(), 5U);
  const auto& pattern = json["pattern"];
  double sum_m2 = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& there = json["particles"][pattern["particle_of_target"][i].get<std::size_t>()]["end_m"];
    for (std::size_t axis = 0; axis < 2; ++axis) {
      sum_m2 += std::pow(there[axis].get<double>() - json["targets_m"][i][axis].get<double>(), 2);
    }
  }
  EXPECT_NEAR(pattern["rms_m"].get<double>(), std::sqrt(sum_m2 / 5.0), 1e-15);
  EXPECT_EQ(pattern["done"], false);
  EXPECT_DOUBLE_EQ(pattern["allowed_m"].get<double>(), 25e-9);
  EXPECT_THAT(particles("gold-row").out, HasSubstr("pattern of 5 targets: not done, "));
}

TEST(ParticlesCommand, EndsAtTheSamePlacesAtEveryRate) {
  double places[3][2] = {};
  const char* rates[] = {"500Hz", "1kHz", "4kHz"};
  for (int i = 0; i < 3; ++i) {
    const ProgramResult result = particles(std::string("latex-letter --json --rate ") + rates[i]);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto end = nlohmann::json::parse(result.out)["particles"][0]["end_m"];
    for (int axis = 0; axis < 2; ++axis) places[i][axis] = end[static_cast<std::size_t>(axis)].get<double>();
  }
  for (int i = 0; i < 2; ++i) {  // 1e-4 of the distance of the axes
    EXPECT_NEAR(places[i][0], places[2][0], 8e-12) << rates[i];
    EXPECT_NEAR(places[i][1], places[2][1], 8e-12) << rates[i];
  }
}

TEST(ParticlesCommand, PrintsWhatAUserMustKnow) {
  const ProgramResult result = particles("gold-row");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"gives sideways at", "gentle load", "softest lever", "amontons", "estimated", "slides"}) {
    EXPECT_THAT(result.out, HasSubstr(part));
  }
}

TEST(ParticlesCommand, CountsParticlesFromOneAndHasNoNumberThatTheFileLacks) {
  EXPECT_THAT(particles("gold-row").out, HasSubstr("slides    1          126.5 pN"));
  EXPECT_THAT(particles("gold-row").out, HasSubstr("\nparticle   moved by     to\n1  "));
  const support::ScratchFolder folder;
  std::string set = core::read_file(support::source("assets/particles/gold-row.toml")).value();
  for (const char* key : {"coefficient = ", "rolling_distance = "}) {
    const std::size_t at = set.find(key);
    set.erase(at, set.find('\n', at) - at);
  }
  const std::string stiff = "\"10 MPa\"";
  const std::string file = folder.write("heavy.toml", set.replace(set.find(stiff), stiff.size(), "\"10 GPa\""));
  const ProgramResult heavy = particles(file);
  EXPECT_EQ(heavy.exit_code, 0) << heavy.err;
  EXPECT_THAT(heavy.out, HasSubstr("amontons unknown without a coefficient"));
  EXPECT_THAT(heavy.out, HasSubstr("this one of 1 N/m rides over it, with at most "));
  EXPECT_THAT(heavy.out, HasSubstr("\nno particle has moved\n"));
  const auto figures = nlohmann::json::parse(particles(file + " --json").out)["species"][0]["figures"];
  EXPECT_TRUE(figures["unloaded_threshold_by_amontons_N"].is_null());
}

// 20 nm below the sample with a lever of 1 N/m
TEST(ParticlesCommand, NamesTheEnergyOfALeverThatIsBentAtTheStart) {
  const support::ScratchFolder folder;
  std::string set = core::read_file(support::source("assets/particles/pick-and-place.toml")).value();
  const std::string high = "y = \"0 nm\"\nz = \"100 nm\"";
  const std::size_t start = set.find(high, set.find("[start]"));
  ASSERT_NE(start, std::string::npos);
  set.replace(start, high.size(), "y = \"0 nm\"\nz = \"-20 nm\"");
  const ProgramResult pressed = particles(folder.write("pressed.toml", set));
  EXPECT_EQ(pressed.exit_code, 0) << pressed.err;
  EXPECT_THAT(pressed.out, HasSubstr("200 aJ were stored at the start, where the lever is bent\n"));
  EXPECT_THAT(pressed.out, testing::Not(HasSubstr("more was lost")));
  EXPECT_THAT(particles("pick-and-place").out, testing::Not(HasSubstr("at the start")));
}

TEST(ParticlesCommand, LaysARodAcrossItsElectrodesAtAnyRate) {
  double turned[3] = {}, moved[3] = {};
  const char* rates[] = {"500Hz", "1kHz", "4kHz"};
  for (int i = 0; i < 3; ++i) {
    const ProgramResult result = particles(std::string("tube-and-electrodes --json --rate ") + rates[i]);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json["species"][0]["length_m"], 1e-6);
    const auto& rod = json["particles"][0];
    EXPECT_NEAR(rod["start_angle_rad"].get<double>(), 35.0 * 3.14159265358979 / 180.0, 1e-12);
    turned[i] = rod["end_angle_rad"].get<double>();
    moved[i] = rod["end_m"][1].get<double>();
    EXPECT_EQ(json["pattern"]["pads_touched"], 2);
    EXPECT_EQ(json["pattern"]["done"], true);
    EXPECT_TRUE(json["pattern"]["allowed_m"].is_null());
    EXPECT_EQ(json["task"]["done"], true);
    EXPECT_EQ(json["task"]["strokes"], 2);
    EXPECT_GE(json["least_certificate_J"].get<double>(), -1e-12 * json["moves"].back()["given_J"].get<double>());
  }
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(turned[i], turned[2], 2e-3) << rates[i];
    EXPECT_NEAR(moved[i], moved[2], 1e-9) << rates[i];
  }
  const ProgramResult text = particles("tube-and-electrodes");
  for (const char* part :
       {"nanotube, rods of 1 um", "in the middle", "at an end", "2 of 2 pads touched", " deg", "done in"}) {
    EXPECT_THAT(text.out, HasSubstr(part));
  }
}

TEST(ParticlesCommand, ScratchesASoftSample) {
  const ProgramResult result = particles("scratch-pmma --json --samples 20");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["sample"], "PMMA");
  EXPECT_EQ(json["states"].size(), 20U);
  const auto& figures = json["figures"];
  EXPECT_NEAR(figures["groove_depth_under_load_m"].get<double>(), 6.296226461e-9, 1e-14);
  EXPECT_NEAR(figures["ploughing_coefficient"].get<double>(), 0.3802388906, 1e-9);
  EXPECT_EQ(figures["any_touch_marks"], true);
  const auto& pass = json["moves"][1];
  EXPECT_EQ(pass["marks"], true);
  EXPECT_EQ(pass["state"], "marks");
  EXPECT_LT(pass["lateral_N"][0].get<double>(), 0.0);
  EXPECT_GT(pass["groove"]["depth_m"].get<double>(), 3e-9);
  const auto& volumes = json["volumes"];
  const double pressed = volumes["pressed_m3"].get<double>(), back = volumes["sprung_back_m3"].get<double>(),
               ridges = volumes["ridges_m3"].get<double>();
  EXPECT_NEAR(ridges, 0.7 * (pressed - back), 1e-6 * pressed);
  EXPECT_NEAR(pressed, back + ridges + volumes["densified_m3"].get<double>(), 1e-6 * pressed);
  EXPECT_GE(json["least_certificate_J"].get<double>(), -1e-12 * json["moves"].back()["given_J"].get<double>());
  EXPECT_EQ(json["moves"].back()["state"], "free");
  EXPECT_EQ(json["sources"].size(), 11U);
  const ProgramResult text = particles("scratch-pmma");
  for (const char* part : {"first scratch", "any touch marks", "went into ridges", "11 of 11 values are estimated"}) {
    EXPECT_THAT(text.out, HasSubstr(part));
  }
  const support::ScratchFolder folder;
  const std::string file = folder.file("scratch.gwy");
  EXPECT_EQ(particles("scratch-pmma --out " + file).exit_code, 0);
  const auto written = curves::load_image(file);
  ASSERT_TRUE(written) << written.error().message;
  const auto& heights = written->image.channels.front().values;
  EXPECT_NEAR(*std::max_element(heights.begin(), heights.end()), 8e-9, 4e-9);
  EXPECT_LT(*std::min_element(heights.begin(), heights.end()), -8e-9);
  expect_refusal(particles("gold-row --out " + file), 2, "image of a soft sample");
  expect_refusal(particles("scratch-pmma --out " + file + ".png"), 2, "ends in .gwy");
  expect_refusal(support::run_program(support::touchafm() + " view --particles scratch-pmma --level 1"), 2,
                 "there are no particles");
}

TEST(ParticlesCommand, TurnsAnIslandAtAnyRate) {
  double turned[3] = {}, aside[3] = {};
  const char* rates[] = {"500Hz", "1kHz", "4kHz"};
  for (int i = 0; i < 3; ++i) {
    const ProgramResult result = particles(std::string("islands --json --rate ") + rates[i]);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_NEAR(json["species"][0]["island_radius_m"].get<double>(), 97.7e-9, 1e-20);
    EXPECT_NEAR(json["species"][0]["figures"]["threshold_through_the_middle_N"].get<double>(), 30e-9, 0.02e-9);
    turned[i] = json["particles"][1]["end_angle_rad"].get<double>();
    aside[i] = json["particles"][1]["end_m"][0].get<double>();
    EXPECT_EQ(json["pattern"]["done"], true);
    EXPECT_EQ(json["task"]["strokes"], 3);
    EXPECT_GE(json["least_certificate_J"].get<double>(), -1e-12 * json["moves"].back()["given_J"].get<double>());
  }
  EXPECT_NEAR(turned[2], -30.8 * 3.14159265358979 / 180.0, 0.01);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(turned[i], turned[2], 1e-4) << rates[i];
    EXPECT_NEAR(aside[i], aside[2], 1e-11) << rates[i];
  }
  const ProgramResult text = particles("islands");
  for (const char* part :
       {"antimony island, flat islands", "through its middle", "stick up to 44.3 deg", " deg", "done in"}) {
    EXPECT_THAT(text.out, HasSubstr(part));
  }
}

// One sphere of the built-in gold, to be pushed 95 nm by a hand that first waits above it.
std::string waiting_hand(const std::string& wait) {
  const std::string gold = *core::read_file(support::source("assets/particles/gold-row.toml"));
  const auto place = [](const std::string& table, int x, const std::string& more) {
    return "\n" + table + "\nx = \"" + std::to_string(x) + " nm\"\ny = \"0 nm\"\n" + more;
  };
  const auto move = [&](int x, int z, const std::string& more) {
    return place("[[move]]", x, "z = \"" + std::to_string(z) + " nm\"\nspeed = \"0.1 um/s\"\n" + more);
  };
  return gold.substr(0, gold.find("[[particle]]")) + place("[[particle]]", 0, "") +
         place("[[particle]]", 300, "pinned = true\n") + place("[[target]]", 95, "") +
         place("[start]", -60, "z = \"80 nm\"\n") + move(-60, 80, "wait = \"" + wait + "\"\n") + move(-60, 0, "") +
         move(55, 0, "") + move(55, 80, "wait = \"6 s\"\n");
}

TEST(ParticlesCommand, FailsOnAnOldPictureUnlessTheHandLooksAgain) {
  const support::ScratchFolder folder;
  const std::string file = folder.write("old.toml", waiting_hand("260 s"));
  const auto json_of = [&](const std::string& options) {
    const ProgramResult result = particles(file + " --json " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out);
  };
  const auto truth = json_of(""), computed = json_of("--level 1");
  const auto looks = json_of("--level 2"), blind = json_of("--level 2 --no-look");
  // a picture that is computed from the truth changes no force
  EXPECT_TRUE(truth["picture"].is_null());
  EXPECT_EQ(truth["task"]["particles_shown"], true) << "an aid";
  EXPECT_EQ(computed["task"]["particles_shown"], false);
  EXPECT_EQ(computed["states"], truth["states"]);
  EXPECT_EQ(computed["particles"], truth["particles"]);
  EXPECT_EQ(computed["task"]["done"], true);
  ASSERT_EQ(computed["picture"]["looks"].size(), 1U);
  EXPECT_EQ(computed["picture"]["looks"][0]["difference_m"], 0.0);
  EXPECT_EQ(computed["picture"]["looks"][0]["lines"], 33);

  // once the picture is stale the hand looks again, and its push succeeds
  EXPECT_EQ(looks["task"]["done"], true);
  EXPECT_EQ(looks["pattern"]["judged"], true);
  ASSERT_EQ(looks["picture"]["looks"].size(), 2U);
  const auto& first = looks["picture"]["looks"][0];
  EXPECT_GT(first["time_s"].get<double>(), 246.0);
  EXPECT_LT(first["time_s"].get<double>(), 251.0);
  EXPECT_NEAR(first["difference_m"].get<double>(), 0.05e-9 * first["time_s"].get<double>(), 0.2e-9);
  EXPECT_EQ(looks["picture"]["particles"][0]["measured"], true);
  EXPECT_EQ(looks["picture"]["particles"][0]["stale"], false);
  EXPECT_EQ(looks["picture"]["particles"][1]["stale"], true);

  // without a look the picture shows success, although the sphere is elsewhere
  EXPECT_EQ(blind["task"]["done"], false);
  EXPECT_EQ(blind["pattern"]["judged"], false);
  EXPECT_EQ(blind["pattern"]["done"], false);
  EXPECT_LT(blind["pattern"]["rms_m"].get<double>(), 5e-9);
  EXPECT_LT(blind["particles"][0]["end_m"][0].get<double>(), 95e-9 - 25e-9);
  EXPECT_GT(blind["picture"]["computed_pixels"].get<int>(), looks["picture"]["computed_pixels"].get<int>());
  EXPECT_THAT(particles(file + " --level 2").out, HasSubstr("second look at 249."));

  // the same numbers every time
  EXPECT_EQ(json_of("--level 2"), looks);
}

TEST(ParticlesCommand, WritesWithInk) {
  const ProgramResult result = particles("write-ink --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_NEAR(json["moves"][4]["width_m"].get<double>(), 216e-9, 11e-9);
  EXPECT_EQ(json["sources"].size(), 7U);
  EXPECT_THAT(particles("write-ink").out, HasSubstr("a line at 100 nm/s   216 nm wide"));
  const support::ScratchFolder folder;
  const std::string file = folder.file("ink.gwy");
  EXPECT_EQ(particles("write-ink --out " + file).exit_code, 0);
  const auto image = curves::load_image(file);
  ASSERT_TRUE(image) << image.error().message;
  expect_refusal(particles("write-ink --level 1"), 2, "ink");
  std::string text = core::read_file(support::source("assets/particles/write-ink.toml")).value();
  text.erase(text.find("[tip]"), text.find("[ink]") - text.find("[tip]"));
  text.erase(text.find("surface_tension"), text.find("[start]") - text.find("surface_tension"));
  const std::string bare = folder.write("bare.toml", text);
  EXPECT_EQ(particles(bare).exit_code, 0);
  expect_refusal(support::run_program(support::touchafm() + " view --particles " + bare), 2, "a hand cannot write");
}

TEST(ParticlesCommand, RefusesWithTheReasonAndTheExitCode) {
  expect_refusal(particles(""), 2, "file");
  expect_refusal(
      particles("silver-row"), 2,
      "unknown set of particles \"silver-row\"; choose blind-line, gold-row, islands, latex-letter, pick-and-place, "
      "scratch-pmma, sticky-tip, sweep-gold, threshold-by-feel, tube-and-electrodes, write-afm, write-ink");
  expect_refusal(particles("/no/such.toml"), 3, "/no/such.toml");
  expect_refusal(particles("gold-row --rate 4"), 2, "kHz");
  expect_refusal(particles("islands --level 1"), 2, "flat islands");
  expect_refusal(particles("scratch-pmma --level 2"), 2, "soft sample");
  expect_refusal(particles("gold-row --rate 1MHz"), 2, "100kHz");
  expect_refusal(particles("gold-row --samples 1"), 2, "2");
  expect_refusal(particles("gold-row --level 3"), 2, "--level");
  const support::ScratchFolder folder;
  expect_refusal(particles(folder.write("long.toml", waiting_hand("4000 s"))), 3, "4000 s is not within");
  std::string text = *core::read_file(support::source("assets/particles/gold-row.toml"));
  const std::string speed = "speed = \"0.1 um/s\"";
  text.replace(text.find(speed), speed.size(), "speed = \"0.0001 um/s\"");
  text.replace(text.find(speed), speed.size(), "speed = \"0.0001 um/s\"");
  expect_refusal(particles(folder.write("slow.toml", text) + " --rate 100kHz"), 2, "lower --rate, or raise the speeds");
}

}  // namespace particles_program_test
}  // namespace afm::app
