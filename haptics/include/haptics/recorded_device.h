// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "haptics/device.h"

namespace afm::haptics {

// State of the hand in one tick of a recording.
struct RecordedHand {
  glm::dvec3 from_contact_m{0.0};  // position in the device frame, relative to that of Z = 0
  bool turn_on = false;
};

// Recorded hand, replayed one entry per read, whatever the time: the tip's force is then the same bit for bit, and so
// is the hand's if the ticks come at the same times. Its contact point is the origin. It ignores forces; after the last
// entry it rests there with the button released.
class RecordedDevice final : public HapticDevice {
 public:
  // BadInputFile if there is no entry, or one that is not finite or out of reach. `name` is the name of the recording.
  static core::Result<std::unique_ptr<RecordedDevice>> create(const std::string& name, std::vector<RecordedHand> hand);

  const DeviceSpec& spec() const noexcept override { return spec_; }
  DeviceSample read(std::int64_t now_ns) noexcept override;
  void write(const ForceCommand& /*command*/) noexcept override {}

  bool finished() const noexcept { return next_ >= hand_.size(); }

 private:
  RecordedDevice(DeviceSpec spec, std::vector<RecordedHand> hand) : spec_(std::move(spec)), hand_(std::move(hand)) {}

  DeviceSpec spec_;
  std::vector<RecordedHand> hand_;
  std::size_t next_ = 0;
};

}  // namespace afm::haptics
