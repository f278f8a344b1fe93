// SPDX-License-Identifier: Apache-2.0
#include "output/picture_writer.h"

#include <utility>

namespace afm::render {

PictureWriter::PictureWriter() : thread_([this] { run(); }) {}

PictureWriter::~PictureWriter() {
  {
    const std::scoped_lock lock(mutex_);
    leaving_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PictureWriter::write(const ImageSpan& picture, std::string path) {
  {
    const std::scoped_lock lock(mutex_);
    waiting_.push_back({picture, std::move(path)});
  }
  changed_.notify_all();
}

SavedPicture PictureWriter::take_front() {
  SavedPicture done = std::move(done_.front());
  done_.pop_front();
  return done;
}

std::optional<SavedPicture> PictureWriter::take() {
  const std::scoped_lock lock(mutex_);
  return done_.empty() ? std::nullopt : std::optional(take_front());
}

SavedPicture PictureWriter::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !done_.empty(); });
  return take_front();
}

// The lock is open while a picture is encoded and written.
void PictureWriter::run() {
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
