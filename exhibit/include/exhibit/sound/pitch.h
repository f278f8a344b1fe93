// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/law_tables.h"

namespace afm::exhibit {

// Equal temperament, A4 (note 69) = 440 Hz: the frequency of a MIDI note, which may lie between two keys.
double note_hz(double note);

// What is heard of a force.
struct Tone {
  double hz = 0;
  double level = 0;  // 0: silent, 1: loudest
  double side = 0;   // -1: the left ear alone, 1: the right ear alone
  double edge = 0;   // 0: a pure tone, 1: with its octave; it also differs in mono

  bool operator==(const Tone&) const = default;
};

// The ear's map of forces: the pitch rises by three octaves, from C3 without force to C6 at the strongest pull, along
// the asinh of the hand's compressed scale (haptics::compression_bend_n). So ear and hand learn one scale. A push may
// be stronger than any pull and rises by an octave more at most. A pull is heard on the left, a push on the right.
class Ear {
 public:
  static constexpr double kLowestNote = 48, kNotesToPull = 36, kNotesBeyond = 12;

  // Forces on the tip, newtons, both above 0: where the compression bends, and the strongest pull.
  Ear(double bend_n, double strongest_n);
  explicit Ear(const physics::LawTables& tables);

  // Force on the tip in newtons, positive away from the sample (a push).
  double hz(double force_n) const;
  Tone tone(double force_n) const;

 private:
  double share(double force_n) const;  // of the way from no force to the strongest pull

  double bend_n_;
  double whole_;  // asinh of the strongest pull
};

}  // namespace afm::exhibit
