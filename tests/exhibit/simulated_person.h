// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <span>

#include "exhibit/state/particles_now.h"
#include "physics/manipulation/pushed_particles.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/pattern_state.h"
#include "servo/live_picture.h"
#include "servo/recorded_servo.h"
#include "support/paper_model.h"

// A person who pushes the particles of a set through the servo's own code, with the delay of the eye and a tremor.
namespace afm::exhibit {
namespace particle_task_test {

constexpr int kStepTicks = 20;  // ticks per command of the hand
constexpr double kStepS = 1e-3 * kStepTicks;
constexpr double kDelayS = 0.25;     // delay of the eye
constexpr double kTremorM = 0.3e-3;  // tremor of the hand along each axis of the sample, root mean square
constexpr double kHeldTremor = 0.5;  // fraction of the tremor that is left after a step
constexpr double kSteerPerS = 2.0;   // fraction of the seen error that the hand corrects per second
constexpr double kPushMPerS = 6e-3;  // speed of the hand
constexpr double kWayMPerS = 60e-3;
constexpr double kLowM = 1.6e-3;  // height of the hand while it pushes
constexpr double kHighM = 16e-3;
constexpr double kBehindM = 50e-9;  // distance from the middle of the particle to the tip that comes down behind it
// values for a rod
constexpr double kRodPlace = 0.35;      // distance of a push from the middle, in lengths
constexpr double kRodHeight = 0.3;      // height of the tip, in radii
constexpr double kBesideRodM = 100e-9;  // distance from its axis to the tip that comes down beside it
constexpr double kNearRodM = 30e-9;     // distance of its ends from the line that satisfies the person
constexpr double kNearM = 10e-9;        // distance from a target that satisfies the person

inline std::unique_ptr<scene::SharedModel> model_with(const scene::ParticleSet& set, std::uint32_t level) {
  auto model = std::make_unique<scene::SharedModel>(test::paper_model());
  model->particles = scene::shared_particles(set);
  model->particles.level.level = level;
  return model;
}

class Person {
 public:
  explicit Person(const scene::ParticleSet& set, unsigned seed, std::uint32_t level = 0)
      : set_(set), pattern_(scene::shared_pattern_of(set)), random_(seed), recording_(*model_with(set, level)) {
    recording_.choose(test::kMica, scene::ScaleMode::Particles);
    recording_.arm();
    m_per_m_ = recording_.state().active.scale.hand_m_per_m;
    go({0.0, 0.0}, kHighM, 0.5);
  }

  // Pushes the particle farthest from its target until all are near, for at most `most_s`.
  void solve(double most_s) {
    for (const double end_s = time_s() + most_s; time_s() < end_s;) {
      rest(0.5);
      const auto pattern = scene::pattern_state(set_, pattern_, *places_of({.set = &set_, .pages = seen()}));
      std::size_t worst = 0;
      const auto off = [&](std::size_t i) { return glm::distance(target(i), place(pattern->match.particles[i])); };
      for (std::size_t i = 1; i < pattern_.targets.size(); ++i) worst = off(i) > off(worst) ? i : worst;
      if (off(worst) < kNearM) break;
      if (looks) look_at(pattern->match.particles[worst]);
      push(pattern->match.particles[worst], target(worst));
    }
    rest(1.0);
  }

  // Takes a second look at every particle that is not measured.
  void look() {
    for (std::size_t i = 0; i < set_.particles.size(); ++i) {
      if (recording_.picture->now().known[i] == servo::Known::Measured) continue;
      look_at(i);
    }
  }

  // Waits without looking, while the sample drifts.
  void wait(double seconds) { recording_.run(static_cast<int>(1e3 * seconds)); }

  // Pushes the ends of the rod in turn, by sight, until both are near the line of the target.
  void lay_rod(double most_s) {
    for (const double end_s = time_s() + most_s; time_s() < end_s;) {
      rest(0.5);
      const Rod seen = rod();
      const double end = std::abs(off_m(seen, 1.0)) > std::abs(off_m(seen, -1.0)) ? 1.0 : -1.0;
      if (std::abs(off_m(seen, end)) < kNearRodM) break;
      push_end(end);
    }
    rest(1.0);
  }

  // Comes down beside the particle and pushes it until it yields, without looking.
  void push_by_feel(std::size_t particle, const glm::dvec2& along, double m_per_s) {
    beside(particle, along);
    double most_n = 0.0;
    for (int i = 0; i < 2000; ++i) {
      step(at_m_ + kStepS * m_per_s * along, kLowM);
      most_n = std::max(most_n, force_n());
      if (recording_.sessions.front().samples.back().push.state == physics::PushState::Slides) break;
    }
    felt_n_ = most_n;
    go(at_m_, kHighM, kWayMPerS);
    rest(1.0);
  }

  // Presses the particle from the middle of the sample with `share` of the felt force, or of 1 nN.
  void press(std::size_t particle, double share, double seconds) {
    const glm::dvec2 along = glm::normalize(place(particle));
    beside(particle, along);
    const double wanted_n = share * (felt_n_ > 0.0 ? felt_n_ : 1e-9);
    for (int i = 0; i < 2000 && force_n() < wanted_n; ++i) step(at_m_ + kStepS * 0.002 * along, kLowM);
    const auto first = static_cast<std::ptrdiff_t>(recording_.sessions.front().samples.size());
    rest(seconds);
    const auto& samples = recording_.sessions.front().samples;
    double sum_n = 0.0;
    for (auto sample = samples.begin() + first; sample != samples.end(); ++sample) {
      sum_n += std::hypot(sample->push.lateral_n[0], sample->push.lateral_n[1]);
    }
    held_n_ = sum_n / static_cast<double>(samples.end() - samples.begin() - first);
    go(at_m_, kHighM, kWayMPerS);
    rest(1.0);
  }
  double held_n() const { return held_n_; }  // mean held force

  // Pushes the first particle `share` of the way to the target, with steering.
  void push_along_line(double share) {
    const scene::Pattern pattern = scene::shared_pattern_of(set_);
    const glm::dvec2 from_m = place(0);
    push(0, from_m + share * (target(0) + glm::dvec2(12e-9, 0.0) - from_m));
    rest(1.0);
  }

  bool looks = false;  // true: a second look before each push

  double time_s() const { return 1e-9 * static_cast<double>(recording_.now_ns); }
  servo::Recording& recording() { return recording_; }

 private:
  struct Rod {
    glm::dvec2 middle_m, along;
  };
  Rod rod() const {
    const physics::ParticlePlace place = places_of({.set = &set_, .pages = seen()})->front();
    const double angle = physics::angle_rad(place.turn);
    return {{place.position.x.si, place.position.y.si}, {std::cos(angle), std::sin(angle)}};
  }
  double length_m() const { return set_.setup.species.front().length.si; }

  // Distance of an end, 1 or -1, from the line of the target; positive on its left.
  double off_m(const Rod& rod, double end) const {
    const double angle = physics::angle_rad(pattern_.targets.front().turn);
    const glm::dvec2 left(-std::sin(angle), std::cos(angle));
    return glm::dot(rod.middle_m + 0.5 * end * length_m() * rod.along - target(0), left);
  }

  // Pushes once across the rod, until the end has been seen near the line; the tip keeps its place along the rod.
  void push_end(double end) {
    const double side = off_m(rod(), end) > 0.0 ? 1.0 : -1.0, at_m = kRodPlace * end * length_m();
    const auto away = [&](const Rod& rod) { return side * glm::dvec2(-rod.along.y, rod.along.x); };
    const Rod before = rod();
    const double low_m = m_per_m_ * kRodHeight * scene::median_radius(set_).si;
    go(m_per_m_ * (before.middle_m + at_m * before.along + kBesideRodM * away(before)), kHighM, kWayMPerS);
    go(at_m_, low_m, kWayMPerS);
    std::deque<Rod> late{before};
    const auto delay = static_cast<std::size_t>(std::lround(kDelayS / kStepS));
    for (int i = 0; i < 500; ++i) {
      const Rod& there = late.front();
      if (side * off_m(there, end) < kPushMPerS / m_per_m_ * kDelayS) break;
      const double slid_m = glm::dot(at_m_ - m_per_m_ * there.middle_m, there.along) - m_per_m_ * at_m;
      step(at_m_ - kStepS * (kPushMPerS * away(there) + kSteerPerS * slid_m * there.along), low_m);
      late.push_back(rod());
      if (late.size() > delay) late.pop_front();
    }
    go(at_m_, kHighM, kWayMPerS);
  }

  void beside(std::size_t particle, const glm::dvec2& along) {
    go(m_per_m_ * (place(particle) - kBehindM * along), kHighM, kWayMPerS);
    go(at_m_, kLowM, kWayMPerS);
  }
  double force_n() const {
    const scene::TipSample& sample = recording_.sessions.front().samples.back();
    return std::hypot(sample.push.lateral_n[0], sample.push.lateral_n[1]);
  }
  glm::dvec2 target(std::size_t i) const {
    return {pattern_.targets[i].position.x.si, pattern_.targets[i].position.y.si};
  }
  glm::dvec2 place(std::size_t particle) const {
    const auto pose = pose_of({.set = &set_, .pages = seen()}, particle);
    return {pose->x_m, pose->y_m};
  }

  // Particles, or at levels 1 and 2 their picture.
  std::span<const scene::ParticlePage> seen() const {
    return recording_.picture ? recording_.picture->shown() : recording_.pages();
  }

  void look_at(std::size_t particle) {
    go(m_per_m_ * place(particle), kHighM, kWayMPerS);
    ++recording_.looks;
    rest(3.6);
  }

  void push(std::size_t particle, const glm::dvec2& to_m) {
    const glm::dvec2 from_m = place(particle), along = glm::normalize(to_m - from_m);
    go(m_per_m_ * (from_m - kBehindM * along), kHighM, kWayMPerS);
    go(at_m_, kLowM, kWayMPerS);
    std::deque<glm::dvec2> late{place(particle)};
    const auto delay = static_cast<std::size_t>(std::lround(kDelayS / kStepS));
    const glm::dvec2 across(-along.y, along.x);
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec2 there_m = late.front();
      if (glm::dot(to_m - there_m, along) < kPushMPerS / m_per_m_ * kDelayS) break;
      const glm::dvec2 left = glm::normalize(to_m - there_m), aside(-left.y, left.x);
      const double off_m = glm::dot(at_m_ - m_per_m_ * there_m, aside);
      if (std::abs(off_m) > m_per_m_ * kBehindM * 0.7) break;  // lost particle
      step(at_m_ + kStepS * (kPushMPerS * left - kSteerPerS * off_m * aside), kLowM);
      late.push_back(place(particle));
      if (late.size() > delay) late.pop_front();
    }
    go(at_m_, kHighM, kWayMPerS);
  }

  void rest(double seconds) {
    for (double s = 0.0; s < seconds; s += kStepS) step(at_m_, height_m_);
  }

  void go(const glm::dvec2& to_m, double height_m, double m_per_s) {
    const glm::dvec3 from(at_m_, height_m_), to(to_m, height_m);
    const int steps = std::max(1, static_cast<int>(std::ceil(glm::distance(from, to) / m_per_s / kStepS)));
    for (int i = 1; i <= steps; ++i) {
      const glm::dvec3 next = from + (to - from) * (static_cast<double>(i) / steps);
      step(glm::dvec2(next), next.z);
    }
  }

  void step(const glm::dvec2& to_m, double height_m) {
    at_m_ = to_m;
    height_m_ = height_m;
    const double fresh = kTremorM * std::sqrt(1.0 - kHeldTremor * kHeldTremor);
    tremor_m_ = kHeldTremor * tremor_m_ + fresh * glm::dvec2(noise_(random_), noise_(random_));
    recording_.go(at_m_ + tremor_m_, height_m_, kStepS);
    recording_.run(kStepTicks);
  }

  const scene::ParticleSet& set_;
  scene::Pattern pattern_;
  std::mt19937 random_;
  std::normal_distribution<double> noise_;
  servo::Recording recording_;
  double m_per_m_ = 0.0;
  glm::dvec2 at_m_{0.0}, tremor_m_{0.0};  // intended position, and error due to the tremor
  double height_m_ = 0.06;
  double felt_n_ = 0.0, held_n_ = 0.0;
};

}  // namespace particle_task_test
}  // namespace afm::exhibit
