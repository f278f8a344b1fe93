// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/synthesizer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "exhibit/sound/stream_clock.h"

namespace afm::exhibit {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kToneAmplitude = 0.16;
constexpr double kOctaveShare = 0.5;  // amplitude of the octave at full edge
constexpr double kFollowS = 0.004;
constexpr double kAttackS = 0.005;
constexpr double kKnee = 0.6;
constexpr double kHissBand = 3.0;  // number of random values in a period of the tone

// One period with its octave, no louder than a pure tone.
double wave(double phase, double edge) noexcept {
  const double octave = kOctaveShare * edge;
  return (std::sin(kTurn * phase) + octave * std::sin(2.0 * kTurn * phase)) / (1.0 + octave);
}

double bent(double sample) noexcept {
  const double size = std::abs(sample);
  if (size <= kKnee) return sample;
  constexpr double kRoom = Synthesizer::kLoudest - kKnee;
  return std::copysign(kKnee + kRoom * std::tanh((size - kKnee) / kRoom), sample);
}

double envelope(double time_s, double length_s) noexcept {
  const double attack_s = std::min(kAttackS, 0.5 * length_s);
  return rise(time_s, attack_s) * rise(length_s - time_s, std::max(attack_s, 0.6 * length_s));
}

double mixed(double a, double b, double share) noexcept { return a + (b - a) * share; }

}  // namespace

Pan pan(double side) {
  const double angle = 0.25 * std::numbers::pi * (side + 1.0);
  return {std::cos(angle), std::sin(angle)};
}

double rise(double time_s, double length_s) {
  return 0.5 - 0.5 * std::cos(std::numbers::pi * std::clamp(time_s / length_s, 0.0, 1.0));
}

// Value between two random numbers of xorshift32 (Marsaglia, J. Stat. Softw. 8 (2003) 14), always the same sequence.
double Synthesizer::Noise::next(double share) noexcept {
  for (along += share; along >= 1.0; along -= 1.0) {
    state ^= state << 13U;
    state ^= state >> 17U;
    state ^= state << 5U;
    from = std::exchange(to, 2.0 * static_cast<double>(state) / 4294967295.0 - 1.0);
  }
  return mixed(from, to, rise(along, 1.0));
}

void Synthesizer::Followed::step() noexcept { now += (wanted - now) / (kFollowS * kSoundRateHz); }

void Synthesizer::set_tone(std::int64_t at, const Tone& tone) noexcept {
  if (point_count_ == kPoints) {  // full queue, not read for a long time: the oldest point, which is past, is dropped
    from_ = points_[first_point_];
    first_point_ = (first_point_ + 1) % kPoints;
    --point_count_;
  }
  points_[(first_point_ + point_count_) % kPoints] = {std::max(at, position_), tone};
  ++point_count_;
}

void Synthesizer::play(std::int64_t at, HeardEvent event, double side) noexcept {
  const bool often = event == HeardEvent::Slip || event == HeardEvent::ParticleGave;
  const std::size_t most = often ? kVoicesOfSlips : kVoices;
  for (std::size_t i = 0; i < most; ++i) {
    if (voices_[i].busy) continue;
    voices_[i] = {std::max(at, position_), event, pan(channels_ == Channels::Mono ? 0.0 : side), {}, true};
    return;
  }
}

Tone Synthesizer::tone_now() noexcept {
  while (point_count_ > 0 && points_[first_point_].at <= position_) {
    from_ = points_[first_point_];
    first_point_ = (first_point_ + 1) % kPoints;
    --point_count_;
  }
  if (point_count_ == 0) return from_.tone;
  const Point& to = points_[first_point_];
  // no glide out of silence
  if (from_.tone.hz <= 0.0 || to.tone.hz <= 0.0) return from_.tone;
  const double share =
      static_cast<double>(position_ - from_.at) / static_cast<double>(std::max<std::int64_t>(1, to.at - from_.at));
  return {.hz = from_.tone.hz * std::pow(to.tone.hz / from_.tone.hz, share),
          .level = mixed(from_.tone.level, to.tone.level, share),
          .side = mixed(from_.tone.side, to.tone.side, share),
          .edge = mixed(from_.tone.edge, to.tone.edge, share),
          .hiss = mixed(from_.tone.hiss, to.tone.hiss, share)};
}

Synthesizer::Frame Synthesizer::next_of_tone() noexcept {
  const Tone tone = tone_now();
  level_.wanted = tone.level;
  side_.wanted = channels_ == Channels::Mono ? 0.0 : tone.side;
  edge_.wanted = tone.edge;
  hiss_.wanted = tone.hiss;
  level_.step();
  side_.step();
  edge_.step();
  hiss_.step();
  tone_gain_.step();
  double shape = wave(phase_, edge_.now);
  if (hiss_.now != 0.0) shape = mixed(shape, noise_.next(kHissBand * tone.hz / kSoundRateHz), hiss_.now);
  const double sample = kToneAmplitude * level_.now * tone_gain_.now * shape;
  phase_ += tone.hz / kSoundRateHz;
  phase_ -= std::floor(phase_);
  const Pan sides = pan(side_.now);
  return {sides.left * sample, sides.right * sample};
}

void Synthesizer::add_voice(Voice& voice, Frame& frame) const noexcept {
  if (!voice.busy || position_ < voice.at) return;
  const double time_s = static_cast<double>(position_ - voice.at) / kSoundRateHz;
  const Signal& signal = row_of(voice.event).signal;
  double sample = 0.0;
  for (std::size_t i = 0; i < signal.notes.size(); ++i) {
    const SignalNote& note = signal.notes[i];
    const double into_s = time_s - note.start_s;
    if (into_s < 0.0 || into_s >= note.length_s) continue;
    sample += note.level * envelope(into_s, note.length_s) * wave(voice.phase[i], note.edge);
    voice.phase[i] += note.from_hz * std::pow(note.to_hz / note.from_hz, into_s / note.length_s) / kSoundRateHz;
  }
  frame.left += voice.pan.left * sample;
  frame.right += voice.pan.right * sample;
  voice.busy = time_s < signal.length_s();
}

void Synthesizer::add_to(std::span<float> interleaved) noexcept {
  for (std::size_t i = 0; i + 1 < interleaved.size(); i += 2) {
    Frame frame = next_of_tone();
    for (Voice& voice : voices_) add_voice(voice, frame);
    gain_.step();
    interleaved[i] = static_cast<float>(bent(gain_.now * (frame.left + static_cast<double>(interleaved[i]))));
    interleaved[i + 1] = static_cast<float>(bent(gain_.now * (frame.right + static_cast<double>(interleaved[i + 1]))));
    ++position_;
  }
}

}  // namespace afm::exhibit
