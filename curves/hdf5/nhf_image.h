// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "physics/imaging/scan_image.h"

namespace afm::curves {

// The first image of a file of Nanosurf Studio (.nhf, versions 1.1 and 2): a group with the number of points and lines,
// in it a group for each direction, "Forward" and "Backward", with a data set for each channel, line by line from the
// bottom. Integers span the range of their type, which is that of the calibration; those that were not measured have
// the fill value (version 2), and lines that are missing at the end count as not measured. A channel that cannot be
// read is an entry of the metadata, kUnreadPrefix and its name, with the reason. HDF5 may crash on a damaged file.
// Throws CurveError.
physics::ScanImage nhf_image(std::string_view bytes);

}  // namespace afm::curves
