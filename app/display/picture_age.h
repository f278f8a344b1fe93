// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace afm::app {

// Distinguishes a headset's frozen picture from a slow one. A picture is frozen after 250 ms, or, if one of the last
// pictures took more than half of that, after twice that picture's time, up to 2 s.
class PictureAge {
 public:
  // Reports a new picture, at a time of a monotonic clock.
  void shown(std::int64_t now_ns);

  // Reports that nobody sees the picture, so the time until the next one does not count.
  void unseen() { shown_ns_.reset(); }

  // Returns whether the picture is frozen. False while nobody sees it.
  bool stands_still(std::int64_t now_ns) const;

 private:
  std::optional<std::int64_t> shown_ns_;
  std::array<std::int64_t, 8> took_ns_{};  // times between the last pictures
  std::size_t next_ = 0;
};

}  // namespace afm::app
