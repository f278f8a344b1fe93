// SPDX-License-Identifier: Apache-2.0
#include "app/display/picture_age.h"

#include <algorithm>

#include "render/headset.h"

namespace afm::app {

namespace {

constexpr std::int64_t kMostPatienceNs = 2'000'000'000;  // time for which a heartbeat covers a slow frame

}  // namespace

void PictureAge::shown(std::int64_t now_ns) {
  if (shown_ns_) {
    took_ns_[next_] = now_ns - *shown_ns_;
    next_ = (next_ + 1) % took_ns_.size();
  }
  shown_ns_ = now_ns;
}

bool PictureAge::stands_still(std::int64_t now_ns) const {
  const std::int64_t longest_ns = *std::max_element(took_ns_.begin(), took_ns_.end());
  return shown_ns_ && now_ns - *shown_ns_ >= std::clamp(2 * longest_ns, render::Headset::kFrozenNs, kMostPatienceNs);
}

}  // namespace afm::app
