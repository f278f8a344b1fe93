// SPDX-License-Identifier: Apache-2.0
#include "wall_pvx.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <string_view>
#include <utility>

#include "core/whole_file.h"
#include "scene/display/wall_doubts.h"

namespace afm::scene {

namespace {

constexpr std::size_t kLargestFile = 1U << 20U;
constexpr std::size_t kMostScreens = 64;
constexpr int kMostPixels = 65536;
constexpr int kDeepest = 100;
constexpr std::size_t kMostUnused = 20;

struct XmlFault {
  std::ptrdiff_t offset;
  std::string what;
};

// Numbers separated by spaces; they must fill `text`.
std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    if (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r') {
      ++at;
      continue;
    }
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value)) return {};
    values.push_back(value);
    at = next;
  }
  return values;
}

glm::dvec3 corner(const pugi::xml_node& machine, const char* name) {
  const pugi::xml_attribute attribute = machine.attribute(name);
  const std::vector<double> v = numbers_in(attribute.value());
  if (v.size() != 3) {
    throw XmlFault{
        machine.offset_debug(),
        fmt::format("Machine.{}: {}", name, attribute ? "must be three numbers \"x y z\" in metres" : "is missing")};
  }
  return {v[0], v[1], v[2]};
}

// Reads WIDTHxHEIGHT+X+Y, the form used by X.
std::optional<PixelRect> read_geometry(std::string_view text) {
  std::array<int, 4> v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    constexpr std::string_view kBefore = " x++";  // separators before each number, none before the first
    if (i > 0 && (text.empty() || text.front() != kBefore.at(i))) return std::nullopt;
    if (i > 0) text.remove_prefix(1);
    const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), v.at(i));
    if (error != std::errc() || v.at(i) < (i < 2 ? 1 : 0) || v.at(i) > kMostPixels) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(next - text.data()));
  }
  if (!text.empty()) return std::nullopt;
  return PixelRect{glm::ivec2(v[2], v[3]), glm::uvec2(v[0], v[1])};
}

struct StereoTypeRow {
  std::string_view type;
  StereoMode mode;
  std::optional<Eye> eye{};
};
constexpr std::array kStereoTypes{StereoTypeRow{"Left", StereoMode::Left, Eye::Left},
                                  StereoTypeRow{"Right", StereoMode::Right, Eye::Right},
                                  StereoTypeRow{"Crystal Eyes", StereoMode::QuadBuffer},
                                  StereoTypeRow{"Anaglyph", StereoMode::AnaglyphRedCyan},
                                  StereoTypeRow{"Interlaced", StereoMode::Row},
                                  StereoTypeRow{"Dresden", StereoMode::Column},
                                  StereoTypeRow{"Checkerboard", StereoMode::Checkerboard},
                                  StereoTypeRow{"SplitViewportHorizontal", StereoMode::SideBySideHalf}};

struct Machine {
  pugi::xml_node node;
  Screen screen;
  const StereoTypeRow* stereo = nullptr;
  std::optional<PixelRect> rect;
  std::string viewer;                  // id of the viewer
  std::optional<std::size_t> partner;  // machine of the other eye on the same screen
  std::set<std::string_view> used{"Name", "LowerLeft", "LowerRight", "UpperRight"};
};

Machine read_machine(const pugi::xml_node& node, std::set<std::string>& names) {
  Machine machine;
  machine.node = node;
  Screen& screen = machine.screen;
  screen.lower_left = corner(node, "LowerLeft");
  screen.lower_right = corner(node, "LowerRight");
  screen.upper_left = screen.lower_left + (corner(node, "UpperRight") - screen.lower_right);

  // one machine may drive several screens
  const std::string name = node.attribute("Name").as_string("screen");
  screen.name = name;
  for (int i = 2; !names.insert(screen.name).second; ++i) screen.name = fmt::format("{} {}", name, i);
  if (const auto checked = check_screen(screen); !checked) {
    throw XmlFault{node.offset_debug(), "Machine.LowerLeft: " + checked.error().message};
  }
  const std::string_view type = node.attribute("StereoType").value();
  const auto* const row = std::find_if(kStereoTypes.begin(), kStereoTypes.end(),
                                       [&](const StereoTypeRow& known) { return known.type == type; });
  if (row != kStereoTypes.end()) machine.stereo = &*row;
  machine.rect = read_geometry(node.attribute("Geometry").value());
  machine.viewer = node.attribute("ViewerId").as_string("0");
  return machine;
}

double read_separation(const pugi::xml_node& node, const char* attribute) {
  const std::vector<double> value = numbers_in(node.attribute(attribute).value());
  if (value.size() != 1 || value[0] < kSmallestIpdM || value[0] > kLargestIpdM) {
    throw XmlFault{node.offset_debug(),
                   fmt::format("{}.{}: is \"{}\"; it must lie between {:g} and {:g}, in metres", node.name(), attribute,
                               node.attribute(attribute).value(), kSmallestIpdM, kLargestIpdM)};
  }
  return value[0];
}

bool in_front_of_all(const std::vector<Screen>& screens, const Viewer& viewer) {
  return std::all_of(screens.begin(), screens.end(), [&](const Screen& screen) {
    return std::all_of(kEyes.begin(), kEyes.end(), [&](Eye eye) {
      return off_axis_view(screen, eye_position(viewer.sweet_spot, eye, viewer.ipd_m),
                           DepthConvention::VulkanReversedInfinite, kNearM, 0.0)
          .has_value();
    });
  });
}

bool same_corners(const Screen& a, const Screen& b) {
  constexpr double kSameM = 5e-3;  // accuracy of a tape measure
  return glm::distance(a.lower_left, b.lower_left) < kSameM && glm::distance(a.lower_right, b.lower_right) < kSameM &&
         glm::distance(a.upper_left, b.upper_left) < kSameM;
}

// Reader of a whole configuration, from the root down.
class Configuration {
 public:
  explicit Configuration(const pugi::xml_node& root) : root_(root) { visit(root, 0); }

  Wall wall() {
    if (machines_.empty())
      throw XmlFault{root_.offset_debug(), "it has no Machine with LowerLeft, LowerRight and UpperRight"};
    pair_eyes();
    const bool placed = outputs_have_places();
    Wall wall;
    for (std::size_t i = 0; i < machines_.size(); ++i) add(i, placed, wall);
    wall.viewers.push_back(viewer(wall));
    return wall;
  }

  // A line for each element with something that wall() does not use, with the element's place in the file.
  std::vector<XmlFault> unused() const {
    std::vector<XmlFault> lines = unused_;
    for (const Machine& machine : machines_) {
      const std::string name = fmt::format("Machine \"{}\"", machine.screen.name);
      add_unused(machine.node, name, machine.used, lines);
    }
    return lines;
  }

 private:
  static void add_unused(const pugi::xml_node& node, const std::string& name, const std::set<std::string_view>& used,
                         std::vector<XmlFault>& lines) {
    std::string ignored;
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      if (used.count(attribute.name()) != 0) continue;
      ignored += fmt::format("{}{}=\"{}\"", ignored.empty() ? "" : ", ", attribute.name(), attribute.value());
    }
    if (!ignored.empty()) lines.push_back({node.offset_debug(), fmt::format("{}: ignored: {}", name, ignored)});
  }

  void visit(const pugi::xml_node& node, int depth) {
    if (depth > kDeepest) throw XmlFault{node.offset_debug(), "its elements are nested too deeply"};
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      const std::string_view name = child.name();
      std::set<std::string_view> used;
      if (name == "Machine") {
        if (machines_.size() == kMostScreens) {
          throw XmlFault{child.offset_debug(), fmt::format("there are more than {} Machine elements", kMostScreens)};
        }
        machines_.push_back(read_machine(child, names_));
      } else if (name == "EyeSeparation") {
        ipd_m_ = read_separation(child, "Value");
        used = {"Value"};
      } else if (name == "Viewer") {
        if (child.attribute("EyeSeparation")) {
          separations_m_[child.attribute("Id").as_string("0")] = read_separation(child, "EyeSeparation");
        }
        used = {"Id", "EyeSeparation"};
      }
      if (name != "Machine") add_unused(child, child.name(), used, unused_);
      visit(child, depth + 1);
    }
  }

  // Finds the machine that shows the right eye on the screen of one that shows the left eye.
  void pair_eyes() {
    const auto shows = [](const Machine& machine, Eye eye) {
      return machine.stereo != nullptr && machine.stereo->eye == eye;
    };
    for (std::size_t left = 0; left < machines_.size(); ++left) {
      if (!shows(machines_[left], Eye::Left)) continue;
      for (std::size_t right = 0; right < machines_.size() && !machines_[left].partner; ++right) {
        if (!shows(machines_[right], Eye::Right) || machines_[right].partner ||
            !same_corners(machines_[left].screen, machines_[right].screen)) {
          continue;
        }
        machines_[left].partner = right;
        machines_[right].partner = left;
      }
    }
  }

  // True if every machine says its stereo and a place on one desktop.
  bool outputs_have_places() const {
    for (std::size_t i = 0; i < machines_.size(); ++i) {
      if (machines_[i].stereo == nullptr || !machines_[i].rect) return false;
      for (std::size_t j = 0; j < i; ++j) {
        if (overlap(*machines_[i].rect, *machines_[j].rect)) return false;
      }
    }
    return true;
  }

  void add(std::size_t index, bool placed, Wall& wall) {
    Machine& machine = machines_[index];
    const bool second = machine.partner && machine.stereo->eye == Eye::Right;
    const Screen& screen = second ? machines_[*machine.partner].screen : machine.screen;
    const auto known = std::find_if(wall.screens.begin(), wall.screens.end(),
                                    [&](const Screen& added) { return added.name == screen.name; });
    const auto place = static_cast<std::size_t>(known - wall.screens.begin());
    if (known == wall.screens.end()) wall.screens.push_back(screen);
    if (machine.partner) machine.used.insert("StereoType");
    if (!placed) return;
    machine.used.insert({"StereoType", "Geometry"});
    Output output;
    output.name = machine.screen.name;
    output.screen = place;
    output.mode = machine.partner ? StereoMode::Dual : machine.stereo->mode;
    if (machine.partner) output.eye = machine.stereo->eye;
    output.rect = *machine.rect;
    wall.outputs.push_back(std::move(output));
  }

  // The viewer of the first machine, since every screen is drawn for one viewer.
  Viewer viewer(const Wall& wall) {
    Viewer viewer;
    const std::string& id = machines_.front().viewer;
    const auto own = separations_m_.find(id);
    viewer.ipd_m = own == separations_m_.end() ? ipd_m_ : own->second;
    for (Machine& machine : machines_) {
      if (machine.viewer == id) machine.used.insert("ViewerId");
    }
    for (const auto& [other, separation_m] : separations_m_) {
      if (other == id) continue;
      unused_.push_back(
          {root_.offset_debug(), fmt::format("Viewer {}: ignored: EyeSeparation=\"{:g}\"; every screen is "
                                             "drawn for viewer {}",
                                             other, separation_m, id)});
    }
    if (in_front_of_all(wall.screens, viewer)) return viewer;
    const Screen& first = wall.screens.front();
    viewer.sweet_spot.position_m = first.center() + first.width_m() * first.normal();
    if (!in_front_of_all(wall.screens, viewer)) {
      throw XmlFault{root_.offset_debug(), "its screens cannot all be seen from 0 0 0 or from in front of the first"};
    }
    return viewer;
  }

  pugi::xml_node root_;
  std::vector<Machine> machines_;
  std::set<std::string> names_;
  std::map<std::string, double> separations_m_;  // eye distances of the independent viewers, by id
  double ipd_m_ = Viewer().ipd_m;
  std::vector<XmlFault> unused_;
};

Wall read_wall(const pugi::xml_document& document, const std::function<std::size_t(std::ptrdiff_t)>& line_of) {
  const pugi::xml_node root = document.child("pvx");
  if (!root) {
    const pugi::xml_node other = document.document_element();
    throw XmlFault{
        other.offset_debug(),
        fmt::format("its root is <{}>, not ParaView's <pvx>; of XML files only ParaView's are read: write its "
                    "corners into a wall file (TOML), such as a copy of assets/walls/powerwall.toml",
                    other.name())};
  }
  Configuration configuration(root);
  Wall wall = configuration.wall();
  if (const auto fault = impossible_length(wall)) {
    throw XmlFault{root.offset_debug(), fmt::format("Machine.LowerLeft: {}", fault->what)};
  }
  const std::vector<XmlFault> unused = configuration.unused();
  for (std::size_t i = 0; i < std::min(unused.size(), kMostUnused); ++i) {
    wall.unused.push_back(fmt::format("line {}: {}", line_of(unused[i].offset), unused[i].what));
  }
  if (unused.size() > kMostUnused) {
    wall.unused.push_back(
        fmt::format("{} more elements are ignored or have ignored attributes", unused.size() - kMostUnused));
  }
  return wall;
}

}  // namespace

core::Result<Wall> load_pvx(const std::string& path) {
  const auto bad = [&](const std::string& what) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("wall file {}: {}", path, what));
  };
  const auto read = core::read_beginning(path, kLargestFile + 1);
  if (!read) {
    // "cannot read PATH: there is no such file"
    const std::string& why = read.error().message;
    return bad("cannot be read" + why.substr(std::min(why.rfind(": "), why.size())));
  }
  const std::string& text = *read;
  if (text.size() > kLargestFile) return bad("is larger than 1 MiB; is it a ParaView configuration?");
  const auto line_of = [&](std::ptrdiff_t offset) {
    const auto end = text.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text));
    return static_cast<std::size_t>(1 + std::count(text.begin(), end, '\n'));
  };
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  if (!parsed) return bad(fmt::format("line {}: {}", line_of(parsed.offset), parsed.description()));
  try {
    return read_wall(document, line_of);
  } catch (const XmlFault& fault) {
    return bad(fmt::format("line {}: {}", line_of(fault.offset), fault.what));
  }
}

}  // namespace afm::scene
