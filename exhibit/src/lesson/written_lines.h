// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>

#include "exhibit/state/lines_to_write.h"
#include "scene/shared/soft_blocks.h"

namespace afm::scene {
struct ParticleSet;
}

namespace afm::exhibit {

// Squares of marks, kSoftSide by kSoftSide of them. A mark is a square of a soft sample at least 0.1 nm below the level
// sample, without load, or a square that ink covers.
struct MarkGrid {
  double spacing_m = 0;
  glm::dvec2 first_m{0.0};  // middle of the square with the least x and y
  double layer_m = 0;       // thickness of the ink; 0: a soft sample
};

// `set` has a soft sample or ink.
MarkGrid mark_grid(const scene::ParticleSet& set);

// Comparison of the marks on a sample with the lines to write.
struct WrittenLines {
  double share = 0;       // fraction of the lines with a mark within half a width, 0 to 1
  double width_m = 0;     // mean width of groove or ink along the lines; 0: none
  double off_m = 0;       // root mean square distance of its middle from the lines
  double outside_m2 = 0;  // area of marks farther than kOutsideWidths from the lines
};

inline constexpr double kOutsideWidths = 2.0;
inline constexpr double kWidthTolerance = 0.2;  // relative to the wanted width

// Fault that keeps lines from being done.
enum class WritingFault { MarksOutside, TooNarrow, TooWide, LinesLeft };

// A length as text, such as "20 nm".
std::string length_words(double length_m);

// True if a line has a place at which its width can be measured: a width or more from the ends of its straight part,
// and two from every other part. `line` is its index in `lines`.
bool can_be_measured(const LinesToWrite& lines, std::size_t line, const MarkGrid& grid);

// `tiles` are the kMarkTiles tiles of that grid; each line can be measured.
WrittenLines written_lines(std::span<const scene::MarkTile> tiles, const MarkGrid& grid, const LinesToWrite& lines);

// First fault in the order of the enumerators; empty if the lines are done.
std::optional<WritingFault> fault_of(const WrittenLines& written, const LinesToWrite& lines);

}  // namespace afm::exhibit
