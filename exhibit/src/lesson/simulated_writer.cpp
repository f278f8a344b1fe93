// SPDX-License-Identifier: Apache-2.0
#include "simulated_writer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "exhibit/state/lines_to_write.h"
#include "physics/manipulation/ink.h"
#include "scene/samples/ink_run.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/scratch_run.h"

namespace afm::exhibit {

namespace {

constexpr int kMostDrawSteps = 5000;  // limit for one part of a line
constexpr double kPressPerS = 2.0;    // fraction of the felt error of the load that the hand corrects per second
constexpr double kFastestM = 2e-4;    // largest change of the height between two commands
constexpr double kTouchMPerS = 6e-3;  // speed of the hand while it comes down on the sample

class WritingHand final : public SimulatedHand {
 public:
  WritingHand(const scene::ParticleSet& set, std::unique_ptr<SimulatedServo>&& servo, std::uint64_t seed)
      : SimulatedHand(set, std::move(servo), seed) {}

 private:
  void attempt(const LessonPrompt& prompt) override;
  void press();
  void release();
  void draw_to(const glm::dvec2& from_m, const glm::dvec2& to_m);
  glm::dvec2 tip_m() const;

  double load_n_ = 0;                 // load with which to press
  double draw_m_per_s_ = kDrawMPerS;  // speed of the hand along a line
  std::size_t begun_ = 0;
  bool tried_ = false;
};

// Writes all lines; if that was not good enough, all of them again on the level sample.
void WritingHand::attempt(const LessonPrompt& prompt) {
  if (std::exchange(begun_, prompt.task + 1) == prompt.task + 1 && tried_) put_back();
  tried_ = true;
  if (set().ink) {  // width by the speed, at any load
    draw_m_per_s_ = m_per_m() * physics::inked_area(set().ink->ink, physics::Time(1.0)).si / prompt.lines->width_m;
  } else {
    // half of the contact bears a tip that is dragged: 2 F = pi H (w/2)^2
    const double half_m = 0.5 * prompt.lines->width_m;
    load_n_ = 0.5 * std::numbers::pi * set().soft->surface.hardness.si * half_m * half_m;
  }
  for (const std::vector<glm::dvec2>& corners_m : prompt.lines->lines_m) {
    go(m_per_m() * corners_m.front(), high_m(), kWayMPerS);
    press();
    for (std::size_t i = 1; i < corners_m.size(); ++i) draw_to(corners_m[i - 1], corners_m[i]);
    release();
    rest(1.0);
  }
}

// Comes down until the load is felt, or ink flows.
void WritingHand::press() {
  const double lowest_m = -high_m();
  const auto presses = [&] { return set().ink ? push().state != physics::PushState::Free : push().lift_n >= load_n_; };
  while (!presses() && height_m() > lowest_m) step(at_m(), height_m() - kCommandS * kTouchMPerS);
}

// Rises, with ink until the liquid tears.
void WritingHand::release() {
  lift();
  for (int i = 0; i < kMostDrawSteps && push().state != physics::PushState::Free; ++i) {
    step(at_m(), height_m() + kCommandS * kWayMPerS);
  }
}

void WritingHand::draw_to(const glm::dvec2& from_m, const glm::dvec2& to_m) {
  const glm::dvec2 along = glm::normalize(to_m - from_m), aside(-along.y, along.x);
  std::deque<glm::dvec2> seen_m{tip_m()};
  for (int i = 0; i < kMostDrawSteps; ++i) {
    const glm::dvec2 there_m = seen_m.front();
    if (glm::dot(to_m - there_m, along) < draw_m_per_s_ / m_per_m() * kSeenAfterS) break;
    const double off_m = m_per_m() * glm::dot(there_m - from_m, aside);
    const scene::TipPush now = push();
    // the height by which a softer or harder lever changes the load
    const double spring_n_per_m = set().setup.springs.normal.si / now.softened_upwards;
    const double down_m =
        set().ink ? 0.0 : kCommandS * kPressPerS * m_per_m() * (load_n_ - now.lift_n) / spring_n_per_m;
    step(at_m() + kCommandS * (draw_m_per_s_ * along - kSteerPerS * off_m * aside),
         height_m() - std::clamp(down_m, -kFastestM, kFastestM));
    seen_m.push_back(tip_m());
    if (seen_m.size() > kSeenAfter) seen_m.pop_front();
  }
}

glm::dvec2 WritingHand::tip_m() const {
  const scene::TipPush now = push();
  return {now.apex_m[0], now.apex_m[1]};
}

}  // namespace

std::unique_ptr<SimulatedHand> make_writing_hand(const scene::ParticleSet& set, std::unique_ptr<SimulatedServo>&& servo,
                                                 std::uint64_t seed) {
  return std::make_unique<WritingHand>(set, std::move(servo), seed);
}

}  // namespace afm::exhibit
