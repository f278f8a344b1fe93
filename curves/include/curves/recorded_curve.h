// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "physics/curve_analysis.h"
#include "physics/units.h"

namespace afm::curves {

// Place at which a curve was recorded, in the frame of the instrument's scanner; x is the fast axis.
struct CurvePosition {
  double x_m = 0, y_m = 0;
};

// Grid of a map of curves.
struct MapGrid {
  std::size_t columns = 0, rows = 0;      // size in pixels, 1 to kMostMapSide
  double width_m = 0, height_m = 0;       // size from edge to edge of the outer pixels; positive
  double center_x_m = 0, center_y_m = 0;  // centre in the frame of CurvePosition
  bool operator==(const MapGrid&) const = default;
};
inline constexpr std::size_t kMostMapSide = 8192;

// Place of a curve in its map. Column 0 is at the left, row 0 at the bottom.
struct MapPixel {
  MapGrid grid;
  std::size_t column = 0, row = 0;
};

// True if a file with this many curves may have a map on this grid: up to 512 x 512 pixels, most of which may lack a
// curve, or up to 16 pixels for each curve. The grid comes from the file: one curve must not take the memory of a
// million.
bool is_map_of(std::size_t curves, const MapGrid& grid);

// Pixel of a grid that is turned by `turn_rad` about its center, counterclockwise, with `reflected` rows from the top.
// Empty outside the grid.
std::optional<MapPixel> pixel_at(const CurvePosition& position, const MapGrid& grid, double turn_rad = 0,
                                 bool reflected = false);

// A file's information on how its curve was recorded; missing information is empty.
struct CurveMetadata {
  std::optional<physics::Stiffness> spring_constant;
  std::optional<double> sensitivity_m_per_v;  // deflection per volt of the optical lever ("InvOLS")
  std::optional<physics::Velocity> approach_speed;
  std::optional<physics::Velocity> retract_speed;
  std::optional<physics::Force> setpoint;
  std::string instrument;
  std::string software;
  std::string software_version;
  std::string date;      // date as YYYY-MM-DD
  std::string time;      // time as HH:MM:SS, local to the instrument
  std::string curve_id;  // identifier of the curve
  std::optional<CurvePosition> position;
  std::optional<MapPixel> pixel;
  // Inputs of a computed curve and other entries of TouchAFM's own files: keys with their units, "tip_radius_m".
  std::vector<std::pair<std::string, std::string>> parameters;
  // Remarks on what a reader left out, reversed or doubts: one sentence each, for the user.
  std::vector<std::string> remarks;
};

// One approach-retract cycle from any file or model, in one convention: SI, force positive away from the sample, height
// of the lever's base decreasing while the tip approaches (afmformats' "height (measured)"), the whole approach before
// the retract, every number finite, at most kMostCurvePoints.
struct RecordedCurve {
  std::vector<physics::CurvePoint> points;
  std::vector<double> time_s;  // time since the first point; empty if unknown
  CurveMetadata metadata;
};

// Doubt about a point that no force microscope records, beyond 1 m or 1 N or not a number: "at 20 m with 0 N is outside
// the range of a force microscope; is it in SI?". Empty for any other point.
std::string doubt_of(const physics::CurvePoint& point);

inline constexpr std::size_t kMostCurvePoints = 4'000'000;
inline constexpr std::size_t kMostRemarks = 64;

// Software name in curves that were computed, not measured.
inline constexpr const char* kComputedBy = "TouchAFM";

// A model's curve with the lever for which it was computed.
RecordedCurve recorded_curve(const physics::ForceCurve& curve, physics::Stiffness spring_constant);

// Adds a "key: value" line with unprintable characters replaced. Ignores any other text, a line of more than 2000
// characters, lines beyond 32 KiB in total, and those after the 200th.
void add_parameter(std::string_view line, CurveMetadata& metadata);

// The value of a numeric parameter; empty if it is not a number.
std::optional<double> number_of(std::string_view value);

}  // namespace afm::curves
