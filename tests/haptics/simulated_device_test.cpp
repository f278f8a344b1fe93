// SPDX-License-Identifier: Apache-2.0
#include "haptics/simulated_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>
namespace simulated_device_test {

using afm::haptics::SimulatedDevice;
using afm::scene::HandScript;

constexpr double kMass = 0.12, kDamping = 2.0, kGrip = 200.0;
constexpr std::int64_t kMs = 1'000'000;

constexpr double kDecay = kDamping / (2.0 * kMass);

// Answer of an oscillator at rest to a step of its equilibrium, from any textbook.
double step_response(double seconds) {
  const double omega = std::sqrt(kGrip / kMass - kDecay * kDecay);
  return 1.0 - std::exp(-kDecay * seconds) * (std::cos(omega * seconds) + kDecay / omega * std::sin(omega * seconds));
}

HandScript jump_to(double height_m) { return {.target_m = {0.0, height_m, 0.0}, .duration_s = 0.0, .revision = 1}; }

TEST(SimulatedHand, StaysWhereItIsLeft) {
  SimulatedDevice device(glm::dvec3(0.01, 0.02, 0.03));
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(device.read(i * kMs).position_m, glm::dvec3(0.01, 0.02, 0.03));
}

// The aim jumps within the first tick, so that the hand's free response starts half a tick later.
TEST(SimulatedHand, RespondsAsTheClosedFormOfItsImpedance) {
  constexpr std::int64_t kTickNs = 1000;
  SimulatedDevice device(glm::dvec3(0.0));
  device.follow(jump_to(0.01));
  double largest_error = 0;
  for (std::int64_t i = 0; i < 300'000; ++i) {
    const double height = device.read(i * kTickNs).position_m.y;
    const double seconds = 1e-9 * (static_cast<double>(i) - 0.5) * kTickNs;
    if (i > 0) largest_error = std::max(largest_error, std::abs(height - 0.01 * step_response(seconds)));
  }
  EXPECT_LT(largest_error, 1e-9);
}

TEST(SimulatedHand, DoesNotDependOnTheTickOnceItsAimRests) {
  std::vector<double> ends;
  for (const std::int64_t tick_ns : {kMs / 8, kMs, 7 * kMs, 56 * kMs}) {
    SimulatedDevice device(glm::dvec3(0.0));
    device.follow(jump_to(0.01));
    device.read(0);
    device.read(kMs);
    for (std::int64_t t = kMs + tick_ns; t < 57 * kMs; t += tick_ns) device.read(t);
    ends.push_back(device.read(57 * kMs).position_m.y);
  }
  for (const double end : ends) EXPECT_NEAR(end, ends.front(), 1e-15);
}

TEST(SimulatedHand, RepeatsItselfBitForBit) {
  std::vector<double> runs[2];
  for (auto& run : runs) {
    SimulatedDevice device;
    device.follow({.target_m = {0.01, -0.02, 0.005}, .duration_s = 0.4, .revision = 3});
    for (int i = 0; i < 1000; ++i) run.push_back(device.read(i * kMs + i % 7).position_m.y);
  }
  EXPECT_EQ(runs[0], runs[1]);
}

TEST(SimulatedHand, FollowsItsAimAndReportsTheEndOfThePath) {
  SimulatedDevice device;
  device.follow({.target_m = {0.0, -0.02, 0.0}, .duration_s = 0.5, .revision = 3, .turn_on_pressed = 1});
  EXPECT_EQ(device.read(0).finished_script, 0U);
  EXPECT_TRUE(device.read(kMs).turn_on);
  EXPECT_EQ(device.read(499 * kMs).finished_script, 0U);
  EXPECT_EQ(device.read(500 * kMs).finished_script, 3U);
  EXPECT_NEAR(device.read(2000 * kMs).position_m.y, -0.02, 1e-6);
}

TEST(SimulatedHand, GoesOnFromItsAimWhenANewPathInterrupts) {
  SimulatedDevice device(glm::dvec3(0.0));
  device.follow({.target_m = {0.0, 0.05, 0.0}, .duration_s = 0.5, .revision = 1});
  double last = 0;
  double longest_step = 0;
  for (int i = 0; i < 1000; ++i) {
    if (i == 250) device.follow({.target_m = {0.0, 0.0, 0.0}, .duration_s = 0.5, .revision = 2});
    const double height = device.read(i * kMs).position_m.y;
    longest_step = std::max(longest_step, std::abs(height - last));
    last = height;
  }
  EXPECT_LT(longest_step, 0.4e-3);  // 0.4 m/s; a jump of the aim would throw the hand
}

TEST(SimulatedHand, StopsAtTheEndsOfItsWorkspace) {
  SimulatedDevice device(glm::dvec3(0.0));
  device.follow(jump_to(1.0));
  for (int i = 0; i < 500; ++i) EXPECT_LE(device.read(i * kMs).position_m.y, device.spec().workspace_max_m.y);
  EXPECT_EQ(device.velocity_m_per_s().y, 0.0);
}

TEST(FlawedHand, ReportsItsPlaceInStepsAndLate) {
  constexpr double kQuantum = 55e-6;
  constexpr std::int64_t kDelayNs = 5 * kMs;
  SimulatedDevice exact(glm::dvec3(0.0)), flawed(glm::dvec3(0.0), {}, {.quantum_m = kQuantum, .delay_ns = kDelayNs});
  std::vector<double> places;
  for (SimulatedDevice* device : {&exact, &flawed}) {
    device->follow({.target_m = {0.0, 0.05, 0.0}, .duration_s = 0.3, .revision = 1});
  }
  for (int i = 0; i < 400; ++i) {
    places.push_back(exact.read(i * kMs).position_m.y);
    const double told = flawed.read(i * kMs).position_m.y;
    EXPECT_EQ(told, kQuantum * std::round(told / kQuantum));
    EXPECT_NEAR(told, places[static_cast<std::size_t>(std::max(0, i - 5))], 0.5 * kQuantum * (1.0 + 1e-9));
  }
}

TEST(FlawedHand, StaysWhereFrictionHoldsItAgainstItsAim) {
  SimulatedDevice device(glm::dvec3(0.0), {}, {.friction_n = 0.26});
  device.follow(jump_to(0.001));  // pull of the grip with 0.2 N
  for (int i = 0; i < 1000; ++i) EXPECT_NEAR(device.read(i * kMs).position_m.y, 0.0, 1e-6);
  device.follow({.target_m = {0.0, 0.010, 0.0}, .duration_s = 0.0, .revision = 2});  // pull of 2 N
  double rests_at = 0;
  for (int i = 1000; i < 3000; ++i) rests_at = device.read(i * kMs).position_m.y;
  EXPECT_NEAR(rests_at, 0.010, 0.26 / kGrip);
  EXPECT_NEAR(device.velocity_m_per_s().y, 0.0, 1e-3);
}

TEST(SimulatedHand, LivesThroughPausesOfAnyLength) {
  SimulatedDevice device(glm::dvec3(0.0));
  device.follow({.target_m = {0.0, 0.04, 0.0}, .duration_s = 0.5, .revision = 1});
  std::int64_t now_ns = 0;
  for (const std::int64_t pause_ns : {kMs, 50 * kMs, 500 * kMs, 3600 * 1000 * kMs, std::int64_t{0}, -5 * kMs}) {
    now_ns += pause_ns;
    EXPECT_TRUE(std::isfinite(device.read(now_ns).position_m.y));
  }
  EXPECT_NEAR(device.read(now_ns + 6 * kMs).position_m.y, 0.04, 1e-9);
}

}  // namespace simulated_device_test
