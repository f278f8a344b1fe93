// SPDX-License-Identifier: Apache-2.0
#include "app/bench/servo_latency.h"

#include <chrono>
#include <thread>

#include "app/bench/servo_work.h"
#include "core/clock.h"
#include "servo/servo_client.h"

namespace afm::app {

core::Result<ServoWake> measure_servo_wake(const std::string& program, double seconds,
                                           const std::function<void()>& draw) {
  auto link = servo::ServoClient::start(mica_alone(), 0, {}, program);
  if (!link) return tl::unexpected(link.error());
  (*link)->choose(0);

  const core::MonotonicClock clock;
  ServoWake wake;
  std::thread plain([&] { wake.plain = measure_wake_jitter(clock, servo::kServoRateHz, seconds); });
  core::Result<void> ran;
  const std::int64_t end_ns = clock.now_ns() + static_cast<std::int64_t>(1e9 * seconds);
  while (ran && clock.now_ns() < end_ns) {
    if (const auto update = (*link)->poll(clock.now_ns()); !update) ran = tl::unexpected(update.error());
    if (draw) {
      draw();
      ++wake.frames;
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  plain.join();
  if (!ran) return tl::unexpected(ran.error());
  wake.servo = (*link)->timing();
  return wake;
}

}  // namespace afm::app
