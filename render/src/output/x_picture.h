// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xcb/xcb.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "device/vulkan.h"

namespace afm::render {

// Puts pictures into a window of 30 bits through X itself. Mesa's drivers for processors (22.3) send every picture as
// one of 24 bits, which such a window refuses. One thread.
class XPicture {
 public:
  // Null if the window has another depth, or if its server is unreachable.
  static std::unique_ptr<XPicture> of(std::uint32_t window);

  // `pixels`: rows from the top, one word each with blue in its lowest ten bits, as in the window's visual. Waits
  // until the server has received them. Ignores a window that has gone.
  void put(vk::Extent2D extent, std::span<const std::byte> pixels) const;

 private:
  struct Disconnect {
    void operator()(xcb_connection_t* connection) const { xcb_disconnect(connection); }
  };
  XPicture() = default;

  std::unique_ptr<xcb_connection_t, Disconnect> connection_;
  std::uint32_t window_ = 0, context_ = 0;
};

}  // namespace afm::render
