// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "physics/manipulation/particle_terms.h"
#include "scene/shared/field_visitor.h"
#include "scene/shared/name.h"
#include "scene/shared/soft_blocks.h"

// Blocks of the spheres, rods and flat islands that a tip pushes over the sample (docs/manipulation.md). Places
// are in the sample's frame, in metres of the nanoworld; the particles rest on its plane z = 0.
namespace afm::physics {
struct HalfTurn;
struct PlacedParticle;
struct PushSetup;
}  // namespace afm::physics

namespace afm::scene {

struct LevelSample;  // scene/shared/tip_blocks.h
struct PushSample;

inline constexpr std::uint32_t kMaxParticles = 2048;
inline constexpr std::uint32_t kMaxSpecies = 8;
inline constexpr std::uint32_t kPosesPerPage = 16;
inline constexpr std::int32_t kNoParticle = -1;
inline constexpr std::uint32_t kParticlePages = kMaxParticles / kPosesPerPage;
static_assert(kMaxParticles == physics::kMostParticles);

// Page of a particle, and number of pages for a number of particles.
constexpr std::uint32_t page_of(std::uint32_t particle) { return particle / kPosesPerPage; }
constexpr std::uint32_t pages_of(std::uint32_t particle_count) {
  return (particle_count + kPosesPerPage - 1) / kPosesPerPage;
}

// ---- constant after the segment is created (written by touchafm, part of SharedModel) ----

// physics::ParticleSpecies in plain numbers, SI.
struct SharedSpecies {
  Name name{};
  double radius_m = 0;
  double reduced_modulus_pa = 0;
  double work_of_adhesion_j_per_m2 = 0;
  double shear_strength_pa = 0;
  double coefficient = 0;
  double measured_threshold_n = 0;
  double kinetic_ratio = 0;
  double ageing_s = 0;
  double rolling_distance_m = 0;
  double tip_adhesion_j_per_m2 = 0;
  physics::ParticleLaw law = physics::ParticleLaw::ContactArea;
  std::uint16_t sticks = 0;        // 1: the tip holds particles that it has touched
  std::uint16_t scatter_seed = 0;  // seed of the scatter of pull-offs; 0: none

  bool operator==(const SharedSpecies&) const = default;
};

template <class Visit, RecordOf<SharedSpecies>... Record>
constexpr void for_each_field(Visit&& visit, Record&... species) {
  visit("name", species.name...);
  visit("radius_m", species.radius_m...);
  visit("reduced_modulus_Pa", species.reduced_modulus_pa...);
  visit("work_of_adhesion_J_per_m2", species.work_of_adhesion_j_per_m2...);
  visit("shear_strength_Pa", species.shear_strength_pa...);
  visit("coefficient", species.coefficient...);
  visit("measured_threshold_N", species.measured_threshold_n...);
  visit("kinetic_ratio", species.kinetic_ratio...);
  visit("ageing_s", species.ageing_s...);
  visit("rolling_distance_m", species.rolling_distance_m...);
  visit("tip_adhesion_J_per_m2", species.tip_adhesion_j_per_m2...);
  visit("law", species.law...);
  visit("sticks", species.sticks...);
  visit("scatter_seed", species.scatter_seed...);
}
static_assert(all_fields_described<SharedSpecies>());

// Tip and lever that push, and the scale at which the hand feels them.
struct SharedPusher {
  double tip_radius_m = 0;
  double half_angle_rad = 0;
  double tip_friction = 0;               // mu_t, coefficient of friction between tip and particle
  double lateral_spring_n_per_m = 0;     // k_l, lateral stiffness of the lever
  double normal_spring_n_per_m = 0;      // k_c, normal stiffness of the lever
  double contact_stiffness_n_per_m = 0;  // k_n, stiffness of the contact
  double diameter_in_hand_m = 0.010;     // width of the median particle in the hand; less if the workspace is too small
  double threshold_on_hand_n = 1.0;      // force on the hand at which the median particle yields

  bool operator==(const SharedPusher&) const = default;
};

template <class Visit, RecordOf<SharedPusher>... Record>
constexpr void for_each_field(Visit&& visit, Record&... pusher) {
  visit("tip_radius_m", pusher.tip_radius_m...);
  visit("half_angle_rad", pusher.half_angle_rad...);
  visit("tip_friction", pusher.tip_friction...);
  visit("lateral_spring_N_per_m", pusher.lateral_spring_n_per_m...);
  visit("normal_spring_N_per_m", pusher.normal_spring_n_per_m...);
  visit("contact_stiffness_N_per_m", pusher.contact_stiffness_n_per_m...);
  visit("diameter_in_hand_m", pusher.diameter_in_hand_m...);
  visit("threshold_on_hand_N", pusher.threshold_on_hand_n...);
}
static_assert(all_fields_described<SharedPusher>());

// Particle before the first push.
struct SharedParticle {
  double x_m = 0;  // x of the centre
  double y_m = 0;
  std::uint32_t species = 0;  // index into SharedParticles::species
  std::uint32_t pinned = 0;   // 1: never moves

  bool operator==(const SharedParticle&) const = default;
};

template <class Visit, RecordOf<SharedParticle>... Record>
constexpr void for_each_field(Visit&& visit, Record&... particle) {
  visit("x_m", particle.x_m...);
  visit("y_m", particle.y_m...);
  visit("species", particle.species...);
  visit("pinned", particle.pinned...);
}
static_assert(all_fields_described<SharedParticle>());

// physics::StickyPad in plain numbers, SI.
struct SharedPad {
  double x_m = 0;  // x of the middle
  double y_m = 0;
  double half_width_m = 0;  // half the extent along x
  double half_height_m = 0;
  double work_of_adhesion_j_per_m2 = 0;  // 0: no pad

  bool operator==(const SharedPad&) const = default;
};

template <class Visit, RecordOf<SharedPad>... Record>
constexpr void for_each_field(Visit&& visit, Record&... pad) {
  visit("x_m", pad.x_m...);
  visit("y_m", pad.y_m...);
  visit("half_width_m", pad.half_width_m...);
  visit("half_height_m", pad.half_height_m...);
  visit("work_of_adhesion_J_per_m2", pad.work_of_adhesion_j_per_m2...);
}
static_assert(all_fields_described<SharedPad>());

inline constexpr std::uint32_t kHighestLevel = 2;
inline constexpr std::uint32_t kLargestSeed = 65535;

// Distance of the particles' picture from the particles: level and seed of scene::PushScript.
struct SharedLevel {
  std::uint32_t level = 0;    // 0: particles as they are; 1: computed picture without errors; 2: drift and scatter
  std::uint32_t seed = 1;     // seed of drift and scatter, 1 to 65535
  std::int64_t since_ns = 0;  // start of the drift on the clock of TipState; 0: first tick of the servo

  bool operator==(const SharedLevel&) const = default;
};

template <class Visit, RecordOf<SharedLevel>... Record>
constexpr void for_each_field(Visit&& visit, Record&... level) {
  visit("level", level.level...);
  visit("seed", level.seed...);
  visit("since_ns", level.since_ns...);
}
static_assert(all_fields_described<SharedLevel>());

struct SharedParticles {
  std::uint32_t count = 0;  // 0: no particles, and all other fields are ignored
  std::uint32_t species_count = 0;
  SharedPusher pusher{};
  std::array<SharedSpecies, kMaxSpecies> species{};
  std::array<SharedParticle, kMaxParticles> particles{};
  // only for rods; sessions store these separately, so that those without rods are unchanged
  std::array<double, kMaxSpecies> length_m{};     // length of a species' axis; 0: spheres
  std::array<double, kMaxParticles> angle_rad{};  // angle of a rod's axis from x
  // stored separately in sessions as well
  std::array<SharedPad, physics::kMostStickyPads> pads{};
  std::array<double, kMaxSpecies> island_radius_m{};  // radius R of a species of flat islands; 0: not islands
  SharedLevel level{};
  SharedSoft soft{};  // soft sample, which replaces the particles; `count` is then 0
  SharedInk ink{};    // ink, which also replaces the particles

  bool operator==(const SharedParticles&) const = default;
};

// True if the tip leaves marks instead of pushing particles: grooves in a soft sample, or ink.
inline bool has_marks(const SharedParticles& particles) {
  return particles.soft.hardness_pa > 0.0 || particles.ink.molecules_per_s > 0.0;
}

// True if the scale Particles has something to show: particles, or a sample for marks.
inline bool are_there(const SharedParticles& particles) { return particles.count > 0 || has_marks(particles); }

// True if a species consists of rods, or of flat islands; a set never mixes them with others.
bool has_rods(const SharedParticles& particles);
bool has_islands(const SharedParticles& particles);

// True if spheres of a species stick to the tip, or if there is a pad.
bool has_hold(const SharedParticles& particles);
bool has_pads(const SharedParticles& particles);

// True if the tip lifts spheres of a valid set off the sample or off a pad.
bool has_lift(const SharedParticles& particles);

// Reason why the particles cannot have a picture of level 1 or 2; empty if they can.
std::string why_no_level(const SharedParticles& particles);

// Same particles for the physics, with the scatter of their level; `particles` is valid (validate in
// scene/shared/shared_segment.h).
physics::PushSetup push_setup(const SharedParticles& particles);
std::vector<physics::PlacedParticle> start_places(const SharedParticles& particles);

// ---- written by touchafm ----

enum class PushTool : std::uint16_t { OfSet = 0, Push = 1, Grip = 2 };

// Settings that a person changes among particles, each an index into its values (scene/shared/push_values.h);
// 0: value of the set.
struct PushSettings {
  PushTool tool = PushTool::OfSet;
  std::uint16_t law = 0;
  std::uint16_t lever = 0;
  std::uint16_t tip = 0;
  std::uint16_t medium = 0;
  std::uint16_t level = 0;

  bool operator==(const PushSettings&) const = default;
};

template <class Visit, RecordOf<PushSettings>... Record>
constexpr void for_each_field(Visit&& visit, Record&... settings) {
  visit("tool", settings.tool...);
  visit("law", settings.law...);
  visit("lever", settings.lever...);
  visit("tip", settings.tip...);
  visit("medium", settings.medium...);
  visit("level", settings.level...);
}
static_assert(all_fields_described<PushSettings>());

// Straight path on which a person plans to push a sphere, in the sample's frame, metres. Stored whenever it changes,
// recorded with every tick.
struct PlannedPush {
  std::array<double, 2> from_m{};       // centre of the sphere at the time of planning
  std::array<double, 2> to_m{};         // goal of the sphere's centre
  std::int32_t particle = kNoParticle;  // index of the sphere; none: no plan, and all fields have their defaults
  std::uint32_t guided = 0;             // 1: a groove guides the hand (haptics/felt_groove.h)

  bool operator==(const PlannedPush&) const = default;
};

template <class Visit, RecordOf<PlannedPush>... Record>
constexpr void for_each_field(Visit&& visit, Record&... plan) {
  visit("plan_from_m", plan.from_m...);
  visit("plan_to_m", plan.to_m...);
  visit("plan_particle", plan.particle...);
  visit("plan_guided", plan.guided...);
}
static_assert(all_fields_described<PlannedPush>());

// Shortest length of a plan, and the largest coordinate of its ends: beyond the range of any scanner.
inline constexpr double kShortestPlanM = 1e-10;
inline constexpr double kFarthestPlanM = 1e-3;

// ---- written by touchafm-servo ----

struct ParticlePose {
  double x_m = 0;  // x of the centre
  double y_m = 0;
  std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};  // unit quaternion, w x y z: sample's frame from particle
  physics::PushState moved = physics::PushState::Free;    // latest motion; Free: none yet; Carried: off the sample
  std::uint32_t rod = 0;  // 1: rod along x of its frame, or island; turns only about the vertical

  bool operator==(const ParticlePose&) const = default;
};

template <class Visit, RecordOf<ParticlePose>... Record>
constexpr void for_each_field(Visit&& visit, Record&... pose) {
  visit("x_m", pose.x_m...);
  visit("y_m", pose.y_m...);
  visit("orientation_wxyz", pose.orientation...);
  visit("moved", pose.moved...);
  visit("rod", pose.rod...);
}
static_assert(all_fields_described<ParticlePose>());

// Poses of the particles from kPosesPerPage times its number onward; default poses beyond the last particle. The servo
// stores a page when it starts and whenever one of its poses has changed.
struct ParticlePage {
  std::array<ParticlePose, kPosesPerPage> poses{};

  bool operator==(const ParticlePage&) const = default;
};

// Direction of a rod or of an island's mark, in the form of the physics, and back; for a sphere, that of its x axis.
physics::HalfTurn turn_of(const ParticlePose& pose) noexcept;
void set_turn(ParticlePose& pose, const physics::HalfTurn& turn) noexcept;  // makes it the pose of a rod or an island

// Mark of a particle at its place; the digest of a set is the sum of the marks of all its particles, modulo 2^64, so
// that a change of one place changes one mark. Bit for bit: -0.0 differs from 0.0. The direction of a rod counts, the
// orientation of a sphere does not.
std::uint64_t place_mark(std::size_t particle, const ParticlePose& pose) noexcept;

// Digest of the first `count` particles of these pages; the pages hold at least `count`.
std::uint64_t digest_of(std::span<const ParticlePage> pages, std::size_t count) noexcept;

inline constexpr std::uint32_t kMostStrokes = 64;  // largest number of strokes that can be taken back

// Push in the newest tick. On a soft sample, where no particle is pushed, `lift_n` is the load on the lever, and
// `state` Holds, or Slides where the tip presses the sample in. With ink it is the load, too, negative for a pull, and
// `state` is Slides while ink flows. The certificate: given_j plus the energy stored at the
// start is at least lost_j + stored_j. A new account begins whenever the tip leaves the particles (`accounts`), and
// only then.
struct TipPush {
  std::int64_t time_ns = 0;  // clock of TipState
  std::uint64_t tick = 0;
  std::uint64_t digest = 0;           // digest_of() all particles, or of the marks with tiles not yet published
  std::array<double, 3> base_m{};     // position of the apex on the unbent lever
  std::array<double, 3> apex_m{};     // position of the apex on the bent lever
  std::array<double, 2> lateral_n{};  // force on the lever, along the sample's x and y
  double lift_n = 0;                  // upward force of the particles on the lever
  double normal_n = 0;                // normal force N on `particle`
  double threshold_n = 0;             // lateral force at which `particle` starts or keeps moving
  double other_threshold_n = 0;       // threshold at rest, without load, by other_law(); 0: unknown
  double given_j = 0;                 // upper bound of the energy given by the hand
  double work_j = 0;                  // work of the hand
  double lost_j = 0;                  // energy lost in friction and slips
  double stored_j = 0;                // energy stored in lever and contacts
  double hand_m_per_m = 0;            // scale of the particles in all directions: metres of hand per metre
  double hand_n_per_n = 0;            // newtons on the hand per newton of a push
  double softened_sideways = 1;       // softening of the lever by this factor, so that the hand can hold it
  double softened_upwards = 1;
  std::uint64_t yields = 0;     // number of yields of particles since the servo's start
  std::uint64_t exhausted = 0;  // number of ticks that ended with a heap not at rest, since the servo's start
  std::uint64_t accounts = 0;
  std::int32_t particle = kNoParticle;  // particle with the largest normal force, or held by the tip
  physics::PushState state = physics::PushState::Free;
  std::uint8_t met = 0;             // 1: tip among particles; 0: another scale, no force, or a wait for a lift
  std::uint8_t lagging = 0;         // 1: the hand was so fast that base_m is behind it
  std::uint16_t strokes = 0;        // number of strokes that can be taken back
  PushSettings settings{};          // settings in use; the tool is Push or Grip, OfSet without particles
  double rise_m = 0;                // height by which the lever on a soft sample is raised while the hand is fast
  double fastest_hand_m_per_s = 0;  // speed of the hand above which the lever is raised; 0: no soft sample
  InkPush ink{};
};

template <class Visit, RecordOf<TipPush>... Record>
constexpr void for_each_field(Visit&& visit, Record&... push) {
  visit("time_ns", push.time_ns...);
  visit("tick", push.tick...);
  visit("digest", push.digest...);
  visit("base_m", push.base_m...);
  visit("apex_m", push.apex_m...);
  visit("lateral_N", push.lateral_n...);
  visit("lift_N", push.lift_n...);
  visit("normal_N", push.normal_n...);
  visit("threshold_N", push.threshold_n...);
  visit("other_threshold_N", push.other_threshold_n...);
  visit("given_J", push.given_j...);
  visit("work_J", push.work_j...);
  visit("lost_J", push.lost_j...);
  visit("stored_J", push.stored_j...);
  visit("hand_m_per_m", push.hand_m_per_m...);
  visit("hand_N_per_N", push.hand_n_per_n...);
  visit("softened_sideways", push.softened_sideways...);
  visit("softened_upwards", push.softened_upwards...);
  visit("yields", push.yields...);
  visit("exhausted", push.exhausted...);
  visit("accounts", push.accounts...);
  visit("particle", push.particle...);
  visit("state", push.state...);
  visit("met", push.met...);
  visit("lagging", push.lagging...);
  visit("strokes", push.strokes...);
  visit("settings", push.settings...);
  visit("rise_m", push.rise_m...);
  visit("fastest_hand_m_per_s", push.fastest_hand_m_per_s...);
  visit("ink", push.ink...);
}
static_assert(all_fields_described<TipPush>());

// Law whose threshold is shown beside that of a species, because the laws disagree.
constexpr physics::ParticleLaw other_law(physics::ParticleLaw law) {
  return law == physics::ParticleLaw::ContactArea ? physics::ParticleLaw::Amontons : physics::ParticleLaw::ContactArea;
}

}  // namespace afm::scene
