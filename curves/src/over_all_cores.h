// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

#include "core/log.h"

namespace afm::curves {

// Number of cores that this thread, and those that it starts, may use.
inline unsigned usable_cores() {
  cpu_set_t cores;
  if (::sched_getaffinity(0, sizeof cores, &cores) != 0) return std::max(1U, std::thread::hardware_concurrency());
  return static_cast<unsigned>(CPU_COUNT(&cores));
}

// Runs work(i) for every i below `count` on all cores, until a stop is requested. Logs the progress of a sweep that
// takes longer than a second.
template <class Work>
void over_all_cores(std::uint64_t count, const std::stop_token& stop, const Work& work) {
  std::atomic<std::uint64_t> next{0}, done{0};
  std::mutex mutex;
  std::condition_variable changed;
  unsigned running = usable_cores();
  const auto run = [&] {
    for (std::uint64_t i; !stop.stop_requested() && (i = next.fetch_add(1)) < count; done.fetch_add(1)) work(i);
    const std::lock_guard lock(mutex);
    --running;
    changed.notify_one();
  };
  std::vector<std::jthread> threads;
  for (unsigned t = running; t > 0; --t) threads.emplace_back(run);
  std::unique_lock lock(mutex);
  while (!changed.wait_for(lock, std::chrono::seconds(1), [&] { return running == 0; })) {
    const std::uint64_t finished = done.load();
    core::log_line(fmt::format("sweep: {} of {} points, {} %", finished, count, 100 * finished / count));
  }
}

}  // namespace afm::curves
