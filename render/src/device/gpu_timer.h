// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device/timestamp_queries.h"
#include "render/renderer.h"

namespace afm::render {

// Start and end times of the passes of one frame in flight.
class GpuTimer {
 public:
  explicit GpuTimer(const Device& device);

  // Marks in the order of a frame. A pair is set only if panels are painted, the shadow map is drawn or the eyes are
  // drawn.
  enum class Mark : std::uint32_t { PanelsBegin, PanelsEnd, ShadowBegin, ShadowEnd, EyesBegin, EyesEnd };

  // Must be called outside any rendering.
  void mark(const vk::raii::CommandBuffer& command, Mark mark) const;

  // Times of a finished frame.
  PassTimes times(bool panels_painted, bool shadow_drawn, bool eyes_drawn) const;

 private:
  double between_ms(Mark begin, Mark end) const;

  TimestampQueries stopwatch_;
};

}  // namespace afm::render
