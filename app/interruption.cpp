// SPDX-License-Identifier: Apache-2.0
#include "app/interruption.h"

#include <atomic>
#include <csignal>

namespace afm::app {

namespace {

// a signal handler can reach nothing but a global
std::atomic<bool> interruption{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int) { interruption.store(true, std::memory_order_relaxed); }

}  // namespace

void catch_interruptions() {
  struct sigaction action{};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return interruption.load(std::memory_order_relaxed); }

}  // namespace afm::app
