// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/key_list.h"
#include "app/view/sound_settings.h"
#include "exhibit/words/guidance.h"
#include "input/simulated_head.h"
#include "scene/shared/scale_modes.h"

namespace afm::servo {
class KeptBeat;
}

namespace afm::app {

struct ViewSettings {
  HandSource hand = HandSource::Mouse;
  exhibit::HandControls device_controls = exhibit::HandControls::Device;  // used with HandSource::Device
  double most_frames_per_s = 60.0;
  scene::ScaleMode scale = scene::ScaleMode::Fit;  // M goes on to the next
  std::optional<std::size_t> first_material;       // chosen whenever a servo starts
  std::string frame_log;                           // a file; empty: none is written
  std::vector<input::HeadKey> head_script;         // moves a head that no tracker follows; may be empty
  bool unattended = false;    // staff keys are locked; without a visitor the wall restarts and demonstrates itself
  double idle_s = 60;         // seconds without input before the demonstration starts
  std::string record_folder;  // receives session files; empty: none is written
  LiveSoundSettings sound;
  std::shared_ptr<servo::KeptBeat> kept;  // beat of a kiosk's window; shared because settings are copied
};

}  // namespace afm::app
