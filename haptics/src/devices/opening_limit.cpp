// SPDX-License-Identifier: Apache-2.0
#include "devices/opening_limit.h"

#include <fmt/core.h>
#include <unistd.h>

#include <utility>

#include "core/exit_code.h"
#include "core/run_main.h"

namespace afm::haptics {

OpeningLimit::OpeningLimit(std::string subject, std::chrono::milliseconds limit)
    : thread_([this, subject = std::move(subject), limit] { wait(subject, limit); }) {}

OpeningLimit::~OpeningLimit() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  over_.notify_one();
  thread_.join();
}

void OpeningLimit::wait(const std::string& subject, std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  if (over_.wait_for(lock, limit, [this] { return done_; })) return;
  // the destructors of a hanging library cannot be trusted either
  ::_exit(core::fail(core::ExitCode::DeviceMissing,
                     fmt::format("{}: its driver did not answer within {:g} s; restart the device and its driver, or "
                                 "choose another with --haptics",
                                 subject, std::chrono::duration<double>(limit).count())));
}

}  // namespace afm::haptics
