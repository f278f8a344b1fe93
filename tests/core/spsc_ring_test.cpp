// SPDX-License-Identifier: Apache-2.0
#include "core/spsc_ring.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <random>
#include <thread>

namespace spsc_ring_test {

using afm::core::SpscRing;

TEST(SpscRing, KeepsTheOrder) {
  SpscRing<int, 4> ring;
  EXPECT_FALSE(ring.pop());
  EXPECT_TRUE(ring.push(1));
  EXPECT_TRUE(ring.push(2));
  EXPECT_EQ(ring.pop(), 1);
  EXPECT_TRUE(ring.push(3));
  EXPECT_EQ(ring.pop(), 2);
  EXPECT_EQ(ring.pop(), 3);
  EXPECT_FALSE(ring.pop());
}

TEST(SpscRing, CountsWhatDoesNotFitAndKeepsTheOldest) {
  SpscRing<int, 4> ring;
  for (int i = 0; i < 7; ++i) EXPECT_EQ(ring.push(i), i < 4);
  EXPECT_EQ(ring.dropped(), 3U);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(ring.pop(), i);
  EXPECT_FALSE(ring.pop());
  EXPECT_TRUE(ring.push(7));
  EXPECT_EQ(ring.pop(), 7);
}

TEST(SpscRing, LosesNothingBetweenTwoThreads) {
  constexpr std::uint64_t kValues = 300'000;
  SpscRing<std::array<std::uint64_t, 8>, 1024> ring;
  std::thread producer([&] {
    for (std::uint64_t i = 0; i < kValues;) {
      std::array<std::uint64_t, 8> value;
      value.fill(i);
      if (ring.push(value)) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  for (std::uint64_t expected = 0; expected < kValues;) {
    const auto value = ring.pop();
    if (!value) {
      std::this_thread::yield();
      continue;
    }
    for (const std::uint64_t word : *value) ASSERT_EQ(word, expected);
    ++expected;
  }
  producer.join();
}

// The indices are the first words of the first two cache lines.
TEST(SpscRing, SurvivesGarbageInItsIndices) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 1000; ++round) {
    SpscRing<int, 8> ring;
    ring.push(1);
    const std::array<std::uint64_t, 2> garbage{random(), random()};
    std::memcpy(reinterpret_cast<char*>(&ring), &garbage[0], sizeof(std::uint64_t));
    std::memcpy(reinterpret_cast<char*>(&ring) + 64, &garbage[1], sizeof(std::uint64_t));

    // at most the capacity is popped, and then the ring works again
    int popped = 0;
    while (ring.pop()) ++popped;
    EXPECT_LE(popped, 8);
    EXPECT_TRUE(ring.push(5));
    EXPECT_EQ(ring.pop(), 5);
  }
}

}  // namespace spsc_ring_test
