// SPDX-License-Identifier: Apache-2.0
// The damping of a viscous map.
// Invariant: the damping of a viscous map takes energy on every closed path
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <random>
#include <vector>

#include "felt/map_bench.h"
#include "haptics/contact_model.h"
#include "haptics/hand_motion.h"
#include "haptics/map_contact.h"
#include "servo_bench.h"
#include "support/deep.h"

namespace afm::haptics {
namespace viscous_map_test {

using physics::Law;
using physics::Phase;

constexpr double kTickS = 1e-3;

std::unique_ptr<ContactModel> model_of(bool viscous, const DeviceSpec& device = omni_like("hand")) {
  scene::SharedContact rubber = test::rubber(Law::Jkr);
  rubber.viscous_map = viscous ? 1 : 0;
  const auto map = test::hilly_map(rubber);
  const auto tables = test::required(build_tables(rubber, {}));
  const auto common = test::required(Scaling::common_scale(std::vector{tables}, device));
  auto model = test::required(ContactModel::create(rubber, 0, tables, {}, common, device, 1'000'000, map.get()));
  model->use(scene::ScaleMode::Fit);
  return model;
}

// Lifts the tip so that it is free.
void lift(ContactModel& model) {
  model.wait_for_lift();
  model.step({0.0, 0.0, 0.07}, {.elapsed_s = kTickS});
}

// Work of the damping on a hand that goes straight from corner to corner of a triangle, at rest at each of them. Each
// force is held during the next tick, as by the servo.
double work_j(ContactModel& model, const std::array<glm::dvec3, 3>& corners, double mean_m_per_s) {
  HandMotion motion(10.0);
  double work = 0.0;
  glm::dvec3 force_n(0.0);
  const auto go_to = [&](const glm::dvec3& here_m) {
    motion.move(here_m, static_cast<std::int64_t>(1e9 * kTickS));
    work += glm::dot(force_n, motion.moved_m());
    const Touch touch = model.step(here_m, {.elapsed_s = kTickS});
    force_n = -touch.map.damping_n_s_per_m * motion.velocity_m_per_s();
  };
  go_to(corners[0]);
  for (std::size_t leg = 0; leg < corners.size(); ++leg) {
    const glm::dvec3 &from = corners[leg], &to = corners[(leg + 1) % corners.size()];
    const double ticks = std::ceil(glm::distance(from, to) / mean_m_per_s / kTickS);
    for (double tick = 1.0; tick <= ticks; tick += 1.0) {
      const double t = tick / ticks;
      go_to(from + t * t * (3.0 - 2.0 * t) * (to - from));
    }
  }
  return work;
}

// Largest energy that the law stores on the way down in the middle of the map.
double largest_j(ContactModel& model) {
  lift(model);
  double largest = 0.0;
  for (double height_m = 0.07; height_m > -0.02; height_m -= 1e-3) {
    largest = std::max(largest, model.energy(model.step({0.0, 0.0, height_m}, {.elapsed_s = kTickS})).stored_j);
  }
  return largest;
}

TEST(ViscousMap, TakesEnergyOnEachOfTenThousandClosedPaths) {
  const auto model = model_of(true);
  lift(*model);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> across(-0.035, 0.035), near(-0.004, 0.004), height(-0.02, 0.05),
      speed(0.02, 0.25);
  double most_j = -HUGE_VAL, sum_j = 0.0;
  for (int path = 0; path < support::draws(10'000); ++path) {
    const glm::dvec3 middle{across(random), across(random), height(random)};
    const auto corner = [&] { return middle + glm::dvec3{near(random), near(random), near(random)}; };
    const glm::dvec3 a = corner(), b = corner(), c = corner();
    const double taken_j = work_j(*model, {a, b, c}, speed(random));
    most_j = std::max(most_j, taken_j);
    sum_j += taken_j;
  }
  // that with which the damping begins, on a path that hardly enters it
  EXPECT_LE(most_j, 1e-6 * largest_j(*model));
  EXPECT_LT(sum_j, -1e-5 * support::draws(10'000)) << "so weak that nobody feels it";
}

// Hovers long enough for the damping to grow.
double damping_at(ContactModel& model, const glm::dvec3& hand_m) {
  double damping = 0.0;
  for (int tick = 0; tick < 200; ++tick) damping = model.step(hand_m, {.elapsed_s = kTickS}).map.damping_n_s_per_m;
  return damping;
}

TEST(ViscousMap, DampsMoreWhereACycleLosesMoreAndNotFarAbove) {
  const auto model = model_of(true);
  lift(*model);
  const double weak = damping_at(*model, {0.0, -0.03, 0.012}), strong = damping_at(*model, {0.0, 0.03, 0.012});
  EXPECT_GT(strong, 2.0 * weak);
  EXPECT_GT(weak, 0.05) << "a drag everywhere near the sample";
  EXPECT_LE(strong, MapContact::kMostDampingNSPerM);
  EXPECT_EQ(damping_at(*model, {0.0, 0.03, 0.07}), 0.0);
  lift(*model);
  EXPECT_LT(model->step({0.0, 0.03, 0.03}, {.elapsed_s = kTickS}).map.damping_n_s_per_m, 1e-3) << "grows gradually";
  model->wait_for_lift();
  EXPECT_EQ(model->step({0.0, 0.03, 0.0}, {.elapsed_s = kTickS}).map.damping_n_s_per_m, 0.0) << "without force";
}

TEST(ViscousMap, IsNoStrongerThanTheDevice) {
  const auto model = model_of(true, limited_to(omni_like("weak hand"), 0.5));
  lift(*model);
  const double damping = damping_at(*model, {0.0, 0.03, 0.0});
  EXPECT_GT(damping, 0.05);
  EXPECT_LE(damping, 0.5);
}

TEST(ViscousMap, IsOnlyThereOnRequest) {
  const auto model = model_of(false);
  lift(*model);
  EXPECT_EQ(damping_at(*model, {0.0, 0.03, 0.0}), 0.0);
  scene::SharedContact mapless = test::rubber(Law::Jkr);
  mapless.viscous_map = 1;
  mapless.law_map = 0;
  const auto refused = build_tables(mapless, {});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("its viscosity needs a map"));
}

}  // namespace viscous_map_test
}  // namespace afm::haptics
