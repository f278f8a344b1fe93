// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "panels/canvas.h"

namespace afm::render {

struct Ink {
  TextStyle style;
  Color color;
  float smallest = 0.55F;  // fraction of the style's size below which text is cut instead
};

// Draws left-aligned text, reduced if it would be wider than `room_mm`, so that no word is cut. Text that would be too
// small to read ends in an ellipsis instead.
void shrunk_text(Canvas& canvas, glm::vec2 position, const Ink& ink, std::string_view text, float room_mm,
                 float scale = 1.0F);

// Draws a panel's title with the top of its line at `position`: on one line, or on two of 0.6 times the size, within
// the same height, if one would be smaller than that. `room_mm` is the width; `scale` reduces the style's size. A title
// too long for two lines ends in an ellipsis.
void paint_title(Canvas& canvas, glm::vec2 position, std::string_view title, float room_mm, float scale = 1.0F);

}  // namespace afm::render
