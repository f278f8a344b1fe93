// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "exhibit/words/phrases.h"

namespace afm::exhibit {

// What has its own sound, a caption on the wall, and a phrase that is spoken.
enum class HeardEvent {
  SnapIn,
  PullOff,
  Slip,
  Touch,         // the force has turned from none or a pull to a push
  ForceOn,       // on the hand
  ForceOff,      // because a person wanted it, or the sample was changed
  Fault,         // the force is gone because something failed
  SampleChosen,  // and lies under the tip
  TurnOnReady,   // the tip is high enough for Turn-On
  ScanLine       // of an image is done
};

// One note of a signal: a sine that glides from one pitch to another under an envelope without corners.
struct SignalNote {
  double start_s = 0;
  double length_s = 0;
  double from_hz = 0;
  double to_hz = 0;
  double level = 0;  // amplitude, 1: full scale
  double edge = 0;   // as in Tone
};

struct Signal {
  std::array<SignalNote, 3> notes{};  // in the order of their starts; one without length is none
  double length_s() const;
};

enum class Spoken { AtOnce, OnRequest };

struct HeardEventRow {
  HeardEvent event;
  Phrase caption;  // with the placeholders kEventPlaces
  Phrase said;     // the same
  Spoken spoken;   // OnRequest: so frequent that only the key Y says it
  Signal signal;
};

// One row for each event, in the order of HeardEvent.
const HeardEventRow& row_of(HeardEvent event);

}  // namespace afm::exhibit
