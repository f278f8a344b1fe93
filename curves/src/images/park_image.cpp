// SPDX-License-Identifier: Apache-2.0
#include "images/park_image.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "bytes/file_bytes.h"
#include "bytes/tiff_page.h"

namespace afm::curves {

namespace {

constexpr unsigned kParkMagic = 0xC500, kParkVersion = 0xC501, kParkNumbers = 0xC502, kParkHeader = 0xC503,
                   kParkComment = 0xC504, kParkSoftware = 0x0131, kParkDateTime = 0x0132;
constexpr double kParkMagicNumber = 0x0E031301, kParkVersionWithTypes = 0x01000002;
constexpr double kMicrometre_m = 1e-6;

// Offsets in the header of the first version, and of the type of the numbers, which the second one adds.
enum At : std::size_t {
  kKindAt = 0,
  kSourceAt = 4,
  kModeAt = 68,
  kColumnsAt = 100,
  kRowsAt = 104,
  kForwardAt = 128,
  kSwappedAt = 136,
  kWidthAt = 140,
  kHeightAt = 148,
  kXAt = 156,
  kYAt = 164,
  kLineRateAt = 172,
  kGainAt = 220,
  kScaleAt = 228,
  kOffsetAt = 236,
  kUnitAt = 244,
  kNumberTypeAt = 348
};
constexpr std::size_t kSourceLength = 32, kShortLength = 8;  // lengths in characters of two bytes
enum class Kind : std::uint32_t { Image, LineProfile, Spectroscopy };

// Text of `length` characters of UTF-16 as UTF-8; characters beyond its first plane become "?".
std::string text_at(std::string_view header, std::size_t at, std::size_t length) {
  std::string text;
  for (std::size_t i = 0; i < length; ++i) {
    const unsigned code = number_at<std::uint16_t>(header, at + 2 * i);
    if (code == 0) break;
    constexpr unsigned kSurrogates = 0xD800, kBehindSurrogates = 0xE000;
    if (code < 0x80) {
      text += static_cast<char>(code);
    } else if (code < 0x800) {
      text += static_cast<char>(0xC0U | (code >> 6U));
      text += static_cast<char>(0x80U | (code & 0x3FU));
    } else if (code >= kSurrogates && code < kBehindSurrogates) {
      text += '?';
    } else {
      text += static_cast<char>(0xE0U | (code >> 12U));
      text += static_cast<char>(0x80U | ((code >> 6U) & 0x3FU));
      text += static_cast<char>(0x80U | (code & 0x3FU));
    }
  }
  return text;
}

enum class NumberType : std::uint32_t { Int16, Int32, Float };

double number_of_type(std::string_view numbers, std::size_t index, NumberType type) {
  if (type == NumberType::Int16) return number_at<std::int16_t>(numbers, index * sizeof(std::int16_t));
  if (type == NumberType::Int32) return number_at<std::int32_t>(numbers, index * sizeof(std::int32_t));
  return static_cast<double>(number_at<float>(numbers, index * sizeof(float)));
}

std::string name_of_channel(std::string_view header) {
  std::string name = text_at(header, kSourceAt, kSourceLength);
  if (name.empty()) name = "unnamed";
  return number_at<std::uint32_t>(header, kForwardAt) != 0 ? name : name + " (retrace)";
}

NumberType type_of_numbers(std::string_view header, const TiffPage& page) {
  if (page.number(kParkVersion).value_or(0) < kParkVersionWithTypes) return NumberType::Int16;
  const auto type = number_at<std::uint32_t>(header, kNumberTypeAt);
  if (type > static_cast<std::uint32_t>(NumberType::Float)) {
    throw CurveError(fmt::format("its numbers are of type {}; 0 to 2 are read", type));
  }
  return NumberType{type};
}

ImagePage channel_of(std::string_view header, const TiffPage& page) {
  const std::size_t columns = image_side(number_at<std::uint32_t>(header, kColumnsAt)),
                    rows = image_side(number_at<std::uint32_t>(header, kRowsAt));
  const NumberType type = type_of_numbers(header, page);
  const std::size_t size = columns * rows * (type == NumberType::Int16 ? 2 : 4);
  const std::string_view numbers = part(page.bytes(kParkNumbers), 0, size);
  const auto gain = number_at<double>(header, kGainAt), scale = number_at<double>(header, kScaleAt),
             offset = number_at<double>(header, kOffsetAt);
  if (!std::isfinite(gain * scale) || gain * scale == 0.0 || !std::isfinite(offset)) {
    throw CurveError(
        fmt::format("its gain is {:g}, its scale {:g} and its offset {:g}: no calibration", gain, scale, offset));
  }
  const ScaledUnit unit = scaled_unit(text_at(header, kUnitAt, kShortLength)), micrometres{kMicrometre_m, "m"};
  return {.name = name_of_channel(header),
          .unit = unit.unit,
          .columns = columns,
          .rows = rows,
          .width_m = image_length_m(number_at<double>(header, kWidthAt), micrometres),
          .height_m = image_length_m(number_at<double>(header, kHeightAt), micrometres),
          .x_offset_m = kMicrometre_m * number_at<double>(header, kXAt),
          .y_offset_m = kMicrometre_m * number_at<double>(header, kYAt),
          .values = [=] {
            return grid_values(columns, rows, true, [&](std::size_t i) {
              return unit.factor * gain * (scale * number_of_type(numbers, i, type) + offset);
            });
          }};
}

}  // namespace

bool looks_like_park(std::string_view bytes) {
  if (!looks_like_tiff(bytes)) return false;
  try {
    return TiffPage(bytes, tiff_first_page(bytes), tiff_order(bytes)).number(kParkMagic) == kParkMagicNumber;
  } catch (const CurveError&) {
    return false;
  }
}

ImagePages read_park_image(std::string_view bytes) {
  const TiffPage page(bytes, tiff_first_page(bytes), tiff_order(bytes));
  const std::string_view header = page.bytes(kParkHeader);
  if (header.empty()) throw CurveError("it has no header of Park Systems");
  const auto kind = Kind{number_at<std::uint32_t>(header, kKindAt)};
  if (kind != Kind::Image) {
    throw CurveError(kind == Kind::LineProfile ? "it is a line profile of Park Systems, not an image"
                                               : "it is a spectroscopy of Park Systems, which is not read");
  }
  ImagePages found;
  const auto add = [&](const char* key, std::string text) {
    if (!text.empty()) found.metadata.emplace_back(key, std::move(text));
  };
  add("Mode", text_at(header, kModeAt, kShortLength));
  add("Software", page.text(kParkSoftware));
  add("Date", page.text(kParkDateTime));
  add("Comment", page.text(kParkComment));
  if (const auto rate = number_at<double>(header, kLineRateAt); rate > 0)
    add("Scan rate", fmt::format("{:g} Hz", rate));
  if (number_at<std::uint32_t>(header, kSwappedAt) != 0) {
    found.remark("its lines were scanned along y: rows and columns are as in the file");
  }
  add_page(name_of_channel(header), found, [&] { return channel_of(header, page); });
  return found;
}

}  // namespace afm::curves
