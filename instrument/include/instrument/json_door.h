// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "curves/recorded_curve.h"
#include "instrument/simulated_instrument.h"
#include "physics/imaging/scan_image.h"

namespace afm::instrument {

inline constexpr std::size_t kMostRequestBytes = std::size_t{1} << 20;

// Answers requests to an instrument, one JSON object a line (docs/serve.md). A request is hostile input: whatever it is,
// it is answered, and none is trusted. One thread.
class JsonDoor {
 public:
  // Sends one line, without its end; false: nobody reads any more.
  using Send = std::function<bool(std::string_view line)>;

  // `folder` is where "save" writes; empty: nowhere. The instrument must outlive the object.
  JsonDoor(SimulatedInstrument& instrument, std::string folder);

  enum class Then { GoOn, Quit };

  // Sends the lines of a scan, and one answer.
  Then answer(std::string_view request, const Send& send);

 private:
  struct Verbs;

  SimulatedInstrument& instrument_;
  std::string folder_;
  std::optional<physics::ScanImage> image_;     // newest, for "save"
  std::optional<curves::RecordedCurve> curve_;  // newest, for "save"
};

}  // namespace afm::instrument
