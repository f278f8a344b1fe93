// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <memory>

#include "core/result.h"
#include "render/renderer.h"
#include "render/window.h"

namespace afm::render {

// Where a picture lies in a window: as large as fits at its own proportions, in the middle, between black bars.
struct PicturePlace {
  glm::uvec2 offset_px{0};
  glm::uvec2 size_px{0};
};
PicturePlace picture_place(glm::uvec2 window_px, glm::uvec2 picture_px);

// Shows a renderer's frames in a window, in step with its display. Follows the window through resizes, full screen and
// the loss of its surface. The main thread alone. A lost device, and a surface that stays lost, are exceptions:
// DeviceFailure.
class Presenter {
 public:
  // DeviceMissing: the device and the display have no way to show pictures in common. All three must outlive the
  // presenter; `context` was opened with Presentation::Window.
  static core::Result<Presenter> create(Context& context, Window& window, Renderer& renderer);

  Presenter(Presenter&&) noexcept;
  Presenter& operator=(Presenter&&) noexcept;
  ~Presenter();

  // Shows the renderer's newest frame and waits until it has been drawn; meanwhile calls `while_waiting` every few
  // milliseconds, from this thread. False, with nothing shown: the window is minimised, has just changed its size, or
  // its display accepts no picture now; go on and try with the next frame. At least one frame has been rendered.
  bool present(const Composition& composition, const std::function<void()>& while_waiting);

 private:
  struct Parts;
  explicit Presenter(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace afm::render
