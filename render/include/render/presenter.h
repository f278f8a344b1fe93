// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <span>

#include "core/result.h"
#include "render/renderer.h"
#include "render/window.h"

namespace afm::render {

// Fit of a picture in its window: in its proportions, between black bars, or stretched to the whole window, as for a
// projector whose image ends at the measured corners of the screen.
enum class PictureFit { Proportions, Fill };
struct PicturePlace {
  glm::uvec2 offset_px{0};
  glm::uvec2 size_px{0};
};
PicturePlace picture_place(glm::uvec2 window_px, glm::uvec2 picture_px, PictureFit fit = PictureFit::Proportions);

// Picture of a frame in a window. In mode dual it is the left eye's, since one window has one picture.
struct WindowPicture {
  Composition composition;
  PictureFit fit = PictureFit::Proportions;
};

// Timing of the picture change: each display on its own, or, if the surface offers VK_NV_present_barrier, in the same
// refresh as synchronised displays of other machines.
enum class Swap { Alone, WithOthers };

inline constexpr std::size_t kMostWindows = 16;

// Shows a renderer's frames in windows that are presented together, in step with their display: begin(), then render()
// and draw() for the windows of each screen, then show(). Handles resizing, full screen and loss of a surface. Main
// thread only. Throws DeviceFailure if the device is lost or memory runs out.
class Presenter {
 public:
  // DeviceMissing: the device and the display have no common way to show pictures. All arguments must outlive the
  // presenter; `context` was opened with Presentation::Window. Takes 1 to kMostWindows windows.
  static core::Result<Presenter> create(Context& context, Renderer& renderer, std::span<Window* const> windows,
                                        Swap swap = Swap::Alone);

  Presenter(Presenter&&) noexcept;
  Presenter& operator=(Presenter&&) noexcept;
  ~Presenter();

  // DeviceMissing, with the missing feature: quad-buffer needs a display with a picture for each eye.
  core::Result<void> check_mode(scene::StereoMode mode) const;

  // True if all windows change their picture in step with other machines.
  bool swaps_with_others() const;

  // Acquires the images that the windows show next. `pictures` has one entry per window, in modes that check_mode()
  // allows. Calls `while_waiting` every few milliseconds on this thread. False if no window can show anything now,
  // because all are minimised, have just been resized, or their display accepts no picture; continue and try again with
  // the next frame.
  bool begin(std::span<const WindowPicture> pictures, const std::function<void()>& while_waiting);

  // Draws the renderer's newest frame into those of the given windows that have an image, and waits until it is drawn.
  void draw(std::span<const std::size_t> windows, const std::function<void()>& while_waiting);

  // Shows everything drawn since begin(), in one call: all windows change in the same refresh if the device supports
  // it.
  void show();

 private:
  struct Parts;
  explicit Presenter(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace afm::render
