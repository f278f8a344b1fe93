// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "passes/draw_list.h"
#include "passes/scene_geometry.h"
#include "render/frame.h"

namespace afm::render {

// What both eyes of a frame see of its panels.
class PanelSight {
 public:
  // All must outlive it.
  PanelSight(const FrameState& frame, const SceneGeometry& geometry, const DrawList& draws)
      : frame_(frame), geometry_(geometry), draws_(draws) {}

  // A rectangle, with its front towards both eyes.
  bool faces(const PanelPlacement& panel) const;

  // What is drawn before it may hide more than a tenth of it from an eye. By the boxes of what is drawn: never false
  // where it does.
  bool may_be_hidden(const PanelPlacement& panel) const;

  // Parts of both may be seen in the same place.
  bool may_overlap(const PanelPlacement& a, const PanelPlacement& b) const;

 private:
  double hidden_share(const Draw& draw, const scene::EyeView& eye, const PanelPlacement& panel) const;
  bool reaches_between(const Draw& draw, const scene::EyeView& eye, const PanelPlacement& panel) const;

  const FrameState& frame_;
  const SceneGeometry& geometry_;
  const DrawList& draws_;
};

}  // namespace afm::render
