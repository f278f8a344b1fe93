// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bytes/zip_archive.h"
#include "curves/curve_file.h"
#include "formats/jpk_properties.h"

namespace afm::curves {

// One segment of a JPK curve: a folder of an archive with properties, and a raw file of big-endian numbers for each
// channel, or a rule that makes them. An encoder converts integers to volts and a chain of linear conversions these to
// metres and newtons.
// Throws CurveError.
class JpkSegment {
 public:
  // The archive must outlive the object.
  JpkSegment(const ZipArchive& archive, std::string folder, JpkProperties properties);

  const JpkProperties& properties() const { return properties_; }

  // Kind of the segment: "extend", "retract", "pause" or another.
  std::string style() const;

  // Number of points of the deflection; 0 if it was not recorded.
  std::size_t points() const;

  bool has(std::string_view channel) const;

  // The channel's values converted to a slot: "volts", or the result of the chain of conversions.
  std::vector<double> values(std::string_view channel, const std::string& slot, const CurveReading& reading) const;

  // Height by its sensor, otherwise by a piezo, at last by the stage of a CellHesion or any other channel that is
  // called a height.
  std::vector<double> heights(const CurveReading& reading) const;

  // Factor of a conversion of the deflection, if it is defined: the lever's calibration.
  std::optional<double> calibration(const std::string& slot) const;

 private:
  struct Linear {
    double offset = 0;
    double multiplier = 1;
    double operator()(double value) const { return multiplier * value + offset; }
  };

  // Storage of a channel's numbers: their encoder's type and its properties, or the type of data without one.
  struct Storage {
    std::string type, encoder;
  };

  Linear linear_at(const std::string& prefix) const;
  std::string type_of(std::string_view channel) const;
  std::optional<Storage> storage_of(std::string_view channel) const;
  // Numbers of a channel, mostly volts, before the conversions; computed for a channel that a rule defines.
  std::vector<double> recorded(std::string_view channel) const;
  std::vector<double> computed(std::string_view channel, std::string_view type) const;
  std::string data_file(std::string_view channel) const;
  std::string base_slot(const std::string& prefix) const;
  // The usual conversion of a channel, or, where it is not defined, the one that the file itself shows by default.
  std::string slot_of(std::string_view channel, const char* usual) const;
  // The chain from the slot back to the base. A given calibration replaces the file's.
  std::vector<Linear> conversions(const std::string& prefix, const std::string& base, std::string slot,
                                  const CurveReading& reading) const;
  std::string uncalibrated(const std::string& prefix, const std::string& slot, const CurveReading& reading) const;

  const ZipArchive& archive_;
  std::string folder_;
  JpkProperties properties_;
};

}  // namespace afm::curves
