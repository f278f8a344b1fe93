// SPDX-License-Identifier: Apache-2.0
#include "scene/display/wall_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <string_view>

#include "coverage_doubts.h"
#include "wall_units.h"

namespace afm::scene {

namespace {

constexpr double kLongestEdgeM = 60.0;     // the largest screens of open-air stages
constexpr double kFarthestHeadM = 60.0;    // distance at which a wall of 3 m fills three degrees
constexpr double kFarthestPointM = 1e3;    // distance at which floats, in which pictures are drawn, are 0.1 mm apart
constexpr double kSmallestExtentM = 0.03;  // size of a watch
constexpr double kNearestHeadM = 0.1;      // distance nearer than anybody can focus
constexpr double kGrazing = 0.17;          // sine of ten degrees
constexpr double kFlat = 0.95;             // sine of 72 degrees: floors, ceilings and tables within 18 degrees
constexpr double kUpright = 0.866;         // cosine of 30 degrees
constexpr double kFacing = 0.26;           // cosine of 75 degrees between the lines of the eyes and of the screen
constexpr double kBelowFloorM = 0.5;       // depth of the floor in a room whose origin is at the height of a seat
constexpr double kMostDark = 0.2;          // share of a projector outside its mesh
constexpr double kMostLost = 0.2;          // share of a picture that a keystone puts outside the projector
constexpr double kRounding = 1e-12;        // error of a homography that was inverted twice
constexpr std::string_view kCheckUnit = "lengths are in metres: check the unit";
constexpr glm::dvec3 kUp(0.0, 1.0, 0.0);

glm::dvec3 right_of(const Screen& screen) { return glm::normalize(screen.lower_right - screen.lower_left); }
glm::dvec3 up_of(const Screen& screen) { return glm::cross(screen.normal(), right_of(screen)); }
bool is_flat(const Screen& screen) { return std::abs(screen.normal().y) > kFlat; }

// Axis nearest to the direction, and the rotation that makes it the room's +y.
struct UpwardAxis {
  std::string_view name, turned;
};
UpwardAxis upward_axis(const glm::dvec3& direction) {
  constexpr std::array<std::array<UpwardAxis, 2>, 3> kAxes{{{{{"+x", "[-y, x, z]"}, {"-x", "[y, -x, z]"}}},
                                                            {{{"+y", "[x, y, z]"}, {"-y", "[-x, -y, z]"}}},
                                                            {{{"+z", "[x, z, -y]"}, {"-z", "[x, -z, y]"}}}}};
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(direction[i]) > std::abs(direction[axis])) axis = i;
  }
  return kAxes.at(static_cast<std::size_t>(axis)).at(direction[axis] < 0.0 ? 1 : 0);
}

std::string list_of(const std::vector<const Screen*>& screens) {
  std::string names;
  for (const Screen* screen : screens) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", screen->name);
  return (screens.size() == 1 ? "screen " : "screens ") + names;
}

std::string who(const Viewer& viewer) { return fmt::format("viewer \"{}\"", viewer.name); }

// If every screen lies flat or is turned, an upper edge along +z may be that of a wall in a room whose z points up:
// a floor's points away from the viewer, and a viewer's head is a person's height above the floor.
bool lies_in_a_room_with_z_up(const Screen& screen, const HeadPose& head) {
  constexpr double kLowestM = 0.3, kHighestM = 2.5;
  if (up_of(screen).z < kUpright) return false;
  const auto is_height = [&](double height_m) { return height_m >= kLowestM && height_m <= kHighestM; };
  if (!is_height(head.position_m.y)) return true;
  const glm::dvec3 forward = head.room_from_head * glm::dvec3(0.0, 0.0, -1.0);
  return screen.normal().y > 0.0 && glm::dot(forward, up_of(screen)) < -kUpright && is_height(head.position_m.z) &&
         screen.lower_left.z >= 0.0;
}

std::vector<std::string> doubts_of_upright(const Wall& wall) {
  std::vector<const Screen*> upside_down, turned, flat;
  for (const Screen& screen : wall.screens) {
    if (is_flat(screen)) {
      flat.push_back(&screen);
      continue;
    }
    const glm::dvec3 normal = screen.normal();
    const double upright = glm::dot(up_of(screen), glm::normalize(kUp - normal.y * normal));
    if (upright < -0.5) {
      upside_down.push_back(&screen);
    } else if (upright < kUpright) {
      turned.push_back(&screen);
    }
  }
  if (flat.size() + turned.size() == wall.screens.size()) {
    for (const Screen* screen : flat) {
      if (lies_in_a_room_with_z_up(*screen, wall.viewers.front().sweet_spot)) turned.push_back(screen);
    }
  }
  std::vector<std::string> doubts;
  if (!upside_down.empty()) {
    doubts.push_back(fmt::format(
        "{}: the upper edge is below the lower edge, so the picture is upside down in the room and lit from below: "
        "give the corners as a viewer in front of the screen sees them, and +y upwards",
        list_of(upside_down)));
  }
  if (!turned.empty()) {
    const UpwardAxis up = upward_axis(up_of(*turned.front()));
    doubts.push_back(fmt::format(
        "{}: the upper edge points along {}, but +y points up in the room, so the picture lies on its back or its "
        "side: if {} points up in your room, write each point x, y, z as {}; otherwise give the corners as a "
        "viewer in front of the screen sees them",
        list_of(turned), up.name, up.name, up.turned));
  }
  return doubts;
}

std::string quaternion_text(const glm::dquat& turn) {
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4 + 0.0; };
  const glm::dquat q = turn.w < 0.0 ? -turn : turn;
  return fmt::format("[{:g}, {:g}, {:g}, {:g}]", rounded(q.x), rounded(q.y), rounded(q.z), rounded(q.w));
}

// Component of the line between the eyes along the screen, negative if the eyes are exchanged in front of it.
double line_of_eyes_along(const Screen& screen, const glm::dquat& room_from_head) {
  const glm::dvec3 right = room_from_head * glm::dvec3(1.0, 0.0, 0.0);
  if (!is_flat(screen)) return glm::dot(right, right_of(screen));
  return glm::length(right - glm::dot(right, screen.normal()) * screen.normal());  // from any side of a table
}

bool looks_towards(const Screen& screen, const HeadPose& head) {
  const glm::dvec3 forward = head.room_from_head * glm::dvec3(0.0, 0.0, -1.0);
  const std::array corners{screen.lower_left, screen.lower_right, screen.upper_left,
                           screen.lower_right + screen.upper_left - screen.lower_left};
  return std::any_of(corners.begin(), corners.end(),
                     [&](const glm::dvec3& corner) { return glm::dot(forward, corner - head.position_m) > 0.0; });
}

enum class HeadTurn { Good, UpsideDown, OnItsSide, Exchanged, Away, Past };

HeadTurn turn_of(const Wall& wall, const HeadPose& head) {
  if ((head.room_from_head * kUp).y < -0.5) return HeadTurn::UpsideDown;
  if (std::abs((head.room_from_head * glm::dvec3(1.0, 0.0, 0.0)).y) > kUpright) return HeadTurn::OnItsSide;
  double best = -1.0;
  bool towards = false;
  for (const Screen& screen : wall.screens) {
    best = std::max(best, line_of_eyes_along(screen, head.room_from_head));
    towards = towards || looks_towards(screen, head);
  }
  if (best < -kFacing) return HeadTurn::Exchanged;
  if (best < kFacing) return HeadTurn::Past;
  return towards ? HeadTurn::Good : HeadTurn::Away;
}

// Orientation that was probably meant: the same numbers with w first, or straight towards an upright screen.
std::string turn_that_fits(const Wall& wall, const Viewer& viewer) {
  const glm::dquat& read = viewer.sweet_spot.room_from_head;
  HeadPose other = viewer.sweet_spot;
  other.room_from_head = glm::dquat(read.x, read.y, read.z, read.w);  // w, x, y, z from the file's four numbers
  if (turn_of(wall, other) == HeadTurn::Good) {
    return fmt::format("sweet_spot_orientation is x, y, z, w: if yours begins with w, write {}",
                       quaternion_text(other.room_from_head));
  }
  for (const Screen& screen : wall.screens) {
    const glm::dvec3 normal = screen.normal();
    if (is_flat(screen)) continue;
    const glm::dvec3 back = glm::normalize(glm::dvec3(normal.x, 0.0, normal.z));
    other.room_from_head = glm::quat_cast(glm::dmat3(glm::cross(kUp, back), kUp, back));
    return fmt::format("facing screen \"{}\", sweet_spot_orientation is {}", screen.name,
                       quaternion_text(other.room_from_head));
  }
  return "check sweet_spot_orientation, x, y, z, w";
}

void doubt_turn(const Wall& wall, const Viewer& viewer, std::vector<std::string>& doubts) {
  constexpr std::array<std::string_view, 6> kSaid{
      "",
      "hangs upside down",
      "lies on its side",
      "looks away from every screen, so that the eyes are exchanged",
      "looks away from every screen",
      "looks past every screen, so that both eyes see nearly the same picture"};
  const HeadTurn turn = turn_of(wall, viewer.sweet_spot);
  if (turn == HeadTurn::Good) return;
  doubts.push_back(fmt::format("{}: the head {}: {}", who(viewer), kSaid.at(static_cast<std::size_t>(turn)),
                               turn_that_fits(wall, viewer)));
}

std::string unit_or(const Wall& wall, const Viewer& viewer, std::string_view otherwise) {
  const std::string unit = unit_that_fits(wall, viewer);
  return unit.empty() ? std::string(otherwise) : unit;
}

void doubt_distance(const Wall& wall, const Viewer& viewer, std::vector<std::string>& doubts) {
  const glm::dvec3& head_m = viewer.sweet_spot.position_m;
  const WallLengths lengths = lengths_of(wall, viewer);
  if (too_far(lengths)) {
    doubts.push_back(fmt::format("{}: the head is {:.2f} m in front of a wall whose diagonal is {:.2f} m; {}",
                                 who(viewer), lengths.distance_m, lengths.extent_m, unit_or(wall, viewer, kCheckUnit)));
  } else if (too_high(lengths)) {
    doubts.push_back(fmt::format("{}: the head is {:.2f} m above the floor; {}", who(viewer), lengths.head_height_m,
                                 unit_or(wall, viewer, kCheckUnit)));
  }
  for (const Screen& screen : wall.screens) {
    const double distance_m = glm::dot(head_m - screen.lower_left, screen.normal());
    if (is_flat(screen) || (distance_m >= kLeastWidths * screen.width_m() && distance_m >= kNearestHeadM)) continue;
    doubts.push_back(fmt::format("{}: the head is {:.0f} mm in front of screen \"{}\", which is {:.2f} m wide: {}",
                                 who(viewer), distance_m * 1e3, screen.name, screen.width_m(),
                                 unit_or(wall, viewer, "check sweet_spot and the corners")));
  }
}

// Reports a head so far beside all screens that it sees only strips of them.
void doubt_side(const Wall& wall, const Viewer& viewer, std::vector<std::string>& doubts) {
  const glm::dvec3& head_m = viewer.sweet_spot.position_m;
  double best = 0.0;
  const Screen* faced = nullptr;
  for (const Screen& screen : wall.screens) {
    const glm::dvec3 right = screen.lower_right - screen.lower_left, up = screen.upper_left - screen.lower_left;
    const glm::dvec3 to_head = head_m - screen.lower_left;
    const double along = std::clamp(glm::dot(to_head, right) / glm::dot(right, right), 0.0, 1.0),
                 high = std::clamp(glm::dot(to_head, up) / glm::dot(up, up), 0.0, 1.0);
    const double nearest_m = glm::distance(head_m, screen.lower_left + along * right + high * up);
    const double sine = glm::dot(to_head, screen.normal()) / nearest_m;
    if (sine > best) faced = &screen;
    best = std::max(best, sine);
  }
  if (faced == nullptr || best >= kGrazing) return;
  doubts.push_back(fmt::format(
      "{}: the head is {:.2f} m in front of screen \"{}\" but so far beside it that its picture is a strip: check "
      "sweet_spot and the corners",
      who(viewer), glm::dot(head_m - faced->lower_left, faced->normal()), faced->name));
}

void doubt_floor(const Wall& wall, const Viewer& viewer, std::vector<std::string>& doubts) {
  double floor_m = 0.0;
  for (const Screen& screen : wall.screens) {
    for (const glm::dvec3& corner : {screen.lower_left, screen.lower_right, screen.upper_left}) {
      floor_m = std::min(floor_m, corner.y);
    }
  }
  const double below_m = floor_m - viewer.sweet_spot.position_m.y;
  if (below_m < kBelowFloorM) return;
  doubts.push_back(fmt::format(
      "{}: the head is {:.2f} m below the floor: +y points up; if z points up in your room, write each point x, y, z "
      "as [x, z, -y]",
      who(viewer), below_m));
}

void doubt_mesh(const Output& output, std::vector<std::string>& doubts) {
  if (!output.warp) return;
  constexpr glm::uvec2 kRaster(96, 54);
  const std::vector<glm::vec4> map = warp_map(*output.warp, kRaster);
  const auto dark = std::count_if(map.begin(), map.end(), [](const glm::vec4& place) { return place.w == 0.0F; });
  const double share = double(dark) / double(map.size());
  if (share < kMostDark) return;
  double widest = 0.0;  // largest distance from the middle, in half widths of the output
  for (const WarpNode& node : output.warp->nodes) widest = std::max(widest, std::abs(2.0 * node.output.x - 1.0));
  std::string fix = "check its nodes";
  if (widest < 1.0 - kMostDark / 2.0 && output.rect.size_px.y > 0) {
    const double aspect = double(output.rect.size_px.x) / double(output.rect.size_px.y);
    fix = fmt::format("its x goes to {:.2f}; on an output of {} x {} pixels the edge is at {:.2f}", widest * aspect,
                      output.rect.size_px.x, output.rect.size_px.y, aspect);
  }
  doubts.push_back(fmt::format("output \"{}\": {:.0f} % of the projector is outside its warp mesh and stays dark: {}",
                               output.name, share * 100.0, fix));
}

// Fraction of the picture that a keystone puts outside the output.
double lost_share(const glm::dmat3& output_from_picture) {
  constexpr int kSteps = 24;
  int lost = 0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const int column = i % kSteps, row = i / kSteps;
    const glm::dvec2 place((column + 0.5) / kSteps, (row + 0.5) / kSteps);
    const glm::dvec3 image = output_from_picture * glm::dvec3(place, 1.0);
    const glm::dvec2 shown = glm::dvec2(image) / image.z;
    if (shown.x < 0.0 || shown.x > 1.0 || shown.y < 0.0 || shown.y > 1.0) ++lost;
  }
  return double(lost) / (kSteps * kSteps);
}

// Reports a homography measured in pixels, as OpenCV returns it: it puts the picture outside the projector.
void doubt_keystone(const Output& output, std::vector<std::string>& doubts) {
  const glm::dmat3 keystone = glm::inverse(output.picture_from_output);
  const double lost = lost_share(keystone);
  if (lost < kMostLost) return;
  std::string fix = "it takes places in 0..1 to places in 0..1";
  const glm::dvec2 size_px(output.rect.size_px);
  if (size_px.x > 0.0 && size_px.y > 0.0) {
    const glm::dmat3 px(size_px.x, 0, 0, 0, size_px.y, 0, 0, 0, 1);
    const glm::dmat3 scaled = glm::inverse(px) * keystone * px;
    if (lost_share(scaled) < kMostLost) {
      glm::dmat3 m = scaled / scaled[2][2];
      for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
          if (std::abs(m[column][row]) < kRounding) m[column][row] = 0.0;
        }
      }
      fix += fmt::format(
          "; if it was measured in pixels, write [{:.6g}, {:.6g}, {:.6g}, {:.6g}, {:.6g}, {:.6g}, {:.6g}, {:.6g}, 1]",
          m[0][0], m[1][0], m[2][0], m[0][1], m[1][1], m[2][1], m[0][2], m[1][2]);
    }
  }
  doubts.push_back(fmt::format("output \"{}\": its homography puts {:.0f} % of the picture outside the projector: {}",
                               output.name, lost * 100.0, fix));
}

// Empty for a screen that can be built. Where the other screens are in metres, their sizes give the unit of this one.
std::string impossible_size(const Wall& wall, const Screen& screen) {
  if (std::max(screen.width_m(), screen.height_m()) <= kLongestEdgeM) return "";
  std::string what = fmt::format("the screen would be {:.0f} m x {:.0f} m", screen.width_m(), screen.height_m());
  const Screen* in_metres = screen_in_metres(wall, screen);
  if (in_metres == nullptr) return what + "; " + unit_or(wall, wall.viewers.front(), kCheckUnit);
  const std::string unit = unit_of_one_screen(screen, *in_metres);
  return what + fmt::format(", beside screen \"{}\" of {:.2f} m x {:.2f} m; {}", in_metres->name, in_metres->width_m(),
                            in_metres->height_m(), unit.empty() ? kCheckUnit : unit);
}

}  // namespace

std::vector<std::string> doubts_of(const Wall& wall) {
  std::vector<std::string> doubts;
  for (const Screen& screen : wall.screens) {
    if (std::max(screen.width_m(), screen.height_m()) >= kSmallestExtentM) continue;
    doubts.push_back(fmt::format("screen \"{}\": it is {:.1f} mm x {:.1f} mm; lengths are in metres", screen.name,
                                 screen.width_m() * 1e3, screen.height_m() * 1e3));
  }
  doubt_coverage(wall, doubts);
  const std::vector<std::string> turned = doubts_of_upright(wall);
  doubts.insert(doubts.end(), turned.begin(), turned.end());
  for (const Viewer& viewer : wall.viewers) {
    doubt_distance(wall, viewer, doubts);
    doubt_side(wall, viewer, doubts);
    if (!turned.empty()) continue;  // the same cause
    doubt_turn(wall, viewer, doubts);
    doubt_floor(wall, viewer, doubts);
  }
  for (const Output& output : wall.outputs) {
    doubt_mesh(output, doubts);
    doubt_keystone(output, doubts);
  }
  return doubts;
}

std::vector<std::string> notes_of(const Wall& wall) {
  std::vector<std::string> notes = wall.unused;
  const std::vector<std::string> doubts = doubts_of(wall);
  notes.insert(notes.end(), doubts.begin(), doubts.end());
  return notes;
}

std::optional<ImpossibleLength> impossible_length(const Wall& wall) {
  for (std::size_t i = 0; i < wall.screens.size(); ++i) {
    const std::string what = impossible_size(wall, wall.screens[i]);
    if (!what.empty()) return ImpossibleLength{.index = i, .what = what};
  }
  for (std::size_t i = 0; i < wall.screens.size(); ++i) {
    const double from_origin_m = glm::length(wall.screens[i].center());
    if (from_origin_m <= kFarthestPointM) continue;
    return ImpossibleLength{
        .index = i,
        .what = fmt::format("the screen would be {:.0f} m from the room's origin; lengths are in metres: subtract one "
                            "point of the room, such as the floor in front of the wall, from every point",
                            from_origin_m)};
  }
  for (std::size_t i = 0; i < wall.viewers.size(); ++i) {
    const WallLengths lengths = lengths_of(wall, wall.viewers[i]);
    if (lengths.distance_m <= kFarthestHeadM || !too_far(lengths)) continue;
    return ImpossibleLength{
        .of_viewer = true,
        .index = i,
        .what = fmt::format("the head would be {:.0f} m in front of a screen {:.2f} m wide; {}", lengths.distance_m,
                            wall.screens.front().width_m(), unit_or(wall, wall.viewers[i], kCheckUnit))};
  }
  return std::nullopt;
}

}  // namespace afm::scene
