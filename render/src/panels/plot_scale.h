// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

// The arithmetic of plots, apart from any drawing.
namespace afm::render {

// Distance of axis ticks: 1, 2 or 5 times a power of ten, at most `most` ticks in `range` (> 0).
double tick_step(double range, int most);

// A tick's number with as many decimals as `step` needs, a typographic minus and the language's decimal mark.
std::string tick_text(double value, double step, char decimal_mark = '.');

// Leaves a line that looks the same at this resolution: of every column of `column_mm` its first, lowest, highest and
// last point, in their order. Points are in millimetres of the canvas, and need not advance in x.
void thin_out(std::vector<glm::vec2>& points, float column_mm);

}  // namespace afm::render
