// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bytes/ardf_sections.h"
#include "curves/curve_file.h"
#include "curves/recorded_curve.h"

namespace afm::curves {

// The force map of an .ardf of Asylum Research: of its volumes the first, which of a fast map is the trace. A curve has
// an array of floats for each channel, of which "Defl" (metres, or volts) and "ZSnsr", otherwise "Raw" (metres, towards
// the sample), are read, with the calibration of the file's note. The names of the segments say which parts are
// approach and retract; a curve without segments turns in the middle. Lines count from the bottom, points from the
// left; those that were not measured are missing. Of a file that is cut short those are read that are whole. Throws
// CurveError.
class ArdfCurves {
 public:
  // The bytes must outlive the object.
  explicit ArdfCurves(std::string_view bytes);
  ArdfCurves(const ArdfCurves&) = delete;
  ArdfCurves& operator=(const ArdfCurves&) = delete;

  // Number of curves that were measured; of a file that is cut short, those that are there and one more.
  std::size_t size() const { return sets_.size() + (is_cut_ ? 1 : 0); }

  // Curve of an index below size(). Throws also for a file without a calibration that `reading` lacks too.
  RecordedCurve curve(std::size_t index, const CurveReading& reading) const;

 private:
  struct Channel {
    std::string name, unit;  // name, and SI unit of the values
    double factor = 1.0;     // factor to the unit
  };
  // Curve of a place of the grid.
  struct Set {
    std::size_t offset = 0;
    std::uint64_t line = 0, point = 0;
  };
  struct Array;
  struct Walk;

  void read_note(const ArdfTable& contents);
  void read_volume(std::uint64_t offset);
  std::uint64_t read_channels(std::uint64_t offset);
  void find_sets(const ArdfTable& lines);
  void find_line(std::uint64_t line, std::uint64_t first, Walk& walk);
  bool is_cut(const Set& set) const;
  void leave_out_cut_set();
  std::size_t channel(std::string_view name) const;
  Array array_of(const Set& set, std::size_t channel) const;
  double newton_per_unit(const Channel& deflection, const CurveReading& reading, CurveMetadata& metadata) const;

  std::string_view bytes_;
  std::string_view note_;
  std::vector<Channel> channels_;
  std::vector<std::string> segments_;  // names of the segments; fewer than two: the curve turns in the middle
  std::uint64_t columns_ = 0, rows_ = 0;
  double step_x_m_ = 0, step_y_m_ = 0;  // distances of points and lines; 0: unknown
  std::size_t volumes_ = 0;
  std::vector<Set> sets_;  // curves by line and point
  bool is_cut_ = false;    // true: the file is cut short, and other curves are missing
};

}  // namespace afm::curves
