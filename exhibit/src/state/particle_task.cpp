// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/particle_task.h"

#include "exhibit/state/particles_now.h"
#include "servo/live_picture.h"
#include "servo/replay.h"

namespace afm::exhibit {

ParticleTask::ParticleTask(const scene::ParticleSet& set) : set_(set), task_(set, scene::shared_pattern_of(set)) {}

void ParticleTask::add(const scene::TipSample& sample, bool truth) {
  const auto& [x_m, y_m] = sample.surface.xy_m;
  task_.add(scene::TaskTick{.time_ns = sample.time_ns,
                            .base_m = {x_m, y_m, sample.tip.z_m},
                            .lateral_n = sample.push.lateral_n,
                            .lift_n = sample.push.lift_n,
                            .places = sample.push.digest,
                            .particle = sample.push.particle,
                            .guided = sample.plan.guided != 0,
                            .carries = sample.push.state == physics::PushState::Carried,
                            .swept = sample.scan.hand == scene::ScanHand::Looks,
                            .truth = truth && !set_.blind});
}

std::optional<std::vector<physics::ParticlePlace>> ParticleTask::unjudged(
    std::span<const scene::ParticlePage> pages) const {
  const auto rest = task_.unjudged();
  if (!rest || pages.size() < scene::pages_of(static_cast<std::uint32_t>(set_.particles.size()))) return std::nullopt;
  if (scene::digest_of(pages, set_.particles.size()) != *rest) return std::nullopt;
  return places_of({.set = &set_, .pages = pages});
}

bool ParticleTask::far_enough(std::span<const scene::ParticlePage> pages) const {
  const auto places = set_.blind ? places_of({.set = &set_, .pages = pages}) : std::nullopt;
  const auto way = places ? task_.way(*places) : std::nullopt;
  return way && way->far_enough();
}

bool ParticleTask::look(std::span<const scene::ParticlePage> pages, const servo::LivePicture* picture) {
  auto places = unjudged(pages);
  if (!places || (picture != nullptr && !picture->now().all_measured)) return false;
  if (picture != nullptr) places = places_of({.set = &set_, .pages = picture->shown()});
  task_.judge(*places);
  return task_.score().state == scene::TaskState::Done;
}

void ParticleTask::hear(const servo::ReplayedTick& tick) {
  for (const scene::TipEvent& event : tick.events) add(event);
  add(tick.sample, tick.picture == nullptr);
  look(tick.pages, tick.picture);
}

}  // namespace afm::exhibit
