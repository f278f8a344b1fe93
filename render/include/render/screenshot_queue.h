// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "render/renderer.h"

namespace afm::render {

// Result of saving a picture; the error names its path.
struct SavedPicture {
  std::string path;
  core::Result<void> written;
};

// Saves pictures of frames as PNG files while the next frames are drawn: the device copies them, and a separate thread
// encodes and writes them. At most kMostPictures are in progress; the next one waits, and none is lost. Renderer's
// thread. Throws DeviceFailure if the device is lost or memory runs out.
class ScreenshotQueue {
 public:
  // Largest number of pictures in progress.
  static constexpr std::size_t kMostPictures = 4;

  // Both arguments must outlive the object.
  ScreenshotQueue(Context& context, Renderer& renderer);
  ScreenshotQueue(ScreenshotQueue&&) noexcept;
  ScreenshotQueue& operator=(ScreenshotQueue&&) noexcept;
  ~ScreenshotQueue();  // waits like finish()

  // Starts saving the renderer's newest frame in a mode with one picture; `path` and `area` as in write_png() and
  // Renderer::read_composed(). Returns false and saves nothing if kMostPictures are in progress: call collect(), and
  // try again with this frame or a later one. Does not wait.
  bool save(const Composition& composition, std::string path, const ReadArea& area = {});

  // Passes on the pictures that have been read, and returns those written since the last call, in the order of save().
  // Does not wait.
  std::vector<SavedPicture> collect();

  // Like collect(), after everything is written.
  std::vector<SavedPicture> finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace afm::render
