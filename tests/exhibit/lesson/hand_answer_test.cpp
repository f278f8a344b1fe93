// SPDX-License-Identifier: Apache-2.0
// Invariant: a question can be answered by hand alone, but only after a movement
#include "exhibit/lesson/hand_answer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace afm::exhibit {
namespace hand_answer_test {

using Layout = HandAnswer::Layout;

constexpr int kFramesPerS = 60;

class HandAnswerTest : public ::testing::Test {
 protected:
  bool add(double height_m, std::uint64_t presses) {
    now_s_ += 1.0 / kFramesPerS;
    return answer_.add(height_m, presses, now_s_);
  }
  // Moves from one height to the other, without a press.
  void moves(double from_m, double to_m) {
    constexpr int kFrames = 100;
    for (int i = 0; i <= kFrames; ++i) EXPECT_FALSE(add(from_m + (to_m - from_m) * i / kFrames, 7));
  }

  HandAnswer answer_;
  double now_s_ = 0;
};

TEST_F(HandAnswerTest, MarksNothingOfAListBeforeTheHandHasMoved) {
  answer_.ask(5, Layout::List, std::nullopt);
  moves(0.060, 0.060);
  for (int i = 0; i < 1000; ++i) add(0.060 + 0.002 * std::sin(0.05 * i), 7);  // tremor
  EXPECT_EQ(answer_.marked(), std::nullopt);
  moves(0.060, 0.044);
  EXPECT_EQ(answer_.marked(), 0U) << "the first one from above";
}

TEST_F(HandAnswerTest, GoesDownAListAndStopsAtItsEnds) {
  answer_.ask(3, Layout::List, std::nullopt);
  moves(0.060, 0.028);
  EXPECT_EQ(answer_.marked(), 1U);
  moves(0.028, -0.040);
  EXPECT_EQ(answer_.marked(), 2U);
  moves(-0.040, -0.014);
  EXPECT_EQ(answer_.marked(), 1U) << "it turns round where the hand does";
  moves(-0.014, 0.060);
  EXPECT_EQ(answer_.marked(), 0U);
}

TEST_F(HandAnswerTest, GoesUpAScaleWithTheHand) {
  answer_.ask(21, Layout::Scale, 10);
  moves(0.000, 0.0085);
  EXPECT_EQ(answer_.marked(), 12U);
  answer_.set_marked(3);  // mark set by a key
  moves(0.0085, 0.003);
  EXPECT_EQ(answer_.marked(), 2U);
  moves(0.003, -0.100);
  EXPECT_EQ(answer_.marked(), 0U);
}

TEST_F(HandAnswerTest, EveryAnswerIsWithinTheReachOfASmallDevice) {
  for (std::size_t answers = 2; answers <= 21; ++answers) {
    answer_.ask(answers, Layout::List, std::nullopt);
    moves(0.050, -0.050);
    EXPECT_EQ(answer_.marked(), answers - 1) << answers;
  }
}

TEST_F(HandAnswerTest, GivesTheMarkThatWasShownWhenTheButtonWasPressed) {
  answer_.ask(3, Layout::List, std::nullopt);
  moves(0.060, 0.040);
  EXPECT_TRUE(add(0.010, 8)) << "in a slow frame the hand goes on";
  EXPECT_EQ(answer_.marked(), 0U);
  EXPECT_FALSE(add(0.010, 8));
  EXPECT_EQ(answer_.marked(), 2U);
}

TEST_F(HandAnswerTest, TakesEachPressOnceAndNoneFromBefore) {
  EXPECT_FALSE(add(0.0, 3)) << "pressed before anything was asked";
  answer_.ask(0, Layout::List, std::nullopt);
  EXPECT_TRUE(add(0.0, 4)) << "however soon and however short it was";
  EXPECT_FALSE(add(0.0, 4));
  answer_.ask(2, Layout::List, std::nullopt);
  EXPECT_FALSE(add(0.0, 4)) << "one press answers once";
  EXPECT_EQ(answer_.marked(), std::nullopt);
}

TEST_F(HandAnswerTest, MarksTheSameAnswerAtMostThreeTimesASecondHoweverTheHandShakes) {
  for (const double shakes_per_s : {1.0, 6.0, 20.0}) {
    answer_.ask(2, Layout::List, std::nullopt);
    std::vector<double> marked_s;  // the first answer
    std::optional<std::size_t> before;
    for (int i = 0; i < 10 * kFramesPerS; ++i) {
      add(0.020 * std::sin(6.283185 * shakes_per_s * i / kFramesPerS + 1.0), 7);
      if (answer_.marked() == 0U && before != 0U) marked_s.push_back(now_s_);
      before = answer_.marked();
    }
    EXPECT_GT(marked_s.size(), 8U) << shakes_per_s << " Hz: the mark goes with the hand";
    for (std::size_t i = 3; i < marked_s.size(); ++i) EXPECT_GT(marked_s[i] - marked_s[i - 3], 1.0) << shakes_per_s;
  }
}

}  // namespace hand_answer_test
}  // namespace afm::exhibit
