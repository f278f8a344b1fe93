// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "render/renderer.h"

namespace afm::render {

// Outcome of saving a picture; the error names its path.
struct SavedPicture {
  std::string path;
  core::Result<void> written;
};

// Saves pictures of frames as PNG files while the next frames are drawn: copied by the device, encoded and written by a
// separate thread. A few pictures can be on their way; where there are more, the next waits, and none is lost. The
// thread of the renderer. A lost device and a lack of memory are exceptions: DeviceFailure.
class ScreenshotQueue {
 public:
  // Pictures on their way at once.
  static constexpr std::size_t kMostPictures = 4;

  // Both must outlive it.
  ScreenshotQueue(Context& context, Renderer& renderer);
  ScreenshotQueue(ScreenshotQueue&&) noexcept;
  ScreenshotQueue& operator=(ScreenshotQueue&&) noexcept;
  ~ScreenshotQueue();  // waits, as finish() does

  // Begins to save the renderer's newest frame in a mode with one picture; `path` and `area` as for write_png() and
  // Renderer::read_composed(). False, with nothing begun: kMostPictures are on their way; call collect() and try again
  // with this frame or a later one. Does not wait.
  bool save(const Composition& composition, std::string path, const ReadArea& area = {});

  // Hands on what has been read and returns what has been written since, in the order of save(). Does not wait.
  std::vector<SavedPicture> collect();

  // As collect(), once everything is written.
  std::vector<SavedPicture> finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace afm::render
