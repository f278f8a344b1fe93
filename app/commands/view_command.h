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
#include "exhibit/frame/exhibit_files.h"
#include "physics/friction/friction.h"
#include "servo/servo_choice.h"

namespace afm::curves {
struct SampleModel;
}
namespace afm::exhibit {
struct Stage;
}

namespace afm::app {

struct ViewLesson;

// What the live window is opened with.
struct ViewOptions {
  exhibit::ExhibitFiles files;
  DisplayOptions display;
  ViewSettings settings;
  physics::FrictionLaw friction = physics::FrictionLaw::None;
  double frame_rate = 0;  // 0: the display's
  bool speech = false;
  bool headset = false;
  bool kiosk = false;  // an unattended window that is opened again whenever it fails
  servo::ServoChoice servo{.haptic_device = "mouse", .settings = {.linger_s = 10.0}};
  std::int64_t spin_us = 0;
  WandOptions wand;
  ClusterOptions cluster;
};

// Opens the window and runs it to its end; `lesson` may be null. `program` is the running touchafm.
core::Result<void> run_view(const ViewOptions& options, const std::string& program, const ViewLesson* lesson = nullptr);

// The samples of the stage as the servo gets them, with the surfaces that the stage draws.
core::Result<std::vector<curves::SampleModel>> felt_samples(exhibit::Stage& stage, physics::FrictionLaw friction);

// Options of the window that a lesson has too: picture, wand, device, sound and speech.
void add_window_options(OptionList& command, ViewOptions& options);

}  // namespace afm::app
