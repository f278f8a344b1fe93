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
  Touch,         // the force has changed from zero or a pull to a push
  ForceOn,       // force on the hand enabled
  ForceOff,      // disabled by a person or by a change of the sample
  Fault,         // disabled after a failure
  SampleChosen,  // the sample is under the tip
  TurnOnReady,   // the tip is high enough for Turn-On
  ScanLine,      // a line of a scan is complete
  ParticleTouched,
  ParticleGave,
  ParticleLost,
  ParticleRiddenOver,
  ParticleDragged,
  ParticleTorn,
  PushTakenBack,
  ParticlesPutBack,
  PatternDone,       // the particles lie on the pattern of their set
  JumpToRepulsion,   // a tapping lever fell into the repulsive state
  JumpToAttraction,  // it fell back into the attractive one
  ParticleLifted,
  ParticleSetDown,
  LookedAgain,        // a scan of the particles near the tip begins
  SurfaceMarked,      // the tip begins to press a soft sample in
  TipStopped,         // it cannot sink deeper
  HandTooFast,        // the hand moves faster than the tip scratches
  InkFlows,           // a tip with ink touches the sample
  LiquidTorn,         // it comes off
  ParticleSwept,      // a scan that presses too hard begins to push a particle
  ParticleAstray,     // a pushed particle has come off the way of the tip
  ParticleJammed,     // the tip presses particles hard that cannot move
  ParticleFarEnough,  // without a picture: a pushed particle is at the end of its line
  BlindTaskDone,      // a task without a picture is done
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
  double edge = 0;   // see Tone
};

struct Signal {
  std::array<SignalNote, 3> notes{};  // in order of their starts; zero length: no note
  double length_s() const;
};

enum class Spoken { AtOnce, OnRequest };

struct HeardEventRow {
  HeardEvent event;
  Phrase caption;  // with the placeholders kEventPlaces
  Phrase said;     // with the placeholders kEventPlaces
  Spoken spoken;   // OnRequest: too frequent, so spoken only after the key Y
  Signal signal;
};

// The event's row.
const HeardEventRow& row_of(HeardEvent event);

}  // namespace afm::exhibit
