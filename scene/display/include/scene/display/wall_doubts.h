// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/display/wall.h"

namespace afm::scene {

// Signs of a mistake in a readable wall: other units, a room whose z points up, a picture that
// is upside down, a head that faces no screen, a screen without an output, a projector that stays half dark. Each is
// one line that names the screen, viewer or output and the change that would help. Empty for a usual wall. Limits: a
// wall in feet whose origin is its own centre looks like a large one in metres.
std::vector<std::string> doubts_of(const Wall& wall);

// The doubts, after a line for everything in the file that the program does not use.
std::vector<std::string> notes_of(const Wall& wall);

// A length that no screen and no viewer's distance can have in metres, with the unit that would fit.
struct ImpossibleLength {
  bool of_viewer = false;  // a viewer's distance; otherwise a screen's edge
  std::size_t index = 0;   // index into Wall::viewers or Wall::screens
  std::string what;
};
std::optional<ImpossibleLength> impossible_length(const Wall& wall);

}  // namespace afm::scene
