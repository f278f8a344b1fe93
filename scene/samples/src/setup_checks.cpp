// SPDX-License-Identifier: Apache-2.0
#include "setup_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "particle_field.h"
#include "physics/manipulation/particle_limits.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/quantity_text.h"
#include "sourced_values.h"

namespace afm::scene {
namespace {

using physics::format_quantity;
using physics::kLengthUnits;
using physics::Length;

constexpr double kLeastShare = 0.5;  // smallest ratio of a particle to the tip, and to the largest particle
constexpr int kDigits = 4;           // significant digits of a length in a message

std::string length_text(Length length) { return format_quantity(length, kLengthUnits, kDigits); }

// Refuses the first species that is too thin for the tip or for another one, or too narrow for another island.
void check_sizes(const ParticleSet& set, const SetTables& tables) {
  Length thickest, widest;
  for (const physics::ParticleSpecies& species : set.setup.species) {
    thickest = std::max(thickest, species.contact.tip_radius);
    widest = std::max(widest, physics::outer_radius(species));
  }
  const Length tip = set.setup.tip.radius;
  for (std::size_t i = 0; i < set.species.size(); ++i) {
    const physics::ParticleSpecies& species = set.setup.species[i];
    const Length radius = species.contact.tip_radius;
    if (radius < kLeastShare * std::max(tip, thickest)) {
      if (!physics::is_island(species)) {
        tables.species[i].refuse("radius", fmt::format("{} is too small: it must be at least half the tip's, {}, and "
                                                       "half the largest particle's, {}",
                                                       length_text(radius), length_text(tip), length_text(thickest)));
      }
      tables.species[i].refuse(
          "height", fmt::format("{} is too low: an island must be at least as high as the tip's radius, {}, and half "
                                "as high as the highest island, {}",
                                length_text(2.0 * radius), length_text(tip), length_text(2.0 * thickest)));
    }
    if (physics::is_island(species) && species.island_radius < kLeastShare * widest) {
      tables.species[i].refuse("radius",
                               fmt::format("{} is too small: it must be at least half that of the widest island, {}",
                                           length_text(species.island_radius), length_text(widest)));
    }
  }
}

// The text of an error about the friction of a whole particle, which its file has per length or per area.
std::string whole_friction(const physics::UnphysicalValue& error, std::string_view what) {
  constexpr std::string_view kOfSpheres = "measured threshold ";
  const std::string text = error.what();
  return text.starts_with(kOfSpheres)
             ? fmt::format("friction of the whole {}: {}", what, text.substr(kOfSpheres.size()))
             : text;
}

}  // namespace

void check_setup(const ParticleSet& set, const SetTables& tables) {
  const bool islands = std::any_of(set.setup.species.begin(), set.setup.species.end(), physics::is_island);
  const bool others = !std::all_of(set.setup.species.begin(), set.setup.species.end(), physics::is_island);
  if (!(islands && others)) check_sizes(set, tables);
  try {
    physics::validate(set.setup);
  } catch (const physics::UnphysicalValue& error) {
    const std::string& field = error.field();
    if (field == "tip_radius") tables.tip.refuse("radius", error.what());
    if (field == "half_angle") tables.tip.refuse("half_angle_deg", error.what());
    if (field == "tip_friction") tables.tip.refuse("friction", error.what());
    if (field == "tip_adhesion" || field == "island_radius" || field == "radius") {
      tables.top.refuse("species", error.what());
    }
    tables.lever.refuse(field, error.what());
  }
}

void check_places(const ParticleSet& set, const SetTables& tables) {
  try {
    physics::validate(set.setup, set.particles);
  } catch (const physics::UnplaceableParticle& error) {
    tables.particles.at(error.particle()).refuse("x", error.what());
  } catch (const std::invalid_argument& error) {
    tables.top.refuse("particle", error.what());
  }
}

void refuse_rod(const TomlTable& table, const physics::UnphysicalValue& error) {
  if (error.field() == "measured_threshold") table.refuse("friction_per_length", whole_friction(error, "rod"));
  table.refuse(error.field(), error.what());
}

void refuse_island(const TomlTable& table, const physics::UnphysicalValue& error, Length height) {
  if (error.field() == "measured_threshold") table.refuse("shear_strength", whole_friction(error, "island"));
  if (error.field() == "radius") {
    table.refuse("height", fmt::format("height {} is not within {}", format_quantity(height, kLengthUnits),
                                       physics::range_text(2.0 * physics::kThinnestParticle.si,
                                                           2.0 * physics::kThickestParticle.si, kLengthUnits)));
  }
  if (error.field() == "island_radius") {
    table.refuse("radius", fmt::format("{}: an island must be at least {:g} times as wide as it is high",
                                       message_of(error, "radius"), physics::kFlattestIsland));
  }
  table.refuse(error.field(), error.what());
}

void check_within_field(const TomlTable& table, const ParticleSet& set, const physics::Sideways<Length>& place,
                        std::string_view what) {
  const ParticleField field = field_of(set);
  if (field.holds(place)) return;
  const bool across = place.x < field.least.x || place.x > field.most.x;
  const auto ends = [](Length least, Length most) {
    return physics::range_ends(least.si, most.si, kLengthUnits.units, kDigits);
  };
  const auto [left, right] = ends(field.least.x, field.most.x);
  const auto [below, above] = ends(field.least.y, field.most.y);
  table.refuse(across ? "x" : "y",
               fmt::format("{} is outside the rectangle of the particles, x from {} to {} and y from {} to {}, over "
                           "which the hand reaches: a particle with pinned = true beyond it makes that larger",
                           what, left, right, below, above));
}

}  // namespace afm::scene
