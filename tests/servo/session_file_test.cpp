// SPDX-License-Identifier: Apache-2.0
#include "servo/session_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/whole_file.h"
#include "haptics/device.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace {

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

TEST(SessionFile, OfTheSameSessionHasTheSameBytes) {
  const support::ScratchFolder folder;
  ASSERT_TRUE(save_session(example(), folder.file("a.afms")).has_value());
  ASSERT_TRUE(save_session(example(), folder.file("b.afms")).has_value());
  EXPECT_EQ(core::read_file(folder.file("a.afms")).value(), core::read_file(folder.file("b.afms")).value());
}

TEST(SessionFile, CutAnywhereIsRefused) {
  const support::ScratchFolder folder;
  ASSERT_TRUE(save_session(example(), folder.file("s.afms")).has_value());
  const std::string whole = core::read_file(folder.file("s.afms")).value();
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 200) {
    EXPECT_NE(error_of(folder.write("cut.afms", whole.substr(0, size))), "accepted") << size;
  }
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
  EXPECT_THAT(error_of(folder.write("new.afms", std::string("AFMS\x09\0\0\0", 8))),
              HasSubstr("version 9, this program reads version 3"));
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
  ASSERT_TRUE(save_session(session, folder.file("m.afms")).has_value());
  const auto loaded = load_session(folder.file("m.afms"));
  ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
  ASSERT_TRUE(loaded->curve);
  EXPECT_EQ(loaded->curve->retract_count, 2U);
  EXPECT_EQ(loaded->curve->retract[1].force.si, -0.2e-9);
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

  surface.height_m[8] = std::nanf("");
  ASSERT_TRUE(save_session(session, folder.file("t.afms")).has_value());
  EXPECT_THAT(error_of(folder.file("t.afms")), HasSubstr("no grid of heights"));
}

TEST(SessionFile, OfADeviceThatCannotBeIsRefused) {
  const support::ScratchFolder folder;
  RecordedSession session = example();
  session.device.max_force_n = -1.0;
  ASSERT_TRUE(save_session(session, folder.file("d.afms")).has_value());
  EXPECT_THAT(error_of(folder.file("d.afms")), HasSubstr("its device has limits that cannot be"));
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

}  // namespace
}  // namespace afm::servo
