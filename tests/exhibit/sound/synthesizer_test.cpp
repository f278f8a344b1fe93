// SPDX-License-Identifier: Apache-2.0
// Invariant: sound depends only on samples and events, without clicks, at most -1 dBFS; its thread neither allocates
// nor locks
#include "exhibit/sound/synthesizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <span>
#include <vector>

#include "core/enumerators.h"
#include "exhibit/sound/sound_mixer.h"
#include "exhibit/sound/stream_clock.h"
#include "support/no_alloc.h"
#include "support/sound_analysis.h"

namespace afm::exhibit {
namespace synthesizer_test {

constexpr double kRate = kSoundRateHz;
// The steepest that a sine of this pitch and its octave can be between two samples.
double steepest(double hz, double amplitude) { return 4.0 * std::numbers::pi * hz / kRate * amplitude; }

std::vector<float> sound(Synthesizer& synthesizer, double seconds) {
  std::vector<float> samples(2 * static_cast<std::size_t>(seconds * kRate));
  synthesizer.add_to(samples);
  return samples;
}

std::vector<float> event_alone(HeardEvent event, std::int64_t at = 0, Channels channels = Channels::Stereo) {
  Synthesizer synthesizer(channels);
  synthesizer.play(at, event, 0.0);
  return sound(synthesizer, 1.0);
}

TEST(SoundOfAForce, HasItsPitchWithinACent) {
  const Ear ear(0.5 * 0.239752e-9, 1.399894e-9);
  for (const double force_n : {-1.399894e-9, -0.239752e-9, -0.05e-9, 0.3e-9, 2e-9}) {
    Synthesizer synthesizer(Channels::Stereo);
    synthesizer.set_tone(0, ear.tone(force_n));
    const auto samples = test::channel(sound(synthesizer, 0.5), force_n < 0 ? 0 : 1);
    const std::span<const double> steady(samples.data() + 4800, 16384);
    EXPECT_LT(std::abs(test::cents(test::pitch_hz(steady, kRate), ear.hz(force_n))), 1.0) << force_n;
  }
}

TEST(SoundOfAForce, IsOnTheSideOfPullOrPush) {
  const Ear ear(1e-10, 1.4e-9);
  for (const double force_n : {-1e-9, 1e-9}) {
    Synthesizer synthesizer(Channels::Stereo);
    synthesizer.set_tone(0, ear.tone(force_n));
    const auto samples = sound(synthesizer, 0.5);
    const double left = test::rms(test::channel(samples, 0)), right = test::rms(test::channel(samples, 1));
    if (force_n < 0) {
      EXPECT_GT(left, 2.0 * right);
    } else {
      EXPECT_GT(right, 2.0 * left);
    }
    EXPECT_GT(std::min(left, right), 0.001) << "no ear is left without";
  }
}

TEST(SoundOfAForce, IsTheSameOnBothSidesInMonoWhereAPushHasItsOctave) {
  const Ear ear(1e-10, 1.4e-9);
  const auto octave_share = [&](double force_n) {
    Synthesizer synthesizer(Channels::Mono);
    synthesizer.set_tone(0, ear.tone(force_n));
    const auto samples = sound(synthesizer, 0.5);
    EXPECT_EQ(test::channel(samples, 0), test::channel(samples, 1));
    const auto left = test::channel(samples, 0);
    const std::span<const double> steady(left.data() + 4800, 16384);
    const double hz = ear.hz(force_n);
    return test::amplitude(steady, 2.0 * hz, kRate) / test::amplitude(steady, hz, kRate);
  };
  EXPECT_LT(octave_share(-1e-9), 0.02);
  EXPECT_GT(octave_share(1e-9), 0.4);
}

TEST(SoundOfAForce, GlidesAndFallsSilentWithoutAClick) {
  const Ear ear(1e-10, 1.4e-9);
  Synthesizer synthesizer(Channels::Stereo);
  std::vector<float> all;
  // a jump of the force within a tick, a side that changes, an end
  const double forces[] = {0.0, 0.0, -1.4e-9, -1.4e-9, 3e-9, 3e-9, -0.2e-9};
  std::int64_t at = 0;
  for (const double force_n : forces) {
    for (int tick = 0; tick < 50; ++tick, at += 48) synthesizer.set_tone(at, ear.tone(force_n));
    const auto samples = sound(synthesizer, 0.05);
    all.insert(all.end(), samples.begin(), samples.end());
  }
  synthesizer.set_tone(at, {.hz = ear.hz(-0.2e-9), .level = 0});
  const auto end = sound(synthesizer, 0.2);
  all.insert(all.end(), end.begin(), end.end());
  for (const std::size_t side : {0U, 1U}) {
    EXPECT_LT(test::largest_step(test::channel(all, side)), steepest(note_hz(96), 0.16));
  }
  const auto left = test::channel(end, 0);
  EXPECT_LT(test::rms(std::span<const double>(left).last(4800)), 1e-6) << "silent at last";
}

TEST(SoundOfAnEvent, BeginsWithItsSampleAndEndsWithoutAClick) {
  for (const HeardEvent event : core::kEnumerators<HeardEvent>) {
    constexpr std::int64_t kAt = 12'345;
    const auto left = test::channel(event_alone(event, kAt), 0);
    const auto first = std::find_if(left.begin(), left.end(), [](double sample) { return sample != 0.0; });
    ASSERT_NE(first, left.end()) << core::index_of(event);
    EXPECT_LE(std::abs(first - left.begin() - kAt), 2) << core::index_of(event);
    const Signal& signal = row_of(event).signal;
    double bound = 0;
    for (const SignalNote& note : signal.notes) {
      // the waves and the envelope, whose attack is no shorter than a click's
      bound = std::max(bound, steepest(std::max(note.from_hz, note.to_hz), note.level) + note.level * 0.0066);
    }
    EXPECT_LT(test::largest_step(left), bound) << core::index_of(event);
    EXPECT_LT(std::abs(left.back()), 1e-12) << core::index_of(event);
    EXPECT_LT(signal.length_s(), 0.6) << "an earcon is short";
  }
}

TEST(SoundOfAnEvent, IsUnlikeThatOfAnyOther) {
  std::set<std::vector<double>> sounds;
  for (const HeardEvent event : core::kEnumerators<HeardEvent>) sounds.insert(test::channel(event_alone(event), 0));
  EXPECT_EQ(sounds.size(), core::kEnumerators<HeardEvent>.size());
}

TEST(SoundOfAnEvent, IsHeardOnTheSideOfItsForce) {
  Synthesizer synthesizer(Channels::Stereo);
  synthesizer.play(0, HeardEvent::SnapIn, -0.75);
  const auto samples = sound(synthesizer, 0.3);
  EXPECT_GT(test::rms(test::channel(samples, 0)), 2.0 * test::rms(test::channel(samples, 1)));
}

TEST(SoundOfSlips, IsAClickForEachOne) {
  Synthesizer synthesizer(Channels::Mono);
  constexpr int kSlips = 8;
  constexpr std::int64_t kApart = 1440;  // 30 ms
  for (int i = 0; i < kSlips; ++i) synthesizer.play(480 + i * kApart, HeardEvent::Slip, 0.0);
  const auto left = test::channel(sound(synthesizer, 0.5), 0);
  int clicks = 0;
  for (std::size_t i = 48; i < left.size(); ++i) {
    const bool silent_before =
        std::all_of(left.begin() + static_cast<std::ptrdiff_t>(i) - 48, left.begin() + static_cast<std::ptrdiff_t>(i),
                    [](double s) { return s == 0.0; });
    clicks += silent_before && left[i] != 0.0 ? 1 : 0;
  }
  EXPECT_EQ(clicks, kSlips);
}

TEST(Synthesizer, StaysBelowItsLimitWhateverIsHeard) {
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> event(0, static_cast<int>(core::kEnumerators<HeardEvent>.size()) - 1);
  Synthesizer synthesizer(Channels::Stereo);
  synthesizer.set_tone(0, {.hz = 1000, .level = 1, .side = 0, .edge = 1});
  for (int block = 0; block < 200; ++block) {
    for (int i = 0; i < 20; ++i) {
      synthesizer.play(synthesizer.position() + 13 * i,
                       core::kEnumerators<HeardEvent>[static_cast<std::size_t>(event(random))], 0.3);
    }
    std::vector<float> loud(512, 0.8F);  // a voice
    synthesizer.add_to(loud);
    for (const float sample : loud) ASSERT_LE(std::abs(sample), Synthesizer::kLoudest + 1e-6);
  }
}

TEST(Synthesizer, GivesTheSameSamplesWhateverTheBlocks) {
  const auto play = [](std::size_t frames) {
    Synthesizer synthesizer(Channels::Stereo);
    synthesizer.set_tone(100, {.hz = 440, .level = 1, .side = -0.5, .edge = 0});
    synthesizer.set_tone(9000, {.hz = 660, .level = 0.5, .side = 0.5, .edge = 1});
    synthesizer.play(5000, HeardEvent::PullOff, -0.2);
    std::vector<float> all;
    while (all.size() < 2 * 24'000) {
      std::vector<float> block(2 * frames);
      synthesizer.add_to(block);
      all.insert(all.end(), block.begin(), block.end());
    }
    all.resize(2 * 24'000);
    return all;
  };
  EXPECT_EQ(play(256), play(1));
  EXPECT_EQ(play(256), play(1000));
}

// ---- the mixer, as the sound card pulls from it

struct Card {
  SoundMixer mixer{Channels::Stereo};
  std::int64_t now_ns = 10'000'000'000;
  std::int64_t begun_ns = now_ns;
  std::vector<float> played;

  void pull(double seconds) {
    const auto blocks = static_cast<int>(std::lround(seconds * kRate / 256));
    for (int i = 0; i < blocks; ++i) {
      std::array<float, 512> block{};
      {
        const test::NoAllocation none;
        mixer.fill(block, now_ns);
      }
      played.insert(played.end(), block.begin(), block.end());
      now_ns += static_cast<std::int64_t>(256e9 / kRate);
    }
  }
};

TEST(SoundMixer, LetsAnEventBeHeardWithin30Milliseconds) {
  Card card;
  card.mixer.set_ear(0, Ear(1e-10, 1e-9));
  card.pull(0.5);
  const std::int64_t event_ns = card.now_ns - 4'321'000;  // 4 ms ago
  card.mixer.heard(scene::TipEvent{
      .kind = physics::EventKind::JumpToContact, .material = 0, .time_ns = event_ns, .force_after_n = -1e-9});
  card.pull(0.3);
  const auto left = test::channel(card.played, 0);
  const auto first = std::find_if(left.begin(), left.end(), [](double sample) { return sample != 0.0; });
  ASSERT_NE(first, left.end());
  const double heard_ns = static_cast<double>(card.begun_ns) + static_cast<double>(first - left.begin()) / kRate * 1e9;
  const double late_ms = (heard_ns - static_cast<double>(event_ns)) * 1e-6;
  constexpr double kBuffersMs = 2 * 256 / 48.0;  // latency of a card's two buffers
  EXPECT_NEAR(late_ms, 1e-6 * SoundMixer::kDelayNs, 0.1) << "as long after as any other event";
  EXPECT_LT(late_ms + kBuffersMs, 30.0);
}

TEST(SoundMixer, KeepsTheRhythmOfEventsThatItLearnsOfLate) {
  Card card;
  card.mixer.set_ear(0, Ear(1e-10, 1e-9));
  card.pull(0.2);
  // five slips, of which the mixer learns 3 ms to 9 ms later
  std::vector<double> times;
  for (int i = 0; i < 5; ++i) {
    card.pull(0.02);
    const std::int64_t at_ns = card.now_ns - (i % 2 == 0 ? 9'000'000 : 3'000'000);
    times.push_back(1e-9 * static_cast<double>(at_ns - card.begun_ns));
    card.mixer.heard(scene::TipEvent{.kind = physics::EventKind::Slip, .material = 0, .time_ns = at_ns});
  }
  card.pull(0.2);
  const auto left = test::channel(card.played, 0);
  std::vector<double> heard;
  std::size_t silent = 1000;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (left[i] != 0.0 && silent > 96) heard.push_back(static_cast<double>(i) / kRate);
    silent = left[i] == 0.0 ? silent + 1 : 0;
  }
  ASSERT_EQ(heard.size(), times.size());
  for (std::size_t i = 1; i < heard.size(); ++i) {
    EXPECT_NEAR(heard[i] - heard[0], times[i] - times[0], 0.0001) << i;
  }
}

TEST(SoundMixer, CutsAVoiceOffForANewerOneWithoutAClick) {
  Card card;
  const auto speak = [&](std::uint32_t phrase, float level) {
    for (int block = 0; block < 20; ++block) {
      VoiceBlock voice{.phrase = phrase, .count = VoiceBlock::kSamples};
      voice.samples.fill(level);
      card.mixer.speak(voice);
    }
  };
  card.mixer.cut_voice(1);
  speak(1, 0.4F);
  card.pull(0.1);
  const auto before = test::channel(card.played, 0);
  EXPECT_NEAR(before.back(), 0.4, 1e-3);
  card.mixer.cut_voice(2);
  speak(2, -0.3F);
  card.pull(0.05);
  const auto after = test::channel(card.played, 0);
  EXPECT_NEAR(after.back(), -0.3, 1e-3) << "the rest of the first is gone";
  EXPECT_LT(test::largest_step(after), 0.01);
}

TEST(SoundMixer, IsSilentWithoutVolumeAndSpeaksWithoutTones) {
  Card card;
  card.mixer.set_ear(0, Ear(1e-10, 1e-9));
  card.mixer.set_tones(false);
  card.mixer.happened({.event = HeardEvent::Fault, .time_ns = card.now_ns});
  card.pull(0.6);
  EXPECT_EQ(test::rms(test::channel(card.played, 0)), 0.0);
  card.mixer.set_tones(true);
  card.mixer.set_volume(0.0);
  card.pull(0.1);
  card.played.clear();
  card.mixer.happened({.event = HeardEvent::Fault, .time_ns = card.now_ns});
  card.pull(0.6);
  EXPECT_LT(test::rms(test::channel(card.played, 0)), 1e-5);
}

}  // namespace synthesizer_test
}  // namespace afm::exhibit
