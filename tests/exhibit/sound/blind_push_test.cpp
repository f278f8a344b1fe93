// SPDX-License-Identifier: Apache-2.0
// A push by ear alone: what a particle that moves sounds like, and a hand that follows it without a picture.
// Invariant: a hand that hears a pushed particle 30 ms late, and sees nothing, pushes it along a line
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <vector>

#include "exhibit/sound/push_ear.h"
#include "exhibit/sound/synthesizer.h"
#include "exhibit/sound/tip_ear.h"
#include "pushing_bench.h"

namespace afm::exhibit {
namespace blind_push_test {

using physics::PushState;

// Samples of a tip that goes along x by steps of 1 nm, with a force on its lever.
class Pushed {
 public:
  PushEar::Astray step(double x_n, double y_n, PushState state = PushState::Slides, double normal_n = 1e-9) {
    sample_.surface.xy_m[0] += 1e-9;
    sample_.push = {.lateral_n = {x_n, y_n}, .normal_n = normal_n, .particle = 0, .state = state};
    return ear_.add(sample_);
  }
  const HeardPush& push() const { return ear_.push(); }

 private:
  scene::TipSample sample_;
  PushEar ear_;
};

TEST(PushEar, HearsTheForceAndTheSideOfAParticle) {
  Pushed pushed;
  for (int i = 0; i < 50; ++i) EXPECT_EQ(pushed.step(-1e-9, 0.0), PushEar::Astray::No);
  EXPECT_DOUBLE_EQ(pushed.push().force_n, 1e-9);
  EXPECT_NEAR(pushed.push().side, 0.0, 1e-12);
  pushed.step(-0.9e-9, -0.436e-9);  // particle on the left, 26 degrees off the path
  EXPECT_NEAR(pushed.push().side, -0.436, 0.001);
  EXPECT_EQ(pushed.step(-0.8e-9, -0.6e-9), PushEar::Astray::Left);
  EXPECT_EQ(pushed.step(-0.7e-9, -0.7e-9), PushEar::Astray::No) << "said once";
  pushed.step(-1e-9, 0.0);
  EXPECT_EQ(pushed.step(-0.8e-9, 0.6e-9), PushEar::Astray::Right);
  pushed.step(-1e-9, 0.0, PushState::Holds);
  EXPECT_LT(pushed.push().pulse, 0.5) << "quieter";
  pushed.step(0.0, 0.0, PushState::Free);
  EXPECT_EQ(pushed.push().force_n, 0.0);
  pushed.step(1e-9, 0.0, PushState::Slides, -1e-9);
  EXPECT_EQ(pushed.push().side, 0.0) << "dragged";
  EXPECT_GT(pushed.push().force_n, 0.0);
}

TEST(PushEar, HearsThatAParticleRolls) {
  Pushed pushed;
  int loud = 0, changes = 0;
  bool was_loud = true;
  for (int i = 0; i < 130; ++i) {
    pushed.step(-1e-9, 0.0, PushState::Rolls);
    const bool is_loud = pushed.push().pulse == 1.0;
    if (is_loud) ++loud;
    if (is_loud != was_loud) ++changes;
    was_loud = is_loud;
  }
  EXPECT_NEAR(loud, 65, 10);
  EXPECT_NEAR(changes, 20, 2) << "a pulse each 13 nm";
}

TEST(PushEar, HasAHissWhosePitchRisesWithTheForceAndWhichFollowsTheSide) {
  const Tone weak = tone_of({.force_n = 1e-10}), strong = tone_of({.force_n = 1e-9});
  EXPECT_NEAR(strong.hz / weak.hz, std::exp2(9.0 / 12.0), 1e-12);
  EXPECT_EQ(weak.hiss, 1.0);
  EXPECT_LT(tone_of({.force_n = 1e-9, .side = -1.0}).side, -0.8);
  EXPECT_GT(tone_of({.force_n = 1e-9, .side = 1.0}).side, 0.8);
}

// The hiss is noise, is the same in every run, and starts within 30 ms.
TEST(PushEar, IsHeardInTheEarOfTheSideWithin30Ms) {
  const auto sound = [] {
    Synthesizer synthesizer(Channels::Stereo);
    synthesizer.set_tone(0, tone_of({.force_n = 1e-9, .side = 1.0}));
    std::vector<float> samples(2 * 48 * 30);
    synthesizer.add_to(samples);
    return samples;
  };
  const std::vector<float> samples = sound();
  double left = 0.0, right = 0.0;
  for (std::size_t i = samples.size() / 2; i + 1 < samples.size(); i += 2) {
    left += std::abs(static_cast<double>(samples[i]));
    right += std::abs(static_cast<double>(samples[i + 1]));
  }
  EXPECT_GT(right, 5.0 * left);
  EXPECT_GT(right / (0.25 * static_cast<double>(samples.size())), 0.01);
  EXPECT_EQ(samples, sound());
}

// A hand that pushes along x at 6 mm/s by three times the distance of tip and sphere, at first 0.1 of it beside the
// middle.
class BlindHand {
 public:
  explicit BlindHand(bool listens) : listens_(listens) {
    bench_.put_down();
    hand_m_ = {-0.030, kBesideM};
    bench_.go(hand_m_.x, hand_m_.y, 0.001, 0.3);
    rho_m_ = test::touch_m(test::two_particles().particles);
    const double scale = bench_.renderer.tip_push()->hand_m_per_m;
    while (hand_m_.x < scale * (-80e-9 + 2.7 * rho_m_)) push();  // rho behind the sphere, plus the bend
  }

  const scene::ParticlePose& sphere() { return pose_ = bench_.pose(0); }
  double rho_m() const { return rho_m_; }

 private:
  static constexpr double kBesideM = 0.0008;    // 0.1 rho in the hand
  static constexpr int kFrame = 10, kLate = 3;  // ticks of a step of the hand; number of steps of its delay
  static constexpr double kStepM = 6e-5;        // path of the hand per step
  static constexpr double kTurn = 2.0;          // slope of its path as a function of the side of the particle

  void push() {
    hand_m_.x += kStepM;
    if (listens_ && heard_.size() == kLate) hand_m_.y -= kTurn * kStepM * heard_.front();
    bench_.send(hand_m_.x, hand_m_.y, 0.001, 0.01);
    const std::size_t before = bench_.samples.size();
    for (int i = 0; i < kFrame; ++i) bench_.tick();
    for (std::size_t i = before; i < bench_.samples.size(); ++i) ear_.add(bench_.samples[i]);
    heard_.push_back(ear_.push().side);
    if (heard_.size() > kLate) heard_.pop_front();
  }

  bool listens_;
  test::PushingBench bench_;
  TipEar ear_;
  std::deque<double> heard_;
  glm::dvec2 hand_m_{0.0};
  scene::ParticlePose pose_;
  double rho_m_ = 0;
};

TEST(BlindPush, ByEarGoesThreeDistancesFarWithinARadius) {
  BlindHand deaf(false);
  EXPECT_LT(deaf.sphere().x_m, -80e-9 + 1.0 * deaf.rho_m()) << "it has slipped past";
  BlindHand hand(true);
  EXPECT_NEAR(hand.sphere().x_m, -80e-9 + 3.0 * hand.rho_m(), test::kGoldRadiusM);
  EXPECT_LT(std::abs(hand.sphere().y_m), test::kGoldRadiusM);
}

}  // namespace blind_push_test
}  // namespace afm::exhibit
