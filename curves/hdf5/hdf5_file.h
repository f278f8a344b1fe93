// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "curves/recorded_curve.h"

namespace afm::curves {

// afmformats' .h5: one group per curve, "0", "1" and so on, with the metadata as attributes and one data set per
// column.

// One curve in group "0". Throws std::runtime_error.
std::string hdf5_bytes(const RecordedCurve& curve);

// Reads the curve of group `index`. Rejects data in other files. HDF5 may crash on a damaged file. Throws CurveError.
RecordedCurve read_hdf5(std::string_view bytes, std::size_t index);

}  // namespace afm::curves
