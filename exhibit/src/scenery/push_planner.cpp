// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scenery/push_planner.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <numbers>

#include "exhibit/scenery/stage_particles.h"
#include "exhibit/scenery/wall_layout.h"
#include "exhibit/scenery/wall_scene.h"
#include "exhibit/state/plan_figures.h"
#include "input/selection.h"
#include "physics/manipulation/tip_contact.h"
#include "physics/quantity_text.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/pattern_state.h"

namespace afm::exhibit {

namespace {

constexpr double kShortestPlan = 0.1;  // length in radii
constexpr double kPointedReach = 1.3;  // reach of a sphere for a ray, in radii
constexpr double kFreeWay = 3.0;       // distance without a pattern, in rho
constexpr std::size_t kDirections = 8;
constexpr int kDigitsOfPlan = 3;

}  // namespace

std::optional<input::Ray> ray_on_sample(const WallScene& scene, const WallState& state, const input::Ray& ray) {
  if (state.centerpiece != Centerpiece::Instrument || !state.material) return std::nullopt;
  const glm::dmat4 sample_from_room = glm::inverse(scene.node_transforms(state)[scene.sample_node()]);
  const double m_per_unit = scene.drawn_scale(*state.material, state.release_z_m).sample_m_per_m * scene.unit_m();
  return input::Ray{.origin_m = m_per_unit * glm::dvec3(sample_from_room * glm::dvec4(ray.origin_m, 1.0)),
                    .direction = glm::normalize(glm::dvec3(sample_from_room * glm::dvec4(ray.direction, 0.0)))};
}

PushPlanner::PushPlanner(const scene::ParticleSet& set)
    : set_(set), half_side_m_(0.5 * kNarrowestSample * StageParticles::stroke_m(set)) {
  const auto shared = std::make_unique<const scene::SharedParticles>(scene::shared_particles(set));
  for (std::uint32_t i = 0; i < shared->count; ++i) {
    starts_m_.emplace_back(shared->particles[i].x_m, shared->particles[i].y_m);
  }
  for (const physics::ParticlePlace& target : scene::shared_targets(set)) {
    targets_m_.emplace_back(target.position.x.si, target.position.y.si);
  }
}

bool PushPlanner::can_be_pushed(std::size_t particle) const {
  const physics::PlacedParticle& placed = set_.particles[particle];
  return !placed.pinned && !physics::is_rod(set_.setup.species[placed.species]);
}

double PushPlanner::radius_m(std::size_t particle) const {
  return physics::outer_radius(set_.setup.species[set_.particles[particle].species]).si;
}

glm::dvec2 PushPlanner::place_m(std::size_t particle, const ParticlesNow& now) const {
  const auto pose = pose_of(now, particle);
  return pose ? glm::dvec2(pose->x_m, pose->y_m) : starts_m_[particle];
}

// Index of the place that the best match with the pattern assigns to the particle.
std::size_t PushPlanner::assigned_place(std::size_t particle, const ParticlesNow& now) const {
  const auto pattern = pattern_of(now);
  for (std::size_t place = 0; pattern && place < pattern->match.particles.size(); ++place) {
    if (pattern->match.particles[place] == particle) return place;
  }
  return 0;
}

std::vector<glm::dvec2> PushPlanner::places_m(std::size_t particle, const ParticlesNow& now) const {
  if (!targets_m_.empty()) return targets_m_;
  const physics::Length radius(radius_m(particle));
  const double way_m = kFreeWay * physics::side_contact(set_.setup.tip, radius, physics::Length(0.0)).distance.si;
  std::vector<glm::dvec2> places;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(kDirections);
    places.push_back(place_m(particle, now) + way_m * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return places;
}

std::string PushPlanner::choose(std::size_t particle, const ParticlesNow& now) {
  plan_.particle = static_cast<std::int32_t>(particle);
  return go_to_place(assigned_place(particle, now), now);
}

// Plans the way to the first place, from this index on, at which the sphere does not lie.
std::string PushPlanner::go_to_place(std::size_t first, const ParticlesNow& now) {
  const std::vector<glm::dvec2> places = places_m(static_cast<std::size_t>(plan_.particle), now);
  for (std::size_t i = 0; i < places.size(); ++i) {
    place_ = (first + i) % places.size();
    if (go_to(places[place_], now)) return described(now);
  }
  return end();
}

// Plans the way to a place from the sphere's own; false if the sphere is there.
bool PushPlanner::go_to(const glm::dvec2& place_m, const ParticlesNow& now) {
  const auto particle = static_cast<std::size_t>(plan_.particle);
  const glm::dvec2 from_m = this->place_m(particle, now);
  if (!(glm::distance(from_m, place_m) > kShortestPlan * radius_m(particle))) return false;
  plan_.from_m = {from_m.x, from_m.y};
  plan_.to_m = {place_m.x, place_m.y};
  return true;
}

std::string PushPlanner::end() {
  plan_ = {};
  return "plan: none";
}

void PushPlanner::clear() {
  plan_ = {};
  groove_ = false;
}

scene::PlannedPush PushPlanner::plan() const {
  scene::PlannedPush plan = plan_;
  plan.guided = groove_ && plan.particle != scene::kNoParticle ? 1 : 0;
  return plan;
}

std::string PushPlanner::next_particle(const ParticlesNow& now) {
  std::size_t next = plan_.particle == scene::kNoParticle ? 0 : static_cast<std::size_t>(plan_.particle) + 1;
  while (next < set_.particles.size() && !can_be_pushed(next)) ++next;
  if (next < set_.particles.size()) return choose(next, now);
  return plan_.particle == scene::kNoParticle ? "plan: only spheres that are not pinned can be planned" : end();
}

std::string PushPlanner::next_place(const ParticlesNow& now) {
  if (plan_.particle == scene::kNoParticle) return next_particle(now);
  return go_to_place(place_ + 1, now);
}

std::string PushPlanner::toggle_groove() {
  groove_ = !groove_;
  return groove_ ? "groove: on, along the plan of a push" : "groove: off";
}

std::optional<std::string> PushPlanner::point(const input::Ray& ray, const ParticlesNow& now) {
  std::vector<input::Target> spheres;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < set_.particles.size(); ++i) {
    if (!can_be_pushed(i)) continue;
    spheres.push_back({.center_m = glm::dvec3(place_m(i, now), radius_m(i)), .radius_m = kPointedReach * radius_m(i)});
    numbers.push_back(i);
  }
  if (const auto sphere = input::pick(ray, 0.0, spheres)) {
    return plan_.particle == static_cast<std::int32_t>(numbers[*sphere]) ? end() : choose(numbers[*sphere], now);
  }
  const glm::dvec2 met_m(ray.origin_m - ray.origin_m.z / ray.direction.z * ray.direction);
  const auto is_on_sample = [&](double coordinate_m) { return std::abs(coordinate_m) <= half_side_m_; };  // NaN: false
  const bool met = ray.origin_m.z > 0.0 && ray.direction.z < 0.0 && is_on_sample(met_m.x) && is_on_sample(met_m.y);
  if (!met) return std::nullopt;
  if (plan_.particle == scene::kNoParticle) return "plan: point at a sphere first";
  return go_to(met_m, now) ? described(now) : "plan: the sphere lies there";
}

std::string PushPlanner::described(const ParticlesNow& now) const {
  ParticlesNow planned = now;
  planned.plan = plan_;
  const PlanFigures figures = plan_figures(planned).value();
  std::string text = fmt::format("plan: particle {}, {} to go; aim within {}", plan_.particle + 1,
                                 physics::format_quantity(figures.left, physics::kLengthUnits, kDigitsOfPlan),
                                 physics::format_quantity(figures.aim, physics::kLengthUnits, kDigitsOfPlan));
  if (!(figures.hand.si > 0.0)) return text;
  return text + ", hand at most " + physics::format_quantity(figures.hand, physics::kVelocityUnits, kDigitsOfPlan);
}

}  // namespace afm::exhibit
