// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/hand_answer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace afm::exhibit {
namespace {

using Layout = HandAnswer::Layout;

// Moves from one height to the other, without a press.
void moves(HandAnswer& answer, double from_m, double to_m) {
  constexpr int kFrames = 100;
  for (int i = 0; i <= kFrames; ++i) EXPECT_FALSE(answer.add(from_m + (to_m - from_m) * i / kFrames, 7));
}

TEST(HandAnswer, MarksNothingOfAListBeforeTheHandHasMoved) {
  HandAnswer answer;
  answer.ask(5, Layout::List, std::nullopt);
  moves(answer, 0.060, 0.060);
  for (int i = 0; i < 1000; ++i) answer.add(0.060 + 0.002 * std::sin(0.05 * i), 7);  // tremor
  EXPECT_EQ(answer.marked(), std::nullopt);
  moves(answer, 0.060, 0.044);
  EXPECT_EQ(answer.marked(), 0U) << "the first one from above";
}

TEST(HandAnswer, GoesDownAListAndStopsAtItsEnds) {
  HandAnswer answer;
  answer.ask(3, Layout::List, std::nullopt);
  moves(answer, 0.060, 0.028);
  EXPECT_EQ(answer.marked(), 1U);
  moves(answer, 0.028, -0.040);
  EXPECT_EQ(answer.marked(), 2U);
  moves(answer, -0.040, -0.014);
  EXPECT_EQ(answer.marked(), 1U) << "it turns round where the hand does";
  moves(answer, -0.014, 0.060);
  EXPECT_EQ(answer.marked(), 0U);
}

TEST(HandAnswer, GoesUpAScaleWithTheHand) {
  HandAnswer answer;
  answer.ask(21, Layout::Scale, 10);
  moves(answer, 0.000, 0.0085);
  EXPECT_EQ(answer.marked(), 12U);
  answer.set_marked(3);  // by a key
  moves(answer, 0.0085, 0.003);
  EXPECT_EQ(answer.marked(), 2U);
  moves(answer, 0.003, -0.100);
  EXPECT_EQ(answer.marked(), 0U);
}

TEST(HandAnswer, EveryAnswerIsWithinTheReachOfASmallDevice) {
  for (std::size_t answers = 2; answers <= 21; ++answers) {
    HandAnswer answer;
    answer.ask(answers, Layout::List, std::nullopt);
    moves(answer, 0.050, -0.050);
    EXPECT_EQ(answer.marked(), answers - 1) << answers;
  }
}

TEST(HandAnswer, GivesTheMarkThatWasShownWhenTheButtonWasPressed) {
  HandAnswer answer;
  answer.ask(3, Layout::List, std::nullopt);
  moves(answer, 0.060, 0.040);
  EXPECT_TRUE(answer.add(0.010, 8)) << "in a slow frame the hand goes on";
  EXPECT_EQ(answer.marked(), 0U);
  EXPECT_FALSE(answer.add(0.010, 8));
  EXPECT_EQ(answer.marked(), 2U);
}

TEST(HandAnswer, TakesEachPressOnceAndNoneFromBefore) {
  HandAnswer answer;
  EXPECT_FALSE(answer.add(0.0, 3)) << "pressed before anything was asked";
  answer.ask(0, Layout::List, std::nullopt);
  EXPECT_TRUE(answer.add(0.0, 4)) << "however soon and however short it was";
  EXPECT_FALSE(answer.add(0.0, 4));
  answer.ask(2, Layout::List, std::nullopt);
  EXPECT_FALSE(answer.add(0.0, 4)) << "one press answers once";
  EXPECT_EQ(answer.marked(), std::nullopt);
}

}  // namespace
}  // namespace afm::exhibit
