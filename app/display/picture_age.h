// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace afm::app {

// Distinguishes a headset's frozen picture from a slow one. It may stand still for 250 ms; where one of the last
// pictures took longer than half of that, for twice as long as that one, up to 2 s.
class PictureAge {
 public:
  // A picture is shown, at a time of a monotonic clock.
  void shown(std::int64_t now_ns);

  // Nobody sees the picture: the time until the next one says nothing.
  void unseen() { shown_ns_.reset(); }

  // For longer than it may. False where nobody sees it.
  bool stands_still(std::int64_t now_ns) const;

 private:
  std::optional<std::int64_t> shown_ns_;
  std::array<std::int64_t, 8> took_ns_{};  // the last pictures, each since the one before it
  std::size_t next_ = 0;
};

}  // namespace afm::app
