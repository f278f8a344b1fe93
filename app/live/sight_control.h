// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "app/view/view_control.h"
#include "render/window_sight.h"

namespace afm::app {

struct ViewParts;

// Detects that nobody sees the sample, because no window that shows it is visible or gets a picture. The servo then
// applies no force. A picture that is hidden on purpose, by key X or in a blind step, counts as seen.
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
  bool shows_stage_;  // true: sample shown in at least one of this machine's windows
  render::WindowSight sight_;
  bool logged_blind_ = false;
};

}  // namespace afm::app
