// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "curves/curve_file.h"

namespace afm::curves {

struct ConversionOptions {
  CurveReading reading;              // settings of the reading, whose `index` is not used
  std::optional<std::size_t> index;  // index of a curve in a file with several; empty: all of them
  std::string channel;               // channel to convert to a .gsf; empty: the height
};

struct Converted {
  std::string bytes;                 // contents of the new file
  std::string contents;              // description of the contents, "1 curve of 4000 points"
  std::vector<std::string> remarks;  // remarks on losses, turns and rounding, one sentence each
};

// All endings of a converted file, for help and error messages.
inline constexpr const char* kConvertedFiles =
    "curves: .tab, .h5 or, for AFM Workshop and Gwyddion, .csv; images: .gwy or .gsf";

// Largest number of points of all curves together: they are converted in memory.
inline constexpr std::size_t kMostConvertedPoints = 8'000'000;

// Converts a file of curves or an image into the format whose ending `name` has, with all metadata that both support.
// One curve is read back and compared, so that a remark gives what the format rounds. WrongUsage if the format does not
// hold what the file has, or an option is for another kind of file; BadInputFile if it cannot be read. One of several
// curves that cannot be read is left out, with a remark. Any thread but the servo's.
core::Result<Converted> converted(const std::string& file, const std::string& name, const ConversionOptions& options);

}  // namespace afm::curves
