// SPDX-License-Identifier: Apache-2.0
#include "app/live/live_window.h"

#include "app/display/view_picture.h"
#include "app/display/view_windows.h"
#include "app/live/live_view.h"
#include "app/live/view_settings.h"
#include "app/view/live_sound.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_choice.h"
#include "app/view/view_controls.h"
#include "app/view/view_hand.h"
#include "app/view/view_panels.h"
#include "app/view/view_parts.h"
#include "app/view/view_pointer.h"
#include "app/view/view_wand.h"
#include "curves/felt_sources.h"
#include "exhibit/frame/exhibit_setup.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

// Objects shared by the controls, in reverse order of their destruction.
struct LiveWindow {
  LiveWindow(const LiveWindowParts& given, const ViewSettings& settings)
      : panels(given.stage.wall_scene, given.materials, key_list),
        sound(settings.sound, given.stage.phrases(), given.stage.titles(), given.clock),
        servo(
            given.start_servo,
            [this](servo::ServoClient& link, std::optional<std::size_t> chosen_before) {
              controls.servo_started(link, chosen_before);
            },
            given.stage.materials.materials.size(), settings.record_folder, sound.narrator()),
        hand(given.stage, servo, {.source = settings.hand, .device = settings.device_controls}),
        pointer(given.stage, given.picture, panels, servo, given.wand),
        parts{.stage = given.stage,
              .clock = given.clock,
              .windows = given.windows,
              .picture = given.picture,
              .panels = panels,
              .sound = sound,
              .servo = servo,
              .wand = given.wand,
              .hand = hand,
              .pointer = pointer,
              .choice = choice,
              .controls = controls},
        choice(parts, given.materials, {.scale = settings.scale, .first_material = settings.first_material}),
        controls(parts) {
    panels.set_friction(&servo.friction());
    servo.cite([&materials = given.materials](std::size_t material, const scene::SharedContact& felt) {
      return curves::felt_sources(materials[material].setup, felt);
    });
    servo.set_force_map(settings.force_map);
    if (settings.unattended) panels.show_visitors_keys_only();
  }
  LiveWindow(const LiveWindow&) = delete;
  LiveWindow& operator=(const LiveWindow&) = delete;

  ViewPanels panels;
  LiveSound sound;  // before the servo, whose listener it uses
  ServoSupervisor servo;
  ViewHand hand;
  ViewPointer pointer;
  ViewParts parts;
  ViewChoice choice;
  ViewControls controls;
};

}  // namespace

core::Result<void> run_live_window(const LiveWindowParts& given, const ViewSettings& settings,
                                   const LiveFeatures& features) {
  LiveWindow window(given, settings);
  // a panel may lie on the screens of several machines, each with its own graphics device
  if (features.cluster == nullptr) window.panels.set_drawn_by(given.drawn_by);
  LiveControls controls(window.parts, settings, features);
  LiveView loop(window.parts, [&](render::Key key) { controls.press(key); },
                {.most_frames_per_s = settings.most_frames_per_s,
                 .frame_log = settings.frame_log,
                 .unattended = settings.unattended});
  return loop.run();
}

}  // namespace afm::app
