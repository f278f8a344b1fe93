// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

// Bounds in real time, on a machine that may itself stall. A watcher thread does nothing but wake every millisecond;
// its longest delay is the machine's, independent of the program under test.
namespace afm::support {

class StallWatch {
 public:
  StallWatch() : thread_([this] { watch(); }) {}
  StallWatch(const StallWatch&) = delete;
  StallWatch& operator=(const StallWatch&) = delete;
  ~StallWatch() {
    ended_ = true;
    thread_.join();
  }

  struct Stall {
    std::int64_t from_ns, to_ns;  // times on the steady clock
  };
  // Longest stall that overlaps a span of the steady clock.
  std::chrono::nanoseconds longest_between(std::int64_t from_ns, std::int64_t to_ns) const {
    const std::lock_guard lock(mutex_);
    std::int64_t longest_ns = 0;
    for (const Stall& stall : stalls_) {
      if (stall.from_ns < to_ns && stall.to_ns > from_ns)
        longest_ns = std::max(longest_ns, stall.to_ns - stall.from_ns);
    }
    return std::chrono::nanoseconds(longest_ns);
  }

  // Longest delay of a wake-up since construction, including a wake-up that is still due.
  std::chrono::nanoseconds longest() const {
    const std::int64_t overdue_ns = now_ns() - due_ns_.load();
    return std::chrono::nanoseconds(std::max({std::int64_t{0}, longest_ns_.load(), overdue_ns}));
  }

 private:
  static constexpr std::int64_t kPeriodNs = 1'000'000;

  static std::int64_t now_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }

  void watch() {
    while (!ended_) {
      const std::int64_t due_ns = now_ns() + kPeriodNs;
      due_ns_ = due_ns;
      std::this_thread::sleep_for(std::chrono::nanoseconds(kPeriodNs));
      const std::int64_t woken_ns = now_ns();
      longest_ns_ = std::max(longest_ns_.load(), woken_ns - due_ns);
      if (woken_ns - due_ns < kPeriodNs) continue;
      const std::lock_guard lock(mutex_);
      stalls_.push_back({due_ns, woken_ns});
    }
  }

  std::atomic<bool> ended_{false};
  std::atomic<std::int64_t> due_ns_{now_ns() + kPeriodNs}, longest_ns_{0};
  mutable std::mutex mutex_;
  std::vector<Stall> stalls_;  // stalls of at least a millisecond
  std::thread thread_;
};

using Milliseconds = std::chrono::duration<double, std::milli>;

// Duration of an action, and the machine's longest stall during it.
struct Timed {
  Milliseconds took{}, stalled{};
};

template <class Action>
Timed timed(Action&& action) {
  const StallWatch watch;
  const auto begin = std::chrono::steady_clock::now();
  std::forward<Action>(action)();
  return {std::chrono::steady_clock::now() - begin, watch.longest()};
}

// Wake-up delay up to which a machine counts as awake.
inline constexpr Milliseconds kAwake{5.0};

// Fails unless `window`, which returns a Timed, stays within the bound. A window that exceeds it condemns the program
// only if the machine was awake; otherwise another one is tried, three in all. If the machine slept in each of them,
// nothing is proved, and the test fails with the stalls that it saw.
template <class Window>
void expect_within(Milliseconds bound, Window&& window) {
  std::string stalls;
  for (int number = 1; number <= 3; ++number) {
    const Timed seen = window();
    if (testing::Test::HasFailure()) return;
    std::printf("window %d: %.1f ms of at most %.1f ms; longest stall of the machine %.1f ms\n", number,
                seen.took.count(), bound.count(), seen.stalled.count());
    if (seen.took <= bound) return;
    if (seen.stalled <= kAwake) {
      ADD_FAILURE() << "took " << seen.took.count() << " ms, at most " << bound.count()
                    << " ms are allowed, and the machine was awake (" << seen.stalled.count() << " ms late at most)";
      return;
    }
    stalls += (stalls.empty() ? "" : ", ") + std::to_string(seen.stalled.count()) + " ms";
  }
  ADD_FAILURE() << "not judged: in three windows the machine stood still for " << stalls << ", and the bound of "
                << bound.count() << " ms was exceeded each time";
}

}  // namespace afm::support
