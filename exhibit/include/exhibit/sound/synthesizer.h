// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "exhibit/sound/heard_event.h"
#include "exhibit/sound/pitch.h"

namespace afm::exhibit {

enum class Channels { Stereo, Mono };

// Left and right gain with constant power; `side` from -1 (left only) to 1.
struct Pan {
  double left = 0, right = 0;
};
Pan pan(double side);

// A raised cosine that rises from 0 to 1 over `length_s` seconds; its largest step at 48 kHz over 5 ms is 0.00654.
double rise(double time_s, double length_s);

// Synthesizes sound as a pure function of tones and events: the same calls return the same samples, bit for bit.
// Interpolates pitch, level and side between two tones; the last tone lasts. Avoids clicks: levels change within
// milliseconds, and phases are continuous. A soft knee keeps the sum below -1 dBFS. Neither allocates nor locks nor
// throws. One thread.
class Synthesizer {
 public:
  static constexpr double kLoudest = 0.891;  // amplitude of -1 dBFS

  explicit Synthesizer(Channels channels) : channels_(channels) {}

  // Sets the tone from sample `at` on, counted from the stream's start and not before that of an earlier call; at once
  // if it is past.
  void set_tone(std::int64_t at, const Tone& tone) noexcept;
  // Plays the event's signal from sample `at` on, or at once if it is past. Drops it if too many already play: some
  // slips, rarely other events.
  void play(std::int64_t at, HeardEvent event, double side) noexcept;

  // Gain of the whole output; 1: unchanged. Changes within milliseconds.
  void set_gain(double gain) noexcept { gain_.wanted = gain; }
  // Gain of the tone only, for lowering it while a voice speaks.
  void set_tone_gain(double gain) noexcept { tone_gain_.wanted = gain; }

  // Adds the next samples, left and right alternating, to the existing ones, then applies the knee.
  void add_to(std::span<float> interleaved) noexcept;

  std::int64_t position() const noexcept { return position_; }  // index of the next sample

 private:
  struct Point {
    std::int64_t at = 0;
    Tone tone;
  };
  struct Voice {
    std::int64_t at = 0;
    HeardEvent event{};
    Pan pan;
    std::array<double, 3> phase{};
    bool busy = false;
  };
  // A value that follows its target within kFollowS.
  struct Followed {
    double now = 0;
    double wanted = 0;
    void step() noexcept;
  };
  // Smooth noise, interpolated between random numbers; `share` is the step from one to the next.
  struct Noise {
    double from = 0, to = 0, along = 0;
    std::uint32_t state = 2463534242;
    double next(double share) noexcept;
  };
  struct Frame {
    double left = 0, right = 0;
  };

  Tone tone_now() noexcept;
  Frame next_of_tone() noexcept;
  void add_voice(Voice& voice, Frame& frame) const noexcept;

  static constexpr std::size_t kPoints = 256, kVoices = 16, kVoicesOfSlips = 12;

  Channels channels_;
  std::int64_t position_ = 0;
  Point from_;
  std::array<Point, kPoints> points_{};  // ring buffer of tones to come
  std::size_t first_point_ = 0, point_count_ = 0;
  double phase_ = 0;  // phase of the tone, in turns
  Noise noise_;
  Followed level_, side_, edge_, hiss_, gain_{1.0, 1.0}, tone_gain_{1.0, 1.0};
  std::array<Voice, kVoices> voices_{};
};

}  // namespace afm::exhibit
