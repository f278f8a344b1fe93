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
  // `place`: a monitor's name or number, which it fills; or kFree for a window that can be moved. DeviceMissing: there
  // is no such monitor. Before the Context, which it must outlive.
  static constexpr const char* kFree = "window";
  static core::Result<render::Window> open_window(const std::string& place,
                                                  const std::vector<render::Monitor>& monitors);

  // Draws into that window. All must outlive it.
  static core::Result<std::unique_ptr<InstructorWindow>> create(render::Context& context, render::Window& window,
                                                                const exhibit::Phrases& phrases,
                                                                render::PanelContrast contrast);
  ~InstructorWindow();

  // What the instructor did since the last call: with the keys 1 to 4, or by a click on an action that acts at
  // `prompt`. Other keys that were pressed are the wall's.
  struct Input {
    std::vector<exhibit::InstructorAction> actions;
    std::vector<render::Key> keys;
    bool close_requested = false;
  };
  Input poll(const exhibit::LessonPrompt& prompt);

  // Once a frame; draws what has changed, and every second anew, since others may have painted over it.
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
