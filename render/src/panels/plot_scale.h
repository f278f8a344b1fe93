// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

// Arithmetic of plots, without any drawing.
namespace afm::render {

// Distance between axis ticks: 1, 2 or 5 times a power of ten, with at most `most` ticks in `range` (> 0).
double tick_step(double range, int most);

// Text of a tick's number: as many decimals as `step` needs, a typographic minus, and the language's decimal mark.
std::string tick_text(double value, double step, char decimal_mark = '.');

// Removes points without a visible change at this resolution: keeps the first, lowest, highest and last point of every
// column of `column_mm`, in order. Points are in millimetres of the canvas, and need not advance in x.
void thin_out(std::vector<glm::vec2>& points, float column_mm);

}  // namespace afm::render
