// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/geometric.hpp>

#include "haptics/felt_marks.h"
#include "haptics/felt_particles.h"
#include "haptics/servo_loop.h"

namespace afm::haptics {

namespace {

std::array<double, 3> array_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

scene::Tip tip_of(const Touch& touch) {
  return {.z_m = touch.z_m,
          .force_n = touch.response.force.si,
          .height_m = touch.response.tip_height.si,
          .deflection_m = touch.response.cantilever_deflection.si,
          .sample_deformation_m = touch.response.sample_deformation.si};
}

// Force of the groove after the tick; zero once the force has been dropped.
std::array<double, 2> guide_n(FeltParticles* particles) {
  if (particles == nullptr) return {};
  const glm::dvec2& force_n = particles->groove().force_n();
  return {force_n.x, force_n.y};
}

}  // namespace

void ServoLoop::publish_events(std::int64_t now_ns) noexcept {
  const physics::TipResponse& response = touch_.response;
  for (std::uint32_t i = 0; i < response.event_count; ++i) {
    const physics::ModelEvent& event = response.events[i];
    const double since_previous_ns = event.fraction * static_cast<double>(now_ns - previous_ns_);
    shared_.push(scene::TipEvent{.kind = event.kind,
                                 .material = state_.material,
                                 .time_ns = previous_ns_ + std::llround(since_previous_ns),
                                 .z_m = event.z.si,
                                 .force_before_n = event.force_before.si,
                                 .force_after_n = event.force_after.si});
  }
  for (const physics::LatticeSlip& slip : touch_.friction.events.slipped()) {
    shared_.push(scene::TipEvent{
        .kind = physics::EventKind::Slip,
        .material = state_.material,
        .time_ns = previous_ns_ + std::llround(slip.fraction * static_cast<double>(now_ns - previous_ns_)),
        .z_m = touch_.z_m,
        .force_before_n = physics::magnitude(slip.force_before).si,
        .force_after_n = physics::magnitude(slip.force_after).si});
  }
  for (const ParticlePush::Event& event : touch_.push.happened()) {
    shared_.push(scene::TipEvent{.kind = event.kind,
                                 .material = state_.material,
                                 .time_ns = now_ns,
                                 .z_m = touch_.z_m,
                                 .force_before_n = event.force_before_n,
                                 .force_after_n = event.force_after_n});
  }
}

void ServoLoop::publish(std::int64_t now_ns, std::uint32_t wake_us) noexcept {
  ++state_.tick;
  state_.time_ns = now_ns;
  state_.tip = tip_of(touch_);
  state_.swing = touch_.swing;
  state_.surface = {.xy_m = {touch_.tip_xy_m.x, touch_.tip_xy_m.y}, .height_m = touch_.surface_height_m};
  state_.here = touch_.map.here;
  state_.normal = array_of(sample_.in_device(touch_.normal));
  state_.hand.position_m = array_of(hand_.position_m);
  state_.safety = {.force_cap_n = governor_.force_cap_n(),
                   .slew_limit_n_per_s = governor_.slew_limit_n_per_s(),
                   .motor_heat = governor_.motors().heat(),
                   .thermal_gain = governor_.motors().gain(),
                   .excess_energy_j = governor_.observer().excess_j(),
                   .observer_damping_n_s_per_m = governor_.observer_damping_n_s_per_m()};
  state_.phase = touch_.response.phase;
  state_.servo_state = governor_.state();
  state_.fault = governor_.fault();
  state_.dead_man = governor_.dead_man() ? 1 : 0;
  state_.led = guide_.leads() ? 1 : 0;
  state_.lead_lost = guide_.lost() ? 1 : 0;
  state_.level = model_ != nullptr && model_->is_level() ? 1 : 0;
  state_.acknowledged.refused_edit = edits_.refused();
  state_.garbage_blocks = shared_.refused_blocks() + refused_transforms_;
  shared_.store(state_);
  if (particles() != nullptr) publish_particles();
  if (marks_) publish_marks();

  // without a material there is no curve to draw
  if (model_ == nullptr) return;
  const glm::dvec3& normal = sample_.normal();
  const auto& [x, y, z] = state_.hand.force_n;
  shared_.push(scene::TipSample{.time_ns = now_ns,
                                .tick = state_.tick,
                                .tip = state_.tip,
                                .hand_height_m = glm::dot(hand_.from_contact_m, normal),
                                .hand_force_n = glm::dot(glm::dvec3(x, y, z), normal),
                                .servo_state = state_.servo_state,
                                .phase = state_.phase,
                                .material = state_.material,
                                .wake_us = wake_us,
                                .edit_revision = state_.active.edit_revision,
                                .turn_on = hand_.turn_on ? 1U : 0U,
                                .renderer = renderer_,
                                .scale_mode = state_.active.scale_mode,
                                .hand_from_contact_m = array_of(hand_.from_contact_m),
                                .sample_normal = array_of(normal),
                                .sample_x = array_of(sample_.x()),
                                .surface = state_.surface,
                                .motor_heat = state_.safety.motor_heat,
                                .device_healthy = hand_.healthy ? 1U : 0U,
                                .changing = changing_ ? 1U : 0U,
                                .lateral_force_n = {touch_.friction.lateral.x.si, touch_.friction.lateral.y.si},
                                .scan = scan_,
                                .push = push_sample(),
                                .swing = state_.swing,
                                .plan = particles() != nullptr ? particles()->groove().plan() : scene::PlannedPush{},
                                .guide_n = guide_n(particles()),
                                .level = particles() != nullptr ? particles()->level() : scene::LevelSample{},
                                .settings = swap_->settings()});
}

// Restores marks, only without force, as for particles.
void ServoLoop::put_marks() noexcept {
  if (!marks_ || model_ == nullptr || !governor_.released()) return;
  if (heard_.put_back && marks_->put_back()) {
    touch_.push.add({.kind = physics::EventKind::ParticlesPutBack});
  } else if (heard_.take_back && marks_->take_back()) {
    touch_.push.add({.kind = physics::EventKind::PushTakenBack});
  }
}

scene::PushSample ServoLoop::push_sample() const noexcept {
  if (marks_) return marks_->sample();
  return particles() != nullptr ? particles()->sample() : scene::PushSample{};
}

// Publishes one tile in each tick: a copy takes a microsecond.
void ServoLoop::publish_marks() noexcept {
  if (const auto tile = marks_->next_tile()) shared_.store(marks_->tiles()[*tile], *tile);
  scene::TipPush push = marks_->push();
  push.time_ns = state_.time_ns;
  push.tick = state_.tick;
  shared_.store(push);
}

// Publishes only the pages that changed.
void ServoLoop::publish_particles() noexcept {
  scene::TipPush push = particles()->push();
  push.settings = swap_->settings();
  push.time_ns = state_.time_ns;
  push.tick = state_.tick;
  shared_.store(push);
  for (const std::uint32_t page : particles()->changed_pages()) shared_.store(particles()->pages()[page], page);
  particles()->published();
}

}  // namespace afm::haptics
