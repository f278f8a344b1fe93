// SPDX-License-Identifier: Apache-2.0
#include "haptics/recorded_device.h"

#include <fmt/core.h>

#include <algorithm>

namespace afm::haptics {

core::Result<std::unique_ptr<RecordedDevice>> RecordedDevice::create(const std::string& name,
                                                                     std::vector<RecordedHand> hand) {
  const auto bad = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("cannot replay {}: {}; record it again", name, why));
  };
  if (hand.empty()) return bad("it contains no ticks");
  const auto wrong = std::find_if(hand.begin(), hand.end(),
                                  [](const RecordedHand& entry) { return !is_within_reach(entry.from_contact_m); });
  if (wrong != hand.end())
    return bad(fmt::format("the hand's position at tick {} is impossible", wrong - hand.begin()));
  return std::unique_ptr<RecordedDevice>(new RecordedDevice(omni_like("replay of " + name), std::move(hand)));
}

DeviceSample RecordedDevice::read(std::int64_t /*now_ns*/) noexcept {
  if (finished()) return {.position_m = hand_.back().from_contact_m};
  const RecordedHand& now = hand_[next_++];
  return {.position_m = now.from_contact_m, .turn_on = now.turn_on};
}

}  // namespace afm::haptics
