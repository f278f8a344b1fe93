// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "exhibit/scenery/journey.h"
#include "exhibit/scenery/stage_place.h"
#include "exhibit/scenery/wall_layout.h"
#include "exhibit/state/wall_state.h"
#include "render/frame.h"

namespace afm::exhibit {

// The composition of a wall of any shape: the places of panels, shelf, swatches and wand.
class WallPlaces {
 public:
  WallPlaces() = default;

  // Computes the layout for this number of swatches from the screens and the viewer in front of them.
  WallPlaces(const StagePlace& stage, std::size_t swatches);

  // Frame with its origin at the contact point, x right, y up, z to the viewer; unit: one metre of the paper's wall.
  const glm::dmat4& room_from_layout() const { return room_from_layout_; }
  // View of the whole main screen.
  const Journey::View& journey_view() const { return journey_view_; }
  double unit_m() const;  // size of one layout unit in metres
  double shelf_y() const { return shelf_y_; }
  double height_bar_x() const { return height_bar_x_; }
  // Left end of the plate with the word and number of a jump, limited so that no eye sees it over the left panel.
  double cue_left() const { return cue_left_; }
  render::PanelPlacement height_bar_text(double share) const;  // number beside the scale, 0 at its foot, 1 at its head

  // Place of swatch `i` of `count` in the layout.
  glm::dvec3 swatch(std::size_t i, std::size_t count) const;

  glm::dvec3 wand_grip_m() const;

  // Places beyond the two panels, if the wall is wide enough and the viewer need not turn far: for the images of a
  // scan, and for the content that replaces the data elsewhere.
  struct Far {
    render::PanelPlacement left, right;
  };
  const std::optional<Far>& far() const { return far_; }

  // Panel of a material's parameters, in place of its data, and the target that opens it.
  render::PanelPlacement parameters() const;
  render::PanelPlacement parameter_tab() const;

  // Placement of the list of keys: over everything below the banner.
  render::PanelPlacement keys() const;

  // Placement of a short note below the left panel.
  render::PanelPlacement note() const;

  // Placement of the ruler's number, beside a ruler of this length: at its right, or at its left if something else
  // is at the right.
  enum class RulerSide { Left, Right };
  render::PanelPlacement ruler_text(double length, RulerSide side) const;

  // Placement of a rung of the journey's ladder, numbered from the lowest.
  render::PanelPlacement rung(std::size_t i) const;

  // A rectangle of the layout in the wall's plane, or in the scene's.
  render::PanelPlacement in_wall(double left, double bottom, double width, double height) const;
  render::PanelPlacement in_scene(double left, double bottom, double width, double height) const;

  void place_panels(const WallState& state, render::FrameState& frame) const;

 private:
  void lay_out_front(const StagePlace& stage);
  void lay_out_panels(const StagePlace& stage);
  void lay_out_far_panels(const StagePlace& stage);
  void lay_out_cue(const StagePlace& stage);
  void lay_out_height_bar(const StagePlace& stage, std::size_t swatches);
  render::PanelPlacement finale() const;  // placement of the large plot
  render::PanelPlacement right_of_data(double inset) const;

  glm::dmat4 room_from_layout_{1.0};
  Journey::View journey_view_;
  glm::dmat4 room_from_wall_{1.0};  // room_from_layout_ with y along the main screen; differs if that lies flat
  WallShape shape_;
  double half_width_ = 0;  // half width of the composition in layout units
  double wall_bottom_ = 0, wall_top_ = 0;
  double shelf_y_ = 0, shelf_z_ = 0, back_z_ = 0;
  double height_bar_x_ = 0;
  double cue_left_ = kCuePlace.x;
  glm::dvec3 wand_grip_{0.0};
  render::PanelPlacement force_placement_, data_placement_;
  std::optional<Far> far_;
};

}  // namespace afm::exhibit
