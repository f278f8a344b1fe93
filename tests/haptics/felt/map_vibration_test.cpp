// SPDX-License-Identifier: Apache-2.0
// A quantity of a map, felt as a vibration.
// Invariant: a vibration takes energy on every closed path, and is at most 0.1 N
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "contact/felt_vibration.h"
#include "felt/map_bench.h"
#include "haptics/contact_model.h"
#include "haptics/map_contact.h"
#include "scene/shared/map_vibration.h"
#include "servo_bench.h"

namespace afm::haptics {
namespace map_vibration_test {

using physics::Law;
using physics::Phase;
using scene::MapVibration;
using test::lift;

constexpr double kTickS = test::kMapTickS;

DeviceSpec vibrating(double most_n = kMostVibrationN) {
  DeviceSpec device = omni_like("hand");
  device.max_vibration_n = most_n;
  return device;
}

std::unique_ptr<ContactModel> model_of(MapVibration quantity, const DeviceSpec& device = vibrating()) {
  scene::SharedContact rubber = test::rubber(Law::Jkr);
  rubber.map_vibration = quantity;
  return test::hilly_model(rubber, device);
}

// Work of the vibration on a hand that rests, and then goes round a triangle. Each force is held during the next tick,
// as by the servo.
double work_j(ContactModel& model, const std::array<glm::dvec3, 3>& corners, double mean_m_per_s) {
  constexpr int kRestTicks = 20;  // two periods
  for (int tick = 0; tick < kRestTicks; ++tick) model.step(corners[0], {.elapsed_s = kTickS});
  double work = 0.0;
  glm::dvec3 force_n(0.0), before_m = corners[0];
  test::go_round(corners, mean_m_per_s, [&](const glm::dvec3& here_m) {
    work += glm::dot(force_n, here_m - before_m);
    force_n = model.step(here_m, {.elapsed_s = kTickS}).map.vibration_n;
    before_m = here_m;
  });
  return work;
}

class EveryVibration : public ::testing::TestWithParam<MapVibration> {};

TEST_P(EveryVibration, TakesEnergyOnEachOfTenThousandClosedPaths) {
  const auto model = model_of(GetParam());
  const double limit_j = 1e-6 * test::largest_j(*model);
  lift(*model);
  const auto taken = test::ten_thousand_paths(
      0.02, [&](const auto& corners, double mean_m_per_s) { return work_j(*model, corners, mean_m_per_s); });
  EXPECT_LE(taken.most_j, limit_j);
  EXPECT_LT(taken.sum_j, -0.01) << "so weak that nobody feels it";
}

// A hand that draws circles as fast as the vibration could follow it, and faster.
TEST_P(EveryVibration, IsWithinItsLimitAndTheCapHoweverTheHandMoves) {
  const DeviceSpec device = vibrating();
  const auto model = model_of(GetParam(), device);
  double longest_n = 0.0;
  for (const double per_s : {3.0, 30.0, 100.0, 300.0}) {
    lift(*model);
    for (int tick = 0; tick < 2000; ++tick) {
      const double t = kTickS * tick, down_m = std::min(0.09, 0.09 * t);
      const glm::dvec3 hand_m(0.003 * std::cos(per_s * t), 0.03 + 0.003 * std::sin(per_s * t), 0.07 - down_m);
      const Touch touch = model->step(hand_m, {.elapsed_s = kTickS});
      longest_n = std::max(longest_n, glm::length(touch.map.vibration_n));
      const double other_n = glm::length(touch.hand_force_n - touch.map.vibration_n);
      ASSERT_LE(glm::length(touch.hand_force_n), std::max(force_cap_n(device), other_n) + 1e-12) << per_s;
    }
  }
  EXPECT_LE(longest_n, kMostVibrationN + 1e-12);
  EXPECT_GT(longest_n, 0.02) << "too weak to be felt";
}

INSTANTIATE_TEST_SUITE_P(Quantities, EveryVibration,
                         testing::Values(MapVibration::Modulus, MapVibration::Adhesion, MapVibration::Loss,
                                         MapVibration::Collision),
                         [](const auto& tested) { return std::string(scene::text_of(tested.param).word); });

// Strongest vibration of a hand that slides through a place.
double strongest_n(ContactModel& model, const glm::dvec3& through_m) {
  double strongest = 0.0;
  for (int tick = 0; tick < 200; ++tick) {
    const glm::dvec3 hand_m = through_m + glm::dvec3(2e-4 * (tick - 100), 0.0, 0.0);
    strongest = std::max(strongest, glm::length(model.step(hand_m, {.elapsed_s = kTickS}).map.vibration_n));
  }
  return strongest;
}

// test::hilly_map() is stiffest at the corners of low and of high x and y, and stickiest at high y.
TEST(MapVibration, IsStrongerWhereItsQuantityIsLarger) {
  for (const MapVibration quantity : {MapVibration::Adhesion, MapVibration::Loss}) {
    const auto model = model_of(quantity);
    lift(*model);
    const double weak_n = strongest_n(*model, {0.0, -0.03, 0.0}), strong_n = strongest_n(*model, {0.0, 0.03, 0.0});
    EXPECT_GT(strong_n, 1.5 * weak_n) << scene::text_of(quantity).word;
    EXPECT_GT(strong_n, 0.02);
  }
  const auto model = model_of(MapVibration::Modulus);
  lift(*model);
  EXPECT_GT(strongest_n(*model, {-0.03, -0.025, 0.0}), 1.5 * strongest_n(*model, {0.03, -0.025, 0.0}));
}

TEST(MapVibration, IsNotFeltByAHandAtRestOrAboveTheSample) {
  const auto model = model_of(MapVibration::Loss);
  lift(*model);
  EXPECT_GT(strongest_n(*model, {0.0, 0.03, 0.0}), 0.02);
  double at_rest_n = 0.0;
  for (int tick = 0; tick < 100; ++tick) {
    const Touch touch = model->step({0.02, 0.03, 0.0}, {.elapsed_s = kTickS});
    if (tick > 10) at_rest_n = std::max(at_rest_n, glm::length(touch.map.vibration_n));
  }
  EXPECT_LT(at_rest_n, 1e-9);
  lift(*model);
  EXPECT_EQ(strongest_n(*model, {0.0, 0.03, 0.065}), 0.0);
  model->wait_for_lift();
  EXPECT_EQ(strongest_n(*model, {0.0, 0.03, 0.0}), 0.0) << "without force";
}

TEST(MapVibration, OfATouchBeginsWithItAndFades) {
  const auto model = model_of(MapVibration::Collision);
  lift(*model);
  double first_n = 0.0, later_n = 0.0;
  int touched = -1;
  for (int tick = 0; tick < 2000; ++tick) {
    const glm::dvec3 hand_m(5e-5 * tick - 0.05, 0.0, 0.07 - 1e-4 * std::min(tick, 900));
    const Touch touch = model->step(hand_m, {.elapsed_s = kTickS});
    const double vibration_n = glm::length(touch.map.vibration_n);
    if (touch.response.phase == Phase::Attached && touched < 0) touched = tick;
    if (touched < 0) {
      EXPECT_EQ(vibration_n, 0.0) << "before the touch";
    }
    if (touched >= 0 && tick < touched + 100) first_n = std::max(first_n, vibration_n);
    if (touched >= 0 && tick > touched + 600) later_n = std::max(later_n, vibration_n);
  }
  ASSERT_GT(touched, 0);
  EXPECT_GT(first_n, 0.02);
  EXPECT_EQ(later_n, 0.0);
}

TEST(MapVibration, IsOnlyThereOnRequestAndOnDevicesWhoseProfileAllowsIt) {
  const glm::dvec3 place(0.0, 0.03, 0.0);
  const auto off = model_of(MapVibration::None), without = model_of(MapVibration::Loss, omni_like("hand")),
             weak = model_of(MapVibration::Loss, vibrating(0.01));
  for (const auto* model : {&off, &without, &weak}) lift(**model);
  EXPECT_EQ(strongest_n(*off, place), 0.0);
  EXPECT_EQ(strongest_n(*without, place), 0.0);
  const double weak_n = strongest_n(*weak, place);
  EXPECT_GT(weak_n, 0.002);
  EXPECT_LE(weak_n, 0.01 + 1e-12);
  const auto strong = model_of(MapVibration::Loss, vibrating(5.0));
  lift(*strong);
  EXPECT_LE(strongest_n(*strong, place), kMostVibrationN + 1e-12) << "whatever a profile allows";
  scene::SharedContact mapless = test::rubber(Law::Jkr);
  mapless.map_vibration = MapVibration::Modulus;
  mapless.law_map = 0;
  const auto refused = build_tables(mapless, {});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("its vibration needs a map"));
}

// However little room other forces leave.
TEST(FeltVibration, TakesNoMoreThanTheRoom) {
  FeltVibration vibration(vibrating());
  double longest_n = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    const double room_n = tick % 3 == 0 ? -0.1 : 0.03;
    const glm::dvec3 force_n = vibration.step({1e-3 * tick, 0.0, 0.0}, 1.0, room_n, kTickS);
    ASSERT_LE(glm::length(force_n), std::max(0.0, room_n) + 1e-12);
    longest_n = std::max(longest_n, glm::length(force_n));
  }
  EXPECT_GT(longest_n, 0.025);
}

}  // namespace map_vibration_test
}  // namespace afm::haptics
