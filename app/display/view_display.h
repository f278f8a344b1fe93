// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/display/display_options.h"
#include "app/display/view_outputs.h"
#include "app/display/view_picture.h"
#include "app/display/view_windows.h"
#include "core/result.h"
#include "render/context.h"
#include "render/saver_inhibition.h"

namespace afm::core {
class Clock;
}
namespace afm::render {
class HeadsetRuntime;
}

namespace afm::app {

class InstructorWindow;
class ViewHeadset;

// The windows of the live view with everything that draws into them. Main thread only.
class ViewDisplay {
 public:
  // `stage` must outlive the object. Fails as plan_view, ViewWindows and Context do, or if the display does not suit
  // the stereo mode. `runtime` is the runtime of the headset that shows the picture, whose left eye the windows then
  // mirror; it may be null, and must outlive the object, as must the clock.
  static core::Result<std::unique_ptr<ViewDisplay>> open(const exhibit::Stage& stage, const DisplayOptions& options,
                                                         render::HeadsetRuntime* runtime, const core::Clock& clock);
  ~ViewDisplay();
  ViewDisplay(const ViewDisplay&) = delete;
  ViewDisplay& operator=(const ViewDisplay&) = delete;

  ViewWindows& windows() { return *windows_; }
  ViewPicture& picture() { return *picture_; }
  render::Context& context() { return *context_; }
  InstructorWindow* instructor() { return instructor_.get(); }  // may be null
  ViewHeadset* headset() { return headset_.get(); }             // may be null

 private:
  ViewDisplay();
  render::RendererOptions drawing(const exhibit::Stage& stage, const DisplayOptions& options) const;
  core::Result<void> check_outputs(render::Swap swap) const;
  static render::RendererOptions drawing_in_headset(const exhibit::Stage& stage, glm::uvec2 eye_px);

  std::vector<ViewOutput> outputs_;
  std::optional<ViewWindows> windows_;
  std::optional<render::Window> instructor_window_;
  std::optional<render::Context> context_;
  std::optional<render::Renderer> renderer_;
  std::optional<render::Presenter> presenter_;
  std::unique_ptr<ViewHeadset> headset_;
  std::optional<ViewPicture> picture_;
  std::unique_ptr<InstructorWindow> instructor_;
  render::SaverInhibition awake_;
};

}  // namespace afm::app
