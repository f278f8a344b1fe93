// SPDX-License-Identifier: Apache-2.0
// Invariant: an edit takes effect only when the force is off; an invalid one changes nothing
#include "haptics/edit_builder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <limits>
#include <thread>
#include <utility>

#include "haptics/edit_thread.h"
#include "servo_bench.h"
#include "support/samples/measured_curve_of.h"

namespace material_edit_test {

using namespace afm::scene;
using afm::test::kGold;
using afm::test::kMica;
using afm::test::paper_model;
using afm::test::ServoBench;

SharedContact mica_on_a_lever_of(double newton_per_metre) {
  SharedContact mica = paper_model().materials[kMica];
  mica.contact.spring_constant.si = newton_per_metre;
  return mica;
}

// Z_joc of the paper's law: F_ad/k_c on a rigid sample.
double pull_off_m(const SharedContact& material) {
  const double adhesion_n =
      4.0 * 3.14159265358979323846 * material.contact.tip_radius.si * material.contact.mean_surface_energy.si;
  return adhesion_n / material.contact.spring_constant.si;
}

double pull_off_m(const ServoBench& bench, std::uint32_t revision) {
  double z_m = 0;
  for (const TipSample& sample : bench.samples) {
    if (sample.edit_revision == revision && sample.phase == afm::physics::Phase::Attached)
      z_m = std::max(z_m, sample.tip.z_m);
  }
  return z_m;
}

TEST(MaterialEdit, IsFeltOnceTheForceIsReleased) {
  ServoBench bench;
  bench.arm(kMica);
  bench.edit(kMica, mica_on_a_lever_of(0.2));
  bench.run(0.1);
  EXPECT_EQ(bench.state().active.edit_revision, 1U);
  EXPECT_EQ(bench.state().acknowledged.refused_edit, 0U);
  EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed);
  EXPECT_EQ(bench.state().material, kMica);

  bench.arm(kMica);
  bench.move(-0.010, 0.5);
  bench.move(0.072, 2.0);
  ASSERT_EQ(bench.events.size(), 2U);
  EXPECT_NEAR(bench.events[1].z_m, pull_off_m(mica_on_a_lever_of(0.2)), 1e-9 * bench.events[1].z_m);
  EXPECT_NEAR(pull_off_m(bench, 1), bench.events[1].z_m, 0.1e-9);
  EXPECT_NEAR(bench.state().active.scale.hand_m_per_m, 0.050 / bench.events[1].z_m, 1.0);
}

TEST(MaterialEdit, TakesEffectOnlyAfterTheForceIsGone) {
  ServoBench bench;
  bench.arm(kMica);
  bench.move(0.045, 0.3);
  bench.edit(kMica, mica_on_a_lever_of(0.2));
  while (bench.state().active.edit_revision == 0) {
    bench.tick();
    ASSERT_LT(bench.now_ns, 10'000'000'000);
  }
  EXPECT_EQ(bench.hand_force_n(), 0.0);
  bench.tick();
  EXPECT_EQ(bench.state().phase, afm::physics::Phase::WaitForLift);
}

TEST(MaterialEdit, WaitsUntilTheTipIsOff) {
  ServoBench bench;
  bench.hold_attached(kMica);
  const double force_n = bench.hand_force_n();
  bench.edit(kMica, mica_on_a_lever_of(0.2));
  bench.run(0.3);
  EXPECT_EQ(bench.state().active.edit_revision, 0U);
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);
  EXPECT_NEAR(bench.hand_force_n(), force_n, 1e-3);

  bench.move(0.072, 0.5);
  bench.run(0.2);
  EXPECT_EQ(bench.state().active.edit_revision, 1U);
  EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed);
}

TEST(MaterialEdit, OfAnotherMaterialLeavesTheHandAlone) {
  ServoBench bench;
  bench.hold_attached(kMica);
  SharedContact gold = paper_model().materials[kGold];
  gold.contact.spring_constant.si = 0.3;
  bench.edit(kGold, gold);
  bench.run(0.1);
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);
  EXPECT_EQ(bench.state().active.edit_revision, 0U);

  bench.move(0.072, 0.5);
  bench.arm(kGold);
  EXPECT_EQ(bench.state().active.edit_revision, 1U);
  EXPECT_NEAR(bench.state().active.scale.hand_m_per_m, 0.050 / pull_off_m(gold), 1.0);
}

TEST(MaterialEdit, ThatCannotBeFeltIsRefusedAndChangesNothing) {
  ServoBench bench;
  bench.hold_attached(kMica);
  const double force_n = bench.hand_force_n();
  SharedContact nonsense = mica_on_a_lever_of(std::numeric_limits<double>::quiet_NaN());
  bench.edit(kMica, nonsense);
  bench.run(0.01);
  EXPECT_EQ(bench.state().acknowledged.refused_edit, 1U);
  nonsense = mica_on_a_lever_of(0.1);
  nonsense.law = static_cast<afm::physics::Law>(99);
  nonsense.name.fill('x');
  bench.edit(kMica, nonsense);
  bench.run(0.01);
  EXPECT_EQ(bench.state().acknowledged.refused_edit, 2U);
  // an adhesion too weak to hold a tip that was pulled in: valid numbers without a law
  nonsense = mica_on_a_lever_of(0.1);
  nonsense.contact.mean_surface_energy.si = 1e-6;
  bench.edit(kMica, nonsense);
  bench.run(0.01);
  EXPECT_EQ(bench.state().acknowledged.refused_edit, 3U);
  EXPECT_EQ(bench.state().active.edit_revision, 0U);
  EXPECT_NEAR(bench.hand_force_n(), force_n, 1e-3);
}

// Mica with the curve of an instrument, which tears off at 14 nm.
SharedModel measured_model() {
  SharedModel model = paper_model();
  model.materials[kMica].law = afm::physics::Law::Measured;
  afm::test::add_measured_curve(model, kMica);
  return model;
}

// Same curve with the tear-off at 10 nm, as of another pixel.
SharedMeasuredCurve other_curve(const SharedModel& model) {
  SharedMeasuredCurve curve = model.curves[0];
  for (auto& point : curve.retract) {
    if (point.z.si > 10e-9) point.force = afm::physics::Force();
  }
  return curve;
}

TEST(MaterialEdit, BringsAnotherMeasuredCurveOnceTheTipIsOffAndTheForceGone) {
  const SharedModel model = measured_model();
  ServoBench bench(model);
  bench.hold_attached(kMica);
  bench.edit(kMica, model.materials[kMica], other_curve(model));
  bench.run(0.3);
  EXPECT_EQ(bench.state().active.edit_revision, 0U) << "in contact";
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);
  bench.move(0.072, 0.5);
  bench.run(0.2);
  EXPECT_EQ(bench.state().active.edit_revision, 1U);
  EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed);
  EXPECT_EQ(bench.hand_force_n(), 0.0);

  bench.hold_attached(kMica);
  bench.move(0.072, 2.0);
  EXPECT_NEAR(pull_off_m(bench, 0), 14e-9, 0.3e-9);
  EXPECT_NEAR(pull_off_m(bench, 1), 10e-9, 0.3e-9);
}

TEST(MaterialEdit, OfACurveThatIsNoneIsRefused) {
  const SharedModel model = measured_model();
  ServoBench bench(model);
  bench.arm(kMica);
  SharedMeasuredCurve backwards = other_curve(model);
  std::swap(backwards.retract[3], backwards.retract[4]);
  bench.edit(kMica, model.materials[kMica], backwards);
  SharedMeasuredCurve endless = other_curve(model);
  endless.approach_count = 0xFFFFFFFFU;
  bench.edit(kMica, model.materials[kMica], endless);
  bench.run(0.1);
  EXPECT_EQ(bench.state().acknowledged.refused_edit, 2U);
  EXPECT_EQ(bench.state().active.edit_revision, 0U);
}

TEST(MaterialEdit, OfAThousandInAStormTheNewestIsFelt) {
  ServoBench bench;
  bench.hold_attached(kMica);
  for (int i = 1; i <= 1000; ++i) {
    bench.edit(kMica, mica_on_a_lever_of(0.05 + 0.0002 * i));
    bench.tick();
  }
  EXPECT_EQ(bench.state().active.edit_revision, 0U);
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);
  bench.move(0.072, 0.5);
  bench.run(0.2);
  EXPECT_EQ(bench.state().active.edit_revision, 1000U);
  EXPECT_NEAR(bench.state().active.scale.hand_m_per_m, 0.050 / pull_off_m(mica_on_a_lever_of(0.25)), 1.0);

  // again with a tip that is always free, where every edit is accepted at once
  for (int i = 1; i <= 1000; ++i) {
    bench.edit(kMica, mica_on_a_lever_of(0.25 - 0.0002 * i));
    bench.tick();
  }
  bench.run(0.1);
  EXPECT_EQ(bench.state().active.edit_revision, 2000U);
}

TEST(MaterialEdit, IsFeltByTheSuccessorOfAServoThatDied) {
  ServoBench bench;
  bench.arm(kMica);
  bench.edit(kMica, mica_on_a_lever_of(0.2));
  afm::haptics::SimulatedDevice device;
  auto successor = afm::haptics::ServoLoop::create(bench.segment, device, {});
  ASSERT_TRUE(successor);
  for (int i = 0; i < 50; ++i) {
    bench.renderer.store(RendererHeartbeat{});
    (*successor)->tick(bench.now_ns += 1'000'000, 0);
  }
  EXPECT_EQ(bench.state().active.edit_revision, 1U);
}

// Three threads, as in the program: one draws and edits, one builds, one ticks.
TEST(MaterialEdit, CrossesBetweenThreads) {
  ServoBench bench;
  std::atomic<bool> done{false};
  const afm::haptics::EditThread builder(bench.loop->edits());
  std::thread servo([&] {
    std::int64_t now_ns = 0;
    while (!done.load()) {
      bench.loop->tick(now_ns += 1'000'000, 0);
      std::this_thread::yield();
    }
  });
  bench.renderer.store(Selection{.material = kMica, .revision = 1});
  std::uint32_t revision = 0;
  while (revision < 300) {
    bench.renderer.store(RendererHeartbeat{});
    bench.renderer.store(MaterialEdit{.material = mica_on_a_lever_of(0.1 + 0.001 * revision), .revision = ++revision},
                         kMica);
    std::this_thread::yield();
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (std::chrono::steady_clock::now() < end) {
    const auto state = bench.renderer.tip_state();
    if (state && state->active.edit_revision == revision) break;
    std::this_thread::yield();
  }
  done = true;
  servo.join();
  EXPECT_EQ(bench.state().active.edit_revision, revision);
}

}  // namespace material_edit_test
