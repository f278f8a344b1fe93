// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "core/spsc_ring.h"
#include "exhibit/sound/stream_clock.h"
#include "exhibit/sound/synthesizer.h"
#include "exhibit/sound/tip_ear.h"
#include "servo/tip_listener.h"

namespace afm::exhibit {

// Part of a spoken phrase, at kSoundRateHz.
struct VoiceBlock {
  static constexpr std::size_t kSamples = 480;
  std::uint32_t phrase = 0;  // number of the phrase; a higher one interrupts it
  std::uint32_t count = 0;
  std::array<float, kSamples> samples{};
};

// Mixes the sound card's output: tones and signals of the tip, signals of the program, and a voice. Three producers,
// each in a separate thread, and one consumer, the audio thread, communicate through rings, which lose nothing that
// fits into half a second.
//
// An event is heard kDelayNs after its time, plus the card's delay, so that an update may be late by that much without
// disturbing the rhythm.
class SoundMixer final : public servo::TipAudience {
 public:
  static constexpr std::int64_t kDelayNs = 10'000'000;
  static constexpr std::size_t kMaxMaterials = 16;

  explicit SoundMixer(Channels channels) : synthesizer_(channels) {}

  // ---- for the thread that reads the servo ----
  void heard(const scene::TipSample& sample) noexcept override;
  void heard(const scene::TipEvent& event) noexcept override;

  // ---- for the frame loop
  void happened(const Heard& event) noexcept;
  void set_ear(std::size_t material, const Ear& ear) noexcept;  // before the material's forces sound, and on changes
  void set_volume(double gain) noexcept { gain_.store(static_cast<float>(gain)); }  // output gain; 0: silent
  void set_tones(bool on) noexcept { tones_.store(on); }  // tones and signals, without the voice

  // ---- for the thread that speaks
  bool speak(const VoiceBlock& block) noexcept { return voice_.push(block); }  // false: queue full, try again
  void cut_voice(std::uint32_t next_phrase) noexcept { phrase_.store(next_phrase); }

  // ---- for the audio thread: the next samples, left and right alternating. Wait-free; neither allocates nor throws.
  void fill(std::span<float> interleaved, std::int64_t now_ns) noexcept;

 private:
  struct TipUpdate {
    std::int64_t time_ns = 0;
    double force_n = 0;
    scene::Swing swing{};
    HeardPush push{};
    std::int32_t material = -1;
    bool event = false;  // true: an event; false: a sample, which has a force
    bool audible = false;
    HeardEvent what{};
  };
  struct ProgramUpdate {
    Heard event;
    bool is_ear = false;
    std::size_t material = 0;
    Ear ear{1.0, 1.0};
  };

  void take_updates() noexcept;
  void take(const TipUpdate& update) noexcept;
  void take(const ProgramUpdate& update) noexcept;
  std::int64_t sample_of(std::int64_t time_ns) const noexcept;
  void add_voice(std::span<float> interleaved) noexcept;
  float next_of_voice() noexcept;

  // ---- used by the thread that reads the servo
  TipEar ear_;

  // ---- shared by two threads
  core::SpscRing<TipUpdate, 1024> tip_updates_;
  core::SpscRing<ProgramUpdate, 64> program_updates_;
  core::SpscRing<VoiceBlock, 64> voice_;
  std::atomic<float> gain_{1.0F};
  std::atomic<bool> tones_{true};
  std::atomic<std::uint32_t> phrase_{0};

  // ---- used by the audio thread
  std::array<Ear, kMaxMaterials> ears_ = filled_with(Ear(1e-9, 1e-9), std::make_index_sequence<kMaxMaterials>());
  StreamClock clock_;
  Synthesizer synthesizer_;
  VoiceBlock block_;
  std::size_t spoken_ = 0;  // position within block_
  float voice_gain_ = 0;
  double last_hz_ = 0;

  template <std::size_t... index>
  static std::array<Ear, sizeof...(index)> filled_with(const Ear& ear, std::index_sequence<index...>) {
    return {((void)index, ear)...};
  }
};

}  // namespace afm::exhibit
