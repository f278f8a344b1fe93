// SPDX-License-Identifier: Apache-2.0
#include "core/hurry_threads.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <future>
#include <thread>

namespace afm::core {
namespace hurry_threads_test {

// Nice value that a thread has after it has made itself nice and `after` has run, which another thread may do.
template <typename Function>
int nice_of_a_nice_thread(const Function& after) {
  int nice = 0;
  std::thread([&] {
    const auto self = static_cast<id_t>(::gettid());
    EXPECT_EQ(::setpriority(PRIO_PROCESS, self, 19), 0);
    after(self);
    nice = ::getpriority(PRIO_PROCESS, self);
  }).join();
  return nice;
}

TEST(HurryThreads, TakesBackTheNicenessOfAThreadWhereThatIsAllowed) {
  const int own = ::getpriority(PRIO_PROCESS, static_cast<id_t>(::getpid()));
  const int allowed = nice_of_a_nice_thread([&](id_t self) { ::setpriority(PRIO_PROCESS, self, own); });
  EXPECT_EQ(nice_of_a_nice_thread([](id_t) { std::async(std::launch::async, hurry_threads).get(); }), allowed);
}

}  // namespace hurry_threads_test
}  // namespace afm::core
