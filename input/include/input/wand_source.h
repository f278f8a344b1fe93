// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "core/latest_value.h"
#include "input/wand.h"

namespace afm::input {

// Source of a wand's state. Used by one thread, which may wait in it.
class WandSource {
 public:
  WandSource() = default;
  WandSource(const WandSource&) = delete;
  WandSource& operator=(const WandSource&) = delete;
  virtual ~WandSource() = default;

  // Processes the input, waiting for it for at most 10 ms, and returns the newest state. Never fails: a missing wand is
  // not `connected`.
  virtual WandState poll() = 0;
};

// Polls a source in a separate thread and publishes the newest state.
class WandThread {
 public:
  explicit WandThread(std::unique_ptr<WandSource> source);
  WandThread(const WandThread&) = delete;
  WandThread& operator=(const WandThread&) = delete;
  ~WandThread();

  // Newest state; not connected before the first one. Any thread.
  WandState newest() const { return newest_.load().value_or(WandState{}); }

 private:
  void run();

  std::unique_ptr<WandSource> source_;
  core::LatestValue<WandState> newest_;
  std::atomic<bool> ending_{false};
  std::thread thread_;  // last member, because the thread uses all the others
};

}  // namespace afm::input
