// SPDX-License-Identifier: Apache-2.0
// Invariant: every number of a session file is checked before it is used
#include "servo/session_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include "core/version.h"
#include "core/whole_file.h"
#include "haptics/device.h"
#include "servo/session_writer.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace session_file_test {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;

RecordedSession example() {
  RecordedSession session;
  session.material = "mica";
  session.parameters.contact.tip_radius.si = 50e-9;
  session.parameters.contact.spring_constant.si = 0.1;
  session.parameters.contact.sample_stiffness.si = std::numeric_limits<double>::infinity();
  session.parameters.contact.hamaker.si = 24.5e-21;
  session.parameters.contact.mean_surface_energy.si = 2.228e-3;
  session.parameters.contact.reduced_modulus = physics::Pressure(51.5e9);
  session.parameters.contact.atomic_distance = physics::Length(0.3e-9);
  session.parameters.law = physics::Law::Dmt;
  session.parameters.has_meniscus = 1;
  session.parameters.meniscus.relative_humidity = 0.35;
  session.parameters.dynamic = 1;
  session.parameters.lever = {physics::Frequency(12e3), 2.5, physics::Temperature(298.0)};
  session.slow_motion = 37.0;
  session.rate_hz = 1000.0;
  session.dead_man = true;
  session.room_from_sample[13] = 1.5;
  session.device = haptics::shared(haptics::omni_like("an Omni"));
  session.device.max_slew_n_per_s = 400.0;
  session.realtime = true;
  session.hand_m_per_m = 3.57e6;
  session.hand_n_per_n = 1.43e9;
  for (int i = 0; i < 1000; ++i) {
    scene::TipSample sample;
    sample.time_ns = 5'000'000'000 + i * 1'000'000;
    sample.tip.z_m = 1e-9 * std::cos(0.01 * i);
    sample.tip.force_n = -0.1 * sample.tip.z_m;
    session.samples.push_back(sample);
  }
  scene::TipEvent event;
  event.kind = physics::EventKind::JumpOffContact;
  event.time_ns = 5'300'000'123;
  event.z_m = 14e-9;
  session.events.push_back(event);
  return session;
}

std::string error_of(const std::string& path) {
  const auto session = load_session(path);
  if (session) return "accepted";
  EXPECT_EQ(session.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(session.error().message, HasSubstr(path));
  return session.error().message;
}

TEST(SessionFile, ComesBackAsItWasSaved) {
  const support::ScratchFolder folder;
  ASSERT_TRUE(save_session(example(), folder.file("s.afms")).has_value());
  const auto loaded = load_session(folder.file("s.afms"));
  ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
  EXPECT_EQ(loaded->material, "mica");
  EXPECT_EQ(loaded->parameters.contact.hamaker.si, 24.5e-21);
  EXPECT_TRUE(std::isinf(loaded->parameters.contact.sample_stiffness.si));
  EXPECT_EQ(loaded->parameters.contact.reduced_modulus.si, 51.5e9);
  EXPECT_EQ(loaded->parameters.law, physics::Law::Dmt);
  EXPECT_EQ(loaded->parameters.has_meniscus, 1U);
  EXPECT_EQ(loaded->parameters.meniscus.relative_humidity, 0.35);
  EXPECT_EQ(loaded->parameters.lever.quality_factor, 2.5);
  EXPECT_EQ(loaded->slow_motion, 37.0);
  EXPECT_FALSE(loaded->curve);
  EXPECT_FALSE(loaded->surface);
  EXPECT_TRUE(loaded->dead_man);
  EXPECT_EQ(loaded->room_from_sample[13], 1.5);
  EXPECT_STREQ(loaded->device.name.data(), "an Omni");
  EXPECT_EQ(loaded->device.max_slew_n_per_s, 400.0);
  EXPECT_TRUE(std::isinf(loaded->device.max_speed_m_per_s));
  EXPECT_EQ(loaded->device.workspace_min_m, example().device.workspace_min_m);
  EXPECT_EQ(loaded->hand_n_per_n, 1.43e9);
  ASSERT_EQ(loaded->samples.size(), 1000U);
  EXPECT_EQ(loaded->samples[999].tip.z_m, example().samples[999].tip.z_m);
  ASSERT_NE(loaded->find(physics::EventKind::JumpOffContact), nullptr);
  EXPECT_EQ(loaded->find(physics::EventKind::JumpToContact), nullptr);
  EXPECT_NEAR(loaded->seconds_since_start(loaded->events[0].time_ns), 0.300000123, 1e-12);
}

TEST(SessionFile, KeepsTheSourcesOfItsParameters) {
  const support::ScratchFolder folder;
  RecordedSession session = example();
  session.sources = R"({"tip_radius":{"estimated":false,"source":"Liu & Peng, Table 1","value":"50 nm"}})";
  ASSERT_TRUE(save_session(session, folder.file("s.afms")));
  EXPECT_EQ(load_session(folder.file("s.afms"))->sources, session.sources);
  session.sources = R"({"tip_radius":{"estimated":true,"source":null,"value":"50 nm"}})";
  ASSERT_TRUE(save_session(session, folder.file("d.afms")));
  EXPECT_THAT(error_of(folder.file("d.afms")), HasSubstr("its header is damaged"));
}

TEST(SessionFile, NamesTheProgramThatRecordedIt) {
  const support::ScratchFolder folder;
  ASSERT_TRUE(save_session(example(), folder.file("a.afms")));
  EXPECT_THAT(core::read_file(folder.file("a.afms")).value(),
              AllOf(HasSubstr("\"software\":\"TouchAFM\""),
                    HasSubstr(std::string("\"software_version\":\"") + core::kVersion + "\"")));
}

TEST(SessionFile, OfTheSameSessionHasTheSameBytes) {
  const support::ScratchFolder folder;
  ASSERT_TRUE(save_session(example(), folder.file("a.afms")).has_value());
  ASSERT_TRUE(save_session(example(), folder.file("b.afms")).has_value());
  EXPECT_EQ(core::read_file(folder.file("a.afms")).value(), core::read_file(folder.file("b.afms")).value());
}

// Three parts, each with a third of the samples.
std::string in_parts(const RecordedSession& whole, const std::string& path) {
  std::optional<SessionWriter> writer;
  RecordedSession part = whole;
  const std::size_t third = whole.samples.size() / 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto begin = whole.samples.begin() + static_cast<std::ptrdiff_t>(i * third);
    part.samples.assign(begin, i < 2 ? begin + static_cast<std::ptrdiff_t>(third) : whole.samples.end());
    part.events = i == 0 ? whole.events : std::vector<scene::TipEvent>{};
    if (!writer) writer.emplace(SessionWriter::create(part, path).value());
    EXPECT_TRUE(writer->add(part));
  }
  return core::read_file(path).value();  // file still open
}

TEST(SessionFile, CutAnywhereHoldsTheWholePartsBeforeTheCut) {
  const support::ScratchFolder folder;
  const std::string growing = in_parts(example(), folder.file("s.afms"));
  std::size_t longest = 0;
  for (std::size_t size = 0; size <= growing.size(); size += 1 + growing.size() / 300) {
    const std::string path = folder.write("cut.afms", growing.substr(0, size));
    const auto session = load_session(path);
    if (!session) {
      EXPECT_THAT(error_of(path), AnyOf(HasSubstr("truncated"), HasSubstr("not a TouchAFM session"))) << size;
      EXPECT_EQ(longest, 0U) << size;
      continue;
    }
    EXPECT_FALSE(session->complete);
    EXPECT_EQ(session->samples.size() % 333, 0U);
    EXPECT_GE(session->samples.size(), longest);
    EXPECT_EQ(session->samples.front().time_ns, 5'000'000'000);
    EXPECT_THAT(cut_text(*session, path), HasSubstr(longest < 600 ? "after 0." : "s;"));
    longest = session->samples.size();
  }
  EXPECT_EQ(longest, 666U);  // end without the last byte but one
  EXPECT_EQ(load_session(folder.file("s.afms"))->samples.size(), 1000U);
}

TEST(SessionFile, SavedWholeAndCutLaterLosesItsLastSecondAtMost) {
  const support::ScratchFolder folder;
  RecordedSession session = example();
  const RecordedSession first = session;
  for (int second = 1; second < 5; ++second) {
    for (scene::TipSample sample : first.samples) {
      sample.time_ns += second * 1'000'000'000LL;
      session.samples.push_back(sample);
    }
    session.events.push_back(session.events.back());
    session.events.back().time_ns += 1'000'000'000;
  }
  ASSERT_TRUE(save_session(session, folder.file("s.afms")));
  const std::string whole = core::read_file(folder.file("s.afms")).value();
  for (const std::size_t lost : {std::size_t{1}, whole.size() / 3, whole.size() / 2}) {
    const auto cut = load_session(folder.write("cut.afms", whole.substr(0, whole.size() - lost)));
    ASSERT_TRUE(cut) << cut.error().message;
    EXPECT_FALSE(cut->complete);
    const std::size_t kept = session.samples.size() * (whole.size() - lost) / whole.size();
    EXPECT_GE(cut->samples.size() + 1000, kept) << lost;
    EXPECT_EQ(cut->events.size(), cut->samples.size() / 1000) << "of the ticks that are there";
  }
  const auto loaded = load_session(folder.file("s.afms"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->complete);
  EXPECT_EQ(loaded->samples.size(), session.samples.size());
  ASSERT_EQ(loaded->events.size(), session.events.size());
  EXPECT_EQ(loaded->events.back().time_ns, session.events.back().time_ns);
}

TEST(SessionFile, OfAFinishedWriterIsThatOfASavedSession) {
  const support::ScratchFolder folder;
  const RecordedSession session = example();
  {
    SessionWriter writer = SessionWriter::create(session, folder.file("grown.afms")).value();
    ASSERT_TRUE(writer.add(session));
    ASSERT_TRUE(writer.finish());
  }
  ASSERT_TRUE(save_session(session, folder.file("saved.afms")));
  EXPECT_EQ(core::read_file(folder.file("grown.afms")).value(), core::read_file(folder.file("saved.afms")).value());
  EXPECT_TRUE(load_session(folder.file("grown.afms"))->complete);
}

TEST(SessionFile, ThatGrowsReplacesNothingAndFollowsNoLink) {
  const support::ScratchFolder folder;
  folder.write("there.afms", "mine");
  std::filesystem::create_symlink(folder.file("target"), folder.file("link.afms"));
  EXPECT_FALSE(SessionWriter::create(example(), folder.file("there.afms")));
  EXPECT_FALSE(SessionWriter::create(example(), folder.file("link.afms")));
  EXPECT_EQ(core::read_file(folder.file("there.afms")).value(), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder.file("target")));
}

// 0.1.0's bytes: tests/formats/README.md.
TEST(SessionFile, OfVersion010IsRead) {
  const auto session = load_session(support::source("tests/formats/0.1.0/session-gold.afms"));
  ASSERT_TRUE(session) << session.error().message;
  EXPECT_EQ(session->material, "gold");
  EXPECT_TRUE(session->complete);
  EXPECT_TRUE(session->wall.empty());
  EXPECT_GE(session->events.size(), 2U);
}

TEST(SessionFile, CarriesWhatTheWallShowed) {
  const support::ScratchFolder folder;
  RecordedSession session = example();
  session.shown = {"mica", "gold"};
  session.earlier_curves = {{.material = "gold", .points = {{1.5, -0.25}, {0.1, 1e-17}}}};
  WallFrame frame{.time_ns = 5'000'000'000, .centerpiece = "instrument", .ipd_m = 0.063, .stereo = "mono"};
  frame.navigation[0] = frame.navigation[5] = frame.navigation[10] = frame.navigation[15] = 1.0;
  session.wall.push_back(frame);
  frame.time_ns += 16'000'000;
  frame.wand = RecordedWand{.pose = {.position_m = {0.1, 1.0 / 3.0, -2e-7}}, .connected = true, .buttons = 5};
  frame.guidance = "Dr\u00fccken";
  frame.servo_row = {{"ticks", "12 \u00b5s", "clock"}};
  frame.scan = RecordedScan{.frame = 1, .pixel = 40, .truth = true};
  frame.scan_hand = RecordedHandPart{.paints = true, .feedback = false, .side_m = 1e-7, .first_tick = 1234};
  frame.scan_changes = {{.frame = 0, .pixel = 0, .setpoint_n = 2e-9, .gain_per_s = 2000, .tip_radius_m = 1.0 / 3e8},
                        {.frame = 1, .pixel = 7, .setpoint_n = 1e-9, .apex_distance_m = 1e-8},
                        {.frame = 1, .pixel = 9, .setpoint_n = 0.8, .free_amplitude_m = 15e-9, .drive_hz = 299'850.0}};
  frame.map = RecordedMapView{"modulus", true, -1e-9 / 3.0, 1e7 / 3.0, 0.03};
  frame.lines = RecordedLines{{{{-8e-8, 1e-7 / 3.0}, {8e-8, 0.0}, {0.0, -1e-9}}, {{0.0, 0.0}, {1e-9, 1e-9}}}, 2e-8};
  session.wall.push_back(frame);
  frame.wand.reset();
  frame.head.position_m = {0.3, 1.7, 2.0};
  session.wall.push_back(frame);
  ASSERT_TRUE(save_session(session, folder.file("w.afms")));
  const auto loaded = load_session(folder.file("w.afms"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->wall, session.wall);
  EXPECT_EQ(loaded->shown, session.shown);
  EXPECT_EQ(loaded->earlier_curves, session.earlier_curves);

  session.wall[1].head.orientation = {0.0, 0.0, 0.0, 0.0};
  ASSERT_TRUE(save_session(session, folder.file("w.afms")));
  EXPECT_THAT(error_of(folder.file("w.afms")), HasSubstr("its state of the wall is impossible"));
}

TEST(SessionFile, AlteredInAnyByteIsRefused) {
  const support::ScratchFolder folder;
  ASSERT_TRUE(save_session(example(), folder.file("s.afms")).has_value());
  const std::string whole = core::read_file(folder.file("s.afms")).value();
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 200) {
    std::string altered = whole;
    altered[at] = static_cast<char>(altered[at] ^ 0x40);
    EXPECT_NE(error_of(folder.write("altered.afms", altered)), "accepted") << at;
  }
}

TEST(SessionFile, OfAnotherVersionNamesBoth) {
  const support::ScratchFolder folder;
  EXPECT_THAT(
      error_of(folder.write("new.afms", std::string("AFMS\x10\0\0\0", 8))),
      HasSubstr("version is 16; this program reads versions 3, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 17, 18, 19, 20"));
  // between the two releases
  EXPECT_THAT(error_of(folder.write("between.afms", std::string("AFMS\x04\0\0\0", 8))), HasSubstr("version is 4;"));
}

TEST(SessionFile, WithAnEventOfAnUnknownKindIsRefused) {
  const support::ScratchFolder folder;
  RecordedSession session = example();
  session.events.at(0).kind = static_cast<physics::EventKind>(99);
  ASSERT_TRUE(save_session(session, folder.file("s.afms")));
  EXPECT_THAT(error_of(folder.file("s.afms")), HasSubstr("an event of an unknown kind"));
}

TEST(SessionFile, CarriesTheCurveThatWasFelt) {
  const support::ScratchFolder folder;
  RecordedSession session = example();
  session.parameters.dynamic = 0;
  session.parameters.law = physics::Law::Measured;
  session.parameters.measured_curve = 0;
  scene::SharedMeasuredCurve& curve = session.curve.emplace();
  curve.approach_count = curve.retract_count = 2;
  curve.approach[1] = curve.retract[1] = {physics::Length(3e-9), physics::Force(-0.2e-9)};
  curve.jumps = {.approach = 1, .retract = 2};
  curve.column = 3;
  curve.row = 12;
  ASSERT_TRUE(save_session(session, folder.file("m.afms")).has_value());
  const auto loaded = load_session(folder.file("m.afms"));
  ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
  ASSERT_TRUE(loaded->curve);
  EXPECT_EQ(loaded->curve->retract_count, 2U);
  EXPECT_EQ(loaded->curve->retract[1].force.si, -0.2e-9);
  EXPECT_EQ(loaded->curve->jumps.approach, 1U);
  EXPECT_EQ(loaded->curve->jumps.retract, 2U);
  EXPECT_EQ(loaded->curve->column, 3);
  EXPECT_EQ(loaded->curve->row, 12);
}

TEST(SessionFile, CarriesTheSurfaceThatWasFelt) {
  const support::ScratchFolder folder;
  RecordedSession session = example();
  scene::SharedHeightField& surface = session.surface.emplace();
  surface.columns = surface.rows = 5;
  surface.spacing_m = 10e-9;
  surface.height_m[7] = 1.25e-9F;
  ASSERT_TRUE(save_session(session, folder.file("t.afms")).has_value());
  const auto loaded = load_session(folder.file("t.afms"));
  ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
  EXPECT_EQ(loaded->surface.value().height_m, surface.height_m);
  EXPECT_EQ(loaded->parameters.height_field, 0U);

  EXPECT_EQ(loaded->parameters.surface_release_m, 0.0) << "as in a session of a TouchAFM without it";
  session.parameters.surface_release_m = 14e-9 / 3.0;
  ASSERT_TRUE(save_session(session, folder.file("t.afms")).has_value());
  EXPECT_EQ(load_session(folder.file("t.afms")).value().parameters.surface_release_m, 14e-9 / 3.0);
  session.parameters.surface_release_m = -1.0;
  ASSERT_TRUE(save_session(session, folder.file("t.afms")).has_value());
  EXPECT_THAT(error_of(folder.file("t.afms")), HasSubstr("release that belongs to its surface"));
  session.parameters.surface_release_m = 0.0;

  surface.height_m[8] = std::nanf("");
  ASSERT_TRUE(save_session(session, folder.file("t.afms")).has_value());
  EXPECT_THAT(error_of(folder.file("t.afms")), HasSubstr("not a grid of heights"));
}

TEST(SessionFile, CarriesTheTopographyThatWasFelt) {
  const support::ScratchFolder folder;
  RecordedSession session = example();
  session.topography = {
      .columns = 3, .rows = 2, .spacing_m = 10e-9, .height_m = {0, 1e-9F, 2e-9F, 3e-9F, 4e-9F, 5e-9F}};
  session.parameters.height_field = scene::kTopography;
  session.parameters.topography = {.lateral = 0.25, .vertical = 0.5};
  ASSERT_TRUE(save_session(session, folder.file("t.afms")).has_value());
  const auto loaded = load_session(folder.file("t.afms"));
  ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
  EXPECT_EQ(loaded->topography.columns, 3U);
  EXPECT_EQ(loaded->topography.rows, 2U);
  EXPECT_EQ(loaded->topography.spacing_m, 10e-9);
  EXPECT_EQ(loaded->topography.height_m, session.topography.height_m);
  EXPECT_EQ(loaded->parameters.height_field, scene::kTopography);
  EXPECT_EQ(loaded->parameters.topography.vertical, 0.5);

  session.topography.height_m[2] = std::nanf("");
  ASSERT_TRUE(save_session(session, folder.file("t.afms")).has_value());
  EXPECT_THAT(error_of(folder.file("t.afms")), HasSubstr("not a grid of heights"));
  session.topography.height_m.pop_back();
  ASSERT_TRUE(save_session(session, folder.file("t.afms")).has_value());
  EXPECT_THAT(error_of(folder.file("t.afms")), HasSubstr("not a grid of heights"));
}

TEST(SessionFile, OfADeviceThatCannotBeIsRefused) {
  const support::ScratchFolder folder;
  RecordedSession session = example();
  session.device.max_force_n = -1.0;
  ASSERT_TRUE(save_session(session, folder.file("d.afms")).has_value());
  EXPECT_THAT(error_of(folder.file("d.afms")), HasSubstr("the limits of its device are impossible"));
}

TEST(SessionFile, WithParametersThatNoMicroscopeHasIsRefused) {
  const support::ScratchFolder folder;
  RecordedSession session = example();
  session.parameters.contact.tip_radius.si = -1.0;
  ASSERT_TRUE(save_session(session, folder.file("bad.afms")).has_value());
  EXPECT_THAT(error_of(folder.file("bad.afms")), HasSubstr("tip radius"));
}

TEST(SessionFile, WithNumbersThatAreNotFiniteIsRefused) {
  const support::ScratchFolder folder;
  RecordedSession session = example();
  session.samples[500].tip.force_n = std::nan("");
  ASSERT_TRUE(save_session(session, folder.file("nan.afms")).has_value());
  EXPECT_THAT(error_of(folder.file("nan.afms")), HasSubstr("not finite"));
}

TEST(SessionFile, ThatIsSomethingElseIsNamedSo) {
  const support::ScratchFolder folder;
  EXPECT_THAT(error_of(folder.write("picture.png", "\x89PNG and so on")), HasSubstr("not a TouchAFM session"));
}

}  // namespace session_file_test
}  // namespace afm::servo
