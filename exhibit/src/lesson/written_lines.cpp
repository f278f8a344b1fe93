// SPDX-License-Identifier: Apache-2.0
#include "written_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/check.h"
#include "exhibit/models/marks_relief.h"
#include "physics/manipulation/ink.h"
#include "physics/manipulation/marked_surface.h"
#include "physics/quantity_text.h"
#include "scene/samples/ink_run.h"
#include "scene/samples/particle_set.h"

namespace afm::exhibit {

namespace {

using glm::dvec2;

constexpr double kMarkM = 1e-10;     // smallest depth of a mark
constexpr double kInkM = 1e-9;       // depth of a groove as which ink counts
constexpr double kFromEnds = 1.0;    // distance from a measured place to the ends of its part, in widths
constexpr double kFromOthers = 2.0;  // distance to another part, in widths
constexpr double kWithin = 0.5;      // largest distance from a place of a line to a mark, in widths
constexpr double kFollowed = 2.0;    // distance to which a groove is followed on either side, in widths

struct LinePart {
  std::size_t line;
  dvec2 from_m, to_m;
};
std::vector<LinePart> parts_of(const LinesToWrite& lines) {
  std::vector<LinePart> parts;
  for (std::size_t line = 0; line < lines.lines_m.size(); ++line) {
    const auto& corners_m = lines.lines_m[line];
    for (std::size_t i = 0; i + 1 < corners_m.size(); ++i) parts.push_back({line, corners_m[i], corners_m[i + 1]});
  }
  return parts;
}

double distance_m(const dvec2& place_m, const LinePart& part) {
  const dvec2 way_m = part.to_m - part.from_m;
  const double share = std::clamp(glm::dot(place_m - part.from_m, way_m) / glm::dot(way_m, way_m), 0.0, 1.0);
  return glm::distance(place_m, part.from_m + share * way_m);
}

double distance_m(const dvec2& place_m, const std::vector<LinePart>& parts) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const LinePart& part : parts) least_m = std::min(least_m, distance_m(place_m, part));
  return least_m;
}

// Place on a line, with a flag for a measurable groove.
struct LinePlace {
  std::size_t line;
  dvec2 place_m, across;
  bool measured;
};
std::vector<LinePlace> line_places(const LinesToWrite& lines, double spacing_m) {
  const std::vector<LinePart> parts = parts_of(lines);
  std::vector<LinePlace> places;
  for (std::size_t number = 0; number < parts.size(); ++number) {
    const LinePart& part = parts[number];
    const double length_m = glm::distance(part.from_m, part.to_m);
    const dvec2 along = (part.to_m - part.from_m) / length_m;
    const int steps = std::max(1, static_cast<int>(std::ceil(length_m / spacing_m)));
    for (int i = 0; i <= steps; ++i) {
      const double way_m = length_m * i / steps, from_ends_m = std::min(way_m, length_m - way_m);
      const dvec2 place_m = part.from_m + way_m * along;
      bool measured = from_ends_m >= kFromEnds * lines.width_m;
      for (std::size_t other = 0; other < parts.size(); ++other) {
        if (other != number) measured = measured && distance_m(place_m, parts[other]) >= kFromOthers * lines.width_m;
      }
      places.push_back({part.line, place_m, {-along.y, along.x}, measured});
    }
  }
  return places;
}

// Heights of a sample without load, on its squares and between their middles. Ink counts as a groove of kInkM, beside
// which the bare sample is as high, so that its edge lies halfway between a covered square and a bare one.
class MarkHeights {
 public:
  MarkHeights(std::span<const scene::MarkTile> tiles, const MarkGrid& grid) : tiles_(tiles), grid_(grid) {}

  double spacing_m() const { return grid_.spacing_m; }
  dvec2 middle_m(std::size_t column, std::size_t row) const {
    return {grid_.first_m.x + static_cast<double>(column) * grid_.spacing_m,
            grid_.first_m.y + static_cast<double>(row) * grid_.spacing_m};
  }
  bool is_marked(std::size_t column, std::size_t row) const { return height_m(column, row) <= -kMarkM; }

  double at(const dvec2& place_m) const {
    const dvec2 squares = glm::clamp((place_m - grid_.first_m) / grid_.spacing_m, 0.0, scene::kSoftSide - 1.001);
    const auto column = static_cast<std::size_t>(squares.x), row = static_cast<std::size_t>(squares.y);
    const dvec2 share = squares - glm::floor(squares);
    return glm::mix(glm::mix(height_m(column, row), height_m(column + 1, row), share.x),
                    glm::mix(height_m(column, row + 1), height_m(column + 1, row + 1), share.x), share.y);
  }

  // True if a mark has its middle within that distance of the place.
  bool has_mark_near(const dvec2& place_m, double within_m) const {
    const auto first = [&](double at_m, double first_m) {
      return static_cast<std::size_t>(std::max(0.0, std::ceil((at_m - within_m - first_m) / grid_.spacing_m)));
    };
    for (std::size_t row = first(place_m.y, grid_.first_m.y); row < scene::kSoftSide; ++row) {
      if (middle_m(0, row).y > place_m.y + within_m) break;
      for (std::size_t column = first(place_m.x, grid_.first_m.x); column < scene::kSoftSide; ++column) {
        const dvec2 at_m = middle_m(column, row);
        if (at_m.x > place_m.x + within_m) break;
        if (glm::distance(at_m, place_m) <= within_m && is_marked(column, row)) return true;
      }
    }
    return false;
  }

 private:
  double height_m(std::size_t column, std::size_t row) const {
    const double height_m = mark_height_m(tiles_, column, row);
    if (grid_.layer_m == 0.0) return height_m;
    return height_m != 0.0 ? -kInkM : kInkM;
  }

  std::span<const scene::MarkTile> tiles_;
  MarkGrid grid_;
};

// Groove across a line: the offset of its middle, and its width.
struct Groove {
  double middle_m, width_m;
};

// Groove whose middle is nearest to the place, within a width of it; empty if there is none.
std::optional<Groove> groove_at(const MarkHeights& heights, const LinePlace& place, double width_m) {
  const double step_m = 0.5 * heights.spacing_m();
  const int most = static_cast<int>(std::ceil(kFollowed * width_m / step_m));
  std::optional<Groove> nearest;
  double before_m = 0.0, begin_m = 0.0, lowest_m = 0.0;
  bool inside = false;
  const auto height_m = [&](int i) { return heights.at(place.place_m + step_m * i * place.across); };
  for (int i = -most; i <= most + 1; ++i) {
    const double now_m = i <= most ? height_m(i) : 0.0;  // end of the groove, at the latest
    const double zero_m = step_m * (i - (now_m == before_m ? 0.0 : now_m / (now_m - before_m)));
    if (!inside) lowest_m = 0.0;
    lowest_m = std::min(lowest_m, now_m);
    if (!inside && now_m < 0.0) begin_m = i == -most ? step_m * i : zero_m;
    if (inside && now_m >= 0.0) {
      const Groove groove{0.5 * (begin_m + zero_m), zero_m - begin_m};
      const bool near = lowest_m <= -kMarkM && std::abs(groove.middle_m) <= width_m;
      if (near && (!nearest || std::abs(groove.middle_m) < std::abs(nearest->middle_m))) nearest = groove;
    }
    inside = now_m < 0.0;
    before_m = now_m;
  }
  return nearest;
}

}  // namespace

std::string length_words(double length_m) {
  return physics::format_quantity(physics::Length(length_m), physics::kLengthUnits, 3);
}

MarkGrid mark_grid(const scene::ParticleSet& set) {
  if (set.ink) {
    const physics::Ink& ink = set.ink->ink;
    const physics::Length reach(scene::ink_reach_m(ink)), spacing(scene::ink_side_m(ink) / scene::kSoftSide);
    const physics::InkedSurface surface(ink, {-reach, -reach}, {reach, reach}, physics::Length(0.0), spacing);
    const auto first = surface.middle_of_first();
    return {.spacing_m = spacing.si, .first_m = {first.x.si, first.y.si}, .layer_m = set.ink->thickness.si};
  }
  const double radius_m = set.setup.tip.radius.si, spacing_m = radius_m / physics::MarkedSurface::kSquaresPerRadius;
  const double first_m = -scene::soft_reach_m(radius_m) - (physics::MarkedSurface::kReach + 1) * spacing_m;
  return {.spacing_m = spacing_m, .first_m = dvec2(first_m)};
}

bool can_be_measured(const LinesToWrite& lines, std::size_t line, const MarkGrid& grid) {
  const auto places = line_places(lines, grid.spacing_m);
  return std::any_of(places.begin(), places.end(),
                     [&](const LinePlace& place) { return place.line == line && place.measured; });
}

WrittenLines written_lines(std::span<const scene::MarkTile> tiles, const MarkGrid& grid, const LinesToWrite& lines) {
  AFM_CHECK(tiles.size() == scene::kMarkTiles);
  const MarkHeights heights(tiles, grid);
  const std::vector<LinePlace> places = line_places(lines, heights.spacing_m());
  WrittenLines written;
  std::size_t count = 0, grooves = 0;
  double widths_m = 0.0, off_m2 = 0.0;
  for (const LinePlace& place : places) {
    if (heights.has_mark_near(place.place_m, kWithin * lines.width_m)) ++count;
    const auto groove = place.measured ? groove_at(heights, place, lines.width_m) : std::nullopt;
    if (!groove) continue;
    ++grooves;
    widths_m += groove->width_m;
    off_m2 += groove->middle_m * groove->middle_m;
  }
  written.share = static_cast<double>(count) / static_cast<double>(places.size());
  if (grooves > 0) {
    written.width_m = widths_m / static_cast<double>(grooves);
    written.off_m = std::sqrt(off_m2 / static_cast<double>(grooves));
  }
  const std::vector<LinePart> parts = parts_of(lines);
  const double far_m = kOutsideWidths * lines.width_m;
  for (std::size_t row = 0; row < scene::kSoftSide; ++row) {
    for (std::size_t column = 0; column < scene::kSoftSide; ++column) {
      if (!heights.is_marked(column, row) || distance_m(heights.middle_m(column, row), parts) <= far_m) continue;
      written.outside_m2 += heights.spacing_m() * heights.spacing_m();
    }
  }
  return written;
}

std::optional<WritingFault> fault_of(const WrittenLines& written, const LinesToWrite& lines) {
  if (written.outside_m2 > 0.0) return WritingFault::MarksOutside;
  if (written.width_m > (1.0 + kWidthTolerance) * lines.width_m) return WritingFault::TooWide;
  if (written.width_m > 0.0 && written.width_m < (1.0 - kWidthTolerance) * lines.width_m) {
    return WritingFault::TooNarrow;
  }
  const bool done = written.share >= 1.0 && written.width_m > 0.0;
  return done ? std::nullopt : std::optional(WritingFault::LinesLeft);
}

}  // namespace afm::exhibit
