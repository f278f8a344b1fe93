// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtx/quaternion.hpp>
#include <mutex>
#include <string>
#include <thread>

#include "support/network/loopback_sender.h"

namespace afm::support {

// A tracker that sends a head and a Flystick through a real socket, 100 times a second with garbage in between, for
// the object's lifetime. Its frame is DTrack's: z upwards, y towards the wall.
class Tracker {
 public:
  Tracker() : thread_([this] { run(); }) {}
  Tracker(const Tracker&) = delete;
  Tracker& operator=(const Tracker&) = delete;
  ~Tracker() {
    ending_ = true;
    thread_.join();
  }

  // Falls silent, like a pulled cable, until there is something to show again.
  void fall_silent() {
    const std::lock_guard lock(changing_);
    lines_.clear();
  }

  std::string place() const { return "127.0.0.1:" + std::to_string(sender_.port()); }

  void show(const glm::dvec3& hand_m, const glm::dvec3& target_m, unsigned buttons,
            const glm::dvec3& head_m = {0.0, 1.65, 2.0}) {
    const glm::dquat q = glm::rotation(glm::dvec3(0.0, 0.0, -1.0), glm::normalize(target_m - hand_m));
    const auto in_tracker = [](const glm::dvec3& p) { return glm::dvec3(p.x, -p.z, p.y); };
    const glm::dmat3 in_room(q);
    const glm::dmat3 r(in_tracker(in_room[0]), in_tracker(in_room[1]), in_tracker(in_room[2]));
    const glm::dvec3 head_mm = 1e3 * in_tracker(head_m), hand_mm = 1e3 * in_tracker(hand_m);
    char line[512];
    std::snprintf(
        line, sizeof line,
        "6d 1 [2 1.000][%.3f %.3f %.3f 0 0 0][1 0 0 0 1 0 0 0 1]\n"
        "6df2 1 1 [0 1.000 6 2][%.3f %.3f %.3f][%.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f][%u 0.00 0.00]\n",
        head_mm.x, head_mm.y, head_mm.z, hand_mm.x, hand_mm.y, hand_mm.z, r[0].x, r[0].y, r[0].z, r[1].x, r[1].y,
        r[1].z, r[2].x, r[2].y, r[2].z, buttons);
    const std::lock_guard lock(changing_);
    lines_ = line;
  }

 private:
  void run() {
    for (int frame = 0; !ending_; ++frame) {
      {
        const std::lock_guard lock(changing_);
        if (!lines_.empty()) sender_.send("fr " + std::to_string(frame) + "\n" + lines_);
      }
      for (int i = 0; i < 10; ++i) sender_.send(std::string(40, static_cast<char>(frame + i)));
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

  const LoopbackSender sender_;
  std::mutex changing_;
  std::string lines_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace afm::support
