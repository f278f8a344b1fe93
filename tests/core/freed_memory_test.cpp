// SPDX-License-Identifier: Apache-2.0
#include "core/freed_memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstddef>
#include <thread>
#include <vector>

namespace afm::core {
namespace freed_memory_test {

constexpr int kTimes = 50;

// Pages that the kernel handed out while arrays of 2 MiB in all were made and freed again and again.
long pages_of_arrays() {
  const auto pages = [] {
    rusage usage{};
    ::getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_minflt;
  };
  const auto make = [] {
    std::vector<std::vector<double>> arrays;
    arrays.reserve(8);
    for (std::size_t i = 0; i < 8; ++i) arrays.emplace_back(32768, 1.0);
    return arrays.back().back();
  };
  double sum = make();
  const long before = pages();
  for (int i = 0; i < kTimes; ++i) sum += make();
  const long after = pages();
  EXPECT_EQ(sum, kTimes + 1.0);
  return after - before;
}

TEST(FreedMemory, IsUsedAgainWithoutTheKernel) {
  EXPECT_GT(pages_of_arrays(), 100 * kTimes) << "without it, each array has new pages";
  keep_freed_memory();
  EXPECT_LT(pages_of_arrays(), kTimes);
  std::jthread([] { EXPECT_LT(pages_of_arrays(), 2 * kTimes) << "in another thread"; }).join();
}

}  // namespace freed_memory_test
}  // namespace afm::core
