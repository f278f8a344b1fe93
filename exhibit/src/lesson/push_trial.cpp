// SPDX-License-Identifier: Apache-2.0
#include "push_trial.h"

#include <memory>
#include <vector>

#include "exhibit/state/particles_now.h"
#include "scene/shared/particle_blocks.h"

namespace afm::exhibit {

namespace {

using physics::Length;
using physics::Sideways;

// Set for the plan: with one target only its particle counts; pinned ones stay out of a pattern.
scene::ParticleSet wanted_set(const scene::ParticleSet& set, const PushPlan& plan) {
  scene::ParticleSet wanted = set;
  wanted.blind = blind_task_of(plan);
  if (plan.until != PushUntil::Target && plan.until != PushUntil::Line) return wanted;
  wanted.targets = {set.targets[plan.target]};
  wanted.pads.clear();
  if (wanted.blind) wanted.blind->target = 0;
  if (plan.until == PushUntil::Line) return wanted;
  for (std::size_t i = 0; i < wanted.particles.size(); ++i) wanted.particles[i].pinned = i != plan.particle;
  return wanted;
}

std::unique_ptr<const scene::SharedParticles> shared_of(const scene::ParticleSet& set) {
  return std::make_unique<const scene::SharedParticles>(scene::shared_particles(set));
}

Sideways<Length> start_of(const scene::ParticleSet& set, std::size_t particle) {
  const auto shared = shared_of(set);
  return {Length(shared->particles.at(particle).x_m), Length(shared->particles.at(particle).y_m)};
}

}  // namespace

std::optional<scene::BlindTask> blind_task_of(const PushPlan& plan) {
  switch (plan.until) {
    case PushUntil::Line:
      return scene::BlindTask{scene::BlindKind::Line, plan.particle, plan.target};
    case PushUntil::Threshold:
      return scene::BlindTask{scene::BlindKind::Threshold, plan.particle, 0};
    case PushUntil::Moved:
    case PushUntil::Target:
    case PushUntil::Pattern:
    case PushUntil::Lost:
      break;
  }
  return std::nullopt;
}

std::uint64_t start_digest(const scene::ParticleSet& set) {
  const auto shared = shared_of(set);
  std::vector<scene::ParticlePage> pages(scene::pages_of(shared->count));
  for (std::uint32_t i = 0; i < shared->count; ++i) {
    scene::ParticlePose& pose = pages[scene::page_of(i)].poses[i % scene::kPosesPerPage];
    pose.x_m = shared->particles[i].x_m;
    pose.y_m = shared->particles[i].y_m;
  }
  return scene::digest_of(pages, shared->count);
}

PushTrial::PushTrial(const scene::ParticleSet& set, const PushPlan& plan)
    : plan_(plan), set_(wanted_set(set, plan)), start_(start_of(set, plan.particle)), task_(set_) {}

void PushTrial::add(const scene::TipEvent& event) {
  task_.add(event);
  if (event.kind != physics::EventKind::ParticleLost || plan_.until != PushUntil::Lost || lost_) return;
  if (touched_ == static_cast<std::int32_t>(plan_.particle)) lost_ = task_.score();
}

void PushTrial::add(const scene::TipSample& sample) {
  if (sample.push.particle != scene::kNoParticle) touched_ = sample.push.particle;
  task_.add(sample);
}

Length PushTrial::way_of(const Sideways<Length>& place) const { return magnitude(place - start_); }

bool PushTrial::look(std::span<const scene::ParticlePage> pages) {
  switch (plan_.until) {
    case PushUntil::Pattern:
    case PushUntil::Target:
      if (!task_.look(pages)) return false;
      result_ = task_.score().rms_m;
      return true;
    case PushUntil::Line:
    case PushUntil::Threshold:
      if (!task_.look(pages)) return false;
      result_ = scene::answered(task_.score()) ? 1.0 + scene::answer_error(task_.score()) : task_.score().rms_m;
      return true;
    case PushUntil::Lost: {
      const auto pose = lost_ ? pose_of({.set = &set_, .pages = pages}, plan_.particle) : std::nullopt;
      if (!pose) return false;
      result_ = way_of({Length(pose->x_m), Length(pose->y_m)}).si;
      return true;
    }
    case PushUntil::Moved:
      break;
  }
  const auto places = task_.unjudged(pages);
  if (!places) return false;
  result_ = way_of((*places)[plan_.particle].position).si;
  if (result_ < plan_.distance_m) return false;
  task_.end(Length(result_ - plan_.distance_m));
  return true;
}

}  // namespace afm::exhibit
