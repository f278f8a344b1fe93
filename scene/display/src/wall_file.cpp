// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <initializer_list>
#include <limits>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "physics/quantity_text.h"
#include "scene/config/toml_file.h"
#include "scene/display/wall.h"
#include "wall_pvx.h"

namespace afm::scene {

namespace {

constexpr int kLargestPixel = 65536;
constexpr double kLargestEyeFromHeadM = 0.5;

class TableReader {
 public:
  TableReader(const toml::table& table, std::string section) : table_(table), section_(std::move(section)) {}

  void allow_only(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, node] : table_) {
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end()) {
        throw Fault{node.source(), name(key.str()), fmt::format("unknown key; known are {}", fmt::join(keys, ", "))};
      }
    }
  }

  std::string text(std::string_view key) const {
    const auto value = required(key).value_exact<std::string>();
    if (!value || value->empty()) throw Fault{required(key).source(), name(key), "must be text and not empty"};
    return *value;
  }

  template <std::size_t Count>
  std::array<double, Count> numbers(std::string_view key, const char* meaning) const {
    const toml::node& node = required(key);
    const toml::array* array = node.as_array();
    std::array<double, Count> values{};
    if (array == nullptr || array->size() != Count) {
      throw Fault{node.source(), name(key), fmt::format("must be {}", meaning)};
    }
    for (std::size_t i = 0; i < Count; ++i) {
      const auto value = (*array)[i].value<double>();
      if (!value || !std::isfinite(*value)) throw Fault{node.source(), name(key), fmt::format("must be {}", meaning)};
      values[i] = *value;
    }
    return values;
  }

  glm::dvec3 point(std::string_view key) const {
    const auto v = numbers<3>(key, "three numbers [x, y, z] in metres");
    return {v[0], v[1], v[2]};
  }

  double length_m(std::string_view key, double smallest, double largest) const {
    const auto parsed = physics::parse_quantity(text(key), physics::kLengthUnits);
    if (!parsed.value) throw Fault{required(key).source(), name(key), parsed.error};
    const double value = parsed.value->si;
    if (value < smallest || value > largest) {
      throw Fault{required(key).source(), name(key),
                  fmt::format("is {:g} mm; it must lie between {:g} mm and {:g} mm", value * 1e3, smallest * 1e3,
                              largest * 1e3)};
    }
    return value;
  }

  bool has(std::string_view key) const { return table_.contains(key); }

  bool flag(std::string_view key) const {
    const auto value = required(key).value_exact<bool>();
    if (!value) throw Fault{required(key).source(), name(key), "must be true or false"};
    return *value;
  }

  // Of pixels: [x, y, width, height].
  PixelRect rect(std::string_view key) const {
    const auto v = numbers<4>(key, "four whole numbers [x, y, width, height] in pixels");
    for (const double value : v) {
      if (value != std::floor(value) || std::abs(value) > kLargestPixel) {
        fail(key, fmt::format("must be four whole numbers [x, y, width, height] in pixels, up to {}", kLargestPixel));
      }
    }
    if (v[2] < 1 || v[3] < 1) fail(key, fmt::format("is {:g} x {:g} pixels; it must be at least 1 x 1", v[2], v[3]));
    return {glm::ivec2(v[0], v[1]), glm::uvec2(v[2], v[3])};
  }

  [[noreturn]] void fail(std::string_view key, std::string what) const {
    throw Fault{has(key) ? table_.get(key)->source() : table_.source(), name(key), std::move(what)};
  }

 private:
  std::string name(std::string_view key) const { return section_ + "." + std::string(key); }

  const toml::node& required(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) throw Fault{table_.source(), name(key), "is missing"};
    return *node;
  }

  const toml::table& table_;
  std::string section_;
};

Screen read_screen(const toml::table& table) {
  const TableReader reader(table, "screen");
  reader.allow_only({"name", "lower_left", "lower_right", "upper_left"});
  Screen screen{.name = reader.text("name"),
                .lower_left = reader.point("lower_left"),
                .lower_right = reader.point("lower_right"),
                .upper_left = reader.point("upper_left")};
  if (const auto checked = check_screen(screen); !checked) {
    throw Fault{table.source(), "screen.lower_left", checked.error().message};
  }
  return screen;
}

// A homography as a person measures it: where on the output the corners of the picture are to appear. Returned is the
// way back. It must keep every place of the picture before the projector and must not mirror it, which would exchange
// near and far.
glm::dmat3 read_keystone(const TableReader& reader, std::string_view key) {
  const auto v = reader.numbers<9>(key, "nine numbers, a 3 x 3 matrix row by row");
  const glm::dmat3 output_from_picture(v[0], v[3], v[6], v[1], v[4], v[7], v[2], v[5], v[8]);
  const double determinant = glm::determinant(output_from_picture);
  const double size = std::cbrt(std::abs(determinant));
  double nearest = std::numeric_limits<double>::infinity();
  for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
    nearest = std::min(nearest, (output_from_picture * glm::dvec3(corner, 1.0)).z);
  }
  constexpr double kLeastOfLargest = 1e-3;  // beyond it a picture is a line, or its edge infinitely far
  const double largest =
      std::abs(*std::max_element(v.begin(), v.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  if (!(size > kLeastOfLargest * largest) || !(nearest > kLeastOfLargest * largest)) {
    reader.fail(key, "folds the picture into a line or sends a corner to infinity; measure the corners again");
  }
  if (determinant < 0.0) reader.fail(key, "mirrors the picture; set rear projection in the projector instead");
  return glm::inverse(output_from_picture);
}

WallNode read_node(const toml::table& table, const std::vector<WallNode>& earlier) {
  const TableReader reader(table, "node");
  reader.allow_only({"name", "host"});
  WallNode node{.name = reader.text("name"), .host = reader.text("host")};
  // they are typed into shells, and name units of systemd
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.'; };
  for (const auto& [key, text] : {std::pair("name", &node.name), std::pair("host", &node.host)}) {
    if (!std::all_of(text->begin(), text->end(), is_plain) || text->front() == '-') {
      reader.fail(key, "must consist of letters, digits, \"-\", \"_\" and \".\"");
    }
  }
  if (node.name.size() > kLongestNodeName) {
    reader.fail("name", fmt::format("is longer than {} characters", kLongestNodeName));
  }
  for (const WallNode& other : earlier) {
    if (other.name == node.name) reader.fail("name", fmt::format("\"{}\" is used twice", node.name));
  }
  if (earlier.size() == kMostNodes) reader.fail("name", fmt::format("is one of more than {} nodes", kMostNodes));
  return node;
}

Output read_output(const toml::table& table, const std::vector<Screen>& screens, const std::vector<WallNode>& nodes) {
  const TableReader reader(table, "output");
  reader.allow_only({"name", "screen", "node", "mode", "eye", "swap", "monitor", "rect", "homography"});
  Output output;
  output.name = reader.text("name");
  const std::string screen = reader.text("screen");
  const auto found = std::find_if(screens.begin(), screens.end(), [&](const Screen& s) { return s.name == screen; });
  if (found == screens.end()) reader.fail("screen", fmt::format("there is no [[screen]] with the name \"{}\"", screen));
  output.screen = static_cast<std::size_t>(found - screens.begin());
  if (reader.has("node")) {
    const std::string node = reader.text("node");
    const auto its = std::find_if(nodes.begin(), nodes.end(), [&](const WallNode& n) { return n.name == node; });
    if (its == nodes.end()) reader.fail("node", fmt::format("there is no [[node]] with the name \"{}\"", node));
    output.node = static_cast<std::size_t>(its - nodes.begin());
  }
  const auto mode = parse_stereo_mode(reader.text("mode"));
  if (!mode) reader.fail("mode", mode.error().message);
  output.mode = *mode;
  if (reader.has("eye") != (output.mode == StereoMode::Dual)) {
    reader.fail("eye", reader.has("eye")
                           ? "applies only to mode \"dual\"; remove it"
                           : "is missing; in mode \"dual\" each output shows the \"left\" or the \"right\" eye");
  }
  if (reader.has("eye")) {
    const std::string eye = reader.text("eye");
    if (eye != "left" && eye != "right") reader.fail("eye", "must be \"left\" or \"right\"");
    output.eye = eye == "left" ? Eye::Left : Eye::Right;
  }
  if (reader.has("swap") && reader.flag("swap")) output.order = EyeOrder::Swapped;
  if (reader.has("monitor") == reader.has("rect")) {
    reader.fail("monitor", "an output has either a monitor = \"NAME\" or a rect = [x, y, width, height]");
  }
  if (reader.has("monitor")) output.monitor = reader.text("monitor");
  if (reader.has("rect")) output.rect = reader.rect("rect");
  const auto packing = frame_packing(output.mode);
  if (packing && reader.has("rect") && output.rect.size_px != picture_size(output.mode, packing->eye_px)) {
    const glm::uvec2 size = picture_size(output.mode, packing->eye_px);
    reader.fail("rect", fmt::format("mode \"{}\" needs exactly {} x {} pixels", name_of(output.mode), size.x, size.y));
  }
  if (reader.has("homography")) output.picture_from_output = read_keystone(reader, "homography");
  return output;
}

bool overlap(const PixelRect& a, const PixelRect& b) {
  const glm::ivec2 a_end = a.offset_px + glm::ivec2(a.size_px), b_end = b.offset_px + glm::ivec2(b.size_px);
  return a.offset_px.x < b_end.x && b.offset_px.x < a_end.x && a.offset_px.y < b_end.y && b.offset_px.y < a_end.y;
}

// What two outputs may not share, and the pair that dual needs.
void check_together(const Output& output, const std::vector<Output>& earlier, const toml::table& table) {
  const TableReader reader(table, "output");
  for (const Output& other : earlier) {
    if (other.name == output.name) reader.fail("name", fmt::format("\"{}\" is used twice", output.name));
    const bool one_desktop = output.node == other.node;
    if (one_desktop && !output.monitor.empty() && output.monitor == other.monitor) {
      reader.fail("monitor", fmt::format("\"{}\" already shows output \"{}\"", output.monitor, other.name));
    }
    if (one_desktop && output.monitor.empty() && other.monitor.empty() && overlap(output.rect, other.rect)) {
      reader.fail("rect", fmt::format("overlaps that of output \"{}\"", other.name));
    }
    if (output.eye && other.eye == output.eye && other.screen == output.screen) {
      reader.fail("eye", fmt::format("output \"{}\" already shows this eye of the screen", other.name));
    }
  }
}

void check_pairs(const std::vector<Output>& outputs, const toml::array& tables) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const Output& output = outputs[i];
    const bool paired = std::any_of(outputs.begin(), outputs.end(), [&](const Output& other) {
      return other.screen == output.screen && other.eye && other.eye != output.eye;
    });
    if (output.eye && !paired) {
      TableReader(*tables[i].as_table(), "output")
          .fail("eye", "no output in mode \"dual\" shows the other eye of this screen");
    }
  }
}

bool is_digits(std::string_view text) {
  return !text.empty() && text.size() <= 3 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

Viewer read_viewer(const toml::table& table) {
  const TableReader reader(table, "viewer");
  reader.allow_only({"name", "ipd", "head", "eye_from_head", "sweet_spot", "sweet_spot_orientation"});
  Viewer viewer;
  viewer.name = reader.text("name");
  viewer.ipd_m = reader.length_m("ipd", kSmallestIpdM, kLargestIpdM);
  constexpr std::string_view kDtrack = "dtrack:";
  if (reader.has("head")) viewer.head = reader.text("head");
  const bool tracked =
      viewer.head.starts_with(kDtrack) && is_digits(std::string_view(viewer.head).substr(kDtrack.size()));
  if (viewer.head != "none" && !tracked) {
    reader.fail("head", fmt::format("\"{}\" is neither \"none\" nor a tracked body such as \"dtrack:0\"", viewer.head));
  }
  if (reader.has("eye_from_head")) {
    viewer.eye_from_head_m = reader.point("eye_from_head");
    if (glm::length(viewer.eye_from_head_m) > kLargestEyeFromHeadM) {
      reader.fail("eye_from_head", fmt::format("is {:g} m from the tracked body, too far for a head; check the unit",
                                               glm::length(viewer.eye_from_head_m)));
    }
  }
  viewer.sweet_spot.position_m = reader.point("sweet_spot");
  if (reader.has("sweet_spot_orientation")) {
    const auto q = reader.numbers<4>("sweet_spot_orientation", "a unit quaternion [x, y, z, w]");
    const glm::dquat orientation(q[3], q[0], q[1], q[2]);
    if (std::abs(glm::length(orientation) - 1.0) > 1e-3) {
      reader.fail("sweet_spot_orientation", "must be a unit quaternion [x, y, z, w]");
    }
    viewer.sweet_spot.room_from_head = glm::normalize(orientation);
  }
  return viewer;
}

template <class Read>
void read_tables(const toml::table& root, std::string_view key, const Read& read) {
  const toml::node* node = root.get(key);
  if (node == nullptr)
    throw Fault{root.source(), std::string(key), fmt::format("is missing; the file needs at least one [[{}]]", key)};
  const toml::array* tables = node->as_array();
  if (tables == nullptr || tables->empty())
    throw Fault{node->source(), std::string(key), fmt::format("must be written [[{}]]", key)};
  for (const toml::node& entry : *tables) {
    const toml::table* table = entry.as_table();
    if (table == nullptr) throw Fault{entry.source(), std::string(key), fmt::format("must be written [[{}]]", key)};
    read(*table);
  }
}

Wall read_wall(const toml::table& root) {
  TableReader(root, "wall").allow_only({"screen", "node", "output", "viewer"});
  Wall wall;
  std::set<std::string> names;
  read_tables(root, "screen", [&](const toml::table& table) {
    wall.screens.push_back(read_screen(table));
    if (!names.insert(wall.screens.back().name).second) {
      throw Fault{table.source(), "screen.name", fmt::format("\"{}\" is used twice", wall.screens.back().name)};
    }
  });
  if (root.contains("node")) {
    read_tables(root, "node", [&](const toml::table& table) { wall.nodes.push_back(read_node(table, wall.nodes)); });
  }
  if (root.contains("output")) {
    read_tables(root, "output", [&](const toml::table& table) {
      wall.outputs.push_back(read_output(table, wall.screens, wall.nodes));
      check_together(wall.outputs.back(), {wall.outputs.begin(), wall.outputs.end() - 1}, table);
    });
    check_pairs(wall.outputs, *root.get("output")->as_array());
  }
  read_tables(root, "viewer", [&](const toml::table& table) {
    wall.viewers.push_back(read_viewer(table));
    const Viewer& viewer = wall.viewers.back();
    for (const Screen& screen : wall.screens) {
      for (const Eye eye : kEyes) {
        const auto view = off_axis_view(screen, eye_position(viewer.sweet_spot, eye, viewer.ipd_m),
                                        DepthConvention::VulkanReversedInfinite, kNearM, 0.0);
        if (!view) throw Fault{table.source(), "viewer.sweet_spot", view.error().message};
      }
    }
  });
  return wall;
}

// A ParaView configuration under another name; no TOML begins so.
bool begins_like_xml(const std::string& path) {
  char first = 0;
  return std::ifstream(path) >> first && first == '<';
}

}  // namespace

core::Result<Wall> load_wall(const std::string& path) {
  if (path.ends_with(".pvx") || begins_like_xml(path)) return load_pvx(path);
  return read_toml("wall file", path, read_wall);
}

}  // namespace afm::scene
