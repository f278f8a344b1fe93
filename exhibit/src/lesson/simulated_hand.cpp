// SPDX-License-Identifier: Apache-2.0
#include "simulated_hand.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "curves/sample_model.h"
#include "exhibit/lesson/hand_force.h"
#include "exhibit/lesson/lesson_run.h"
#include "haptics/servo_loop.h"
#include "haptics/simulated_device.h"
#include "physics/manipulation/pushed_particles.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/shared_segment.h"
#include "simulated_pusher.h"
#include "simulated_writer.h"

namespace afm::exhibit {

struct SimulatedServo {
  explicit SimulatedServo(scene::SharedSegment shared)
      : segment(std::move(shared)), renderer(segment.renderer_side()) {}

  scene::SharedSegment segment;
  scene::RendererSide renderer;
  haptics::SimulatedDevice device;
  std::unique_ptr<haptics::ServoLoop> loop;
};

namespace {

constexpr int kCommandTicks = 20;     // ticks per command of the hand
constexpr double kServoTickS = 1e-3;  // period of the servo
constexpr int kFrameTicks = 16;
constexpr double kTremorM = 0.3e-3;    // tremor of the hand along each axis of the sample, root mean square
constexpr double kHeldTremor = 0.5;    // fraction of the tremor that is left after a step
constexpr double kArmHeightM = 0.062;  // high enough to turn the force on
constexpr double kWarmest = 0.6;       // motor heat at which the student lets the device cool before the next attempt
constexpr double kMostS = 600.0;
constexpr double kHigh = 3.2;  // height of the tip above the particles, in radii

// Constant part of the servo's model: one sample, face up, and the particles.
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

}  // namespace

core::Result<std::unique_ptr<SimulatedHand>> SimulatedHand::create(const curves::SampleModel& sample,
                                                                   const scene::ParticleSet& set, std::uint64_t seed) {
  auto segment = scene::SharedSegment::create(*servo_model(sample, set), 0);
  if (!segment) return tl::unexpected(segment.error());
  auto servo = std::make_unique<SimulatedServo>(std::move(*segment));
  auto hand = scene::leaves_marks(set) ? make_writing_hand(set, std::move(servo), seed)
                                       : make_pushing_hand(set, std::move(servo), seed);
  if (auto begun = hand->begin(); !begun) return tl::unexpected(begun.error());
  return hand;
}

SimulatedHand::SimulatedHand(const scene::ParticleSet& set, std::unique_ptr<SimulatedServo>&& servo, std::uint64_t seed)
    : set_(set),
      servo_(std::move(servo)),
      pages_(scene::pages_of(static_cast<std::uint32_t>(set.particles.size()))),
      tiles_(scene::leaves_marks(set) ? scene::kMarkTiles : 0),
      normal_(seed) {}

SimulatedHand::~SimulatedHand() = default;

core::Result<void> SimulatedHand::begin() {
  auto loop = haptics::ServoLoop::create(servo_->segment, servo_->device, {.rate_hz = 1.0 / kServoTickS});
  if (!loop) return tl::unexpected(loop.error());
  servo_->loop = std::move(*loop);
  select(false);
  tick(100);
  const auto state = servo_->renderer.tip_state();
  if (!state) return core::failure(core::ErrorCategory::Failed, "the simulated servo does not run");
  m_per_m_ = state->active.scale.hand_m_per_m;
  high_m_ = m_per_m_ * std::max(kHigh * scene::median_radius(set_).si, 1.1 * physics::clear_height(set_.setup).si);
  return {};
}

core::Result<void> SimulatedHand::take_step(LessonRun& run, double& now_s) {
  run_ = &run;
  now_s_ = now_s;
  taken_ = run.prompt(now_s_);
  see();
  const double latest_s = now_s_ + kMostS;
  bool ready = false;
  while (goes_on() && now_s_ < latest_s) {
    if (run.prompt(now_s_).put_back) {
      put_back();
    } else if (!ready) {
      arm();
    }
    ready = true;
    if (servo_->renderer.tip_state()->safety.motor_heat > kWarmest) {
      rest(1.0);
    } else {
      attempt(taken_);
    }
  }
  const bool done = !goes_on();
  const std::string words = run.prompt(now_s_).words;
  run_ = nullptr;
  now_s = now_s_;
  if (done) return {};
  return core::failure(core::ErrorCategory::Failed,
                       "the simulated participant does not manage a step of this lesson within ten minutes: " + words);
}

bool SimulatedHand::goes_on() const {
  const LessonPrompt prompt = run_->prompt(now_s_);
  return prompt.wants == taken_.wants && prompt.task == taken_.task;
}

LessonPrompt SimulatedHand::prompt() const { return run_->prompt(now_s_); }

void SimulatedHand::put_back() {
  select(true);
  tick(1000);
  ++put_back_;
  tick(200);
  arm();
}

// Turns the force on, and moves above the middle.
void SimulatedHand::arm() {
  aim({0.0, 0.0}, kArmHeightM, 0.3);
  tick(900);
  aim({0.0, 0.0}, kArmHeightM, 0.0, true);
  tick(100);
  aim({0.0, 0.0}, kArmHeightM, 0.0);
  tick(600);
  at_m_ = {0.0, 0.0};
  height_m_ = kArmHeightM;
  go(at_m_, high_m_, kWayMPerS);
}

void SimulatedHand::select(bool release) {
  servo_->renderer.store(scene::Selection{.material = 0,
                                          .revision = ++selection_,
                                          .scale_mode = scene::ScaleMode::Particles,
                                          .release = release ? 1U : 0U});
}

void SimulatedHand::rest(double seconds) {
  for (double s = 0.0; s < seconds; s += kCommandS) step(at_m_, height_m_);
}

void SimulatedHand::go(const glm::dvec2& to_m, double height_m, double m_per_s) {
  const glm::dvec2 from_m = at_m_;
  const double from_height_m = height_m_;
  const double way_m = std::hypot(glm::distance(from_m, to_m), height_m - from_height_m);
  const int steps = std::max(1, static_cast<int>(std::ceil(way_m / m_per_s / kCommandS)));
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    step(from_m + share * (to_m - from_m), from_height_m + share * (height_m - from_height_m));
  }
}

void SimulatedHand::step(const glm::dvec2& to_m, double height_m) {
  at_m_ = to_m;
  height_m_ = height_m;
  const double fresh_m = kTremorM * std::sqrt(1.0 - kHeldTremor * kHeldTremor);
  const double x = normal_(), y = normal_();
  tremor_m_ = kHeldTremor * tremor_m_ + fresh_m * glm::dvec2(x, y);
  aim(at_m_ + tremor_m_, height_m_, kCommandS);
  tick(kCommandTicks);
}

void SimulatedHand::aim(const glm::dvec2& place_m, double height_m, double seconds, bool pressed) {
  servo_->renderer.store(scene::HandScript{.target_m = {place_m.x, height_m, -place_m.y},
                                           .duration_s = seconds,
                                           .revision = ++script_,
                                           .turn_on_pressed = pressed ? 1U : 0U});
}

// Runs ticks of the servo; the lesson gets every tick, and particles and marks at the end.
void SimulatedHand::tick(int count) {
  for (int i = 0; i < count; ++i, ++ticks_) {
    if (ticks_ % kFrameTicks == 0)
      servo_->renderer.store(scene::RendererHeartbeat{.frame = ++frame_, .put_back = put_back_});
    now_ns_ += static_cast<std::int64_t>(1e9 * kServoTickS);
    now_s_ += kServoTickS;
    servo_->loop->tick(now_ns_, 0);
    while (const auto event = servo_->renderer.pop_event()) {
      if (run_ != nullptr) run_->add(*event);
    }
    while (const auto sample = servo_->renderer.pop_sample()) {
      if (run_ == nullptr) continue;
      run_->force_is(hand_force(sample->servo_state, servo_->renderer.tip_state()->safety.thermal_gain), now_s_);
      run_->add(*sample, now_s_);
    }
  }
  for (std::uint32_t page = 0; page < pages_.size(); ++page) {
    if (const auto newer = servo_->renderer.new_particle_page(page)) pages_[page] = *newer;
  }
  for (std::uint32_t tile = 0; tile < tiles_.size(); ++tile) {
    if (const auto newer = servo_->renderer.new_mark_tile(tile)) tiles_[tile] = *newer;
  }
  push_ = servo_->renderer.tip_push().value_or(scene::TipPush{});
  if (run_ != nullptr) see();
}

void SimulatedHand::see() {
  if (tiles_.empty()) return run_->look(pages_, now_s_);
  run_->look_at_marks(tiles_, now_s_);
}

}  // namespace afm::exhibit
