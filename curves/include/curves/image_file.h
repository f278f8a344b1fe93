// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "physics/imaging/scan_image.h"

// Reading of the images that AFM programs write; docs/manual.md, "Bring your own surface", says what each format holds.
namespace afm::curves {

enum class ImageFormat {
  Gsf,        // Gwyddion's simple field, .gsf
  Gwy,        // Gwyddion's own, .gwy
  Nanoscope,  // Bruker, .spm, .001
  Igor,       // Asylum Research, .ibw
  Jpk         // JPK, .jpk
};

// All of them, as help and refusals list them.
inline constexpr const char* kImageFiles = "Gwyddion .gwy or .gsf, Nanoscope .spm or .001, Igor .ibw, JPK .jpk";

// "Nanoscope", as a sentence names it.
std::string_view name_of(ImageFormat format);

// Whether the first bytes of a regular file are those of an image.
bool is_image_file(const std::string& path);

struct ImageReading {
  std::string channel;   // name in upper or lower case; empty: the first height channel, trace before retrace
  bool confined = true;  // reads in a process that can open nothing; false: in this process, visible to a fuzzer
};

// An image as the file has it: nothing is levelled, and a number that is not finite is a NaN.
struct LoadedImage {
  ImageFormat format = ImageFormat::Gsf;
  physics::ScanImage image;           // all channels on the grid of the selected one
  std::size_t chosen = 0;             // index of the channel that was asked for
  std::vector<std::string> left_out;  // channels on other grids, by name
};

// BadInputFile, in one line that names the file, for whatever is not wholly understood: truncated, altered, larger than
// 256 MiB or 8192 points a side, of another kind, without the channel. Takes at most 1 GiB.
core::Result<LoadedImage> load_image(const std::string& path, const ImageReading& reading = {});

// The same for the bytes of a file called `name`.
core::Result<LoadedImage> parse_image(std::string_view bytes, const std::string& name,
                                      const ImageReading& reading = {});

}  // namespace afm::curves
