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

#include "felt/map_bench.h"
#include "haptics/contact_model.h"
#include "haptics/hand_motion.h"
#include "haptics/map_contact.h"
#include "servo_bench.h"
#include "support/deep.h"

namespace afm::haptics {
namespace viscous_map_test {

using physics::Law;
using test::lift;

constexpr double kTickS = test::kMapTickS;

std::unique_ptr<ContactModel> model_of(bool viscous, const DeviceSpec& device = omni_like("hand")) {
  scene::SharedContact rubber = test::rubber(Law::Jkr);
  rubber.viscous_map = viscous ? 1 : 0;
  return test::hilly_model(rubber, device);
}

// Work of the damping on a hand that goes round a triangle. Each force is held during the next tick, as by the servo.
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
  test::go_round(corners, mean_m_per_s, go_to);
  return work;
}

TEST(ViscousMap, TakesEnergyOnEachOfTenThousandClosedPaths) {
  const auto model = model_of(true);
  lift(*model);
  const auto taken = test::ten_thousand_paths(
      0.05, [&](const auto& corners, double mean_m_per_s) { return work_j(*model, corners, mean_m_per_s); });
  // energy with which the damping begins, on a path that hardly enters it
  EXPECT_LE(taken.most_j, 1e-6 * test::largest_j(*model));
  EXPECT_LT(taken.sum_j, -1e-5 * support::draws(10'000)) << "so weak that nobody feels it";
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
