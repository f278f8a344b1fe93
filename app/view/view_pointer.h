// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "app/display/mouse_wand.h"
#include "app/view/pointed.h"
#include "exhibit/words/guidance.h"
#include "input/selection.h"

namespace afm::exhibit {
struct Stage;
class WallScene;
}  // namespace afm::exhibit

namespace afm::app {

class ServoSupervisor;
class ViewPanels;
class ViewPicture;
class ViewWand;

// Grip of the wand that is drawn for the mouse, in metres of the room: below the tab at the right, whose words it would
// cover, unless the shelf's last swatch is there.
glm::dvec3 mouse_grip_m(const exhibit::WallScene& scene);

// Target of the wand or the mouse, whichever was used last. Main thread only.
class ViewPointer {
 public:
  // All arguments must outlive the object.
  ViewPointer(const exhibit::Stage& stage, ViewPicture& picture, ViewPanels& panels, ServoSupervisor& servo,
              ViewWand& wand);

  // Call once a frame. Dragging the hand does not count as pointing.
  void follow(const glm::dvec2& cursor_px, bool dragging, std::int64_t now_ns);

  exhibit::Pointer kind() const;

  // Target of the cursor in a window, or of the wand.
  Pointed at(std::size_t window, const glm::dvec2& cursor_px);
  Pointed at_wand();
  Pointed now(std::size_t window, const glm::dvec2& cursor_px);  // target of the device used last

  input::Ray ray(std::size_t window, const glm::dvec2& cursor_px) const;

  // Wand to draw; the mouse has one too, but not while it drags the hand.
  std::optional<input::WandState> drawn(const Pointed& pointed, std::int64_t now_ns) const;

  // Hand travel per pixel that keeps the tip under the cursor.
  double hand_m_per_px(std::size_t window) const;

 private:
  const exhibit::Stage& stage_;
  ViewPicture& picture_;
  ViewPanels& panels_;
  ServoSupervisor& servo_;
  ViewWand& view_wand_;
  MouseWand mouse_;
  std::vector<input::Target> swatches_;
  glm::dvec2 cursor_px_{0.0};
  std::int64_t cursor_moved_ns_ = 0;
  bool dragging_ = false;
};

}  // namespace afm::app
