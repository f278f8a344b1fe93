// SPDX-License-Identifier: Apache-2.0
#include "images/jpk_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "bytes/file_bytes.h"
#include "bytes/tiff_page.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

enum Tag : std::uint16_t {
  kColumnCount = 0x0100,
  kRowCount = 0x0101,
  kBits = 0x0102,
  kCompression = 0x0103,
  kPhotometric = 0x0106,
  kSamplesPerPixel = 0x0115,
  kSampleFormat = 0x0153,
  kName = 0x8004,
  kComment = 0x8005,
  kSample = 0x8007,
  kGridX = 0x8040,
  kGridY = 0x8041,
  kGridWidth = 0x8042,
  kGridHeight = 0x8043,
  kGridReflected = 0x8045,
  kChannel = 0x8050,
  kRetrace = 0x8051,
  kChannelTitle = 0x8052,
  kSlotCount = 0x8080,
  kDefaultSlot = 0x8081,
  kSlotName = 0x8090,  // tags of the first slot
  kEncoderUnit = 0x80A2,
  kScalingType = 0x80A3,
  kMultiplier = 0x80A4,
  kOffset = 0x80A5
};

constexpr unsigned kSlotStride = 0x30;
constexpr double kMostSlots = 64;
constexpr std::size_t kMostPages = 256;
constexpr std::uint32_t kSignedIntegers = 2, kUncompressed = 1, kBlackIsZero = 1;

struct Calibration {
  double multiplier = 1.0, offset = 0.0;
  std::string unit;
};

// Calibration of the page's default slot.
Calibration default_calibration(const TiffPage& page) {
  const std::string wanted = page.text(kDefaultSlot);
  const double count = std::min(page.number(kSlotCount).value_or(0.0), kMostSlots);
  for (unsigned i = 0; i < count; ++i) {
    const unsigned slot = kSlotStride * i;
    if (page.text(kSlotName + slot) != wanted) continue;
    const std::string type = page.text(kScalingType + slot);
    if (type == "NullScaling") return {};
    const auto multiplier = page.number(kMultiplier + slot), offset = page.number(kOffset + slot);
    if (type != "LinearScaling" || !multiplier || !offset) break;
    return {*multiplier, *offset, page.text(kEncoderUnit + slot)};
  }
  throw CurveError(fmt::format("it has no linear calibration \"{}\"", wanted));
}

double jpk_integer(std::string_view pixels, std::size_t index, std::size_t size, bool is_signed, std::endian order) {
  const std::size_t at = index * size;
  if (size == 2) {
    return is_signed ? static_cast<double>(number_at<std::int16_t>(pixels, at, order))
                     : static_cast<double>(number_at<std::uint16_t>(pixels, at, order));
  }
  return is_signed ? static_cast<double>(number_at<std::int32_t>(pixels, at, order))
                   : static_cast<double>(number_at<std::uint32_t>(pixels, at, order));
}

struct Grid {
  double width_m = 0, height_m = 0, x_m = 0, y_m = 0;
};

// Returns false for JPK's thumbnail and other pages that are not channels.
bool is_channel(const TiffPage& page) {
  const double bits = page.number(kBits).value_or(0);
  return page.number(kPhotometric) == kBlackIsZero && (bits == 16 || bits == 32) && page.count(kBits) == 1;
}

// Name of a channel: "height", "height (retrace)".
std::string name_of_channel(const TiffPage& page) {
  std::string name = page.text(kChannelTitle);
  if (name.empty()) name = page.text(kChannel);
  if (name.empty()) name = "unnamed";
  return page.number(kRetrace).value_or(0) != 0 ? name + " (retrace)" : name;
}

ImagePage channel_of(std::string_view file, const TiffPage& page, const Grid& grid, std::endian order) {
  if (page.number(kCompression).value_or(kUncompressed) != kUncompressed ||
      page.number(kSamplesPerPixel).value_or(1) != 1) {
    throw CurveError("it is compressed");
  }
  const Calibration scale = default_calibration(page);
  const std::size_t columns = image_side(page.number(kColumnCount).value_or(0)),
                    rows = image_side(page.number(kRowCount).value_or(0));
  const auto size = static_cast<std::size_t>(*page.number(kBits)) / 8;
  const bool is_signed = page.number(kSampleFormat).value_or(0) == kSignedIntegers;
  const bool reflected = page.number(kGridReflected).value_or(0) != 0;
  const ScaledUnit unit = scaled_unit(scale.unit);
  return {.name = name_of_channel(page),
          .unit = unit.unit,
          .columns = columns,
          .rows = rows,
          .width_m = grid.width_m,
          .height_m = grid.height_m,
          .x_offset_m = grid.x_m,
          .y_offset_m = grid.y_m,
          .values = [=] {
            const std::string pixels = tiff_strips(file, page, columns * rows * size);
            return grid_values(columns, rows, !reflected, [&](std::size_t i) {
              return unit.factor * (scale.multiplier * jpk_integer(pixels, i, size, is_signed, order) + scale.offset);
            });
          }};
}

}  // namespace

ImagePages read_jpk_image(std::string_view bytes) {
  const std::endian order = tiff_order(bytes);
  const TiffPage first(bytes, tiff_first_page(bytes), order);
  const auto width = first.number(kGridWidth), height = first.number(kGridHeight);
  if (!width || !height) throw CurveError("it is a TIFF without the size of a scan: neither JPK's nor Park's");
  const Grid grid{image_length_m(*width), image_length_m(*height), first.number(kGridX).value_or(0.0),
                  first.number(kGridY).value_or(0.0)};
  ImagePages found;
  constexpr std::pair<Tag, std::string_view> kTexts[]{{kName, "Name"}, {kComment, "Comment"}, {kSample, "Sample"}};
  for (const auto& [tag, key] : kTexts) {
    if (std::string text = first.text(tag); !text.empty()) found.metadata.emplace_back(key, std::move(text));
  }
  std::size_t offset = tiff_first_page(bytes);
  for (std::size_t pages = 0; offset != 0; ++pages) {
    if (pages == kMostPages) throw CurveError("its pages have no end");
    const TiffPage page(bytes, offset, order);
    if (is_channel(page)) add_page(name_of_channel(page), found, [&] { return channel_of(bytes, page, grid, order); });
    offset = page.next();
  }
  return found;
}

}  // namespace afm::curves
