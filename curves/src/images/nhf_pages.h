// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "images/image_pages.h"

namespace afm::curves {

// Prefix of a converted image's metadata with the reason why a channel is missing.
inline constexpr std::string_view kUnreadPrefix = "Not read: ";

// Returns whether a file is HDF5 of Nanosurf Studio (.nhf), whose root has the version of the format.
bool is_nhf(std::string_view bytes);

// Returns whether such a file begins with an image: without one, it has spectroscopy.
bool begins_as_nhf(std::string_view bytes);

// The file's image as .gwy, made by the program touchafm-hdf5 in a confined process. Throws CurveError.
std::string nhf_as_gwy(std::string_view bytes);

// Pages of that .gwy, and the channels that it lacks.
ImagePages read_nhf_pages(std::string_view gwy);

}  // namespace afm::curves
