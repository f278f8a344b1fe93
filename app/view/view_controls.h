// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/view/view_control.h"

namespace afm::servo {
class ServoClient;
}

namespace afm::app {

struct ViewParts;

// All controls of a live window, in order. Main thread only.
class ViewControls {
 public:
  // `parts` must outlive it.
  explicit ViewControls(ViewParts& parts) : parts_(parts) {}

  // Adds the control after the others; it must outlive the object.
  void add(ViewControl& control) { controls_.push_back(&control); }

  auto begin() const { return controls_.begin(); }
  auto end() const { return controls_.end(); }

  // Call after a start of a servo; `chosen_before` is the material that was selected at the previous servo.
  void servo_started(servo::ServoClient& servo, std::optional<std::size_t> chosen_before);

  // Returns everything to its initial state, and restarts the servo if it has ended.
  void begin_again();

  // Same for another visitor.
  void begin_for_visitor();

  // Line above the wall: from the first control that has one, otherwise the next step of the procedure.
  std::string guidance(const exhibit::Phrases& phrases) const;

 private:
  ViewParts& parts_;
  std::vector<ViewControl*> controls_;
};

}  // namespace afm::app
