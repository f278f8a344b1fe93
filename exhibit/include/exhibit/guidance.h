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

// The step of the procedure that comes next, from what has really happened to the tip. `ascending`: the hand is on its
// way up. `cycles`: how often the tip has let go of this material.
Hint next_step(const scene::TipState& tip, bool ascending, int cycles);

// The same in words, of a language that is loaded from a file (assets/guidance). Const after loading; any thread.
class Guidance {
 public:
  static core::Result<Guidance> load(const std::string& path);

  const std::string& text(Hint hint) const;

  // One short line: why the force went off, if it did, and the next step.
  std::string line(const scene::TipState& tip, bool ascending, int cycles) const;

 private:
  std::vector<std::string> phrases_;
};

}  // namespace afm::exhibit
