// SPDX-License-Identifier: Apache-2.0
#include "app/commands/species_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "physics/manipulation/island.h"
#include "physics/manipulation/push_figures.h"
#include "physics/manipulation/rod.h"
#include "physics/manipulation/tip_hold.h"
#include "physics/quantity_text.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/scripted_push.h"

namespace afm::app {
namespace {

using physics::Force;
using physics::format_quantity;
using physics::kForceUnits;
using physics::kLengthUnits;
using physics::Length;
using physics::ParticleLaw;
using physics::ParticleSpecies;
using physics::Stiffness;

constexpr Length kAtomicDistance{0.3e-9};  // z0 of Tabor's parameter
constexpr physics::Temperature kRoomTemperature{298.15};
constexpr double kPoorAim = 0.05;  // offset of a poor aim, relative to the distance of the axes

// Figures of a species that a user needs before a push.
struct SpeciesFigures {
  physics::PushBalance rest, moving;
  Force adhesion, gentle, gentle_without_friction, most_push, area_law, amontons_law;
  Stiffness softest, sideways;
  Length rho;
  double tabor = 0.0, kt_per_nm = 0.0, spinning = 0.0;
};

SpeciesFigures figures_of(const scene::ParticleSet& set, const ParticleSpecies& species) {
  const physics::PushSetup& setup = set.setup;
  const Length radius = species.contact.tip_radius;
  const double sine = std::sin(setup.tip.half_angle_rad), cosine = std::cos(setup.tip.half_angle_rad);
  const physics::TipGrip grip = physics::flank_grip(setup.tip, species, setup.tip_friction);
  SpeciesFigures f;
  f.rest = physics::push_balance(species, grip, sine, cosine);
  f.moving = physics::push_balance(species, grip, sine, cosine, species.kinetic_ratio);
  f.adhesion = physics::pull_off_force(species);
  f.gentle = physics::gentle_load(species, setup.tip, setup.tip_friction);
  f.gentle_without_friction = physics::gentle_load(species, setup.tip, 0.0);
  f.most_push = physics::largest_push(setup.tip, radius, setup.springs.normal, Force(0.0));
  f.area_law = physics::sliding_threshold(species, ParticleLaw::ContactArea, Force(0.0));
  f.amontons_law = physics::sliding_threshold(species, ParticleLaw::Amontons, Force(0.0));
  f.softest = physics::softest_lever(species, setup.tip);
  f.sideways = physics::stiffness_sideways(setup.springs, sine, cosine);
  f.rho = physics::side_contact(setup.tip, radius, Length(0.0)).distance;
  f.tabor = physics::tabor_parameter(species, kAtomicDistance);
  f.kt_per_nm = f.rest.lateral * Length(1e-9) / physics::thermal_energy(kRoomTemperature);
  f.spinning = physics::spinning_share(species, Force(0.0));
  return f;
}

// Threshold of an unloaded sphere by a law; a file that lacks the law's number has none.
std::string threshold_text(Force force, std::string_view lacking) {
  return force.si > 0.0 ? format_quantity(force, kForceUnits, 4) : fmt::format("unknown without {}", lacking);
}
nlohmann::json threshold_json(Force force) { return force.si > 0.0 ? nlohmann::json(force.si) : nlohmann::json(); }

std::string force_text(Force force) {
  return std::isfinite(force.si) ? format_quantity(force, kForceUnits, 4) : "none: it jams";
}

// The lever of the file beside the softest one; a sphere that rolls gives to a softer one.
std::string lever_text(Stiffness normal, const SpeciesFigures& f) {
  if (f.most_push >= f.rest.lateral) return fmt::format("pushes up to {}", force_text(f.most_push));
  return fmt::format("of {} rides over it, with at most {}", format_quantity(normal, physics::kStiffnessUnits, 4),
                     force_text(f.most_push));
}

// Figures of rods that a user needs before a push.
struct RodFigures {
  Force middle, end;  // forces at rest
  Length pivot, rho;
  Force most_push;
};

RodFigures rod_figures_of(const scene::ParticleSet& set, const ParticleSpecies& rod) {
  const physics::PushSetup& setup = set.setup;
  const Length radius = rod.contact.tip_radius, at_end = 0.5 * rod.length;
  return {.middle = rod.measured_threshold,
          .end = physics::rod_threshold(rod.measured_threshold, rod.length, at_end),
          .pivot = physics::rod_pivot(rod.length, at_end),
          .rho = physics::side_contact(setup.tip, radius, Length(0.0)).distance,
          .most_push = physics::largest_push(setup.tip, radius, setup.springs.normal, Force(0.0))};
}

std::string sources_text(const scene::SpeciesEntry& entry) {
  const auto estimated = std::count_if(entry.sources.begin(), entry.sources.end(),
                                       [](const scene::SourcedValue& s) { return s.estimated; });
  return fmt::format("  sources              {} of {} values are estimated; --json lists each\n", estimated,
                     entry.sources.size());
}

std::string rod_figures_text(const scene::ParticleSet& set, std::size_t index) {
  const ParticleSpecies& rod = set.setup.species[index];
  const RodFigures f = rod_figures_of(set, rod);
  return fmt::format(
             "{}, rods of {} with a radius of {}, measured friction per length\n"
             "  gives to a push      of {} in the middle, {} at an end; then of {:g} times that\n"
             "  pushed at an end     it turns about a point {} beyond its middle\n"
             "  lever                pushes up to {}\n"
             "  distance of axes     {} at touch\n",
             set.species[index].name, format_quantity(rod.length, kLengthUnits, 4),
             format_quantity(rod.contact.tip_radius, kLengthUnits, 4), format_quantity(f.middle, kForceUnits, 4),
             format_quantity(f.end, kForceUnits, 4), rod.kinetic_ratio, format_quantity(f.pivot, kLengthUnits, 4),
             format_quantity(f.most_push, kForceUnits, 4), format_quantity(f.rho, kLengthUnits, 4)) +
         sources_text(set.species[index]);
}

nlohmann::json rod_figures_json(const scene::ParticleSet& set, const ParticleSpecies& rod) {
  const RodFigures f = rod_figures_of(set, rod);
  return {{"threshold_in_the_middle_N", f.middle.si}, {"threshold_at_an_end_N", f.end.si},
          {"kinetic_ratio", rod.kinetic_ratio},       {"pivot_from_middle_m", f.pivot.si},
          {"largest_push_N", f.most_push.si},         {"distance_of_axes_m", f.rho.si}};
}

// Figures of flat islands that a user needs before a push.
struct IslandFigures {
  Force pushed, turned;  // forces at rest: through the middle, and beside it for a tip that only just sticks
  Length rho, aim, lost;
  double sticks_rad = 0.0;
  Force most_push;
};

IslandFigures island_figures_of(const scene::ParticleSet& set, const ParticleSpecies& island) {
  const physics::PushSetup& setup = set.setup;
  const Length rim = island.contact.tip_radius;
  IslandFigures f;
  f.rho = physics::core_radius(island) + physics::side_contact(setup.tip, rim, Length(0.0)).distance;
  f.pushed = island.measured_threshold;
  f.turned = f.pushed * physics::island_turning_share(setup.tip_friction);
  f.aim = physics::largest_offset(3.0 * physics::kIslandTurning) * f.rho;
  f.lost = physics::island_travel_until_lost(kPoorAim, setup.tip_friction) * f.rho;
  f.sticks_rad = physics::largest_sticking_angle(setup.tip_friction);
  f.most_push = physics::largest_push(setup.tip, rim, setup.springs.normal, Force(0.0));
  return f;
}

std::string island_figures_text(const scene::ParticleSet& set, std::size_t index) {
  const ParticleSpecies& island = set.setup.species[index];
  const IslandFigures f = island_figures_of(set, island);
  return fmt::format(
             "{}, flat islands with a radius of {}, {} high, shear strength {}\n"
             "  gives to a push      of {} through its middle, {} beside it; then of {:g} times that\n"
             "  beside the middle    tip and rim stick up to {:.1f} deg; the island turns, by {:.3g} of a sphere's "
             "rate\n"
             "  lever                pushes up to {}\n"
             "  aim                  {} beside the middle for a push of 3 x {}; from {:g} of it, lost after {}\n",
             set.species[index].name, format_quantity(island.island_radius, kLengthUnits, 4),
             format_quantity(2.0 * island.contact.tip_radius, kLengthUnits, 4),
             format_quantity(island.shear_strength, physics::kPressureUnits, 4),
             format_quantity(f.pushed, kForceUnits, 4), format_quantity(f.turned, kForceUnits, 4), island.kinetic_ratio,
             f.sticks_rad * 180.0 / std::numbers::pi, physics::kIslandTurning,
             format_quantity(f.most_push, kForceUnits, 4), format_quantity(f.aim, kLengthUnits, 4),
             format_quantity(f.rho, kLengthUnits, 4), kPoorAim, format_quantity(f.lost, kLengthUnits, 4)) +
         sources_text(set.species[index]);
}

nlohmann::json island_figures_json(const scene::ParticleSet& set, const ParticleSpecies& island) {
  const IslandFigures f = island_figures_of(set, island);
  return {{"threshold_through_the_middle_N", f.pushed.si},
          {"threshold_beside_the_middle_N", f.turned.si},
          {"kinetic_ratio", island.kinetic_ratio},
          {"sticks_up_to_rad", f.sticks_rad},
          {"turning_share", physics::kIslandTurning},
          {"distance_of_axes_m", f.rho.si},
          {"largest_offset_for_3_distances_m", f.aim.si},
          {"travel_until_lost_from_0.05_m", f.lost.si},
          {"largest_push_N", f.most_push.si}};
}

// Adhesion of the tip: where a contact on the flank or on the cap tears, and at what loss.
std::string hold_text(const scene::ParticleSet& set, const ParticleSpecies& species) {
  const physics::SphereCone& tip = set.setup.tip;
  return fmt::format(
      "  tip adhesion         tears away at {} on the flank, {} on top; a tip that moves away {} it\n"
      "  lifted               by a tip adhesion above {}: this one {}\n",
      format_quantity(physics::tip_pull_off(tip, species, true), kForceUnits, 4),
      format_quantity(physics::tip_pull_off(tip, species, false), kForceUnits, 4),
      physics::follows_tip(tip, species) ? "drags" : "leaves",
      format_quantity(physics::lifting_adhesion(tip, species), physics::kSurfaceEnergyUnits, 4),
      physics::lifts(tip, species) ? "lifts it, from the top" : "does not");
}

nlohmann::json hold_json(const scene::ParticleSet& set, const ParticleSpecies& species) {
  if (!species.sticks) return {};
  const physics::SphereCone& tip = set.setup.tip;
  const double sine = std::sin(tip.half_angle_rad), cosine = std::cos(tip.half_angle_rad);
  const Force pull = physics::tip_pull_off(tip, species, true);
  const Stiffness spring = physics::stiffness_along_normal(set.setup.springs, sine, cosine);
  return {{"pull_off_on_flank_N", pull.si},
          {"pull_off_on_top_N", physics::tip_pull_off(tip, species, false).si},
          {"lateral_pull_N", (pull * cosine).si},
          {"drags", physics::follows_tip(tip, species)},
          {"tear_J", physics::tear_energy(pull, spring).si},
          {"lifted_from_J_per_m2", physics::lifting_adhesion(tip, species).si},
          {"lifts", physics::lifts(tip, species)}};
}

}  // namespace

std::string species_figures_text(const scene::ParticleSet& set, std::size_t index) {
  const ParticleSpecies& species = set.setup.species[index];
  if (physics::is_rod(species)) return rod_figures_text(set, index);
  if (physics::is_island(species)) return island_figures_text(set, index);
  const SpeciesFigures f = figures_of(set, species);
  const std::string gentle = f.gentle.si > 0.0 ? format_quantity(f.gentle, kForceUnits, 4)
                                               : fmt::format(
                                                     "none: the tip's friction locks it on the flank; without "
                                                     "friction {}",
                                                     format_quantity(f.gentle_without_friction, kForceUnits, 4));
  const std::string text = fmt::format(
      "{}, law {} ({})\n"
      "  adhesion             {}\n"
      "  gives sideways at    {}, then {}: {}\n"
      "  unloaded, by law     area {}, amontons {}\n"
      "  gentle load          {}\n"
      "  softest lever        {}; this one {}\n"
      "  aim                  {} beside the middle for a push of 3 x {}\n"
      "  steering hand        up to {} on the sample\n"
      "  unit of pushing      {:.3g} kT per nm at room temperature\n",
      set.species[index].name, physics::text_of(species.law).word, physics::text_of(species.law).formula,
      format_quantity(f.adhesion, kForceUnits, 4), force_text(f.rest.lateral), force_text(f.moving.lateral),
      physics::kPushModes.at(static_cast<std::size_t>(f.rest.mode)).word,
      threshold_text(f.area_law, "a shear_strength"), threshold_text(f.amontons_law, "a coefficient"), gentle,
      format_quantity(f.softest, physics::kStiffnessUnits, 4), lever_text(set.setup.springs.normal, f),
      format_quantity(physics::largest_offset(3.0) * f.rho, kLengthUnits, 4), format_quantity(f.rho, kLengthUnits, 4),
      format_quantity(physics::fastest_steering(f.rho, physics::kSteeringDelay), physics::kVelocityUnits, 4),
      f.kt_per_nm);
  return text + (species.sticks ? hold_text(set, species) : "") + sources_text(set.species[index]);
}

nlohmann::json species_figures_json(const scene::ParticleSet& set, std::size_t index) {
  if (physics::is_rod(set.setup.species[index])) return rod_figures_json(set, set.setup.species[index]);
  if (physics::is_island(set.setup.species[index])) return island_figures_json(set, set.setup.species[index]);
  const SpeciesFigures f = figures_of(set, set.setup.species[index]);
  nlohmann::json json{{"push_mode", physics::kPushModes.at(static_cast<std::size_t>(f.rest.mode)).word},
                      {"adhesion_N", f.adhesion.si},
                      {"threshold_at_rest_N", f.rest.lateral.si},
                      {"threshold_moving_N", f.moving.lateral.si},
                      {"normal_at_rest_N", f.rest.normal.si},
                      {"lift_at_rest_N", f.rest.lift.si},
                      {"unloaded_threshold_by_area_N", threshold_json(f.area_law)},
                      {"unloaded_threshold_by_amontons_N", threshold_json(f.amontons_law)},
                      {"gentle_load_N", f.gentle.si},
                      {"gentle_load_without_tip_friction_N", f.gentle_without_friction.si},
                      {"softest_lever_N_per_m", f.softest.si},
                      {"largest_push_N", f.most_push.si},
                      {"stiffness_sideways_N_per_m", f.sideways.si},
                      {"distance_of_axes_m", f.rho.si},
                      {"largest_offset_for_3_distances_m", (physics::largest_offset(3.0) * f.rho).si},
                      {"fastest_steering_m_per_s", physics::fastest_steering(f.rho, physics::kSteeringDelay).si},
                      {"tabor_parameter", f.tabor},
                      {"spinning_moment_share", f.spinning},
                      {"kT_per_nm", f.kt_per_nm}};
  json["tip_adhesion"] = hold_json(set, set.setup.species[index]);
  return json;
}

std::string picture_text(const scene::PushScript& script, const scene::ScriptedPush& played) {
  if (!played.picture) return "";
  const physics::OperatorsPicture& picture = *played.picture;
  std::size_t pushed = 0, stale = 0;
  for (std::size_t i = 0; i < picture.shown().size(); ++i) {
    pushed += picture.is_measured(i) ? 0U : 1U;
    stale += picture.is_stale(i) ? 1U : 0U;
  }
  std::string text = fmt::format(
      "\npicture, level {}: {} of {} pixels computed; particles not measured since a push: {}, stale: {}\n",
      script.level, picture.picture().computed(), picture.picture().heights().height_m.size(), pushed, stale);
  for (const physics::SecondLook& look : picture.looks()) {
    const std::string what =
        look.measured ? format_quantity(magnitude(look.measured->position - look.shown.position), kLengthUnits, 3) +
                            " from its place in the picture"
                      : "not found";
    text += fmt::format("second look at {:.1f} s, {} lines: particle {} {}\n", look.at.si, look.lines,
                        look.particle + 1, what);
  }
  if (script.level > 1) {
    text += fmt::format("the sample has drifted by {}, at 0.05 nm/s (order of magnitude, estimated)\n",
                        format_quantity(magnitude(played.drift), kLengthUnits, 3));
  }
  return text;
}

nlohmann::json picture_json(const scene::PushScript& script, const scene::ScriptedPush& played) {
  if (!played.picture) return nullptr;
  const physics::OperatorsPicture& picture = *played.picture;
  const physics::HeightGrid& grid = picture.picture().heights();
  const auto place = [](const physics::ParticlePlace& p) { return nlohmann::json{p.position.x.si, p.position.y.si}; };
  nlohmann::json particles = nlohmann::json::array(), looks = nlohmann::json::array();
  for (std::size_t i = 0; i < picture.shown().size(); ++i) {
    particles.push_back({{"shown_m", place(picture.shown()[i])},
                         {"measured", picture.is_measured(i)},
                         {"age_s", picture.age(i).si},
                         {"doubt_m", picture.doubt().after(picture.age(i)).si},
                         {"stale", picture.is_stale(i)}});
  }
  for (const physics::SecondLook& look : picture.looks()) {
    nlohmann::json json{{"time_s", look.at.si},         {"lines", look.lines},   {"particle", look.particle},
                        {"shown_m", place(look.shown)}, {"measured_m", nullptr}, {"difference_m", nullptr}};
    if (look.measured) {
      json["measured_m"] = place(*look.measured);
      json["difference_m"] = magnitude(look.measured->position - look.shown.position).si;
    }
    looks.push_back(std::move(json));
  }
  return {{"level", script.level},
          {"seed", script.seed},
          {"drift_m", {played.drift.x.si, played.drift.y.si}},
          {"pixel_m", grid.column_step_m},
          {"columns", grid.columns},
          {"rows", grid.rows},
          {"computed_pixels", picture.picture().computed()},
          {"particles", particles},
          {"looks", looks}};
}

}  // namespace afm::app
