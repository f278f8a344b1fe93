// SPDX-License-Identifier: Apache-2.0
// Invariant: every force is finite and within the cap and the slew limit, whatever comes in
#include "haptics/force_limiter.h"
#include "support/deep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>

namespace force_limiter_test {

using namespace afm::haptics;
using afm::scene::FaultCode;

constexpr double kCapN = 2.0;
constexpr double kSlewNPerS = 500.0;
constexpr double kPeriodS = 1e-3;
constexpr double kRounding = 1e-12;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const WorkspaceStop kStop(glm::dvec3(-0.080, -0.040, -0.035), glm::dvec3(0.080, 0.080, 0.035));

ForceLimiter stage() { return {kCapN, kSlewNPerS, kStop}; }

// Request in the middle of the workspace, at rest, armed.
OutputRequest request(const glm::dvec3& law_force_n) {
  return {.law_force_n = law_force_n, .arm_gain = 1.0, .slew_n_per_s = kSlewNPerS, .elapsed_s = kPeriodS};
}

// The command once the slew limit no longer matters.
glm::dvec3 settled(const OutputRequest& wanted) {
  ForceLimiter output = stage();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(output.step(wanted), FaultCode::None);
  return output.command_n();
}

TEST(ForceLimiter, PassesAForceWithinItsLimitsBitForBit) {
  const glm::dvec3 force_n(0.1, -1.9, 0.2);
  EXPECT_EQ(settled(request(force_n)), force_n);
}

TEST(ForceLimiter, TakesBothGainsBeforeItClamps) {
  OutputRequest wanted = request({0.0, -3.0, 0.0});
  wanted.arm_gain = 0.5;
  wanted.thermal_gain = 0.8;
  EXPECT_NEAR(settled(wanted).y, -1.2, kRounding);
}

TEST(ForceLimiter, DampsWithTheGainOfArmingAlone) {
  OutputRequest wanted = request({});
  wanted.velocity_m_per_s = {0.0, 0.2, 0.0};
  wanted.damping_n_s_per_m = 3.0;
  wanted.thermal_gain = 0.5;
  EXPECT_NEAR(settled(wanted).y, -0.6, kRounding);
  wanted.damping_n_s_per_m = 100.0;
  EXPECT_NEAR(settled(wanted).y, -ForceLimiter::kMostDampingNSPerM * 0.2, kRounding);
  wanted.damping_n_s_per_m = -3.0;
  EXPECT_EQ(settled(wanted).y, 0.0) << "a damper that pushes";
}

TEST(ForceLimiter, ClampsTheSumOfAllAndKeepsItsDirection) {
  OutputRequest wanted = request({2.0, 0.0, 0.0});
  wanted.position_m = {0.0, -0.040, 0.0};
  const glm::dvec3 sum_n(2.0, 0.75, 0.0);
  const glm::dvec3 got_n = settled(wanted);
  EXPECT_NEAR(glm::length(got_n), kCapN, kRounding);
  EXPECT_NEAR(glm::dot(got_n, sum_n), kCapN * glm::length(sum_n), kRounding);
}

TEST(ForceLimiter, NeverBelievesInMoreThanTheHardCap) {
  ForceLimiter output(50.0, 1e6, kStop);
  output.step({.law_force_n = glm::dvec3(0.0, 40.0, 0.0), .arm_gain = 1, .slew_n_per_s = 1e6, .elapsed_s = 1.0});
  EXPECT_NEAR(output.command_n().y, 3.3, kRounding);
}

TEST(ForceLimiter, RisesAndFallsNoFasterThanTheLesserSlew) {
  ForceLimiter output = stage();
  OutputRequest wanted = request({0.0, -2.0, 0.0});
  for (const double expected_n : {0.5, 1.0, 1.5, 2.0, 2.0}) {
    output.step(wanted);
    EXPECT_NEAR(-output.command_n().y, expected_n, kRounding);
  }
  wanted.law_force_n.y = 0.0;
  wanted.slew_n_per_s = 100.0;
  output.step(wanted);
  EXPECT_NEAR(-output.command_n().y, 1.9, kRounding);
}

TEST(ForceLimiter, CutsToZeroAtOnceForWhatIsNoNumberAndForAHandThatFlies) {
  for (int what = 0; what < 8; ++what) {
    ForceLimiter output = stage();
    OutputRequest wanted = request({0.0, -1.0, 0.0});
    for (int i = 0; i < 5; ++i) output.step(wanted);
    ASSERT_NEAR(output.command_n().y, -1.0, kRounding);
    if (what == 0) wanted.law_force_n.z = kNan;
    if (what == 1) wanted.law_force_n.x = -kInfinity;
    if (what == 2) wanted.arm_gain = kNan;
    if (what == 3) wanted.thermal_gain = kNan;
    if (what == 4) wanted.damping_n_s_per_m = kNan;
    if (what == 5) wanted.elapsed_s = kInfinity;
    if (what == 6) wanted.position_m.y = kNan;
    if (what == 7) wanted.too_fast = true;
    EXPECT_EQ(output.step(wanted), what == 7 ? FaultCode::VelocityTrip : FaultCode::NotFinite) << what;
    EXPECT_EQ(output.command_n(), glm::dvec3(0.0)) << what;
  }
}

// A cheap random number generator (Marsaglia 2003, xorshift).
class Random {
 public:
  std::uint64_t bits() {
    state_ ^= state_ << 13U;
    state_ ^= state_ >> 7U;
    state_ ^= state_ << 17U;
    return state_;
  }
  double between(double least, double most) {
    return least + (most - least) * static_cast<double>(bits() >> 11U) * 0x1p-53;
  }

  // Around `size`, and now and then anything a double can be.
  double any(double size) {
    switch (bits() % 512) {
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
      case 5:
        return 1e9 * size;
      default:
        return between(-size, size);
    }
  }
  glm::dvec3 any_vector(double size) { return {any(size), any(size), any(size)}; }

 private:
  std::uint64_t state_ = 20240917;
};

TEST(ForceLimiter, StaysFiniteWithinCapAndSlewWhateverComesIn) {
  const int kInputs = afm::support::draws(10'000'000);
  Random random;
  ForceLimiter output = stage();
  glm::dvec3 last_n(0.0);
  int in_force = 0;
  int at_cap = 0;
  int cuts = 0;
  for (int i = 0; i < kInputs; ++i) {
    OutputRequest wanted;
    wanted.law_force_n = random.any_vector(4.0);
    wanted.position_m = random.any_vector(0.1);
    wanted.velocity_m_per_s = random.any_vector(1.0);
    wanted.arm_gain = random.any(2.0);
    wanted.thermal_gain = random.any(2.0);
    wanted.damping_n_s_per_m = random.any(6.0);
    wanted.slew_n_per_s = random.any(2.0 * kSlewNPerS);
    wanted.elapsed_s = std::abs(random.any(2e-3));
    wanted.too_fast = random.bits() % 256 == 0;

    const FaultCode fault = output.step(wanted);
    const glm::dvec3& force_n = output.command_n();
    const double length_n = glm::length(force_n);
    bool right = std::isfinite(length_n) && length_n <= kCapN + kRounding;
    if (fault == FaultCode::None) {
      right = right && glm::length(force_n - last_n) <= kSlewNPerS * wanted.elapsed_s + kRounding;
    } else {
      right = right && force_n == glm::dvec3(0.0);
      ++cuts;
    }
    if (!right) FAIL() << "input " << i << ": " << length_n << " N after " << glm::length(last_n) << " N";
    in_force += length_n > 0.0 ? 1 : 0;
    at_cap += length_n > kCapN - 1e-9 ? 1 : 0;
    last_n = force_n;
  }
  EXPECT_GT(in_force, kInputs / 3) << "the inputs hardly ever made a force";
  EXPECT_GT(at_cap, kInputs / 2000);
  EXPECT_GT(cuts, kInputs / 100);
}

TEST(WorkspaceStop, PushesBackOverTheLastFiveMillimetresOfEveryAxis) {
  const glm::dvec3 inside(0.074, 0.074, -0.029);
  EXPECT_EQ(kStop.force_n(inside, {}), glm::dvec3(0.0));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const glm::dvec3 min(-0.080, -0.040, -0.035);
      const glm::dvec3 max(0.080, 0.080, 0.035);
      glm::dvec3 place(0.0);
      place[axis] = sign > 0 ? max[axis] : min[axis];
      glm::dvec3 expected_n(0.0);
      expected_n[axis] = -sign * 0.75;
      EXPECT_NEAR(glm::length(kStop.force_n(place, {}) - expected_n), 0.0, kRounding);
      glm::dvec3 inwards(0.0);
      inwards[axis] = -sign * 0.1;
      EXPECT_NEAR(kStop.force_n(place, inwards)[axis], -sign * 0.55, kRounding);
      EXPECT_EQ(kStop.force_n(place, 10.0 * inwards)[axis], 0.0) << "a hand that sticks to the wall";
      EXPECT_FALSE(kStop.is_outside(place));
      place[axis] += sign * 0.0101;
      EXPECT_TRUE(kStop.is_outside(place));
    }
  }
}

TEST(WorkspaceStop, StoresWhatItsSpringTakes) {
  const double step_m = 1e-6;
  double work_j = 0.0;
  for (double y_m = 0.070; y_m < 0.085; y_m += step_m) {
    work_j -= kStop.spring_n({0.0, y_m + 0.5 * step_m, 0.0}).y * step_m;
    ASSERT_NEAR(kStop.stored_j({0.0, y_m + step_m, 0.0}), work_j, 1e-9);
  }
}

TEST(WorkspaceStop, IsNotThereOnAnAxisThatTheDeviceDoesNotHave) {
  const WorkspaceStop one_axis(glm::dvec3(0.0, -0.05, 0.0), glm::dvec3(0.0, 0.08, 0.0));
  EXPECT_EQ(one_axis.force_n({0.3, 0.0, -0.3}, {}), glm::dvec3(0.0));
  EXPECT_FALSE(one_axis.is_outside({0.3, 0.0, -0.3}));
}

}  // namespace force_limiter_test
