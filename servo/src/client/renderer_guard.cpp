// SPDX-License-Identifier: Apache-2.0
#include "renderer_guard.h"

#include <sys/eventfd.h>

#include "core/log.h"
#include "haptics/realtime.h"

namespace afm::servo {

namespace {

constexpr int kWakeMs = 20;

}  // namespace

RendererGuard::RendererGuard(int lifeline, int process, scene::SharedSegment& segment)
    : dismissal_(::eventfd(0, EFD_CLOEXEC)),
      guard_(lifeline, process, segment,
             {.wake = kWakeMs, .release = kRendererReleaseMs, .kill = kRendererKillMs, .close = kRendererCloseMs}),
      thread_([this] { watch(); }) {}

RendererGuard::~RendererGuard() {
  ::eventfd_write(dismissal_.get(), 1);
  thread_.join();
}

void RendererGuard::watch() {
  // the servo logs whatever is refused here too
  haptics::enter_realtime(haptics::kMonitorPriority, haptics::PageLock::Leave);
  if (guard_.watch(ForceGuard::Beats::No, dismissal_.get()) == ForceGuard::End::Stuck) {
    core::log_line("the servo stopped responding, and so did its watchdog: ended it, no force reaches the hand");
  }
}

}  // namespace afm::servo
