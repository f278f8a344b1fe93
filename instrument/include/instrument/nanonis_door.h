// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "instrument/door.h"

namespace afm::physics {
struct ScanImage;
}

namespace afm::instrument {

class SimulatedInstrument;

// Properties of scans that a client sets, as Scan.PropsGet names them: kept, without effect.
struct NanonisProperties {
  static constexpr std::uint32_t kSaveNone = 2;
  std::uint32_t continuous = 0, bouncing = 0;  // flags of a scan, 0 off, 1 on
  std::uint32_t autosave = kSaveNone;          // choice by which no image is saved
  std::string series, comment;
};

// Nanonis' TCP protocol (SPECS, July 2021) as far as its clients use it to approach, scan and move: docs/serve.md lists
// the functions. Any other function is answered with an error text. A scan is done as soon as it is started: simulated
// time never waits for a client.
class NanonisDoor final : public Door {
 public:
  static constexpr double kApproachSpeedM = 1e-6;  // speed of an approach, m/s

  // The instrument must outlive the object.
  explicit NanonisDoor(SimulatedInstrument& instrument);
  ~NanonisDoor() override;

  std::optional<std::size_t> request_size(std::string_view bytes) const override;
  std::size_t most_request_bytes() const override { return std::size_t{1} << 16; }
  std::string_view too_long() const override { return {}; }
  bool announces_too_much(std::string_view bytes) const override;
  Then answer(std::string_view request, const Send& send) override;

 private:
  struct Functions;

  SimulatedInstrument& instrument_;
  std::unique_ptr<const physics::ScanImage> image_;  // newest image; null: none
  bool upwards_ = false;                             // direction of the newest image's scan
  bool feedback_ = true;
  float bias_v_ = 0;                      // bias voltage, stored without effect
  double frame_x_m_ = 0, frame_y_m_ = 0;  // middle of the images, independent of the tip's position
  double follow_speed_m_per_s_ = 1e-6;    // speed with custom_speed_; otherwise the tip moves at its scan speed
  std::uint32_t custom_speed_ = 0;
  bool keeps_speed_ = false;  // true: a wider image takes longer for a line
  std::vector<std::int32_t> channels_{30};
  float speed_ratio_ = 1;  // ratio of retrace and trace, stored without effect: both take equally long
  NanonisProperties properties_;
};

}  // namespace afm::instrument
