// SPDX-License-Identifier: Apache-2.0
#include "bytes/tiff_page.h"

#include <array>

#include "bytes/file_bytes.h"
#include "curves/curve_error.h"

namespace afm::curves {

namespace {

constexpr std::size_t kEntryBytes = 12, kPointerBytes = 4, kFirstPageAt = 4;
constexpr std::uint16_t kText = 2;
constexpr unsigned kStripOffsets = 0x0111, kStripSizes = 0x0117;

// Bytes of a TIFF 6.0 type; 0 if unknown.
std::size_t size_of_type(std::uint16_t type) {
  constexpr std::array<std::size_t, 13> kSizes{0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8};
  return type < kSizes.size() ? kSizes[type] : 0;
}

}  // namespace

bool looks_like_tiff(std::string_view bytes) {
  return bytes.starts_with(std::string_view("MM\0*", 4)) || bytes.starts_with(std::string_view("II*\0", 4));
}

std::endian tiff_order(std::string_view file) { return file.starts_with('M') ? std::endian::big : std::endian::little; }

std::size_t tiff_first_page(std::string_view file) {
  return number_at<std::uint32_t>(file, kFirstPageAt, tiff_order(file));
}

TiffPage::TiffPage(std::string_view file, std::size_t offset, std::endian order) : order_(order) {
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

const TiffPage::Entry* TiffPage::find(unsigned tag) const {
  const auto found = entries_.find(static_cast<std::uint16_t>(tag));
  return found == entries_.end() ? nullptr : &found->second;
}

std::optional<double> TiffPage::number(unsigned tag, std::size_t index) const {
  const Entry* const entry = find(tag);
  if (entry == nullptr || index >= entry->count) return std::nullopt;
  const std::size_t at = index * size_of_type(entry->type);
  switch (entry->type) {
    case 1:
      return number_at<std::uint8_t>(entry->bytes, at, order_);
    case 3:
      return number_at<std::uint16_t>(entry->bytes, at, order_);
    case 4:
      return number_at<std::uint32_t>(entry->bytes, at, order_);
    case 6:
      return number_at<std::int8_t>(entry->bytes, at, order_);
    case 8:
      return number_at<std::int16_t>(entry->bytes, at, order_);
    case 9:
      return number_at<std::int32_t>(entry->bytes, at, order_);
    case 11:
      return static_cast<double>(number_at<float>(entry->bytes, at, order_));
    case 12:
      return number_at<double>(entry->bytes, at, order_);
    default:
      return std::nullopt;
  }
}

std::size_t TiffPage::count(unsigned tag) const {
  const Entry* const entry = find(tag);
  return entry == nullptr ? 0 : entry->count;
}

std::string TiffPage::text(unsigned tag) const {
  const Entry* const entry = find(tag);
  if (entry == nullptr || entry->type != kText) return {};
  return std::string(entry->bytes.substr(0, entry->bytes.find('\0')));
}

std::string_view TiffPage::bytes(unsigned tag) const {
  const Entry* const entry = find(tag);
  return entry == nullptr ? std::string_view() : entry->bytes;
}

std::string tiff_strips(std::string_view file, const TiffPage& page, std::size_t size) {
  std::string pixels;
  pixels.reserve(size);
  for (std::size_t i = 0; i < page.count(kStripOffsets) && pixels.size() < size; ++i) {
    const auto offset = page.number(kStripOffsets, i), length = page.number(kStripSizes, i);
    const auto most = static_cast<double>(file.size());
    if (!offset || !length || !(*offset >= 0 && *offset <= most && *length > 0 && *length <= most)) {
      throw CurveError(cut_short("a strip of an image lies outside it"));
    }
    const std::string_view strip = part(file, static_cast<std::size_t>(*offset), static_cast<std::size_t>(*length));
    pixels += strip.substr(0, size - pixels.size());
  }
  if (pixels.size() != size) throw CurveError(cut_short("the strips of an image do not fill it"));
  return pixels;
}

}  // namespace afm::curves
