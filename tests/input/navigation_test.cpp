// SPDX-License-Identifier: Apache-2.0
// Invariant: a grab and its reverse restore the scene to 1e-9; the scene is locked while the tip touches
#include "input/navigation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

namespace afm::input {
namespace navigation_test {

constexpr glm::dvec3 kPivot(0.0, 1.65, 0.0);
constexpr double kFrameS = 1.0 / 60.0;
constexpr double kExactM = 1e-9;

WandState pointed_wand(std::uint32_t buttons = 0) {
  WandState wand;
  wand.connected = wand.orientation_valid = wand.position_valid = true;
  wand.position_m = {0.3, 1.2, 1.8};
  wand.buttons = buttons;
  return wand;
}

WandState cap(std::uint32_t buttons = 0) {
  WandState wand = pointed_wand(buttons);
  wand.position_valid = false;
  wand.motion = WandMotion::Rate;
  return wand;
}

double difference(const glm::dmat4& a, const glm::dmat4& b) {
  double largest = 0.0;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) largest = std::max(largest, std::abs(a[column][row] - b[column][row]));
  }
  return largest;
}

glm::dvec3 moved(const Navigation& navigation, const glm::dvec3& point) {
  return glm::dvec3(navigation.room_from_scene() * glm::dvec4(point, 1.0));
}

TEST(Navigation, BeginsWithTheSceneWhereItIs) { EXPECT_EQ(Navigation(kPivot).room_from_scene(), glm::dmat4(1.0)); }

TEST(Navigation, GrabbingAndComingBackLeavesTheSceneExactlyWhereItWas) {
  Navigation navigation(kPivot);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const WandState start = pointed_wand(bit(WandButton::Grab));
  for (int grab = 0; grab < 20; ++grab) {
    navigation.update(pointed_wand(), kFrameS, false);
    const glm::dmat4 before = navigation.room_from_scene();
    navigation.update(start, kFrameS, false);
    WandState wand = start;
    for (int i = 0; i < 500; ++i) {
      wand.position_m += 0.05 * glm::dvec3{normal(random), normal(random), normal(random)};
      wand.room_from_wand = glm::normalize(
          glm::angleAxis(0.2 * normal(random), glm::normalize(glm::dvec3{normal(random), 1.0, normal(random)})) *
          wand.room_from_wand);
      navigation.update(wand, kFrameS, false);
    }
    EXPECT_GT(difference(navigation.room_from_scene(), before), 0.01);
    navigation.update(start, kFrameS, false);
    EXPECT_LT(difference(navigation.room_from_scene(), before), kExactM);
    // released somewhere else, so that the next grab begins there
    wand.buttons = bit(WandButton::Grab);
    navigation.update(wand, kFrameS, false);
  }
}

TEST(Navigation, WhatIsGrabbedSticksToTheWand) {
  Navigation navigation(kPivot);
  WandState wand = pointed_wand(bit(WandButton::Grab));
  navigation.update(wand, kFrameS, false);
  const glm::dvec3 held = wand.position_m + glm::dvec3(0.1, 0.2, -0.7);
  wand.position_m += glm::dvec3(-0.4, 0.1, 0.2);
  wand.room_from_wand = glm::angleAxis(0.8, glm::dvec3(0, 1, 0));
  navigation.update(wand, kFrameS, false);
  const glm::dvec3 expected = wand.position_m + wand.room_from_wand * glm::dvec3(0.1, 0.2, -0.7);
  EXPECT_LT(glm::distance(moved(navigation, held), expected), kExactM);
}

TEST(Navigation, ScalesAboutTheHandWhereItIsTracked) {
  Navigation navigation(kPivot);
  WandState wand = pointed_wand(bit(WandButton::Scale));
  navigation.update(wand, kFrameS, false);
  const glm::dvec3 hand = wand.position_m;
  wand.position_m.z += 0.3;  // motion towards oneself, since the ray looks along -z
  navigation.update(wand, kFrameS, false);
  EXPECT_NEAR(navigation.scale(), std::exp(1.0), 1e-12);
  EXPECT_LT(glm::distance(moved(navigation, hand), hand), kExactM);
  wand.position_m.z -= 0.3;
  navigation.update(wand, kFrameS, false);
  EXPECT_LT(difference(navigation.room_from_scene(), glm::dmat4(1.0)), kExactM);
}

TEST(Navigation, ScalesAboutTheMiddleOfTheSceneByTiltOrByACap) {
  Navigation tilted(kPivot);
  WandState wand = pointed_wand(bit(WandButton::Scale));
  wand.position_valid = false;
  tilted.update(wand, kFrameS, false);
  wand.room_from_wand = glm::angleAxis(0.35, glm::dvec3(1, 0, 0));
  tilted.update(wand, kFrameS, false);
  EXPECT_NEAR(tilted.scale(), std::exp(1.0), 1e-9);
  EXPECT_LT(glm::distance(moved(tilted, kPivot), kPivot), kExactM);

  Navigation capped(kPivot);
  wand = cap(bit(WandButton::Scale));
  wand.push.y = 1.0;
  for (int i = 0; i < 60; ++i) capped.update(wand, kFrameS, false);
  EXPECT_NEAR(capped.scale(), std::exp(1.0), 1e-9);
  EXPECT_LT(glm::distance(moved(capped, kPivot), kPivot), kExactM);
}

TEST(Navigation, KeepsTheScaleWithinItsLimits) {
  Navigation navigation(kPivot);
  WandState wand = cap(bit(WandButton::Scale));
  wand.push.y = 1.0;
  for (int i = 0; i < 10'000; ++i) navigation.update(wand, kFrameS, false);
  EXPECT_EQ(navigation.scale(), Navigation::kLargestScale);
  wand.push.y = -1.0;
  for (int i = 0; i < 10'000; ++i) navigation.update(wand, kFrameS, false);
  EXPECT_EQ(navigation.scale(), Navigation::kSmallestScale);
}

TEST(Navigation, FliesTheSameWayAtAnyFrameRate) {
  std::vector<glm::dmat4> ends;
  for (const int frames : {10, 60, 1000}) {
    Navigation navigation(kPivot);
    WandState wand = cap(bit(WandButton::Grab));
    wand.push = {0.7, -0.4, 1.0};
    wand.turn = {0.0, 0.8, 0.0};
    for (int i = 0; i < frames; ++i) navigation.update(wand, 1.0 / frames, false);
    wand.push = wand.turn = glm::dvec3(0.0);
    for (int i = 0; i < frames; ++i) navigation.update(wand, 1.0 / frames, false);
    ends.push_back(navigation.room_from_scene());
  }
  EXPECT_GT(difference(ends[0], glm::dmat4(1.0)), 0.1);
  EXPECT_LT(difference(ends[0], ends[1]), kExactM);
  EXPECT_LT(difference(ends[0], ends[2]), kExactM);
}

TEST(Navigation, DoesNotDriftWithinTheDeadZone) {
  Navigation navigation(kPivot);
  WandState wand = cap(bit(WandButton::Grab));
  wand.push = {0.09, -0.1, 0.05};
  wand.turn = {0.1, 0.0, -0.08};
  for (int i = 0; i < 600; ++i) navigation.update(wand, kFrameS, false);
  EXPECT_EQ(navigation.room_from_scene(), glm::dmat4(1.0));
}

TEST(Navigation, OfACapNeedsTheGrabButton) {
  Navigation navigation(kPivot);
  WandState wand = cap();
  wand.push = {1.0, 1.0, 1.0};
  for (int i = 0; i < 60; ++i) navigation.update(wand, kFrameS, false);
  EXPECT_EQ(navigation.room_from_scene(), glm::dmat4(1.0));
}

TEST(Navigation, NeverFliesTheSceneOutOfReach) {
  Navigation navigation(kPivot);
  WandState wand = cap(bit(WandButton::Grab));
  wand.push = {1.0, 0.0, 0.0};
  for (int i = 0; i < 60 * 60; ++i) navigation.update(wand, kFrameS, false);
  EXPECT_NEAR(glm::distance(moved(navigation, kPivot), kPivot), Navigation::kFarthestM, 1e-9);
}

TEST(Navigation, GoesHome) {
  Navigation navigation(kPivot);
  WandState wand = cap(bit(WandButton::Grab));
  wand.push = {1.0, 0.5, 0.0};
  for (int i = 0; i < 60; ++i) navigation.update(wand, kFrameS, false);
  wand.buttons = bit(WandButton::Home);
  navigation.update(wand, kFrameS, false);
  EXPECT_EQ(navigation.room_from_scene(), glm::dmat4(1.0));
}

TEST(Navigation, StopsWhileTheTipIsInContactAndGoesOnWithoutAJump) {
  Navigation navigation(kPivot);
  WandState wand = pointed_wand(bit(WandButton::Grab));
  navigation.update(wand, kFrameS, false);
  wand.position_m.x += 0.2;
  navigation.update(wand, kFrameS, false);
  const glm::dmat4 before = navigation.room_from_scene();
  wand.position_m.x += 0.5;
  navigation.update(wand, kFrameS, true);
  EXPECT_EQ(navigation.room_from_scene(), before);
  WandState home = wand;
  home.buttons = bit(WandButton::Home);
  navigation.update(home, kFrameS, true);
  EXPECT_EQ(navigation.room_from_scene(), before);
  navigation.update(wand, kFrameS, false);
  EXPECT_LT(difference(navigation.room_from_scene(), before), kExactM) << "taken up where the wand now is";
  wand.position_m.x += 0.1;
  navigation.update(wand, kFrameS, false);
  EXPECT_NEAR(moved(navigation, kPivot).x - before[3].x, 0.1, kExactM);
}

TEST(Navigation, StopsWhenTheWandIsUnpluggedOrLost) {
  Navigation navigation(kPivot);
  WandState wand = pointed_wand(bit(WandButton::Grab));
  navigation.update(wand, kFrameS, false);
  wand.position_m.x += 0.2;
  navigation.update(wand, kFrameS, false);
  const glm::dmat4 before = navigation.room_from_scene();
  navigation.update(WandState{}, kFrameS, false);
  WandState broken = wand;
  broken.position_m.x = std::numeric_limits<double>::quiet_NaN();
  navigation.update(broken, kFrameS, false);
  EXPECT_EQ(navigation.room_from_scene(), before);
}

TEST(NavigationLock, HoldsInContactAndWhileTheHandFeelsAForce) {
  scene::TipState tip;
  EXPECT_FALSE(navigation_locked(tip));
  tip.phase = physics::Phase::Attached;
  EXPECT_TRUE(navigation_locked(tip));
  tip.phase = physics::Phase::Free;
  EXPECT_FALSE(navigation_locked(tip));
  tip.hand.force_n = {0.0, -0.2, 0.0};
  EXPECT_TRUE(navigation_locked(tip));
  tip.hand.force_n[1] = std::nan("");
  EXPECT_TRUE(navigation_locked(tip));
}

}  // namespace navigation_test
}  // namespace afm::input
