// SPDX-License-Identifier: Apache-2.0
#include "haptics/contact/sweeping_scan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "physics/manipulation/particle_picture.h"
#include "physics/manipulation/push_figures.h"

namespace afm::haptics {

namespace {

using physics::Length;

constexpr double kNPerPn = 1e-12;
constexpr double kLines = static_cast<double>(physics::kLookLines);

physics::Sideways<Length> sideways(const glm::dvec2& place_m) { return {Length(place_m.x), Length(place_m.y)}; }

}  // namespace

SweepingScan::SweepingScan(const scene::SharedParticles& particles)
    : setup_(scene::push_setup(particles)),
      particles_(setup_, scene::start_places(particles), {sideways(glm::dvec2(0.0)), physics::clear_height(setup_)}),
      clear_(physics::clear_height(setup_)) {
  climbs_n_.reserve(particles.count);
  reach_m_.reserve(particles.count);
  climbed_.reserve(particles.count);
  for (std::uint32_t i = 0; i < particles.count; ++i) {
    const scene::SharedParticle& particle = particles.particles[i];
    const physics::ParticleSpecies& species = setup_.species[particle.species];
    const double gentle_n = physics::climbing_load(species, setup_.tip, setup_.tip_friction).si;
    climbs_n_.push_back(particle.pinned != 0 ? std::numeric_limits<double>::infinity() : gentle_n);
    reach_m_.push_back(physics::footprint_radius(setup_.tip, species.contact.tip_radius).si);
  }
}

bool SweepingScan::sweeps(double load_n) const noexcept {
  return std::any_of(climbs_n_.begin(), climbs_n_.end(), [&](double climbs_n) { return load_n > climbs_n; });
}

bool SweepingScan::goes_on(const scene::ScanLead& look) const noexcept {
  return begun_ && look.apex_xy_m == look_.apex_xy_m && look.height_m == look_.height_m &&
         look.load_pn == look_.load_pn;
}

void SweepingScan::begin(const scene::ScanLead& look, std::span<const scene::ParticlePage> pages) noexcept {
  look_ = look;
  time_s_ = 0.0;
  begun_ = true;
  climbed_.clear();
  for (std::uint32_t i = 0; i < particles_.size(); ++i) {
    if (!(kNPerPn * look.load_pn > climbs_n_[i])) climbed_.push_back(i);
    const scene::ParticlePose& pose = pages[scene::page_of(i)].poses[i % scene::kPosesPerPage];
    const physics::ParticlePlace there{sideways({pose.x_m, pose.y_m}), scene::turn_of(pose)};
    if (there != physics::ParticlePlace{particles_.position(i), particles_.turn(i)}) particles_.put(i, there);
  }
  lift({look.apex_xy_m[0], look.apex_xy_m[1]});
}

bool SweepingScan::covers(std::size_t particle, const glm::dvec2& place_m) const noexcept {
  const auto nearest = particles_.nearest(particle, sideways(place_m));
  return glm::distance(glm::dvec2(nearest.x.si, nearest.y.si), place_m) < reach_m_[particle];
}

// True if the tip cannot come down here: it would be on a particle.
bool SweepingScan::is_over(const glm::dvec2& place_m) const noexcept {
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    if (covers(i, place_m)) return true;
  }
  return false;
}

void SweepingScan::lift(const glm::dvec2& place_m) noexcept {
  particles_.hold_over({sideways(place_m), clear_});
  down_ = false;
}

const physics::PushTick& SweepingScan::step(const glm::dvec2& drift_m, double elapsed_s) noexcept {
  time_s_ += elapsed_s;
  const double lines = time_s_ / kLineS, line = std::floor(lines), along = (lines - line) / kTraceShare;
  const glm::dvec2 middle_m(look_.apex_xy_m[0], look_.apex_xy_m[1]);
  const glm::dvec2 share(2.0 * std::min(along, 1.0) - 1.0, 2.0 * line / (kLines - 1.0) - 1.0);
  const glm::dvec2 at_m = middle_m + look_.height_m * share - drift_m;
  const bool on_line = along < 1.0 && line < kLines;
  const bool climbs = std::any_of(climbed_.begin(), climbed_.end(), [&](std::uint32_t i) { return covers(i, at_m); });
  if (!on_line || climbs || (!down_ && is_over(at_m))) {
    if (down_) lift(at_m);
    return particles_.last();
  }
  if (!down_) lift(at_m);
  down_ = true;
  const Length pressed = -physics::Force(kNPerPn * look_.load_pn) / setup_.springs.normal;
  return particles_.move_to({sideways(at_m), pressed}, physics::Time(elapsed_s));
}

}  // namespace afm::haptics
