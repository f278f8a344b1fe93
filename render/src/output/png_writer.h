// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "render/image_file.h"
#include "render/screenshot_queue.h"

namespace afm::render {

// Thread that writes pictures as PNG files, one after the other. One other thread may call.
class PngWriter {
 public:
  PngWriter();
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
  ~PngWriter();  // waits until all pictures are written

  // Queues a picture without waiting. Its pixels must not change until take() or wait() returns its result.
  void write(const ImageSpan& picture, std::string path);

  // Result of the oldest finished picture not yet taken. take() does not wait; wait() requires an untaken picture.
  std::optional<SavedPicture> take();
  SavedPicture wait();

 private:
  struct Order {
    ImageSpan picture;
    std::string path;
  };
  void run();
  SavedPicture take_front();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Order> waiting_;
  std::deque<SavedPicture> done_;
  bool leaving_ = false;
  std::thread thread_;  // last member: it uses all the others
};

}  // namespace afm::render
