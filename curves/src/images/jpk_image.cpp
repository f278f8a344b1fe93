// SPDX-License-Identifier: Apache-2.0
#include "images/jpk_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "bytes/file_bytes.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

enum Tag : std::uint16_t {
  kColumnCount = 0x0100,
  kRowCount = 0x0101,
  kBits = 0x0102,
  kCompression = 0x0103,
  kPhotometric = 0x0106,
  kStripOffsets = 0x0111,
  kSamplesPerPixel = 0x0115,
  kStripSizes = 0x0117,
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
  kOffset = 0x80A5,
  kParkMagic = 0xC500
};

constexpr unsigned kSlotStride = 0x30;
constexpr double kMostSlots = 64;
constexpr std::size_t kMostPages = 256;
constexpr std::uint32_t kSignedIntegers = 2, kUncompressed = 1, kBlackIsZero = 1;

constexpr std::size_t kEntryBytes = 12, kPointerBytes = 4;

struct Entry {
  std::uint16_t type = 0;
  std::size_t count = 0;
  std::string_view bytes;
};

// Bytes of a TIFF 6.0 type; 0 if unknown.
std::size_t size_of_type(std::uint16_t type) {
  constexpr std::array<std::size_t, 13> kSizes{0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8};
  return type < kSizes.size() ? kSizes[type] : 0;
}

class Page {
 public:
  Page(std::string_view file, std::size_t offset, std::endian order) : order_(order) {
    const auto count = number_at<std::uint16_t>(file, offset, order);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view record = part(file, offset + 2 + i * kEntryBytes, kEntryBytes);
      Entry entry{.type = number_at<std::uint16_t>(record, 2, order),
                  .count = number_at<std::uint32_t>(record, 4, order),
                  .bytes = {}};
      const std::size_t size = size_of_type(entry.type) * entry.count;
      entry.bytes =
          size <= kPointerBytes ? record.substr(8, size) : part(file, number_at<std::uint32_t>(record, 8, order), size);
      entries_.emplace(number_at<std::uint16_t>(record, 0, order), entry);
    }
    next_ = number_at<std::uint32_t>(file, offset + 2 + count * kEntryBytes, order);
  }

  std::size_t next() const { return next_; }  // offset of the next page in the file; 0: none

  std::optional<double> number(unsigned tag, std::size_t index = 0) const {
    const auto found = entries_.find(static_cast<std::uint16_t>(tag));
    if (found == entries_.end() || index >= found->second.count) return std::nullopt;
    const Entry& entry = found->second;
    const std::size_t at = index * size_of_type(entry.type);
    switch (entry.type) {
      case 1:
        return number_at<std::uint8_t>(entry.bytes, at, order_);
      case 3:
        return number_at<std::uint16_t>(entry.bytes, at, order_);
      case 4:
        return number_at<std::uint32_t>(entry.bytes, at, order_);
      case 6:
        return number_at<std::int8_t>(entry.bytes, at, order_);
      case 8:
        return number_at<std::int16_t>(entry.bytes, at, order_);
      case 9:
        return number_at<std::int32_t>(entry.bytes, at, order_);
      case 11:
        return static_cast<double>(number_at<float>(entry.bytes, at, order_));
      case 12:
        return number_at<double>(entry.bytes, at, order_);
      default:
        return std::nullopt;
    }
  }

  std::size_t count(unsigned tag) const {
    const auto found = entries_.find(static_cast<std::uint16_t>(tag));
    return found == entries_.end() ? 0 : found->second.count;
  }

  std::string text(unsigned tag) const {
    const auto found = entries_.find(static_cast<std::uint16_t>(tag));
    if (found == entries_.end() || found->second.type != 2) return {};
    return std::string(found->second.bytes.substr(0, found->second.bytes.find('\0')));
  }

 private:
  std::map<std::uint16_t, Entry> entries_;
  std::endian order_;
  std::size_t next_ = 0;
};

struct Calibration {
  double multiplier = 1.0, offset = 0.0;
  std::string unit;
};

// Calibration of the page's default slot.
Calibration default_calibration(const Page& page) {
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

// The pixels of a page, strip by strip, each with a whole number of rows.
std::string strips_of(std::string_view file, const Page& page, std::size_t size) {
  std::string pixels;
  pixels.reserve(size);
  for (std::size_t i = 0; i < page.count(kStripOffsets) && pixels.size() < size; ++i) {
    const auto offset = page.number(kStripOffsets, i), length = page.number(kStripSizes, i);
    const auto most = static_cast<double>(file.size());
    if (!offset || !length || !(*offset >= 0 && *offset <= most && *length > 0 && *length <= most)) {
      throw CurveError("it is damaged: a strip of an image lies outside the file");
    }
    const std::string_view strip = part(file, static_cast<std::size_t>(*offset), static_cast<std::size_t>(*length));
    pixels += strip.substr(0, size - pixels.size());
  }
  if (pixels.size() != size) throw CurveError("it is cut short: the strips of an image do not fill it");
  return pixels;
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
bool is_channel(const Page& page) {
  const double bits = page.number(kBits).value_or(0);
  return page.number(kPhotometric) == kBlackIsZero && (bits == 16 || bits == 32) && page.count(kBits) == 1;
}

// "height", "height (retrace)".
std::string name_of_channel(const Page& page) {
  std::string name = page.text(kChannelTitle);
  if (name.empty()) name = page.text(kChannel);
  if (name.empty()) name = "unnamed";
  return page.number(kRetrace).value_or(0) != 0 ? name + " (retrace)" : name;
}

ImagePage channel_of(std::string_view file, const Page& page, const Grid& grid, std::endian order) {
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
            const std::string pixels = strips_of(file, page, columns * rows * size);
            return grid_values(columns, rows, !reflected, [&](std::size_t i) {
              return unit.factor * (scale.multiplier * jpk_integer(pixels, i, size, is_signed, order) + scale.offset);
            });
          }};
}

}  // namespace

bool looks_like_tiff(std::string_view bytes) {
  return bytes.starts_with(std::string_view("MM\0*", 4)) || bytes.starts_with(std::string_view("II*\0", 4));
}

ImagePages read_jpk_image(std::string_view bytes) {
  const std::endian order = bytes[0] == 'M' ? std::endian::big : std::endian::little;
  const Page first(bytes, number_at<std::uint32_t>(bytes, 4, order), order);
  const auto width = first.number(kGridWidth), height = first.number(kGridHeight);
  if (first.count(kParkMagic) > 0) {
    throw CurveError("it is a TIFF of Park Systems, which is not read; save it as .gsf or .gwy with Gwyddion");
  }
  if (!width || !height) throw CurveError("it is a TIFF without the size of a scan: none of JPK's");
  const Grid grid{image_length_m(*width), image_length_m(*height), first.number(kGridX).value_or(0.0),
                  first.number(kGridY).value_or(0.0)};
  ImagePages found;
  constexpr std::pair<Tag, std::string_view> kTexts[]{{kName, "Name"}, {kComment, "Comment"}, {kSample, "Sample"}};
  for (const auto& [tag, key] : kTexts) {
    if (std::string text = first.text(tag); !text.empty()) found.metadata.emplace_back(key, std::move(text));
  }
  std::size_t offset = number_at<std::uint32_t>(bytes, 4, order);
  for (std::size_t pages = 0; offset != 0; ++pages) {
    if (pages == kMostPages) throw CurveError("its pages have no end");
    const Page page(bytes, offset, order);
    if (is_channel(page)) add_page(name_of_channel(page), found, [&] { return channel_of(bytes, page, grid, order); });
    offset = page.next();
  }
  return found;
}

}  // namespace afm::curves
