// SPDX-License-Identifier: Apache-2.0
// The whole servo, with its governor, among particles: the work of a hand that comes back to where it began.
// Invariant: no closed path of a hand among particles gives it energy
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "haptics/servo_loop.h"
#include "servo_bench.h"
#include "support/deep.h"
#include "support/paper_model.h"
#include "support/particles/gold_particles.h"

namespace afm {
namespace closed_paths_test {

// A device at the places that the test sets.
class PlacedDevice final : public haptics::HapticDevice {
 public:
  const haptics::DeviceSpec& spec() const noexcept override { return spec_; }
  haptics::DeviceSample read(std::int64_t /*now_ns*/) noexcept override {
    return {.position_m = at_m, .turn_on = turn_on, .healthy = true};
  }
  void write(const haptics::ForceCommand& command) noexcept override { force_n = command.force_n(); }

  glm::dvec3 at_m{0.0, 0.06, 0.0};
  glm::dvec3 force_n{0.0};
  bool turn_on = false;

 private:
  haptics::DeviceSpec spec_ = haptics::omni_like("placed hand");
};

class Walk {
 public:
  explicit Walk(const scene::SharedModel& model)
      : segment_(test::required(scene::SharedSegment::create(model, 0))),
        renderer_(segment_.renderer_side()),
        loop_(test::required(haptics::ServoLoop::create(segment_, device_, {}))) {
    renderer_.store(
        scene::Selection{.material = test::kMica, .revision = 1, .scale_mode = scene::ScaleMode::Particles});
    rest(1500);
    device_.turn_on = true;
    rest(100);
    device_.turn_on = false;
    rest(600);
  }

  scene::TipState state() { return *renderer_.tip_state(); }
  glm::dvec2 sphere_in_hand_m() {
    if (const auto newer = renderer_.new_particle_page(0)) page_ = *newer;
    return renderer_.tip_push()->hand_m_per_m * glm::dvec2(page_.poses[0].x_m, page_.poses[0].y_m);
  }

  // Moves on a straight line, with the sample's z up; returns the work of the hand.
  double go(const glm::dvec3& to) {
    double work_j = 0.0;
    while (at_m_ != to) {
      const glm::dvec3 before_m = device_.at_m, before_n = device_.force_n;
      const double left_m = glm::distance(to, at_m_), step_m = meets() ? kFineM : kStepM;
      at_m_ = left_m <= step_m ? to : at_m_ + step_m / left_m * (to - at_m_);
      device_.at_m = {at_m_.x, at_m_.z, -at_m_.y};
      tick();
      work_j -= 0.5 * glm::dot(before_n + device_.force_n, device_.at_m - before_m);
    }
    return work_j;
  }
  void rest(int ticks) {
    for (int i = 0; i < ticks; ++i) tick();
  }

 private:
  // The mean of both ends of a step of a spring of K errs by K/8 times its square where it begins: 6e-10 J.
  static constexpr double kStepM = 5e-5, kFineM = 5e-6;

  bool meets() { return at_m_.z < 0.012 && glm::distance(glm::dvec2(at_m_), sphere_in_hand_m()) < 0.013; }

  void tick() {
    renderer_.store(scene::RendererHeartbeat{.time_ns = now_ns_, .frame = ++frame_});
    loop_->tick(now_ns_ += loop_->period_ns(), 0);
    while (renderer_.pop_sample()) {
    }
    while (renderer_.pop_event()) {
    }
  }

  PlacedDevice device_;
  scene::SharedSegment segment_;
  scene::RendererSide renderer_;
  std::unique_ptr<haptics::ServoLoop> loop_;
  scene::ParticlePage page_;
  glm::dvec3 at_m_{0.0, 0.0, 0.06};
  std::int64_t now_ns_ = 1'000'000'000;
  std::uint64_t frame_ = 0;
};

TEST(ClosedPathsAmongParticles, GiveTheHandNoEnergyAfterTheGovernor) {
  scene::SharedModel model = test::paper_model();
  model.particles = test::particles_at({{0.0, 0.0}, {0.0, 300e-9}});
  Walk walk(model);
  ASSERT_EQ(walk.state().servo_state, scene::ServoState::Running);
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> beside(-0.012, 0.012), low(0.0005, 0.006), turn(0.0, 6.28);
  const int paths = support::deep() ? 1000 : 10;
  int pushed = 0;
  for (int path = 0; path < paths; ++path) {
    const glm::dvec2 middle = walk.sphere_in_hand_m();
    const auto near = [&] {
      const double right_m = beside(random), back_m = beside(random);
      return middle + glm::dvec2{right_m, back_m};
    };
    // starts outside, so that the sphere stays in the middle of the workspace
    const double angle = turn(random);
    const glm::dvec2 random_way(std::cos(angle), std::sin(angle));
    const glm::dvec2 outwards = glm::length(middle) > 0.01 ? glm::normalize(middle) : random_way;
    const glm::dvec3 over(middle + 0.012 * outwards, 0.03);
    walk.go(over);
    double work_j = walk.go(glm::dvec3(glm::dvec2(over), low(random)));
    work_j += walk.go(glm::dvec3(middle - 0.004 * outwards, low(random)));
    for (int i = 0; i < 2; ++i) {
      const glm::dvec2 place = near();
      work_j += walk.go(glm::dvec3(place, low(random)));
    }
    work_j += walk.go(over);
    EXPECT_GE(work_j, -1e-9) << path;
    if (walk.sphere_in_hand_m() != middle) ++pushed;
  }
  EXPECT_GT(pushed, paths / 2);
  EXPECT_EQ(walk.state().fault, scene::FaultCode::None);
}

}  // namespace closed_paths_test
}  // namespace afm
