// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scenery/stage_particles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "exhibit/models/marks_relief.h"
#include "exhibit/models/model_builder.h"
#include "exhibit/models/particle_models.h"
#include "exhibit/scenery/lines_on_sample.h"
#include "exhibit/scenery/wall_layout.h"
#include "exhibit/scenery/wall_scene.h"
#include "exhibit/state/lines_to_write.h"
#include "physics/manipulation/tip_contact.h"
#include "scene/samples/particle_set.h"
#include "servo/live_picture.h"

namespace afm::exhibit {

namespace {

using glm::dmat4;
using glm::dvec3;

constexpr double kDrawnReach = 0.52;     // layout units from the middle of the sample to the outermost particle's edge
constexpr double kDrawnDiameter = 0.13;  // largest size of a median particle
constexpr glm::vec3 kTouched{1.35F, 1.3F, 1.1F};

constexpr double kShortestWay = 0.2;  // shortest way with a footprint, in radii
constexpr double kDotSpacing = 0.45;  // distance in radii
constexpr std::uint32_t kMostDots = 64, kMostDotsInAll = 8192;
// Dots along lines to write; distance and size in widths of the groove.
constexpr std::uint32_t kMostLineDots = 1024;
constexpr double kLineDotSpacing = 0.6, kLineDotSize = 1.5;

// Sizes of a plan, in radii: its dots are larger and closer than those of a path, its rings wider than a footprint.
constexpr double kPlanDotSpacing = 0.3, kPlanDotSize = 1.4, kPlanRingSize = 1.8;
constexpr glm::vec4 kPlanned{0.35F, 1.05F, 1.15F, 1.0F};  // tint of a plan

// Dots around a particle that was not measured: how many, and their distance and size in radii.
struct DoubtMark {
  int dots = 0;
  double size = 0;
};
constexpr DoubtMark kComputedMark{12, 1.0}, kStaleMark{4, 2.4};
constexpr double kDoubtRadius = 1.6;
constexpr std::uint32_t kMostMarked = 512;  // largest number of particles with such dots
constexpr float kStaleShade = 0.3F;

// Linear colours of the species, which also differ in lightness.
constexpr std::array<glm::vec3, 8> kSpeciesColors{{{0.83F, 0.56F, 0.15F},
                                                   {0.80F, 0.84F, 0.88F},
                                                   {0.30F, 0.55F, 0.40F},
                                                   {0.62F, 0.30F, 0.30F},
                                                   {0.35F, 0.45F, 0.75F},
                                                   {0.88F, 0.75F, 0.55F},
                                                   {0.45F, 0.30F, 0.55F},
                                                   {0.25F, 0.25F, 0.28F}}};

// Places in the servo's order, and sizes of the particles.
struct Placed {
  std::size_t species = 0;
  double radius_m = 0, half_m = 0, outer_m = 0, x_m = 0, y_m = 0, angle_rad = 0;
};
std::vector<Placed> placed(const scene::ParticleSet& set) {
  const auto shared = std::make_unique<const scene::SharedParticles>(scene::shared_particles(set));
  std::vector<Placed> all;
  for (std::uint32_t i = 0; i < shared->count; ++i) {
    const scene::SharedParticle& particle = shared->particles[i];
    all.push_back({.species = particle.species,
                   .radius_m = shared->species[particle.species].radius_m,
                   .half_m = 0.5 * shared->length_m[particle.species],
                   .outer_m = physics::outer_radius(set.setup.species[particle.species]).si,
                   .x_m = particle.x_m,
                   .y_m = particle.y_m,
                   .angle_rad = shared->angle_rad[i]});
  }
  return all;
}

// Direction from the middle of a rod to its front end, in half lengths.
glm::dvec2 axis_of(const physics::HalfTurn& turn) { return {turn.w * turn.w - turn.z * turn.z, 2.0 * turn.w * turn.z}; }

// Mark on the sample, in layout units.
render::MeshCopy mark_at(const glm::dvec2& place, double size) {
  return {.place = glm::vec3(dvec3(place, 0.0)), .scale = static_cast<float>(size)};
}

}  // namespace

double StageParticles::stroke_m(const scene::ParticleSet& set) {
  const std::vector<Placed> particles = placed(set);
  double reach_m = 0.0;
  for (const Placed& p : particles) {
    const double size_m = p.half_m + p.outer_m;
    reach_m = std::max({reach_m, std::abs(p.x_m) + size_m, std::abs(p.y_m) + size_m});
  }
  const auto reach = [&](const auto& pad) {
    reach_m = std::max(
        {reach_m, std::abs(pad.middle.x.si) + pad.half_size.x.si, std::abs(pad.middle.y.si) + pad.half_size.y.si});
  };
  for (const scene::Pad& pad : scene::shared_pads(set)) reach(pad);
  for (const physics::StickyPad& pad : scene::shared_sticky_pads(set)) reach(pad);
  if (set.soft || set.ink) reach_m = 0.5 * marks_scale(set).side_m;
  const double layout_per_m = std::min(kDrawnReach / reach_m, kDrawnDiameter / (2.0 * scene::median_radius(set).si));
  return kStrokeHeight / layout_per_m;
}

StageParticles::StageParticles(const scene::ParticleSet& set, ModelBuilder& build, scene::Scene& scene,
                               scene::NodeIndex sample)
    : tip_radius_m_(set.setup.tip.radius.si) {
  const std::vector<Placed> particles = placed(set);
  double half_m = 0.0;  // half length of the rods of a pattern
  for (const Placed& p : particles) {
    const physics::HalfTurn turn = physics::half_turn(p.angle_rad);
    particles_.push_back({.species = p.species,
                          .radius_m = p.radius_m,
                          .half_m = p.half_m,
                          .outer_m = p.outer_m,
                          .start_m = {p.x_m, p.y_m},
                          .start_turn = {0.0, 0.0, turn.z, turn.w},
                          .color = kSpeciesColors.at(p.species % kSpeciesColors.size())});
    half_m = std::max(half_m, p.half_m);
  }
  for (const auto& [position, turn] : scene::shared_targets(set)) {
    const glm::dvec2 middle_m(position.x.si, position.y.si), end_m = half_m * axis_of(turn);
    target_places_m_.push_back(middle_m - end_m);
    if (half_m > 0.0) target_places_m_.push_back(middle_m + end_m);
  }
  target_size_m_ = scene::median_radius(set).si;
  build.part(particle_sphere(), "particles", sample);
  build.part(particle_target(), "targets", sample);
  build.part(particle_footprint(), "footprints", sample);
  build.part(particle_dot(), "ways", sample);
  build.part(particle_dot(), "plan-line", sample);
  build.part(particle_footprint(), "plan-ends", sample);
  build.part(particle_dot(), "doubts", sample);
  build.part(particle_ring(), "touched-particle", sample);
  add_flat_and_pads(set, build, sample);
  // up to the drawn lever
  const double drawn_radius = tip_radius_m_ * kStrokeHeight / stroke_m(set);
  build.part(particle_tip(set.setup.tip.half_angle_rad, kTipDrawnLength / drawn_radius), "true-tip", sample);
  spheres_ = build.node("particles/sphere");
  targets_ = build.node("targets/target");
  footprints_ = build.node("footprints/footprint");
  dots_ = build.node("ways/dot");
  plan_line_ = build.node("plan-line/dot");
  plan_ends_ = build.node("plan-ends/footprint");
  doubts_ = build.node("doubts/dot");
  ring_ = build.node("touched-particle/ring");
  tip_ = build.node("true-tip/tip");
  const auto count = std::max(1U, static_cast<std::uint32_t>(particles_.size()));  // none if the tip leaves marks
  most_dots_ = std::clamp(kMostDotsInAll / count, 1U, kMostDots);
  if (build.error()) return;
  scene.nodes[spheres_].most_copies = scene.nodes[footprints_].most_copies = count;
  scene.nodes[dots_].most_copies = most_dots_ * count;
  scene.nodes[plan_line_].most_copies = scene::leaves_marks(set) ? kMostLineDots : kMostDots;
  scene.nodes[plan_ends_].most_copies = 2;
  scene.nodes[doubts_].most_copies = static_cast<std::uint32_t>(kComputedMark.dots) * std::min(count, kMostMarked);
  scene.nodes[targets_].most_copies = 2 * scene::kMostTargets;
  for (const auto& flat : flat_) {
    if (flat) scene.nodes[*flat].most_copies = count;
  }
  for (const DrawnPad& pad : pads_) scene.nodes[pad.node].most_copies = 1;
}

void StageParticles::add_flat_and_pads(const scene::ParticleSet& set, ModelBuilder& build, scene::NodeIndex sample) {
  for (std::size_t i = 0; i < set.setup.species.size(); ++i) {
    const physics::ParticleSpecies& species = set.setup.species[i];
    flat_.emplace_back();
    if (physics::is_rod(species)) {
      const std::string name = "rods-" + std::to_string(i);
      build.part(particle_rod(species.length / species.contact.tip_radius), name, sample);
      flat_.back() = build.node(name + "/rod");
    } else if (physics::is_island(species)) {
      const std::string name = "islands-" + std::to_string(i);
      build.part(particle_island(physics::core_radius(species) / species.contact.tip_radius), name, sample);
      flat_.back() = build.node(name + "/island");
    }
  }
  const physics::Length unit = scene::median_radius(set);
  const auto add = [&](const auto& model, const auto& pad) {
    const std::string name = "pads-" + std::to_string(pads_.size());
    build.part(model(2.0 * (pad.half_size.x / unit), 2.0 * (pad.half_size.y / unit)), name, sample);
    pads_.push_back({build.node(name + "/pad"), {pad.middle.x.si, pad.middle.y.si}});
  };
  for (const scene::Pad& pad : scene::shared_pads(set)) add(particle_pad, pad);
  for (const physics::StickyPad& pad : scene::shared_sticky_pads(set)) add(particle_sticky_pad, pad);
}

std::vector<scene::NodeIndex> StageParticles::nodes() const {
  std::vector<scene::NodeIndex> all{spheres_, targets_, footprints_, dots_, plan_line_, plan_ends_, doubts_, tip_};
  for (const auto& flat : flat_) {
    if (flat) all.push_back(*flat);
  }
  for (const DrawnPad& pad : pads_) all.push_back(pad.node);
  return all;
}

std::optional<dvec3> StageParticles::apex_m(const ParticlesNow* now) {
  if (now == nullptr || now->push.met == 0) return std::nullopt;
  const auto& [x, y, z] = now->push.apex_m;
  return dvec3(x, y, z);
}

void StageParticles::place(const ParticlesNow* now, double layout_per_m, const dvec3& apex,
                           std::vector<dmat4>& local) const {
  local[tip_] = glm::scale(glm::translate(dmat4(1.0), apex), dvec3(layout_per_m * tip_radius_m_));
  if (now == nullptr) return;
  const auto particle = touched(*now, particles_.size());
  if (!particle) return;
  const auto pose = pose_of(*now, *particle);
  const auto& [start_x, start_y] = particles_[*particle].start_m;
  const glm::dvec2 foot_m = pose ? touched_m(particles_[*particle], *pose, *now) : glm::dvec2(start_x, start_y);
  const dvec3 foot = layout_per_m * dvec3(foot_m, 0.0);
  local[ring_] = glm::scale(glm::translate(dmat4(1.0), foot), dvec3(layout_per_m * particles_[*particle].outer_m));
}

// Point of a rod's axis nearest to the tip.
glm::dvec2 StageParticles::touched_m(const Particle& particle, const scene::ParticlePose& pose,
                                     const ParticlesNow& now) const {
  const glm::dvec2 middle_m(pose.x_m, pose.y_m), axis = axis_of(scene::turn_of(pose));
  const double place_m = glm::dot(glm::dvec2(now.push.apex_m[0], now.push.apex_m[1]) - middle_m, axis);
  return middle_m + std::clamp(place_m, -particle.half_m, particle.half_m) * axis;
}

void StageParticles::add_copies(const ParticlesNow* now, double layout_per_m, render::FrameState& frame) const {
  render::MeshCopies spheres{.node = spheres_, .copies = {}};
  std::vector<render::MeshCopies> flat(flat_.size());
  spheres.copies.reserve(particles_.size());
  const auto pushed = now == nullptr ? std::nullopt : touched(*now, particles_.size());
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const Particle& particle = particles_[i];
    const auto pose = now == nullptr ? std::nullopt : pose_of(*now, i);
    const auto& [start_x, start_y] = particle.start_m;
    render::MeshCopy copy;
    copy.place = glm::vec3(layout_per_m * dvec3(pose ? pose->x_m : start_x, pose ? pose->y_m : start_y,
                                                particle.radius_m + (pose ? height_m(i, *pose, *now) : 0.0)));
    copy.scale = static_cast<float>(layout_per_m * particle.radius_m);
    copy.turn = glm::vec4(particle.start_turn);
    if (pose) {
      const auto& [w, x, y, z] = pose->orientation;
      copy.turn = glm::vec4(glm::dvec4(x, y, z, w));
    }
    const bool stale = now != nullptr && known_of(*now, i) == servo::Known::Stale;
    copy.tint =
        glm::vec4((stale ? kStaleShade : 1.0F) * (pushed == i ? kTouched * particle.color : particle.color), 1.0F);
    (flat_[particle.species] ? flat[particle.species] : spheres).copies.push_back(copy);
  }
  if (!spheres.copies.empty()) frame.copies.push_back(std::move(spheres));
  for (std::size_t i = 0; i < flat.size(); ++i) {
    if (flat[i].copies.empty()) continue;
    flat[i].node = flat_[i].value();
    frame.copies.push_back(std::move(flat[i]));
  }
  add_targets(layout_per_m, frame);
  if (now == nullptr) return;
  add_marks(*now, layout_per_m, frame);
  add_doubts(*now, layout_per_m, frame);
  add_plan(*now, layout_per_m, frame);
}

// Height above the sample of a sphere that hangs on the tip.
double StageParticles::height_m(std::size_t particle, const scene::ParticlePose& pose, const ParticlesNow& now) const {
  const bool hangs = now.push.state == physics::PushState::Carried && touched(now, particles_.size()) == particle;
  if (!hangs) return 0.0;
  const auto& [x_m, y_m, z_m] = now.push.apex_m;
  const double away_m = glm::length(glm::dvec2(pose.x_m - x_m, pose.y_m - y_m));
  const physics::Length touching = physics::touching_height(
      now.set->setup.tip, physics::Length(particles_[particle].radius_m), physics::Length(away_m));
  return std::max(0.0, z_m - touching.si);
}

void StageParticles::add_targets(double layout_per_m, render::FrameState& frame) const {
  render::MeshCopies targets{.node = targets_, .copies = {}};
  for (const glm::dvec2& place_m : target_places_m_) {
    targets.copies.push_back(mark_at(layout_per_m * place_m, layout_per_m * target_size_m_));
  }
  if (!targets.copies.empty()) frame.copies.push_back(std::move(targets));
  for (const auto& [node, middle_m] : pads_) {
    frame.copies.push_back({.node = node, .copies = {mark_at(layout_per_m * middle_m, layout_per_m * target_size_m_)}});
  }
}

// Adds dots from each particle's start to its place, straight, since other machines do not know its path.
void StageParticles::add_marks(const ParticlesNow& now, double layout_per_m, render::FrameState& frame) const {
  render::MeshCopies footprints{.node = footprints_, .copies = {}}, dots{.node = dots_, .copies = {}};
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const double radius_m = particles_[i].outer_m;
    const glm::dvec2 start_m(particles_[i].start_m[0], particles_[i].start_m[1]);
    const auto pose = pose_of(now, i);
    const glm::dvec2 way_m = pose ? glm::dvec2(pose->x_m, pose->y_m) - start_m : glm::dvec2(0.0);
    const double length_m = glm::length(way_m);
    if (!(length_m > kShortestWay * radius_m)) continue;
    const auto add = [&](render::MeshCopies& marks, double share) {
      marks.copies.push_back(mark_at(layout_per_m * (start_m + share * way_m), layout_per_m * radius_m));
    };
    add(footprints, 0.0);
    const double gaps = std::clamp(length_m / (kDotSpacing * radius_m), 1.0, most_dots_ + 1.0);
    for (double dot = 1.0; dot < std::floor(gaps); dot += 1.0) add(dots, dot / std::floor(gaps));
  }
  for (render::MeshCopies* marks : {&footprints, &dots}) {
    if (!marks->copies.empty()) frame.copies.push_back(std::move(*marks));
  }
}

void StageParticles::add_doubts(const ParticlesNow& now, double layout_per_m, render::FrameState& frame) const {
  render::MeshCopies dots{.node = doubts_, .copies = {}};
  std::uint32_t marked = 0;
  for (std::size_t i = 0; i < particles_.size() && marked < kMostMarked; ++i) {
    const servo::Known state = known_of(now, i);
    const auto pose = pose_of(now, i);
    if (state == servo::Known::Measured || !pose) continue;
    ++marked;
    const DoubtMark& mark = state == servo::Known::Stale ? kStaleMark : kComputedMark;
    const double radius_m = particles_[i].half_m + kDoubtRadius * particles_[i].outer_m;
    for (int dot = 0; dot < mark.dots; ++dot) {
      const double angle = 2.0 * std::numbers::pi * dot / mark.dots;
      const glm::dvec2 place_m =
          glm::dvec2(pose->x_m, pose->y_m) + radius_m * glm::dvec2(std::cos(angle), std::sin(angle));
      dots.copies.push_back(mark_at(layout_per_m * place_m, layout_per_m * mark.size * particles_[i].outer_m));
    }
  }
  if (!dots.copies.empty()) frame.copies.push_back(std::move(dots));
}

// Adds the line as planned, with the first ring around the sphere wherever it lies now.
void StageParticles::add_plan(const ParticlesNow& now, double layout_per_m, render::FrameState& frame) const {
  const auto particle = static_cast<std::size_t>(now.plan.particle);  // huge without a plan
  if (particle >= particles_.size()) return;
  const double radius_m = particles_[particle].outer_m;
  const glm::dvec2 from_m(now.plan.from_m[0], now.plan.from_m[1]), to_m(now.plan.to_m[0], now.plan.to_m[1]);
  const auto pose = pose_of(now, particle);
  render::MeshCopies line{.node = plan_line_, .copies = {}}, ends{.node = plan_ends_, .copies = {}};
  const auto add = [&](render::MeshCopies& marks, const glm::dvec2& place_m, double size) {
    marks.copies.push_back(mark_at(layout_per_m * place_m, layout_per_m * size * radius_m));
    marks.copies.back().tint = kPlanned;
  };
  const double gaps =
      std::floor(std::clamp(glm::distance(from_m, to_m) / (kPlanDotSpacing * radius_m), 1.0, kMostDots - 1.0));
  for (double dot = 0.0; dot <= gaps; dot += 1.0) add(line, glm::mix(from_m, to_m, dot / gaps), kPlanDotSize);
  add(ends, pose ? glm::dvec2(pose->x_m, pose->y_m) : from_m, kPlanRingSize);
  add(ends, to_m, kPlanRingSize);
  frame.copies.push_back(std::move(line));
  frame.copies.push_back(std::move(ends));
}

void add_lines(const LinesToWrite& lines, const WallScene& wall, render::FrameState& frame) {
  const auto node = wall.scene().find_node("plan-line/dot");
  if (!node) return;
  const double layout_per_m = 1.0 / (wall.unit_m() * wall.drawn_scale(0).sample_m_per_m);
  const std::size_t most = wall.scene().nodes[*node].most_copies;
  render::MeshCopies dots{.node = *node, .copies = {}};
  for (const std::vector<glm::dvec2>& corners_m : lines.lines_m) {
    for (std::size_t i = 0; i + 1 < corners_m.size(); ++i) {
      const double length_m = glm::distance(corners_m[i], corners_m[i + 1]);
      const double gaps = std::max(1.0, std::round(length_m / (kLineDotSpacing * lines.width_m)));
      for (double dot = 0.0; dot <= gaps && dots.copies.size() < most; dot += 1.0) {
        const glm::dvec2 place_m = glm::mix(corners_m[i], corners_m[i + 1], dot / gaps);
        dots.copies.push_back(mark_at(layout_per_m * place_m, layout_per_m * kLineDotSize * lines.width_m));
        dots.copies.back().place.z += static_cast<float>(kReliefLift);  // height above the marks
        dots.copies.back().tint = kPlanned;
      }
    }
  }
  if (!dots.copies.empty()) frame.copies.push_back(std::move(dots));
}

}  // namespace afm::exhibit
