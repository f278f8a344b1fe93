// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/display/wall.h"

namespace afm::scene {

// Lengths that reveal a wrong unit, for one viewer.
struct WallLengths {
  double extent_m = 0;       // largest distance between corners of all screens
  double distance_m = 0;     // distance from the head to the plane of the nearest screen; negative behind one
  double head_height_m = 0;  // height above the room's floor; 0 if unknown: screens below y = 0
};
WallLengths lengths_of(const Wall& wall, const Viewer& viewer);

// True if the viewer is so far away that the picture would fill less than three degrees.
bool too_far(const WallLengths& lengths);
// True if the head is higher than the eyes of a standing person on any usual platform.
bool too_high(const WallLengths& lengths);

// Smallest distance of a head from an upright screen, in widths of the screen.
constexpr double kLeastWidths = 0.1;

// Units in which the wall or the viewer's place may have been written, the likeliest first, such as "lengths are in
// metres: as millimetres, ..."; empty if none fits.
std::string unit_that_fits(const Wall& wall, const Viewer& viewer);

// Another screen of the wall beside which this one is so large that only its own corners can be in another unit;
// nullptr if there is none.
const Screen* screen_in_metres(const Wall& wall, const Screen& too_large);
// Names the unit of the corners of that one screen, as `unit_that_fits` does; empty if none fits.
std::string unit_of_one_screen(const Screen& too_large, const Screen& in_metres);

}  // namespace afm::scene
