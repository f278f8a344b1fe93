// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "curves/curve_file.h"
#include "curves/recorded_curve.h"
#include "hdf5_handles.h"

namespace afm::curves {

// afmformats' .h5: one group per curve, "0", "1" and so on, with the metadata as attributes and one data set per
// column.

// A file with the curves in groups "0", "1" and so on, and the parameters of the first. The same curves give the same
// bytes. Throws std::runtime_error.
std::string hdf5_bytes(std::span<const RecordedCurve> curves);

// A file in memory. Rejects data in other files. HDF5 may crash on a damaged file. Throws CurveError.
class Hdf5Curves {
 public:
  explicit Hdf5Curves(std::string_view bytes);

  // Number of the groups "0", "1" and so on, at most a million.
  std::size_t size() const;

  // The curve of group `index`; forces are in newtons.
  RecordedCurve curve(std::size_t index, const CurveReading& reading) const;

 private:
  Handle file_;
};

}  // namespace afm::curves
