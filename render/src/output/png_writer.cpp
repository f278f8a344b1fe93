// SPDX-License-Identifier: Apache-2.0
#include "output/png_writer.h"

#include <utility>

namespace afm::render {

PngWriter::PngWriter() : thread_([this] { run(); }) {}

PngWriter::~PngWriter() {
  {
    const std::scoped_lock lock(mutex_);
    leaving_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PngWriter::write(const ImageSpan& picture, std::string path) {
  {
    const std::scoped_lock lock(mutex_);
    waiting_.push_back({picture, std::move(path)});
  }
  changed_.notify_all();
}

SavedPicture PngWriter::take_front() {
  SavedPicture done = std::move(done_.front());
  done_.pop_front();
  return done;
}

std::optional<SavedPicture> PngWriter::take() {
  const std::scoped_lock lock(mutex_);
  return done_.empty() ? std::nullopt : std::optional(take_front());
}

SavedPicture PngWriter::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !done_.empty(); });
  return take_front();
}

// Releases the lock while a picture is encoded and written.
void PngWriter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return leaving_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    Order order = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    auto written = write_png(order.picture, order.path);
    lock.lock();
    done_.push_back({std::move(order.path), std::move(written)});
    changed_.notify_all();
  }
}

}  // namespace afm::render
