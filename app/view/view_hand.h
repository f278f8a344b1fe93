// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "app/view/key_list.h"
#include "app/view/mouse_hand.h"
#include "exhibit/words/guidance.h"
#include "input/selection.h"
#include "input/simulated_person.h"

namespace afm::exhibit {
struct Stage;
}

namespace afm::app {

class ServoSupervisor;

// The hand of the live window: a device, or the servo's simulated hand, which the mouse or a simulated person moves.
// Main thread only.
class ViewHand {
 public:
  struct Settings {
    HandSource source = HandSource::Mouse;                         // unless the device has a hand of its own
    exhibit::HandControls device = exhibit::HandControls::Device;  // names of its controls
  };

  // Stage and servo must outlive it.
  ViewHand(const exhibit::Stage& stage, ServoSupervisor& servo, const Settings& settings);

  // Who moves the hand now.
  HandSource source() const;
  bool has_own_hand() const;  // the servo's device has one

  // The controls in the person's hands.
  exhibit::Controls controls(exhibit::Pointer pointer) const;

  // Without a visitor the simulated person moves a simulated hand and demonstrates one sample after another.
  void demonstrate(bool on) { demonstrates_ = on; }
  bool demonstrates() const { return demonstrates_; }

  MouseHand& mouse() { return mouse_; }
  void renew_mouse();  // at rest, for another servo

  const input::SimulatedPerson& person() const { return person_; }

  // The simulated person goes to the swatch of a material and feels it.
  void begin_person(std::size_t material, std::int64_t now_ns);

  // A feature moves the simulated hand in place of the person; revision 0: it no longer does.
  void replace_person(const scene::HandScript& script) { replaced_ = script; }

  // Once a frame.
  struct Motion {
    glm::dvec2 cursor_px{0.0};  // on the desktop
    double m_per_px = 0;        // hand travel per pixel of the cursor
    double frame_s = 0;
    std::int64_t now_ns = 0;
  };
  void move(const Motion& motion);

  // The sample was turned: its normal, not necessarily of length 1, and its direction to the right.
  void set_axes(const glm::dvec3& normal, const glm::dvec3& right);

 private:
  const exhibit::Stage& stage_;
  ServoSupervisor& servo_;
  Settings settings_;
  std::vector<input::Target> swatches_;
  MouseHand mouse_;
  input::SimulatedPerson person_;
  scene::HandScript replaced_;
  bool demonstrates_ = false;
};

}  // namespace afm::app
