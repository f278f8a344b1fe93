// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "physics/imaging/scan_image.h"

// Reading of image files of AFM programs. docs/manual/measure.md, "Bring your own surface", describes the contents of
// each format.
namespace afm::curves {

enum class ImageFormat {
  Gsf,        // Gwyddion's simple field, .gsf
  Gwy,        // Gwyddion's own, .gwy
  Nanoscope,  // Bruker, .spm, .001
  Igor,       // Asylum Research, .ibw
  Nanosurf,   // Nanosurf, .nid
  Nhf,        // Nanosurf Studio, .nhf
  Park,       // Park Systems, .tiff
  Jpk         // JPK, .jpk
};

// All formats, as help and refusals list them.
inline constexpr const char* kImageFiles =
    "Gwyddion .gwy or .gsf, Nanoscope .spm or .001, Igor .ibw, Nanosurf .nid or .nhf, Park .tiff, JPK .jpk";

// Name of a format for use in a sentence: "Nanoscope".
std::string_view name_of(ImageFormat format);

// Returns whether a regular file begins like an image.
bool is_image_file(const std::string& path);

// Returns whether the bytes of a file begin like an image.
bool begins_like_image(std::string_view bytes);

struct ImageReading {
  std::string channel;   // channel name in upper or lower case; empty: the first height channel, trace before retrace
  bool confined = true;  // true: reads in a process that cannot open anything; false: in this process, for a fuzzer
};

struct UnreadChannel {
  std::string name;
  std::string reason;
};

// An image as in the file, without levelling; non-finite numbers become NaN.
struct LoadedImage {
  ImageFormat format = ImageFormat::Gsf;
  physics::ScanImage image;           // image with all channels on the grid of the selected one
  std::size_t chosen = 0;             // index of the requested channel
  std::vector<std::string> left_out;  // names of channels on other grids
  std::vector<UnreadChannel> unread;  // channels that cannot be read
  std::vector<std::string> remarks;   // remarks on doubts about the header and their solutions, one sentence each
};

// BadInputFile, in one line that names the file, for any content that is not completely understood: truncated, altered,
// larger than 256 MiB or 8192 points per side, of another kind, or without the channel. Takes at most 1 GiB. A channel
// that cannot be read costs only itself, unless it is the requested one or the file is cut short.
core::Result<LoadedImage> load_image(const std::string& path, const ImageReading& reading = {});

// Reads the bytes of a file called `name`, as load_image() does.
core::Result<LoadedImage> parse_image(std::string_view bytes, const std::string& name,
                                      const ImageReading& reading = {});

}  // namespace afm::curves
