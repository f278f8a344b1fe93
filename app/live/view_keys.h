// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "render/frame.h"
#include "render/window.h"

namespace afm::app {

enum class HandSource { Mouse, Simulated, Device };

// What a person can ask of the live window by a key. Samples are chosen by the digits, see digit().
enum class ViewAction {
  Leave,
  ShowKeys,
  ShowParameters,
  FullScreen,
  NextScale,
  HidePanels,
  BeginAgain,
  Home,
  SwapEyes,
  Journey,
  Analogy,
  NextStereo,
  PreviousStereo,
  NarrowEyes,
  WidenEyes,
  ShowCalibration,
  BringToWall,
  SavePicture,
};

std::optional<ViewAction> action_of(render::Key key);

// 0 for the key 1, up to 8.
std::optional<std::size_t> digit(render::Key key);

// What the live window's keys and buttons do, for the wall.
render::DataPanel key_list(HandSource hand);

}  // namespace afm::app
