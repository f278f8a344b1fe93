// SPDX-License-Identifier: Apache-2.0
#include "simulated_pusher.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "exhibit/state/particles_now.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/pattern_state.h"

namespace afm::exhibit {

namespace {

constexpr int kMostPushSteps = 2000;
// lengths in radii of the particle
constexpr double kLow = 0.32;    // height of the tip while it pushes
constexpr double kBehind = 2.0;  // distance from the middle of the particle to the tip that comes down behind it
constexpr double kNear = 0.4;    // distance from a target that satisfies the student
constexpr double kAside = 0.3;   // offset that loses a particle
constexpr double kLostWay = 8.0;
// values without the picture
constexpr double kBlindMPerS = 4e-3;  // speed of the hand
constexpr double kTurn = 2.0;         // slope of its path as a function of the side on which it feels the particle
constexpr int kLostAfter = 25;        // number of commands without a force
constexpr double kForceNoise = 0.07;  // scatter of a remembered force, order of magnitude, estimated
constexpr double kPressMPerS = 3e-3;  // speed of a pressing hand, far from the remembered force
constexpr double kPressS = 6.0;

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a;
  const double share = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::distance(p, a + share * along);
}

class PushingHand final : public SimulatedHand {
 public:
  PushingHand(const scene::ParticleSet& set, std::unique_ptr<SimulatedServo>&& servo, std::uint64_t seed);

 private:
  static constexpr double kBlindStepM = kBlindMPerS * kCommandS;  // path of the hand per command

  void attempt(const LessonPrompt& prompt) override;
  void bring(std::size_t particle, const glm::dvec2& to_m);
  void steer(std::size_t particle, const glm::dvec2& to_m);
  void slip_past(std::size_t particle);
  void push_by_feel(std::size_t particle, const glm::dvec2& to_m);
  void answer_by_feel(std::size_t particle);
  std::optional<double> feel(std::size_t particle);
  void press(std::size_t particle, double force_n);
  double lateral_n() const { return std::hypot(push().lateral_n[0], push().lateral_n[1]); }
  glm::dvec2 free_direction(std::size_t particle, double way_m) const;
  glm::dvec2 place(std::size_t particle) const;
  double radius_m(std::size_t particle) const;
  double low_m() const { return m_per_m() * kLow * scene::median_radius(set()).si; }

  std::vector<glm::dvec2> targets_m_;
  std::size_t task_ = 0;             // task of the newest attempt
  std::optional<glm::dvec2> end_m_;  // goal of this task's particle
};

PushingHand::PushingHand(const scene::ParticleSet& set, std::unique_ptr<SimulatedServo>&& servo, std::uint64_t seed)
    : SimulatedHand(set, std::move(servo), seed) {
  for (const physics::ParticlePlace& target : scene::shared_targets(set)) {
    targets_m_.emplace_back(target.position.x.si, target.position.y.si);
  }
}

void PushingHand::attempt(const LessonPrompt& prompt) {
  const PushPlan& plan = prompt.push;
  if (std::exchange(task_, prompt.task) != prompt.task) end_m_.reset();
  switch (plan.until) {
    case PushUntil::Pattern: {
      const auto pattern =
          scene::pattern_state(set(), scene::shared_pattern_of(set()), *places_of({.set = &set(), .pages = pages()}));
      const auto off_m = [&](std::size_t i) {
        return glm::distance(targets_m_[i], place(pattern->match.particles[i]));
      };
      std::size_t worst = 0;
      for (std::size_t i = 1; i < targets_m_.size(); ++i) worst = off_m(i) > off_m(worst) ? i : worst;
      return bring(pattern->match.particles[worst], targets_m_[worst]);
    }
    case PushUntil::Target:
      return bring(plan.particle, targets_m_[plan.target]);
    case PushUntil::Moved: {
      const double way_m = plan.distance_m + 2.0 * kNear * radius_m(plan.particle);
      if (!end_m_) end_m_ = place(plan.particle) + way_m * free_direction(plan.particle, way_m);
      return bring(plan.particle, *end_m_);
    }
    case PushUntil::Lost:
      return slip_past(plan.particle);
    case PushUntil::Line:
      return push_by_feel(plan.particle, targets_m_[plan.target]);
    case PushUntil::Threshold:
      return answer_by_feel(plan.particle);
  }
}

// Pushes the particle once, or rests if it is near enough.
void PushingHand::bring(std::size_t particle, const glm::dvec2& to_m) {
  if (glm::distance(place(particle), to_m) < kNear * radius_m(particle)) return rest(1.0);
  steer(particle, to_m);
  rest(0.5);
}

void PushingHand::steer(std::size_t particle, const glm::dvec2& to_m) {
  const double behind_m = kBehind * radius_m(particle);
  const glm::dvec2 from_m = place(particle), along = glm::normalize(to_m - from_m);
  go(m_per_m() * (from_m - behind_m * along), high_m(), kWayMPerS);
  go(at_m(), low_m(), kWayMPerS);
  std::deque<glm::dvec2> seen{place(particle)};
  for (int i = 0; i < kMostPushSteps; ++i) {
    const glm::dvec2 there_m = seen.front();
    if (glm::dot(to_m - there_m, along) < kDrawMPerS / m_per_m() * kSeenAfterS) break;
    const glm::dvec2 left = glm::normalize(to_m - there_m), aside(-left.y, left.x);
    const glm::dvec2 tip_m = at_m() - m_per_m() * there_m;
    const double off_m = glm::dot(tip_m, aside);
    if (std::abs(off_m) > m_per_m() * behind_m * 0.7 || glm::dot(tip_m, left) > 0.0) break;  // lost particle
    step(at_m() + kCommandS * (kDrawMPerS * left - kSteerPerS * off_m * aside), low_m());
    seen.push_back(place(particle));
    if (seen.size() > kSeenAfter) seen.pop_front();
  }
  lift();
}

// Pushes off centre, without steering.
void PushingHand::slip_past(std::size_t particle) {
  const double r_m = radius_m(particle);
  const glm::dvec2 from_m = place(particle), along = free_direction(particle, kLostWay * r_m);
  const glm::dvec2 across(-along.y, along.x);
  go(m_per_m() * (from_m + r_m * (kAside * across - kBehind * along)), high_m(), kWayMPerS);
  go(at_m(), low_m(), kWayMPerS);
  const auto steps = static_cast<int>(kLostWay * r_m * m_per_m() / (kDrawMPerS * kCommandS));
  for (int i = 0; i < steps && goes_on(); ++i) step(at_m() + kCommandS * kDrawMPerS * along, low_m());
  lift();
}

// Comes down behind the particle, which can be seen until then, and steers by the side from which the force comes. If
// the particle is lost, all begins again.
void PushingHand::push_by_feel(std::size_t particle, const glm::dvec2& to_m) {
  const glm::dvec2 from_m = place(particle), along = glm::normalize(to_m - from_m), right(along.y, -along.x);
  go(m_per_m() * (from_m - kBehind * radius_m(particle) * along), high_m(), kWayMPerS);
  go(at_m(), low_m(), kWayMPerS);
  std::deque<double> felt;
  int free = 0;  // number of commands since the tip has touched it
  for (int i = 0; i < kMostPushSteps && free < kLostAfter && !prompt().far_enough; ++i) {
    const double side = felt.size() < kSeenAfter ? 0.0 : felt.front();
    step(at_m() + kBlindStepM * (along + kTurn * side * right), low_m());
    const bool touches = lateral_n() > 0.0;
    free = touches ? 0 : free + (felt.empty() ? 0 : 1);
    if (!touches && felt.empty()) continue;
    felt.push_back(touches ? -glm::dot(glm::dvec2(push().lateral_n[0], push().lateral_n[1]), right) / lateral_n()
                           : 0.0);
    if (felt.size() > kSeenAfter) felt.pop_front();
  }
  lift();
  rest(1.0);
  if (goes_on()) put_back();
}

void PushingHand::answer_by_feel(std::size_t particle) {
  if (const auto felt_n = feel(particle)) {
    const auto& all = set().particles;
    const auto post = std::find_if(all.begin(), all.end(), [](const auto& p) { return p.pinned; });
    press(static_cast<std::size_t>(post - all.begin()), *felt_n * (1.0 + kForceNoise * noise()));
    rest(1.0);
  }
  if (goes_on()) put_back();
}

// Feels the largest lateral force before the particle yields.
std::optional<double> PushingHand::feel(std::size_t particle) {
  const glm::dvec2 from_m = place(particle), along = free_direction(particle, 2.0 * radius_m(particle));
  go(m_per_m() * (from_m - kBehind * radius_m(particle) * along), high_m(), kWayMPerS);
  go(at_m(), low_m(), kWayMPerS);
  double most_n = 0.0;
  bool gave = false;
  for (int i = 0; i < kMostPushSteps && !gave; ++i) {
    step(at_m() + kBlindStepM * along, low_m());
    most_n = std::max(most_n, lateral_n());
    gave = push().state == physics::PushState::Slides || push().state == physics::PushState::Rolls;
  }
  lift();
  return gave ? std::optional(most_n) : std::nullopt;
}

// Presses a particle until the force equals the remembered one, and holds it.
void PushingHand::press(std::size_t particle, double force_n) {
  const glm::dvec2 to_m = place(particle), along = glm::normalize(to_m);
  go(m_per_m() * (to_m - kBehind * radius_m(particle) * along), high_m(), kWayMPerS);
  go(at_m(), low_m(), kWayMPerS);
  std::deque<double> felt_n;
  for (double s = 0.0; s < kPressS; s += kCommandS) {
    const double now_n = felt_n.size() < kSeenAfter ? 0.0 : felt_n.front();
    const double off = std::clamp((force_n - now_n) / force_n, -1.0, 1.0);
    step(at_m() + kCommandS * kPressMPerS * off * along, low_m());
    felt_n.push_back(lateral_n());
    if (felt_n.size() > kSeenAfter) felt_n.pop_front();
  }
  lift();
}

// The one of sixteen directions with the most room for the particle; among equals, the one that stays nearest to the
// middle.
glm::dvec2 PushingHand::free_direction(std::size_t particle, double way_m) const {
  const double r_m = radius_m(particle);
  const glm::dvec2 from_m = place(particle);
  glm::dvec2 best(1.0, 0.0);
  double most = -HUGE_VAL;
  for (int i = 0; i < 16; ++i) {
    const double angle = std::numbers::pi * i / 8.0;
    const glm::dvec2 along(std::cos(angle), std::sin(angle)), to_m = from_m + way_m * along;
    double room_m = 4.0 * r_m;
    for (std::size_t other = 0; other < set().particles.size(); ++other) {
      if (other == particle) continue;
      room_m = std::min(room_m, distance_to_segment(place(other), from_m - kBehind * r_m * along, to_m));
    }
    const double value = room_m - 0.1 * glm::length(to_m);
    if (value > most) {
      most = value;
      best = along;
    }
  }
  return best;
}

glm::dvec2 PushingHand::place(std::size_t particle) const {
  const auto pose = pose_of({.set = &set(), .pages = pages()}, particle);
  return {pose->x_m, pose->y_m};
}

double PushingHand::radius_m(std::size_t particle) const {
  return set().setup.species[set().particles[particle].species].contact.tip_radius.si;
}

}  // namespace

std::unique_ptr<SimulatedHand> make_pushing_hand(const scene::ParticleSet& set, std::unique_ptr<SimulatedServo>&& servo,
                                                 std::uint64_t seed) {
  return std::make_unique<PushingHand>(set, std::move(servo), seed);
}

}  // namespace afm::exhibit
