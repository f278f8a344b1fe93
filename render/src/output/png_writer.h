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

// A thread that writes pictures as PNG files, one after the other. One other thread gives and takes.
class PngWriter {
 public:
  PngWriter();
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
  ~PngWriter();  // once all is written

  // The pixels must not change until take() or wait() reports the outcome. Does not wait.
  void write(const ImageSpan& picture, std::string path);

  // The oldest picture that is done and was not taken yet. take() does not wait; before wait() something was given that
  // was not taken.
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
  std::thread thread_;  // last: it uses everything above
};

}  // namespace afm::render
