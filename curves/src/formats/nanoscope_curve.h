// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bytes/nanoscope_header.h"
#include "curves/curve_file.h"
#include "curves/recorded_curve.h"
#include "formats/nanoscope_scan.h"
#include "formats/nanoscope_swing.h"

namespace afm::curves {

inline constexpr std::string_view kNanoscopeForceMagic = "\\*Force file list";

// Curves of Bruker's Nanoscope (.spm, .000, .pfc), a single ramp or a force volume: a block "\*Ciao force image list"
// per channel, whose data are, curve after curve, the extend, from the sample outwards, then the retract in the order
// of time, then a hold (as AtomicJ found by Bruker's own reader), in integers of two or four bytes. Points that were
// not recorded have the lowest integer. Of two lengths in "\Samps/line" the first is the retract's. The heights are
// those of the sensor, otherwise evenly spaced over the ramp, in a force volume above the height of the image at the
// curve's pixel. A capture of PeakForce tapping has a period a curve (nanoscope_swing.h), which is turned so that it
// begins half a period before the deepest point; its heights are those of its channel "Height Sensor" or "Height",
// otherwise of the swing. Of a volume that is cut short the first curves are read. Throws CurveError.
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
  struct Layout {
    std::size_t size = 0;    // size of an integer in bytes
    std::size_t points = 0;  // points of a curve: both branches and a hold
  };
  struct Signal;

  void read_header();
  void find_curves(const std::vector<const NanoscopeBlock*>& channels, double length);
  void count_whole();
  std::string whole_of_all() const;
  static Lengths lengths_of(const NanoscopeBlock& channel);
  static std::size_t hold_of(const std::vector<NanoscopeBlock>& blocks);
  std::optional<Layout> layout_of(const NanoscopeBlock& channel) const;
  Layout known_layout(const NanoscopeBlock& channel) const;
  Signal signal(const NanoscopeBlock& channel, std::size_t index) const;
  Signal heights(std::size_t index) const;
  void place(std::size_t index, RecordedCurve& curve) const;

  std::string_view bytes_;
  std::vector<NanoscopeBlock> blocks_;
  const NanoscopeBlock* deflection_ = nullptr;
  const NanoscopeBlock* sensor_ = nullptr;  // channel of the height sensor; null: none
  Lengths lengths_;
  std::size_t hold_ = 0;  // points of a hold, in channels with a hold
  std::optional<NanoscopeVolume> volume_;
  std::optional<NanoscopeSwing> swing_;  // swing in PeakForce tapping without a height channel; empty: other curves
  bool is_sensed_period_ = false;        // true: PeakForce tapping with a height channel
  std::size_t count_ = 1, whole_ = 1;    // number of complete curves, all unless the file is cut short
};

}  // namespace afm::curves
