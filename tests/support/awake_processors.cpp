// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <atomic>
#include <thread>
#include <vector>

// With the idlers below every fork is one of several threads, and ThreadSanitizer would end a child that starts
// another.
extern "C" const char* __tsan_default_options();
extern "C" const char* __tsan_default_options() { return "die_after_fork=0"; }

namespace afm::support {
namespace {

// While the tests of real time run, every processor has something to do, at the priority that gives way to everything
// else. A virtual processor that sleeps may be woken tens of milliseconds late, which the servo rightly takes for a
// stall; one that is awake is on time, as that of a machine with a device is.
class AwakeProcessors : public testing::Environment {
 public:
  void SetUp() override {
    for (unsigned i = 0; i < std::thread::hardware_concurrency(); ++i) {
      idlers_.emplace_back([this] {
        const sched_param lowest{};
        ::pthread_setschedparam(::pthread_self(), SCHED_IDLE, &lowest);
        while (!ended_.load(std::memory_order_relaxed)) {
        }
      });
    }
  }

  void TearDown() override {
    ended_ = true;
    for (std::thread& idler : idlers_) idler.join();
  }

 private:
  std::atomic<bool> ended_{false};
  std::vector<std::thread> idlers_;
};

[[maybe_unused]] const testing::Environment* const kAwake = testing::AddGlobalTestEnvironment(new AwakeProcessors);

}  // namespace
}  // namespace afm::support
