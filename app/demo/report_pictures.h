// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/output_folder.h"
#include "core/result.h"
#include "render/screenshot_queue.h"

namespace afm::exhibit {
struct ReportPicture;
}

namespace afm::app {

// Pictures of frames for a report, also saved as PNG files in its folder while the next frames are drawn. Renderer's
// thread.
class ReportPictures {
 public:
  // All arguments must outlive the object.
  ReportPictures(render::Context& context, render::Renderer& renderer, const core::OutputFolder& out);
  ~ReportPictures();

  // Saves the renderer's newest frame, side by side. Waits only if ScreenshotQueue::kMostPictures are pending.
  void add(const std::string& file, const std::string& caption);

  // Returns all pictures, in order. Failed if one could not be written.
  core::Result<std::vector<exhibit::ReportPicture>> finish();

 private:
  void keep_errors(std::vector<render::SavedPicture> saved);

  render::ScreenshotQueue saver_;
  const core::OutputFolder& out_;
  std::vector<exhibit::ReportPicture> pictures_;
  std::vector<std::string> paths_;
  std::vector<core::Error> errors_;
};

}  // namespace afm::app
