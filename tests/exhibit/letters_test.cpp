// SPDX-License-Identifier: Apache-2.0
// How large the letters of every panel are for somebody at the sweet spot, on a wall or in a headset, where a panel's
// texture is as sharp as they are.
// Invariant: from the paper's sweet spot the letters of every panel reach 20 minutes of arc
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "app/bench/render_subjects.h"
#include "app/live/view_keys.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/lesson/lesson_panel.h"
#include "exhibit/scan/scan_panels.h"
#include "full_panels.h"
#include "panel_painter.h"
#include "support/places.h"

namespace afm::exhibit {
namespace letters_test {

constexpr double kCapShare = 0.727;  // cap height in Inter's em square
constexpr double kLeastMinutes = 20.0;

class LettersOfThePanels : public ::testing::TestWithParam<const char*> {};

TEST_P(LettersOfThePanels, ReachTwentyMinutesOfArcFromTheSweetSpotOfThePapersWall) {
  ExhibitFiles files;
  files.assets_dir = support::source("assets");
  files.language = GetParam();
  const auto stage = load_exhibit(files);
  ASSERT_TRUE(stage) << stage.error().message;
  const render::FrameState frame = app::wall_subject(*stage, 64, app::WallMotion::Tip).value().frames.back();
  const double millimetre_m = stage->wall_scene.panel_millimetre_m();
  test::Painter painter(640.0, millimetre_m);
  const glm::dvec3 viewer = stage->wall.viewers.front().sweet_spot.position_m;
  const auto expect_large = [&](const auto& panel, const render::PanelPlacement& place, const std::string& name) {
    const glm::dvec3 middle = place.lower_left_m + 0.5 * (place.right_m + place.up_m);
    const double cap_m = kCapShare * static_cast<double>(painter.paint(panel, place).least_em_m);
    const double minutes = std::atan(cap_m / glm::distance(viewer, middle)) * 60.0 * 180.0 / std::numbers::pi;
    EXPECT_GE(minutes, kLeastMinutes) << name;
    RecordProperty(fmt::format("minutes of {}", name), fmt::format("{:.1f}", minutes));
  };
  const Phrases& phrases = stage->phrases();
  const render::PanelPlacement right = stage->wall_scene.places().parameters();
  expect_large(frame.panels.force.content, frame.panels.force.placement, "the plot");
  painter.look_for_overlaps(true);
  EXPECT_FALSE(painter.paint(frame.panels.force.content, frame.panels.force.placement).overlapping)
      << "the comma of the live force is on the legend";
  painter.look_for_overlaps(false);
  expect_large(frame.panels.data.content, frame.panels.data.placement, "the data");
  expect_large(full_banner(phrases, frame.panels.banner.content), frame.panels.banner.placement, "the banner");
  expect_large(render::ListPanel{app::key_list(app::HandSource::Mouse, false, phrases)},
               stage->wall_scene.places().keys(), "the list of keys");
  expect_large(full_parameters(*stage), right, "the parameters");
  const LiveScan scan = full_scan(*stage);
  expect_large(scan_panel(scan, phrases.word("Silicon nitride"), phrases), right, "the settings of a scan");
  const LiveScan tapped = full_tapped_scan(*stage);
  expect_large(scan_panel(tapped, phrases.word("Silicon nitride"), phrases), right,
               "the settings of a lever that taps");
  expect_large(image_panel(scan, phrases.word("Silicon nitride"), phrases), frame.panels.force.placement, "the images");
  expect_large(full_friction_loop(physics::FrictionLaw::Lattice, phrases), right, "the friction loop");
  expect_large(full_dial(phrases), right, "the dial");
  for (const LessonPrompt& prompt : full_prompts(phrases)) {
    const auto targets = lesson_targets(prompt, std::nullopt, phrases);
    const LessonPlaces places = lesson_places(right, targets.size());
    expect_large(lesson_panel(prompt, phrases), places.words, "the words of a lesson");
    for (std::size_t i = 0; i < targets.size(); ++i) {
      expect_large(render::Label{.text = targets[i].text, .highlighted = false, .placement = places.targets[i]},
                   places.targets[i], targets[i].text);
    }
  }
  for (const render::Label& label : frame.labels) expect_large(label, label.placement, label.text);
}

// Texts for a whole class have letters nearly as large as the guidance.
TEST_P(LettersOfThePanels, OfKeysAndOfALessonsWordsAreThoseOfTheGuidance) {
  constexpr double kShareOfGuidance = 0.7;
  ExhibitFiles files;
  files.assets_dir = support::source("assets");
  files.language = GetParam();
  const auto stage = load_exhibit(files);
  ASSERT_TRUE(stage) << stage.error().message;
  test::Painter painter(640.0, stage->wall_scene.panel_millimetre_m());
  render::FrameState frame = app::wall_subject(*stage, 64, app::WallMotion::Tip).value().frames.back();
  render::Banner guidance;
  guidance.guidance = "Lift the tip";
  const float guidance_px = painter.paint(guidance, frame.panels.banner.placement).letter_px;
  const auto share = [&](const auto& panel, const render::PanelPlacement& place) {
    const auto painted = painter.paint(panel, place);
    EXPECT_TRUE(painted.inside() && !painted.cut);
    return static_cast<double>(painted.letter_px / guidance_px);
  };
  const Phrases& phrases = stage->phrases();
  const WallPlaces& places = stage->wall_scene.places();
  const render::ListPanel keys{app::key_list(app::HandSource::Mouse, false, phrases)};
  RecordProperty("keys", std::to_string(share(keys, places.keys())));
  LessonPrompt cycle;
  cycle.title = phrases[Phrase::AllKeys];
  cycle.progress = phrases.text<Phrase::LessonStep>("2", "4");
  cycle.wants = LessonPrompt::Wants::Cycle;
  cycle.words = "Now turn the force on, and lower the tip slowly. Feel how suddenly the tip is pulled down.";
  cycle.hint = "Lift the tip, and press Turn-On.";
  RecordProperty("words", std::to_string(share(lesson_panel(cycle, phrases), places.parameters())));
  EXPECT_GE(share(keys, places.keys()), kShareOfGuidance);
  EXPECT_GE(share(lesson_panel(cycle, phrases), places.parameters()), kShareOfGuidance);
}

// Fourteen rows that must shrink: one with a source below it takes more height, not smaller letters.
TEST(LettersOfATable, HaveOneSizeWithAndWithoutASourceBelowThem) {
  test::Painter painter(640.0, 1e-3);
  const render::PanelPlacement place{.lower_left_m = {}, .right_m = {0.9, 0, 0}, .up_m = {0, 0.92, 0}};
  render::DataPanel table;
  for (int i = 0; i < 14; ++i) {
    table.rows.push_back({.name = "", .value = "8", .source = i % 3 == 0 ? "" : " "});
  }
  const auto painted = painter.paint(table, place);
  EXPECT_TRUE(painted.inside());
  EXPECT_GT(painted.least_em_m, 0.02F);
  EXPECT_NEAR(painted.largest_em_m, painted.least_em_m, 1e-4F);
}

TEST(LettersOfALabel, KeepTheirDistanceFromItsEdges) {
  constexpr float kLeastMm = 20.0F;
  test::Painter painter(1000.0, 1e-3);
  const render::PanelPlacement place{.lower_left_m = {}, .right_m = {0.8, 0, 0}, .up_m = {0, 0.1, 0}};
  const auto painted = painter.paint(
      render::Label{.text = "The tip presses on the surface", .highlighted = false, .placement = place}, place);
  const float mm_of_px = 800.0F / painted.size.x;
  EXPECT_GT(mm_of_px * painted.left_px, kLeastMm);
  EXPECT_GT(mm_of_px * (painted.size.x - painted.right_px), kLeastMm);
}

INSTANTIATE_TEST_SUITE_P(Languages, LettersOfThePanels, ::testing::Values("en", "de"));

}  // namespace letters_test
}  // namespace afm::exhibit
