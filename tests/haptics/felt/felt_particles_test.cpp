// SPDX-License-Identifier: Apache-2.0
// Particles under the hand: forces, events, energy and places.
// Invariant: far from a particle no bit of a force changes
// Invariant: a particle gives at f_s and goes on at f_k at any rate and speed; pushes give no more energy than they
// store
#include "haptics/felt_particles.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "haptics/contact_model.h"
#include "haptics/passivity_observer.h"
#include "servo_bench.h"
#include "support/deep.h"
#include "support/particles/gold_particles.h"

namespace afm {
namespace felt_particles_test {

using haptics::FeltParticles;
using haptics::ParticlePush;
using haptics::ParticleScale;
using haptics::Touch;
using physics::EventKind;
using physics::PushState;
using scene::ScaleMode;
using scene::SharedParticles;
using test::constant_species;
using test::expect_relative;
using test::particles_at;
using test::touch_m;
using testing::ElementsAre;

const haptics::DeviceSpec kOmni = haptics::omni_like("hand");

// ---- on the hand

// A contact model on the scale Particles.
struct Hand {
  explicit Hand(const SharedParticles& set)
      : particles(set), scale(*haptics::particle_scale(set, kOmni)), felt(set, scale) {
    const scene::SharedContact mica = test::paper_model().materials[test::kMica];
    const auto tables = test::required(haptics::build_tables(mica, {}));
    auto common = test::required(haptics::Scaling::common_scale(std::vector{tables}, kOmni));
    common.particles = scale;
    model = test::required(haptics::ContactModel::create(mica, 0, tables, {}, common, kOmni, 1'000'000));
    bare = test::required(haptics::ContactModel::create(mica, 0, tables, {}, common, kOmni, 1'000'000));
    model->use(ScaleMode::Particles, &felt);
    bare->use(ScaleMode::Particles);
  }

  static haptics::ScanFeedback force_on(double elapsed_s = 1e-3) {
    return {.elapsed_s = elapsed_s, .without_force = false};
  }
  Touch step(const glm::dvec3& hand_m, double elapsed_s = 1e-3) { return model->step(hand_m, force_on(elapsed_s)); }
  double release_m() const { return model->scaling().release_height_m(); }

  SharedParticles particles;
  ParticleScale scale;
  FeltParticles felt;
  std::unique_ptr<haptics::ContactModel> model, bare;  // models with and without the particles
};

bool same_bits(const Touch& a, const Touch& b) {
  return std::memcmp(&a.hand_force_n, &b.hand_force_n, sizeof(glm::dvec3)) == 0;
}

TEST(FeltParticles, FarFromTheTipChangeNoBitOfTheForceOrItsEnergy) {
  Hand hand(particles_at({{0.0, 0.0}, {30e-9, 70e-9}}));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-0.06, 0.06), height(-0.01, 0.05);
  int compared = 0, low = 0;
  glm::dvec3 at(0.05, 0.0, hand.release_m() + 0.01), to = at;
  for (int i = 0; i < 20'000; ++i) {
    if (i % 100 == 0) to = {place(random), place(random), height(random)};
    at += 0.03 * (to - at);
    // far from all particles, or above them
    if (glm::length(glm::dvec2(at)) < 0.035 && at.z < hand.release_m()) at.z = hand.release_m();
    const Touch with = hand.step(at);
    const Touch without = hand.bare->step(at, Hand::force_on());
    ASSERT_FALSE(with.push.touches);
    if (with.push.near) continue;
    ASSERT_TRUE(same_bits(with, without)) << i;
    const auto law = hand.model->energy(with), bare = hand.bare->energy(without);
    ASSERT_EQ(std::memcmp(&law.stored_j, &bare.stored_j, sizeof(double)), 0) << i;
    ASSERT_EQ(law.stiffness_n_per_m, bare.stiffness_n_per_m);
    ++compared;
    if (at.z < 0.0) ++low;
  }
  EXPECT_GT(compared, 15'000);
  EXPECT_GT(low, 500);
  EXPECT_EQ(hand.felt.push().digest, FeltParticles(hand.particles, hand.scale).push().digest);
}

TEST(FeltParticles, OnOtherScalesAreNotThere) {
  Hand hand(particles_at({{0.0, 0.0}}));
  for (const ScaleMode mode : {ScaleMode::Common, ScaleMode::Fit, ScaleMode::Compressed, ScaleMode::Atoms}) {
    hand.model->use(mode, &hand.felt);
    hand.bare->use(mode);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(-0.02, 0.02), height(-0.01, 0.065);
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec3 at{place(random), place(random), height(random)};
      ASSERT_TRUE(same_bits(hand.step(at), hand.bare->step(at, Hand::force_on()))) << i;
    }
  }
}

// Lifts, lowers beside the particle, and pushes it along x at a speed of the hand; calls `each` after each tick.
template <class Each>
void push_along_x(Hand& hand, double rate_hz, double speed_m_per_s, double to_m, Each&& each) {
  const double z = 0.1e-9 * hand.scale.hand_m_per_m, begin = -1.3 * touch_m(hand.particles) * hand.scale.hand_m_per_m;
  hand.step({begin, 0.0, hand.release_m() + 0.005}, 1.0 / rate_hz);
  hand.step({begin, 0.0, z}, 1.0 / rate_hz);
  const double tick_m = speed_m_per_s / rate_hz;
  for (double x = begin; x < to_m; x += tick_m) each(hand.step({x, 0.0, z}, 1.0 / rate_hz));
}

// A particle so large in the hand that it gives at 1 N.
SharedParticles large(const scene::SharedSpecies& species) {
  SharedParticles particles = particles_at({{0.0, 0.0}}, species);
  particles.pusher.diameter_in_hand_m = 0.020;
  return particles;
}

TEST(FeltParticles, GiveAtOneNewtonOfTheHandAndGoOnAtHalfOfItAtAnyRateAndSpeed) {
  scene::SharedSpecies species = constant_species(20e-9, 0.5, 50e-9);
  species.ageing_s = 10.0;
  for (const double rate_hz : {500.0, 1000.0, 4000.0}) {
    for (const double speed : {0.01, 0.05, 0.2}) {
      Hand hand(large(species));
      double largest_n = 0.0, last_n = 0.0;
      std::vector<ParticlePush::Event> gave;
      push_along_x(hand, rate_hz, speed, 0.012, [&](const Touch& touch) {
        last_n = -hand.scale.hand_n_per_n * touch.push.push_n.x;
        largest_n = std::max(largest_n, last_n);
        for (const auto& event : touch.push.happened()) {
          if (event.kind == EventKind::ParticleGave) gave.push_back(event);
        }
      });
      ASSERT_EQ(gave.size(), 1U) << rate_hz << " Hz, " << speed << " m/s";
      expect_relative(gave[0].force_before_n * hand.scale.hand_n_per_n, 1.0, 1e-9);
      expect_relative(gave[0].force_after_n * hand.scale.hand_n_per_n, 0.5, 1e-9);
      EXPECT_LE(largest_n, 1.0 + 1e-9);
      EXPECT_GT(largest_n, 1.0 - 200.0 * speed / rate_hz - 1e-9);
      expect_relative(last_n, 0.5, 1e-9);
    }
  }
}

// The lever bends by 5 mm of the hand before the particle gives at 1 N: row N73.
TEST(FeltParticles, N73GiveAfterFiveMillimetres) {
  Hand hand(large(constant_species(20e-9, 0.5, 50e-9)));
  double touched_at = 0.0, gave_at = 0.0;
  push_along_x(hand, 1000.0, 0.02, 0.012, [&](const Touch& touch) {
    if (touch.push.touches && touched_at == 0.0) touched_at = touch.tip_xy_m.x;
    for (const auto& event : touch.push.happened()) {
      if (event.kind == EventKind::ParticleGave && gave_at == 0.0) gave_at = touch.tip_xy_m.x;
    }
  });
  // springs in series along the flank, and the apex that climbs it, add less than a tenth
  EXPECT_NEAR((gave_at - touched_at) * hand.scale.hand_m_per_m, 0.0054, 0.0004);
}

TEST(FeltParticles, PushTheHandUpByAQuarterOfTheSidewaysForce) {
  scene::SharedSpecies species = constant_species(20e-9, 1.0, 50e-9);
  Hand hand(particles_at({{0.0, 0.0}}, species));
  push_along_x(hand, 1000.0, 0.02, 0.01, [&](const Touch& touch) {
    if (!touch.push.touches) return;
    EXPECT_NEAR(touch.push.push_n.z / -touch.push.push_n.x, std::tan(std::numbers::pi / 12.0), 1e-6);
  });
}

// The wall draws a lifted tip there.
TEST(FeltParticles, PublishThePlaceOfATipAboveThem) {
  Hand hand(particles_at({{0.0, 0.0}}));
  const double up_m = hand.release_m() + 0.005;
  for (const double aside_m : {0.02, -0.01}) {
    hand.step({aside_m, 0.5 * aside_m, up_m});
    const scene::TipPush push = hand.felt.push();
    EXPECT_EQ(push.met, 1U);
    EXPECT_DOUBLE_EQ(push.apex_m[0], aside_m / hand.scale.hand_m_per_m);
    EXPECT_DOUBLE_EQ(push.apex_m[1], 0.5 * aside_m / hand.scale.hand_m_per_m);
    EXPECT_GE(push.apex_m[2], hand.scale.clear_z_m);
    EXPECT_EQ(push.base_m, push.apex_m) << "the lever is straight";
  }
}

// The tip is over a particle when it is let down: it waits, and no force comes.
TEST(FeltParticles, WaitForALiftAfterTheForceWasOff) {
  Hand hand(particles_at({{0.0, 0.0}}));
  hand.step({-0.02, 0.0, hand.release_m() + 0.005});
  hand.step({-0.02, 0.0, 0.0});
  for (int i = 0; i < 2000 && !hand.step({-0.02 + 1e-5 * i, 0.0, 0.0}).push.touches; ++i) {
  }
  const double x = hand.felt.push().base_m[0] * hand.scale.hand_m_per_m + 0.001;
  EXPECT_TRUE(hand.step({x, 0.0, 0.0}).push.touches);
  EXPECT_EQ(hand.felt.push().met, 1U);
  hand.model->step({x, 0.0, 0.0}, {.elapsed_s = 1e-3, .without_force = true});
  EXPECT_EQ(hand.felt.push().met, 0U);
  EXPECT_FALSE(hand.step({x, 0.0, 0.0}).push.touches);
  EXPECT_FALSE(hand.step({x, 0.0, 0.5 * hand.scale.clear_z_m * hand.scale.hand_m_per_m}).push.touches);
  hand.step({x, 0.0, hand.release_m() + 0.005});
  EXPECT_EQ(hand.felt.push().met, 1U);
}

TEST(FeltParticles, AreRiddenOverByALeverThatIsTooSoft) {
  SharedParticles particles = particles_at({{0.0, 0.0}}, constant_species(20e-9, 1.0, 50e-9));
  particles.pusher.normal_spring_n_per_m = 0.02;
  Hand hand(particles);
  std::vector<EventKind> kinds;
  push_along_x(hand, 1000.0, 0.02, 0.02, [&](const Touch& touch) {
    for (const auto& event : touch.push.happened()) kinds.push_back(event.kind);
  });
  EXPECT_THAT(kinds, ElementsAre(EventKind::ParticleTouched, EventKind::ParticleRiddenOver));
}

TEST(FeltParticles, AreNotLostByAHandThatLiftsTheTip) {
  Hand hand(particles_at({{0.0, 0.0}}));
  std::vector<EventKind> kinds;
  const auto note = [&](const Touch& touch) {
    for (const auto& event : touch.push.happened()) kinds.push_back(event.kind);
  };
  push_along_x(hand, 1000.0, 0.02, 0.002, note);
  for (double z = 0.0; z < hand.release_m(); z += 1e-4) note(hand.step({0.002, 0.0, z}));
  EXPECT_FALSE(kinds.empty());
  for (const EventKind kind : kinds) EXPECT_NE(kind, EventKind::ParticleLost);
}

// ---- energy

// Random walks of the hand among one sphere and five, with rest, lifts and presses: the observer sees no more than a
// sampled spring gives, and the account of each push holds.
TEST(FeltParticles, NeverGiveMoreThanASampledSpring) {
  for (const auto& [count, sticks] :
       {std::pair{1, false}, std::pair{5, false}, std::pair{1, true}, std::pair{5, true}}) {
    std::vector<test::PlaceM> places;
    for (int i = 0; i < count; ++i) places.push_back({52e-9 * (i % 3), 52e-9 * (i / 3)});
    scene::SharedSpecies gold = test::gold_species();
    gold.sticks = static_cast<std::uint16_t>(sticks);
    Hand hand(particles_at(places, gold));
    std::mt19937_64 random(static_cast<std::uint64_t>(count));
    std::normal_distribution<double> gauss;
    haptics::PassivityObserver observer;
    glm::dvec3 at(-0.02, 0.0, hand.release_m() + 0.005), velocity(0.0);
    Touch touch = hand.step(at);
    auto before = hand.model->energy(touch);
    double largest_j = 0.0;
    int touches = 0;
    for (int i = 0; i < 40'000; ++i) {
      velocity = 0.97 * velocity + 1.5e-5 * glm::dvec3{gauss(random), gauss(random), gauss(random)};
      glm::dvec3 next = at + velocity;
      // stays about the particles, which it pushes away
      const scene::ParticlePose& first = hand.felt.pages()[0].poses[0];
      const glm::dvec2 middle = hand.scale.hand_m_per_m * glm::dvec2(first.x_m, first.y_m);
      next += 0.002 * (glm::dvec3(middle, 0.004) - next);
      const glm::dvec3 force = touch.hand_force_n, moved = next - at;
      touch = hand.step(next);
      const auto after = hand.model->energy(touch);
      if (touch.response.phase != physics::Phase::WaitForLift) {
        observer.integrate({.moved_m = moved,
                            .wanted_n = force,
                            .commanded_n = force,
                            .stored_rise_j = after.stored_j - after.given_j - before.stored_j,
                            .stiffness_n_per_m = before.stiffness_n_per_m,
                            .oscillation_n = 0.0});
      }
      before = after;
      at = next;
      largest_j = std::max(largest_j, observer.excess_j());
      const scene::TipPush push = hand.felt.push();
      ASSERT_GE(push.given_j - push.lost_j - push.stored_j, -1e-9 * (push.given_j + 1e-20)) << i;
      if (touch.push.touches) ++touches;
    }
    EXPECT_GT(touches, 2000) << count;
    EXPECT_LT(largest_j, haptics::PassivityObserver::kToleranceJ) << count;
  }
}

// Strokes of the hand about a sphere that sticks to the tip, each of which ends above: none gives energy.
TEST(FeltParticles, GiveNoEnergyOnAClosedStrokeWhenTheyStick) {
  const int strokes = support::deep() ? 200 : 50;
  for (const double shear_pa : {10e6, 100e6}) {  // shear strengths for a drag, and for a torn contact
    scene::SharedSpecies gold = test::gold_species();
    gold.shear_strength_pa = shear_pa;
    gold.sticks = 1;
    Hand hand(particles_at({{0.0, 0.0}}, gold));
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> beside(-0.012, 0.012), low(-0.001, 0.006);
    int dragged = 0, torn = 0;
    glm::dvec3 at(0.0, 0.0, hand.release_m() + 0.005);
    const auto go = [&](const glm::dvec3& to) {
      const int ticks = std::max(1, static_cast<int>(glm::length(to - at) / 1e-4));
      for (int i = 1; i <= ticks; ++i) {
        const Touch touch = hand.step(at + (to - at) * (static_cast<double>(i) / ticks));
        for (const auto& event : touch.push.happened()) {
          if (event.kind == EventKind::ParticleDragged) ++dragged;
          if (event.kind == EventKind::ParticleTorn) ++torn;
        }
      }
      at = to;
    };
    for (int stroke = 0; stroke < strokes; ++stroke) {
      const scene::ParticlePose there = hand.felt.pages()[0].poses[0];
      const glm::dvec2 middle = hand.scale.hand_m_per_m * glm::dvec2(there.x_m, there.y_m);
      const auto near = [&] { return middle + glm::dvec2{beside(random), beside(random)}; };
      const glm::dvec3 over(near(), hand.release_m() + 0.005);
      go(over);
      for (int i = 0; i < 4; ++i) go(glm::dvec3(near(), low(random)));
      go(glm::dvec3(glm::dvec2(at), 0.999 * hand.scale.clear_z_m * hand.scale.hand_m_per_m));
      const scene::TipPush push = hand.felt.push();
      EXPECT_GE(push.work_j * push.hand_m_per_m * push.hand_n_per_n, -1e-9) << stroke;
    }
    EXPECT_GT(torn, strokes / 4);
    if (shear_pa < 50e6) {
      EXPECT_GT(dragged, strokes / 4);
    }
  }
}

TEST(FeltParticles, LeaveTheNumbersFiniteWhateverTheHandDoes) {
  Hand hand(particles_at({{0.0, 0.0}, {60e-9, 0.0}}));
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(-0.05, 0.05), height(-0.05, 0.05);
  for (int i = 0; i < 20'000; ++i) {
    const Touch touch = hand.step({place(random), place(random), height(random)});
    ASSERT_TRUE(std::isfinite(glm::length(touch.hand_force_n)));
    const auto law = hand.model->energy(touch);
    ASSERT_TRUE(std::isfinite(law.stored_j) && std::isfinite(law.stiffness_n_per_m));
  }
}

// ---- poses

TEST(FeltParticles, GoOnFromPagesAsIfTheyHadAlwaysLainThere) {
  Hand first(particles_at({{0.0, 0.0}, {60e-9, 0.0}}));
  push_along_x(first, 1000.0, 0.02, 0.01, [](const Touch&) {});
  for (int i = 0; i < 100; ++i) first.step({0.0, 0.0, first.release_m() + 0.005});
  Hand second(first.particles);
  second.felt.resume(first.felt.pages());
  EXPECT_EQ(second.felt.push().digest, first.felt.push().digest);
  std::vector<glm::dvec3> one, other;
  push_along_x(first, 1000.0, 0.02, 0.015, [&](const Touch& touch) { one.push_back(touch.hand_force_n); });
  second.step({0.01, 0.01, second.release_m() + 0.01});
  push_along_x(second, 1000.0, 0.02, 0.015, [&](const Touch& touch) { other.push_back(touch.hand_force_n); });
  EXPECT_EQ(one.size(), other.size());
  EXPECT_EQ(std::memcmp(one.data(), other.data(), one.size() * sizeof(glm::dvec3)), 0);
  EXPECT_EQ(second.felt.push().digest, first.felt.push().digest);
}

TEST(FeltParticles, RefusePagesThatAreNotTheirs) {
  Hand hand(particles_at({{0.0, 0.0}}));
  EXPECT_THROW(hand.felt.resume({}), std::invalid_argument);
  std::vector<scene::ParticlePage> pages(1);
  pages[0].poses[0].x_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(hand.felt.resume(pages), std::invalid_argument);
}

}  // namespace felt_particles_test
}  // namespace afm
