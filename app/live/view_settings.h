// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/key_list.h"
#include "app/view/sound_settings.h"
#include "exhibit/words/controls.h"
#include "input/simulated_head.h"
#include "scene/shared/scale_modes.h"
#include "servo/recorded_force_map.h"

namespace afm::servo {
class KeptBeat;
}

namespace afm::app {

// Settings of the live window, from the options of its command.
struct ViewSettings {
  HandSource hand = HandSource::Mouse;
  exhibit::HandControls device_controls = exhibit::HandControls::Device;  // names of a device's controls
  double most_frames_per_s = 60.0;
  scene::ScaleMode scale = scene::ScaleMode::Fit;  // initial scale; M selects the next
  std::optional<std::size_t> first_material;       // material chosen after every start of a servo
  std::string frame_log;                           // file name; empty: no log
  std::vector<input::HeadKey> head_script;         // simulated motion of an untracked head; may be empty
  bool unattended = false;    // true: staff keys locked; restarts and demonstrates itself without a visitor
  double idle_s = 60;         // seconds without input before the demonstration starts
  std::string record_folder;  // folder for sessions; empty: none are stored
  std::optional<servo::RecordedForceMap> force_map;  // file of the map, for its sessions; empty: none
  std::optional<double> equal_force_n;               // force of the surface shown first over a force map; empty: none
  LiveSoundSettings sound;
  std::shared_ptr<servo::KeptBeat> kept;  // heartbeat of a kiosk's window; shared because settings are copied
};

}  // namespace afm::app
