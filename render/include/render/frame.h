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

// Bends the mesh of one node like an end-loaded beam (physics/beam_shape.h), clamped at x = 0 and loaded at x = L. The
// beam lies along the node's +x and bends along its +z, in the node's units. Normals follow the slope.
struct BeamBend {
  scene::NodeIndex node = 0;
  float length = 1.0F;
  float end_deflection = 0.0F;
};

// Copy of a node's mesh: scaled, turned and moved in the node's frame. Shaders read it as it is.
struct MeshCopy {
  glm::vec3 place{0.0F};  // place of the mesh's origin, in the node's units
  float scale = 1.0F;
  glm::vec4 turn{0.0F, 0.0F, 0.0F, 1.0F};  // unit quaternion, w last
  glm::vec4 tint{1.0F};                    // rgb: linear, multiplies the base colour; a: unused

  bool operator==(const MeshCopy&) const = default;
};

// Copies shown in place of the mesh of a node, at most scene::Node::most_copies. A node with room for copies and
// without this entry shows nothing.
struct MeshCopies {
  scene::NodeIndex node = 0;
  std::vector<MeshCopy> copies;
};

// Vertices of a node's mesh in this frame, as many as the mesh has and within its box, in place of those it was loaded
// with. A node with scene::Node::reshaped and without this entry shows nothing. Such a mesh casts no shadow.
struct MeshShape {
  scene::NodeIndex node = 0;
  std::vector<scene::Vertex> vertices;
};

// One key light with a shadow; the rest is the procedural environment.
struct KeyLight {
  glm::vec3 direction_to_light{0.3F, 0.8F, 0.5F};  // room frame, any length
  glm::vec3 radiance{2.9F, 2.7F, 2.45F};
  glm::vec3 shadow_center_m{0.0F};  // the shadow covers a sphere of this centre and radius
  float shadow_radius_m = 2.5F;
  float map_share = 1.0F;  // strength of the shadows of the scene's own triangles, 0 (none) to 1
};

// Shade of a cone that rests on its rounded end: computed, with a soft edge at every scale, for a caster
// far larger than the area of its shadow. In frames with fog or a fade.
struct ConeShade {
  glm::vec3 apex_m{0.0F};            // lowest point
  glm::vec3 axis{0.0F, 1.0F, 0.0F};  // unit vector from the apex into the cone
  float radius_m = 0.0F;             // radius of the rounded end
  float slope = 0.0F;                // growth of the radius along the axis
  float height_m = 0.0F;
  float share = 0.0F;  // strength of the shade; 0: none
};

// Mark at the contact point: a soft shadow that deepens as the tip approaches and, briefly after a jump, a ring of
// light with radius `ring_radius_m`.
struct ContactMark {
  glm::vec3 place_m{0.0F};      // place of the tip's apex
  float shade_radius_m = 0.0F;  // radius of the shadow; 0: no mark
  glm::vec3 ring_color{0.0F};   // linear radiance
  float ring_radius_m = 0.0F;
};

// Fades the picture into the background: the whole picture by `fade`, distant objects by distance. With a range,
// objects may be far larger than the room; text, panels and unlit objects are then drawn first.
struct Fog {
  float fade = 0.0F;                   // 0: clear, 1: background only
  float begin_m = 0.0F, end_m = 0.0F;  // distances from the origin; equal: no range
  glm::dvec3 origin_m{0.0};
  glm::dvec3 away{0.0, 0.0, -1.0};  // unit vector along which distances are measured
};

// Light of the scene, placed in the room (KHR_lights_punctual). It adds to the environment and casts no shadow.
struct PlacedLight {
  scene::PunctualLight light;
  glm::vec3 position_m{0.0F};
  glm::vec3 direction{0.0F, 0.0F, -1.0F};  // unit vector along the rays
};

// Limit on placed lights; further ones are not drawn.
inline constexpr std::size_t kMostPlacedLights = 16;

// Rectangle in the room that shows a panel: lower-left corner, and edges to the right and up, in metres. A panel
// without area is not shown.
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

// One approach-retract curve. Approach is dashed and thinner, retract solid, so that they differ in more than colour.
struct PlotCurve {
  std::string label;
  glm::vec3 color{1.0F};  // sRGB
  bool faded = false;     // earlier material, drawn in the background
  bool filled = false;    // true: area between both branches filled, the energy of the loop
  std::vector<PlotPoint> approach;
  std::vector<PlotPoint> retract;

  bool operator==(const PlotCurve&) const = default;
};

struct PlotMarker {  // labelled value: "Z_jtc 2.40 nm"
  enum class Kind { VerticalLine, HorizontalLine } kind = Kind::VerticalLine;
  double value = 0;   // nm on the position axis, nN on the force axis
  std::string label;  // empty: line only

  bool operator==(const PlotMarker&) const = default;
};

// Legend and axis texts of a plot.
struct PlotWords {
  std::string approach, retract;  // legend of the dashed and the solid line; empty: no legend, since labels suffice
  std::string place_axis = "Z (nm)", force_axis = "F (nN)";
  char decimal_mark = '.';

  bool operator==(const PlotWords&) const = default;
};

struct DataRow {
  std::string name, value, source;
  bool detail = false;  // true: source shown only among the details of the panel

  bool operator==(const DataRow&) const = default;
};

// Plot of force against position. For the force-displacement panel: Z (nm) to the right, force on the tip (nN, positive
// away from the sample) up. For the friction loop: lateral displacement and force, one curve per stroke.
struct ForcePanel {
  std::string title;
  PlotWords words{};
  double place_min_nm = -5, place_max_nm = 20, force_min_nn = -2, force_max_nn = 1;
  std::vector<PlotCurve> curves;
  std::vector<PlotMarker> markers;
  std::optional<PlotPoint> cursor;  // current position of the tip
  std::string stage;                // current part of the cycle, with the letters of the paper's Fig. 2
  std::string live;                 // current force in the largest digits, "\u22120.41 nN"; empty: none
  std::vector<DataRow> figures;     // quantities derived from the curves, in a row above them, without sources

  bool operator==(const ForcePanel&) const = default;
};

struct DataPanel {
  std::string title;
  std::string subtitle;
  std::vector<DataRow> rows;
  bool details = true;  // true: all sources; false: only those not marked as details, larger if there is room

  bool operator==(const DataPanel&) const = default;
};

// A list over the whole composition, in columns: each row has a name and a value.
struct ListPanel {
  DataPanel list;

  bool operator==(const ListPanel&) const = default;
};

enum class StateShape { Circle, Triangle, Square, Diamond, Cross };

// Line above the picture: guidance, the state of the servo as a word and a shape, and the scale.
struct Banner {
  std::string guidance;
  std::string state_word;
  StateShape state_shape = StateShape::Circle;
  glm::vec3 state_color{1.0F};  // sRGB
  std::string scale;            // scale of sample and motion, "1 m = 33 nm ..."; second line: hand and servo
  std::string warning;          // "not real-time"; empty: none

  bool operator==(const Banner&) const = default;
};

struct Label {  // short text in the room, such as a swatch's name
  std::string text;
  bool highlighted = false;
  PanelPlacement placement;

  bool operator==(const Label&) const = default;
};

inline constexpr std::uint32_t kMostGridCells = 510;  // in each direction, for all panels

// Grid of colours, row by row from the top; at most kMostGridCells in each direction.
struct ColorGrid {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::vector<std::array<std::uint8_t, 4>> colors;  // sRGB and coverage; columns * rows entries

  bool operator==(const ColorGrid&) const = default;
};

// Target that a ray can hit on a ControlPanel.
struct ControlTarget {
  enum class Kind { Less, More, Button, Pixel } kind = Kind::Less;
  std::size_t index = 0;  // index of the row or button; for a map's pixel, row by row from the top left

  bool operator==(const ControlTarget&) const = default;
};

struct ControlRow {  // value with one target to decrease it and one to increase it
  std::string name, value;
  bool changed = false;  // true: different from its initial value

  bool operator==(const ControlRow&) const = default;
};

// A map in false colours, each of whose pixels can be pointed at.
struct MapPicture {
  std::string title;
  std::uint32_t columns = 1, rows = 1;  // size of the map; its grid may be smaller
  double aspect = 1;                    // ratio of width to height
  ColorGrid grid;
  std::size_t marked = 0;       // felt pixel, as ControlTarget::index
  std::vector<glm::vec3> bar;   // colours from the lowest to the highest value
  std::string lowest, highest;  // ends of the range, with unit

  bool operator==(const MapPicture&) const = default;
};

// Panel of values that are changed by pointing; render/control_layout.h has the positions of its targets.
struct ControlPanel {
  std::string title;
  std::vector<std::string> buttons;  // texts of the buttons beside the title
  std::vector<ControlRow> rows;
  std::vector<std::string> notes;  // results derived from the values, one per line
  std::string status;              // outcome of the last change
  std::optional<ControlTarget> pointed;
  std::optional<std::size_t> marked;  // row changed by keys
  std::optional<MapPicture> picture;  // below the notes

  bool operator==(const ControlPanel&) const = default;
};

// One quantity of a scan as a picture. Unmeasured pixels have no coverage.
struct ImageMap {
  std::string title;
  ColorGrid grid;

  bool operator==(const ImageMap&) const = default;
};

// Lines over one axis: along a scan line, or across a tip.
struct ProfilePlot {
  struct Line {
    std::string label;
    glm::vec3 color{1.0F};  // sRGB
    bool dashed = false;    // true: dashed, so that lines differ in more than colour
    std::vector<glm::vec2> points;

    bool operator==(const Line&) const = default;
  };
  std::string title;
  glm::dvec2 low{0.0}, high{1.0};  // ends of the axes
  std::vector<Line> lines;

  bool operator==(const ProfilePlot&) const = default;
};

// Results of a scan so far: trace and retrace of the height, large and side by side, with axes, a scale bar and a
// colour bar; below or beside them, smaller, the other quantities and the newest line.
struct ImagePanel {
  std::string title, subtitle;
  std::array<ImageMap, 2> heights;  // trace, retrace
  std::vector<ImageMap> smaller;    // error signal, lateral force
  ProfilePlot profile;              // plot of the newest line
  std::string side_unit;            // unit of `side` and `scale_bar`
  double side = 1;                  // side of the scanned square
  double scale_bar = 1;             // round length of the scale bar
  std::optional<double> line;       // scan position, 0 at the top to 1 at the bottom
  double bar_low_nm = 0, bar_high_nm = 1;
  std::vector<glm::vec3> bar;  // colours from the lowest to the highest height
  char decimal_mark = '.';

  bool operator==(const ImagePanel&) const = default;
};

// Picture for setting up a screen, at true scale over its whole area: a grid in centimetres or decimetres, a cross in
// the wall's plane, a circle, a ruler of eye distances and grey steps. If the eyes have separate pictures, it shows an
// L to the left eye only and an R to the right eye only. Nothing else should be shown with it.
struct CalibrationPanel {
  std::string size;       // size of the screen, with its name
  std::string mode;       // stereo mode
  std::string legend;     // legend of grid and letters
  std::string ruler;      // legend of the ruler
  double square_m = 0.1;  // grid spacing
  double ipd_m = 0;       // viewer's eye distance, marked on the ruler
  bool eye_marks = true;
  glm::dvec2 grid_from_m{0.0};               // one grid crossing, right of and below the screen centre
  std::array<scene::EdgeRamp, 4> ramps{};    // blending ramps, indexed by scene::ScreenEdge
  std::array<std::string, 4> ramp_widths{};  // ramp widths as text; empty: no ramp

  bool operator==(const CalibrationPanel&) const = default;
};

// Placement of a hidden panel, without area.
inline constexpr PanelPlacement kNoPlacement{
    .lower_left_m = glm::dvec3(0.0), .right_m = glm::dvec3(0.0), .up_m = glm::dvec3(0.0)};

// A panel with its own placement in every frame.
template <class Content>
struct PanelSlot {
  Content content{};
  PanelPlacement placement = kNoPlacement;
};

// All panels but the labels. Painting, drawing, hiding and the digest visit the members, so that a new slot is part of
// all of them (docs/adding-a-panel.md). A later panel covers an earlier one.
struct FramePanels {
  PanelSlot<ForcePanel> force;
  PanelSlot<ImagePanel> image;  // in place of the force panel
  PanelSlot<ForcePanel> loop;   // friction loop, in place of the data panel
  PanelSlot<DataPanel> data;
  PanelSlot<DataPanel> particles;   // in place of the data panel
  PanelSlot<ControlPanel> control;  // in place of the data panel
  PanelSlot<ListPanel> keys;        // over everything, including labels
  PanelSlot<Banner> banner;         // over everything, including labels
  PanelSlot<CalibrationPanel> calibration;
};

inline void hide(FramePanels& panels) {
  core::for_each_member([](auto& slot) { slot.placement = kNoPlacement; }, panels);
}

// ---- the frame ----

struct FrameState {
  std::array<scene::EyeView, 2> eyes;         // left, right; reversed infinite depth
  std::vector<glm::dmat4> room_from_node;     // one per scene node
  std::vector<std::uint8_t> visible;          // one per scene node; 0 hides the node's own mesh
  std::vector<scene::NodeIndex> highlighted;  // nodes at which the wand points or that it selected; children glow too
  std::vector<BeamBend> bends;
  std::vector<MeshCopies> copies;            // at most one entry per node
  std::vector<MeshShape> shapes;             // at most one entry per node
  std::vector<scene::NodeIndex> unshadowed;  // nodes lit without shadows, because their colours include one
  std::vector<scene::NodeIndex> outlined;    // nodes darkened where the surface turns away, in frames with fog
  KeyLight key_light;
  ConeShade cone;
  ContactMark contact;
  Fog fog;
  std::vector<PlacedLight> lights;  // used only if the scene has lights
  FramePanels panels;
  std::vector<Label> labels;
  std::size_t panels_apart = 0;  // largest number of panels left out of the eyes' pictures (Headset::show())
};

// Resolution and samples of the room in a frame, independent of its contents and layout. Panels always have all pixels
// of the eye images, so that their text stays legible.
struct FrameQuality {
  double scale = 1.0;         // fraction of the eye images' width and height, (0, 1]; enlarged below the panels
  std::uint32_t samples = 4;  // 1 or 4, at most RendererOptions::samples

  bool operator==(const FrameQuality&) const = default;
};

// Image in host memory: 8-bit sRGB RGBA, rows from top to bottom.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;
};

}  // namespace afm::render
