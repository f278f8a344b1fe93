// SPDX-License-Identifier: Apache-2.0
#include "scene/shared/shared_blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "scene/shared/shared_segment.h"
#include "support/paper_model.h"
#include "support/particles/gold_particles.h"

namespace shared_blocks_test {

using namespace afm::scene;
using afm::test::paper_model;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

SharedSegment create_segment() {
  auto segment = SharedSegment::create(paper_model(), 0);
  EXPECT_TRUE(segment) << segment.error().message;
  return std::move(*segment);
}

TEST(SharedBlocks, ThatAreImplausibleAreDroppedAndCounted) {
  SharedSegment segment = create_segment();
  RendererSide renderer = segment.renderer_side();
  ServoSide servo = segment.servo_side();

  renderer.store(Selection{.material = 3, .revision = 1});
  EXPECT_FALSE(servo.new_selection());
  renderer.store(HandScript{.target_m = {0, kNan, 0}});
  EXPECT_FALSE(servo.new_hand_script());
  renderer.store(HandScript{.duration_s = -1});
  EXPECT_FALSE(servo.new_hand_script());
  renderer.store(SceneTransforms{.count = 3});
  EXPECT_FALSE(servo.new_transforms());
  renderer.store(RendererHeartbeat{.leaving = 2});
  EXPECT_FALSE(servo.new_heartbeat());
  for (const ScanLead& bad :
       {ScanLead{.time_ns = -1}, ScanLead{.apex_xy_m = {kNan, 0}}, ScanLead{.height_m = kNan},
        ScanLead{.gain_per_s = -1}, ScanLead{.gain_per_s = 2 * kMostScanGainPerS},
        ScanLead{.hand = static_cast<ScanHand>(4)}, ScanLead{.feedback = 2}, ScanLead{.hand = ScanHand::Looks},
        ScanLead{.apex_xy_m = {2e-3, 0}, .height_m = 1e-9, .hand = ScanHand::Looks},
        ScanLead{.load_pn = kMostLookLoadPn + 1}}) {
    renderer.store(bad);
    EXPECT_FALSE(servo.new_scan_lead());
  }
  renderer.store(ScanLead{.hand = ScanHand::Scans, .feedback = 1});
  EXPECT_TRUE(servo.new_scan_lead());
  EXPECT_EQ(servo.refused_blocks(), 15U);

  servo.store(TipState{.tip = {.z_m = kNan}});
  EXPECT_FALSE(renderer.tip_state());
  servo.store(TipState{.servo_state = static_cast<ServoState>(77)});
  EXPECT_FALSE(renderer.tip_state());
  servo.store(TipState{.fault = static_cast<FaultCode>(14)});
  EXPECT_FALSE(renderer.tip_state());
  servo.push(TipEvent{.kind = static_cast<afm::physics::EventKind>(0)});
  servo.push(TipEvent{.kind = afm::physics::EventKind::JumpToContact, .material = 3});
  EXPECT_FALSE(renderer.pop_event());
  // events after a bad sample are still found
  servo.push(TipSample{.tip = {.force_n = kNan}});
  servo.push(TipSample{.tick = 8});
  EXPECT_EQ(renderer.pop_sample()->tick, 8U);
  EXPECT_EQ(renderer.refused_blocks(), 6U);
}

TEST(SharedBlocks, OfEveryFaultAndEveryScaleModePass) {
  SharedSegment segment = create_segment();
  RendererSide renderer = segment.renderer_side();
  ServoSide servo = segment.servo_side();
  for (const FaultText& fault : kFaultTexts) {
    servo.store(TipState{.fault = fault.code});
    EXPECT_TRUE(renderer.tip_state()) << fault.reason;
  }
  for (const ScaleModeText& scale : kScalesOfSamples) {
    renderer.store(Selection{.material = 0, .scale_mode = scale.mode});
    EXPECT_TRUE(servo.new_selection()) << scale.word;
  }
  renderer.store(Selection{.material = 0, .scale_mode = ScaleMode::Particles});
  EXPECT_FALSE(servo.new_selection()) << "there are none";
  auto with_particles = SharedSegment::create(afm::test::model_with_particles(), 0);
  ASSERT_TRUE(with_particles) << with_particles.error().message;
  with_particles->renderer_side().store(Selection{.material = 0, .scale_mode = ScaleMode::Particles});
  EXPECT_TRUE(with_particles->servo_side().new_selection());
}

TEST(SharedParticles, CrossInPagesOfWhichOnlyNewOnesAreSeen) {
  auto segment = SharedSegment::create(afm::test::model_with_particles(), 0);
  ASSERT_TRUE(segment) << segment.error().message;
  RendererSide renderer = segment->renderer_side();
  ServoSide servo = segment->servo_side();
  EXPECT_FALSE(renderer.new_particle_page(0) || renderer.tip_push() || servo.last_particle_page(0));
  ParticlePage page;
  page.poses[3].x_m = 5e-9;
  servo.store(page, 1);
  EXPECT_EQ(renderer.new_particle_page(1), page);
  EXPECT_FALSE(renderer.new_particle_page(1));
  EXPECT_FALSE(renderer.new_particle_page(0));
  EXPECT_EQ(servo.last_particle_page(1), page) << "for a successor";
  page.poses[3].orientation[2] = kNan;
  servo.store(page, 1);
  EXPECT_FALSE(renderer.new_particle_page(1) || servo.last_particle_page(1));
  EXPECT_EQ(renderer.refused_blocks(), 1U);

  servo.store(TipPush{.tick = 4, .hand_n_per_n = 2e10, .particle = 2});
  EXPECT_EQ(renderer.tip_push()->tick, 4U);
  servo.store(TipPush{.particle = 3});
  EXPECT_FALSE(renderer.tip_push()) << "there are three";
  servo.store(TipPush{.base_m = {kNan, 0.0, 0.0}});
  EXPECT_FALSE(renderer.tip_push());
  servo.push(TipSample{.push = {.particle = 3}});
  EXPECT_FALSE(renderer.pop_sample());
}

TEST(SharedParticles, ArePlannedOnceByAPlanThatCanBe) {
  auto segment = SharedSegment::create(afm::test::model_with_particles(), 0);
  ASSERT_TRUE(segment);
  RendererSide renderer = segment->renderer_side();
  ServoSide servo = segment->servo_side();
  const PlannedPush plan{.from_m = {-8e-8, 0.0}, .to_m = {1e-7, 2e-8}, .particle = 2, .guided = 1};
  renderer.store(plan);
  EXPECT_EQ(servo.new_plan(), plan);
  EXPECT_FALSE(servo.new_plan());
  renderer.store(PlannedPush{});
  EXPECT_EQ(servo.new_plan(), PlannedPush{});
  std::vector<PlannedPush> bad(7, plan);
  bad[0].from_m[1] = kNan;
  bad[1].to_m[0] = std::numeric_limits<double>::infinity();
  bad[2].to_m = plan.from_m;
  bad[3].to_m[1] = -2.0 * kFarthestPlanM;
  bad[4].particle = 3;
  bad[5].guided = 2;
  bad[6].particle = kNoParticle;
  for (const PlannedPush& each : bad) {
    renderer.store(each);
    EXPECT_FALSE(servo.new_plan());
  }
  EXPECT_EQ(servo.refused_blocks(), bad.size());
}

TEST(SharedParticles, AreRefusedWithAReason) {
  const auto refused = [](auto&& spoil) {
    SharedParticles particles = afm::test::model_with_particles().particles;
    spoil(particles);
    const auto valid = validate(particles);
    return valid ? std::string("accepted") : valid.error().message;
  };
  EXPECT_EQ(refused([](SharedParticles&) {}), "accepted");
  EXPECT_EQ(refused([](SharedParticles& p) { p = {}; }), "accepted");
  EXPECT_EQ(refused([](SharedParticles& p) { p.count = 2049; }),
            "the shared scene has 2049 particles of 1 species: the limits are 2048 particles and 1 to 8 species");
  EXPECT_EQ(refused([](SharedParticles& p) { p.particles[1].x_m = kNan; }),
            "the place of a particle in the shared scene is invalid");
  EXPECT_EQ(
      refused([](SharedParticles& p) { p.particles[1].x_m = -79e-9; }),
      "the particles of the shared scene: particles 1 and 2 overlap: their centres are 1 nm apart and touch at 50 "
      "nm");
  EXPECT_EQ(refused([](SharedParticles& p) { p.particles[1].species = 1; }),
            "the particles of the shared scene: particle 2 is of an unknown species");
  EXPECT_EQ(refused([](SharedParticles& p) { p.species[0].law = static_cast<afm::physics::ParticleLaw>(9); }),
            "the name or the law of particle species 0 is invalid");
  EXPECT_EQ(refused([](SharedParticles& p) { p.species[0].sticks = 2; }),
            "the adhesion of particle species 0 is invalid");
  EXPECT_EQ(refused([](SharedParticles& p) { p.pusher.threshold_on_hand_n = 0.0; }),
            "the size or the threshold of the particles in a hand is impossible");
}

// Makes each number of a block NaN in turn; returns how many there are.
template <class Block>
int expect_every_number_is_checked(const SharedModel& model) {
  const Block good{};
  EXPECT_TRUE(is_valid(good, model));
  int numbers = 0;
  const auto spoil = [&](const char* name, const double& number) {
    Block bad = good;
    const auto offset = reinterpret_cast<const std::byte*>(&number) - reinterpret_cast<const std::byte*>(&good);
    std::memcpy(reinterpret_cast<std::byte*>(&bad) + offset, &kNan, sizeof(double));
    EXPECT_FALSE(is_valid(bad, model)) << name;
    ++numbers;
  };
  for_each_leaf(
      [&]<class Value>(const char* name, const Value& value) {
        if constexpr (std::is_same_v<Value, double>) {
          spoil(name, value);
        } else if constexpr (!std::is_integral_v<Value> && !std::is_enum_v<Value>) {
          for (const double& number : value) spoil(name, number);
        }
      },
      good);
  return numbers;
}

TEST(SharedBlocks, AreRefusedForAnyNumberThatIsNotFinite) {
  const SharedModel model = paper_model();
  EXPECT_EQ(expect_every_number_is_checked<TipState>(model), 5 + 3 + 3 + 6 + 4 + 6 + 2 + 2);
  EXPECT_EQ(expect_every_number_is_checked<TipSample>(model), 5 + 3 + 2 + 9 + 1 + 2 + 4 + 4 + 2 + 4 + 2);
  EXPECT_EQ(expect_every_number_is_checked<TipPush>(model), 3 + 3 + 2 + 4 + 4 + 4 + 3 + 2);
  EXPECT_EQ(expect_every_number_is_checked<TipEvent>(model), 3);
}

TEST(SharedBlocks, SayYesOrNoByOneOrZeroAlone) {
  const SharedModel model = paper_model();
  SharedDevice device{.max_force_n = 1,
                      .max_continuous_force_n = 1,
                      .max_stiffness_n_per_m = 1,
                      .max_slew_n_per_s = 1,
                      .max_speed_m_per_s = 1};
  for (const std::uint32_t answer : {0U, 1U, 2U, ~0U}) {
    const bool good = answer <= 1;
    EXPECT_EQ(is_valid(HandScript{.turn_on_pressed = answer}), good) << answer;
    EXPECT_EQ(is_valid(RendererHeartbeat{.leaving = answer}), good) << answer;
    EXPECT_EQ(is_valid(RendererHeartbeat{.stop = answer}), good) << answer;
    EXPECT_EQ(is_valid(RendererHeartbeat{.unseen = answer}), good) << answer;
    EXPECT_EQ(is_valid(TipSample{.device_healthy = answer}, model), good) << answer;
    EXPECT_EQ(is_valid(TipSample{.changing = answer}, model), good) << answer;
    EXPECT_EQ(is_valid(TipPush{.met = static_cast<std::uint8_t>(answer)}, model), good) << answer;
    EXPECT_EQ(is_valid(TipPush{.lagging = static_cast<std::uint8_t>(answer)}, model), good) << answer;
    device.has_own_hand = answer;
    EXPECT_EQ(is_valid(device), good) << answer;
  }
  for (const double most_n : {0.0, 0.1, -0.1, std::nan(""), HUGE_VAL}) {
    device.has_own_hand = 1;
    device.max_vibration_n = most_n;
    EXPECT_EQ(is_valid(device), most_n == 0.0 || most_n == 0.1) << most_n;
  }
  EXPECT_TRUE(is_valid(TipPush{.strokes = kMostStrokes}, model));
  EXPECT_FALSE(is_valid(TipPush{.strokes = kMostStrokes + 1}, model));
}

TEST(SharedContact, WhoseHeightFieldIsNotThereLiesOnAPlane) {
  for (const std::uint32_t missing : {0U, 1U, kNoHeightField}) {
    EXPECT_EQ(surface_of({.height_field = missing}, {}, {}).columns, 0U) << missing;
  }
}

// Each friction with each law, and the properties that a law of force must have for it.
TEST(SharedContact, HasFrictionWhereItsLawOfForceHasWhatItNeeds) {
  using namespace afm::physics;
  const Pressure modulus(1e9), rigid(std::numeric_limits<double>::infinity());
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(Law::Count); ++i) {
    const Law law = static_cast<Law>(i);
    const bool contact = law == Law::Hertz || law == Law::Dmt || law == Law::Jkr || law == Law::MaugisDugdale;
    EXPECT_EQ(why_no_friction(FrictionLaw::None, law, rigid), "") << name_of(law);
    for (const FrictionLaw friction : {FrictionLaw::Amontons, FrictionLaw::Lattice}) {
      EXPECT_EQ(why_no_friction(friction, law, rigid).empty(), law != Law::Paper) << name_of(law);
    }
    EXPECT_EQ(why_no_friction(FrictionLaw::ContactArea, law, modulus).empty(), contact) << name_of(law);
    EXPECT_FALSE(why_no_friction(FrictionLaw::ContactArea, law, rigid).empty()) << name_of(law);
  }
}

TEST(SharedBlocks, MadeOfRandomBytesCrashNobody) {
  SharedSegment segment = create_segment();
  const auto size = static_cast<std::size_t>(::lseek(segment.descriptor(), 0, SEEK_END));
  std::mt19937_64 random(3);
  std::vector<std::uint64_t> noise(size / sizeof(std::uint64_t));
  for (int round = 0; round < 20; ++round) {
    for (auto& word : noise) word = random();
    // everything but the header and the model, which attach() has validated
    constexpr std::size_t kPage = 4096;
    constexpr std::size_t kConstantPart = (1 + (sizeof(SharedModel) + kPage - 1) / kPage) * kPage;
    ASSERT_GT(::pwrite(segment.descriptor(), noise.data(), size - kConstantPart, kConstantPart), 0);
    RendererSide renderer = segment.renderer_side();
    ServoSide servo = segment.servo_side();
    EditSide edits = segment.edit_side();
    for (int i = 0; i < 3; ++i) {
      const auto selection = servo.new_selection();
      EXPECT_TRUE(!selection || selection->material < 3);
      const auto state = renderer.tip_state();
      EXPECT_TRUE(!state || std::isfinite(state->tip.z_m));
      servo.new_transforms();
      servo.new_hand_script();
      const auto lead = servo.new_scan_lead();
      EXPECT_TRUE(!lead || std::isfinite(lead->height_m));
      servo.new_heartbeat();
      const auto edit = edits.new_edit(0);
      EXPECT_FALSE(edit && validate(edit->material, 0, 0));
      while (renderer.pop_sample()) {
      }
      while (renderer.pop_event()) {
      }
    }
  }
}

}  // namespace shared_blocks_test
