// SPDX-License-Identifier: Apache-2.0
#include "screen_blends.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <utility>

namespace afm::scene {

namespace {

using Table = BlendFault::Table;

constexpr std::array kScreenEdges{ScreenEdge::Left, ScreenEdge::Top, ScreenEdge::Right, ScreenEdge::Bottom};
constexpr double kSameWidthM = 1e-6;

constexpr std::size_t index_of(ScreenEdge edge) { return static_cast<std::size_t>(edge); }
constexpr ScreenEdge facing(ScreenEdge edge) { return kScreenEdges.at((index_of(edge) + 2) % kScreenEdges.size()); }
std::string key_of(ScreenEdge edge) { return "blend_" + std::string(kScreenEdgeNames.at(index_of(edge))); }

// Screen in its plane, in metres from the lower left corner of the plane's first screen; y up.
struct PlaneBox {
  std::size_t plane = 0;  // index of the plane's first screen
  glm::dvec2 low{0.0}, high{0.0};
  double turned_m = 0;  // height of its right end above its left end
};

std::vector<PlaneBox> boxes_of(const std::vector<Screen>& screens) {
  std::vector<PlaneBox> boxes;
  for (std::size_t i = 0; i < screens.size(); ++i) {
    std::size_t first = 0;
    while (boxes.size() > first && (boxes[first].plane != first || !in_one_plane(screens[first], screens[i]))) ++first;
    const Screen& leader = screens[first];
    const glm::dvec3 right = glm::normalize(leader.lower_right - leader.lower_left);
    const glm::dvec3 up = glm::cross(leader.normal(), right);
    const auto place = [&](const glm::dvec3& corner) {
      const glm::dvec3 from_leader = corner - leader.lower_left;
      return glm::dvec2(glm::dot(from_leader, right), glm::dot(from_leader, up));
    };
    const glm::dvec2 low = place(screens[i].lower_left), end = place(screens[i].lower_right);
    boxes.push_back({first, low, {end.x, place(screens[i].upper_left).y}, end.y - low.y});
  }
  return boxes;
}

// Depth to which `b`, which extends beyond that edge of `a`, overlaps `a`.
std::optional<double> overlap_m(const PlaneBox& a, const PlaneBox& b, ScreenEdge edge) {
  if (a.plane != b.plane) return std::nullopt;
  const bool across = edge == ScreenEdge::Left || edge == ScreenEdge::Right;
  const bool upwards = edge == ScreenEdge::Right || edge == ScreenEdge::Top;
  const glm::length_t axis = across ? 0 : 1, other = 1 - axis;
  const double beside = std::min(a.high[other], b.high[other]) - std::max(a.low[other], b.low[other]);
  const double depth = upwards ? a.high[axis] - b.low[axis] : b.high[axis] - a.low[axis];
  const double beyond = upwards ? b.high[axis] - a.high[axis] : a.low[axis] - b.low[axis];
  const double before = upwards ? b.low[axis] - a.low[axis] : a.high[axis] - b.high[axis];
  if (std::min({beside, depth, beyond, before}) < kLeastOverlapM) return std::nullopt;
  return depth;
}

// All overlaps at one edge of a screen.
struct EdgeOverlap {
  std::vector<std::size_t> screens;
  std::size_t shallowest = 0;  // index of the screen with the smallest depth
  double depth_m = 0;          // smallest depth
};

EdgeOverlap overlap_of(const std::vector<PlaneBox>& boxes, std::size_t screen, ScreenEdge edge) {
  EdgeOverlap overlap;
  for (std::size_t j = 0; j < boxes.size(); ++j) {
    const auto depth = j == screen ? std::nullopt : overlap_m(boxes[screen], boxes[j], edge);
    if (!depth) continue;
    if (overlap.screens.empty() || *depth < overlap.depth_m) {
      overlap.shallowest = j;
      overlap.depth_m = *depth;
    }
    overlap.screens.push_back(j);
  }
  return overlap;
}

// Ramp at an edge: the width given for this edge or for one that faces it; otherwise the whole overlap.
tl::expected<EdgeRamp, BlendFault> ramp_of(const std::vector<Screen>& screens, const std::vector<EdgeWidths>& widths_m,
                                           std::size_t screen, ScreenEdge edge, const EdgeOverlap& overlap) {
  const auto fault = [&](std::string what) {
    return tl::unexpected(BlendFault{Table::Screen, screen, key_of(edge), std::move(what)});
  };
  std::optional<double> wanted_m = widths_m[screen].at(index_of(edge));
  if (overlap.screens.empty()) {
    if (!wanted_m) return EdgeRamp{};
    return fault(
        fmt::format("no screen overlaps this edge by {:g} mm or more; remove the key or measure the corners "
                    "again",
                    kLeastOverlapM * 1e3));
  }
  for (const std::size_t j : overlap.screens) {
    const auto theirs_m = widths_m[j].at(index_of(facing(edge)));
    if (theirs_m && std::abs(wanted_m.value_or(*theirs_m) - *theirs_m) > kSameWidthM) {
      return fault(
          fmt::format("is {:g} mm, but screen \"{}\" has {} = \"{:g} mm\"; both sides of an overlap need the "
                      "same width: give one of them",
                      *wanted_m * 1e3, screens[j].name, key_of(facing(edge)), *theirs_m * 1e3));
    }
    if (theirs_m) wanted_m = theirs_m;
  }
  const double width_m = wanted_m.value_or(overlap.depth_m);
  if (width_m > overlap.depth_m + kSameWidthM) {
    return fault(fmt::format("is {:g} mm, but screen \"{}\" overlaps this edge by {:g} mm only", width_m * 1e3,
                             screens[overlap.shallowest].name, overlap.depth_m * 1e3));
  }
  return EdgeRamp{std::max(0.0, 0.5 * (overlap.depth_m - width_m)), std::min(width_m, overlap.depth_m)};
}

// Fields of that screen and its neighbours, in unit coordinates of the screen's picture.
std::vector<Blend::Field> fields_of(const std::vector<Screen>& screens, std::size_t screen,
                                    const std::function<double(std::size_t)>& black_of) {
  const std::vector<PlaneBox> boxes = boxes_of(screens);
  const PlaneBox& own = boxes[screen];
  const glm::dvec2 size = own.high - own.low;
  std::vector<std::size_t> members{screen};
  members.insert(members.end(), screens[screen].blend->neighbours.begin(), screens[screen].blend->neighbours.end());
  std::vector<Blend::Field> fields;
  for (const std::size_t member : members) {
    const PlaneBox& box = boxes[member];
    Blend::Field field{.low = {(box.low.x - own.low.x) / size.x, (own.high.y - box.high.y) / size.y},
                       .high = {(box.high.x - own.low.x) / size.x, (own.high.y - box.low.y) / size.y},
                       .black = black_of(member)};
    for (const ScreenEdge edge : kScreenEdges) {
      const bool across = edge == ScreenEdge::Left || edge == ScreenEdge::Right;
      const EdgeRamp& ramp = screens[member].blend->ramp(edge);
      field.begin.at(index_of(edge)) = ramp.begin_m / (across ? size.x : size.y);
      field.width.at(index_of(edge)) = ramp.width_m / (across ? size.x : size.y);
    }
    fields.push_back(field);
  }
  return fields;
}

// Calls `take` with the centre of each cell between the borders of ramps and screens in a picture.
void for_each_cell(const Blend& blend, const std::function<void(const glm::dvec2&)>& take) {
  std::array<std::vector<double>, 2> borders{std::vector{0.0, 1.0}, std::vector{0.0, 1.0}};
  for (const Blend::Field& field : blend.fields) {
    for (const ScreenEdge edge : kScreenEdges) {
      const std::size_t i = index_of(edge), axis = i % 2;
      const bool from_low = i < 2;
      const auto at = static_cast<glm::length_t>(axis);
      for (const double inwards : {0.0, field.begin.at(i), field.begin.at(i) + field.width.at(i)}) {
        borders.at(axis).push_back(from_low ? field.low[at] + inwards : field.high[at] - inwards);
      }
    }
  }
  for (auto& along : borders) {
    for (double& border : along) border = std::clamp(border, 0.0, 1.0);
    std::sort(along.begin(), along.end());
  }
  const auto& [x, y] = borders;
  for (std::size_t column = 0; column + 1 < x.size(); ++column) {
    for (std::size_t row = 0; row + 1 < y.size(); ++row) {
      if (x[column + 1] > x[column] && y[row + 1] > y[row]) {
        take({0.5 * (x[column] + x[column + 1]), 0.5 * (y[row] + y[row + 1])});
      }
    }
  }
}

// Connected group of overlapping screens that contains this one.
std::vector<std::size_t> group_of(const std::vector<Screen>& screens, std::size_t screen) {
  std::vector<std::size_t> group{screen};
  for (std::size_t i = 0; i < group.size(); ++i) {
    for (const std::size_t j : screens[group[i]].blend->neighbours) {
      if (std::find(group.begin(), group.end(), j) == group.end()) group.push_back(j);
    }
  }
  std::sort(group.begin(), group.end());
  return group;
}

std::optional<BlendFault> check_group(const std::vector<Screen>& screens, const PlaneBox& box, std::size_t screen) {
  const auto fault = [&](std::string key, std::string what) {
    return BlendFault{Table::Screen, screen, std::move(key), std::move(what)};
  };
  const ScreenBlend& blend = *screens[screen].blend;
  if (blend.neighbours.size() >= Blend::kMostScreens) {
    return fault("name", fmt::format("{} screens overlap this one; at most {} can be blended with it",
                                     blend.neighbours.size(), Blend::kMostScreens - 1));
  }
  if (std::abs(box.turned_m) > kLeastOverlapM) {
    return fault("lower_right", fmt::format("its right end is {:.0f} mm {} than its left one, against the first screen "
                                            "of its plane; measure the corners again, or square it with a homography",
                                            std::abs(box.turned_m) * 1e3, box.turned_m > 0 ? "higher" : "lower"));
  }
  std::optional<BlendFault> gap;
  const Blend trial{.fields = fields_of(screens, screen, [](std::size_t) { return 0.0; })};
  for_each_cell(trial, [&](const glm::dvec2& place) {
    if (gap || trial.at(place).all > 0.0) return;
    const auto dark = std::find_if(kScreenEdges.begin(), kScreenEdges.end(),
                                   [&](ScreenEdge edge) { return blend.ramp(edge).begin_m > 0.0; });
    gap = fault(key_of(dark == kScreenEdges.end() ? ScreenEdge::Left : *dark),
                fmt::format("the widths leave a dark place {:.3f} m from the left and {:.3f} m from the top of the "
                            "screen; leave them out or align the screens in rows and columns",
                            place.x * screens[screen].width_m(), place.y * screens[screen].height_m()));
  });
  return gap;
}

// Output of a screen that is seen together with another one, by the same eye.
const Output* shown_with(const Wall& wall, std::size_t screen, const Output& output) {
  if (screen == output.screen) return &output;
  const auto found = std::find_if(wall.outputs.begin(), wall.outputs.end(), [&](const Output& other) {
    return other.screen == screen && (!other.eye || !output.eye || *other.eye == *output.eye);
  });
  return found == wall.outputs.end() ? nullptr : &*found;
}

Blend blend_of(const Wall& wall, std::size_t screen, const std::function<double(std::size_t)>& black_of) {
  Blend blend{.fields = fields_of(wall.screens, screen, black_of)};
  blend.darkest_black = 1.0;
  for (const std::size_t member : group_of(wall.screens, screen)) {
    const Blend theirs{.fields = fields_of(wall.screens, member, black_of)};
    for_each_cell(theirs, [&](const glm::dvec2& place) {
      const double black = theirs.at(place).black;
      blend.brightest_black = std::max(blend.brightest_black, black);
      blend.darkest_black = std::min(blend.darkest_black, black);
    });
  }
  return blend;
}

}  // namespace

std::optional<BlendFault> blend_screens(std::vector<Screen>& screens, const std::vector<EdgeWidths>& widths_m) {
  const std::vector<PlaneBox> boxes = boxes_of(screens);
  for (std::size_t i = 0; i < screens.size(); ++i) {
    ScreenBlend blend;
    for (const ScreenEdge edge : kScreenEdges) {
      const EdgeOverlap overlap = overlap_of(boxes, i, edge);
      const auto ramp = ramp_of(screens, widths_m, i, edge, overlap);
      if (!ramp) return ramp.error();
      blend.ramps.at(index_of(edge)) = *ramp;
      for (const std::size_t j : overlap.screens) {
        const auto known = std::find(blend.neighbours.begin(), blend.neighbours.end(), j);
        if (known == blend.neighbours.end()) blend.neighbours.push_back(j);
      }
    }
    if (!blend.neighbours.empty()) screens[i].blend = std::move(blend);
  }
  for (std::size_t i = 0; i < screens.size(); ++i) {
    if (!screens[i].blend) continue;
    screens[i].blend->origin = screens[group_of(screens, i).front()].center();
    if (auto fault = check_group(screens, boxes[i], i)) return fault;
  }
  return std::nullopt;
}

std::optional<BlendFault> blend_outputs(Wall& wall, const std::vector<ProjectorLight>& lights) {
  const auto light_of = [&](const Output& output) -> const ProjectorLight& {
    return lights[static_cast<std::size_t>(&output - wall.outputs.data())];
  };
  for (std::size_t i = 0; i < wall.outputs.size(); ++i) {
    Output& output = wall.outputs[i];
    const auto fault = [&](const char* key, std::string what) {
      return BlendFault{Table::Output, i, key, std::move(what)};
    };
    if (!wall.screens[output.screen].blend) {
      if (!lights[i].gamma && !lights[i].black) continue;
      return fault(lights[i].gamma ? "gamma" : "black_level",
                   "applies only where another screen overlaps the output's; remove it");
    }
    for (const std::size_t member : group_of(wall.screens, output.screen)) {
      const Output* const other = shown_with(wall, member, output);
      if (other == nullptr) {
        return fault("screen", fmt::format("its picture fades out towards screen \"{}\", which no output shows{}",
                                           wall.screens[member].name, output.eye ? " to this eye" : ""));
      }
      if (light_of(*other).black && !lights[i].black) {
        return fault("black_level", fmt::format("is missing; output \"{}\" has one, and black is the same everywhere "
                                                "only if all have",
                                                other->name));
      }
    }
    Blend blend = blend_of(wall, output.screen, [&](std::size_t screen) {
      return light_of(*shown_with(wall, screen, output)).black.value_or(0.0);
    });
    blend.gamma = lights[i].gamma;
    output.blend = std::make_shared<const Blend>(std::move(blend));
  }
  return std::nullopt;
}

std::shared_ptr<const Blend> usual_blend(const Wall& wall, std::size_t screen) {
  if (!wall.screens[screen].blend) return nullptr;
  return std::make_shared<const Blend>(blend_of(wall, screen, [](std::size_t) { return 0.0; }));
}

}  // namespace afm::scene
