// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "exhibit/words/controls.h"
#include "exhibit/words/phrases.h"
#include "haptics/hand_controls.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// Lines of guidance: the steps of the procedure, and the end of the servo.
enum class Hint {
  ChooseSample,
  Lift,
  TurnOn,
  TurnOnAndHold,
  ComingOn,
  GoingOff,
  MoveDown,
  PressOn,
  Pressed,
  MoveUp,
  LetGo,
  GoBeside,
  PushAside,
  TakeSwing,
  GiveSwing,
  SwingsFree,
  PressToGoOn,
  ServoEnded
};

// Progress of the current cycle.
struct StepsDone {
  bool ascending = false;  // direction of the hand's last motion
  bool pressed = false;    // true: below Z = 0 at some time since the tip touched
  bool let_go = false;     // true: pull-off since the force was switched on, or the swing taken and given back
  std::optional<bool> swing_taken{};  // true: the sample has the swing of a lever that taps; none without tapping
};

// Progress counted by CycleHistory.
struct CycleProgress {
  bool ascending = false;
  bool pressed = false;
  int cycles = 0;                       // number of cycles on the sample under the tip
  std::optional<double> swing_share{};  // amplitude in free amplitudes; none without tapping
};

// True if the hand is on the scale on which the tip pushes particles, where a cycle of approach and retract is no goal.
bool pushes_particles(const scene::TipState& tip);

// Next step of the procedure, derived from the tip's real events.
Hint next_step(const scene::TipState& tip, const StepsDone& done);

// Lines on how to leave a view that replaces the instrument, and on how to show the list of keys.
enum class Note { Keys, LeaveJourney, LeaveAnalogy };
const std::string& note_text(const Phrases& phrases, Note note);

// Text of the step, with the names of the device's controls.
std::string step_text(const Phrases& phrases, Hint hint, const Controls& controls);

// One line for the wall: the reason if the force went off without a person's Stop, and the next step.
std::string guidance_line(const Phrases& phrases, Hint hint, const scene::TipState& tip, const Controls& controls);

// Line on how to choose a sample, for the panel of the sample's data while there is none.
std::string no_sample_advice(const Phrases& phrases, Pointer pointer);

}  // namespace afm::exhibit
