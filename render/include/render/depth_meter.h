// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "render/renderer.h"

namespace afm::render {

// Nearest and farthest depth in a frame, over both eyes, in metres from the plane through the eye parallel to the wall.
struct DepthRange {
  double nearest_m = 0;
  double farthest_m = 0;
};

// Finds the extremes of the eyes' depth on the device, without waiting for it. Renderer's thread.
class DepthMeter {
 public:
  // Both arguments must outlive the object.
  DepthMeter(Context& context, Renderer& renderer);
  DepthMeter(DepthMeter&&) noexcept;
  DepthMeter& operator=(DepthMeter&&) noexcept;
  ~DepthMeter();

  // Measures the renderer's newest frame, unless an earlier measurement is still running.
  void measure();

  // Newest finished measurement; nothing before the first, or if nothing was drawn.
  std::optional<DepthRange> newest();

  // Waits for the running measurement.
  void wait();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace afm::render
