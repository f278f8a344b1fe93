// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/live/live_controls.h"
#include "core/result.h"
#include "curves/sample_model.h"

namespace afm::core {
class Clock;
}
namespace afm::exhibit {
struct Stage;
}
namespace afm::servo {
class ServoClient;
}

namespace afm::app {

class ViewPicture;
class ViewWand;
class ViewWindows;

// Components of a live window.
struct LiveWindowParts {
  const exhibit::Stage& stage;
  const std::vector<curves::SampleModel>& materials;
  ViewWindows& windows;
  ViewPicture& picture;
  std::string drawn_by;  // name of the graphics device
  ViewWand& wand;
  const core::Clock& clock;
  std::function<core::Result<std::unique_ptr<servo::ServoClient>>()> start_servo;
};

// Runs the live window: the mouse points, chooses samples and moves the servo's simulated hand; every frame shows the
// newest state of the tip. Returns as LiveView::run() does.
core::Result<void> run_live_window(const LiveWindowParts& parts, const ViewSettings& settings,
                                   const LiveFeatures& features);

}  // namespace afm::app
