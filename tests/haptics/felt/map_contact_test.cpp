// SPDX-License-Identifier: Apache-2.0
// A hand over a map of modulus and adhesion, through the contact model.
#include "haptics/map_contact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "felt/map_bench.h"
#include "haptics/contact_model.h"
#include "haptics/passivity_observer.h"
#include "scene/shared/map_vibration.h"
#include "servo_bench.h"
#include "support/deep.h"

namespace afm::haptics {
namespace map_contact_test {

using physics::Law;
using physics::Phase;
using scene::ScaleMode;
using testing::HasSubstr;

const DeviceSpec kOmni = [] {
  DeviceSpec device = omni_like("hand");
  device.max_vibration_n = kMostVibrationN;
  return device;
}();

core::Result<std::unique_ptr<ContactModel>> model_on(const scene::SharedContact& material,
                                                     const scene::SharedLawMap& map) {
  auto tables = build_tables(material, {});
  if (!tables) return tl::unexpected(tables.error());
  const auto common = test::required(Scaling::common_scale(std::vector{*tables}, kOmni));
  return ContactModel::create(material, 0, *tables, {}, common, kOmni, 1'000'000, &map);
}

// Built once for each law.
ContactModel& hilly(Law law) {
  static const auto build = [](Law name) {
    return test::required(model_on(test::rubber(name), *test::hilly_map(test::rubber(name))));
  };
  static const auto dmt = build(Law::Dmt), jkr = build(Law::Jkr);
  return law == Law::Dmt ? *dmt : *jkr;
}

// A closed way through random places that begins and ends high above the sample, at most at 0.12 m/s.
class Loop {
 public:
  explicit Loop(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> across(-0.03, 0.03), height(-0.025, 0.035);
    const glm::dvec3 start{across(random), across(random), 0.07};
    places_.push_back(start);
    for (int i = 0; i < 5; ++i) places_.push_back({across(random), across(random), height(random)});
    places_.push_back(start);
  }

  // Position after so much of the way, smooth, at rest at each of its places.
  glm::dvec3 at(double seconds) const {
    const double leg = std::clamp(seconds / kLegS, 0.0, static_cast<double>(places_.size()) - 1.0 - 1e-12);
    const auto i = static_cast<std::size_t>(leg);
    const double t = leg - static_cast<double>(i);
    return places_[i] + t * t * (3.0 - 2.0 * t) * (places_[i + 1] - places_[i]);
  }
  double seconds() const { return kLegS * static_cast<double>(places_.size() - 1); }

 private:
  static constexpr double kLegS = 1.0;
  std::vector<glm::dvec3> places_;
};

struct Ridden {
  double work_j = 0;      // work on the hand
  double most_j = 0;      // largest stored energy
  double excess_j = 0;    // largest excess seen by the observer
  double sideways_n = 0;  // largest sideways force
  int jumps = 0;
};

// Takes the hand round at a rate. The work is that of the mean force of each step; `sideways` leaves that of the map
// out.
Ridden ride(ContactModel& model, ScaleMode mode, const Loop& loop, double rate_hz, bool sideways = true) {
  Ridden ridden;
  PassivityObserver observer;
  model.wait_for_lift();
  model.use(mode);
  glm::dvec3 before_m = loop.at(0.0), force_n(0.0);
  PassivityObserver::Law law;
  for (int i = 0; i <= std::lround(rate_hz * loop.seconds()); ++i) {
    const glm::dvec3 here_m = loop.at(i / rate_hz);
    const Touch touch = model.step(here_m, {.elapsed_s = 1.0 / rate_hz});
    const PassivityObserver::Law now = model.energy(touch);
    glm::dvec3 here_n = touch.hand_force_n;
    if (!sideways) here_n -= glm::dvec3(touch.map.sideways_n, 0.0);
    const glm::dvec3 moved_m = here_m - before_m;
    if (i > 0) {
      ridden.work_j += 0.5 * glm::dot(force_n + here_n, moved_m);
      observer.integrate({.moved_m = moved_m,
                          .wanted_n = force_n,
                          .commanded_n = force_n,
                          .stored_rise_j = now.stored_j - law.stored_j,
                          .stiffness_n_per_m = now.stiffness_n_per_m});
    }
    ridden.excess_j = std::max(ridden.excess_j, observer.excess_j());
    ridden.most_j = std::max(ridden.most_j, now.stored_j);
    ridden.sideways_n = std::max(ridden.sideways_n, glm::length(touch.map.sideways_n));
    ridden.jumps += static_cast<int>(touch.response.event_count);
    before_m = here_m;
    force_n = here_n;
    law = now;
  }
  return ridden;
}

TEST(MapContact, GivesNoEnergyOnClosedWaysAtAnyRateOnAnyScale) {
  const unsigned ways = support::deep() ? 8 : 2;
  int jumps = 0;
  for (const double rate_hz : {500.0, 1000.0, 4000.0}) {
    for (const scene::ScaleModeText& scale : scene::kScalesOfSamples) {
      for (unsigned seed = 0; seed < ways; ++seed) {
        for (const Law law : {Law::Dmt, Law::Jkr}) {
          const Ridden ridden = ride(hilly(law), scale.mode, Loop(seed), rate_hz);
          EXPECT_LT(ridden.work_j, 1e-4 * ridden.most_j) << scale.word << ' ' << rate_hz << " Hz, way " << seed;
          EXPECT_LT(ridden.excess_j, PassivityObserver::kToleranceJ) << scale.word << ' ' << rate_hz << " Hz";
          jumps += ridden.jumps;
        }
      }
    }
  }
  EXPECT_GT(jumps, 25U * ways) << "the ways hardly ever touch";
}

TEST(MapContact, GivesNoEnergyOnClosedWaysWithEachVibration) {
  for (const scene::MapVibrationText& row : scene::kMapVibrations) {
    scene::SharedContact rubber = test::rubber(Law::Jkr);
    rubber.map_vibration = row.quantity;
    const auto model = test::required(model_on(rubber, *test::hilly_map(rubber)));
    for (unsigned seed = 0; seed < 8; ++seed) {
      const Ridden ridden = ride(*model, ScaleMode::Fit, Loop(seed), 1000.0);
      EXPECT_LT(ridden.work_j, 1e-4 * ridden.most_j) << row.word << ", way " << seed;
      EXPECT_LT(ridden.excess_j, PassivityObserver::kToleranceJ) << row.word << ", way " << seed;
    }
  }
}

TEST(MapContact, WouldGiveEnergyWithoutItsSidewaysForce) {
  double most = 0.0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    const Ridden ridden = ride(hilly(Law::Jkr), ScaleMode::Fit, Loop(seed), 1000.0, false);
    most = std::max(most, ridden.excess_j);
  }
  EXPECT_GT(most, 0.1 * PassivityObserver::kLimitJ);
}

TEST(MapContact, PushesSidewaysSoThatItIsFeltButNotTooHard) {
  double most_n = 0.0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    most_n = std::max(most_n, ride(hilly(Law::Jkr), ScaleMode::Fit, Loop(seed), 500.0).sideways_n);
  }
  EXPECT_GT(most_n, 0.05) << "too weak for a moving hand";
  EXPECT_LT(most_n, 1.5 * MapContact::kShareSideways * force_cap_n(kOmni));
}

TEST(MapContact, IsTheOrdinaryContactWhereTheMapHasOneValue) {
  const auto map = test::hilly_map(test::rubber(Law::Dmt));
  map->ln_modulus.fill(static_cast<float>(std::log(2e6)));
  map->adhesion_j_per_m2.fill(40e-3F);
  scene::SharedContact plain = test::rubber(Law::Jkr);
  plain.law_map = 0;
  const auto with = test::required(model_on(test::rubber(Law::Jkr), *map)), without = test::model_of(plain);
  std::vector<physics::ModelEvent> jumps_with, jumps_without;
  const auto take = [](const Touch& touch, std::vector<physics::ModelEvent>& jumps) {
    jumps.insert(jumps.end(), touch.response.events.begin(),
                 touch.response.events.begin() + touch.response.event_count);
  };
  for (int i = 0; i <= 2000; ++i) {
    const glm::dvec3 hand_m(0.01, 0.0, 0.03 + 0.04 * std::cos(2.0 * M_PI * i / 2000.0));
    const Touch on_map = with->step(hand_m), plainly = without->step(hand_m);
    ASSERT_EQ(on_map.response.phase, plainly.response.phase) << i;
    const double hand_n = with->scaling().hand_force_n(plainly.response.force.si);
    EXPECT_NEAR(on_map.hand_force_n.z, hand_n, 2e-3) << i;
    EXPECT_NEAR(on_map.response.force.si, plainly.response.force.si,
                1e-6 * std::abs(plainly.response.force.si) + 1e-15);
    EXPECT_EQ(glm::length(on_map.map.sideways_n), 0.0);
    take(on_map, jumps_with);
    take(plainly, jumps_without);
  }
  ASSERT_EQ(jumps_with.size(), 2U);
  ASSERT_EQ(jumps_without.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(jumps_with[i].kind, jumps_without[i].kind);
    EXPECT_NEAR(jumps_with[i].z.si, jumps_without[i].z.si, 1e-13);
    EXPECT_NEAR(jumps_with[i].fraction, jumps_without[i].fraction, 1e-3);
    EXPECT_NEAR(jumps_with[i].force_after.si, jumps_without[i].force_after.si, 1e-12);
  }
}

// The law at a place belongs to its modulus: splines between the laws of the family add nothing.
TEST(MapContact, HasTheLawOfEveryModulusAndAdhesionOfTheMap) {
  for (const double share : support::deep() ? std::vector{0.0, 0.31, 1.0} : std::vector{0.31}) {
    const auto map = test::hilly_map(test::rubber(Law::Dmt));
    const double ln_modulus = std::log(1e6) + share * std::log(8.0), adhesion = 20e-3 + share * 60e-3;
    // everywhere the same, but for two points with the ends of both ranges, far from the middle
    constexpr std::size_t kFar = 8 * 64 + 8;
    for (std::uint32_t cell = 0; cell < map->columns * map->rows; ++cell) {
      map->ln_modulus[cell] = static_cast<float>(ln_modulus);
      map->adhesion_j_per_m2[cell] = static_cast<float>(adhesion);
    }
    map->ln_modulus[kFar] = static_cast<float>(std::log(1e6));
    map->ln_modulus[kFar + 1] = static_cast<float>(std::log(8e6));
    map->adhesion_j_per_m2[kFar] = 20e-3F;
    map->adhesion_j_per_m2[kFar + 1] = 80e-3F;
    const auto model = test::required(model_on(test::rubber(Law::Dmt), *map));
    scene::SharedContact here = test::rubber(Law::Dmt);
    here.law_map = 0;
    here.contact = contact_with(here.contact, physics::Pressure(std::exp(ln_modulus)), adhesion);
    const auto tables = test::required(build_tables(here, {}));
    const glm::dvec3 place(0.0, 0.0, 1.0);
    Touch touch = model->step(0.07 * place);
    for (double height_m = 0.07; height_m > -0.01; height_m -= 1e-3) touch = model->step(height_m * place);
    ASSERT_EQ(touch.response.phase, Phase::Attached);
    EXPECT_NEAR(touch.map.here.reduced_modulus_pa, std::exp(ln_modulus), 0.02 * std::exp(ln_modulus));
    EXPECT_NEAR(touch.map.here.adhesion_j_per_m2, adhesion, 1e-3);
    const double force_n = tables->attached.force(physics::Length(touch.z_m)).si;
    EXPECT_NEAR(touch.response.force.si, force_n, 0.03 * std::abs(force_n)) << share;
  }
}

std::string refusal_of(const scene::SharedContact& material, const scene::SharedLawMap& map) {
  const auto model = model_on(material, map);
  return model ? "felt" : model.error().message;
}

TEST(MapContact, RefusesWhatNoHandCanFeel) {
  const auto map = test::hilly_map(test::rubber(Law::Dmt));
  EXPECT_EQ(refusal_of(test::rubber(Law::Dmt), *map), "felt");
  map->ln_modulus[7] = static_cast<float>(std::log(1e9));
  EXPECT_THAT(refusal_of(test::rubber(Law::Dmt), *map),
              HasSubstr("from 1 MPa to 1 GPa; a hand can feel a factor of 50"));
  EXPECT_THAT(refusal_of(test::rubber(Law::Dmt), {}), HasSubstr("it has no map"));
  EXPECT_THAT(refusal_of(test::rubber(Law::Hao), *map), HasSubstr("with the laws dmt, jkr and hertz alone"));
  scene::SharedContact rubbing = test::rubber(Law::Dmt);
  rubbing.friction.law = physics::FrictionLaw::Amontons;
  EXPECT_THAT(refusal_of(rubbing, *map), HasSubstr("without friction"));
}

// Where adhesion hardly pulls on one side and 200 times as hard on the other, a hand would feel nothing on the first.
TEST(MapContact, RefusesForcesThatAreTooFaintBesideTheStrongest) {
  const auto map = test::hilly_map(test::rubber(Law::Dmt));
  map->ln_modulus.fill(static_cast<float>(std::log(1e4)));
  map->adhesion_j_per_m2.fill(10e-6F);
  map->adhesion_j_per_m2[7] = 1.0F;
  EXPECT_THAT(refusal_of(test::rubber(Law::Dmt), *map), HasSubstr("too weak to feel"));
}

TEST(MapContact, WaitsAfterAPlaceThatIsNoNumber) {
  ContactModel& model = hilly(Law::Jkr);
  model.wait_for_lift();
  model.use(ScaleMode::Fit);
  for (double height_m = 0.07; height_m > -0.01; height_m -= 1e-3) model.step({0.0, 0.0, height_m});
  ASSERT_EQ(model.phase(), Phase::Attached);
  const Touch touch = model.step({std::nan(""), 0.0, 0.0});
  EXPECT_EQ(touch.response.phase, Phase::WaitForLift);
  EXPECT_EQ(touch.map.force_n, 0.0);
  EXPECT_EQ(model.phase(), Phase::WaitForLift);
}

}  // namespace map_contact_test
}  // namespace afm::haptics
