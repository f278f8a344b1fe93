// SPDX-License-Identifier: Apache-2.0
#include "app/view/mouse_hand.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace afm::app {
namespace mouse_hand_test {

using Kind = render::WindowEvent::Kind;

constexpr double kMPerPx = 0.0005;
constexpr std::int64_t kFrameNs = 16'000'000;

class MouseHandTest : public ::testing::Test {
 protected:
  void button(Kind kind, render::MouseButton button, double y) {
    hand_.apply({.kind = kind, .button = button, .cursor_px = {0.0, y}}, kMPerPx, now_ns_);
  }
  void key(Kind kind, render::Key key, double y = 0.0) {
    hand_.apply({.kind = kind, .key = key, .cursor_px = {0.0, y}}, kMPerPx, now_ns_);
  }
  void frame(double cursor_y, double cursor_x = 0.0) {
    now_ns_ += kFrameNs;
    hand_.update({cursor_x, cursor_y}, kMPerPx, 1e-9 * kFrameNs, now_ns_);
  }

  std::int64_t now_ns_ = 1'000'000'000;
  MouseHand hand_{{0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}};
};

TEST_F(MouseHandTest, FollowsTheCursorWhileTheRightButtonIsHeldAndOnlyThen) {
  frame(500.0);
  EXPECT_EQ(hand_.wanted_m(), MouseHand::kRestM);
  button(Kind::ButtonDown, render::MouseButton::Right, 500.0);
  frame(520.0);
  EXPECT_NEAR(hand_.wanted_m(), MouseHand::kRestM - 20.0 * kMPerPx, 1e-12);
  button(Kind::ButtonUp, render::MouseButton::Right, 530.0);
  frame(0.0);
  EXPECT_NEAR(hand_.wanted_m(), MouseHand::kRestM - 30.0 * kMPerPx, 1e-12);
}

TEST_F(MouseHandTest, ADragBetweenTwoFramesIsNotLost) {
  button(Kind::ButtonDown, render::MouseButton::Right, 100.0);
  button(Kind::ButtonUp, render::MouseButton::Right, 140.0);
  frame(900.0);
  EXPECT_NEAR(hand_.wanted_m(), MouseHand::kRestM - 40.0 * kMPerPx, 1e-12);
}

// Use as the scanner of an image: down onto the sample, then a drag over it, in which up means away from the user.
TEST_F(MouseHandTest, GoesOverTheSampleAsAScanner) {
  hand_.scan(true);
  EXPECT_EQ(hand_.wanted_m(), MouseHand::kOnSampleM);
  button(Kind::ButtonDown, render::MouseButton::Right, 100.0);
  for (int i = 0; i < 100; ++i) frame(60.0, 30.0);
  EXPECT_EQ(hand_.wanted_m(), MouseHand::kOnSampleM);
  EXPECT_NEAR(hand_.script().target_m[0], 30.0 * kMPerPx, 1e-12);
  EXPECT_NEAR(hand_.script().target_m[1], MouseHand::kOnSampleM, 1e-12);
  EXPECT_NEAR(hand_.script().target_m[2], -40.0 * kMPerPx, 1e-12);
  button(Kind::ButtonUp, render::MouseButton::Right, 60.0);
  hand_.scan(false);
  for (int i = 0; i < 100; ++i) frame(60.0, 30.0);
  EXPECT_NEAR(hand_.script().target_m[1], MouseHand::kHighestM, 1e-12);
  EXPECT_NEAR(hand_.script().target_m[2], 0.0, 1e-12);
}

// The key may be held together with the button or alone; the height stays.
TEST_F(MouseHandTest, GoesOverTheSampleWhileItsKeyIsHeld) {
  button(Kind::ButtonDown, render::MouseButton::Right, 100.0);
  for (int i = 0; i < 100; ++i) frame(150.0);
  const double height_m = hand_.wanted_m();
  EXPECT_NEAR(height_m, MouseHand::kRestM - 50.0 * kMPerPx, 1e-12);
  key(Kind::KeyDown, MouseHand::kOverKey, 150.0);
  for (int i = 0; i < 100; ++i) frame(110.0, 30.0);
  button(Kind::ButtonUp, render::MouseButton::Right, 110.0);
  EXPECT_TRUE(hand_.dragging());
  key(Kind::KeyUp, MouseHand::kOverKey, 110.0);
  EXPECT_FALSE(hand_.dragging());
  for (int i = 0; i < 100; ++i) frame(700.0, 700.0);
  EXPECT_NEAR(hand_.script().target_m[1], height_m, 1e-12);
  EXPECT_NEAR(hand_.script().target_m[2], -40.0 * kMPerPx, 1e-12);
  button(Kind::ButtonDown, render::MouseButton::Right, 100.0);
  frame(90.0);
  EXPECT_NEAR(hand_.wanted_m(), height_m + 10.0 * kMPerPx, 1e-12) << "up and down again";
}

TEST_F(MouseHandTest, StaysWhereItIsLedTo) {
  hand_.rest_at({0.01, 0.02, -0.03});
  for (int i = 0; i < 100; ++i) frame(0.0);
  EXPECT_NEAR(hand_.script().target_m[0], 0.01, 1e-12);
  EXPECT_NEAR(hand_.script().target_m[1], 0.02, 1e-12);
  EXPECT_NEAR(hand_.script().target_m[2], -0.03, 1e-12);
}

TEST_F(MouseHandTest, SpaceBarDragsAsTheButtonDoes) {
  key(Kind::KeyDown, render::Key::Space, 100.0);
  frame(60.0);
  EXPECT_GT(hand_.wanted_m(), MouseHand::kRestM);
  key(Kind::KeyUp, render::Key::Space, 60.0);
  EXPECT_FALSE(hand_.dragging());
}

TEST_F(MouseHandTest, StaysWithinTheWorkspaceHoweverFarTheMouseGoes) {
  button(Kind::ButtonDown, render::MouseButton::Right, 0.0);
  frame(1e6);
  EXPECT_EQ(hand_.wanted_m(), MouseHand::kLowestM);
  frame(-1e6);
  EXPECT_EQ(hand_.wanted_m(), MouseHand::kHighestM);
}

TEST_F(MouseHandTest, TheAimIsNeverFasterThanTheServoTrusts) {
  button(Kind::ButtonDown, render::MouseButton::Right, 0.0);
  double before = hand_.aim_m();
  for (int i = 0; i < 200; ++i) {
    frame(i % 2 == 0 ? 1e6 : -1e6);
    const double peak_m_per_s = 1.875 * std::abs(hand_.aim_m() - before) / hand_.script().duration_s;
    EXPECT_LT(peak_m_per_s, 0.5);  // the servo trips at 0.8 m/s
    before = hand_.aim_m();
  }
}

TEST_F(MouseHandTest, ArrivesWhereItIsWantedAndThenWritesNoMoreScripts) {
  button(Kind::ButtonDown, render::MouseButton::Right, 0.0);
  for (int i = 0; i < 100; ++i) frame(80.0);
  EXPECT_NEAR(hand_.aim_m(), MouseHand::kRestM - 80.0 * kMPerPx, 1e-12);
  const auto revision = hand_.script().revision;
  frame(80.0);
  EXPECT_EQ(hand_.script().revision, revision);
  EXPECT_NEAR(hand_.script().target_m[1], hand_.aim_m(), 1e-12);
}

TEST_F(MouseHandTest, AClickBetweenTwoFramesIsAPressOfTurnOn) {
  key(Kind::KeyDown, render::Key::T);
  key(Kind::KeyUp, render::Key::T);
  frame(0.0);
  EXPECT_EQ(hand_.script().turn_on_pressed, 1U);
  for (int i = 0; i < 20; ++i) frame(0.0);
  EXPECT_EQ(hand_.script().turn_on_pressed, 0U);
  button(Kind::ButtonDown, render::MouseButton::Middle, 0.0);
  for (int i = 0; i < 20; ++i) frame(0.0);
  EXPECT_EQ(hand_.script().turn_on_pressed, 1U);
}

TEST_F(MouseHandTest, GoesSidewaysAsFarAsASampleReaches) {
  button(Kind::ButtonDown, render::MouseButton::Right, 0.0);
  for (int i = 0; i < 100; ++i) frame(0.0, 30.0);
  EXPECT_NEAR(hand_.script().target_m[0], 30.0 * kMPerPx, 1e-12);
  EXPECT_EQ(hand_.aim_m(), MouseHand::kRestM);
  for (int i = 0; i < 100; ++i) frame(0.0, 1e6);
  EXPECT_EQ(hand_.script().target_m[0], MouseHand::kWidestM);
}

TEST_F(MouseHandTest, IsNotFasterAslant) {
  button(Kind::ButtonDown, render::MouseButton::Right, 0.0);
  const glm::dvec2 before(0.0, hand_.aim_m());
  frame(1e5, 1e5);
  const glm::dvec2 moved = glm::dvec2(hand_.script().target_m[0], hand_.aim_m()) - before;
  EXPECT_LT(1.875 * glm::length(moved) / hand_.script().duration_s, 0.5);
}

TEST_F(MouseHandTest, TheLeftButtonMovesNothing) {
  button(Kind::ButtonDown, render::MouseButton::Left, 0.0);
  frame(100.0);
  EXPECT_EQ(hand_.wanted_m(), MouseHand::kRestM);
}

}  // namespace mouse_hand_test
}  // namespace afm::app
