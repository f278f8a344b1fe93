// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/view/view_control.h"
#include "input/idle_watch.h"

namespace afm::app {

struct ViewParts;

// A live window without staff: restarts for every visitor, and demonstrates itself in between.
class VisitorControl final : public ViewControl {
 public:
  // `idle_s`: seconds without input before the demonstration starts.
  VisitorControl(ViewParts& parts, double idle_s);

  void notice(const ViewInput& input, const ViewFrame& frame) override;
  void take(const ViewInput& input, const ViewFrame& frame) override;
  std::optional<std::string> guidance(const exhibit::Phrases& phrases) const override;

 private:
  void demonstrate_next();
  bool hand_was_used();

  ViewParts& parts_;
  input::IdleWatch watch_;
  glm::dvec3 hand_seen_m_{0.0};  // position of a device's hand at its last motion
  std::uint32_t presses_seen_ = 0;
  std::int64_t wand_seen_ns_ = 0;
  glm::dvec2 cursor_seen_px_{0.0};
};

}  // namespace afm::app
