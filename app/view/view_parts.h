// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "app/view/view_turn.h"

namespace afm::core {
class Clock;
}
namespace afm::exhibit {
struct Stage;
}

namespace afm::app {

class LiveSound;
class ServoSupervisor;
class ViewChoice;
class ViewControls;
class ViewHand;
class ViewPanels;
class ViewPicture;
class ViewPointer;
class ViewWand;
class ViewWindows;

// Objects shared by the loop and all controls of a live window. Everything referred to must outlive it.
struct ViewParts {
  const exhibit::Stage& stage;
  const core::Clock& clock;
  ViewWindows& windows;
  ViewPicture& picture;
  ViewPanels& panels;
  LiveSound& sound;
  ServoSupervisor& servo;
  ViewWand& wand;
  ViewHand& hand;
  ViewPointer& pointer;
  ViewChoice& choice;
  ViewControls& controls;
  ViewTurn turn{};
};

// Heartbeat of one frame. Also reports to the servo whether anybody sees the picture, if that is known.
std::function<void()> heartbeat_of(ViewParts& parts);

}  // namespace afm::app
