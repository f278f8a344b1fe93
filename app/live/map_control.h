// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "app/view/view_control.h"
#include "exhibit/models/relief.h"
#include "exhibit/scan/map_picture.h"
#include "exhibit/state/wall_state.h"

namespace afm::app {

struct ViewParts;

// A force map that is felt whole, on its sample: the quantity of its picture in false colours.
class MapControl final : public ViewControl {
 public:
  explicit MapControl(ViewParts& parts) : parts_(parts) {}

  void add_to_moment(exhibit::Moment& now, ViewFrame& frame) override;
  void add_to_picture(render::FrameState& picture, const ViewFrame& frame) override;

 private:
  // What was laid on the sample last.
  struct Laid {
    exhibit::MapQuantity quantity{};
    double release_z_m = 0;  // as in exhibit::WallState: the sample's size
    exhibit::HeightRelief relief;
  };

  const curves::SampleModel* map() const;  // null: another sample, or none, is under the tip
  void lay_colours(const curves::SampleModel& map, render::FrameState& picture);

  ViewParts& parts_;
  exhibit::WallState wall_;  // of this frame
  std::optional<Laid> laid_;
};

}  // namespace afm::app
