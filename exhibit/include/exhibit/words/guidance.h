// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "exhibit/words/controls.h"
#include "exhibit/words/phrases.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// The lines of guidance: the steps of the procedure, and the end of the servo.
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
  PressToGoOn,
  ServoEnded
};

// Progress of the present cycle.
struct StepsDone {
  bool ascending = false;  // the hand, last time that it moved
  bool pressed = false;    // below Z = 0 since the tip touched
  bool let_go = false;     // since the force came on
};

// Progress as CycleHistory counts it.
struct CycleProgress {
  bool ascending = false;
  bool pressed = false;
  int cycles = 0;  // of the sample under the tip
};

// The step of the procedure that comes next, from what has really happened to the tip.
Hint next_step(const scene::TipState& tip, const StepsDone& done);

// Ways back from what is shown instead of the instrument, and the place of the list of keys.
enum class Note { Keys, LeaveJourney, LeaveAnalogy };
const std::string& note_text(const Phrases& phrases, Note note);

// The step in words, with the controls of the device in the hand.
std::string step_text(const Phrases& phrases, Hint hint, const Controls& controls);

// One line for the wall: why the force went off, if it did, and the next step.
std::string guidance_line(const Phrases& phrases, Hint hint, const scene::TipState& tip, const Controls& controls);

}  // namespace afm::exhibit
