// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/loading_notice.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

namespace afm::scene {

bool LoadingNotice::wait_a_second(const std::stop_token& stop) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any stopped;
  stopped.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; });
  return !stop.stop_requested();
}

LoadingNotice::LoadingNotice(const std::string& file, Wait wait, std::ostream& out)
    : thread_([file, wait = std::move(wait), &out](const std::stop_token& stop) {
        if (wait(stop)) out << "loading " + file + " ...\n" << std::flush;
      }) {}

}  // namespace afm::scene
