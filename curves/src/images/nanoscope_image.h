// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "images/image_pages.h"

namespace afm::curves {

inline constexpr std::string_view kNanoscopeMagic = "\\*File list";
inline constexpr std::string_view kNanoscopeElectrochemistryMagic = "\\*EC File list";

// Images of Bruker's Nanoscope (.spm, .001), with a text header up to a byte 0x1A: blocks "\*Ciao image list" with
// "\Data offset", "\Samps/line", "\@2:Z scale: V [Sens. X] (...) HARD V", and blocks with "\@Sens. X: V SOFT nm/V". A
// value is LSB * HARD / 256^(Bytes/pixel) * SOFT. From version 0x09200000 on an integer always takes 4 bytes, while the
// divisor still uses Bytes/pixel. Rows are stored from bottom to top. Throws CurveError.
ImagePages read_nanoscope(std::string_view bytes);

}  // namespace afm::curves
