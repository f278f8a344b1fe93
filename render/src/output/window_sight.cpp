// SPDX-License-Identifier: Apache-2.0
#include "render/window_sight.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include "core/enumerators.h"
#include "output/window_handle.h"
#include "output/x_sight.h"

namespace afm::render {

namespace {

constexpr int kLookMs = 40;

struct SightText {
  Sight sight;
  const char* text;
};
constexpr std::array kTexts{SightText{Sight::Seen, "the window is visible"},
                            SightText{Sight::Hidden, "the window is minimised, or on another workspace"},
                            SightText{Sight::Covered, "another window covers it"},
                            SightText{Sight::Blanked, "the screen saver or DPMS has blanked the screen"},
                            SightText{Sight::OffMonitors, "no monitor shows the window's place"}};
static_assert(core::has_row_for_each(kTexts, &SightText::sight));

}  // namespace

const char* text_of(Sight sight) { return kTexts[core::index_of(sight)].text; }

struct WindowSight::Watch {
  Watch(std::unique_ptr<XSight> windows, const core::Clock& given) : x(std::move(windows)), clock(given) {
    thread = std::thread([this] { run(); });
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  ~Watch() {
    ending = true;
    ::eventfd_write(wake, 1);
    thread.join();
    ::close(wake);
  }

  void run() {
    while (!ending) {
      const Sight sight = x->look();
      const bool seen = sight == Sight::Seen;
      if (seen) unseen_since_ns = kNever;
      if (!seen && unseen_since_ns == kNever) unseen_since_ns = clock.now_ns();
      newest = sight;
      x->wait(wake, kLookMs);
    }
  }

  static constexpr std::int64_t kNever = -1;

  std::unique_ptr<XSight> x;
  const core::Clock& clock;
  int wake = ::eventfd(0, EFD_CLOEXEC);
  std::atomic<bool> ending = false;
  std::atomic<Sight> newest = Sight::Seen;
  std::atomic<std::int64_t> unseen_since_ns = kNever;
  std::thread thread;
};

WindowSight::WindowSight(std::span<Window* const> windows, const core::Clock& clock) {
  std::vector<std::uint32_t> ids;
  for (Window* const window : windows) {
    if (const auto id = window->handle().x_window()) ids.push_back(*id);
  }
  if (ids.empty() || ids.size() != windows.size()) return;
  if (auto x = XSight::connect(ids)) watch_ = std::make_unique<Watch>(std::move(x), clock);
}

WindowSight::~WindowSight() = default;

Sight WindowSight::newest() const { return watch_ ? watch_->newest.load() : Sight::Seen; }

std::optional<std::int64_t> WindowSight::unseen_since_ns() const {
  const std::int64_t since_ns = watch_ ? watch_->unseen_since_ns.load() : Watch::kNever;
  return since_ns == Watch::kNever ? std::nullopt : std::optional(since_ns);
}

}  // namespace afm::render
