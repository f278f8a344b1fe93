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

// All controls of a live window, in their order. Main thread only.
class ViewControls {
 public:
  // `parts` must outlive it.
  explicit ViewControls(ViewParts& parts) : parts_(parts) {}

  // Behind the others; must outlive this.
  void add(ViewControl& control) { controls_.push_back(&control); }

  auto begin() const { return controls_.begin(); }
  auto end() const { return controls_.end(); }

  // A servo has been started; `chosen_before` is the material that was chosen at its predecessor.
  void servo_started(servo::ServoClient& servo, std::optional<std::size_t> chosen_before);

  // Returns everything to its state after the start, and starts the servo again if it has ended.
  void begin_again();

  // The same for another visitor.
  void begin_for_visitor();

  // The line above the wall: the first that a control has, otherwise the next step of the procedure.
  std::string guidance(const exhibit::Phrases& phrases) const;

 private:
  ViewParts& parts_;
  std::vector<ViewControl*> controls_;
};

}  // namespace afm::app
