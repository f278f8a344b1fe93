// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bytes/nanoscope_header.h"
#include "curves/recorded_curve.h"

// The scan of a Nanoscope file: area and scale of an image, and the grid of a force volume. Throws CurveError.
namespace afm::curves {

struct NanoscopePoints {
  std::size_t columns = 0, rows = 0;
};

struct NanoscopeArea {
  double width_m = 0, height_m = 0;
};

// Gets a sentence about a doubt and its solution.
using TakeRemark = std::function<void(const std::string& sentence)>;

// The area of an image. The header of a scan that was stopped may keep the size of the whole: its lines, or an aspect
// ratio, tell which part of the height the image has.
NanoscopeArea nanoscope_area(const NanoscopeBlock& image, const std::vector<NanoscopeBlock>& blocks,
                             const NanoscopePoints& points, const TakeRemark& remark);

struct NanoscopeScale {
  double factor = 1.0;  // factor per integer over its divisor
  std::string unit;     // SI unit of the values
  std::string missing;  // named sensitivity that the header lacks; empty: none
};
NanoscopeScale nanoscope_scale(const NanoscopeBlock& image, const std::vector<NanoscopeBlock>& blocks);

// Integers of an image or a curve.
struct NanoscopeIntegers {
  std::size_t size = 2;    // bytes of an integer in the file: 1, 2 or 4; from version 9.2 on always 4
  double divisor = 65536;  // 256^(Bytes/pixel)
};
NanoscopeIntegers nanoscope_integers(const NanoscopeBlock& channel, const std::vector<NanoscopeBlock>& blocks);

double nanoscope_integer(std::string_view data, std::size_t index, std::size_t size);

// Places of the curves of a force volume: in rows from the bottom, like the points of its image, of which a curve
// may have several.
struct NanoscopeVolume {
  std::size_t columns = 0, rows = 0;  // number of curves along a side; 0: not in the file
  std::optional<MapGrid> grid;        // grid of the volume; empty: its image cannot be read
  NanoscopePoints points;             // points of the image
  std::vector<double> image_m;        // heights of the sample at the image's points; empty: unknown
  double turn_deg = 0;                // rotation of the scan in degrees
  std::vector<std::string> remarks;
  bool image_is_cut = false;  // true: the file ends in the image

  // Height of the sample where a curve was taken; 0 if unknown.
  double surface_m(std::size_t curve) const;
};

// Places of a force volume; empty for a file without an image, which has a single ramp.
std::optional<NanoscopeVolume> nanoscope_volume(std::string_view bytes, const std::vector<NanoscopeBlock>& blocks);

}  // namespace afm::curves
