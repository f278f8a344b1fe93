// SPDX-License-Identifier: Apache-2.0
#include "output/x_picture.h"

#include <algorithm>
#include <cstdlib>

namespace afm::render {

namespace {

constexpr std::uint8_t kDepth = 30;
constexpr std::size_t kPixelBytes = 4, kRequestBytes = 64;  // a pixel, and more than the head of a request

// Depth of a window in bits; 0 if the window has gone.
std::uint8_t depth_of(xcb_connection_t* connection, std::uint32_t window) {
  xcb_generic_error_t* error = nullptr;
  xcb_get_geometry_reply_t* const geometry =
      xcb_get_geometry_reply(connection, xcb_get_geometry(connection, window), &error);
  const std::uint8_t depth = geometry == nullptr ? std::uint8_t{0} : geometry->depth;
  std::free(geometry);
  std::free(error);
  return depth;
}

}  // namespace

std::unique_ptr<XPicture> XPicture::of(std::uint32_t window) {
  std::unique_ptr<XPicture> picture(new XPicture());
  picture->connection_.reset(xcb_connect(nullptr, nullptr));
  xcb_connection_t* const connection = picture->connection_.get();
  if (xcb_connection_has_error(connection) != 0 || depth_of(connection, window) != kDepth) return nullptr;
  picture->window_ = window;
  picture->context_ = xcb_generate_id(connection);
  xcb_create_gc(connection, picture->context_, window, 0, nullptr);
  return picture;
}

void XPicture::put(vk::Extent2D extent, std::span<const std::byte> pixels) const {
  xcb_connection_t* const connection = connection_.get();
  const std::size_t row_bytes = kPixelBytes * extent.width;
  const std::size_t most_bytes = kPixelBytes * xcb_get_maximum_request_length(connection) - kRequestBytes;
  const auto most_rows = static_cast<std::uint32_t>(std::max<std::size_t>(most_bytes / row_bytes, 1));
  for (std::uint32_t row = 0; row < extent.height; row += most_rows) {
    const std::uint32_t rows = std::min(most_rows, extent.height - row);
    const auto part = pixels.subspan(row * row_bytes, rows * row_bytes);
    xcb_put_image(connection, XCB_IMAGE_FORMAT_Z_PIXMAP, window_, context_, static_cast<std::uint16_t>(extent.width),
                  static_cast<std::uint16_t>(rows), std::int16_t{0}, static_cast<std::int16_t>(row), std::uint8_t{0},
                  kDepth, static_cast<std::uint32_t>(part.size()), reinterpret_cast<const std::uint8_t*>(part.data()));
  }
  // the answer comes after all earlier pictures; so does an error, which needs no handling
  std::free(xcb_get_input_focus_reply(connection, xcb_get_input_focus(connection), nullptr));
  while (xcb_generic_event_t* const event = xcb_poll_for_event(connection)) std::free(event);
}

}  // namespace afm::render
