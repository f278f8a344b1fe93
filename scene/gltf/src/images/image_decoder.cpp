// SPDX-License-Identifier: Apache-2.0
#include "images/image_decoder.h"

#include <fmt/core.h>
#include <png.h>
#include <turbojpeg.h>

#include <csetjmp>
#include <cstring>
#include <memory>

#include "foreign_file.h"
#include "gltf_error.h"

namespace afm::scene {
namespace {

using Encoded = std::span<const std::uint8_t>;

bool is_png(Encoded bytes) { return bytes.size() >= 24 && png_sig_cmp(bytes.data(), 0, 8) == 0; }
bool is_jpeg(Encoded bytes) { return bytes.size() >= 4 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF; }

struct CloseJpeg {
  void operator()(void* decoder) const { tjDestroy(decoder); }
};

ImageSize png_size(Encoded bytes) {
  if (std::memcmp(bytes.data() + 12, "IHDR", 4) != 0) throw GltfError("its PNG header is corrupt");
  return {png_get_uint_32(bytes.data() + 16), png_get_uint_32(bytes.data() + 20)};
}

ImageSize jpeg_size(Encoded bytes) {
  const std::unique_ptr<void, CloseJpeg> decoder(tjInitDecompress());
  int width = 0, height = 0, sampling = 0, colors = 0;
  if (tjDecompressHeader3(decoder.get(), bytes.data(), bytes.size(), &width, &height, &sampling, &colors) != 0 ||
      width <= 0 || height <= 0) {
    throw GltfError("its JPEG header is corrupt");
  }
  return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

void read_memory(png_structp png, png_bytep into, std::size_t count) {
  auto& left = *static_cast<Encoded*>(png_get_io_ptr(png));
  if (count > left.size()) png_error(png, "it ends too early");
  std::memcpy(into, left.data(), count);
  left = left.subspan(count);
}

// libpng's messages are for programmers, and would go to stderr
void keep_quiet(png_structp, png_const_charp) {}
void leave(png_structp png, png_const_charp) { png_longjmp(png, 1); }

// libpng returns by longjmp(), so nothing here may need a destructor.
bool read_png(png_structp png, png_infop info, Encoded* left, png_bytepp rows, std::size_t row_bytes) {
  // NOLINTNEXTLINE(cert-err52-cpp): libpng knows no other way to say that an image is broken
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_read_fn(png, left, read_memory);
  png_set_user_limits(png, kLargestImageSide, kLargestImageSide);
  png_set_chunk_malloc_max(png, 8U << 20U);
  png_read_info(png, info);
  png_set_expand(png);
  png_set_scale_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  if (png_get_rowbytes(png, info) != row_bytes) return false;
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  return true;
}

void decode_png(Encoded bytes, Image& image) {
  const std::size_t row_bytes = std::size_t{4} * image.width;
  std::vector<png_bytep> rows(image.height);
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = image.rgba.data() + row * row_bytes;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, leave, keep_quiet);
  if (png == nullptr) throw GltfError("out of memory while decoding it");
  png_infop info = png_create_info_struct(png);
  const bool whole = info != nullptr && read_png(png, info, &bytes, rows.data(), row_bytes);
  png_destroy_read_struct(&png, &info, nullptr);
  if (!whole) throw GltfError("its PNG data is corrupt");
}

void decode_jpeg(Encoded bytes, Image& image) {
  const std::unique_ptr<void, CloseJpeg> decoder(tjInitDecompress());
  const int done =
      tjDecompress2(decoder.get(), bytes.data(), bytes.size(), image.rgba.data(), static_cast<int>(image.width), 0,
                    static_cast<int>(image.height), TJPF_RGBA, TJFLAG_LIMITSCANS | TJFLAG_ACCURATEDCT);
  if (done != 0 && tjGetErrorCode(decoder.get()) == TJERR_FATAL) {
    throw GltfError(fmt::format("its JPEG data is corrupt or of an unsupported kind ({})",
                                std::string(tjGetErrorStr2(decoder.get())).substr(0, 80)));
  }
}

}  // namespace

ImageSize image_size(Encoded encoded) {
  if (!is_png(encoded) && !is_jpeg(encoded)) {
    const std::string kind = encoded.empty() ? "empty" : foreign_image(encoded);
    throw GltfError(fmt::format("it is {}; export the model with PNG or JPEG images",
                                kind.empty() ? "neither PNG nor JPEG" : kind));
  }
  const ImageSize size = is_png(encoded) ? png_size(encoded) : jpeg_size(encoded);
  if (size.width == 0 || size.height == 0 || size.width > kLargestImageSide || size.height > kLargestImageSide) {
    throw GltfError(
        fmt::format("it is {} x {} pixels, not 1 to {} on a side", size.width, size.height, kLargestImageSide));
  }
  return size;
}

void decode_image(Encoded encoded, Image& image) {
  image.rgba.resize(std::size_t{4} * image.width * image.height);
  if (is_png(encoded)) {
    decode_png(encoded, image);
  } else {
    decode_jpeg(encoded, image);
  }
}

}  // namespace afm::scene
