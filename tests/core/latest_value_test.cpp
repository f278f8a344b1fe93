// SPDX-License-Identifier: Apache-2.0
#include "core/latest_value.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <new>
#include <thread>

#include "support/deep.h"

namespace latest_value_test {

using afm::core::LatestValue;

// Block whose words are all equal if it is whole.
using Block = std::array<std::uint64_t, 64>;

Block filled(std::uint64_t number) {
  Block block;
  block.fill(number);
  return block;
}

bool whole(const Block& block) {
  for (const std::uint64_t word : block) {
    if (word != block[0]) return false;
  }
  return true;
}

TEST(LatestValue, IsEmptyBeforeTheFirstStore) {
  const LatestValue<int> channel;
  EXPECT_FALSE(channel.try_load());
  EXPECT_FALSE(channel.load());
}

TEST(LatestValue, GivesTheNewestValueAgainAndAgain) {
  LatestValue<int> channel;
  channel.store(1);
  channel.store(2);
  EXPECT_EQ(channel.try_load(), 2);
  EXPECT_EQ(channel.load(), 2);
}

TEST(LatestValue, GivesWhatIsNewOnlyOnce) {
  LatestValue<int> channel;
  std::uint64_t seen = 0;
  EXPECT_FALSE(channel.try_load_newer(seen));
  channel.store(7);
  EXPECT_EQ(channel.try_load_newer(seen), 7);
  EXPECT_FALSE(channel.try_load_newer(seen));
  channel.store(7);
  EXPECT_EQ(channel.try_load_newer(seen), 7);
}

TEST(LatestValue, CarriesTypesWhoseSizeIsNoMultipleOfAWord) {
  LatestValue<std::array<char, 13>> channel;
  channel.store({"twelve bytes"});
  EXPECT_STREQ(channel.load()->data(), "twelve bytes");
}

TEST(LatestValue, IsNeverTornAndNeverGoesBack) {
  constexpr std::uint64_t kStores = 200'000;
  LatestValue<Block> channel;
  std::atomic<bool> reading{false};
  std::thread reader([&] {
    std::uint64_t last = 0;
    while (last < kStores) {
      reading = true;
      const auto block = channel.try_load();
      if (!block) continue;
      ASSERT_TRUE(whole(*block));
      ASSERT_GE((*block)[0], last);
      last = (*block)[0];
    }
  });
  while (!reading) std::this_thread::yield();
  for (std::uint64_t i = 1; i <= kStores; ++i) channel.store(filled(i));
  reader.join();
}

// The channel in memory that outlives its writer.
class SharedChannel {
 public:
  SharedChannel()
      : memory_(::mmap(nullptr, sizeof(LatestValue<Block>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)),
        channel_(new(memory_) LatestValue<Block>) {}
  SharedChannel(const SharedChannel&) = delete;
  SharedChannel& operator=(const SharedChannel&) = delete;
  ~SharedChannel() { ::munmap(memory_, sizeof(LatestValue<Block>)); }

  LatestValue<Block>& operator*() { return *channel_; }

 private:
  void* memory_;
  LatestValue<Block>* channel_;
};

TEST(LatestValue, OutlivesAWriterKilledAtAnyMoment) {
  const int kills = afm::support::draws(200);
  int left_in_the_middle = 0;
  for (int kill_number = 0; kill_number < kills; ++kill_number) {
    SharedChannel channel;
    const pid_t writer = ::fork();
    ASSERT_GE(writer, 0);
    if (writer == 0) {
      for (std::uint64_t i = 1;; ++i) (*channel).store(filled(i));
    }
    while (!(*channel).load()) std::this_thread::yield();
    for (int spin = 0; spin < 20 * kill_number; ++spin) ASSERT_TRUE(whole((*channel).load().value_or(filled(0))));
    ::kill(writer, SIGKILL);
    ASSERT_EQ(::waitpid(writer, nullptr, 0), writer);

    // either whole or empty, and in bounded time, since the loop inside has a fixed number of attempts
    const auto left = (*channel).load();
    if (left) {
      EXPECT_TRUE(whole(*left));
    } else {
      ++left_in_the_middle;
    }

    // a successor heals it
    (*channel).store(filled(42));
    const auto healed = (*channel).load();
    ASSERT_TRUE(healed);
    EXPECT_EQ(*healed, filled(42));
  }
  std::printf("the writer died in the middle of a store in %d of %d kills\n", left_in_the_middle, kills);
}

}  // namespace latest_value_test
