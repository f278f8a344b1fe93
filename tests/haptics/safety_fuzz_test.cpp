// SPDX-License-Identifier: Apache-2.0
// Invariant: no sequence of inputs brings the governor to a force beyond its limits
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "haptics/safety.h"

namespace safety_fuzz_test {

using namespace afm::haptics;
using afm::physics::Phase;
using afm::scene::ServoState;

constexpr std::int64_t kPeriodNs = 1'000'000;
constexpr double kCapN = 2.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-12;

// Any number a double can be, the ordinary ones more often.
double any_double(std::mt19937_64& random) {
  switch (random() % 64) {
    case 0:
      return kNan;
    case 1:
      return kInfinity;
    case 2:
      return -kInfinity;
    case 3:
      return std::numeric_limits<double>::max();
    case 4:
      return -std::numeric_limits<double>::denorm_min();
    default:
      return std::uniform_real_distribution<double>(-4.0, 4.0)(random);
  }
}

TEST(GovernorFuzz, StaysFiniteWithinCapAndSlewWhateverComesIn) {
  std::mt19937_64 random(20240917);
  SafetyGovernor governor({.period_ns = kPeriodNs, .force_cap_n = kCapN, .release_height_m = 0.050});
  // a law of unlimited stiffness may leak any energy; other tests cover the passivity observer
  GovernorInput input{.time_ns = 1'000'000'000, .law_energy = {.stiffness_n_per_m = 1e12}};
  glm::dvec3 last_n(0.0);
  int in_force = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const bool calm = (i / 2000) % 2 == 0;  // phases long enough to arm
    input.time_ns += calm ? kPeriodNs : static_cast<std::int64_t>(random() % 4'000'000) - 10'000;
    if (random() % 5000 == 0) input.time_ns += 30'000'000;
    input.hand_position_m = calm ? glm::dvec3(0.0) : glm::dvec3(any_double(random) * 1e-3);
    input.hand_height_m = calm ? 0.060 : any_double(random);
    const bool steady = calm && i % 2000 < 200;
    input.wanted_force_n =
        steady ? glm::dvec3(0.0) : glm::dvec3{any_double(random), any_double(random), any_double(random)};
    if (calm && !std::isfinite(glm::dot(input.wanted_force_n, glm::dvec3(1.0)))) input.wanted_force_n = glm::dvec3(0.0);
    input.phase = calm ? Phase::Free : static_cast<Phase>(random() % 3);
    input.pulled_off = random() % 100 == 0;
    input.turn_on = random() % 4 == 0;
    input.device_healthy = calm || random() % 100 != 0;
    input.led = random() % 3 == 0;
    input.damping_n_s_per_m = calm ? 2.0 : any_double(random);
    input.renderer = calm ? RendererLink::Alive : static_cast<RendererLink>(random() % 7);

    const glm::dvec3 force_n = governor.step(input).command.force_n();
    const double length_n = glm::length(force_n);
    ASSERT_TRUE(std::isfinite(length_n));
    ASSERT_LE(length_n, kCapN + kRounding);
    if (governor.state() == ServoState::Fault) {
      ASSERT_EQ(length_n, 0.0);
    } else {
      ASSERT_LE(glm::length(force_n - last_n), SafetyGovernor::kSlewNPerS * 1e-3 + kRounding);
    }
    in_force += length_n > 0.0 ? 1 : 0;
    last_n = force_n;
  }
  EXPECT_GT(in_force, 100'000) << "the fuzzer hardly ever reached a force";
}

}  // namespace safety_fuzz_test
