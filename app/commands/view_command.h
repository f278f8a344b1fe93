// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/cluster/cluster_start.h"
#include "app/display/display_options.h"
#include "app/live/view_settings.h"
#include "app/options/command.h"
#include "app/view/wand_options.h"
#include "core/result.h"
#include "curves/tapping/driven_setup.h"
#include "exhibit/frame/exhibit_files.h"
#include "physics/friction/friction.h"
#include "scene/samples/level_choice.h"
#include "servo/servo_choice.h"

namespace afm::curves {
struct SampleModel;
}
namespace afm::exhibit {
struct Stage;
}

namespace afm::app {

struct ViewLesson;

// Options of the live window.
struct ViewOptions {
  exhibit::ExhibitFiles files;
  scene::LevelChoice level;
  DisplayOptions display;
  ViewSettings settings;                  // settings without the scale
  std::optional<scene::ScaleMode> scale;  // scale of the hand; empty: particles if there are any, otherwise fit
  physics::FrictionLaw friction = physics::FrictionLaw::None;
  curves::TappedHand tapping;
  double frame_rate = 0;  // frames per second; 0: the display's rate
  bool speech = false;
  bool headset = false;
  bool kiosk = false;  // true: an unattended window that reopens after a failure or a hang
  int kept = -1;       // descriptor for the heartbeat of a kiosk's window; -1: none
  servo::ServoChoice servo{.haptic_device = "mouse", .settings = {.linger_s = 10.0}};
  std::int64_t spin_us = 0;
  WandOptions wand;
  ClusterOptions cluster;
};

// Opens the window and runs it until it ends; `lesson` may be null. `program` is the running touchafm.
core::Result<void> run_view(const ViewOptions& options, const std::string& program, const ViewLesson* lesson = nullptr);

// Window options that a lesson shares: picture, wand, device, sound and speech.
void add_window_options(OptionList& command, ViewOptions& options);

}  // namespace afm::app
