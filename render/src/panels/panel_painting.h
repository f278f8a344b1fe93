// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panels/canvas.h"
#include "render/frame.h"

namespace afm::render {

inline constexpr float kMargin = 34.0F;  // width around texts and plots, mm

void paint(Canvas& canvas, const ForcePanel& panel);
void paint(Canvas& canvas, const ImagePanel& panel);
void paint(Canvas& canvas, const DataPanel& panel);
void paint(Canvas& canvas, const ListPanel& panel);
void paint(Canvas& canvas, const Banner& banner);
void paint(Canvas& canvas, const ControlPanel& panel);
void paint(Canvas& canvas, const Label& label);

// Letter shown to one eye only; fills the canvas.
struct EyeMark {
  scene::Eye eye = scene::Eye::Left;

  bool operator==(const EyeMark&) const = default;
};
void paint(Canvas& canvas, const CalibrationPanel& panel);
void paint(Canvas& canvas, const EyeMark& mark);

// Relation of a panel to the rest of the picture.
enum class PanelLayer {
  InScene,     // hidden by nearer objects
  OverAll,     // hidden by nothing, since a person must see if a force reaches the hand, wherever the scene
               // has been moved; and a list over the whole wall
  Calibration  // over everything else, only in the pictures of the eyes
};
template <class Content>
inline constexpr PanelLayer kLayerOf = PanelLayer::InScene;
template <>
inline constexpr PanelLayer kLayerOf<Banner> = PanelLayer::OverAll;
template <>
inline constexpr PanelLayer kLayerOf<ListPanel> = PanelLayer::OverAll;
template <>
inline constexpr PanelLayer kLayerOf<CalibrationPanel> = PanelLayer::Calibration;

}  // namespace afm::render
