// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "scene/shared/tip_blocks.h"

namespace afm::servo {

// Places of the particles between the pushes of a session, by their digests, in the order in which a push can be taken
// back. A replay knows no other pushes than those of its session.
class ReachedPlaces {
 public:
  // Call for every sample of the session, in order.
  void add(const scene::PushSample& push) {
    const bool at_rest = push.particle == scene::kNoParticle;
    if (at_rest && (places_.empty() || places_.back() != push.digest)) places_.push_back(push.digest);
  }

  // A push was taken back, and the particles have this digest now. False if it was made before the session.
  bool take_back_to(std::uint64_t digest) {
    if (places_.empty()) return false;
    const auto before = std::find(places_.rbegin() + 1, places_.rend(), digest);
    if (before == places_.rend()) return false;
    places_.erase(before.base(), places_.end());
    return true;
  }

  void clear() { places_.clear(); }

 private:
  std::vector<std::uint64_t> places_;
};

}  // namespace afm::servo
