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

// A force map that is felt whole, on its sample: key F10 chooses what is seen of its curves. Sessions of one pixel keep
// what its picture shows.
class MapControl final : public ViewControl {
 public:
  // `equal_force_n` is that of the surface that is shown first; empty: none.
  MapControl(ViewParts& parts, std::optional<double> equal_force_n);

  // Shows the slice, the surface of equal force, both, or neither; without such a map, a line of the log says so.
  void next_volume();

  void add_to_moment(exhibit::Moment& now, ViewFrame& frame) override;
  void add_to_session(servo::WallFrame& shown) const override;
  void add_to_picture(render::FrameState& picture, const ViewFrame& frame) override;
  void restart(Restart what) override;

 private:
  enum class Seen { Nothing, Slice, Surface, Both };

  const curves::SampleModel* map() const;  // null: another sample, or none, is under the tip
  MapView view() const;
  void add_pixel_to_session(servo::WallFrame& shown) const;
  void check_vibration();  // report of a device that cannot vibrate

  ViewParts& parts_;
  exhibit::WallState wall_;  // the frame's
  bool retracting_ = false;
  bool checked_ = false;                               // the vibration, once the device was known
  Seen seen_ = Seen::Nothing, first_ = Seen::Nothing;  // now, and at the start
  std::optional<double> equal_force_n_;
  MapOverlay overlay_;
};

}  // namespace afm::app
