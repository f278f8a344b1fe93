// SPDX-License-Identifier: Apache-2.0
// Invariant: the passivity observer detects exactly the laws that return more energy than they store
#include "haptics/passivity_observer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "haptics/sample_axes.h"
#include "servo_bench.h"
#include "support/samples/rough_surface.h"

namespace passivity_observer_test {

using namespace afm::haptics;
using afm::physics::Law;
using afm::physics::Phase;
using afm::scene::FaultCode;
using afm::scene::ScaleMode;
using afm::scene::ServoState;

constexpr std::int64_t kPeriodNs = 1'000'000;
constexpr double kPeriodS = 1e-3;
constexpr double kTopM = 0.068;
constexpr double kEncoderM = 0.055e-3;

PassivityObserver::Tick falling_spring(double height_m, double moved_m, double force_share = 1.0) {
  constexpr double kSpring = 40.0;
  const glm::dvec3 force_n(0.0, -kSpring * force_share * height_m, 0.0);
  const double after_m = height_m + moved_m;
  return {.moved_m = {0.0, moved_m, 0.0},
          .wanted_n = force_n,
          .commanded_n = force_n,
          .stored_rise_j = 0.5 * kSpring * (after_m * after_m - height_m * height_m),
          .stiffness_n_per_m = kSpring};
}

TEST(PassivityObserver, SeesNothingInASpringThatIsSampled) {
  PassivityObserver observer;
  double height_m = 0.03;
  for (int i = 0; i < 10'000; ++i) {
    const double moved_m = 1e-3 * std::sin(0.1 * i);
    observer.integrate(falling_spring(height_m, moved_m));
    height_m += moved_m;
    ASSERT_LT(observer.excess_j(), 1e-12);
  }
}

TEST(PassivityObserver, SeesASpringThatGivesMoreThanItHolds) {
  PassivityObserver observer;
  observer.integrate(falling_spring(0.03, -1e-4, 1.5));
  EXPECT_NEAR(observer.excess_j(), 0.5 * 40.0 * 0.03 * 1e-4, 1e-6);
}

TEST(PassivityObserver, DampsByWhatPaysBackInATickAndNoMoreThanItsLimit) {
  PassivityObserver observer;
  const glm::dvec3 velocity(0.0, -0.1, 0.0);
  EXPECT_EQ(observer.damping_n_s_per_m(velocity, kPeriodS), 0.0);
  observer.integrate({.moved_m = {0.0, -1e-4, 0.0}, .stored_rise_j = 2e-5});
  EXPECT_NEAR(observer.damping_n_s_per_m(velocity, kPeriodS), 2e-5 / (0.01 * kPeriodS), 1e-9);
  observer.integrate({.stored_rise_j = 4e-5});
  EXPECT_EQ(observer.damping_n_s_per_m(velocity, kPeriodS), PassivityObserver::kMostDampingNSPerM);
  EXPECT_EQ(observer.damping_n_s_per_m({}, kPeriodS), PassivityObserver::kMostDampingNSPerM);
  EXPECT_FALSE(observer.exceeded());
  observer.integrate({.stored_rise_j = PassivityObserver::kLimitJ});
  EXPECT_TRUE(observer.exceeded());
  observer.reset();
  EXPECT_EQ(observer.excess_j(), 0.0);
}

TEST(PassivityObserver, IsPaidBackByWhatDamps) {
  PassivityObserver observer;
  observer.integrate({.stored_rise_j = 4e-5});
  for (int i = 0; i < 10; ++i) {
    const double damping = observer.damping_n_s_per_m({0.0, 0.1, 0.0}, kPeriodS);
    observer.integrate({.moved_m = {0.0, 0.1 * kPeriodS, 0.0}, .commanded_n = {0.0, -0.1 * damping, 0.0}});
  }
  EXPECT_LE(observer.excess_j(), PassivityObserver::kToleranceJ);
}

TEST(PassivityObserver, BlamesNoLawForWhatTheLimitsAdd) {
  PassivityObserver observer;
  observer.integrate({.moved_m = {0.0, 1e-3, 0.0}, .wanted_n = {}, .commanded_n = {0.0, 1.0, 0.0}});
  EXPECT_EQ(observer.excess_j(), 0.0);
}

TEST(PassivityObserver, BooksAllDirectionsOfTheForce) {
  PassivityObserver observer;
  const glm::dvec3 force_n(0.3, -0.2, 0.5);
  const glm::dvec3 moved_m(1e-3, 2e-3, -1e-3);
  observer.integrate({.moved_m = -moved_m, .wanted_n = force_n, .commanded_n = force_n});
  EXPECT_NEAR(observer.excess_j(), -glm::dot(force_n, moved_m), 1e-12);
}

// Errors by which a broken program could change a force between law and governor.
enum class Injected { Nothing, HalfMore, FiveMillisecondsLate };

// Law, scale and governor in a loop that a test moves by its hand's height; without the servo around them.
class Loop {
 public:
  explicit Loop(const afm::scene::SharedContact& material, std::int64_t period_ns = kPeriodNs,
                const afm::scene::SharedHeightField* drawn = nullptr, ScaleMode mode = ScaleMode::Fit)
      : period_ns_(period_ns),
        model_(afm::test::model_of(material, drawn, period_ns)),
        governor_(safety_limits(omni_like("hand"), period_ns, Scaling::kStrokeM, false)) {
    model_->use(mode);
    governor_.set_release_height(model_->scaling().release_height_m());
  }

  void tick(const glm::dvec3& position_m, std::int64_t late_ns = 0) {
    time_ns_ += period_ns_ + late_ns;
    position_m_ = position_m;
    const auto touch = model_->step(sample_.in_sample(position_m));
    const auto& response = touch.response;
    const double height_m = model_->scaling().hand_height_m(touch.z_m);
    phase_ = response.phase;
    const glm::dvec3 force_n = sample_.in_device(touch.hand_force_n);
    history_[ticks_ % history_.size()] = force_n;
    glm::dvec3 wanted_n = force_n;
    if (injected == Injected::HalfMore) wanted_n = 1.5 * force_n;
    if (injected == Injected::FiveMillisecondsLate) wanted_n = history_[(ticks_ + 1) % history_.size()];
    ++ticks_;
    bool pulled_off = false;
    for (std::uint32_t i = 0; i < response.event_count; ++i) {
      pulled_off = pulled_off || response.events[i].kind == afm::physics::EventKind::JumpOffContact;
    }
    const auto output = governor_.step({.time_ns = time_ns_,
                                        .hand_position_m = position_m,
                                        .wanted_force_n = wanted_n,
                                        .hand_height_m = height_m,
                                        .phase = phase_,
                                        .pulled_off = pulled_off,
                                        .turn_on = turn_on,
                                        .renderer = RendererLink::Alive,
                                        .law_energy = model_->energy(touch)});
    force_n_ = output.command.force_n();
    if (output.dropped) model_->wait_for_lift();
    most_excess_j = std::max(most_excess_j, governor_.observer().excess_j());
    damped_ticks += governor_.observer_damping_n_s_per_m() > 0.0 ? 1 : 0;
  }

  // Lifts slowly and presses Turn-On until there is force; a fault takes two presses, heat perhaps more.
  void arm() {
    for (int press = 0; press < 10 && governor_.state() != ServoState::Running; ++press) {
      turn_on = false;
      glm::dvec3 place_m = position_m_;
      const glm::dvec3 way_m = (glm::dvec3(0.0, kTopM, 0.0) - place_m) / 400.0;
      for (int i = 0; i < 400; ++i) tick(place_m += way_m);
      for (int i = 0; i < 50; ++i) tick(place_m);
      turn_on = true;
      for (int i = 0; i < 520; ++i) tick(place_m);
    }
    ASSERT_EQ(governor_.state(), ServoState::Running);
  }

  SafetyGovernor& governor() { return governor_; }
  const ContactModel& model() const { return *model_; }
  Phase phase() const { return phase_; }
  const glm::dvec3& position_m() const { return position_m_; }
  const glm::dvec3& force_n() const { return force_n_; }

  Injected injected = Injected::Nothing;
  bool turn_on = false;
  double most_excess_j = 0;
  int damped_ticks = 0;

 private:
  std::int64_t period_ns_;
  std::unique_ptr<ContactModel> model_;
  SampleAxes sample_;  // level sample
  SafetyGovernor governor_;
  std::array<glm::dvec3, 6> history_{};  // oldest entry 5 ms old at 1 kHz
  std::size_t ticks_ = 0;
  std::int64_t time_ns_ = 1'000'000'000;
  glm::dvec3 position_m_{0.0, kTopM, 0.0};
  Phase phase_ = Phase::WaitForLift;
  glm::dvec3 force_n_{0.0};
};

afm::scene::SharedContact random_material(std::mt19937_64& random, Law law) {
  const auto between = [&](double least, double most) {
    return least * std::pow(most / least, std::uniform_real_distribution<double>(0.0, 1.0)(random));
  };
  afm::scene::SharedContact material =
      afm::test::material("random", between(0.03, 1.0), between(5e-21, 300e-21), between(1e-3, 40e-3));
  material.law = law;
  material.contact.tip_radius.si = between(10e-9, 100e-9);
  material.contact.reduced_modulus.si = between(1e9, 100e9);
  return material;
}

// A hand on its way as no hand would go: speeds up to the trip's, reversals, places in steps of an encoder, sideways
// into the end-stop, ticks that come too late.
void wander(Loop& loop, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const bool quantised = random() % 2 == 0;
  const bool restless = random() % 4 == 0;
  const int ticks = 40 + static_cast<int>(random() % 150);
  glm::dvec3 place_m = loop.position_m();
  glm::dvec3 velocity(0.0, place_m.y > 0.03 ? -0.5 : 0.5, 0.0);
  for (int i = 0; i < ticks; ++i) {
    if (random() % 32 == 0) {
      velocity.y = 0.7 * (2.0 * share(random) - 1.0);
      velocity.x = restless ? 0.3 * (2.0 * share(random) - 1.0) : 0.0;
    }
    if (place_m.y < -0.037) velocity.y = std::abs(velocity.y);
    if (place_m.y > 0.078) velocity.y = -std::abs(velocity.y);
    if (std::abs(place_m.x) > 0.078) velocity.x = -std::copysign(velocity.x, place_m.x);
    const std::int64_t late_ns = restless && random() % 64 == 0 ? static_cast<std::int64_t>(share(random) * 19e6) : 0;
    place_m += velocity * (kPeriodS + 1e-9 * static_cast<double>(late_ns));
    loop.tick(quantised ? kEncoderM * glm::round(place_m / kEncoderM) : place_m, late_ns);
  }
}

struct AnyLaw {
  std::string name;
  Law law;
};

class PassivityObserverOf : public testing::TestWithParam<AnyLaw> {};

TEST_P(PassivityObserverOf, NeverActsOnTheIdealModel) {
  constexpr int kMaterials = 40;
  constexpr int kTrips = 400;
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam().law) + 1);
  const auto rough = std::make_unique<afm::scene::SharedHeightField>(afm::test::rough_surface(3));
  int attached = 0;
  int armed = 0;
  for (int i = 0; i < kMaterials; ++i) {
    std::unique_ptr<Loop> loop;
    while (loop == nullptr) {
      try {
        // every other one on a surface that is nowhere flat, on one scale after the other
        const auto mode = static_cast<ScaleMode>(i % 3);
        loop = std::make_unique<Loop>(random_material(random, GetParam().law), kPeriodNs,
                                      i % 2 == 0 ? nullptr : rough.get(), mode);
      } catch (const std::runtime_error&) {
        // not every set of numbers has such a law, or can be felt
      }
    }
    for (int trip = 0; trip < kTrips; ++trip) {
      if (loop->governor().state() != ServoState::Running) loop->arm();
      if (HasFatalFailure()) return;
      wander(*loop, random);
      attached += loop->phase() == Phase::Attached ? 1 : 0;
      armed += loop->governor().state() == ServoState::Running ? 1 : 0;
      if (random() % 16 == 0) loop->governor().disarm();
      ASSERT_EQ(loop->damped_ticks, 0) << "material " << i << ", trip " << trip << ", excess "
                                       << 1e6 * loop->most_excess_j << " uJ";
      ASSERT_NE(loop->governor().fault(), FaultCode::EnergyExceeded);
    }
  }
  EXPECT_GT(attached, kMaterials * kTrips / 20);
  EXPECT_GT(armed, kMaterials * kTrips / 2);
}

INSTANTIATE_TEST_SUITE_P(Laws, PassivityObserverOf,
                         testing::Values(AnyLaw{"Paper", Law::Paper}, AnyLaw{"Hao", Law::Hao},
                                         AnyLaw{"Hertz", Law::Hertz}, AnyLaw{"Dmt", Law::Dmt}, AnyLaw{"Jkr", Law::Jkr},
                                         AnyLaw{"MaugisDugdale", Law::MaugisDugdale},
                                         AnyLaw{"LennardJones", Law::LennardJones}),
                         [](const auto& test) { return test.param.name; });

class PassivityObserverOfDynamics : public testing::TestWithParam<AnyLaw> {};

// Warm levers of high and low quality: heat, ringing and jumps that take their time are no fault.
TEST_P(PassivityObserverOfDynamics, NeverActs) {
  constexpr int kMaterials = 5;
  constexpr int kTrips = 50;
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam().law) + 1);
  for (int i = 0; i < kMaterials; ++i) {
    std::unique_ptr<Loop> loop;
    while (loop == nullptr) {
      auto material = random_material(random, GetParam().law);
      material.dynamic = 1;
      material.lever = {afm::physics::Frequency(12e3), i % 2 == 0 ? 2.5 : 100.0, afm::physics::Temperature(298.0)};
      try {
        loop = std::make_unique<Loop>(material);
      } catch (const std::runtime_error&) {
        // as above
      }
    }
    for (int trip = 0; trip < kTrips; ++trip) {
      if (loop->governor().state() != ServoState::Running) loop->arm();
      if (HasFatalFailure()) return;
      wander(*loop, random);
      ASSERT_EQ(loop->damped_ticks, 0) << "material " << i << ", trip " << trip << ", excess "
                                       << 1e6 * loop->most_excess_j << " uJ";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, PassivityObserverOfDynamics,
                         testing::Values(AnyLaw{"Hertz", Law::Hertz}, AnyLaw{"Dmt", Law::Dmt}, AnyLaw{"Jkr", Law::Jkr},
                                         AnyLaw{"MaugisDugdale", Law::MaugisDugdale},
                                         AnyLaw{"LennardJones", Law::LennardJones}),
                         [](const auto& test) { return test.param.name; });

// Place of the tip when the fault occurs, and direction of the hand: paths on which the fault gives energy at once.
struct Fault {
  std::string name;
  Injected injected;
  double from_m;
  double speed_m_per_s;
};

class PassivityObserverWithFault : public testing::TestWithParam<Fault> {
 protected:
  // Attached, at rest in `height_m`.
  static void bring(Loop& loop, double height_m) {
    loop.arm();
    double y_m = kTopM;
    for (const double target_m : {-0.010, height_m}) {
      const double step_m = std::copysign(0.2 * kPeriodS, target_m - y_m);
      for (; std::abs(target_m - y_m) > std::abs(step_m); y_m += step_m) loop.tick({0.0, y_m, 0.0});
      for (int i = 0; i < 50; ++i) loop.tick({0.0, y_m = target_m, 0.0});
    }
    ASSERT_EQ(loop.phase(), Phase::Attached);
    ASSERT_EQ(loop.damped_ticks, 0);
  }
};

TEST_P(PassivityObserverWithFault, ActsWithinThreeTicks) {
  for (const std::int32_t material : {afm::test::kMica, afm::test::kGold, afm::test::kSiliconNitride}) {
    Loop loop(afm::test::paper_model().materials[static_cast<std::size_t>(material)]);
    bring(loop, GetParam().from_m);
    double y_m = GetParam().from_m;
    const double step_m = GetParam().speed_m_per_s * kPeriodS;
    for (int i = 0; i < 10; ++i) loop.tick({0.0, y_m += step_m, 0.0});
    ASSERT_EQ(loop.damped_ticks, 0);
    loop.injected = GetParam().injected;
    int ticks = 0;
    for (; loop.damped_ticks == 0 && ticks < 100; ++ticks) loop.tick({0.0, y_m += step_m, 0.0});
    EXPECT_LE(ticks, 3);
  }
}

INSTANTIATE_TEST_SUITE_P(Faults, PassivityObserverWithFault,
                         testing::Values(Fault{"HalfMoreWhilePulledDown", Injected::HalfMore, 0.030, -0.05},
                                         Fault{"HalfMoreWhilePushedUp", Injected::HalfMore, -0.020, 0.05},
                                         Fault{"LateWhilePulledDown", Injected::FiveMillisecondsLate, 0.030, -0.2},
                                         Fault{"LateWhilePressed", Injected::FiveMillisecondsLate, -0.005, -0.2},
                                         Fault{"LateWhileLifted", Injected::FiveMillisecondsLate, 0.030, 0.2}),
                         [](const auto& test) { return test.param.name; });

TEST(PassivityObserverInTheLoop, TakesTheForceAwayWhereDampingDoesNotSuffice) {
  Loop loop(afm::test::paper_model().materials[afm::test::kMica]);
  loop.arm();
  double y_m = kTopM;
  while (y_m > -0.010) loop.tick({0.0, y_m -= 0.2 * kPeriodS, 0.0});
  while (y_m < 0.045) loop.tick({0.0, y_m += 0.2 * kPeriodS, 0.0});
  // a spring that is half as stiff again, let go from where it is stretched most
  loop.injected = Injected::HalfMore;
  int ticks = 0;
  while (loop.governor().state() == ServoState::Running && ++ticks < 200) {
    // too slow for damping to take much
    loop.tick({0.0, y_m -= 0.05 * kPeriodS, 0.0});
  }
  EXPECT_EQ(loop.governor().state(), ServoState::Fading);
  EXPECT_EQ(loop.governor().fault(), FaultCode::EnergyExceeded);
  EXPECT_LT(loop.most_excess_j, 2.0 * PassivityObserver::kLimitJ);
  for (ticks = 0; glm::length(loop.force_n()) > 0.0 && ticks < 100; ++ticks) loop.tick({0.0, y_m, 0.0});
  EXPECT_LE(ticks, 21);
}

}  // namespace passivity_observer_test
