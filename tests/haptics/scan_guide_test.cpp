// SPDX-License-Identifier: Apache-2.0
// Invariant: a scan leads a hand only while Turn-On is held, within spring, force, speed and energy
// Invariant: a scan lets go if its path ends, is late, jumps or leaves the workspace
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "haptics/scan_guide.h"
#include "servo_bench.h"
#include "support/samples/rough_surface.h"

// A hand that a scan leads, and a hand that is the scanner.
namespace scan_guide_test {

using namespace afm::haptics;
using afm::scene::ScanHand;
using afm::scene::ScanLead;
using afm::test::kMica;
using afm::test::ServoBench;

constexpr double kTickS = 1e-3;

// A hand at its place: a mass with the damping of an arm, and an Omni's friction.
struct Hand {
  glm::dvec3 place_m{0.0};
  glm::dvec3 speed_m_per_s{0.0};
  double given_j = 0;  // energy given by the spring

  void move(const glm::dvec3& force_n, double rubbing_n = 0.0) {
    constexpr double kMassKg = 0.12, kArmNSPerM = 1.0;
    const double speed = glm::length(speed_m_per_s);
    glm::dvec3 net_n = force_n - kArmNSPerM * speed_m_per_s;
    if (speed > 0.0) net_n -= rubbing_n * std::min(1.0, speed / 1e-3) * (speed_m_per_s / speed);
    speed_m_per_s += kTickS / kMassKg * net_n;
    given_j += glm::dot(force_n, kTickS * speed_m_per_s);
    place_m += kTickS * speed_m_per_s;
  }
};

ScanGuide::Input input_of(const glm::dvec3& hand_m, const glm::dvec3& target_m, std::int64_t tick) {
  return {.hand_m = hand_m,
          .target = ScanGuide::Target{.time_ns = tick * 1'000'000, .in_sample_m = target_m, .in_device_m = target_m},
          .force_on = true,
          .turn_on = true,
          .elapsed_s = kTickS};
}

TEST(ScanGuide, IsAWeakSpringWithinWhatTheDeviceGives) {
  DeviceSpec device = omni_like("hand");
  EXPECT_LE(ScanGuide(device).stiffness_n_per_m(), 100.0);
  EXPECT_LE(ScanGuide(device).most_force_n(), 0.6);
  device.max_stiffness_n_per_m = 200.0;
  device.max_continuous_force_n = 0.3;
  EXPECT_DOUBLE_EQ(ScanGuide(device).stiffness_n_per_m(), 50.0);
  EXPECT_DOUBLE_EQ(ScanGuide(device).most_force_n(), 0.24);
  EXPECT_LE(ScanGuide(limited_to(omni_like("hand"), 0.1)).most_force_n(), 0.1);
}

TEST(ScanGuide, BeginsWithoutForceAndRisesOverASecond) {
  ScanGuide guide(omni_like("hand"));
  const glm::dvec3 held_m(0.0, 0.03, 0.0), target_m(0.03, 0.0, 0.0);
  double before_n = 0.0;
  for (std::int64_t tick = 0; tick < 2000; ++tick) {
    const ScanGuide::Pull pull = guide.step(input_of(held_m, target_m, tick));
    ASSERT_TRUE(pull.leads);
    const double force_n = glm::length(pull.force_n);
    ASSERT_LE(force_n, ScanGuide::kMostForceN * kTickS * static_cast<double>(tick + 1) * (1 + 1e-12));
    ASSERT_LE(force_n, ScanGuide::kMostForceN * (1 + 1e-12));
    ASSERT_GE(force_n, before_n - 1e-12);
    before_n = force_n;
  }
  EXPECT_NEAR(before_n, ScanGuide::kMostForceN, 1e-9);
}

TEST(ScanGuide, LeadsAHandAlongLinesAtSixtyMillimetresASecond) {
  for (const double rubbing_n : {0.0, 0.26}) {
    ScanGuide guide(omni_like("hand"));
    Hand hand;
    double farthest_m = 0;
    for (std::int64_t tick = 0; tick < 10'000; ++tick) {
      const double way_m = std::fmod(0.06 * kTickS * static_cast<double>(tick / 16 * 16), 0.12);  // steps of one frame
      const glm::dvec3 target_m(way_m < 0.06 ? way_m - 0.03 : 0.09 - way_m, 0.0, 0.0);
      const ScanGuide::Pull pull = guide.step(input_of(hand.place_m, target_m, tick));
      hand.move(pull.force_n - ScanGuide::kDampingNSPerM * hand.speed_m_per_s, rubbing_n);
      if (tick > 3000) farthest_m = std::max(farthest_m, glm::distance(hand.place_m, target_m));
    }
    EXPECT_LT(farthest_m, 0.010) << rubbing_n;
    EXPECT_GT(farthest_m, 0.001) << rubbing_n;
  }
}

TEST(ScanGuide, GivesNoMoreEnergyThanItsTankWhateverThePathAndTheHandDo) {
  for (const double path_m_per_s : {0.05, 0.24}) {
    ScanGuide guide(omni_like("hand"));
    glm::dvec3 hand_m(0.0), force_n(0.0);
    double given_j = 0, most_over_j = -1;
    for (std::int64_t tick = 0; tick < 60'000; ++tick) {
      const double t = kTickS * static_cast<double>(tick);
      const glm::dvec3 path_m(0.03 * std::sin(path_m_per_s / 0.03 * t), 0.0, 0.0);
      // a hand that takes as much energy as it can: it follows the pull and resists nothing
      const glm::dvec3 moved_m = 0.0008 * force_n;
      given_j += glm::dot(force_n, moved_m);
      hand_m += moved_m;
      const ScanGuide::Pull pull = guide.step(input_of(hand_m, path_m, tick));
      force_n = pull.force_n;
      most_over_j = std::max(most_over_j, given_j - EnergyTank::kFullJ - EnergyTank::kRefillW * t);
    }
    EXPECT_LE(most_over_j, 1e-6) << path_m_per_s;
    EXPECT_GT(given_j, 0.01);
  }
}

TEST(ScanGuide, LetsGoWithTurnOnAndOfAPathThatEndsJumpsOrLeavesTheHandsPlace) {
  const glm::dvec3 hand_m(0.0), target_m(0.01, 0.0, 0.0);
  const std::vector<std::function<void(ScanGuide::Input&)>> ends{
      [](auto& input) { input.turn_on = false; },
      [](auto& input) { input.force_on = false; },
      [](auto& input) { input.target.reset(); },
      [](auto& input) { input.target->in_sample_m.x += 0.01; },
      [](auto& input) { input.target->in_device_m.x = 0.079; },
      [](auto& input) { input.target->in_device_m.x = std::numeric_limits<double>::quiet_NaN(); }};
  for (std::size_t end = 0; end < ends.size(); ++end) {
    ScanGuide guide(omni_like("hand"));
    std::int64_t tick = 0;
    ScanGuide::Pull pull;
    for (; tick < 500; ++tick) pull = guide.step(input_of(hand_m, target_m, tick));
    ASSERT_GT(glm::length(pull.force_n), 0.1);
    ScanGuide::Input input = input_of(hand_m, target_m, ++tick);
    ends[end](input);
    pull = guide.step(input);
    EXPECT_FALSE(pull.leads) << end;
    EXPECT_EQ(pull.force_n, glm::dvec3(0.0)) << end;
    EXPECT_EQ(pull.stored_j, 0.0) << end;
    // it takes hold again by itself only if a person let go of it
    pull = guide.step(input_of(hand_m, target_m, ++tick));
    EXPECT_EQ(pull.leads, end < 2) << end;
    input = input_of(hand_m, target_m, ++tick);
    input.turn_on = false;
    guide.step(input);
    pull = guide.step(input_of(hand_m, target_m, ++tick));
    EXPECT_TRUE(pull.leads) << end;
    EXPECT_LT(glm::length(pull.force_n), 0.001) << end;
  }
}

// ---- in the servo ----

// Sends the scan of every frame, as the live window does.
class ScanBench : public ServoBench {
 public:
  explicit ScanBench(const afm::scene::SharedModel& model = afm::test::paper_model()) : ServoBench(model) {}

  void scan(ScanLead lead) {
    lead.revision = ++revision_;
    lead.time_ns = now_ns;
    renderer.store(lead);
  }

  // A tip that goes to and fro over some millimetres of the hand, `nm` to either side.
  ScanLead led(double nm) const {
    const double phase = std::fmod(1e-9 * static_cast<double>(now_ns), 4.0);
    return {.apex_xy_m = {1e-9 * nm * (phase < 2.0 ? phase - 1.0 : 3.0 - phase), 0.0}, .hand = ScanHand::Led};
  }

  void run_with(double seconds, const std::function<ScanLead()>& lead) {
    for (const std::int64_t end_ns = now_ns + std::llround(1e9 * seconds); now_ns < end_ns;) {
      if (frames_++ % 16 == 0) scan(lead());
      tick();
    }
  }

  // Running at the top, with Turn-On held.
  void arm_and_hold() {
    arm(kMica);
    aim(kTop, 0.0, true);
    run(0.05);
  }

 private:
  std::uint32_t revision_ = 0;
  int frames_ = 0;
};

TEST(ScanOfTheHand, LeadsOnlyWithTurnOnHeldAndLetsGoWithIt) {
  ScanBench bench;
  bench.arm(kMica);
  bench.run_with(1.0, [&] { return bench.led(5.0); });
  EXPECT_EQ(bench.state().led, 0U);
  EXPECT_LT(bench.hand_force_n(), 0.05);
  bench.aim(ServoBench::kTop, 0.0, true);
  bench.run_with(3.0, [&] { return bench.led(5.0); });
  EXPECT_EQ(bench.state().led, 1U);
  EXPECT_EQ(bench.state().servo_state, afm::scene::ServoState::Running);
  EXPECT_GT(bench.hand_force_n(), 0.4);  // force on the simulated hand, which holds its position
  EXPECT_LT(bench.hand_force_n(), ScanGuide::kMostForceN + 0.1);
  EXPECT_LT(bench.state().safety.excess_energy_j, PassivityObserver::kToleranceJ);
  bench.aim(ServoBench::kTop, 0.0, false);
  bench.run_with(0.004, [&] { return bench.led(5.0); });
  EXPECT_EQ(bench.state().led, 0U);
  EXPECT_EQ(bench.hand_force_n(), 0.0);
}

// Each frame aims the hand at the hand's own place, as the live window does for a passive hand.
TEST(ScanOfTheHand, TakesARelaxedSimulatedHandDownToTheTipAndAlong) {
  ScanBench bench;
  bench.arm_and_hold();
  double x_before_m = 0, way_m = 0;
  for (int frame = 0; frame < 600; ++frame) {
    const auto [x, y, z] = bench.state().hand.position_m;
    bench.renderer.store(afm::scene::HandScript{
        .target_m = {x, y, z}, .duration_s = 0.016, .revision = ++bench.script, .turn_on_pressed = 1});
    bench.run_with(0.016, [&] { return bench.led(5.0); });
    if (frame > 200) way_m += std::abs(x - x_before_m);
    x_before_m = x;
  }
  EXPECT_EQ(bench.state().led, 1U);
  EXPECT_LT(bench.state().hand.position_m[1], 0.015) << "from 60 mm";
  // 5 nm to either side in 2 s are 18 mm/s of the hand, for 6.4 s
  EXPECT_GT(way_m, 0.5 * 0.018 * 6.4);
}

TEST(ScanOfTheHand, LetsGoWhenFramesStayAwayOrTheScanEnds) {
  for (const bool ends : {false, true}) {
    ScanBench bench;
    bench.arm_and_hold();
    bench.run_with(2.0, [&] { return bench.led(5.0); });
    ASSERT_EQ(bench.state().led, 1U);
    if (ends) bench.scan({});
    bench.run(ends ? 0.01 : 0.01 + 1e-9 * static_cast<double>(afm::scene::kScanLeadLastsNs));
    EXPECT_EQ(bench.state().led, 0U) << ends;
    EXPECT_EQ(bench.hand_force_n(), 0.0) << ends;
    EXPECT_EQ(bench.state().servo_state, afm::scene::ServoState::Running) << ends;
  }
}

TEST(ScanOfTheHand, SaysThatTurnOnMustBeReleasedAfterALateFrame) {
  ScanBench bench;
  bench.arm_and_hold();
  bench.run_with(2.0, [&] { return bench.led(5.0); });
  EXPECT_EQ(bench.state().lead_lost, 0U);
  bench.run(0.01 + 1e-9 * static_cast<double>(afm::scene::kScanLeadLastsNs));
  bench.run_with(0.5, [&] { return bench.led(5.0); });
  EXPECT_EQ(bench.state().led, 0U);
  EXPECT_EQ(bench.state().lead_lost, 1U);
  bench.aim(ServoBench::kTop, 0.0);
  bench.run_with(0.1, [&] { return bench.led(5.0); });
  EXPECT_EQ(bench.state().lead_lost, 0U);
  bench.aim(ServoBench::kTop, 0.0, true);
  bench.run_with(0.5, [&] { return bench.led(5.0); });
  EXPECT_EQ(bench.state().led, 1U);
}

TEST(ScanOfTheHand, DoesNotTakeAHandOffTheSample) {
  ScanBench bench;
  bench.hold_attached(kMica);
  bench.aim(0.025, 0.0, true);
  bench.run_with(1.0, [&] { return bench.led(1.0); });
  EXPECT_EQ(bench.state().phase, afm::physics::Phase::Attached);
  EXPECT_EQ(bench.state().led, 0U);
}

// ---- the hand is the scanner ----

// The hand goes over a rough sample in contact; the forces that it gets along the normal.
struct Felt {
  double lowest_n = HUGE_VAL, highest_n = -HUGE_VAL, sideways_n = 0, excess_j = 0;
};
Felt felt_across(const ScanLead& lead) {
  ScanBench bench(afm::test::rough_model());
  const auto scans = [&] { return lead; };
  bench.choose(kMica);
  bench.run_with(0.1, scans);
  bench.move(ServoBench::kTop, 0.3);
  bench.run_with(1.0, scans);
  bench.aim(ServoBench::kTop, 0.0, true);
  bench.run_with(0.1, scans);
  bench.aim(ServoBench::kTop, 0.0);
  bench.run_with(0.6, scans);
  bench.aim(-0.004, 0.5);
  bench.run_with(1.5, scans);
  EXPECT_EQ(bench.state().phase, afm::physics::Phase::Attached);
  EXPECT_EQ(bench.state().level, lead.feedback);
  bench.renderer.store(afm::scene::HandScript{
      .target_m = {0.03, -0.004, 0.0}, .duration_s = 2.0, .revision = ++bench.script, .turn_on_pressed = 0});
  const std::size_t first = bench.samples.size();
  bench.run_with(2.0, scans);
  Felt felt;
  for (std::size_t i = first; i < bench.samples.size(); ++i) {
    felt.lowest_n = std::min(felt.lowest_n, bench.samples[i].hand_force_n);
    felt.highest_n = std::max(felt.highest_n, bench.samples[i].hand_force_n);
  }
  felt.excess_j = bench.state().safety.excess_energy_j;
  EXPECT_EQ(bench.state().servo_state, afm::scene::ServoState::Running);
  EXPECT_EQ(bench.state().phase, afm::physics::Phase::Attached);
  return felt;
}

TEST(ScanOfTheHand, FeelsLevelWithFeedbackAndTheReliefWithoutOrWithSlowFeedback) {
  const Felt relief = felt_across({.hand = ScanHand::Scans});
  const Felt level = felt_across({.gain_per_s = 2000.0, .hand = ScanHand::Scans, .feedback = 1});
  const Felt slow = felt_across({.gain_per_s = 5.0, .hand = ScanHand::Scans, .feedback = 1});
  const double rough_n = relief.highest_n - relief.lowest_n;
  EXPECT_GT(rough_n, 0.05);
  EXPECT_LT(level.highest_n - level.lowest_n, 0.2 * rough_n);
  EXPECT_GT(slow.highest_n - slow.lowest_n, 1.5 * (level.highest_n - level.lowest_n));
  EXPECT_LT(level.excess_j, PassivityObserver::kToleranceJ);
  EXPECT_LT(slow.excess_j, PassivityObserver::kToleranceJ);
}

TEST(ScanOfTheHand, ChangesTheFeedbackOnlyWhereNoHandFeelsAStep) {
  ScanBench bench(afm::test::rough_model());
  bench.hold_attached(kMica);
  const ScanLead with{.gain_per_s = 2000.0, .hand = ScanHand::Scans, .feedback = 1};
  bench.run_with(0.5, [&] { return with; });
  EXPECT_EQ(bench.state().level, 0U);
  bench.aim(0.072, 0.5);
  bench.run_with(1.5, [&] { return with; });
  EXPECT_EQ(bench.state().level, 1U);
}

// ---- apart, nothing changes ----

TEST(ScanOfTheHand, ChangesNoBitOfAForceWhileItIsApart) {
  const auto forces_of = [](bool scanned) {
    ScanBench bench(afm::test::rough_model());
    bench.arm(kMica);
    std::vector<double> forces_n;
    for (const double height_m : {-0.01, 0.07}) {
      bench.aim(height_m, 0.8);
      const auto run = [&] { return ScanLead{.apex_xy_m = {1.0, -2.0}, .height_m = 5.0, .gain_per_s = 7.0}; };
      scanned ? bench.run_with(1.2, run) : bench.run(1.2);
    }
    for (const auto& sample : bench.samples) forces_n.push_back(sample.hand_force_n);
    return forces_n;
  };
  const std::vector<double> without = forces_of(false), with = forces_of(true);
  ASSERT_EQ(without.size(), with.size());
  EXPECT_EQ(std::memcmp(without.data(), with.data(), without.size() * sizeof(double)), 0);
  EXPECT_GT(*std::max_element(without.begin(), without.end()), 0.1);
}

}  // namespace scan_guide_test
