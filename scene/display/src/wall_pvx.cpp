// SPDX-License-Identifier: Apache-2.0
#include "wall_pvx.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <set>
#include <string_view>

#include "core/whole_file.h"

namespace afm::scene {

namespace {

constexpr std::size_t kLargestFile = 1U << 20U;
constexpr std::size_t kMostScreens = 64;

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

Screen read_machine(const pugi::xml_node& machine, std::set<std::string>& names) {
  Screen screen;
  screen.lower_left = corner(machine, "LowerLeft");
  screen.lower_right = corner(machine, "LowerRight");
  screen.upper_left = screen.lower_left + (corner(machine, "UpperRight") - screen.lower_right);

  // one machine may drive several screens
  const std::string name = machine.attribute("Name").as_string("screen");
  screen.name = name;
  for (int i = 2; !names.insert(screen.name).second; ++i) screen.name = fmt::format("{} {}", name, i);
  if (const auto checked = check_screen(screen); !checked) {
    throw XmlFault{machine.offset_debug(), "Machine.LowerLeft: " + checked.error().message};
  }
  return screen;
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

Wall read_wall(const pugi::xml_document& document) {
  struct Reader : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override {
      const std::string_view name = node.name();
      if (name == "EyeSeparation") {
        const std::vector<double> value = numbers_in(node.attribute("Value").value());
        if (value.size() != 1 || value[0] < kSmallestIpdM || value[0] > kLargestIpdM) {
          throw XmlFault{node.offset_debug(), fmt::format("EyeSeparation.Value: must lie between {:g} and {:g} m",
                                                          kSmallestIpdM, kLargestIpdM)};
        }
        ipd_m = value[0];
      }
      if (name != "Machine") return true;
      if (wall.screens.size() == kMostScreens) {
        throw XmlFault{node.offset_debug(), fmt::format("there are more than {} Machine elements", kMostScreens)};
      }
      wall.screens.push_back(read_machine(node, names));
      return true;
    }
    Wall wall;
    std::set<std::string> names;
    double ipd_m = Viewer().ipd_m;
  } reader;
  pugi::xml_node root = document.child("pvx");
  if (!root) throw XmlFault{0, "its root is not <pvx>"};
  root.traverse(reader);
  Wall wall = std::move(reader.wall);
  if (wall.screens.empty())
    throw XmlFault{root.offset_debug(), "it has no Machine with LowerLeft, LowerRight and UpperRight"};
  Viewer viewer;
  viewer.ipd_m = reader.ipd_m;
  if (!in_front_of_all(wall.screens, viewer)) {
    const Screen& first = wall.screens.front();
    viewer.sweet_spot.position_m = first.center() + first.width_m() * first.normal();
    if (!in_front_of_all(wall.screens, viewer)) {
      throw XmlFault{root.offset_debug(), "its screens cannot all be seen from 0 0 0 or from in front of the first"};
    }
  }
  wall.viewers.push_back(viewer);
  return wall;
}

}  // namespace

core::Result<Wall> load_pvx(const std::string& path) {
  const auto bad = [&](const std::string& what) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("wall file {}: {}", path, what));
  };
  const auto read = core::read_beginning(path, kLargestFile + 1);
  if (!read) return bad("cannot be read; check the path and its permissions");
  const std::string& text = *read;
  if (text.size() > kLargestFile) return bad("is larger than 1 MiB; is it a ParaView configuration?");
  const auto line_of = [&](std::ptrdiff_t offset) {
    const auto end = text.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text));
    return 1 + std::count(text.begin(), end, '\n');
  };
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  if (!parsed) return bad(fmt::format("line {}: {}", line_of(parsed.offset), parsed.description()));
  try {
    return read_wall(document);
  } catch (const XmlFault& fault) {
    return bad(fmt::format("line {}: {}", line_of(fault.offset), fault.what));
  }
}

}  // namespace afm::scene
