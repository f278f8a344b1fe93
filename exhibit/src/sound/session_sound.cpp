// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/session_sound.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "exhibit/sound/stream_clock.h"
#include "exhibit/sound/tip_ear.h"
#include "exhibit/sound/wav_file.h"
#include "haptics/contact_model.h"

namespace afm::exhibit {

namespace {

constexpr int kChannelCount = 2;
constexpr std::int64_t kEndS = 1;  // fade-out of sounds that began with the last tick
constexpr std::int64_t kLongestNs = 3'600'000'000'000;

// Collects the stream.
class Stream {
 public:
  Stream(const servo::RecordedSession& session, const Ear& ear, Channels channels, double gain)
      : start_ns_(session.samples.front().time_ns), ear_(ear), synthesizer_(channels), gain_(gain) {}

  void play(const Heard& heard) {
    synthesizer_.play(sample_at(heard.time_ns, start_ns_), heard.event, side_of(heard, ear_));
  }

  void hold(const scene::TipSample& sample) {
    if (const auto heard = tip_ear_.add(sample)) play(*heard);
    const bool pushed = tip_ear_.push().force_n > 0.0;
    const Tone heard = pushed ? tone_of(tip_ear_.push()) : ear_.tone(sample);
    const Tone tone = is_audible(sample) ? heard : Tone{.hz = hz_, .level = 0};
    hz_ = tone.hz;
    const std::int64_t at = sample_at(sample.time_ns, start_ns_);
    synthesizer_.set_tone(at, tone);
    go_on_to(at);
  }

  std::vector<float> end() {
    go_on_to(synthesizer_.position() + kEndS * kSoundRateHz);
    for (float& sample : samples_) sample *= static_cast<float>(gain_);
    return std::move(samples_);
  }

 private:
  void go_on_to(std::int64_t position) {
    const std::int64_t count = std::max<std::int64_t>(0, position - synthesizer_.position());
    const std::size_t before = samples_.size();
    samples_.resize(before + static_cast<std::size_t>(kChannelCount * count));
    synthesizer_.add_to(std::span(samples_).subspan(before));
  }

  std::int64_t start_ns_;
  Ear ear_;
  TipEar tip_ear_;
  Synthesizer synthesizer_;
  double gain_;
  double hz_ = 0;
  std::vector<float> samples_;
};

}  // namespace

core::Result<std::vector<float>> sound_of(const servo::RecordedSession& session, Channels channels, double gain) {
  if (session.samples.back().time_ns - session.samples.front().time_ns > kLongestNs) {
    return core::failure(core::ErrorCategory::BadInputFile, "it lasts longer than an hour, too long for its sound");
  }
  const auto model = servo::model_of(session);
  const auto tables =
      haptics::build_tables(model->materials.front(), std::span(model->curves).first(session.curve ? 1 : 0));
  if (!tables) return core::failure(core::ErrorCategory::BadInputFile, tables.error().message);
  Stream stream(session, Ear(**tables, model->materials.front().free_amplitude_m), channels, gain);
  auto event = session.events.begin();
  for (const scene::TipSample& sample : session.samples) {
    for (; event != session.events.end() && event->time_ns <= sample.time_ns; ++event) stream.play(heard_of(*event));
    stream.hold(sample);
  }
  return stream.end();
}

core::Result<std::string> wav_of(const servo::RecordedSession& session, Channels channels, double gain) {
  const auto sound = sound_of(session, channels, gain);
  if (!sound) return tl::unexpected(sound.error());
  return wav_bytes(*sound);
}

}  // namespace afm::exhibit
