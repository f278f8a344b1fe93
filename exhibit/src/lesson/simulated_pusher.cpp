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

#include "curves/sample_model.h"
#include "exhibit/lesson/hand_force.h"
#include "exhibit/lesson/lesson_run.h"
#include "exhibit/state/particles_now.h"
#include "haptics/servo_loop.h"
#include "haptics/simulated_device.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/normal_generator.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/pattern_state.h"
#include "scene/shared/shared_segment.h"

namespace afm::exhibit {

namespace {

constexpr int kCommandTicks = 20;     // a command of the hand
constexpr double kServoTickS = 1e-3;  // period of the servo
constexpr double kCommandS = kServoTickS * kCommandTicks;
constexpr int kFrameTicks = 16;
constexpr double kDelayS = 0.25;       // delay of the eye
constexpr double kTremorM = 0.3e-3;    // tremor of the hand, root mean square, each way along the sample
constexpr double kHeldTremor = 0.5;    // share of the tremor that is left after a step
constexpr double kSteerPerS = 2.0;     // share of the seen error that the hand corrects
constexpr double kPushMPerS = 6e-3;    // speed of the hand
constexpr double kWayMPerS = 60e-3;    // the same above the particles
constexpr double kArmHeightM = 0.062;  // high enough to turn the force on
constexpr double kWarmest = 0.6;       // motor heat at which the student lets the device cool before the next push
constexpr double kMostS = 600.0;
constexpr int kMostPushSteps = 2000;
// in radii of the particle
constexpr double kLow = 0.32, kHigh = 3.2;  // heights of the tip while it pushes, and between pushes
constexpr double kBehind = 2.0;             // from the middle of the particle to the tip that comes down behind it
constexpr double kNear = 0.4;               // distance from a target that the student is content with
constexpr double kAside = 0.3;              // offset that loses a particle
constexpr double kLostWay = 8.0;

// The servo's constant part: one sample, face up, and the particles.
std::unique_ptr<scene::SharedModel> servo_model(const curves::SampleModel& sample, const scene::ParticleSet& set) {
  auto model = std::make_unique<scene::SharedModel>();
  model->node_count = 2;
  model->nodes[0].name = scene::to_name("stage");
  model->nodes[0].parent_from_node = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  model->nodes[1].name = scene::to_name("sample");
  model->nodes[1].parent = 0;
  // columns: the sample's x, y, z and origin in the room; z is up
  model->nodes[1].parent_from_node = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};
  model->sample_node = 1;
  model->material_count = 1;
  model->materials[0] = sample.parameters;
  model->particles = scene::shared_particles(set);
  return model;
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a;
  const double share = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::distance(p, a + share * along);
}

class PushingHand final : public SimulatedPusher {
 public:
  PushingHand(const scene::ParticleSet& set, scene::SharedSegment segment, std::uint64_t seed);

  core::Result<void> begin();
  core::Result<void> push(LessonRun& run, double& now_s) override;

 private:
  void make_ready();  // with all particles at their start, and the force on
  void attempt(const PushPlan& plan);
  void bring(std::size_t particle, const glm::dvec2& to_m);
  void steer(std::size_t particle, const glm::dvec2& to_m);
  void slip_past(std::size_t particle);
  glm::dvec2 free_direction(std::size_t particle, double way_m) const;
  glm::dvec2 place(std::size_t particle) const;
  double radius_m(std::size_t particle) const;

  void arm();
  void select(bool release);
  void rest(double seconds);
  void go(const glm::dvec2& to_m, double height_m, double m_per_s);  // in metres of the hand
  void step(const glm::dvec2& to_m, double height_m);
  void aim(const glm::dvec2& place_m, double height_m, double seconds, bool pressed = false);
  void tick(int count);
  bool goes_on() const;

  const scene::ParticleSet& set_;
  std::vector<glm::dvec2> targets_m_;
  scene::SharedSegment segment_;
  scene::RendererSide renderer_;
  haptics::SimulatedDevice device_;
  std::unique_ptr<haptics::ServoLoop> loop_;
  std::vector<scene::ParticlePage> pages_;  // newest
  physics::NormalGenerator normal_;
  double m_per_m_ = 0, low_m_ = 0, high_m_ = 0;  // scale and heights of the hand
  std::int64_t now_ns_ = 1'000'000'000;
  int ticks_ = 0;
  std::uint32_t selection_ = 0, script_ = 0, put_back_ = 0;
  std::uint64_t frame_ = 0;
  glm::dvec2 at_m_{0.0}, tremor_m_{0.0};  // intended place, and the error of the tremor
  double height_m_ = 0;
  LessonRun* run_ = nullptr;  // only during push()
  std::size_t task_ = 0;
  double now_s_ = 0;
  std::optional<glm::dvec2> end_m_;  // place to which the particle of this step is to go
};

PushingHand::PushingHand(const scene::ParticleSet& set, scene::SharedSegment segment, std::uint64_t seed)
    : set_(set),
      segment_(std::move(segment)),
      renderer_(segment_.renderer_side()),
      pages_(scene::pages_of(static_cast<std::uint32_t>(set.particles.size()))),
      normal_(seed) {
  for (const physics::ParticlePlace& target : scene::shared_targets(set)) {
    targets_m_.emplace_back(target.position.x.si, target.position.y.si);
  }
}

core::Result<void> PushingHand::begin() {
  auto loop = haptics::ServoLoop::create(segment_, device_, {.rate_hz = 1.0 / kServoTickS});
  if (!loop) return tl::unexpected(loop.error());
  loop_ = std::move(*loop);
  select(false);
  tick(100);
  const auto state = renderer_.tip_state();
  if (!state) return core::failure(core::ErrorCategory::Failed, "the simulated servo does not run");
  m_per_m_ = state->active.scale.hand_m_per_m;
  const double radius_m = scene::median_radius(set_).si;
  low_m_ = m_per_m_ * kLow * radius_m;
  high_m_ = m_per_m_ * std::max(kHigh * radius_m, 1.1 * physics::clear_height(set_.setup).si);
  return {};
}

core::Result<void> PushingHand::push(LessonRun& run, double& now_s) {
  run_ = &run;
  now_s_ = now_s;
  const LessonPrompt prompt = run.prompt(now_s_);
  task_ = prompt.task;
  end_m_.reset();
  run.look(pages_, now_s_);
  const double latest_s = now_s_ + kMostS;
  bool ready = false;
  while (goes_on() && now_s_ < latest_s) {
    if (!ready || run.prompt(now_s_).put_back) make_ready();
    ready = true;
    if (renderer_.tip_state()->safety.motor_heat > kWarmest) {
      rest(1.0);
    } else {
      attempt(prompt.push);
    }
  }
  const bool done = !goes_on();
  run_ = nullptr;
  now_s = now_s_;
  if (done) return {};
  return core::failure(core::ErrorCategory::Failed,
                       "the simulated participant does not manage a push of this lesson within ten minutes");
}

bool PushingHand::goes_on() const {
  const LessonPrompt prompt = run_->prompt(now_s_);
  return prompt.wants == LessonPrompt::Wants::Push && prompt.task == task_;
}

void PushingHand::make_ready() {
  if (run_->prompt(now_s_).put_back) {
    select(true);
    tick(1000);
    ++put_back_;
    tick(200);
  }
  arm();
  go({0.0, 0.0}, high_m_, kWayMPerS);
}

void PushingHand::attempt(const PushPlan& plan) {
  switch (plan.until) {
    case PushUntil::Pattern: {
      const auto pattern =
          scene::pattern_state(set_, scene::shared_pattern_of(set_), *places_of({.set = &set_, .pages = pages_}));
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
  go(m_per_m_ * (from_m - behind_m * along), high_m_, kWayMPerS);
  go(at_m_, low_m_, kWayMPerS);
  std::deque<glm::dvec2> seen{place(particle)};
  const auto delay = static_cast<std::size_t>(std::lround(kDelayS / kCommandS));
  for (int i = 0; i < kMostPushSteps; ++i) {
    const glm::dvec2 there_m = seen.front();
    if (glm::dot(to_m - there_m, along) < kPushMPerS / m_per_m_ * kDelayS) break;
    const glm::dvec2 left = glm::normalize(to_m - there_m), aside(-left.y, left.x);
    const glm::dvec2 tip_m = at_m_ - m_per_m_ * there_m;
    const double off_m = glm::dot(tip_m, aside);
    if (std::abs(off_m) > m_per_m_ * behind_m * 0.7 || glm::dot(tip_m, left) > 0.0) break;  // lost
    step(at_m_ + kCommandS * (kPushMPerS * left - kSteerPerS * off_m * aside), low_m_);
    seen.push_back(place(particle));
    if (seen.size() > delay) seen.pop_front();
  }
  go(at_m_, high_m_, kWayMPerS);
}

// Pushes off centre, without steering.
void PushingHand::slip_past(std::size_t particle) {
  const double r_m = radius_m(particle);
  const glm::dvec2 from_m = place(particle), along = free_direction(particle, kLostWay * r_m);
  const glm::dvec2 across(-along.y, along.x);
  go(m_per_m_ * (from_m + r_m * (kAside * across - kBehind * along)), high_m_, kWayMPerS);
  go(at_m_, low_m_, kWayMPerS);
  const auto steps = static_cast<int>(kLostWay * r_m * m_per_m_ / (kPushMPerS * kCommandS));
  for (int i = 0; i < steps && goes_on(); ++i) step(at_m_ + kCommandS * kPushMPerS * along, low_m_);
  go(at_m_, high_m_, kWayMPerS);
}

// The direction, of sixteen, with the most room for the particle; among equals, the one that stays nearest to the
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
    for (std::size_t other = 0; other < set_.particles.size(); ++other) {
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
  const auto pose = pose_of({.set = &set_, .pages = pages_}, particle);
  return {pose->x_m, pose->y_m};
}

double PushingHand::radius_m(std::size_t particle) const {
  return set_.setup.species[set_.particles[particle].species].contact.tip_radius.si;
}

void PushingHand::arm() {
  aim({0.0, 0.0}, kArmHeightM, 0.3);
  tick(900);
  aim({0.0, 0.0}, kArmHeightM, 0.0, true);
  tick(100);
  aim({0.0, 0.0}, kArmHeightM, 0.0);
  tick(600);
  at_m_ = {0.0, 0.0};
  height_m_ = kArmHeightM;
}

void PushingHand::select(bool release) {
  renderer_.store(scene::Selection{.material = 0,
                                   .revision = ++selection_,
                                   .scale_mode = scene::ScaleMode::Particles,
                                   .release = release ? 1U : 0U});
}

void PushingHand::rest(double seconds) {
  for (double s = 0.0; s < seconds; s += kCommandS) step(at_m_, height_m_);
}

void PushingHand::go(const glm::dvec2& to_m, double height_m, double m_per_s) {
  const glm::dvec2 from_m = at_m_;
  const double from_height_m = height_m_;
  const double way_m = std::hypot(glm::distance(from_m, to_m), height_m - from_height_m);
  const int steps = std::max(1, static_cast<int>(std::ceil(way_m / m_per_s / kCommandS)));
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    step(from_m + share * (to_m - from_m), from_height_m + share * (height_m - from_height_m));
  }
}

void PushingHand::step(const glm::dvec2& to_m, double height_m) {
  at_m_ = to_m;
  height_m_ = height_m;
  const double fresh_m = kTremorM * std::sqrt(1.0 - kHeldTremor * kHeldTremor);
  const double x = normal_(), y = normal_();
  tremor_m_ = kHeldTremor * tremor_m_ + fresh_m * glm::dvec2(x, y);
  aim(at_m_ + tremor_m_, height_m_, kCommandS);
  tick(kCommandTicks);
}

void PushingHand::aim(const glm::dvec2& place_m, double height_m, double seconds, bool pressed) {
  renderer_.store(scene::HandScript{.target_m = {place_m.x, height_m, -place_m.y},
                                    .duration_s = seconds,
                                    .revision = ++script_,
                                    .turn_on_pressed = pressed ? 1U : 0U});
}

// The lesson hears every tick, and sees the particles at the end.
void PushingHand::tick(int count) {
  for (int i = 0; i < count; ++i, ++ticks_) {
    if (ticks_ % kFrameTicks == 0) renderer_.store(scene::RendererHeartbeat{.frame = ++frame_, .put_back = put_back_});
    now_ns_ += static_cast<std::int64_t>(1e9 * kServoTickS);
    now_s_ += kServoTickS;
    loop_->tick(now_ns_, 0);
    while (const auto event = renderer_.pop_event()) {
      if (run_ != nullptr) run_->add(*event);
    }
    while (const auto sample = renderer_.pop_sample()) {
      if (run_ == nullptr) continue;
      run_->force_is(hand_force(sample->servo_state, renderer_.tip_state()->safety.thermal_gain), now_s_);
      run_->add(*sample, now_s_);
    }
  }
  for (std::uint32_t page = 0; page < pages_.size(); ++page) {
    if (const auto newer = renderer_.new_particle_page(page)) pages_[page] = *newer;
  }
  if (run_ != nullptr) run_->look(pages_, now_s_);
}

}  // namespace

core::Result<std::unique_ptr<SimulatedPusher>> SimulatedPusher::create(const curves::SampleModel& sample,
                                                                       const scene::ParticleSet& set,
                                                                       std::uint64_t seed) {
  auto segment = scene::SharedSegment::create(*servo_model(sample, set), 0);
  if (!segment) return tl::unexpected(segment.error());
  auto pusher = std::make_unique<PushingHand>(set, std::move(*segment), seed);
  if (auto begun = pusher->begin(); !begun) return tl::unexpected(begun.error());
  return std::unique_ptr<SimulatedPusher>(std::move(pusher));
}

}  // namespace afm::exhibit
