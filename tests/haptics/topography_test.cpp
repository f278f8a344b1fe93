// SPDX-License-Identifier: Apache-2.0
// Invariant: the force is the gradient of a potential, sideways too
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "haptics/contact_model.h"
#include "haptics/safety.h"
#include "haptics/sample_axes.h"
#include "physics/contact.h"
#include "servo_bench.h"
#include "support/samples/measured_surface.h"
#include "support/samples/rough_surface.h"

namespace topography_test {

using namespace afm::haptics;
using afm::physics::Phase;
using afm::scene::ScaleMode;
using afm::test::kGold;
using afm::test::kMica;
using afm::test::kSiliconNitride;
using afm::test::required;
using afm::test::rough_model;
using afm::test::ServoBench;

afm::physics::ApproachRetractEvents calculated(std::int32_t material) {
  return afm::physics::approach_retract_events(
      afm::test::paper_model().materials[static_cast<std::size_t>(material)].contact);
}

class Topography : public testing::TestWithParam<std::tuple<std::int32_t, ScaleMode>> {
 protected:
  static constexpr double kStepM = 20e-6;  // motion of a hand per tick

  const std::int32_t material_ = std::get<std::int32_t>(GetParam());
  const std::unique_ptr<afm::scene::SharedModel> model_ = std::make_unique<afm::scene::SharedModel>(rough_model());
  const std::unique_ptr<ContactModel> contact_model_ = make();
  std::mt19937 random_{static_cast<std::uint32_t>(material_) + 11};

  std::unique_ptr<ContactModel> make() const {
    const DeviceSpec omni = omni_like("an Omni");
    std::vector<std::shared_ptr<const afm::physics::LawTables>> tables;
    for (std::uint32_t i = 0; i < model_->material_count; ++i) {
      tables.push_back(required(build_tables(model_->materials[i], {})));
    }
    const auto index = static_cast<std::size_t>(material_);
    auto contact_model =
        required(ContactModel::create(model_->materials[index], 0, tables[index], model_->height_fields.data(),
                                      *Scaling::common_scale(tables, omni), omni, 1'000'000));
    contact_model->use(std::get<ScaleMode>(GetParam()));
    return contact_model;
  }

  double random(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  // Height of the hand for a Z above the plane of z = 0.
  double height(double z_m) const { return contact_model_->scaling().hand_height_m(z_m); }

  // Attaches the tip at this place and leaves it at `height_m`.
  void attach(const glm::dvec2& xy_m, double height_m) {
    for (const double at : {height(2.0 * calculated(material_).z_joc.si), height(-5e-9), height_m}) {
      contact_model_->step(glm::dvec3(xy_m, at));
    }
    ASSERT_EQ(contact_model_->phase(), Phase::Attached);
  }
};

TEST_P(Topography, JumpsWithTheForcesOfTheEquationsWhereverItIs) {
  const auto expected = calculated(material_);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec2 xy(random(-0.07, 0.07), random(-0.07, 0.07));
    std::vector<afm::physics::ModelEvent> events;
    const double top = height(expected.z_joc.si) + 0.01, bottom = height(-3e-9) - 0.005;
    const double step = random(20e-6, 400e-6);
    const auto feel = [&](double at) {
      const Touch touch = contact_model_->step(glm::dvec3(xy, at));
      for (std::uint32_t k = 0; k < touch.response.event_count; ++k) events.push_back(touch.response.events[k]);
    };
    for (double at = top; at > bottom; at -= step) feel(at);
    for (double at = bottom; at < top; at += step) feel(at);
    ASSERT_EQ(events.size(), 2U);
    ASSERT_NEAR(events[0].z.si, expected.z_jtc.si, 1e-9 * expected.z_jtc.si);
    ASSERT_NEAR(events[0].force_after.si, -expected.f_attr.si, 1e-9 * expected.f_attr.si);
    ASSERT_NEAR(events[1].z.si, expected.z_joc.si, 1e-9 * expected.z_joc.si);
    ASSERT_NEAR(events[1].force_before.si, -expected.f_ad.si, 1e-9 * expected.f_ad.si);
  }
}

TEST_P(Topography, PushesAlongTheNormalOfTheSurfaceBelowTheTip) {
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec2 xy(random(-0.03, 0.03), random(-0.03, 0.03));
    attach(xy, height(random(-3e-9, 1e-9)));
    const Touch touch = contact_model_->step(glm::dvec3(xy, height(random(-3e-9, 1e-9))));
    const auto place = contact_model_->surface().at(touch.tip_xy_m);
    EXPECT_EQ(touch.surface_height_m, place.height_m);
    EXPECT_NEAR(glm::length(glm::cross(touch.hand_force_n, touch.normal)), 0.0, 1e-12);
    EXPECT_NEAR(touch.hand_force_n.z, contact_model_->scaling().hand_force_n(touch.response.force.si), 1e-15);
    EXPECT_LE(glm::length(touch.hand_force_n), 1.1 * std::abs(touch.hand_force_n.z) + 1e-15);
  }
}

TEST_P(Topography, TakesAndGivesNoEnergyOnClosedPathsOfOneBranch) {
  for (int path = 0; path < 60; ++path) {
    // a closed curve of three tones in each direction, in space
    glm::dvec3 amplitude[3], phase[3];
    for (int tone = 0; tone < 3; ++tone) {
      amplitude[tone] = {random(0.0, 0.01), random(0.0, 0.01), random(0.0, 0.001)};
      phase[tone] = {random(0.0, 6.28), random(0.0, 6.28), random(0.0, 6.28)};
    }
    const glm::dvec3 middle(random(-0.01, 0.01), random(-0.01, 0.01), height(-2e-9));
    const auto at = [&](double turn) {
      glm::dvec3 place = middle;
      for (int tone = 0; tone < 3; ++tone) {
        place += amplitude[tone] * glm::sin((tone + 1.0) * 6.283185307179586 * turn + phase[tone]);
      }
      return place;
    };
    attach(glm::dvec2(at(0.0)), at(0.0).z);
    constexpr int kSteps = 4000;
    double work_j = 0, moved_j = 0;
    Touch before = contact_model_->step(at(0.0));
    for (int i = 1; i <= kSteps; ++i) {
      const glm::dvec3 step = at(static_cast<double>(i) / kSteps) - at((i - 1.0) / kSteps);
      const Touch here = contact_model_->step(at(static_cast<double>(i) / kSteps));
      ASSERT_EQ(here.response.phase, Phase::Attached);
      const double part_j = glm::dot(0.5 * (before.hand_force_n + here.hand_force_n), step);
      work_j += part_j;
      moved_j += std::abs(part_j);
      before = here;
    }
    // error of the trapezoidal rule over a path with steps of some 20 micrometres
    ASSERT_LE(std::abs(work_j), 1e-4 * moved_j + 1e-9);
  }
}

TEST_P(Topography, GivesAForceThatNeverJumpsOnABranch) {
  // along z the law's stiffness, and the compressed one's; sideways force times curvature, and stiffness times slope
  const double stiffness = 2.0 * Scaling::kMaxStiffnessNPerM;
  glm::dvec3 at(0.0, 0.0, height(-2e-9));
  attach(glm::dvec2(at), at.z);
  Touch before = contact_model_->step(at);
  for (int i = 0; i < 50'000; ++i) {
    glm::dvec3 next = at + kStepM * glm::dvec3(random(-1, 1), random(-1, 1), random(-1, 1));
    next.z = std::clamp(next.z, height(-4e-9), height(0.0));
    const Touch here = contact_model_->step(next);
    ASSERT_EQ(here.response.phase, Phase::Attached);
    ASSERT_LE(glm::length(here.hand_force_n - before.hand_force_n), stiffness * glm::length(next - at) + 1e-12);
    at = next;
    before = here;
  }
}

INSTANTIATE_TEST_SUITE_P(Papers, Topography,
                         testing::Combine(testing::Values(kMica, kGold, kSiliconNitride),
                                          testing::Values(ScaleMode::Common, ScaleMode::Fit, ScaleMode::Compressed)));

TEST(TopographyOfTheMostPoints, TakesAndGivesNoEnergyOnClosedPathsOfOneBranch) {
  const afm::scene::Topography measured = afm::test::measured_surface();
  const auto model = std::make_unique<afm::scene::SharedModel>(afm::test::measured_model(measured));
  const auto contact =
      afm::test::model_of(model->materials[kMica], afm::scene::FeltHeights(measured, afm::test::kMeasuredScale));
  const auto height = [&](double z_m) { return contact->scaling().hand_height_m(z_m); };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1.0, 1.0), turn_of(0.0, 6.28);
  for (int path = 0; path < 40; ++path) {
    const glm::dvec3 middle{0.03 * part(random), 0.03 * part(random), height(-8e-9)};
    const glm::dvec3 amplitude{0.02 * part(random), 0.02 * part(random), 0.001 * part(random)};
    const glm::dvec3 phase{turn_of(random), turn_of(random), turn_of(random)};
    const auto at = [&](double turn) {
      return middle + amplitude * glm::sin(glm::dvec3(1.0, 2.0, 3.0) * 6.283185307179586 * turn + phase);
    };
    for (const double z : {height(60e-9), height(-30e-9), at(0.0).z})
      contact->step(glm::dvec3(at(0.0).x, at(0.0).y, z));
    constexpr int kSteps = 8000;
    double work_j = 0, moved_j = 0;
    Touch before = contact->step(at(0.0));
    for (int i = 1; i <= kSteps; ++i) {
      const glm::dvec3 here_m = at(static_cast<double>(i) / kSteps), step = here_m - at((i - 1.0) / kSteps);
      const Touch here = contact->step(here_m);
      ASSERT_EQ(here.response.phase, Phase::Attached);
      const double part_j = glm::dot(0.5 * (before.hand_force_n + here.hand_force_n), step);
      work_j += part_j;
      moved_j += std::abs(part_j);
      before = here;
    }
    ASSERT_LE(std::abs(work_j), 1e-4 * moved_j + 1e-9);
  }
}

// The picture fits the stroke: a sample that keeps its place in it has the size of the stroke. Other parameters then
// change how the hand feels it no more than how it is drawn.
TEST(TopographyWithOtherParameters, HasTheSizeOfTheStroke) {
  const afm::scene::Topography measured = afm::test::measured_surface();
  const auto model = std::make_unique<afm::scene::SharedModel>(afm::test::measured_model(measured));
  const afm::scene::FeltHeights shown(measured, afm::test::kMeasuredScale);
  afm::scene::SharedContact own = model->materials[kMica];
  own.surface_release_m = afm::test::calculated(kMica).z_joc.si;
  const auto felt = afm::test::model_of(own, shown);
  for (const double times : {0.25, 4.0}) {
    afm::scene::SharedContact changed = own;
    changed.contact.spring_constant.si *= times;
    const auto other = afm::test::model_of(changed, shown);
    const double stroke = other->scaling().release_z_m() / felt->scaling().release_z_m();
    ASSERT_NEAR(stroke, 1.0 / times, 0.1 / times);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec2 place_m = shown.spacing_m * shown.columns * glm::dvec2(0.004 * i - 0.4, 0.003 * i - 0.3);
      const auto here = felt->surface().at(place_m), there = other->surface().at(stroke * place_m);
      ASSERT_NEAR(there.height_m, stroke * here.height_m, 1e-6 * shown.spacing_m) << times << ", place " << i;
      ASSERT_NEAR(glm::distance(there.slope, here.slope), 0.0, 1e-6);
    }
  }
}

// ---- the whole servo ----

std::array<double, 16> turned(const glm::dmat4& turn) {
  // the sample's +z up, its +x to the right
  const glm::dmat4 room_from_sample = turn * glm::dmat4(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0.3, 1.5, -0.2, 1);
  std::array<double, 16> numbers{};
  std::copy_n(glm::value_ptr(room_from_sample), numbers.size(), numbers.begin());
  return numbers;
}

class TurnedSample : public testing::Test {
 protected:
  // Presses the tip on the sample, with the room turned by `turn`, and returns the servo's state.
  static afm::scene::TipState press(const glm::dmat4& turn) {
    ServoBench bench(rough_model());
    afm::scene::SceneTransforms transforms;
    transforms.count = 2;
    transforms.room_from_node[1] = turned(turn);
    bench.renderer.store(transforms);
    const auto aim = [&](const glm::dvec3& place, double seconds, bool pressed) {
      const glm::dvec3 target(turn * glm::dvec4(place, 0.0));
      bench.renderer.store(afm::scene::HandScript{.target_m = {target.x, target.y, target.z},
                                                  .duration_s = seconds,
                                                  .revision = ++bench.script,
                                                  .turn_on_pressed = pressed ? 1U : 0U});
    };
    bench.choose(kMica);
    aim({0.007, 0.060, 0.004}, 0.3, false);
    bench.run(1.3);
    aim({0.007, 0.060, 0.004}, 0.0, true);
    bench.run(0.8);
    aim({0.007, -0.02, 0.004}, 0.5, false);
    bench.run(2.0);
    EXPECT_EQ(bench.state().servo_state, afm::scene::ServoState::Running);
    return bench.state();
  }

  static glm::dvec3 vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
};

TEST_F(TurnedSample, TurnsHeightAxesAndForceTogether) {
  const afm::scene::TipState level = press(glm::dmat4(1.0));
  ASSERT_GT(glm::length(vector(level.hand.force_n)), 0.2);
  EXPECT_GT(std::abs(level.normal[0]) + std::abs(level.normal[2]), 0.01) << "the place is flat";
  EXPECT_NEAR(glm::length(glm::cross(vector(level.normal), glm::normalize(vector(level.hand.force_n)))), 0.0, 1e-12);

  const double thirty = glm::radians(30.0);
  for (const glm::dvec3& axis :
       {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::normalize(glm::dvec3(1, 2, -1)), glm::dvec3(0, 1, 0)}) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), thirty, axis);
    const afm::scene::TipState state = press(turn);
    // the simulated hand's friction and quantiser are along the device's axes: it rests a little elsewhere
    const glm::dvec3 normal(vector(state.normal)), force(vector(state.hand.force_n));
    EXPECT_NEAR(glm::length(glm::cross(normal, glm::normalize(force))), 0.0, 1e-12);
    EXPECT_GT(glm::length(glm::dvec3(turn * glm::dvec4(vector(level.normal), 0.0)) - vector(level.normal)), 0.02);
    EXPECT_LT(glm::length(glm::dvec3(turn * glm::dvec4(vector(level.normal), 0.0)) - normal), 0.05);
    EXPECT_NEAR(state.surface.xy_m[0], level.surface.xy_m[0], 0.2e-9);
    EXPECT_NEAR(state.surface.xy_m[1], level.surface.xy_m[1], 0.2e-9);
  }
}

// Somebody turns the sample to and fro under a tip that hangs on it: the spring is stretched by another hand than the
// one that feels it.
TEST_F(TurnedSample, GivesTheHandNothingThatWouldHaveToBeDamped) {
  ServoBench bench(rough_model());
  bench.hold_attached(kMica);
  const double before_j = bench.state().safety.excess_energy_j;
  afm::scene::SceneTransforms transforms;
  transforms.count = 2;
  for (int i = 1; i <= 2000; ++i) {
    const double angle = glm::radians(25.0) * std::sin(glm::radians(0.36 * i));
    transforms.room_from_node[1] = turned(glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0, 0, 1)));
    bench.renderer.store(transforms);
    bench.tick();
    ASSERT_EQ(bench.state().phase, Phase::Attached) << i;
    ASSERT_LE(bench.state().safety.excess_energy_j, before_j + 1e-4) << i;
  }
}

// On a plateau, 14 mm high for the hand: it is lifted, comes down to this height above the plateau at which Turn-On is
// safe, and presses.
afm::scene::ServoState after_turn_on_above_a_plateau(double height_m) {
  const auto plain = afm::test::model_of(afm::test::paper_model().materials[kGold]);
  const double plateau_m = 0.014;
  auto model = std::make_unique<afm::scene::SharedModel>(rough_model());
  afm::scene::SharedHeightField& field = model->height_fields[0];
  field.height_m.fill(static_cast<float>(plateau_m / plain->scaling().hand_m_per_m()));
  ServoBench bench(*model);
  const double safe_m = plain->scaling().release_height_m() + SafetyGovernor::kArmingMarginM;
  bench.choose(kGold);
  bench.move(plateau_m + safe_m + 0.01, 0.3);
  bench.run(1.0);
  bench.move(plateau_m + safe_m + height_m, 0.3);
  bench.run(0.5);
  EXPECT_EQ(bench.state().phase, Phase::Free) << height_m;
  bench.aim(plateau_m + safe_m + height_m, 0.0, true);
  bench.run(0.3);
  return bench.state().servo_state;
}

TEST(TopographyOfAPlateau, IsArmedAtAHeightAboveItselfAndNotAboveThePlane) {
  EXPECT_NE(after_turn_on_above_a_plateau(0.005), afm::scene::ServoState::Disarmed);
  EXPECT_EQ(after_turn_on_above_a_plateau(-0.004), afm::scene::ServoState::Disarmed);
}

TEST(SampleAxes, TurnWhatTheHandMeetsExactly) {
  const auto model = std::make_unique<afm::scene::SharedModel>(rough_model());
  const auto contact_model = afm::test::model_of(model->materials[kMica], model->height_fields.data());
  const auto press = [&](const glm::dmat4& turn) {
    SampleAxes axes;
    EXPECT_TRUE(axes.set_orientation(turned(turn)));
    contact_model->wait_for_lift();
    glm::dvec3 force_n(0.0);
    for (const double height : {0.06, -0.02, -0.01}) {
      const glm::dvec3 hand(turn * glm::dvec4(0.007, height, 0.004, 0.0));
      force_n = axes.in_device(contact_model->step(axes.in_sample(hand)).hand_force_n);
    }
    return force_n;
  };
  const glm::dvec3 level = press(glm::dmat4(1.0));
  ASSERT_GT(glm::length(level), 0.1);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), i == 0 ? glm::radians(30.0) : 3.0 * any(random),
                                        glm::normalize(glm::dvec3{any(random), any(random), any(random) + 2.0}));
    EXPECT_LT(glm::length(press(turn) - glm::dvec3(turn * glm::dvec4(level, 0.0))), 1e-12);
  }
}

TEST(SampleAxes, IgnoreSizeAndPlace) {
  SampleAxes axes, small;
  EXPECT_TRUE(axes.set_orientation(turned(glm::dmat4(1.0))));
  EXPECT_TRUE(small.set_orientation(turned(glm::scale(glm::dmat4(1.0), glm::dvec3(1e-3)))));
  EXPECT_LT(glm::length(axes.normal() - small.normal()) + glm::length(axes.x() - small.x()), 1e-15);
}

TEST(SampleAxes, StayWhereATransformIsNoUse) {
  SampleAxes axes;
  ASSERT_TRUE(axes.set_orientation(turned(glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(1, 1, 0)))));
  const glm::dvec3 normal = axes.normal();
  std::array<double, 16> flat = turned(glm::dmat4(1.0));
  flat[8] = flat[9] = flat[10] = 0.0;
  EXPECT_FALSE(axes.set_orientation(flat));
  std::array<double, 16> sheared = turned(glm::dmat4(1.0));
  for (std::size_t i = 0; i < 3; ++i) sheared[i] = -2.0 * sheared[8 + i];
  EXPECT_FALSE(axes.set_orientation(sheared));
  std::array<double, 16> endless = turned(glm::dmat4(1.0));
  endless[0] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(axes.set_orientation(endless));
  EXPECT_EQ(axes.normal(), normal);
}

}  // namespace topography_test
