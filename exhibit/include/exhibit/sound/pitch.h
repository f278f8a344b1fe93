// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/law_tables.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// Frequency of a MIDI note in equal temperament, A4 (note 69) = 440 Hz. May be between two keys.
double note_hz(double note);

// Sound of a force.
struct Tone {
  double hz = 0;
  double level = 0;  // 0: silent, 1: loudest
  double side = 0;   // -1: only left ear; 1: only right ear
  double edge = 0;   // 0: pure tone; 1: with its octave, a difference that is audible even in mono
  double hiss = 0;   // 1: noise around that frequency instead of the tone

  bool operator==(const Tone&) const = default;
};

// Mapping of forces to tones: the pitch rises by three octaves, from C3 without force to C6 at the strongest pull,
// along the asinh of the hand's compressed scale (haptics::compression_bend_n), so that ear and hand share one scale. A
// push may exceed the strongest pull and rises by up to another octave. A pull is on the left, a push on the right.
//
// In tapping mode the tone is central instead: the free swing, 90 degrees behind its drive, as A4, an octave higher
// or lower for 90 degrees more or less, and as loud as the remaining fraction of the free amplitude. The tone of a
// repulsive swing, below 90 degrees, has its octave added, which makes the two states different even in mono.
class Ear {
 public:
  static constexpr double kLowestNote = 48, kNotesToPull = 36, kNotesBeyond = 12;

  // Forces on the tip, newtons, both above 0: the compression's bend, and the strongest pull. `free_amplitude_m`: in
  // tapping mode, otherwise 0.
  Ear(double bend_n, double strongest_n, double free_amplitude_m = 0);
  explicit Ear(const physics::LawTables& tables, double free_amplitude_m = 0);

  // Frequency for a force on the tip, newtons, positive away from the sample (a push).
  double hz(double force_n) const;
  Tone tone(double force_n) const;
  Tone tone(const scene::TipSample& sample) const { return tone(sample.tip.force_n, sample.swing); }
  Tone tone(double force_n, const scene::Swing& swing) const;

 private:
  double share(double force_n) const;  // position between no force (0) and the strongest pull (1)

  double bend_n_;
  double whole_;  // asinh of the strongest pull
  double free_amplitude_m_;
};

}  // namespace afm::exhibit
