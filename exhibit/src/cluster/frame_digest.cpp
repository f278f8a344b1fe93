// SPDX-License-Identifier: Apache-2.0
#include "exhibit/cluster/frame_digest.h"

#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/fnv1a.h"

namespace afm::exhibit {

namespace {

// The parts of a frame, each as its members. Eight bytes at a time: a frame has some 20 kB of transforms.
class FrameHash {
 public:
  template <class Number>
    requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
  void add(Number number) {
    std::uint64_t word = 0;
    std::memcpy(&word, &number, sizeof(number));
    value_ = (value_ ^ word) * 0x9E3779B97F4A7C15ULL;
    value_ ^= value_ >> 29U;
  }
  void add(const std::string& text) {
    add(text.size());
    add(core::fnv1a(text));
  }
  void add(const glm::vec3& v) { add_all(v.x, v.y, v.z); }
  void add(const glm::dvec3& v) { add_all(v.x, v.y, v.z); }
  void add(const glm::dvec2& v) { add_all(v.x, v.y); }
  void add(const glm::vec2& v) { add_all(v.x, v.y); }
  void add(const glm::dmat4& m) {
    for (glm::length_t column = 0; column < 4; ++column)
      for (glm::length_t row = 0; row < 4; ++row) add(m[column][row]);
  }
  template <class Value>
  void add(const std::optional<Value>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  template <class Value>
  void add(const std::vector<Value>& values) {
    add(values.size());
    for (const Value& value : values) add(value);
  }

  void add(const render::BeamBend& bend) { add_all(bend.node, bend.length, bend.end_deflection); }
  void add(const render::PanelPlacement& place) { add_all(place.lower_left_m, place.right_m, place.up_m); }
  void add(const render::PlotPoint& point) { add_all(point.place_nm, point.force_nn); }
  void add(const render::PlotCurve& curve) {
    add_all(curve.label, curve.color, curve.faded, curve.approach, curve.retract);
  }
  void add(const render::PlotMarker& marker) { add_all(marker.kind, marker.value, marker.label); }
  void add(const render::DataRow& row) { add_all(row.name, row.value, row.source); }
  void add(const render::PlotWords& words) {
    add_all(words.approach, words.retract, words.place_axis, words.force_axis, words.decimal_mark);
  }
  void add(const render::ForcePanel& panel) {
    add_all(panel.title, panel.words, panel.place_min_nm, panel.place_max_nm, panel.force_min_nn, panel.force_max_nn,
            panel.curves, panel.markers, panel.cursor, panel.stage, panel.figures);
  }
  void add(const render::DataPanel& panel) { add_all(panel.title, panel.subtitle, panel.rows); }
  void add(const render::Banner& banner) {
    add_all(banner.guidance, banner.state_word, banner.state_shape, banner.state_color, banner.scale, banner.warning);
  }
  void add(const render::Label& label) { add_all(label.text, label.highlighted, label.placement); }
  void add(const render::ControlTarget& target) { add_all(target.kind, target.index); }
  void add(const render::ControlRow& row) { add_all(row.name, row.value, row.changed); }
  void add(const render::ControlPanel& panel) {
    add_all(panel.title, panel.buttons, panel.rows, panel.notes, panel.status, panel.pointed, panel.marked);
  }
  template <class Value, std::size_t kCount>
  void add(const std::array<Value, kCount>& values) {
    for (const Value& value : values) add(value);
  }
  void add(const render::ImageMap& map) { add_all(map.title, map.grid.columns, map.grid.rows, map.grid.colors); }
  void add(const render::ProfilePlot::Line& line) { add_all(line.label, line.color, line.dashed, line.points); }
  void add(const render::ImagePanel& panel) {
    add_all(panel.title, panel.subtitle, panel.heights[0], panel.heights[1], panel.smaller, panel.profile.title,
            panel.profile.low, panel.profile.high, panel.profile.lines, panel.side_unit, panel.side, panel.scale_bar,
            panel.line, panel.bar_low_nm, panel.bar_high_nm, panel.bar, panel.decimal_mark);
  }
  void add(const cluster::ShownPose& pose) { add_all(pose.position_m, pose.orientation); }
  void add(const cluster::ShownView& view) {
    for_each_field([this](const char* /*name*/, const auto& value) { add(value); }, view);
  }
  void add(const render::PlacedLight& light) { add_all(light.position_m, light.direction); }

  template <class... Values>
  void add_all(const Values&... values) {
    (add(values), ...);
  }

  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 1;
};

}  // namespace

std::uint64_t digest_of(const render::FrameState& frame, const cluster::ShownView& view) {
  FrameHash hash;
  hash.add_all(frame.room_from_node, frame.visible, frame.highlighted, frame.bends, frame.key_light.direction_to_light,
               frame.key_light.radiance, frame.key_light.shadow_center_m, frame.key_light.shadow_radius_m,
               frame.contact.place_m, frame.contact.shade_radius_m, frame.contact.ring_color,
               frame.contact.ring_radius_m, frame.fog.fade, frame.fog.begin_m, frame.fog.end_m, frame.fog.origin_m,
               frame.fog.away, frame.lights);
  hash.add_all(frame.force_panel, frame.force_placement, frame.image_panel, frame.image_placement, frame.loop_panel,
               frame.loop_placement, frame.data_panel, frame.data_placement, frame.banner, frame.banner_placement,
               frame.control_panel, frame.control_placement, frame.labels);
  hash.add(view);
  return hash.value();
}

}  // namespace afm::exhibit
