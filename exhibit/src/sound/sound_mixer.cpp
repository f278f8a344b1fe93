// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/sound_mixer.h"

#include <algorithm>

namespace afm::exhibit {

namespace {

constexpr double kToneUnderVoice = 0.3;
constexpr float kVoiceStep = 1.0F / (0.004F * kSoundRateHz);  // step that fades an interrupted phrase out within 4 ms

}  // namespace

void SoundMixer::heard(const scene::TipSample& sample) noexcept {
  const auto event = ear_.add(sample);
  tip_updates_.push({.time_ns = sample.time_ns,
                     .force_n = sample.tip.force_n,
                     .swing = sample.swing,
                     .push = ear_.push(),
                     .material = sample.material,
                     .event = false,
                     .audible = is_audible(sample)});
  if (event) {
    tip_updates_.push({.time_ns = event->time_ns,
                       .force_n = event->force_n,
                       .material = event->material,
                       .event = true,
                       .what = event->event});
  }
}

void SoundMixer::heard(const scene::TipEvent& event) noexcept {
  const Heard heard = heard_of(event);
  tip_updates_.push({.time_ns = heard.time_ns,
                     .force_n = heard.force_n,
                     .material = heard.material,
                     .event = true,
                     .what = heard.event});
}

void SoundMixer::happened(const Heard& event) noexcept { program_updates_.push({.event = event, .is_ear = false}); }

void SoundMixer::set_ear(std::size_t material, const Ear& ear) noexcept {
  program_updates_.push({.event = {}, .is_ear = true, .material = material, .ear = ear});
}

std::int64_t SoundMixer::sample_of(std::int64_t time_ns) const noexcept {
  return sample_at(time_ns + kDelayNs, clock_.start_ns());
}

void SoundMixer::take(const ProgramUpdate& update) noexcept {
  if (update.is_ear) {
    if (update.material < ears_.size()) ears_[update.material] = update.ear;
    return;
  }
  synthesizer_.play(sample_of(update.event.time_ns), update.event.event, 0.0);
}

void SoundMixer::take(const TipUpdate& update) noexcept {
  if (update.material < 0 || static_cast<std::size_t>(update.material) >= ears_.size()) return;
  const Ear& ear = ears_[static_cast<std::size_t>(update.material)];
  const std::int64_t at = sample_of(update.time_ns);
  if (update.event) {
    synthesizer_.play(at, update.what, side_of({.event = update.what, .force_n = update.force_n}, ear));
    return;
  }
  // without a force the tone fades at its pitch
  Tone tone = update.push.force_n > 0.0 ? tone_of(update.push) : ear.tone(update.force_n, update.swing);
  if (!update.audible) tone = {.hz = last_hz_, .level = 0};
  last_hz_ = tone.hz;
  synthesizer_.set_tone(at, tone);
}

void SoundMixer::take_updates() noexcept {
  const bool on = tones_.load(std::memory_order_relaxed);
  while (const auto update = program_updates_.pop()) {
    if (on || update->is_ear) take(*update);
  }
  while (const auto update = tip_updates_.pop()) {
    if (on) take(*update);
  }
}

float SoundMixer::next_of_voice() noexcept {
  const std::uint32_t wanted = phrase_.load(std::memory_order_relaxed);
  if (spoken_ >= block_.count) {
    const auto next = voice_.pop();
    if (!next) {
      voice_gain_ = 0.0F;
      return 0.0F;
    }
    block_ = *next;
    spoken_ = 0;
  }
  const bool stale = block_.phrase != wanted;
  voice_gain_ = std::clamp(voice_gain_ + (stale ? -kVoiceStep : kVoiceStep), 0.0F, 1.0F);
  if (stale && voice_gain_ <= 0.0F) {
    spoken_ = block_.count;  // rest of the interrupted phrase skipped
    return 0.0F;
  }
  return voice_gain_ * block_.samples[spoken_++];
}

void SoundMixer::add_voice(std::span<float> interleaved) noexcept {
  for (std::size_t i = 0; i + 1 < interleaved.size(); i += 2) interleaved[i] = interleaved[i + 1] = next_of_voice();
  synthesizer_.set_tone_gain(voice_gain_ > 0.0F ? kToneUnderVoice : 1.0);
}

void SoundMixer::fill(std::span<float> interleaved, std::int64_t now_ns) noexcept {
  clock_.asked(synthesizer_.position(), now_ns);
  take_updates();
  synthesizer_.set_gain(static_cast<double>(gain_.load(std::memory_order_relaxed)));
  add_voice(interleaved);
  synthesizer_.add_to(interleaved);
}

}  // namespace afm::exhibit
