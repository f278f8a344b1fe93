// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// What a person can be told on the wall's one line: the steps of the procedure, and why the force went off.
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

// How far the present cycle is.
struct StepsDone {
  bool ascending = false;  // the hand, last time that it moved
  bool pressed = false;    // below Z = 0 since the tip touched
  bool let_go = false;     // since the force came on
};

// What CycleHistory counts.
struct CycleProgress {
  bool ascending = false;
  bool pressed = false;
  int cycles = 0;  // of the sample under the tip
};

// The step of the procedure that comes next, from what has really happened to the tip.
Hint next_step(const scene::TipState& tip, const StepsDone& done);

// What a person holds: its controls are named on the wall. Device: one that is named nowhere, found by --haptics auto.
enum class HandControls { Mouse, Pen, Grip, Gamepad, Device, Simulated };
enum class Pointer { Mouse, Wand };
struct Controls {
  HandControls hand = HandControls::Simulated;
  Pointer pointer = Pointer::Wand;
};

// How what is shown instead of the instrument is left, and where the keys are listed.
enum class Note { Keys, LeaveJourney, LeaveAnalogy };

// The steps in words, of a language that is loaded from a file (assets/guidance). Const after loading; any thread.
class Guidance {
 public:
  // Where the file names no controls, or says nothing in a note, nothing is said of them.
  static core::Result<Guidance> load(const std::string& path);

  std::string text(Hint hint, const Controls& controls) const;
  const std::string& text(Note note) const;

  // One short line: why the force went off, if it did, and the next step.
  std::string line(Hint hint, const scene::TipState& tip, const Controls& controls) const;

 private:
  std::vector<std::string> phrases_;
};

}  // namespace afm::exhibit
