// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "core/enumerators.h"
#include "exhibit/words/phrases.h"

namespace afm::exhibit {

// Events with a sound, a caption on the wall, and a spoken phrase.
enum class HeardEvent {
  SnapIn,
  PullOff,
  Slip,
  Touch,         // change of the force from zero or a pull to a push
  ForceOn,       // force on the hand enabled
  ForceOff,      // force disabled by a person or by a change of the sample
  Fault,         // force disabled after a failure
  SampleChosen,  // sample placed under the tip
  TurnOnReady,   // tip high enough for Turn-On
  ScanLine,      // completed line of a scan
  ParticleTouched,
  ParticleGave,
  ParticleLost,
  ParticleRiddenOver,
  ParticleDragged,
  ParticleTorn,
  PushTakenBack,
  ParticlesPutBack,
  PatternDone,       // particles complete on the pattern of their set
  JumpToRepulsion,   // fall of a tapping lever into the repulsive state
  JumpToAttraction,  // fall of a tapping lever into the attractive state
  ParticleLifted,
  ParticleSetDown,
  LookedAgain,        // start of a second look at the particles near the tip
  SurfaceMarked,      // first pressing of the tip into a soft sample
  TipStopped,         // tip unable to sink deeper
  HandTooFast,        // hand too fast for the tip to scratch
  InkFlows,           // contact of a tip with ink and the sample
  LiquidTorn,         // end of that contact
  ParticleSwept,      // first push of a particle by a scan that presses too hard
  ParticleAstray,     // pushed particle off the path of the tip
  ParticleJammed,     // hard pressure on particles that cannot move
  ParticleFarEnough,  // pushed particle at the end of its line, without a picture
  BlindTaskDone,      // task without a picture completed
};

}  // namespace afm::exhibit

// HeardEvent has more values than other enumerations.
template <>
consteval auto afm::core::named_values<afm::exhibit::HeardEvent>() {
  return []<std::size_t... index>(std::index_sequence<index...>) {
    return std::array{has_name<static_cast<exhibit::HeardEvent>(index)>()...};
  }(std::make_index_sequence<2 * kMostEnumerators>());
}

namespace afm::exhibit {

// One note of a signal: a sine that glides between two pitches, with a smooth envelope.
struct SignalNote {
  double start_s = 0;
  double length_s = 0;
  double from_hz = 0;
  double to_hz = 0;
  double level = 0;  // amplitude; 1: full scale
  double edge = 0;   // share of the octave, as in Tone
};

struct Signal {
  std::array<SignalNote, 3> notes{};  // notes in order of their starts; zero length: no note
  double length_s() const;
};

enum class Spoken { AtOnce, OnRequest };

struct HeardEventRow {
  HeardEvent event;
  Phrase caption;  // text with the placeholders kEventPlaces
  Phrase said;     // text with the placeholders kEventPlaces
  Spoken spoken;   // OnRequest: too frequent, so spoken only after the key Y
  Signal signal;
};

// The event's row.
const HeardEventRow& row_of(HeardEvent event);

}  // namespace afm::exhibit
