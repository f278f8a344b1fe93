// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <initializer_list>
#include <limits>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "core/whole_file.h"
#include "physics/quantity_text.h"
#include "scene/config/toml_file.h"
#include "scene/config/toml_table.h"
#include "scene/display/wall.h"
#include "scene/display/wall_doubts.h"
#include "screen_blends.h"
#include "wall_pvx.h"

namespace afm::scene {

namespace {

constexpr double kLargestEyeFromHeadM = 0.5;
constexpr double kWidestBlendM = 20.0;
constexpr int kLargestPixel = 65536;
constexpr double kSmallestGamma = 1.0, kLargestGamma = 4.0;
constexpr double kLargestBlack = 0.05;  // black of a projector with a contrast of 20:1

constexpr std::array<std::string_view, kScreenEdgeNames.size()> kBlendKeys{"blend_left", "blend_top", "blend_right",
                                                                           "blend_bottom"};

double read_length_m(const TomlTable& table, std::string_view key, double least_m, double most_m) {
  const double value_m = table.quantity(key, physics::kLengthUnits).si;
  if (value_m < least_m || value_m > most_m) {
    table.refuse(key, fmt::format("is {:g} mm; it must lie between {:g} mm and {:g} mm", value_m * 1e3, least_m * 1e3,
                                  most_m * 1e3));
  }
  return value_m;
}

// Reads pixels: [x, y, width, height].
PixelRect read_rect(const TomlTable& table, std::string_view key) {
  const auto v = table.numbers<4>(key, "four whole numbers [x, y, width, height] in pixels");
  for (const double value : v) {
    if (value != std::floor(value) || std::abs(value) > kLargestPixel) {
      table.refuse(key,
                   fmt::format("must be four whole numbers [x, y, width, height] in pixels, up to {}", kLargestPixel));
    }
  }
  if (v[2] < 1 || v[3] < 1) {
    table.refuse(key, fmt::format("is {:g} x {:g} pixels; it must be at least 1 x 1", v[2], v[3]));
  }
  return {glm::ivec2(v[0], v[1]), glm::uvec2(v[2], v[3])};
}

Screen read_screen(const TomlTable& table, EdgeWidths& widths_m) {
  table.allow_only(
      {"name", "lower_left", "lower_right", "upper_left", kBlendKeys[0], kBlendKeys[1], kBlendKeys[2], kBlendKeys[3]});
  Screen screen{.name = table.text("name"),
                .lower_left = table.point("lower_left"),
                .lower_right = table.point("lower_right"),
                .upper_left = table.point("upper_left")};
  if (const auto checked = check_screen(screen); !checked) table.refuse("lower_left", checked.error().message);
  for (std::size_t edge = 0; edge < widths_m.size(); ++edge) {
    const std::string_view key = kBlendKeys.at(edge);
    if (table.has(key)) widths_m.at(edge) = read_length_m(table, key, kLeastOverlapM, kWidestBlendM);
  }
  return screen;
}

// Reads the mesh, whose path is relative to the wall file.
std::shared_ptr<const WarpMesh> read_warp_mesh(const TomlTable& table, const Output& output,
                                               const std::string& wall_path) {
  if (table.has("homography")) {
    table.refuse("warp_mesh", "an output has either a homography or a warp mesh; the mesh can hold the keystone too");
  }
  const glm::uvec2 eye_px =
      traits_of(output.mode).squeezed ? output.rect.size_px : eye_size(output.mode, glm::max(output.rect.size_px, 1U));
  const bool known = output.rect.size_px != glm::uvec2(0);
  auto mesh = load_warp_mesh((std::filesystem::path(wall_path).parent_path() / table.text("warp_mesh")).string(),
                             known ? std::optional(double(eye_px.x) / double(eye_px.y)) : std::nullopt);
  if (!mesh) table.refuse("warp_mesh", mesh.error().message);
  return std::make_shared<const WarpMesh>(std::move(*mesh));
}

// Homography given by a measurement: the output positions at which the corners of the picture should appear. Returns
// the inverse. It must keep every point of the picture in front of the projector, and must not mirror the picture,
// which would exchange near and far.
glm::dmat3 read_keystone(const TomlTable& table, std::string_view key) {
  const auto v = table.numbers<9>(key, "nine numbers, a 3 x 3 matrix row by row");
  const glm::dmat3 output_from_picture(v[0], v[3], v[6], v[1], v[4], v[7], v[2], v[5], v[8]);
  const double determinant = glm::determinant(output_from_picture);
  const double size = std::cbrt(std::abs(determinant));
  double nearest = std::numeric_limits<double>::infinity();
  for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
    nearest = std::min(nearest, (output_from_picture * glm::dvec3(corner, 1.0)).z);
  }
  constexpr double kLeastOfLargest = 1e-3;  // ratio below which the picture is a line, or its edge infinitely far away
  const double largest =
      std::abs(*std::max_element(v.begin(), v.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  if (!(size > kLeastOfLargest * largest) || !(nearest > kLeastOfLargest * largest)) {
    table.refuse(key, "folds the picture into a line or sends a corner to infinity; measure the corners again");
  }
  if (determinant < 0.0) table.refuse(key, "mirrors the picture; set rear projection in the projector instead");
  return glm::inverse(output_from_picture);
}

WallNode read_node(const TomlTable& table, const std::vector<WallNode>& earlier) {
  table.allow_only({"name", "host"});
  WallNode node{.name = table.text("name"), .host = table.text("host")};
  // names are typed into shells, and become part of names of systemd's units
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.'; };
  for (const auto& [key, text] : {std::pair("name", &node.name), std::pair("host", &node.host)}) {
    if (!std::all_of(text->begin(), text->end(), is_plain) || text->front() == '-') {
      table.refuse(key, "must consist of letters, digits, \"-\", \"_\" and \".\"");
    }
  }
  if (node.name.size() > kLongestNodeName) {
    table.refuse("name", fmt::format("is longer than {} characters", kLongestNodeName));
  }
  for (const WallNode& other : earlier) {
    if (other.name == node.name) table.refuse("name", fmt::format("\"{}\" is used twice", node.name));
  }
  if (earlier.size() == kMostNodes) table.refuse("name", fmt::format("is one of more than {} nodes", kMostNodes));
  return node;
}

// Index of the table that a key names.
template <typename Named>
std::size_t read_name_of(const std::vector<Named>& all, const TomlTable& table, std::string_view key) {
  const std::string name = table.text(key);
  const auto found = std::find_if(all.begin(), all.end(), [&](const Named& named) { return named.name == name; });
  if (found == all.end()) table.refuse(key, fmt::format("there is no [[{}]] with the name \"{}\"", key, name));
  return static_cast<std::size_t>(found - all.begin());
}

// Number of a key that may be absent.
std::optional<double> number_if_given(const TomlTable& table, std::string_view key, double least, double most,
                                      const char* meaning) {
  return table.has(key) ? std::optional(table.number(key, least, most, meaning)) : std::nullopt;
}

Output read_output(const TomlTable& table, const Wall& wall, const std::string& path, ProjectorLight& light) {
  table.allow_only({"name", "screen", "node", "mode", "eye", "swap", "monitor", "rect", "homography", "warp_mesh",
                    "gamma", "black_level"});
  Output output;
  output.name = table.text("name");
  output.screen = read_name_of(wall.screens, table, "screen");
  if (table.has("node")) output.node = read_name_of(wall.nodes, table, "node");
  const auto mode = parse_stereo_mode(table.text("mode"));
  if (!mode) table.refuse("mode", mode.error().message);
  output.mode = *mode;
  if (table.has("eye") != (output.mode == StereoMode::Dual)) {
    table.refuse("eye", table.has("eye")
                            ? "applies only to mode \"dual\"; remove it"
                            : "is missing; in mode \"dual\" each output shows the \"left\" or the \"right\" eye");
  }
  if (table.has("eye")) {
    const std::string eye = table.text("eye");
    if (eye != "left" && eye != "right") table.refuse("eye", "must be \"left\" or \"right\"");
    output.eye = eye == "left" ? Eye::Left : Eye::Right;
  }
  if (table.has("swap") && table.flag("swap")) output.order = EyeOrder::Swapped;
  if (table.has("monitor") == table.has("rect")) {
    table.refuse("monitor", "an output has either a monitor = \"NAME\" or a rect = [x, y, width, height]");
  }
  if (table.has("monitor")) output.monitor = table.text("monitor");
  if (table.has("rect")) output.rect = read_rect(table, "rect");
  const auto packing = frame_packing(output.mode);
  if (packing && table.has("rect") && output.rect.size_px != picture_size(output.mode, packing->eye_px)) {
    const glm::uvec2 size = picture_size(output.mode, packing->eye_px);
    table.refuse("rect", fmt::format("mode \"{}\" needs exactly {} x {} pixels", name_of(output.mode), size.x, size.y));
  }
  if (table.has("homography")) output.picture_from_output = read_keystone(table, "homography");
  if (table.has("warp_mesh")) {
    output.warp = read_warp_mesh(table, output, path);
    output.warp_file = table.text("warp_mesh");
  }
  light.gamma = number_if_given(table, "gamma", kSmallestGamma, kLargestGamma, "the power of the projector's light");
  light.black =
      number_if_given(table, "black_level", 0.0, kLargestBlack, "the light of the projector's black, of its white's");
  return output;
}

// Checks properties that two outputs may not share, and the pair that mode dual needs.
void check_together(const Output& output, const std::vector<Output>& earlier, const TomlTable& table) {
  for (const Output& other : earlier) {
    if (other.name == output.name) table.refuse("name", fmt::format("\"{}\" is used twice", output.name));
    const bool one_desktop = output.node == other.node;
    if (one_desktop && !output.monitor.empty() && output.monitor == other.monitor) {
      table.refuse("monitor", fmt::format("\"{}\" already shows output \"{}\"", output.monitor, other.name));
    }
    if (one_desktop && output.monitor.empty() && other.monitor.empty() && overlap(output.rect, other.rect)) {
      table.refuse("rect", fmt::format("overlaps that of output \"{}\"", other.name));
    }
    if (output.eye && other.eye == output.eye && other.screen == output.screen) {
      table.refuse("eye", fmt::format("output \"{}\" already shows this eye of the screen", other.name));
    }
  }
}

void check_pairs(const std::vector<Output>& outputs, const std::vector<TomlTable>& tables) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const Output& output = outputs[i];
    const bool paired = std::any_of(outputs.begin(), outputs.end(), [&](const Output& other) {
      return other.screen == output.screen && other.eye && other.eye != output.eye;
    });
    if (output.eye && !paired) {
      tables[i].refuse("eye", "no output in mode \"dual\" shows the other eye of this screen");
    }
  }
}

bool is_digits(std::string_view text) {
  return !text.empty() && text.size() <= 3 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

Viewer read_viewer(const TomlTable& table) {
  table.allow_only({"name", "ipd", "head", "eye_from_head", "sweet_spot", "sweet_spot_orientation"});
  Viewer viewer;
  viewer.name = table.text("name");
  viewer.ipd_m = read_length_m(table, "ipd", kSmallestIpdM, kLargestIpdM);
  constexpr std::string_view kDtrack = "dtrack:";
  if (table.has("head")) viewer.head = table.text("head");
  const bool tracked =
      viewer.head.starts_with(kDtrack) && is_digits(std::string_view(viewer.head).substr(kDtrack.size()));
  if (viewer.head != "none" && !tracked) {
    table.refuse("head",
                 fmt::format("\"{}\" is neither \"none\" nor a tracked body such as \"dtrack:0\"", viewer.head));
  }
  if (table.has("eye_from_head")) {
    viewer.eye_from_head_m = table.point("eye_from_head");
    if (glm::length(viewer.eye_from_head_m) > kLargestEyeFromHeadM) {
      table.refuse("eye_from_head", fmt::format("is {:g} m from the tracked body, too far for a head; check the unit",
                                                glm::length(viewer.eye_from_head_m)));
    }
  }
  viewer.sweet_spot.position_m = table.point("sweet_spot");
  if (table.has("sweet_spot_orientation")) {
    viewer.sweet_spot.room_from_head = table.rotation("sweet_spot_orientation");
  }
  return viewer;
}

// Sets the blending of overlaps, after everything has been read.
void blend(Wall& wall, const TomlTable& root, const std::vector<EdgeWidths>& widths_m,
           const std::vector<ProjectorLight>& lights) {
  auto fault = blend_screens(wall.screens, widths_m);
  if (!fault) fault = blend_outputs(wall, lights);
  if (!fault) return;
  const char* const kind = fault->table == BlendFault::Table::Screen ? "screen" : "output";
  root.tables(kind).at(fault->index).refuse(fault->key, fault->what);
}

void check_in_front(const Wall& wall, const Viewer& viewer, const TomlTable& table) {
  for (const Screen& screen : wall.screens) {
    for (const Eye eye : kEyes) {
      const auto view = off_axis_view(screen, eye_position(viewer.sweet_spot, eye, viewer.ipd_m),
                                      DepthConvention::VulkanReversedInfinite, kNearM, 0.0);
      if (!view) table.refuse("sweet_spot", view.error().message);
    }
  }
}

Wall read_wall(const TomlTable& root, const std::string& path) {
  root.allow_only({"screen", "node", "output", "viewer"});
  Wall wall;
  std::vector<EdgeWidths> widths_m;
  std::vector<ProjectorLight> lights;
  std::set<std::string> names;
  for (const TomlTable& table : root.tables("screen")) {
    wall.screens.push_back(read_screen(table, widths_m.emplace_back()));
    const std::string& name = wall.screens.back().name;
    if (!names.insert(name).second) table.refuse("name", fmt::format("\"{}\" is used twice", name));
  }
  if (root.has("node")) {
    for (const TomlTable& table : root.tables("node")) wall.nodes.push_back(read_node(table, wall.nodes));
  }
  if (root.has("output")) {
    const std::vector<TomlTable> tables = root.tables("output");
    for (const TomlTable& table : tables) {
      wall.outputs.push_back(read_output(table, wall, path, lights.emplace_back()));
      check_together(wall.outputs.back(), {wall.outputs.begin(), wall.outputs.end() - 1}, table);
    }
    check_pairs(wall.outputs, tables);
  }
  const std::vector<TomlTable> viewers = root.tables("viewer");
  for (const TomlTable& table : viewers) {
    Viewer viewer = read_viewer(table);
    if (!wall.viewers.empty()) {
      wall.unused.push_back(fmt::format("viewer \"{}\": not used; every screen is drawn for the first viewer, \"{}\"",
                                        viewer.name, wall.viewers.front().name));
    }
    wall.viewers.push_back(std::move(viewer));
  }
  if (const auto fault = impossible_length(wall)) {
    if (fault->of_viewer) viewers[fault->index].refuse("sweet_spot", fault->what);
    root.tables("screen")[fault->index].refuse("lower_left", fault->what);
  }
  for (std::size_t i = 0; i < viewers.size(); ++i) check_in_front(wall, wall.viewers[i], viewers[i]);
  blend(wall, root, widths_m, lights);
  return wall;
}

// True for a ParaView configuration under another name; no TOML file begins like that.
bool begins_like_xml(const std::string& path) {
  const auto beginning = core::read_beginning(path, 256);  // beginning that may contain blank lines
  if (!beginning) return false;
  const std::size_t first = beginning->find_first_not_of(" \t\r\n");
  return first != std::string::npos && (*beginning)[first] == '<';
}

}  // namespace

core::Result<Wall> load_wall(const std::string& path) {
  if (path.ends_with(".pvx") || begins_like_xml(path)) return load_pvx(path);
  return read_toml("wall file", path, [&](const toml::table& root) { return read_wall(TomlTable(root), path); });
}

}  // namespace afm::scene
