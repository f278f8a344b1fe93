// SPDX-License-Identifier: Apache-2.0
#include "render/image_file.h"

#include <png.h>

#include <utility>

#include "core/whole_file.h"

namespace afm::render {

Image to_image(const ImageSpan& span) {
  Image image{.width = span.width, .height = span.height, .rgba = {span.bytes.begin(), span.bytes.end()}};
  if (span.order == ChannelOrder::Bgra) {
    for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) std::swap(image.rgba[i], image.rgba[i + 2]);
  }
  return image;
}

core::Result<std::vector<std::uint8_t>> encode_png(const ImageSpan& image) {
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
  return bytes;
}

core::Result<void> write_png(const ImageSpan& image, const std::string& path) {
  const auto bytes = encode_png(image);
  if (!bytes) {
    return tl::unexpected(bytes.error());
  }
  return core::write_file(path, {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

}  // namespace afm::render
