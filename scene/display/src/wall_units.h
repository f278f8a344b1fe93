// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/display/wall.h"

namespace afm::scene {

// The lengths by which a unit is doubted, for one viewer.
struct WallLengths {
  double extent_m = 0;       // between the farthest corners of all screens
  double distance_m = 0;     // from the head to the nearest screen's plane; negative behind one
  double head_height_m = 0;  // above the room's floor; 0 if the screens reach below y = 0 and the floor is unknown
};
WallLengths lengths_of(const Wall& wall, const Viewer& viewer);

// Farther than any viewer of a wall of that size: the picture would fill less than three degrees.
bool too_far(const WallLengths& lengths);
// Higher than the eyes of a standing person on any usual platform.
bool too_high(const WallLengths& lengths);

// Least distance of a head from an upright screen, in widths of the screen.
constexpr double kLeastWidths = 0.1;

// Names the units in which the wall or the viewer's place may be written, the likeliest first, such as "lengths are in
// metres: as millimetres, ..."; empty if none fits.
std::string unit_that_fits(const Wall& wall, const Viewer& viewer);

// Another screen of the wall beside which this one is so large that only its own corners can be in another unit;
// nullptr if there is none.
const Screen* screen_in_metres(const Wall& wall, const Screen& too_large);
// Names the unit of the corners of that one screen, as `unit_that_fits` does; empty if none fits.
std::string unit_of_one_screen(const Screen& too_large, const Screen& in_metres);

}  // namespace afm::scene
