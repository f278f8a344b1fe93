// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/particle_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "blind_task_file.h"
#include "hand_moves.h"
#include "physics/contact_parameters.h"
#include "physics/elasticity.h"
#include "physics/manipulation/rod.h"
#include "scene/config/toml_file.h"
#include "scene/config/toml_table.h"
#include "setup_checks.h"
#include "soft_sample.h"
#include "sourced_values.h"

namespace afm::scene {
namespace {

using physics::Length;

constexpr std::size_t kMostMoves = 1000;
constexpr double kRounding = 1e-6;
constexpr std::string_view kPadField = "pad_";  // prefix of a pad's fields that the physics refuses
constexpr std::int64_t kLargestSeed = 65535;
constexpr double kWidestAngle = 360.0;  // in degrees

// Key of a table for a field that the physics may refuse.
struct KeyOfField {
  std::string_view field, key;
};
constexpr std::array kSpeciesKeys{KeyOfField{"tip_modulus", "particle_modulus"},
                                  KeyOfField{"tip_poisson_ratio", "particle_poisson_ratio"}};

std::string_view key_of(std::string_view field) {
  const auto at =
      std::find_if(kSpeciesKeys.begin(), kSpeciesKeys.end(), [=](const KeyOfField& k) { return k.field == field; });
  return at == kSpeciesKeys.end() ? field : at->key;
}

// A rod's friction is given per length, and its stiffness limits how long it may be: it is pushed as a rigid body.
physics::ParticleSpecies read_rods(const TomlTable& table, SpeciesEntry& entry) {
  table.allow_only({"name", "radius", "length", "particle_modulus", "friction_per_length", "kinetic_ratio", "ageing"});
  entry.name = table.text("name");
  SourcedValues values(table);
  physics::ParticleSpecies species;
  species.law = physics::ParticleLaw::Measured;
  species.contact.tip_radius = values.quantity("radius", physics::kLengthUnits);
  species.length = values.quantity("length", physics::kLengthUnits);
  const physics::Pressure modulus = values.quantity("particle_modulus", physics::kPressureUnits);
  const physics::Stiffness friction = values.quantity("friction_per_length", physics::kStiffnessUnits);
  species.measured_threshold = friction * species.length;
  species.kinetic_ratio = values.number("kinetic_ratio");
  species.ageing = values.quantity("ageing", physics::kTimeUnits);
  const auto refuse_unless_positive = [&](std::string_view key, double value) {
    if (!(value > 0.0 && std::isfinite(value))) table.refuse(key, "it must be positive");
  };
  refuse_unless_positive("length", species.length.si);
  refuse_unless_positive("particle_modulus", modulus.si);
  refuse_unless_positive("friction_per_length", friction.si);
  try {
    physics::validate(species);
  } catch (const physics::UnphysicalValue& error) {
    refuse_rod(table, error);
  }
  const Length longest = physics::longest_rigid_rod(friction, modulus, species.contact.tip_radius);
  if (species.length > longest) {
    table.refuse("length",
                 fmt::format("a rod longer than {} bends under its own friction by more than {:g} of its "
                             "length, and is pushed as if it were rigid: make it shorter or thicker",
                             physics::format_quantity(longest, physics::kLengthUnits, 3), physics::kRigidShare));
  }
  entry.sources = values.take_sources();
  return species;
}

// The friction of an island is a shear strength everywhere below it; its rim is round, half as high as the island.
physics::ParticleSpecies read_islands(const TomlTable& table, SpeciesEntry& entry) {
  table.allow_only({"name", "radius", "height", "shear_strength", "kinetic_ratio", "ageing"});
  entry.name = table.text("name");
  SourcedValues values(table);
  physics::ParticleSpecies species;
  species.law = physics::ParticleLaw::Measured;
  species.island_radius = values.quantity("radius", physics::kLengthUnits);
  species.contact.tip_radius = 0.5 * values.quantity("height", physics::kLengthUnits);
  species.shear_strength = values.quantity("shear_strength", physics::kPressureUnits);
  species.measured_threshold =
      species.shear_strength * (std::numbers::pi * species.island_radius * species.island_radius);
  species.kinetic_ratio = values.number("kinetic_ratio");
  species.ageing = values.quantity("ageing", physics::kTimeUnits);
  if (!(species.island_radius.si > 0.0)) table.refuse("radius", "it must be positive");
  try {
    physics::validate(species);
  } catch (const physics::UnphysicalValue& error) {
    refuse_island(table, error, 2.0 * species.contact.tip_radius);
  }
  entry.sources = values.take_sources();
  return species;
}

// Reads if the tip holds particles that it has touched, and if its pull-offs scatter.
void read_hold(const TomlTable& table, physics::ParticleSpecies& species) {
  species.sticks = table.has("sticks") && table.flag("sticks");
  if (species.sticks && !(species.tip_adhesion.si > 0.0)) {
    table.refuse("sticks", "a tip that sticks needs tip_adhesion above 0");
  }
  if (!table.has("pull_off_seed")) return;
  if (!species.sticks) table.refuse("pull_off_seed", "the tip has no pull-off here: set sticks = true");
  species.scatter_seed = static_cast<std::uint16_t>(table.whole("pull_off_seed", 1, kLargestSeed));
}

// Refuses a law without its own numbers; those of the others are only for the figure beside.
void refuse_law_without_numbers(const TomlTable& table, const physics::ParticleLawText& law) {
  using enum physics::ParticleLaw;
  const auto need = [&](std::string_view key) {
    if (!table.has(key)) table.refuse(key, fmt::format("is missing; the law {} needs it", law.word));
  };
  if (law.law == ContactArea || law.law == Both) need("shear_strength");
  if (law.law == Amontons || law.law == Both) need("coefficient");
  if (law.law == Measured) need("measured_threshold");
}

physics::ParticleSpecies read_species(const TomlTable& table, SpeciesEntry& entry) {
  if (table.has("length")) return read_rods(table, entry);
  if (table.has("height")) return read_islands(table, entry);
  table.allow_only({"name", "radius", "particle_modulus", "particle_poisson_ratio", "sample_modulus",
                    "sample_poisson_ratio", "work_of_adhesion", "law", "shear_strength", "coefficient",
                    "measured_threshold", "kinetic_ratio", "ageing", "rolling_distance", "tip_adhesion", "sticks",
                    "pull_off_seed"});
  entry.name = table.text("name");
  SourcedValues values(table);
  physics::ParticleSpecies species;
  const physics::ParticleLawText& law = table.one_of("law", physics::kParticleLaws, &physics::ParticleLawText::word);
  refuse_law_without_numbers(table, law);
  species.law = law.law;
  const physics::Elasticity particle{values.quantity("particle_modulus", physics::kPressureUnits),
                                     values.number("particle_poisson_ratio")};
  const physics::Elasticity sample{values.quantity("sample_modulus", physics::kPressureUnits),
                                   values.number("sample_poisson_ratio")};
  species.contact.tip_radius = values.quantity("radius", physics::kLengthUnits);
  species.contact.work_of_adhesion = values.quantity("work_of_adhesion", physics::kSurfaceEnergyUnits);
  // the parameters of the laws that are not chosen give the figure beside
  if (const auto tau = values.optional_quantity("shear_strength", physics::kPressureUnits))
    species.shear_strength = *tau;
  if (table.has("coefficient")) species.coefficient = values.number("coefficient");
  if (const auto f = values.optional_quantity("measured_threshold", physics::kForceUnits))
    species.measured_threshold = *f;
  species.kinetic_ratio = values.number("kinetic_ratio");
  species.ageing = values.quantity("ageing", physics::kTimeUnits);
  if (const auto xi = values.optional_quantity("rolling_distance", physics::kLengthUnits))
    species.rolling_distance = *xi;
  if (const auto w = values.optional_quantity("tip_adhesion", physics::kSurfaceEnergyUnits)) species.tip_adhesion = *w;
  read_hold(table, species);
  try {
    species.contact.reduced_modulus = physics::reduced_modulus(particle, sample);
    physics::validate(species);
  } catch (const physics::UnphysicalValue& error) {
    const std::string_view key = key_of(error.field());
    table.refuse(key, message_of(error, key));
  }
  entry.sources = values.take_sources();
  return species;
}

void read_tip(const TomlTable& table, ParticleSet& set, SourcedValues& values) {
  table.allow_only({"radius", "half_angle_deg", "friction"});
  set.setup.tip.radius = values.quantity("radius", physics::kLengthUnits);
  set.setup.tip.half_angle_rad = values.number("half_angle_deg") * std::numbers::pi / 180.0;
  set.setup.tip_friction = values.number("friction");
}

void read_lever(const TomlTable& table, ParticleSet& set, SourcedValues& values) {
  table.allow_only({"lateral_spring", "normal_spring", "contact_stiffness"});
  set.setup.springs = {values.quantity("lateral_spring", physics::kStiffnessUnits),
                       values.quantity("normal_spring", physics::kStiffnessUnits),
                       values.quantity("contact_stiffness", physics::kStiffnessUnits)};
}

// Angle of a rod from x; required.
double read_angle(const TomlTable& table, bool rod) {
  if (!rod) {
    if (table.has("angle_deg")) table.refuse("angle_deg", "only a rod has an angle, and this is a sphere");
    return 0.0;
  }
  return table.number("angle_deg", -kWidestAngle, kWidestAngle) * std::numbers::pi / 180.0;
}

physics::PlacedParticle read_particle(const TomlTable& table, const ParticleSet& set) {
  table.allow_only({"species", "x", "y", "pinned", "angle_deg"});
  physics::PlacedParticle particle;
  const std::string name = table.has("species") || set.species.size() > 1 ? table.text("species") : set.species[0].name;
  const auto at =
      std::find_if(set.species.begin(), set.species.end(), [&](const SpeciesEntry& s) { return s.name == name; });
  if (at == set.species.end()) {
    std::string known;
    for (const SpeciesEntry& entry : set.species) known += (known.empty() ? "" : ", ") + entry.name;
    table.refuse("species", fmt::format("{} is unknown; known are {}", name, known));
  }
  particle.species = static_cast<std::size_t>(at - set.species.begin());
  particle.position = {place(table, "x", kWidestPlace), place(table, "y", kWidestPlace)};
  particle.pinned = table.has("pinned") && table.flag("pinned");
  particle.angle_rad = read_angle(table, physics::is_rod(set.setup.species[particle.species]));
  return particle;
}

bool has_movable(const ParticleSet& set, bool rods) {
  return std::any_of(set.particles.begin(), set.particles.end(), [&](const physics::PlacedParticle& p) {
    return !p.pinned && physics::is_rod(set.setup.species[p.species]) == rods;
  });
}

// Reads the places of a pattern: within the field of the particles, over which the hand reaches, and no closer to
// each other than the smallest particles that touch.
void read_targets(const TomlTable& top, ParticleSet& set) {
  const auto movable = static_cast<std::size_t>(
      std::count_if(set.particles.begin(), set.particles.end(), [](const auto& p) { return !p.pinned; }));
  Length smallest = physics::outer_radius(set.setup.species.front());
  for (const physics::ParticleSpecies& species : set.setup.species) {
    smallest = std::min(smallest, physics::outer_radius(species));
  }
  const Length touching = physics::touching_distance(smallest, smallest);
  const bool rods = has_movable(set, true);
  if (rods && has_movable(set, false)) {
    top.refuse("target", "a pattern is one of spheres or one of rods, and both can be moved: pin one kind");
  }
  for (const TomlTable& table : top.tables("target", kMostTargets)) {
    table.allow_only({"x", "y", "angle_deg"});
    const physics::Sideways<Length> target{place(table, "x", kWidestPlace), place(table, "y", kWidestPlace)};
    const physics::HalfTurn turn = physics::half_turn(read_angle(table, rods));
    if (set.targets.size() == movable) {
      table.refuse("x", fmt::format("there are more targets than the {} particles that can be moved", movable));
    }
    check_within_field(table, set, target, "the target");
    for (std::size_t i = 0; i < set.targets.size(); ++i) {
      if (physics::magnitude(set.targets[i].position - target) >= (1.0 - kRounding) * touching) continue;
      table.refuse("x", fmt::format("the target is nearer to target {} than two particles that touch, {}", i + 1,
                                    physics::format_quantity(touching, physics::kLengthUnits)));
    }
    set.targets.push_back({target, turn});
  }
}

// Reads a pad to which spheres stick harder or less, within the reach of the hand.
void read_sticky_pad(const TomlTable& table, const Pad& pad, ParticleSet& set) {
  if (!has_movable(set, false)) {
    table.refuse("work_of_adhesion", "a pad that spheres stick to needs a sphere that can be moved");
  }
  check_within_field(table, set, pad.middle, "the pad's middle");
  SourcedValues values(table);
  const physics::SurfaceEnergy work = values.quantity("work_of_adhesion", physics::kSurfaceEnergyUnits);
  set.setup.pads.push_back({pad.middle, pad.half_size, work});
  try {
    physics::validate(set.setup);
  } catch (const physics::UnphysicalValue& error) {
    table.refuse(std::string_view(error.field()).substr(kPadField.size()), error.what());
  }
  for (SourcedValue& source : values.take_sources()) {
    source.key = fmt::format("pad_{}_{}", set.setup.pads.size(), source.key);
    set.sources.push_back(std::move(source));
  }
}

void read_pads(const TomlTable& top, ParticleSet& set) {
  for (const TomlTable& table : top.tables("pad", kMostPads)) {
    table.allow_only({"x", "y", "width", "height", "work_of_adhesion"});
    Pad pad{.middle = {place(table, "x", kWidestPlace), place(table, "y", kWidestPlace)}, .half_size = {}};
    for (const auto& [key, half] : {std::pair{"width", &pad.half_size.x}, std::pair{"height", &pad.half_size.y}}) {
      const Length size = table.quantity(key, physics::kLengthUnits);
      if (!(size > Length(0.0) && size <= kWidestPlace)) {
        table.refuse(
            key, fmt::format("{} is not positive and at most {}", physics::format_quantity(size, physics::kLengthUnits),
                             physics::format_quantity(kWidestPlace, physics::kLengthUnits)));
      }
      *half = 0.5 * size;
    }
    if (table.has("work_of_adhesion")) {
      read_sticky_pad(table, pad, set);
      continue;
    }
    if (!has_movable(set, true) || set.targets.empty()) {
      table.refuse("x", "a pad without work_of_adhesion needs a rod that can be moved, and a target for it");
    }
    set.pads.push_back(pad);
  }
}

void read_particles(const TomlTable& top, ParticleSet& set) {
  SetTables tables{.top = top,
                   .tip = top.table("tip", "[tip]"),
                   .lever = top.table("lever", "[lever]"),
                   .species = {},
                   .particles = {}};
  SourcedValues tip_values(tables.tip), lever_values(tables.lever);
  read_tip(tables.tip, set, tip_values);
  read_lever(tables.lever, set, lever_values);
  set.sources = tip_values.take_sources();
  for (SourcedValue& source : set.sources) source.key = "tip_" + source.key;
  for (SourcedValue& source : lever_values.take_sources()) set.sources.push_back(std::move(source));

  tables.species = top.tables("species", kMaxSpecies);
  for (const TomlTable& table : tables.species) {
    SpeciesEntry entry;
    set.setup.species.push_back(read_species(table, entry));
    const auto same = [&](const SpeciesEntry& s) { return s.name == entry.name; };
    if (std::any_of(set.species.begin(), set.species.end(), same)) {
      table.refuse("name", fmt::format("\"{}\" is used twice", entry.name));
    }
    set.species.push_back(std::move(entry));
  }
  check_setup(set, tables);
  tables.particles = top.tables("particle", physics::kMostParticles);
  for (const TomlTable& table : tables.particles) set.particles.push_back(read_particle(table, set));
  check_places(set, tables);
  if (top.has("target")) read_targets(top, set);
  if (top.has("pad")) read_pads(top, set);
  if (top.has("task")) set.blind = read_blind_task(top, set);
}

ParticleSet read_set(const toml::table& root) {
  const TomlTable top(root);
  top.allow_only({"title", "medium", "note", "tip", "lever", "sample", "ink", "species", "particle", "target", "pad",
                  "task", "start", "move"});
  ParticleSet set;
  set.title = top.text("title");
  set.medium = top.text("medium");
  if (top.has("note")) set.note = top.text("note");
  if (top.has("ink")) {
    read_ink(top, set);
  } else if (top.has("sample")) {
    read_soft_sample(top, set);
  } else {
    read_particles(top, set);
  }
  const TomlTable start = top.table("start", "[start]");
  start.allow_only({"x", "y", "z"});
  set.start = base(start);
  check_start(start, set);
  for (const TomlTable& table : top.tables("move", kMostMoves))
    set.moves.push_back(read_move(table, set.moves.empty() ? set.start : set.moves.back().to, set.soft != nullptr));
  if (set.soft) check_soft_moves(top, set);
  return set;
}

}  // namespace

core::Result<ParticleSet> load_particle_set(const std::string& path) {
  return read_toml("particle file", path, read_set);
}

}  // namespace afm::scene
