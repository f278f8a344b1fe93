// SPDX-License-Identifier: Apache-2.0
#include "input/head_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace afm::input {
namespace head_tracker_test {

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kStart = 1'000 * kMillisecond;
const scene::HeadPose kSweetSpot{.position_m = {0.0, 1.65, 2.5}};

scene::HeadPose at(const glm::dvec3& place) { return {.position_m = place}; }

// Follows a head that moves evenly until `end`, with packets and frames of 10 ms.
std::int64_t follow(HeadTracker& tracker, const glm::dvec3& from, const glm::dvec3& velocity, std::int64_t end,
                    double latency_s) {
  std::int64_t now = kStart;
  for (; now <= end; now += 10 * kMillisecond) {
    tracker.add(at(from + velocity * (static_cast<double>(now - kStart) * 1e-9)), now);
    tracker.head(now, latency_s);
  }
  return now - 10 * kMillisecond;
}

TEST(HeadTracker, ShowsTheSweetSpotUntilThereIsAHead) {
  HeadTracker tracker(kSweetSpot);
  EXPECT_EQ(tracker.head(kStart, 0.03).position_m, kSweetSpot.position_m);
}

TEST(HeadTracker, IsWhereTheTrackerSaysOnceItHasEasedThere) {
  HeadTracker tracker(kSweetSpot);
  const glm::dvec3 place(0.5, 1.7, 2.0);
  const std::int64_t now = follow(tracker, place, glm::dvec3(0.0), kStart + 1'200 * kMillisecond, 0.03);
  EXPECT_LT(glm::distance(tracker.head(now, 0.03).position_m, place), 1e-12);
}

TEST(HeadTracker, PredictsAnEvenMotionOverTheLatency) {
  HeadTracker tracker(kSweetSpot);
  const glm::dvec3 from(-1.0, 1.7, 2.0), velocity(0.5, 0.0, 0.0);
  const std::int64_t now = follow(tracker, from, velocity, kStart + 2'000 * kMillisecond, 0.05);
  const glm::dvec3 then = from + velocity * (static_cast<double>(now - kStart) * 1e-9 + 0.05);
  EXPECT_LT(glm::distance(tracker.head(now, 0.05).position_m, then), 1e-4) << "against 25 mm without";
}

TEST(HeadTracker, PredictsNoFartherThanItSays) {
  HeadTracker tracker(kSweetSpot);
  const glm::dvec3 from(-3.0, 1.7, 2.0), velocity(2.0, 0.0, 0.0);
  const std::int64_t now = follow(tracker, from, velocity, kStart + 2'000 * kMillisecond, 10.0);
  const glm::dvec3 measured = from + velocity * (static_cast<double>(now - kStart) * 1e-9);
  EXPECT_NEAR(glm::distance(tracker.head(now, 10.0).position_m, measured), HeadTracker::kFarthestPredictionM, 1e-9);
}

TEST(HeadTracker, HoldsALostHeadAndEasesItToTheSweetSpotWithoutAJump) {
  HeadTracker tracker(kSweetSpot);
  const glm::dvec3 place(0.8, 1.7, 1.5);
  std::int64_t now = follow(tracker, place, glm::dvec3(0.0), kStart + 1'500 * kMillisecond, 0.03);
  const std::int64_t lost = now;
  glm::dvec3 before = tracker.head(now, 0.03).position_m;
  const double way = glm::distance(place, kSweetSpot.position_m);
  while (now < lost + 1'300 * kMillisecond) {
    now += 10 * kMillisecond;
    const glm::dvec3 shown = tracker.head(now, 0.03).position_m;
    const bool held = now - lost <= HeadTracker::kHoldNs;
    EXPECT_TRUE(!held || glm::distance(shown, place) < 1e-12) << "held";
    EXPECT_LT(glm::distance(shown, before), 0.02 * way) << "no jump";
    before = shown;
  }
  EXPECT_LT(glm::distance(before, kSweetSpot.position_m), 1e-12);

  // found again: as gently back
  const std::int64_t found = now;
  while (now < found + 1'100 * kMillisecond) {
    now += 10 * kMillisecond;
    tracker.add(at(place), now);
    const glm::dvec3 shown = tracker.head(now, 0.03).position_m;
    EXPECT_LT(glm::distance(shown, before), 0.02 * way);
    before = shown;
  }
  EXPECT_LT(glm::distance(before, place), 1e-9);
}

TEST(HeadTracker, DoesNotJumpWhenAMovingHeadIsLost) {
  HeadTracker tracker(kSweetSpot);
  std::int64_t now = follow(tracker, {-1.0, 1.7, 2.0}, {1.0, 0.0, 0.0}, kStart + 1'500 * kMillisecond, 0.05);
  const std::int64_t lost = now;
  glm::dvec3 before = tracker.head(now, 0.05).position_m;
  while (now < lost + 1'500 * kMillisecond) {
    now += 10 * kMillisecond;
    const glm::dvec3 shown = tracker.head(now, 0.05).position_m;
    EXPECT_LT(glm::distance(shown, before), 0.03);
    before = shown;
  }
}

TEST(HeadTracker, BelievesNoPoseThatIsNone) {
  HeadTracker tracker(kSweetSpot);
  tracker.add(at({std::nan(""), 0.0, 0.0}), kStart);
  scene::HeadPose turned = at({9.0, 9.0, 9.0});
  turned.room_from_head = glm::dquat(3.0, 0.0, 0.0, 0.0);
  tracker.add(turned, kStart);
  EXPECT_EQ(tracker.head(kStart + kMillisecond, 0.0).position_m, kSweetSpot.position_m);
}

}  // namespace head_tracker_test
}  // namespace afm::input
