// SPDX-License-Identifier: Apache-2.0
// Invariant: a picture of pushed particles is measured only where a second look has scanned it
#include "physics/manipulation/operators_picture.h"

#include <gtest/gtest.h>

#include <vector>

#include "pushing.h"

namespace afm::physics {
namespace operators_picture_test {

using namespace literals;
using test::base_at;

constexpr double kRateHz = 500.0;

// Two spheres of gold, the hand that pushes the first, and the picture that the hand has.
class Scene {
 public:
  explicit Scene(bool apart, const Sideways<Length>& drift = {})
      : drift_(drift),
        particles_(setup(), spheres(), base_at(-60e-9, 1e-9, 80e-9)),
        picture_(setup(), spheres(), base_at(-60e-9, 1e-9, 80e-9), apart, true) {}

  static PushSetup setup() {
    return {.tip = test::flank_tip(10_nm),
            .springs = {Stiffness(10.0), Stiffness(1.0), Stiffness(100.0)},
            .tip_friction = 0.3,
            .species = {test::gold()}};
  }
  static std::vector<PlacedParticle> spheres() {
    return {{.species = 0, .position = {0_nm, 0_nm}}, {.species = 0, .position = {Length(90e-9), Length(5e-9)}}};
  }

  void go(double x_nm, double z_nm, double seconds) {
    const LeverBase from = base_, to = base_at(1e-9 * x_nm, 1e-9, 1e-9 * z_nm);
    const int ticks = static_cast<int>(seconds * kRateHz);
    for (int i = 1; i <= ticks; ++i) {
      const double share = static_cast<double>(i) / ticks;
      base_ = {from.position + (to.position - from.position) * share, from.z + (to.z - from.z) * share};
      particles_.move_to({base_.position - drift_, base_.z}, Time(1.0 / kRateHz));
      picture_.follow(base_, Time(1.0 / kRateHz), particles_, drift_);
    }
  }
  void push() {
    go(-60, 0, 0.5);
    go(40, 0, 1.0);
  }

  const PushedParticles& particles() const { return particles_; }
  const OperatorsPicture& picture() const { return picture_; }

 private:
  LeverBase base_ = base_at(-60e-9, 1e-9, 80e-9);
  Sideways<Length> drift_;
  PushedParticles particles_;
  OperatorsPicture picture_;
};

TEST(OperatorsPicture, IsComputedOnceTheHandIsLifted) {
  Scene scene(false);
  scene.push();
  EXPECT_GT(scene.particles().position(1).x.si, 90e-9) << "the first pushes the second";
  EXPECT_EQ(scene.picture().picture().computed(), 0U);
  scene.go(40, 80, 0.5);
  EXPECT_GT(scene.picture().picture().computed(), 0U);
  std::vector<PlacedParticle> there = Scene::spheres();
  for (std::size_t i = 0; i < there.size(); ++i) {
    EXPECT_FALSE(scene.picture().is_measured(i));
    there[i].position = scene.particles().position(i);
  }
  const ParticlePicture whole(Scene::setup(), there, frame_around(Scene::setup(), Scene::spheres()));
  EXPECT_EQ(scene.picture().picture().heights().height_m, whole.heights().height_m);
}

TEST(OperatorsPicture, OfAModelWithoutDriftIsThatOfTheParticles) {
  Scene scene(true);
  scene.push();
  scene.go(40, 80, 0.5);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(scene.picture().shown()[i].position, scene.particles().position(i)) << "bit for bit";
  }
}

TEST(OperatorsPicture, IsMeasuredWhereTheHandLooksAgain) {
  const Sideways<Length> drift{0_nm, 3_nm};
  Scene scene(true, drift);
  scene.push();
  scene.go(40, 80, 0.5);
  scene.go(40, 80, 1.8);
  EXPECT_FALSE(scene.picture().all_measured()) << "the hand has not waited long enough";
  scene.go(40, 80, 4.0);
  ASSERT_EQ(scene.picture().looks().size(), 1U);
  const SecondLook& look = scene.picture().looks()[0];
  EXPECT_EQ(look.lines, kLookLines);
  ASSERT_TRUE(look.measured);
  EXPECT_EQ(look.measured->position, scene.particles().position(look.particle) + drift);
  EXPECT_TRUE(scene.picture().all_measured()) << "both are in the box";
  scene.go(40, 80, 6.0);
  EXPECT_EQ(scene.picture().looks().size(), 1U) << "nothing is left to look at";
}

TEST(OperatorsPicture, HasTheLinesOfALookThatTheHandEnds) {
  Scene scene(true, {0_nm, 3_nm});
  scene.push();
  scene.go(40, 80, 0.5);
  scene.go(40, 80, 2.75);
  scene.go(40, 0, 0.5);
  ASSERT_EQ(scene.picture().looks().size(), 1U);
  const SecondLook& look = scene.picture().looks()[0];
  EXPECT_GT(look.lines, 3U);
  EXPECT_LT(look.lines, 14U);
  EXPECT_FALSE(look.measured) << "the middle is in a later line";
  EXPECT_FALSE(scene.picture().all_measured());
  EXPECT_GT(scene.picture().picture().computed(), 0U);
}

}  // namespace operators_picture_test
}  // namespace afm::physics
