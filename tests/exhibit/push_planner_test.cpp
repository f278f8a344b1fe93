// SPDX-License-Identifier: Apache-2.0
// Plans of pushes, made with keys and with a pointer at the drawn sample, and what they ask of a hand.
#include "exhibit/scenery/push_planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "exhibit/models/user_models.h"
#include "exhibit/scenery/wall_scene.h"
#include "exhibit/state/plan_figures.h"
#include "physics/manipulation/push_figures.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/pattern_state.h"
#include "scene/shared/shared_segment.h"
#include "support/paper_wall.h"
#include "support/particles/particle_sets.h"

namespace afm::exhibit {
namespace push_planner_test {

using testing::HasSubstr;
using testing::StartsWith;

class Planner : public test::PaperWall {
 protected:
  ParticlesNow now() const { return {.set = &set_, .pages = pages_, .push = {.hand_m_per_m = 1e5}}; }
  glm::dvec2 place_m(std::size_t particle) const {
    return {pages_[0].poses[particle].x_m, pages_[0].poses[particle].y_m};
  }
  static glm::dvec2 to_m(const PushPlanner& planner) { return {planner.plan().to_m[0], planner.plan().to_m[1]}; }
  // Valid for a servo with these particles.
  bool can_be_sent(const PushPlanner& planner) const {
    const auto model = std::make_unique<scene::SharedModel>();
    model->particles = scene::shared_particles(set_);
    return scene::is_valid(planner.plan(), *model);
  }

  scene::ParticleSet set_ = test::particle_set("gold-row");
  std::vector<scene::ParticlePage> pages_ = test::start_pages(set_);
};

TEST_F(Planner, GoesThroughSpheresAndPlacesByKeys) {
  PushPlanner planner(set_);
  EXPECT_EQ(planner.plan(), scene::PlannedPush{});
  EXPECT_TRUE(can_be_sent(planner));
  const auto pattern = pattern_of(now()).value();
  const auto targets = scene::shared_targets(set_);
  for (std::size_t i = 0; i < set_.particles.size(); ++i) {
    EXPECT_THAT(planner.next_particle(now()), StartsWith("plan: particle " + std::to_string(i + 1) + ", "));
    EXPECT_EQ(planner.plan().particle, static_cast<std::int32_t>(i));
    EXPECT_EQ(planner.plan().from_m[0], place_m(i).x);
    EXPECT_TRUE(can_be_sent(planner));
    EXPECT_EQ(planner.plan().guided, 0U) << "off by default";
  }
  EXPECT_EQ(planner.next_particle(now()), "plan: none");
  EXPECT_EQ(planner.plan(), scene::PlannedPush{});

  // the cross that the pattern assigns comes first, then the others, each once
  planner.next_particle(now());
  std::size_t assigned = 0;
  while (pattern.match.particles[assigned] != 0) ++assigned;
  for (std::size_t i = 0; i <= targets.size(); ++i) {
    const auto& target = targets[(assigned + i) % targets.size()].position;
    EXPECT_EQ(to_m(planner), glm::dvec2(target.x.si, target.y.si)) << i;
    planner.next_place(now());
  }
}

TEST_F(Planner, SkipsThePlaceWhereTheSphereLies) {
  const auto targets = scene::shared_targets(set_);
  pages_ = test::formed_pages(set_);
  pages_[0].poses[0].x_m = targets[0].position.x.si;
  PushPlanner planner(set_);
  planner.next_particle(now());
  for (std::size_t i = 0; i < 2 * targets.size(); ++i) {
    EXPECT_GT(glm::distance(to_m(planner), place_m(0)), 1e-9) << i;
    EXPECT_TRUE(can_be_sent(planner));
    planner.next_place(now());
  }
}

TEST_F(Planner, HasEightWaysOfThreeRhoWithoutAPattern) {
  set_.targets.clear();
  PushPlanner planner(set_);
  planner.next_place(now());  // also begins with a sphere
  ASSERT_EQ(planner.plan().particle, 0);
  const double rho_m = physics::side_contact(set_.setup.tip, physics::Length(25e-9), physics::Length(0.0)).distance.si;
  for (int i = 0; i < 9; ++i) {
    const double angle = i * std::numbers::pi / 4.0;
    const glm::dvec2 way(std::cos(angle), std::sin(angle));
    EXPECT_LT(glm::distance(to_m(planner), place_m(0) + 3.0 * rho_m * way), 1e-15) << i;
    planner.next_place(now());
  }
}

TEST_F(Planner, PlansNeitherRodsNorPinnedSpheres) {
  set_.particles[0].pinned = set_.particles[2].pinned = true;
  PushPlanner planner(set_);
  planner.next_particle(now());
  EXPECT_EQ(planner.plan().particle, 1);
  planner.next_particle(now());
  EXPECT_EQ(planner.plan().particle, 3);
  const scene::ParticleSet rods = test::particle_set("tube-and-electrodes");
  PushPlanner of_rods(rods);
  EXPECT_THAT(of_rods.next_particle({.set = &rods}), HasSubstr("only spheres"));
  EXPECT_EQ(of_rods.plan(), scene::PlannedPush{});
}

TEST_F(Planner, KeepsTheGrooveForTheNextPlanUntilItIsCleared) {
  PushPlanner planner(set_);
  EXPECT_THAT(planner.toggle_groove(), StartsWith("groove: on"));
  EXPECT_EQ(planner.plan(), scene::PlannedPush{}) << "no groove without a plan";
  planner.next_particle(now());
  EXPECT_EQ(planner.plan().guided, 1U);
  EXPECT_TRUE(can_be_sent(planner));
  planner.next_particle(now());
  EXPECT_EQ(planner.plan().guided, 1U);
  EXPECT_EQ(planner.toggle_groove(), "groove: off");
  EXPECT_EQ(planner.plan().guided, 0U);
  planner.toggle_groove();
  planner.clear();
  planner.next_particle(now());
  EXPECT_EQ(planner.plan().guided, 0U);
}

// A ray from above onto a place of the sample, in its frame.
input::Ray onto(const glm::dvec2& place_m, double height_m = 0.0) {
  const glm::dvec3 eye(40e-9, -500e-9, 2e-6), there(place_m, height_m);
  return {.origin_m = eye, .direction = glm::normalize(there - eye)};
}

TEST_F(Planner, TakesTheSphereAndThePlaceAtWhichAPersonPoints) {
  PushPlanner planner(set_);
  const glm::dvec2 free_m(30e-9, 140e-9);
  EXPECT_EQ(planner.point(onto(free_m), now()), "plan: point at a sphere first");
  EXPECT_THAT(planner.point(onto(place_m(3), 25e-9), now()).value(), StartsWith("plan: particle 4, "));
  EXPECT_EQ(planner.plan().particle, 3);
  ASSERT_TRUE(planner.point(onto(free_m), now()));
  EXPECT_LT(glm::distance(to_m(planner), free_m), 1e-15);
  EXPECT_EQ(planner.plan().from_m[0], place_m(3).x);
  EXPECT_TRUE(can_be_sent(planner));
  // from its current place
  pages_[0].poses[3].x_m += 20e-9;
  ASSERT_TRUE(planner.point(onto(free_m), now()));
  EXPECT_EQ(planner.plan().from_m[0], place_m(3).x);
  EXPECT_EQ(planner.point(onto(place_m(3), 25e-9), now()), "plan: none") << "the planned one again";
  EXPECT_EQ(planner.plan(), scene::PlannedPush{});

  planner.next_particle(now());
  const scene::PlannedPush before = planner.plan();
  EXPECT_FALSE(planner.point(onto({1e-4, 0.0}), now())) << "beside the sample";
  EXPECT_FALSE(planner.point({.origin_m = {0.0, 0.0, 1e-6}, .direction = {0.0, 0.0, 1.0}}, now())) << "away from it";
  EXPECT_FALSE(planner.point({.origin_m = {0.0, 0.0, 1e-6}, .direction = {1.0, 0.0, 0.0}}, now())) << "along it";
  EXPECT_FALSE(planner.point({.origin_m = glm::dvec3(std::nan("")), .direction = glm::dvec3(std::nan(""))}, now()));
  EXPECT_EQ(planner.plan(), before);
}

TEST_F(Planner, SeesTheSampleWhereTheWallDrawsIt) {
  UserModels own;
  own.particles = std::make_shared<const scene::ParticleSet>(set_);
  const WallScene wall = WallScene::load(assets_, materials_, stage_place(wall_), test::english(), own).value();
  WallState state{.material = 0};
  for (const bool moved : {false, true}) {
    if (moved) state.navigation = glm::rotate(glm::translate(glm::dmat4(1.0), {0.1, 0.05, 0.2}), 0.3, {0.2, 1.0, 0.0});
    const glm::dmat4 room_from_sample = wall.node_transforms(state)[wall.sample_node()];
    const double units_per_m = 1.0 / (wall.drawn_scale(0).sample_m_per_m * wall.unit_m());
    for (std::size_t i = 0; i < set_.particles.size(); ++i) {
      const glm::dvec3 drawn(room_from_sample * glm::dvec4(units_per_m * glm::dvec3(place_m(i), 25e-9), 1.0));
      const glm::dvec3 eye(0.3, 1.7, 2.5);
      const auto ray = ray_on_sample(wall, state, {.origin_m = eye, .direction = glm::normalize(drawn - eye)});
      ASSERT_TRUE(ray);
      PushPlanner planner(set_);
      ASSERT_TRUE(planner.point(*ray, now()));
      EXPECT_EQ(planner.plan().particle, static_cast<std::int32_t>(i));
    }
  }
  EXPECT_FALSE(ray_on_sample(wall, {}, {})) << "no sample";
  EXPECT_FALSE(ray_on_sample(wall, {.material = 0, .centerpiece = Centerpiece::Journey}, {}));
}

// Rows N33 and N39 of the specification: aim and speed shown on the panel.
TEST_F(Planner, AsksForTheAimAndTheSpeedOfTheEquations) {
  const physics::Length radius = set_.setup.species.front().contact.tip_radius;
  // half angle and radii with rho = 40 nm exactly: without a cone, rho = R_t + R_p
  set_.setup.tip = {.radius = physics::Length(40e-9) - radius, .half_angle_rad = 0.0};
  const double aims[] = {0.09932792742, 0.01347528222, 9.079985934e-05};
  const double ways[] = {3.0, 5.0, 10.0};
  ParticlesNow planned = now();
  for (int i = 0; i < 3; ++i) {
    planned.plan = {
        .from_m = {place_m(1).x, place_m(1).y}, .to_m = {place_m(1).x, place_m(1).y + ways[i] * 40e-9}, .particle = 1};
    const PlanFigures figures = plan_figures(planned).value();
    EXPECT_NEAR(figures.left.si, ways[i] * 40e-9, 1e-18);
    EXPECT_NEAR(figures.aim.si / 40e-9, aims[i], 1e-8 * aims[i]);
    EXPECT_NEAR(figures.hand.si, 0.016, 1e-10) << "at 1e5 and 0.25 s";
  }
  EXPECT_EQ(physics::kSteeringDelay, physics::Time(0.25));
  EXPECT_FALSE(plan_figures(now())) << "without a plan";
  planned.plan.particle = 99;
  EXPECT_FALSE(plan_figures(planned)) << "of another set";
}

}  // namespace push_planner_test
}  // namespace afm::exhibit
