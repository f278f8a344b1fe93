// SPDX-License-Identifier: Apache-2.0
#include "drivers/driver_thread.h"

#include <future>
#include <utility>

#include "core/log.h"

namespace afm::haptics {

DriverThread::DriverThread(std::function<void()> body) {
  std::promise<RealtimeGrant> granted;
  auto grant = granted.get_future();
  thread_ = std::thread([granted = std::move(granted), body = std::move(body)]() mutable {
    granted.set_value(enter_realtime(kServoPriority, PageLock::Leave));
    body();
  });
  grant_ = grant.get();
  for (const std::string& note : grant_.notes) core::log_line("haptics: the driver's thread: " + note);
}

void DriverThread::join() {
  if (thread_.joinable()) thread_.join();
}

}  // namespace afm::haptics
