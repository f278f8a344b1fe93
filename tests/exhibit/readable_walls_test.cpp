// SPDX-License-Identifier: Apache-2.0
// What is painted on the panels of every wall, as Dear ImGui is given it: no word leaves its panel or is cut, and the
// servo's state is large enough on the smallest picture.
// Invariant: at 400 to 7680 pixels no preset cuts off a word in any language, even with large text
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/bench/render_subjects.h"
#include "app/live/view_keys.h"
#include "app/view/view_pointer.h"
#include "core/whole_file.h"
#include "exhibit/frame/calibration.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/lesson/lesson_panel.h"
#include "exhibit/panels/depth_report.h"
#include "exhibit/scan/scan_panels.h"
#include "full_panels.h"
#include "panel_painter.h"
#include "support/deep.h"
#include "support/phrases.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::exhibit {
namespace readable_walls_test {

using test::kLargestImage;
using test::Painted;
using test::Painter;

constexpr float kLeastLetterPx = 9.0F;   // em square of the state's word, in pixels of an eye
constexpr double kLeastBannerPx = 15.0;  // height of the smallest readable banner
constexpr std::array kWidthsPx{400U, 1280U, 2110U, 3840U, 7680U};
constexpr std::array kPresets{"powerwall", "two-projectors", "3d-tv", "desk-red-cyan", "tiled-2x2", "blended",
                              "curved",    "cave",           "floor", "wide",          "phone"};

// Expects everything that a visitor can see on one wall, in one language and at one width, to be readable.
void expect_readable(const Stage& stage, const render::FrameState& frame, std::uint32_t width_px,
                     const std::string& where) {
  const Phrases& phrases = stage.phrases();
  Painter painter(2.0 * width_px / stage.screen.width_m(), stage.wall_scene.panel_millimetre_m());
  const auto expect_whole = [&](const auto& panel, const render::PanelPlacement& placement, const char* name) {
    const Painted painted = painter.paint(panel, placement);
    EXPECT_TRUE(painted.inside()) << where << ": " << name << " covers " << painted.low.x << ", " << painted.low.y
                                  << " to " << painted.high.x << ", " << painted.high.y << " of " << painted.size.x
                                  << ", " << painted.size.y;
    EXPECT_FALSE(painted.cut) << where << ": " << name << " is cut";
  };
  const render::Banner shown = full_banner(phrases, frame.panels.banner.content);
  const Painted banner = painter.paint(shown, frame.panels.banner.placement, shown.state_color);
  EXPECT_TRUE(banner.inside() && !banner.cut) << where << ": the banner";
  EXPECT_LT(banner.bottom_px, 0.97F * banner.size.y) << where << ": the banner's last line is on its edge";
  const float letters = render::text_height_mm(render::TextStyle::Strong);
  const float letter_px = banner.state_height_px * letters / (letters + 24.0F);
  // a picture of 12 m x 2 m that is 400 pixels wide has 67 rows, 7 of them for the banner; one of 6 m x 2 m has 133
  if (glm::length(frame.panels.banner.placement.up_m) * width_px / stage.screen.width_m() > kLeastBannerPx) {
    EXPECT_GE(letter_px, kLeastLetterPx) << where;
  }
  // beside dark screens of a cluster
  if (width_px >= 1280) {
    render::Banner alone = shown;
    alone.warning = phrases[Phrase::MasterMissing];
    render::PanelPlacement part = frame.panels.banner.placement;
    part.right_m *= 1.0 / 3.0;
    expect_whole(alone, part, "the banner on one of three screens");
  }
  expect_whole(frame.panels.force.content, frame.panels.force.placement, "the plot");
  expect_whole(frame.panels.data.content, frame.panels.data.placement, "the data");
  render::DataPanel data = frame.panels.data.content;
  data.details = true;
  expect_whole(data, frame.panels.data.placement, "the data with its sources");
  for (const auto use : {app::WallUse::Free, app::WallUse::Particles, app::WallUse::Lesson}) {
    expect_whole(render::ListPanel{app::key_list(app::HandSource::Mouse, false, phrases, use)},
                 stage.wall_scene.places().keys(), "the list of keys");
  }
  expect_whole(full_parameters(stage), stage.wall_scene.places().parameters(), "the parameters");
  for (const auto law : {physics::FrictionLaw::None, physics::FrictionLaw::Lattice}) {
    expect_whole(full_friction_loop(law, phrases), stage.wall_scene.places().parameters(), "the friction loop");
  }
  expect_whole(full_dial(phrases), stage.wall_scene.places().parameters(), "the dial");
  for (render::DataPanel particles : full_particles(phrases)) {
    particles.details = true;
    expect_whole(particles, frame.panels.data.placement, ("the particles of " + particles.title).c_str());
  }
  for (const LessonPrompt& prompt : full_prompts(phrases)) {
    const auto targets = lesson_targets(prompt, std::nullopt, phrases);
    const LessonPlaces places = lesson_places(stage.wall_scene.places().parameters(), targets.size());
    expect_whole(lesson_panel(prompt, phrases), places.words, "the words of a lesson");
    for (std::size_t i = 0; i < targets.size(); ++i) {
      expect_whole(render::Label{.text = targets[i].text, .highlighted = false, .placement = places.targets[i]},
                   places.targets[i], targets[i].text.c_str());
    }
  }
  const LiveScan scan = full_scan(stage);
  expect_whole(image_panel(scan, phrases.word("Silicon nitride"), phrases), frame.panels.force.placement, "the images");
  expect_whole(scan_panel(scan, phrases.word("Silicon nitride"), phrases), stage.wall_scene.places().parameters(),
               "the settings of a scan");
  const LiveScan tapped = full_tapped_scan(stage);
  expect_whole(image_panel(tapped, phrases.word("Silicon nitride"), phrases), frame.panels.force.placement,
               "the images of a lever that taps");
  expect_whole(scan_panel(tapped, phrases.word("Silicon nitride"), phrases), stage.wall_scene.places().parameters(),
               "the settings of a lever that taps");
  const DepthReport depth = report_depth({.nearest_m = 1.0, .farthest_m = 10.0}, 2.5, 0.063, Relief::BringToWall);
  std::vector<render::Label> labels = frame.labels;
  labels.push_back(depth_label(depth, stage.screen, phrases));
  labels.push_back({.text = phrases[Phrase::ChangeParameters],
                    .highlighted = false,
                    .placement = stage.wall_scene.places().parameter_tab()});
  labels.push_back({.text = phrases[Phrase::LeaveAnalogy] + "     " + phrases[Phrase::AllKeys],
                    .highlighted = false,
                    .placement = stage.wall_scene.places().note()});
  for (const render::Label& label : labels) expect_whole(label, label.placement, label.text.c_str());
  constexpr double kRulerM = 0.080;  // true scale on every screen
  if (stage.screen.width_m() < kRulerM) return;
  render::FrameState pattern;
  show_calibration(stage.screen, scene::StereoMode::SideBySide, 0.063, phrases, pattern);
  const Painted whole_screen = painter.paint(pattern.panels.calibration.content, pattern.panels.calibration.placement);
  const float half_line = 1.5F * whole_screen.size.y / 2286.0F;  // half line of the grid on the screen's edge
  constexpr float kSoftEdge = 3.0F;
  EXPECT_TRUE(whole_screen.inside(kSoftEdge + half_line)) << where << ": the test pattern";
}

class ReadableWalls : public ::testing::TestWithParam<const char*> {};

TEST_P(ReadableWalls, CutNoWordAndShowTheStateOnPicturesOfEverySizeInEveryLanguage) {
  const support::ScratchFolder folder;
  const std::string pseudo = folder.write("pseudo.toml", test::pseudo_language());
  for (const auto& [language, own] : {std::pair<std::string, std::string>{"en", ""}, {"de", ""}, {"en", pseudo}}) {
    if (!support::deep() && own.empty()) continue;  // covered by the pseudo-locale, which has the longest words
    ExhibitFiles files;
    files.assets_dir = support::source("assets");
    files.wall = fmt::format("{}/walls/{}.toml", files.assets_dir, GetParam());
    files.language = language;
    files.guidance = own;
    auto stage = load_exhibit(files);
    ASSERT_TRUE(stage) << stage.error().message;
    const render::FrameState frame = app::wall_subject(*stage, 64, app::WallMotion::Tip).value().frames.back();
    const std::string name = own.empty() ? language : "pseudo";
    for (const std::uint32_t width_px : kWidthsPx) {
      if (!support::deep() && width_px != kWidthsPx.front()) continue;  // the smallest has the least room
      expect_readable(*stage, frame, width_px, fmt::format("{} at {} pixels, {}", GetParam(), width_px, name));
    }
    stage->wall_scene.set_text_size(kLargestText);
    expect_readable(*stage, frame, 1280, fmt::format("{} with large texts, {}", GetParam(), name));
  }
}

TEST_P(ReadableWalls, HaveLargerLettersWhereTheyAreAskedFor) {
  ExhibitFiles files;
  files.assets_dir = support::source("assets");
  files.wall = fmt::format("{}/walls/{}.toml", files.assets_dir, GetParam());
  struct Letters {
    float guidance_px = 0.0F, words_px = 0.0F, consent_px = 0.0F;
  };
  const auto letters_at = [&](double text_size) {
    files.text_size = text_size;
    const auto stage = load_exhibit(files).value();
    Painter painter(2.0 * 1280 / stage.screen.width_m(), stage.wall_scene.panel_millimetre_m());
    const render::FrameState frame = app::wall_subject(stage, 64, app::WallMotion::Tip).value().frames.back();
    const auto words_px = [&](const LessonPrompt& prompt) {
      const std::size_t targets = lesson_targets(prompt, std::nullopt, stage.phrases()).size();
      const LessonPlaces places = lesson_places(stage.wall_scene.places().parameters(), targets);
      return painter.paint(lesson_panel(prompt, stage.phrases()), places.words).letter_px;
    };
    LessonPrompt consent = full_prompts(stage.phrases()).front(), cycle;
    cycle.wants = LessonPrompt::Wants::Cycle;
    cycle.words = "Lift the tip, press Turn-On, and lower it until it snaps to the surface.";
    render::Banner banner = frame.panels.banner.content;
    banner.guidance = "Lower the tip";
    banner.scale.clear();
    banner.state_word.clear();
    return Letters{painter.paint(banner, frame.panels.banner.placement).letter_px, words_px(cycle), words_px(consent)};
  };
  const Letters normal = letters_at(1.0), large = letters_at(kLargestText);
  EXPECT_GT(large.guidance_px, 1.3F * normal.guidance_px);
  EXPECT_GT(large.words_px, 1.2F * normal.words_px);
  EXPECT_GT(large.consent_px, 0.9F * normal.consent_px) << "it fills its panel already, and only the margins grow";
}

// The wand of the mouse covered the words of the tab above it.
TEST(MouseGrip, IsSeenBelowTheTab) {
  constexpr double kHandleM = 0.27;  // distance from the grip to the end that points away from the target
  ExhibitFiles files;
  files.assets_dir = support::source("assets");
  files.aspect = 16.0 / 9.0;
  const auto stage = load_exhibit(files).value();
  const WallScene& scene = stage.wall_scene;
  const glm::dvec3 grip = app::mouse_grip_m(scene), eye = stage.eyes[0].eye_position_m;
  for (const input::Target& target : scene.swatch_targets()) {
    const glm::dvec3 end = grip - kHandleM * glm::normalize(target.center_m - grip);
    for (const glm::dvec3& place : {grip, end}) {
      const double on_wall_y = eye.y + (place.y - eye.y) * eye.z / (eye.z - place.z);
      EXPECT_LT(on_wall_y, scene.places().parameter_tab().lower_left_m.y);
      EXPECT_GT(on_wall_y, stage.screen.lower_left.y);
    }
  }
}

// The servo's line was so long that its letters were 0.6 times as high as those above, which filled half of theirs.
TEST(Banner, SharesItsFactsBetweenTheTwoLowerLines) {
  ExhibitFiles files;
  files.assets_dir = support::source("assets");
  files.aspect = 16.0 / 9.0;
  const auto stage = load_exhibit(files).value();
  Painter painter(2.0 * 1280 / stage.screen.width_m(), stage.wall_scene.panel_millimetre_m());
  const render::FrameState frame = app::wall_subject(stage, 64, app::WallMotion::Tip).value().frames.back();
  const auto letters_px = [&](const char* scale) {
    render::Banner banner;
    banner.scale = scale;
    return painter.paint(banner, frame.panels.banner.placement).letter_px;
  };
  const float whole = letters_px("lever: 1 m = 131 nm\nForce limit: 2 N");
  const float shared = letters_px(
      "sample and motion: 1 m = 209 nm     lever: 1 m = 131 nm     tip: 1 m = 37.5 nm     deflection x626 relative to "
      "the lever\nScale of the hand: 0.5 mm/nm, 0.2 N/nN (fit: scaled to fit each sample)     Force limit: 2 N, 500 "
      "N/s "
      "(simulated hand)     Servo: 1000 Hz, real-time (scheduling latency p99 127 us, 29 of 13029 ticks missed)     "
      "Picture: 50 % of width and height, samples per pixel: 1 (frame budget 60 ms)");
  EXPECT_GT(shared, 0.8F * whole);
}

// Names and numbers that are read from the last row of a room: 10 minutes of arc from 10 m are 29 mm.
TEST(DataPanel, HasLargerNumbersWithoutTheirSources) {
  constexpr float kCapital = 0.727F, kLeastMm = 29.0F;
  ExhibitFiles files;
  files.assets_dir = support::source("assets");
  files.aspect = 16.0 / 9.0;
  const auto stage = load_exhibit(files).value();
  Painter painter(2.0 * 1280 / stage.screen.width_m(), stage.wall_scene.panel_millimetre_m());
  render::FrameState frame = app::wall_subject(stage, 64, app::WallMotion::Tip).value().frames.back();
  render::DataPanel& data = frame.panels.data.content;
  const Painted without = painter.paint(data, frame.panels.data.placement);
  data.details = true;
  const Painted with = painter.paint(data, frame.panels.data.placement);
  EXPECT_GT(without.letter_px, 1.25F * with.letter_px);
  data.subtitle.clear();
  data.details = false;
  EXPECT_GT(1e3F * kCapital * painter.paint(data, frame.panels.data.placement).least_em_m, kLeastMm);
}

// A German title was cut above a table of many rows, where it may not shrink as much.
TEST(DataPanel, WritesALongTitleOnTwoLines) {
  ExhibitFiles files;
  files.assets_dir = support::source("assets");
  files.wall = files.assets_dir + "/walls/powerwall.toml";
  const auto stage = load_exhibit(files).value();
  Painter painter(2.0 * 1280 / stage.screen.width_m(), stage.wall_scene.panel_millimetre_m());
  const render::PanelPlacement place =
      app::wall_subject(stage, 64, app::WallMotion::Tip).value().frames.back().panels.data.placement;
  const auto painted = [&](int repeats) {
    render::DataPanel panel;
    for (int i = 0; i < repeats; ++i) panel.title += i == 0 ? "Punkte und Linien" : " aus Tinte auf Gold";
    return painter.paint(panel, place);
  };
  const Painted one = painted(1), two = painted(4), endless = painted(40);
  EXPECT_FALSE(one.cut || two.cut);
  EXPECT_TRUE(two.inside());
  EXPECT_GT(two.largest_em_m, 0.5F * one.largest_em_m);
  EXPECT_GT(two.right_px, 0.5F * two.size.x);
  EXPECT_TRUE(endless.cut) << "too small to be read";
  EXPECT_TRUE(endless.inside());
}

INSTANTIATE_TEST_SUITE_P(Presets, ReadableWalls, ::testing::ValuesIn(kPresets));

// The accents of the pseudo-locale and of German.
TEST(PanelFonts, HoldEveryLetterOfEveryLanguage) {
  const render::PanelFonts fonts = test::load_panel_fonts(400.0, 1e-3);
  for (const std::string& text : {std::string("äöüßÄÖÜáêïÿÅÉÏØÝ„“–…×°µ²√γ→−"), test::pseudo_language(),
                                  core::read_file(test::kPhraseFolder + "de.toml").value()}) {
    const char* at = text.data();
    const char* const end = at + text.size();
    while (at < end) {
      unsigned int letter = 0;
      at += ImTextCharFromUtf8(&letter, at, end);
      if (letter < ' ') continue;
      // the last font contains only the characters of numbers
      for (ImFont* font : std::span(fonts.fonts).first(render::kTextStyles - 1)) {
        EXPECT_NE(font->FindGlyphNoFallback(static_cast<ImWchar>(letter)), nullptr) << "U+" << std::hex << letter;
      }
    }
  }
}

// Seen from the last row of a room, 10 m away: 40 minutes of arc.
TEST(PanelFonts, ShowTheLiveForceInDigitsForTheLastRow) {
  constexpr double kLeastMm = 116.3;
  const render::PanelFonts fonts = test::load_panel_fonts(2000.0, 1e-3);
  const ImFont& font = *fonts.fonts[static_cast<std::size_t>(render::TextStyle::Figure)];
  for (const char digit : std::string_view("0123456789")) {
    const ImFontGlyph* glyph = font.FindGlyphNoFallback(static_cast<ImWchar>(digit));
    ASSERT_NE(glyph, nullptr) << digit;
    EXPECT_GE((glyph->Y1 - glyph->Y0) / fonts.texels_per_mm, static_cast<float>(kLeastMm)) << digit;
  }
  for (const unsigned int sign : {0x2BU, 0x2CU, 0x2EU, 0x2212U}) {
    EXPECT_NE(font.FindGlyphNoFallback(static_cast<ImWchar>(sign)), nullptr) << sign;
  }
}

// They follow the tip at once. What differs between two digits is at most half of their boxes: for four of them, before
// the paper's wall, that is too small for a flash (WCAG 2.3.1).
TEST(PanelFonts, ShowTheLiveForceTooSmallForAFlash) {
  constexpr double kLargestSafeSr = 0.006, kDiffers = 0.5, kDigits = 4.0, kViewerM = 2.5;
  const render::PanelFonts fonts = test::load_panel_fonts(2000.0, 1e-3);
  const ImFont& font = *fonts.fonts[static_cast<std::size_t>(render::TextStyle::Figure)];
  const ImFontGlyph* glyph = font.FindGlyphNoFallback('0');
  ASSERT_NE(glyph, nullptr);
  const auto size_m = [&](float low, float high) {
    return 1e-3 * static_cast<double>((high - low) / fonts.texels_per_mm);
  };
  const double area_m2 = kDiffers * kDigits * size_m(glyph->X0, glyph->X1) * size_m(glyph->Y0, glyph->Y1);
  EXPECT_LT(area_m2 / (kViewerM * kViewerM), kLargestSafeSr);
}

}  // namespace readable_walls_test
}  // namespace afm::exhibit
