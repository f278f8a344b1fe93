// SPDX-License-Identifier: Apache-2.0
#include "soft_sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "physics/contact_parameters.h"
#include "physics/elasticity.h"
#include "physics/manipulation/marked_surface.h"
#include "scene/samples/scratch_run.h"
#include "sourced_values.h"

namespace afm::scene {
namespace {

using physics::Force;
using physics::Length;

}  // namespace

void add_sources(ParticleSet& set, std::string_view prefix, SourcedValues& values) {
  for (SourcedValue& source : values.take_sources()) {
    source.key = fmt::format("{}{}", prefix, source.key);
    set.sources.push_back(std::move(source));
  }
}

void read_marking_tip(const TomlTable& table, ParticleSet& set) {
  table.allow_only({"radius", "half_angle_deg"});
  SourcedValues values(table);
  set.setup.tip.radius = values.quantity("radius", physics::kLengthUnits);
  set.setup.tip.half_angle_rad = values.number("half_angle_deg") * std::numbers::pi / 180.0;
  try {
    physics::validate_marking_tip(set.setup.tip);
  } catch (const physics::UnphysicalValue& error) {
    table.refuse(error.field() == "tip_radius" ? "radius" : "half_angle_deg", error.what());
  }
  add_sources(set, "tip_", values);
}

void read_marking_lever(const TomlTable& table, std::span<const std::string_view> springs, ParticleSet& set) {
  table.allow_only(springs);
  SourcedValues values(table);
  const auto spring = [&](std::string_view key) { return values.quantity(key, physics::kStiffnessUnits); };
  set.setup.springs.lateral = spring(springs.front());
  set.setup.springs.normal = springs.size() > 1 ? spring(springs.back()) : set.setup.springs.lateral;
  try {
    physics::validate_lever(set.setup.springs);
  } catch (const physics::UnphysicalValue& error) {
    const std::string key = springs.size() > 1 ? std::string(error.field()) : std::string(springs.front());
    table.refuse(key, message_of(error, key));
  }
  add_sources(set, "", values);
}

void read_soft_sample(const TomlTable& top, ParticleSet& set) {
  for (const std::string_view key : {"species", "particle", "target", "pad"}) {
    if (top.has(key)) top.refuse(key, "a soft sample is scratched, and has no particles: leave this or [sample] out");
  }
  read_marking_tip(top.table("tip", "[tip]"), set);
  constexpr std::array<std::string_view, 2> kSprings{"lateral_spring", "normal_spring"};
  read_marking_lever(top.table("lever", "[lever]"), kSprings, set);
  const TomlTable table = top.table("sample", "[sample]");
  table.allow_only({"name", "hardness", "sample_modulus", "sample_poisson_ratio", "tip_modulus", "tip_poisson_ratio",
                    "work_of_adhesion", "pile_up_share"});
  SoftSample soft{.name = table.text("name"), .surface = {}};
  SourcedValues values(table);
  soft.surface.hardness = values.quantity("hardness", physics::kPressureUnits);
  const physics::Elasticity sample{values.quantity("sample_modulus", physics::kPressureUnits),
                                   values.number("sample_poisson_ratio")};
  const physics::Elasticity tip{values.quantity("tip_modulus", physics::kPressureUnits),
                                values.number("tip_poisson_ratio")};
  soft.surface.work_of_adhesion = values.quantity("work_of_adhesion", physics::kSurfaceEnergyUnits);
  soft.surface.pile_up_share = values.number("pile_up_share");
  try {
    soft.surface.reduced_modulus = physics::reduced_modulus(tip, sample);
    physics::validate(soft.surface);
  } catch (const physics::UnphysicalValue& error) {
    table.refuse(error.field(), error.what());
  }
  add_sources(set, "", values);
  set.soft = std::make_shared<const SoftSample>(std::move(soft));
}

void check_soft_moves(const TomlTable& top, const ParticleSet& set) {
  const Length longest = physics::MarkedSurface::longest_side(set.setup.tip);
  const ScratchField field = scratch_field(set);
  const physics::Sideways<Length> size = field.most - field.least;
  if (std::max(size.x, size.y) > longest) {
    top.refuse("move", fmt::format("the hand moves over {} x {}: a tip of {} marks a square of {} at most",
                                   physics::format_quantity(size.x, physics::kLengthUnits, 3),
                                   physics::format_quantity(size.y, physics::kLengthUnits, 3),
                                   physics::format_quantity(set.setup.tip.radius, physics::kLengthUnits, 3),
                                   physics::format_quantity(longest, physics::kLengthUnits, 3)));
  }
  const Force load = largest_load(set);
  if (physics::groove_radius(set.soft->surface, load) > set.setup.tip.radius) {
    top.refuse("move",
               fmt::format("the lever presses with up to {}, for a groove of {}: the model ends at twice the tip's "
                           "radius; press less far down, or with a softer lever",
                           physics::format_quantity(load, physics::kForceUnits, 3),
                           physics::format_quantity(2.0 * physics::groove_radius(set.soft->surface, load),
                                                    physics::kLengthUnits, 3)));
  }
}

}  // namespace afm::scene
