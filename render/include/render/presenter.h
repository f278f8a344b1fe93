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

// Shows a renderer's frames in a window, or in two that are presented together, in step with their display. Follows
// the windows through resizes, full screen and the loss of a surface. The main thread alone. A lost device and a lack
// of memory are exceptions: DeviceFailure.
class Presenter {
 public:
  // DeviceMissing: the device and the display have no way to show pictures in common. `second` is the right eye's
  // window for mode dual, or null; in other modes it shows what the first one does. All must outlive the presenter;
  // `context` was opened with Presentation::Window.
  static core::Result<Presenter> create(Context& context, Window& window, Renderer& renderer, Window* second = nullptr);

  Presenter(Presenter&&) noexcept;
  Presenter& operator=(Presenter&&) noexcept;
  ~Presenter();

  // DeviceMissing, saying what is missing: quad-buffer needs a display with a picture for each eye, dual two windows.
  core::Result<void> check_mode(scene::StereoMode mode) const;

  // Shows the renderer's newest frame and waits until it has been drawn; meanwhile calls `while_waiting` every few
  // milliseconds, from this thread. False, with nothing shown: a window is minimised, has just changed its size, or its
  // display accepts no picture now; go on and try with the next frame. At least one frame has been rendered, and
  // check_mode() allows the mode.
  bool present(const Composition& composition, const std::function<void()>& while_waiting);

 private:
  struct Parts;
  explicit Presenter(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace afm::render
