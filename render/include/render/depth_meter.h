// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "render/renderer.h"

namespace afm::render {

// Nearest and farthest depth in a frame, over both eyes: metres from the plane through the eye parallel to the wall.
struct DepthRange {
  double nearest_m = 0;
  double farthest_m = 0;
};

// Reduces the eyes' depth to its extremes on the device, without waiting for it. Renderer's thread.
class DepthMeter {
 public:
  // Both must outlive it.
  DepthMeter(Context& context, Renderer& renderer);
  DepthMeter(DepthMeter&&) noexcept;
  DepthMeter& operator=(DepthMeter&&) noexcept;
  ~DepthMeter();

  // Begins with the renderer's newest frame, unless an earlier measurement is still under way.
  void measure();

  // Of the newest measurement that is finished; nothing before the first, or when nothing was drawn.
  std::optional<DepthRange> newest();

  // Waits for the measurement under way.
  void wait();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace afm::render
