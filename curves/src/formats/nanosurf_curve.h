// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "bytes/nanosurf_header.h"
#include "curves/curve_file.h"
#include "curves/recorded_curve.h"

namespace afm::curves {

// Curves of Nanosurf's spectroscopy (.nid): the groups "Spec forward", the approach, and "Spec backward", the retract,
// with a curve on each line of their channels, of which LineDimNPoints points were recorded. The force is the channel
// "Deflection" in newtons, metres or volts, the height "Z-Axis Sensor", otherwise "Z-Axis". A map (Map0 = x0; x1; y0;
// y1; columns; rows; ...) is recorded line by line, there and back. Of a file that is cut short those curves are read
// that are whole. Throws CurveError.
class NanosurfCurves {
 public:
  // The bytes must outlive the object.
  explicit NanosurfCurves(std::string_view bytes);
  NanosurfCurves(const NanosurfCurves&) = delete;
  NanosurfCurves& operator=(const NanosurfCurves&) = delete;

  // Number of curves.
  std::size_t size() const { return count_; }

  // Curve of an index below size(). Throws also for a file without a calibration that `reading` lacks too.
  RecordedCurve curve(std::size_t index, const CurveReading& reading) const;

 private:
  // Channels of one direction; null: none.
  struct Direction {
    const NanosurfChannel* force = nullptr;
    const NanosurfChannel* height = nullptr;
  };
  // Grid whose first curve is at a corner.
  struct Map {
    MapGrid grid;
    bool from_right = false, from_top = false, turned = false;
  };

  Direction direction_of(std::string_view group) const;
  std::size_t whole_curves() const;
  std::optional<Map> map_of() const;
  double newton_per_unit(const NanosurfSection& force, const CurveReading& reading, CurveMetadata& metadata) const;
  void add_branch(const Direction& from, physics::Branch branch, std::size_t index, double newton,
                  RecordedCurve& curve) const;
  void place(std::size_t index, CurveMetadata& metadata) const;

  NanosurfFile file_;
  Direction approach_, retract_;
  std::size_t count_ = 0, whole_ = 0;  // number of complete curves, all unless the file is cut short
  std::optional<Map> map_;
};

}  // namespace afm::curves
