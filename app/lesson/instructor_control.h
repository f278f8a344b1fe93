// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "app/view/view_control.h"
#include "render/key.h"

namespace afm::exhibit {
enum class InstructorAction;
class LiveLesson;
}  // namespace afm::exhibit

namespace afm::app {

class InstructorWindow;
struct ViewParts;

// The instructor of a lesson, who uses a separate window.
class InstructorControl final : public ViewControl {
 public:
  // `press_key` receives the keys meant for the wall. All arguments must outlive the object.
  InstructorControl(ViewParts& parts, exhibit::LiveLesson& lesson, InstructorWindow& window,
                    std::function<void(render::Key)> press_key);

  void take(const ViewInput& input, const ViewFrame& frame) override;
  void shown(const ViewFrame& frame, const Beat& beat) override;

 private:
  void press(render::Key key);
  void act(exhibit::InstructorAction action, std::int64_t now_ns);

  ViewParts& parts_;
  exhibit::LiveLesson& lesson_;
  InstructorWindow& window_;
  std::function<void(render::Key)> press_key_;
  bool hand_off_ = false;  // true: force disabled by the instructor
  std::optional<std::int64_t> stop_asked_ns_;
};

}  // namespace afm::app
