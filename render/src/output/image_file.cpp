// SPDX-License-Identifier: Apache-2.0
#include "render/image_file.h"

#include <png.h>
#include <zlib.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "core/printable.h"
#include "core/whole_file.h"
#include "core/written_by.h"

namespace afm::render {
namespace {

// The signature and the header, which is the first chunk (PNG, second edition, 5.2 and 11.2.2). Texts may follow it.
constexpr std::ptrdiff_t kBeginBytes = 8 + 25;
constexpr std::size_t kLongestKey = 79;  // limit of PNG, second edition, 11.3.4.2

void put_u32(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

// Adds a chunk iTXt: text in UTF-8, not compressed (PNG, second edition, 11.3.4.5).
void put_text(std::vector<std::uint8_t>& bytes, std::string_view key, std::string_view text) {
  std::string chunk = "iTXt";
  chunk.append(key.substr(0, kLongestKey));
  chunk.append(5, '\0');  // end of the key, two bytes for "not compressed", no language, no translated key
  chunk.append(text);
  put_u32(bytes, static_cast<std::uint32_t>(chunk.size() - 4));
  bytes.insert(bytes.end(), chunk.begin(), chunk.end());
  const auto* data = reinterpret_cast<const Bytef*>(chunk.data());
  put_u32(bytes, static_cast<std::uint32_t>(::crc32(0, data, static_cast<uInt>(chunk.size()))));
}

}  // namespace

Image to_image(const ImageSpan& span) {
  Image image{.width = span.width, .height = span.height, .rgba = {span.bytes.begin(), span.bytes.end()}};
  if (span.order == ChannelOrder::Bgra) {
    for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) std::swap(image.rgba[i], image.rgba[i + 2]);
  }
  return image;
}

core::Result<std::vector<std::uint8_t>> encode_png(const ImageSpan& image, PictureTexts texts) {
  std::vector<std::uint8_t> color;
  color.reserve(image.bytes.size() / 4 * 3);
  for (std::size_t i = 0; i + 3 < image.bytes.size(); i += 4) {
    color.insert(color.end(), {image.bytes[i], image.bytes[i + 1], image.bytes[i + 2]});
  }
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = image.width;
  png.height = image.height;
  png.format = image.order == ChannelOrder::Bgra ? PNG_FORMAT_BGR : PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::vector<std::uint8_t> bytes(size);
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, color.data(), 0, nullptr) == 0) {
    return core::failure(core::ErrorCategory::Failed, std::string("cannot encode a picture as PNG: ") + png.message);
  }
  bytes.resize(size);
  std::vector<std::uint8_t> named;
  put_text(named, "Software", core::written_by());
  for (const auto& [key, text] : texts) {
    if (key != "Software") put_text(named, key, core::printable(text));
  }
  bytes.insert(bytes.begin() + kBeginBytes, named.begin(), named.end());
  return bytes;
}

core::Result<void> write_png(const ImageSpan& image, const std::string& path, PictureTexts texts) {
  const auto bytes = encode_png(image, texts);
  if (!bytes) {
    return tl::unexpected(bytes.error());
  }
  return core::write_file(path, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

}  // namespace afm::render
