// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "render/context.h"
#include "render/monitor.h"
#include "render/presenter.h"
#include "render/renderer.h"
#include "render/window.h"

namespace afm::exhibit {
enum class InstructorAction;
class InstructorPage;
struct InstructorState;
struct LessonPrompt;
class Phrases;
}  // namespace afm::exhibit

namespace afm::app {

// The window in which an instructor follows a lesson, on a monitor that the participant does not see. Main thread only.
class InstructorWindow {
 public:
  // `place`: name or number of a monitor to fill, or kFree for a movable window. DeviceMissing if there is no such
  // monitor. Open it before the Context, and keep it until the Context is gone.
  static constexpr const char* kFree = "window";
  static core::Result<render::Window> open_window(const std::string& place,
                                                  const std::vector<render::Monitor>& monitors);

  // Prepares drawing into that window. All arguments must outlive the object.
  static core::Result<std::unique_ptr<InstructorWindow>> create(render::Context& context, render::Window& window,
                                                                const exhibit::Phrases& phrases,
                                                                render::PanelContrast contrast);
  ~InstructorWindow();

  // The instructor's input since the last call: keys 1 to 4, or a click on an action that applies to `prompt`. All
  // other keys belong to the wall.
  struct Input {
    std::vector<exhibit::InstructorAction> actions;
    std::vector<render::Key> keys;
    bool close_requested = false;
  };
  Input poll(const exhibit::LessonPrompt& prompt);

  // Call once a frame. Draws the changes, and redraws every second, since another window may have covered it.
  void show(const exhibit::InstructorState& state, std::int64_t now_ns, const std::function<void()>& while_waiting);

 private:
  InstructorWindow(render::Window& window, const exhibit::Phrases& phrases, render::Renderer renderer,
                   render::Presenter presenter, glm::uvec2 size_px);
  void follow_size();

  render::Window& window_;
  const exhibit::Phrases& phrases_;
  render::Renderer renderer_;
  render::Presenter presenter_;
  glm::uvec2 size_px_;
  std::unique_ptr<exhibit::InstructorPage> page_;
  std::optional<exhibit::InstructorAction> pointed_;
  std::optional<render::DataPanel> shown_;
  std::vector<render::Label> shown_labels_;
  std::int64_t shown_ns_ = 0;
};

}  // namespace afm::app
