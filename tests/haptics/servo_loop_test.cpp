// SPDX-License-Identifier: Apache-2.0
// Invariant: the force of an event does not depend on the hand's speed
#include "haptics/servo_loop.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/contact.h"
#include "servo_bench.h"

namespace servo_loop_test {

using namespace afm::scene;
using afm::haptics::ServoLoop;
using afm::haptics::SimulatedDevice;
using afm::test::calculated;
using afm::test::kGold;
using afm::test::kMica;
using afm::test::kSiliconNitride;
using afm::test::paper_model;
using afm::test::ServoBench;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// With an Omni's encoders, its friction and a tick of delay: the band of the hysteresis is wider than all of it.
TEST(ServoLoop, JumpsOnceEachWayOnADeviceWithFlaws) {
  for (const std::int32_t material : {kMica, kGold, kSiliconNitride}) {
    ServoBench bench(paper_model(), 1000.0, afm::haptics::kOmniFlaws);
    bench.arm(material);
    bench.move(-0.015, 2.0);
    bench.move(0.075, 3.0);
    ASSERT_EQ(bench.events.size(), 2U) << material;
    const auto expected = calculated(material);
    EXPECT_NEAR(bench.events[0].force_after_n / -expected.f_attr.si, 1.0, 1e-9);
    EXPECT_NEAR(bench.events[1].force_before_n / -expected.f_ad.si, 1.0, 1e-9);
    EXPECT_EQ(bench.state().fault, FaultCode::None);
  }
}

TEST(ServoLoop, PullsTheHandDownAtSnapInAndLetsItFlyAtPullOff) {
  ServoBench bench;
  bench.arm(kMica);
  bench.move(-0.010, 1.0);
  ASSERT_EQ(bench.events.size(), 1U);

  // after snap-in the hand is below its aim: 200 N/m against 40 N/m
  bench.move(0.030, 1.0);
  bench.run(1.0);
  EXPECT_NEAR(bench.state().hand.position_m[1], 0.030 * 200.0 / 240.0, 1e-5);

  // at pull-off the grip is stretched by 2 N / 200 N/m, and 60 ms later the hand has risen by most of that
  bench.move(0.072, 3.0);
  ASSERT_EQ(bench.events.size(), 2U);
  const auto released = std::find_if(bench.samples.begin(), bench.samples.end(), [&](const TipSample& sample) {
    return sample.time_ns >= bench.events[1].time_ns;
  });
  ASSERT_GT(bench.samples.end() - released, 60);
  EXPECT_NEAR(released->hand_height_m, 0.050, 1e-4);
  EXPECT_GT((released + 60)->hand_height_m, 0.057);
}

TEST(ServoLoop, ReportsItsLimitsHeatAndEnergy) {
  ServoBench bench;
  bench.hold_attached(kMica);
  const TipState state = bench.state();
  EXPECT_EQ(state.safety.force_cap_n, 2.0);
  EXPECT_EQ(state.safety.slew_limit_n_per_s, 500.0);
  EXPECT_GT(state.safety.motor_heat, 0.0);
  EXPECT_LT(state.safety.motor_heat, 0.5);
  EXPECT_EQ(state.safety.thermal_gain, 1.0);
  EXPECT_LT(state.safety.excess_energy_j, 1e-6);
  EXPECT_EQ(state.safety.observer_damping_n_s_per_m, 0.0);
  EXPECT_EQ(state.dead_man, 0U);
}

// A relaxed hand: 0.1 kg, 1 N s/m, 100 N/m.
TEST(ServoLoop, BrakesTheRecoilOfARelaxedHandAtPullOff) {
  auto segment = SharedSegment::create(paper_model(), 0);
  SimulatedDevice device(glm::dvec3(0.0, 0.060, 0.0),
                         {.mass_kg = 0.1, .damping_n_s_per_m = 1.0, .grip_stiffness_n_per_m = 100.0});
  auto loop = ServoLoop::create(*segment, device, {});
  RendererSide renderer = segment->renderer_side();
  renderer.store(Selection{.material = kMica, .revision = 1});
  std::int64_t now_ns = 0;
  double strongest_n = 0.0;
  double recoil_m_per_s = 0.0;
  const auto run = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      renderer.store(RendererHeartbeat{});
      (*loop)->tick(now_ns += 1'000'000, 0);
      const TipState state = *renderer.tip_state();
      strongest_n = std::max(strongest_n, -state.hand.force_n[1]);
      if (renderer.pop_event()) recoil_m_per_s = 0.0;
      recoil_m_per_s = std::max(recoil_m_per_s, device.velocity_m_per_s().y);
    }
  };
  run(500);
  renderer.store(HandScript{.target_m = {0, 0.06, 0}, .revision = 1, .turn_on_pressed = 1});
  run(600);
  renderer.store(HandScript{.target_m = {0, -0.02, 0}, .duration_s = 1.0, .revision = 2});
  run(1500);
  renderer.store(HandScript{.target_m = {0, 0.075, 0}, .duration_s = 4.0, .revision = 3});
  run(5000);
  ASSERT_NEAR(strongest_n, 2.0, 0.02) << "torn off at full force";
  EXPECT_EQ(renderer.tip_state()->phase, afm::physics::Phase::Free);
  EXPECT_EQ(renderer.tip_state()->servo_state, ServoState::Running);
  EXPECT_LE(recoil_m_per_s, 0.35);
  EXPECT_GT(recoil_m_per_s, 0.1) << "there was no recoil";
}

TEST(ServoLoop, GivesForceOnlyWhileTurnOnIsHeldWithADeadMan) {
  auto segment = SharedSegment::create(paper_model(), 0);
  SimulatedDevice device;
  auto loop = ServoLoop::create(*segment, device, {.dead_man = true});
  RendererSide renderer = segment->renderer_side();
  renderer.store(Selection{.material = kMica, .revision = 1});
  std::int64_t now_ns = 0;
  const auto run = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      renderer.store(RendererHeartbeat{});
      (*loop)->tick(now_ns += 1'000'000, 0);
    }
    return *renderer.tip_state();
  };
  run(100);
  renderer.store(HandScript{.target_m = {0, 0.06, 0}, .revision = 1, .turn_on_pressed = 1});
  run(600);
  renderer.store(HandScript{.target_m = {0, -0.02, 0}, .duration_s = 0.5, .revision = 2, .turn_on_pressed = 1});
  TipState state = run(1000);
  EXPECT_EQ(state.dead_man, 1U);
  EXPECT_EQ(state.servo_state, ServoState::Running);
  ASSERT_GT(state.hand.force_n[1], 0.4);
  renderer.store(HandScript{.target_m = {0, -0.02, 0}, .revision = 3});
  state = run(25);
  EXPECT_EQ(state.hand.force_n[1], 0.0);
  EXPECT_EQ(state.fault, FaultCode::DeadManReleased);
}

TEST(ServoLoop, CountsEachPressOfTurnOnOnceHoweverLongItIsHeld) {
  ServoBench bench;
  for (std::uint64_t press = 1; press <= 3; ++press) {
    bench.aim(ServoBench::kTop, 0.0, true);
    bench.run(press == 2 ? 1.0 : 0.002);
    EXPECT_EQ(bench.state().presses, press) << "while it is held";
    bench.aim(ServoBench::kTop, 0.0);
    bench.run(0.002);
    EXPECT_EQ(bench.state().presses, press) << "after it was released";
  }
}

TEST(ServoLoop, GivesNoForceBeforeTurnOn) {
  ServoBench bench;
  bench.choose(kMica);
  bench.move(0.060, 0.3);
  bench.move(-0.020, 0.5);
  bench.run(0.5);
  EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed);
  EXPECT_EQ(bench.hand_force_n(), 0.0);
  EXPECT_NEAR(bench.state().hand.position_m[1], -0.020, 1e-5);
}

TEST(ServoLoop, FeelsTheSampleInItsNewOrientation) {
  ServoBench bench;
  bench.hold_attached(kMica);
  const double angle = 0.3;
  SceneTransforms transforms;
  transforms.count = 2;
  transforms.room_from_node[0] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  transforms.room_from_node[1] = {1, 0, 0, 0, 0, 0, -1, 0, 2 * std::sin(angle), 2 * std::cos(angle), 0, 0, 0, 0, 0, 1};
  bench.renderer.store(transforms);
  bench.run(1.0);
  const TipState state = bench.state();
  EXPECT_NEAR(state.hand.force_n[0] / state.hand.force_n[1], std::tan(angle), 1e-9);
  EXPECT_LT(state.hand.force_n[1], 0.0);
}

TEST(ServoLoop, WaitsWithAChangeOfMaterialUntilTheTipIsOff) {
  ServoBench bench;
  bench.hold_attached(kMica);
  const std::uint32_t before = bench.state().acknowledged.selection;
  bench.choose(kGold);
  bench.run(0.2);
  EXPECT_EQ(bench.state().material, kMica);
  EXPECT_EQ(bench.state().acknowledged.selection, before);
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);

  bench.move(0.072, 0.5);
  bench.run(0.5);
  EXPECT_EQ(bench.state().material, kGold);
  EXPECT_EQ(bench.state().acknowledged.selection, before + 1);
  EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed);
  EXPECT_EQ(bench.hand_force_n(), 0.0);
  EXPECT_NEAR(bench.state().active.scale.hand_m_per_m, 0.050 / calculated(kGold).z_joc.si, 1.0);
}

TEST(ServoLoop, DoesNotDisarmForTheSameMaterialAgain) {
  ServoBench bench;
  bench.arm(kMica);
  bench.choose(kMica);
  bench.run(0.1);
  EXPECT_EQ(bench.state().acknowledged.selection, bench.selection);
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);
}

TEST(ServoLoop, IgnoresAndCountsGarbageInTheSharedBlocks) {
  ServoBench bench;
  bench.hold_attached(kMica);
  const double force_n = bench.hand_force_n();
  bench.renderer.store(Selection{.material = 99, .revision = 1000});
  bench.renderer.store(HandScript{.target_m = {kNan, 0, 0}, .revision = 1000});
  SceneTransforms transforms;
  transforms.count = 2;  // all zero: a sample without an orientation
  bench.renderer.store(transforms);
  bench.run(0.05);
  EXPECT_EQ(bench.state().garbage_blocks, 3U);
  EXPECT_NEAR(bench.hand_force_n(), force_n, 1e-3);
  EXPECT_EQ(bench.state().material, kMica);
}

TEST(ServoLoop, FadesWhenTheHeartbeatStops) {
  ServoBench bench;
  bench.hold_attached(kMica);
  bench.heartbeats = false;
  const std::int64_t stopped_ns = bench.now_ns;
  bench.run(0.249);
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);
  while (bench.hand_force_n() > 0.0) bench.tick();
  EXPECT_LE(bench.now_ns - stopped_ns, 350'000'000);
  EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed);
  EXPECT_EQ(bench.state().fault, FaultCode::RendererHung);
  // a tip that stuck is not taken up again in the middle
  bench.tick();
  EXPECT_EQ(bench.state().phase, afm::physics::Phase::WaitForLift);
}

TEST(ServoLoop, ReleasesWhenTheRendererDied) {
  ServoBench bench;
  bench.hold_attached(kMica);
  bench.loop->renderer_died();
  const std::int64_t died_ns = bench.now_ns;
  while (bench.hand_force_n() > 0.0) bench.tick();
  EXPECT_LE(bench.now_ns - died_ns, 21'000'000);
  EXPECT_EQ(bench.state().fault, FaultCode::RendererDied);
}

TEST(ServoLoop, DisarmsAfterAStallAndNeverThrowsTheHand) {
  for (const std::int64_t stall_ns : {5'000'000, 50'000'000, 500'000'000}) {
    ServoBench bench;
    bench.hold_attached(kMica);
    double last_n = bench.hand_force_n();
    bench.aim(0.035, 0.0);
    bench.tick(stall_ns);
    for (int i = 0; i < 200; ++i) {
      const double force_n = bench.hand_force_n();
      ASSERT_LE(std::abs(force_n - last_n), 0.2);
      last_n = force_n;
      bench.tick();
    }
    EXPECT_EQ(bench.state().servo_state, stall_ns > 20'000'000 ? ServoState::Disarmed : ServoState::Running);
  }
}

// A device whose reports a test can spoil; it remembers the last force that it got.
class FaultyDevice final : public afm::haptics::HapticDevice {
 public:
  const afm::haptics::DeviceSpec& spec() const noexcept override { return hand_.spec(); }
  afm::haptics::DeviceSample read(std::int64_t now_ns) noexcept override {
    auto sample = hand_.read(now_ns);
    if (spoil != nullptr) spoil(sample);
    return sample;
  }
  void write(const afm::haptics::ForceCommand& command) noexcept override {
    force_n = command.force_n();
    hand_.write(command);
  }
  void follow(const HandScript& script) noexcept override { hand_.follow(script); }

  void (*spoil)(afm::haptics::DeviceSample&) = nullptr;
  glm::dvec3 force_n{0.0};

 private:
  SimulatedDevice hand_;
};

TEST(ServoLoop, ReleasesADeviceThatReportsNonsense) {
  for (auto* spoil : {+[](afm::haptics::DeviceSample& s) { s.position_m.y = kNan; },
                      +[](afm::haptics::DeviceSample& s) { s.position_m.x = kInfinity; },
                      +[](afm::haptics::DeviceSample& s) { s.position_m.y = 1e200; },
                      +[](afm::haptics::DeviceSample& s) { s.healthy = false; }}) {
    auto segment = SharedSegment::create(paper_model(), 0);
    FaultyDevice device;
    auto loop = ServoLoop::create(*segment, device, {});
    RendererSide renderer = segment->renderer_side();
    renderer.store(Selection{.material = kMica, .revision = 1});
    std::int64_t now_ns = 0;
    const auto run = [&](int ticks) {
      for (int i = 0; i < ticks; ++i) {
        renderer.store(RendererHeartbeat{});
        (*loop)->tick(now_ns += 1'000'000, 0);
      }
    };
    run(100);
    renderer.store(HandScript{.target_m = {0, 0.06, 0}, .revision = 1, .turn_on_pressed = 1});
    run(600);
    renderer.store(HandScript{.target_m = {0, -0.02, 0}, .duration_s = 0.5, .revision = 2});
    run(1000);
    ASSERT_GT(device.force_n.y, 0.4);
    device.spoil = spoil;
    run(1);
    EXPECT_EQ(device.force_n, glm::dvec3(0.0));
    EXPECT_EQ(renderer.tip_state()->servo_state, ServoState::Fault);
    device.spoil = nullptr;
    run(100);
    EXPECT_EQ(device.force_n, glm::dvec3(0.0));
    EXPECT_EQ(renderer.refused_blocks(), 0U);
  }
}

TEST(ServoLoop, GoesOnInASegmentWhereItsPredecessorDied) {
  ServoBench bench;
  bench.hold_attached(kMica);
  SimulatedDevice device;
  auto successor = ServoLoop::create(bench.segment, device, {});
  ASSERT_TRUE(successor);
  for (int i = 0; i < 50; ++i) {
    bench.renderer.store(RendererHeartbeat{});
    (*successor)->tick(bench.now_ns += 1'000'000, 0);
  }
  EXPECT_EQ(bench.state().tick, 50U);
  EXPECT_EQ(bench.state().material, kMica);
  EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed);
  EXPECT_EQ(bench.hand_force_n(), 0.0);
}

// All felt forces fit below the limit: the scale changes, and nothing is cut off.
TEST(ServoLoop, GivesNoMoreThanAnOperatorAllows) {
  for (const double most_n : {0.1, 1.0, 1.7}) {
    ServoBench bench(paper_model(), 1000.0, {}, most_n);
    bench.arm(kMica);
    bench.move(-0.025, 0.5);
    bench.move(0.060, 0.5);
    EXPECT_LE(bench.state().safety.force_cap_n, most_n);
    double strongest_n = 0.0;
    for (const TipSample& sample : bench.samples) strongest_n = std::max(strongest_n, std::abs(sample.hand_force_n));
    EXPECT_LE(strongest_n, most_n);
    EXPECT_GT(strongest_n, 0.7 * most_n);
    EXPECT_GE(bench.events.size(), 2U);
  }
  auto segment = SharedSegment::create(paper_model(), 0);
  SimulatedDevice device;
  for (const double most_n : {0.0, 0.09, -1.0, kNan}) {
    EXPECT_THAT(ServoLoop::create(*segment, device, {.max_force_n = most_n}).error().message,
                testing::HasSubstr("choose 0.1 N or more"));
  }
}

TEST(ServoLoop, CutsTheForceInTheTickThatHearsStop) {
  ServoBench bench;
  bench.hold_attached(kMica);
  bench.renderer.store(RendererHeartbeat{.time_ns = bench.now_ns, .frame = ++bench.frame, .stop = 1});
  bench.heartbeats = false;
  bench.tick();
  EXPECT_EQ(bench.hand_force_n(), 0.0);
  EXPECT_EQ(bench.state().fault, FaultCode::StopPressed);
  bench.heartbeats = true;
  bench.run(1.0);
  EXPECT_EQ(bench.state().servo_state, ServoState::Fault);
  bench.aim(ServoBench::kTop, 0.3, true);  // acknowledgement of the fault
  bench.run(0.5);
  EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed);
  bench.aim(ServoBench::kTop, 0.0);
  bench.run(0.1);
  bench.arm(kMica);
}

TEST(ServoLoop, RefusesARateThatNoServoCanKeep) {
  auto segment = SharedSegment::create(paper_model(), 0);
  SimulatedDevice device;
  for (const double rate_hz : {0.0, 99.0, 20'000.0, -1000.0, kNan}) {
    EXPECT_THAT(ServoLoop::create(*segment, device, {.rate_hz = rate_hz}).error().message,
                testing::HasSubstr("choose 100 to 10000 Hz"));
  }
}

TEST(ServoLoop, RefusesAMaterialWithoutAForceLaw) {
  SharedModel model = paper_model();
  // an adhesion too weak to hold the tip that the van der Waals force pulls in
  model.materials[kGold].contact.mean_surface_energy.si = 1e-6;
  auto segment = SharedSegment::create(model, 0);
  SimulatedDevice device;
  EXPECT_THAT(ServoLoop::create(*segment, device, {}).error().message, testing::HasSubstr("gold"));
}

}  // namespace servo_loop_test
