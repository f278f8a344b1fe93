// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "app/view/map_overlay.h"
#include "app/view/view_control.h"
#include "exhibit/state/wall_state.h"

namespace afm::curves {
struct SampleModel;
}

namespace afm::app {

struct ViewParts;

// A whole felt force map on its sample; key F10 selects the visible part of its curves. Sessions of one pixel store
// the quantity of its picture.
class MapControl final : public ViewControl {
 public:
  // `equal_force_n` is the force of the surface shown first; empty: none.
  MapControl(ViewParts& parts, std::optional<double> equal_force_n);

  // Shows the slice, the surface of equal force, both, or neither; without such a map, logs that there is none.
  void next_volume();

  void add_to_moment(exhibit::Moment& now, ViewFrame& frame) override;
  void add_to_session(servo::WallFrame& shown) const override;
  void add_to_picture(render::FrameState& picture, const ViewFrame& frame) override;
  void restart(Restart what) override;

 private:
  enum class Seen { Nothing, Slice, Surface, Both };

  const curves::SampleModel* map() const;  // map under the tip; null: another sample, or none
  MapView view() const;
  void add_pixel_to_session(servo::WallFrame& shown) const;
  void check_vibration();  // logs if the device cannot vibrate

  ViewParts& parts_;
  exhibit::WallState wall_;  // wall of the current frame
  bool retracting_ = false;
  bool checked_ = false;                               // true: vibration checked, since the device is known
  Seen seen_ = Seen::Nothing, first_ = Seen::Nothing;  // current part, and the one at the start
  std::optional<double> equal_force_n_;
  MapOverlay overlay_;
};

}  // namespace afm::app
