// SPDX-License-Identifier: Apache-2.0
#include "app/commands/view_people.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "app/view/speech_choice.h"
#include "exhibit/frame/exhibit_setup.h"
#include "servo/haptic_choice.h"
#include "servo/keep_running.h"
#include "servo/session_file.h"

namespace afm::app {

namespace {

// Controls of the device that a person moves.
exhibit::HandControls controls_of(const servo::HapticChoice& choice) {
  if (!choice.replay_file.empty()) return exhibit::HandControls::Simulated;
  return choice.device != nullptr ? choice.device->controls : exhibit::HandControls::Device;
}

// Selects the source of a simulated hand, and the settings for a recorded hand.
core::Result<void> set_hand(const exhibit::Stage& stage, const std::string& device, ViewSettings& settings) {
  const auto choice = servo::parse_haptic_choice(device);
  if (!choice) return tl::unexpected(choice.error());
  if (choice->person == servo::HapticChoice::Person::Simulated) settings.hand = HandSource::Simulated;
  settings.device_controls = controls_of(*choice);
  if (choice->replay_file.empty()) return {};
  const auto session = servo::load_session(choice->replay_file);
  if (!session) return tl::unexpected(session.error());
  const auto& materials = stage.materials.materials;
  const auto found =
      std::find_if(materials.begin(), materials.end(), [&](const auto& m) { return m.name == session->material; });
  const bool of_map = session->law_map || (session->curve && session->curve->column >= 0);
  if (found == materials.end() && of_map) {
    return core::wrong_usage(
        fmt::format("the session {} was recorded over a force map: add --force-map and the options of the recording",
                    choice->replay_file));
  }
  if (found == materials.end()) {
    return core::failure(core::ErrorCategory::WrongUsage,
                         fmt::format("the session {} was recorded on {}, which is not on the wall: add --material {}",
                                     choice->replay_file, session->material, session->material));
  }
  if (session->particles && stage.particles == nullptr) {
    return core::wrong_usage(
        fmt::format("the session {} was recorded with particles: add --particles with the set of the recording",
                    choice->replay_file));
  }
  settings.scale = session->samples.front().scale_mode;
  settings.first_material = static_cast<std::size_t>(found - materials.begin());
  return {};
}

core::Result<void> set_speech(bool wanted, const exhibit::Stage& stage, ViewSettings& settings) {
  if (!wanted) return {};
  auto program = choose_speech_program(stage.phrases()[exhibit::Phrase::Language]);
  if (!program) return tl::unexpected(program.error());
  settings.sound.speech = std::move(*program);
  return {};
}

}  // namespace

core::Result<void> set_people(const ViewOptions& options, const exhibit::Stage& stage, ViewSettings& settings) {
  if (auto set = set_hand(stage, options.servo.haptic_device, settings); !set) return set;
  if (auto set = set_speech(options.speech, stage, settings); !set) return set;
  if (options.kept < 0) return {};
  auto beat = servo::KeptBeat::at(options.kept);
  if (!beat) return tl::unexpected(beat.error());
  settings.kept = std::make_shared<servo::KeptBeat>(std::move(*beat));
  return {};
}

}  // namespace afm::app
