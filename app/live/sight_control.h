// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "app/view/view_control.h"
#include "render/window_sight.h"

namespace afm::app {

struct ViewParts;

// Notices that nobody sees the sample, since no window that shows it is visible, or none gets a picture. The servo then
// applies no force. A picture that is hidden on purpose, by key X or in a blind step, is seen.
class SightControl final : public ViewControl {
 public:
  // `parts` must outlive it.
  explicit SightControl(ViewParts& parts);

  void begin_frame() override;

 private:
  std::int64_t last_seen_ns(std::int64_t now_ns) const;
  bool blind(std::int64_t now_ns) const;
  std::string cause() const;

  ViewParts& parts_;
  bool shows_stage_;  // this machine's windows, or some of them
  render::WindowSight sight_;
  bool logged_blind_ = false;
};

}  // namespace afm::app
