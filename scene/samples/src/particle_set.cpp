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

// Middle of the smallest rectangle along x and y that has all the centres.
physics::Sideways<Length> middle_of(const std::vector<physics::PlacedParticle>& particles) {
  if (particles.empty()) return {};
  const auto middle = [&](auto coordinate) {
    const auto [least, most] =
        std::minmax_element(particles.begin(), particles.end(),
                            [&](const auto& a, const auto& b) { return coordinate(a) < coordinate(b); });
    return 0.5 * (coordinate(*least) + coordinate(*most));
  };
  return {middle([](const physics::PlacedParticle& p) { return p.position.x; }),
          middle([](const physics::PlacedParticle& p) { return p.position.y; })};
}

ParticleSet read_set(const toml::table& root) {
  const TomlTable top(root);
  top.allow_only({"title", "medium", "note", "tip", "lever", "species", "particle", "start", "move"});
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
  const physics::Sideways<Length> middle = middle_of(set.particles);
  for (const physics::PlacedParticle& particle : set.particles) {
    shared.particles.at(shared.count++) = {.x_m = (particle.position - middle).x.si,
                                           .y_m = (particle.position - middle).y.si,
                                           .species = static_cast<std::uint32_t>(particle.species),
                                           .pinned = particle.pinned ? 1U : 0U};
  }
  return shared;
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
