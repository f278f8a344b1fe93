// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "bytes/nanoscope_header.h"
#include "curves/curve_file.h"
#include "curves/recorded_curve.h"
#include "formats/nanoscope_scan.h"

namespace afm::curves {

inline constexpr std::string_view kNanoscopeForceMagic = "\\*Force file list";

// Curves of Bruker's Nanoscope (.spm, .000, .pfc), a single ramp or a force volume: a block "\*Ciao force image list"
// per channel, whose data are, curve after curve, the extend, from the sample outwards, then the retract in the order
// of time, in integers of two or four bytes. Points that were not recorded have the lowest integer. Of two lengths in
// "\Samps/line" the first is the retract's. The heights are those of the sensor, otherwise evenly spaced over the ramp,
// in a force volume above the height of the image at the curve's pixel. Throws CurveError.
class NanoscopeCurves {
 public:
  // The bytes must outlive the object.
  explicit NanoscopeCurves(std::string_view bytes);
  NanoscopeCurves(const NanoscopeCurves&) = delete;
  NanoscopeCurves& operator=(const NanoscopeCurves&) = delete;

  // Number of curves; 1 of a single ramp.
  std::size_t size() const { return count_; }

  // Curve of an index below size(). Throws also for a file without a calibration that `reading` lacks too.
  RecordedCurve curve(std::size_t index, const CurveReading& reading) const;

 private:
  struct Lengths {
    std::size_t extend = 0, retract = 0;
    std::size_t longer() const;
  };
  struct Signal;

  static Lengths lengths_of(const NanoscopeBlock& channel);
  std::size_t integer_size(const NanoscopeBlock& channel) const;
  Signal signal(const NanoscopeBlock& channel, std::size_t index) const;
  Signal heights(std::size_t index) const;
  void place(std::size_t index, RecordedCurve& curve) const;

  std::string_view bytes_;
  std::vector<NanoscopeBlock> blocks_;
  const NanoscopeBlock* deflection_ = nullptr;
  const NanoscopeBlock* sensor_ = nullptr;  // height sensor; null: none
  Lengths lengths_;
  std::optional<NanoscopeVolume> volume_;
  std::size_t count_ = 1;
};

}  // namespace afm::curves
