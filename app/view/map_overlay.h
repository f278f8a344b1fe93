// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

namespace afm::curves {
class ForceVolume;
struct SampleModel;
}  // namespace afm::curves
namespace afm::exhibit {
struct Stage;
class VolumeView;
struct WallState;
}  // namespace afm::exhibit
namespace afm::render {
struct FrameState;
}

namespace afm::app {

class ViewPanels;

// Visible part of a whole felt map's curves. SI.
struct MapView {
  bool slice = false;
  std::optional<double> equal_force_n{};  // force of the surface; empty: no surface
};

// A whole felt map on its sample: the quantity of its picture in false colours, a slice through its curves,
// and the surface on which they have one force. Shared by the live window and by moments of its session. One
// thread.
class MapOverlay {
 public:
  // Both must outlive the object. The panels determine the quantity.
  MapOverlay(const exhibit::Stage& stage, ViewPanels& panels);
  ~MapOverlay();

  // Curves of the stage's map; null if none is felt whole, or if it has no curve to look at.
  static const curves::ForceVolume* volume_of(const exhibit::Stage& stage);

  // Adds it to a frame that has its panels. `sample` is the one below the tip; no effect unless it is a whole map.
  void add_to(render::FrameState& picture, const curves::SampleModel& sample, const exhibit::WallState& wall,
              bool retracting, const MapView& view);

 private:
  struct Laid;  // newest map laid on the sample

  void lay_colours(const curves::SampleModel& map, const exhibit::WallState& wall, render::FrameState& picture);

  const exhibit::Stage& stage_;
  ViewPanels& panels_;
  std::unique_ptr<const Laid> laid_;             // map laid on the sample; null: none
  std::unique_ptr<exhibit::VolumeView> volume_;  // null until something was shown
};

}  // namespace afm::app
