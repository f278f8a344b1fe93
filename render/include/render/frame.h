// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/members.h"
#include "scene/display/wall.h"
#include "scene/graph/scene.h"

// Contents of a frame, as plain data: everything that the renderer needs in addition to the constant Scene. No Vulkan
// types.
namespace afm::render {

// Bends the mesh of one node like an end-loaded beam (physics/beam_shape.h), clamped at x = 0 and loaded at x = L,
// along the node's +x; displacement along the node's +z, in the node's units. Normals follow the slope.
struct BeamBend {
  scene::NodeIndex node = 0;
  float length = 1.0F;
  float end_deflection = 0.0F;
};

// One key light with a shadow; the rest is the procedural environment.
struct KeyLight {
  glm::vec3 direction_to_light{0.3F, 0.8F, 0.5F};  // room frame, any length
  glm::vec3 radiance{2.9F, 2.7F, 2.45F};
  glm::vec3 shadow_center_m{0.0F};  // the shadow covers a sphere of this centre and radius
  float shadow_radius_m = 2.5F;
};

// Mark at the contact point: a soft shadow that deepens as the tip approaches and, briefly after a jump, a ring of
// light at the distance `ring_radius_m`.
struct ContactMark {
  glm::vec3 place_m{0.0F};      // the apex
  float shade_radius_m = 0.0F;  // 0: no mark
  glm::vec3 ring_color{0.0F};   // linear radiance
  float ring_radius_m = 0.0F;
};

// Dissolves what is drawn into the background: everything by `veil`, and what lies far away by its distance. With a
// range, things may be far larger than the room: what is read, panels and what is unlit, is then drawn before all else.
struct Fog {
  float fade = 0.0F;                   // 0: clear, 1: nothing but the background
  float begin_m = 0.0F, end_m = 0.0F;  // from the origin; equal: no range
  glm::dvec3 origin_m{0.0};
  glm::dvec3 away{0.0, 0.0, -1.0};  // unit; distances count along it
};

// A light of the scene, placed in the room (KHR_lights_punctual). It adds to the environment and casts no shadow.
struct PlacedLight {
  scene::PunctualLight light;
  glm::vec3 position_m{0.0F};
  glm::vec3 direction{0.0F, 0.0F, -1.0F};  // of its rays, unit
};

// Further lights are not drawn.
inline constexpr std::size_t kMostPlacedLights = 16;

// A rectangle in the room that shows a drawn panel: lower-left corner, and edges to the right and up, in metres.
// Without area the panel is not shown.
struct PanelPlacement {
  glm::dvec3 lower_left_m{0.0};
  glm::dvec3 right_m{1.0, 0.0, 0.0};
  glm::dvec3 up_m{0.0, 1.0, 0.0};

  bool operator==(const PanelPlacement&) const = default;
};

// ---- panel contents ----

struct PlotPoint {
  double place_nm = 0;
  double force_nn = 0;

  bool operator==(const PlotPoint&) const = default;
};

// One approach-retract curve. Approach is drawn dashed and thinner, retract solid: they differ in more than colour.
struct PlotCurve {
  std::string label;
  glm::vec3 color{1.0F};  // sRGB
  bool faded = false;     // an earlier material, behind
  std::vector<PlotPoint> approach;
  std::vector<PlotPoint> retract;

  bool operator==(const PlotCurve&) const = default;
};

struct PlotMarker {  // a labelled value: "Z_jtc 2.40 nm"
  enum class Kind { VerticalLine, HorizontalLine } kind = Kind::VerticalLine;
  double value = 0;   // nm on the axis of places, nN on the force axis
  std::string label;  // empty: the line alone

  bool operator==(const PlotMarker&) const = default;
};

// The words of a plot.
struct PlotWords {
  std::string approach, retract;  // what dashed and solid mean; empty: the labels say it
  std::string place_axis = "Z (nm)", force_axis = "F (nN)";
  char decimal_mark = '.';

  bool operator==(const PlotWords&) const = default;
};

struct DataRow {
  std::string name, value, source;

  bool operator==(const DataRow&) const = default;
};

// A force over a place. The force-displacement panel: Z (nm) to the right, force on the tip (nN, positive away from the
// sample) up. The friction loop: lateral displacement and force, each stroke a curve.
struct ForcePanel {
  std::string title;
  PlotWords words{};
  double place_min_nm = -5, place_max_nm = 20, force_min_nn = -2, force_max_nn = 1;
  std::vector<PlotCurve> curves;
  std::vector<PlotMarker> markers;
  std::optional<PlotPoint> cursor;  // where the tip is now
  std::string stage;                // the part of the cycle in words, with the letters of the paper's Fig. 2
  std::vector<DataRow> figures;     // what follows from the curves, in a row above them, without sources

  bool operator==(const ForcePanel&) const = default;
};

struct DataPanel {
  std::string title;
  std::string subtitle;
  std::vector<DataRow> rows;

  bool operator==(const DataPanel&) const = default;
};

enum class StateShape { Circle, Triangle, Square, Diamond, Cross };

// The line above: guidance, the servo's state in a word and a shape, and the scale.
struct Banner {
  std::string guidance;
  std::string state_word;
  StateShape state_shape = StateShape::Circle;
  glm::vec3 state_color{1.0F};  // sRGB
  std::string scale;            // "sample and motion: 1 m = 33 nm ..."; the second line: hand and servo
  std::string warning;          // "not real-time", empty for none

  bool operator==(const Banner&) const = default;
};

struct Label {  // a short text standing in the room: a swatch's name
  std::string text;
  bool highlighted = false;
  PanelPlacement placement;

  bool operator==(const Label&) const = default;
};

// Target of a ray on a ControlPanel.
struct ControlTarget {
  enum class Kind { Less, More, Button } kind = Kind::Less;
  std::size_t index = 0;  // of the row, or of the button

  bool operator==(const ControlTarget&) const = default;
};

struct ControlRow {  // a value with a target to make it less and one to make it more
  std::string name, value;
  bool changed = false;  // not what it was at first

  bool operator==(const ControlRow&) const = default;
};

// Values that are changed by pointing (render/control_layout.h says where its targets stand).
struct ControlPanel {
  std::string title;
  std::vector<std::string> buttons;  // beside the title
  std::vector<ControlRow> rows;
  std::vector<std::string> notes;  // what follows from the values, a line each
  std::string status;              // what has become of the last change
  std::optional<ControlTarget> pointed;
  std::optional<std::size_t> marked;  // the row that keys change

  bool operator==(const ControlPanel&) const = default;
};

// A grid of colours, row by row from the top.
struct ColorGrid {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::vector<std::array<std::uint8_t, 4>> colors;  // sRGB and coverage; columns * rows of them

  bool operator==(const ColorGrid&) const = default;
};

// One quantity of a scan as a picture: what has not been measured has no coverage.
struct ImageMap {
  std::string title;
  ColorGrid grid;

  bool operator==(const ImageMap&) const = default;
};

// Lines over one axis: along a line of the scan, or across a tip.
struct ProfilePlot {
  struct Line {
    std::string label;
    glm::vec3 color{1.0F};  // sRGB
    bool dashed = false;    // so that lines differ in more than colour
    std::vector<glm::vec2> points;

    bool operator==(const Line&) const = default;
  };
  std::string title;
  glm::dvec2 low{0.0}, high{1.0};  // of the axes
  std::vector<Line> lines;

  bool operator==(const ProfilePlot&) const = default;
};

// What a scan has measured so far: trace and retrace of the height large and beside each other, with axes, a scale bar
// and a bar of colours; below or beside them smaller what else is measured, and the newest line.
struct ImagePanel {
  std::string title, subtitle;
  std::array<ImageMap, 2> heights;  // trace, retrace
  std::vector<ImageMap> smaller;    // error signal, lateral force
  ProfilePlot profile;              // the newest line
  std::string side_unit;            // of the two below
  double side = 1;                  // of the area, which is a square
  double scale_bar = 1;             // a round length
  std::optional<double> line;       // 0 at the top to 1: where the tip scans now
  double bar_low_nm = 0, bar_high_nm = 1;
  std::vector<glm::vec3> bar;  // colours from the lowest height to the highest
  char decimal_mark = '.';

  bool operator==(const ImagePanel&) const = default;
};

// The picture for setting up a screen, at true scale on all of it: a grid in centimetres or decimetres, a cross in the
// wall's plane, a circle, a ruler of eye distances, grey steps; and, where the eyes have pictures of their own, an L
// that the left eye's alone shows, an R in the right eye's. Nothing else should be shown with it.
struct CalibrationPanel {
  std::string size;       // of the screen, with its name
  std::string mode;       // of stereo
  std::string legend;     // of grid and letters
  std::string ruler;      // its legend
  double square_m = 0.1;  // of the grid
  double ipd_m = 0;       // of the viewer, marked on the ruler
  bool eye_marks = true;
  glm::dvec2 grid_from_m{0.0};               // a crossing of the grid: right of and below the screen's middle
  std::array<scene::EdgeRamp, 4> ramps{};    // of blending, by scene::ScreenEdge
  std::array<std::string, 4> ramp_widths{};  // as text; empty: no ramp

  bool operator==(const CalibrationPanel&) const = default;
};

// A panel without area: not shown.
inline constexpr PanelPlacement kNoPlacement{
    .lower_left_m = glm::dvec3(0.0), .right_m = glm::dvec3(0.0), .up_m = glm::dvec3(0.0)};

// A panel with a place of its own in every frame.
template <class Content>
struct PanelSlot {
  Content content{};
  PanelPlacement placement = kNoPlacement;
};

// All panels but the labels. Painting, drawing, hiding and the digest visit the members, so that a new slot is part of
// all of them (docs/adding-a-panel.md). A later panel covers an earlier one.
struct FramePanels {
  PanelSlot<ForcePanel> force;
  PanelSlot<ImagePanel> image;  // in the place of the force
  PanelSlot<ForcePanel> loop;   // friction loop, in the place of the data
  PanelSlot<DataPanel> data;
  PanelSlot<ControlPanel> control;  // in the place of the data
  PanelSlot<Banner> banner;         // covers whatever is there, labels too
  PanelSlot<CalibrationPanel> calibration;
};

inline void hide(FramePanels& panels) {
  core::for_each_member([](auto& slot) { slot.placement = kNoPlacement; }, panels);
}

// ---- the frame ----

struct FrameState {
  std::array<scene::EyeView, 2> eyes;         // left, right; reversed infinite depth
  std::vector<glm::dmat4> room_from_node;     // one per scene node
  std::vector<std::uint8_t> visible;          // one per scene node, 0 hides the node's own mesh
  std::vector<scene::NodeIndex> highlighted;  // these and all below them glow: what the wand points at or has chosen
  std::vector<BeamBend> bends;
  KeyLight key_light;
  ContactMark contact;
  Fog fog;
  std::vector<PlacedLight> lights;  // only if the scene has lights
  FramePanels panels;
  std::vector<Label> labels;
  std::size_t panels_apart = 0;  // at most so many panels are left out of the pictures of the eyes (Headset::show())
};

// An image in host memory: 8-bit sRGB RGBA, rows from top to bottom.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;
};

}  // namespace afm::render
