// SPDX-License-Identifier: Apache-2.0
// Invariant: a killed node is dropped after three frames and comes back with every curve
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cluster/membership.h"

namespace membership_test {

using namespace afm::cluster;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::int64_t kFrameNs = 16'700'000, kMs = 1'000'000;
constexpr std::uint64_t kDigest = 77;

// Two nodes, frame by frame, with a clock that the test sets.
class MembershipTest : public testing::Test {
 protected:
  void answer(std::uint32_t node, std::uint64_t number, std::uint64_t digest = kDigest) {
    ReadyMessage ready{.header = {.node = node, .number = number}, .state = NodeState::Drawing, .digest = digest};
    membership_.answer(ready, now_ns_);
  }

  // Lets both nodes answer in time three times.
  void join() {
    for (int i = 0; i < Membership::kLeastInTime; ++i) {
      begin();
      answer(0, number_);
      answer(1, number_);
      lines_ = membership_.end();
    }
  }

  void begin() {
    now_ns_ += kFrameNs;
    membership_.begin(++number_, kDigest, now_ns_);
    membership_.drawn(now_ns_);
  }

  // Time for which the master waits for the frame.
  std::int64_t waited_ns() const {
    for (std::int64_t waited = 0;; waited += kMs / 10) {
      if (membership_.complete(now_ns_ + waited)) return waited;
    }
  }

  Membership membership_{{"left", "right"}};
  std::vector<std::string> lines_;
  std::uint64_t number_ = 0;
  std::int64_t now_ns_ = 1'000'000'000;
};

TEST_F(MembershipTest, WaitsForNobodyBeforeThreeAnswersInTime) {
  begin();
  EXPECT_EQ(waited_ns(), 0);
  EXPECT_EQ(membership_.missing(), 3U);
  join();
  EXPECT_EQ(membership_.missing(), 0U);
  EXPECT_THAT(lines_, ElementsAre(HasSubstr("left shows"), HasSubstr("right shows")));
}

TEST_F(MembershipTest, WaitsUntilAllAreReady) {
  join();
  begin();
  answer(0, number_);
  EXPECT_FALSE(membership_.complete(now_ns_ + 49 * kMs));
  answer(1, number_);
  EXPECT_EQ(waited_ns(), 0);
  EXPECT_THAT(membership_.end(), IsEmpty());
}

TEST_F(MembershipTest, GivesUpADeadNodeAfterThreeFramesAnd150Ms) {
  join();
  std::int64_t waited = 0;
  for (int i = 0; i < Membership::kMostMissed; ++i) {
    begin();
    answer(0, number_);
    waited += waited_ns();
    lines_ = membership_.end();
  }
  EXPECT_LE(waited, 150 * kMs);
  EXPECT_THAT(lines_, ElementsAre(HasSubstr("right is missing")));
  EXPECT_EQ(membership_.missing(), 2U);
  EXPECT_EQ(membership_.nodes()[1].timeouts, 3U);
  begin();
  answer(0, number_);
  EXPECT_EQ(waited_ns(), 0);
}

TEST_F(MembershipTest, WaitsLongerWhereTheMasterItselfIsSlowButNotWithoutEnd) {
  join();
  for (const std::int64_t drawing_ms : {20, 100, 1000}) {
    membership_.begin(++number_, kDigest, now_ns_);
    now_ns_ += drawing_ms * kMs;
    membership_.drawn(now_ns_);
    answer(0, number_);
    EXPECT_EQ(waited_ns(), std::clamp<std::int64_t>(drawing_ms, 50, 150) * kMs);
    answer(1, number_);
    membership_.end();
  }
}

TEST_F(MembershipTest, OneLateFrameForgetsNothing) {
  join();
  for (int i = 0; i < 20; ++i) {
    begin();
    answer(0, number_);
    if (i % 3 == 0) answer(1, number_);
    EXPECT_THAT(membership_.end(), IsEmpty());
  }
  EXPECT_EQ(membership_.missing(), 0U);
}

TEST_F(MembershipTest, TakesBackANodeThatAnswersThreeFramesInARow) {
  join();
  for (int i = 0; i < 5; ++i) {
    begin();
    answer(0, number_);
    membership_.end();
  }
  ASSERT_EQ(membership_.missing(), 2U);
  // answers after their frame was shown, one of them too late
  for (const std::int64_t after_ms : {5, 5, 60, 5, 5}) {
    begin();
    answer(0, number_);
    membership_.end();
    now_ns_ += after_ms * kMs;
    answer(1, number_);
    EXPECT_EQ(membership_.missing(), 2U);
  }
  begin();
  answer(1, number_);
  EXPECT_EQ(membership_.missing(), 0U);
}

TEST_F(MembershipTest, AnswersOfLongAgoOrOfNobodyCountForNothing) {
  begin();
  const std::uint64_t first = number_;
  for (int i = 0; i < 10; ++i) begin();
  answer(0, first);
  answer(0, number_ + 5);
  answer(7, number_);
  EXPECT_EQ(membership_.nodes()[0].last_ready, 0U);
  begin();
  now_ns_ += 200 * kMs;
  answer(0, number_);
  EXPECT_EQ(membership_.nodes()[0].in_time, 0);
}

TEST_F(MembershipTest, TakesBackANodeThatLeavesOutFramesAsLongAsNobodyWaitsForIt) {
  join();
  for (int i = 0; i < 5; ++i) {
    begin();
    answer(0, number_);
    membership_.end();
  }
  for (int i = 0; i < 2 * Membership::kLeastInTime; ++i) {
    begin();
    answer(0, number_);
    membership_.end();
    if (i % 2 == 0) answer(1, number_);
  }
  EXPECT_EQ(membership_.missing(), 0U);
}

TEST_F(MembershipTest, NamesANodeThatBuildsAnotherFrame) {
  join();
  begin();
  answer(0, number_, kDigest + 1);
  answer(1, number_);
  EXPECT_THAT(membership_.end(), ElementsAre(HasSubstr("node left built frame")));
  EXPECT_EQ(membership_.nodes()[0].other_frames, 1U);
  EXPECT_EQ(membership_.nodes()[1].other_frames, 0U);
}

TEST_F(MembershipTest, NamesANodeOfAnotherBuildOnce) {
  ReadyMessage ready{.header = {.node = 1, .number = 1}, .state = NodeState::OtherBuild, .digest = 9};
  membership_.answer(ready, now_ns_);
  membership_.answer(ready, now_ns_);
  begin();
  EXPECT_THAT(membership_.end(), ElementsAre(HasSubstr("right was refused: it is another build")));
  EXPECT_EQ(membership_.missing(), 3U);
}

}  // namespace membership_test
