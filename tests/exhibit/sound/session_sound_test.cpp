// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/session_sound.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/written_by.h"
#include "exhibit/sound/stream_clock.h"
#include "exhibit/sound/wav_file.h"
#include "haptics/contact_model.h"
#include "support/paper_model.h"
#include "support/sound_analysis.h"

namespace afm::exhibit {
namespace session_sound_test {

constexpr std::int64_t kStartNs = 200'000'000;

// Three seconds on mica: without a force at first, or with this one all the time.
servo::RecordedSession session_with(scene::ServoState state, double force_n) {
  servo::RecordedSession session;
  session.material = "mica";
  session.parameters = test::paper_model().materials[test::kMica];
  for (std::int64_t ms = 0; ms < 3000; ++ms) {
    scene::TipSample sample{.time_ns = kStartNs + ms * 1'000'000};
    sample.material = 0;
    sample.servo_state = state;
    sample.phase = physics::Phase::Attached;
    sample.tip.force_n = force_n;
    session.samples.push_back(sample);
  }
  return session;
}

std::ptrdiff_t first_sound(const std::vector<double>& samples) {
  return std::find_if(samples.begin(), samples.end(), [](double s) { return s != 0.0; }) - samples.begin();
}

TEST(SessionSound, BeginsEachEventWithTheSampleNearestToItsTime) {  // D07
  servo::RecordedSession session = session_with(scene::ServoState::Disarmed, 0.0);
  session.events.push_back(
      {.kind = physics::EventKind::JumpToContact, .material = 0, .time_ns = 1'234'567'800, .force_after_n = -0.24e-9});
  const auto sound = sound_of(session, Channels::Stereo, 1.0).value();
  // that sample itself is the zero from which the sine rises
  EXPECT_EQ(first_sound(test::channel(sound, 0)), 49659 + 1);
}

TEST(SessionSound, HasThePitchOfTheForce) {
  const auto tables = haptics::build_tables(test::paper_model().materials[test::kMica], {}).value();
  for (const double force_n : {tables->figures.force_before_joc.si, tables->figures.force_after_jtc.si}) {
    const auto sound = sound_of(session_with(scene::ServoState::Running, force_n), Channels::Stereo, 1.0).value();
    const auto left = test::channel(sound, 0);
    EXPECT_LT(
        std::abs(test::cents(test::pitch_hz(std::span(left).subspan(48'000, 16'384), 48e3), Ear(*tables).hz(force_n))),
        1.0);
  }
}

TEST(SessionSound, IsTheSameEveryTimeAndAsLoudAsAsked) {
  servo::RecordedSession session = session_with(scene::ServoState::Running, -1e-9);
  for (int i = 0; i < 20; ++i) {
    session.events.push_back({.kind = physics::EventKind::Slip, .material = 0, .time_ns = kStartNs + 77'777'777LL * i});
  }
  const auto sound = sound_of(session, Channels::Stereo, 1.0).value();
  EXPECT_EQ(sound, sound_of(session, Channels::Stereo, 1.0).value());
  const auto quiet = sound_of(session, Channels::Stereo, 0.5).value();
  EXPECT_NEAR(test::rms(test::channel(quiet, 0)), 0.5 * test::rms(test::channel(sound, 0)), 1e-6);
  const auto mono = sound_of(session, Channels::Mono, 1.0).value();
  EXPECT_EQ(test::channel(mono, 0), test::channel(mono, 1));
  EXPECT_EQ(sound.size(), 2U * (2999U * 48U + 48'000U)) << "a second more than the session";
  const std::string wav = wav_bytes(sound);
  EXPECT_EQ(wav.rfind("LIST"), 44 + 2 * sound.size());
  EXPECT_THAT(wav, testing::HasSubstr(core::written_by()));
  EXPECT_EQ(wav.substr(0, 4) + wav.substr(8, 8), "RIFFWAVEfmt ");
}

TEST(SessionSound, OfAnEndlessSessionIsRefused) {
  servo::RecordedSession session = session_with(scene::ServoState::Running, 0.0);
  session.samples.back().time_ns = kStartNs + 4'000'000'000'000;
  const auto sound = sound_of(session, Channels::Stereo, 1.0);
  ASSERT_FALSE(sound.has_value());
  EXPECT_THAT(sound.error().message, testing::HasSubstr("longer than an hour"));
}

}  // namespace session_sound_test
}  // namespace afm::exhibit
