// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drawing/draw_list.h"
#include "drawing/scene_geometry.h"
#include "render/frame.h"

namespace afm::render {

// Visibility of a frame's panels to both eyes.
class PanelSight {
 public:
  // All arguments must outlive the object.
  PanelSight(const FrameState& frame, const SceneGeometry& geometry, const DrawList& draws)
      : frame_(frame), geometry_(geometry), draws_(draws) {}

  // True if the panel is a rectangle with its front towards both eyes.
  bool faces(const PanelPlacement& panel) const;

  // True if objects in front of the panel may hide more than a tenth of it from an eye. Based on the boxes of the
  // draws: it may be true without need, but is never false if they do hide it.
  bool may_be_hidden(const PanelPlacement& panel) const;

  // True if parts of both may be seen in the same place.
  bool may_overlap(const PanelPlacement& a, const PanelPlacement& b) const;

 private:
  double hidden_share(const Draw& draw, const scene::EyeView& eye, const PanelPlacement& panel) const;
  bool reaches_between(const Draw& draw, const scene::EyeView& eye, const PanelPlacement& panel) const;

  const FrameState& frame_;
  const SceneGeometry& geometry_;
  const DrawList& draws_;
};

}  // namespace afm::render
