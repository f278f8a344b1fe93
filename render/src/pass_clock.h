// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device.h"
#include "render/renderer.h"

namespace afm::render {

// When the passes of one frame in flight began and ended, by the device's own clock.
class PassClock {
 public:
  static bool works_on(const Device& device);

  explicit PassClock(const Device& device);

  // In the order in which a frame reaches them; the first two only where panels are painted.
  enum class Mark : std::uint32_t { PanelsBegin, PanelsEnd, ShadowBegin, ShadowEnd, EyesEnd };

  // Outside any rendering.
  void mark(const vk::raii::CommandBuffer& command, Mark mark) const;

  // Of a frame that is finished.
  PassTimes times(bool panels_painted) const;

 private:
  double between_ms(Mark begin, Mark end) const;

  double ms_per_tick_;
  vk::raii::QueryPool queries_;
};

}  // namespace afm::render
