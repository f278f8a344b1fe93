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

// The hand of the live window: a device, or the servo's simulated hand, moved by the mouse or a simulated person. Main
// thread only.
class ViewHand {
 public:
  struct Settings {
    HandSource source = HandSource::Mouse;                         // mover of a simulated hand; unused for a real one
    exhibit::HandControls device = exhibit::HandControls::Device;  // names of the device's controls
  };

  // Stage and servo must outlive the object.
  ViewHand(const exhibit::Stage& stage, ServoSupervisor& servo, const Settings& settings);

  // Current mover of the hand.
  HandSource source() const;
  bool has_own_hand() const;  // true if the servo's device is moved by a real hand

  // Names of the controls that the person uses.
  exhibit::Controls controls(exhibit::Pointer pointer) const;

  // Lets the simulated person move a simulated hand and demonstrate each sample in turn, while there is no visitor.
  void demonstrate(bool on) { demonstrates_ = on; }

  MouseHand& mouse() { return mouse_; }
  void renew_mouse();  // puts the mouse hand at rest, after the start of another servo

  const input::SimulatedPerson& person() const { return person_; }

  // Makes the simulated person go to a material's swatch and feel it.
  void begin_person(std::size_t material, std::int64_t now_ns);

  // Lets a feature move the simulated hand instead of the person; revision 0: ends this.
  void replace_person(const scene::HandScript& script) { replaced_ = script; }

  // Input of one frame.
  struct Motion {
    glm::dvec2 cursor_px{0.0};  // desktop coordinates
    double m_per_px = 0;        // hand travel per pixel of the cursor
    double frame_s = 0;
    std::int64_t now_ns = 0;
  };
  void move(const Motion& motion);

  // Sets the axes of a turned sample: its normal, of any length, and its direction to the right.
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
