// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "exhibit/state/lines_to_write.h"
#include "scene/shared/soft_blocks.h"

namespace afm::exhibit {

// Comparison of the marks on a soft sample with the lines to write. A mark is a square at least 0.1 nm below
// the level sample, without load.
struct WrittenLines {
  double share = 0;       // fraction of the lines with a mark within half a width, 0 to 1
  double width_m = 0;     // mean width of the groove along the lines; 0: no groove
  double off_m = 0;       // root mean square distance of the groove's middle from the lines
  double outside_m2 = 0;  // area of marks farther than kOutsideWidths from the lines
};

inline constexpr double kOutsideWidths = 2.0;
inline constexpr double kWidthTolerance = 0.2;  // relative to the wanted width

// Fault that keeps lines from being done.
enum class WritingFault { MarksOutside, TooNarrow, TooWide, LinesLeft };

// A length as text, such as "20 nm".
std::string length_words(double length_m);

// True if a line has a place at which its groove can be measured: a width or more from the ends of its straight part,
// and two from every other part. `line` is its index in `lines`.
bool can_be_measured(const LinesToWrite& lines, std::size_t line, double tip_radius_m);

// `tiles` are the kMarkTiles tiles of a sample for a tip of that radius; each line can be measured.
WrittenLines written_lines(std::span<const scene::MarkTile> tiles, double tip_radius_m, const LinesToWrite& lines);

// First fault in the order of the enumerators; empty if the lines are done.
std::optional<WritingFault> fault_of(const WrittenLines& written, const LinesToWrite& lines);

}  // namespace afm::exhibit
