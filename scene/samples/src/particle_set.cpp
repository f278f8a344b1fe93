// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/particle_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "core/check.h"
#include "physics/contact_parameters.h"
#include "physics/elasticity.h"
#include "scene/config/toml_file.h"
#include "scene/config/toml_table.h"
#include "scene/samples/particle_files.h"
#include "sourced_values.h"

namespace afm::scene {
namespace {

using physics::Length;

constexpr std::size_t kMostMoves = 1000;
constexpr Length kWidestPlace{1e-4}, kHighestPlace{1e-5};
constexpr double kRounding = 1e-6;
constexpr physics::Velocity kSlowestHand{1e-11}, kFastestHand{1e-4};

// A key of a table for a field that physics refuses.
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

Length place(const TomlTable& table, std::string_view key, Length most) {
  const Length value = table.quantity(key, physics::kLengthUnits);
  if (!(value >= -most && value <= most)) {
    table.refuse(key, fmt::format("{} is not within -{} to {}", physics::format_quantity(value, physics::kLengthUnits),
                                  physics::format_quantity(most, physics::kLengthUnits),
                                  physics::format_quantity(most, physics::kLengthUnits)));
  }
  return value;
}

physics::LeverBase base(const TomlTable& table) {
  return {{place(table, "x", kWidestPlace), place(table, "y", kWidestPlace)}, place(table, "z", kHighestPlace)};
}

physics::ParticleSpecies read_species(const TomlTable& table, SpeciesEntry& entry) {
  table.allow_only({"name", "radius", "particle_modulus", "particle_poisson_ratio", "sample_modulus",
                    "sample_poisson_ratio", "work_of_adhesion", "law", "shear_strength", "coefficient",
                    "measured_threshold", "kinetic_ratio", "ageing", "rolling_distance", "tip_adhesion"});
  entry.name = table.text("name");
  SourcedValues values(table);
  physics::ParticleSpecies species;
  species.law = table.one_of("law", physics::kParticleLaws, &physics::ParticleLawText::word).law;
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
  try {
    species.contact.reduced_modulus = physics::reduced_modulus(particle, sample);
    physics::validate(species);
  } catch (const physics::UnphysicalValue& error) {
    table.refuse(key_of(error.field()), error.what());
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

// The table and key of a field of PushSetup.
void check_setup(const ParticleSet& set, const TomlTable& top, const TomlTable& tip, const TomlTable& lever) {
  try {
    physics::validate(set.setup);
  } catch (const physics::UnphysicalValue& error) {
    const std::string& field = error.field();
    if (field == "tip_radius") tip.refuse("radius", error.what());
    if (field == "half_angle") tip.refuse("half_angle_deg", error.what());
    if (field == "tip_friction") tip.refuse("friction", error.what());
    if (field == "radius") {
      top.refuse("species",
                 std::string(error.what()) + ": radii must be at least half the tip's and half the largest sphere's");
    }
    lever.refuse(field, error.what());
  }
}

physics::PlacedParticle read_particle(const TomlTable& table, const ParticleSet& set) {
  table.allow_only({"species", "x", "y", "pinned"});
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
  return particle;
}

HandMove read_move(const TomlTable& table) {
  table.allow_only({"x", "y", "z", "speed"});
  HandMove move{base(table), table.quantity("speed", physics::kVelocityUnits)};
  if (!(move.speed >= kSlowestHand && move.speed <= kFastestHand)) {
    table.refuse("speed",
                 fmt::format("{} is not within {}", physics::format_quantity(move.speed, physics::kVelocityUnits),
                             physics::range_text(kSlowestHand.si, kFastestHand.si, physics::kVelocityUnits)));
  }
  return move;
}

// Smallest rectangle along x and y that has all the centres.
struct Field {
  physics::Sideways<Length> least, most;

  physics::Sideways<Length> middle() const { return (least + most) * 0.5; }
  bool holds(const physics::Sideways<Length>& place) const {
    return place.x >= least.x && place.x <= most.x && place.y >= least.y && place.y <= most.y;
  }
};

Field field_of(const std::vector<physics::PlacedParticle>& particles) {
  if (particles.empty()) return {};
  Field field{particles.front().position, particles.front().position};
  for (const physics::PlacedParticle& particle : particles) {
    const physics::Sideways<Length>& place = particle.position;
    field.least = {std::min(field.least.x, place.x), std::min(field.least.y, place.y)};
    field.most = {std::max(field.most.x, place.x), std::max(field.most.y, place.y)};
  }
  return field;
}

// The places of a pattern: within the field of the particles, over which the hand reaches, and no nearer to
// each other than the smallest particles that touch.
void read_targets(const TomlTable& top, ParticleSet& set) {
  const auto movable = static_cast<std::size_t>(
      std::count_if(set.particles.begin(), set.particles.end(), [](const auto& p) { return !p.pinned; }));
  Length smallest = set.setup.species.front().contact.tip_radius;
  for (const physics::ParticleSpecies& species : set.setup.species) {
    smallest = std::min(smallest, species.contact.tip_radius);
  }
  const Length touching = physics::touching_distance(smallest, smallest);
  const Field field = field_of(set.particles);
  for (const TomlTable& table : top.tables("target", kMostTargets)) {
    table.allow_only({"x", "y"});
    const physics::Sideways<Length> target{place(table, "x", kWidestPlace), place(table, "y", kWidestPlace)};
    if (set.targets.size() == movable) {
      table.refuse("x", fmt::format("there are more targets than the {} particles that can be moved", movable));
    }
    if (!field.holds(target)) table.refuse("x", "the target is outside the rectangle of the particles");
    for (std::size_t i = 0; i < set.targets.size(); ++i) {
      if (physics::magnitude(set.targets[i] - target) >= (1.0 - kRounding) * touching) continue;
      table.refuse("x", fmt::format("the target is nearer to target {} than two particles that touch, {}", i + 1,
                                    physics::format_quantity(touching, physics::kLengthUnits)));
    }
    set.targets.push_back(target);
  }
}

ParticleSet read_set(const toml::table& root) {
  const TomlTable top(root);
  top.allow_only({"title", "medium", "note", "tip", "lever", "species", "particle", "target", "start", "move"});
  ParticleSet set;
  set.title = top.text("title");
  set.medium = top.text("medium");
  if (top.has("note")) set.note = top.text("note");

  const TomlTable tip = top.table("tip", "[tip]"), lever = top.table("lever", "[lever]");
  SourcedValues tip_values(tip), lever_values(lever);
  read_tip(tip, set, tip_values);
  read_lever(lever, set, lever_values);
  set.sources = tip_values.take_sources();
  for (SourcedValue& source : set.sources) source.key = "tip_" + source.key;
  for (SourcedValue& source : lever_values.take_sources()) set.sources.push_back(std::move(source));

  for (const TomlTable& table : top.tables("species", kMaxSpecies)) {
    SpeciesEntry entry;
    set.setup.species.push_back(read_species(table, entry));
    const auto same = [&](const SpeciesEntry& s) { return s.name == entry.name; };
    if (std::any_of(set.species.begin(), set.species.end(), same)) {
      table.refuse("name", fmt::format("\"{}\" is used twice", entry.name));
    }
    set.species.push_back(std::move(entry));
  }
  check_setup(set, top, tip, lever);

  for (const TomlTable& table : top.tables("particle", physics::kMostParticles)) {
    set.particles.push_back(read_particle(table, set));
  }
  try {
    physics::validate(set.setup, set.particles);
  } catch (const std::invalid_argument& error) {
    top.refuse("particle", error.what());
  }
  if (top.has("target")) read_targets(top, set);
  const TomlTable start = top.table("start", "[start]");
  start.allow_only({"x", "y", "z"});
  set.start = base(start);
  for (const TomlTable& table : top.tables("move", kMostMoves)) set.moves.push_back(read_move(table));
  return set;
}

}  // namespace

SharedParticles shared_particles(const ParticleSet& set) {
  AFM_CHECK(set.species.size() <= kMaxSpecies && set.setup.species.size() == set.species.size() &&
            set.particles.size() <= kMaxParticles);
  SharedParticles shared;
  shared.pusher.tip_radius_m = set.setup.tip.radius.si;
  shared.pusher.half_angle_rad = set.setup.tip.half_angle_rad;
  shared.pusher.tip_friction = set.setup.tip_friction;
  shared.pusher.lateral_spring_n_per_m = set.setup.springs.lateral.si;
  shared.pusher.normal_spring_n_per_m = set.setup.springs.normal.si;
  shared.pusher.contact_stiffness_n_per_m = set.setup.springs.contact.si;
  for (const physics::ParticleSpecies& species : set.setup.species) {
    shared.species.at(shared.species_count) = {.name = to_name(set.species[shared.species_count].name),
                                               .radius_m = species.contact.tip_radius.si,
                                               .reduced_modulus_pa = species.contact.reduced_modulus.si,
                                               .work_of_adhesion_j_per_m2 = species.contact.work_of_adhesion.si,
                                               .shear_strength_pa = species.shear_strength.si,
                                               .coefficient = species.coefficient,
                                               .measured_threshold_n = species.measured_threshold.si,
                                               .kinetic_ratio = species.kinetic_ratio,
                                               .ageing_s = species.ageing.si,
                                               .rolling_distance_m = species.rolling_distance.si,
                                               .tip_adhesion_j_per_m2 = species.tip_adhesion.si,
                                               .law = species.law};
    ++shared.species_count;
  }
  const physics::Sideways<Length> middle = field_of(set.particles).middle();
  for (const physics::PlacedParticle& particle : set.particles) {
    shared.particles.at(shared.count++) = {.x_m = (particle.position - middle).x.si,
                                           .y_m = (particle.position - middle).y.si,
                                           .species = static_cast<std::uint32_t>(particle.species),
                                           .pinned = particle.pinned ? 1U : 0U};
  }
  return shared;
}

std::vector<physics::Sideways<Length>> shared_targets(const ParticleSet& set) {
  std::vector<physics::Sideways<Length>> targets = set.targets;
  const physics::Sideways<Length> middle = field_of(set.particles).middle();
  for (physics::Sideways<Length>& target : targets) target = target - middle;
  return targets;
}

Length median_radius(const ParticleSet& set) {
  AFM_CHECK(!set.particles.empty());
  std::vector<Length> radii;
  radii.reserve(set.particles.size());
  for (const physics::PlacedParticle& p : set.particles) {
    radii.push_back(set.setup.species[p.species].contact.tip_radius);
  }
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

ParticleSet recorded_set(const SharedParticles& recorded, const std::string& assets_dir) {
  for (const std::string& name : particle_sets(assets_dir)) {
    const auto path = particle_file(name, assets_dir);
    auto set = path ? load_particle_set(*path) : tl::unexpected(path.error());
    if (set && *std::make_unique<const SharedParticles>(shared_particles(*set)) == recorded) return std::move(*set);
  }
  ParticleSet set;
  set.title = "Recorded particles";
  set.medium = "air";
  set.setup = push_setup(recorded);
  set.particles = start_places(recorded);
  for (std::uint32_t i = 0; i < recorded.species_count; ++i) {
    set.species.push_back({.name = recorded.species[i].name.data(), .sources = {}});
  }
  return set;
}

core::Result<ParticleSet> load_particle_set(const std::string& path) {
  return read_toml("particle file", path, read_set);
}

}  // namespace afm::scene
