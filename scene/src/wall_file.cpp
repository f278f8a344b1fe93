// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <set>
#include <string_view>

#include "physics/quantity_text.h"
#include "scene/toml_fault.h"
#include "scene/wall.h"

namespace afm::scene {

namespace {

// Dodgson 2004: 45 to 80 mm covers nearly all adults, children from 40 mm. Beyond it, it is a slip of the unit.
constexpr double kSmallestIpdM = 0.030;
constexpr double kLargestIpdM = 0.090;

class Reader {
 public:
  Reader(const toml::table& table, std::string section) : table_(table), section_(std::move(section)) {}

  void allow_only(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, node] : table_) {
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end()) {
        throw Fault{node.source(), name(key.str()), fmt::format("unknown key; known are {}", fmt::join(keys, ", "))};
      }
    }
  }

  std::string text(std::string_view key) const {
    const auto value = required(key).value_exact<std::string>();
    if (!value || value->empty()) throw Fault{required(key).source(), name(key), "must be a text that is not empty"};
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
  const Reader reader(table, "screen");
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

Viewer read_viewer(const toml::table& table) {
  const Reader reader(table, "viewer");
  reader.allow_only({"name", "ipd", "sweet_spot", "sweet_spot_orientation"});
  Viewer viewer;
  viewer.name = reader.text("name");
  viewer.ipd_m = reader.length_m("ipd", kSmallestIpdM, kLargestIpdM);
  viewer.sweet_spot.position_m = reader.point("sweet_spot");
  if (reader.has("sweet_spot_orientation")) {
    const auto q = reader.numbers<4>("sweet_spot_orientation", "a unit quaternion [x, y, z, w]");
    const glm::dquat orientation(q[3], q[0], q[1], q[2]);
    if (std::abs(glm::length(orientation) - 1.0) > 1e-3) {
      throw Fault{table.source(), "viewer.sweet_spot_orientation", "must be a unit quaternion [x, y, z, w]"};
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
  Reader(root, "wall").allow_only({"screen", "viewer"});
  Wall wall;
  std::set<std::string> names;
  read_tables(root, "screen", [&](const toml::table& table) {
    wall.screens.push_back(read_screen(table));
    if (!names.insert(wall.screens.back().name).second) {
      throw Fault{table.source(), "screen.name", fmt::format("\"{}\" is used twice", wall.screens.back().name)};
    }
  });
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

}  // namespace

core::Result<Wall> load_wall(const std::string& path) { return read_toml("wall file", path, read_wall); }

}  // namespace afm::scene
