// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "exhibit/sound/heard_event.h"
#include "exhibit/sound/pitch.h"

namespace afm::exhibit {

enum class Channels { Stereo, Mono };

// Left and right gain of constant power; `side` from -1 (left alone) to 1.
struct Pan {
  double left = 0, right = 0;
};
Pan pan(double side);

// A raised cosine that rises from 0 to 1 over `length_s` seconds; its largest step at 48 kHz over 5 ms is 0.00654.
double rise(double time_s, double length_s);

// What is heard, as a pure function of tones and events: the same calls give the same samples, bit for bit. Between two
// tones pitch, level and side are interpolated; the last one lasts. Nothing begins or ends with a click: levels follow
// within milliseconds, phases are continuous. The sum stays below -1 dBFS, which a soft knee sees to. Neither allocates
// nor locks nor throws. One thread.
class Synthesizer {
 public:
  static constexpr double kLoudest = 0.891;  // -1 dBFS

  explicit Synthesizer(Channels channels) : channels_(channels) {}

  // From this sample on, counted from the stream's start; not before that of an earlier call. One that is past holds at
  // once.
  void set_tone(std::int64_t at, const Tone& tone) noexcept;
  // Begins with this sample, or at once. Dropped where too many sound already: of slips some, of others hardly ever.
  void play(std::int64_t at, HeardEvent event, double side) noexcept;

  // Of everything; 1: as made. Followed within milliseconds.
  void set_gain(double gain) noexcept { gain_.wanted = gain; }
  // Of the tone alone: lower while a voice speaks.
  void set_tone_gain(double gain) noexcept { tone_gain_.wanted = gain; }

  // The next samples, left and right in turn, added to those that are there; then the knee.
  void add_to(std::span<float> interleaved) noexcept;

  std::int64_t position() const noexcept { return position_; }  // of the next sample

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
  // Follows what is wanted within kFollowS.
  struct Followed {
    double now = 0;
    double wanted = 0;
    void step() noexcept;
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
  std::array<Point, kPoints> points_{};  // a ring
  std::size_t first_point_ = 0, point_count_ = 0;
  double phase_ = 0;  // of the tone, in turns
  Followed level_, side_, edge_, gain_{1.0, 1.0}, tone_gain_{1.0, 1.0};
  std::array<Voice, kVoices> voices_{};
};

}  // namespace afm::exhibit
