// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "curves/recorded_curve.h"

namespace afm::curves {

// afmformats' .h5: a group a curve, "0", "1" and so on, with the metadata as attributes and a data set a column.

// One curve in group "0". Throws std::runtime_error.
std::string hdf5_bytes(const RecordedCurve& curve);

// The curve of group `index`. What lies in other files is refused. Damaged files crash
// HDF5. Throws CurveError.
RecordedCurve read_hdf5(std::string_view bytes, std::size_t index);

}  // namespace afm::curves
