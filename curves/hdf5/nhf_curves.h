// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "curves/curve_file.h"
#include "curves/recorded_curve.h"
#include "hdf5_handles.h"
#include "nhf_reading.h"

namespace afm::curves {

// Spectroscopy of Nanosurf Studio (.nhf): in the group of a measurement a group for each part of the cycle, the first
// "Advance" and the first "Retract", whose channels "Position Z" and "Deflection" have all curves one after the other.
// Deflection is in volts, metres or newtons, the lever's constants are attributes of the measurement. A grid is
// recorded line by line from the bottom, there and back. Throws CurveError.
class NhfCurves {
 public:
  explicit NhfCurves(std::string_view bytes);

  // Number of curves.
  std::size_t size() const { return approach_.curves.size(); }

  // Curve of an index, counted from 0. A calibration of `reading` is used where the file has none.
  RecordedCurve curve(std::size_t index, const CurveReading& reading) const;

 private:
  struct Channel {
    Handle data{H5I_INVALID_HID};
    NhfCalibration calibration;
  };
  // Points of one curve in a channel.
  struct Extent {
    std::size_t first = 0, count = 0;
  };
  // A part of the cycle.
  struct Segment {
    Channel height, force;
    std::vector<Extent> curves;
  };
  // Part of the cycle that is not read.
  struct Rest {
    std::string name;
    const char* when = nullptr;
    std::vector<Extent> curves;
  };

  Segment segment_of(hid_t group) const;
  std::vector<Extent> extents_in(hid_t group) const;
  std::vector<double> values_of(const Channel& channel, const Extent& extent) const;
  void add_branch(const Segment& segment, physics::Branch branch, std::size_t index, const CurveReading& reading,
                  RecordedCurve& curve) const;
  double newton_per_unit(const std::string& unit, const CurveReading& reading, CurveMetadata& metadata) const;

  Handle file_;
  double version_;
  NhfGrid grid_;
  std::optional<double> spring_n_per_m_, sensitivity_m_per_v_;
  Segment approach_, retract_;
  std::vector<Rest> rests_;
};

}  // namespace afm::curves
