// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scenery/stage_place.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace afm::exhibit {

namespace {

using glm::dvec3;
using scene::Screen;

constexpr double kCorner = 0.05;     // gap of adjoining screens, relative to the main screen's width
constexpr double kNarrowest = 0.25;  // width of a side screen in units of the main one; too narrow for a panel below
constexpr double kFacingTie = 0.02;  // difference of cosines below which two screens are faced equally

dvec3 right_of(const Screen& screen) { return glm::normalize(screen.lower_right - screen.lower_left); }

dvec3 up_of(const Screen& screen) { return glm::cross(screen.normal(), right_of(screen)); }

// Rectangle around the tiles of one plane, with the orientation of the first tile.
Screen around(const std::vector<Screen>& tiles) {
  const Screen& first = tiles.front();
  if (tiles.size() == 1) return first;
  const dvec3 right = right_of(first), up = up_of(first);
  glm::dvec2 least(0.0), most(0.0);
  for (const Screen& tile : tiles) {
    for (const dvec3& corner : {tile.lower_left, tile.lower_right, tile.upper_left}) {
      const dvec3 from_first = corner - first.lower_left;
      const glm::dvec2 place(glm::dot(from_first, right), glm::dot(from_first, up));
      least = glm::min(least, place);
      most = glm::max(most, place);
    }
  }
  const auto corner = [&](double x, double y) { return first.lower_left + x * right + y * up; };
  return {.name = "all screens",
          .lower_left = corner(least.x, least.y),
          .lower_right = corner(most.x, least.y),
          .upper_left = corner(least.x, most.y)};
}

// Planes of a wall, each as one screen, in the order of the file.
std::vector<Screen> planes_of(const scene::Wall& wall) {
  std::vector<std::vector<Screen>> planes;
  for (const Screen& screen : wall.screens) {
    const auto same = std::find_if(planes.begin(), planes.end(),
                                   [&](const auto& tiles) { return scene::in_one_plane(tiles.front(), screen); });
    if (same == planes.end()) {
      planes.push_back({screen});
    } else {
      same->push_back(screen);
    }
  }
  std::vector<Screen> screens;
  screens.reserve(planes.size());
  for (const auto& tiles : planes) screens.push_back(around(tiles));
  if (screens.size() > 1) {
    for (std::size_t i = 0; i < screens.size(); ++i) {
      if (planes[i].size() > 1) screens[i].name = "the tiles around " + planes[i].front().name;
    }
  }
  return screens;
}

double facing(const Screen& screen, const scene::HeadPose& head) {
  return -glm::dot(head.room_from_head * dvec3(0.0, 0.0, -1.0), screen.normal());
}

double area(const Screen& screen) { return screen.width_m() * screen.height_m(); }

// The largest of the screens faced most directly; the first among equals.
const Screen& faced(const std::vector<Screen>& screens, const scene::HeadPose& head) {
  return *std::max_element(screens.begin(), screens.end(), [&](const Screen& a, const Screen& b) {
    const double difference = facing(b, head) - facing(a, head);
    return std::abs(difference) > kFacingTie ? difference > 0.0 : area(a) < 0.999 * area(b);
  });
}

// True if `side` continues the main screen at its edge: upright too, wide enough, and in front of the viewer.
bool goes_on(const Screen& side, const dvec3& side_corner, const dvec3& main_corner, const Screen& main,
             const dvec3& head_m) {
  return glm::distance(side_corner, main_corner) < kCorner * main.width_m() &&
         glm::dot(up_of(side), up_of(main)) > 0.99 && side.width_m() > kNarrowest * main.width_m() &&
         glm::dot(head_m - side.lower_left, side.normal()) > 0.0;
}

}  // namespace

StagePlace stage_place(const scene::Wall& wall) {
  const std::vector<Screen> screens = planes_of(wall);
  const scene::Viewer& viewer = wall.viewers.front();
  const scene::HeadPose& head = viewer.sweet_spot;
  StagePlace stage{.main = faced(screens, head), .viewer_m = head.position_m, .ipd_m = viewer.ipd_m};
  for (const Screen& side : screens) {
    if (scene::in_one_plane(side, stage.main)) continue;
    if (goes_on(side, side.lower_right, stage.main.lower_left, stage.main, head.position_m)) stage.left = side;
    if (goes_on(side, side.lower_left, stage.main.lower_right, stage.main, head.position_m)) stage.right = side;
  }
  return stage;
}

}  // namespace afm::exhibit
