// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/species_figures.h"
#include "app/commands/task_figures.h"
#include "app/options/command.h"
#include "app/options/quantity_option.h"
#include "app/options/standard_output.h"
#include "core/file_names.h"
#include "core/json_text.h"
#include "core/whole_file.h"
#include "core/written_by.h"
#include "curves/image_output.h"
#include "exhibit/report/ink_report.h"
#include "exhibit/report/scratch_report.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/quantity_text.h"
#include "scene/samples/hand_script.h"
#include "scene/samples/ink_run.h"
#include "scene/samples/particle_files.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/pattern_state.h"
#include "scene/samples/pattern_task.h"
#include "scene/samples/scratch_run.h"
#include "scene/samples/scripted_push.h"

namespace afm::app {
namespace {

using physics::format_quantity;
using physics::Frequency;
using physics::kEnergyUnits;
using physics::kForceUnits;
using physics::kLengthUnits;
using physics::Length;
using physics::ParticlePlace;
using physics::ParticleSpecies;
using physics::PushTick;
using physics::Sideways;

constexpr Frequency kSlowestTicks{10.0}, kFastestTicks{1e5};
constexpr double kMostTicks = 2e7;   // some minutes
constexpr double kRounding = 1e-12;  // fraction of the given energy that the certificate may lack

struct ParticlesOptions {
  std::string file;
  scene::PushScript script;
  std::string out;
  bool json = false;
};

nlohmann::json json_of(const scene::PushMoment& sample) {
  const PushTick& t = sample.tick;
  return {{"time_s", sample.time_s},
          {"base_m", {t.base.position.x.si, t.base.position.y.si, t.base.z.si}},
          {"apex_m", {t.apex.position.x.si, t.apex.position.y.si, t.apex.z.si}},
          {"lateral_N", {t.lateral.x.si, t.lateral.y.si}},
          {"lift_N", t.lift.si},
          {"particle", t.particle == physics::kNoParticle ? nlohmann::json() : nlohmann::json(t.particle)},
          {"state", physics::kPushStates.at(static_cast<std::size_t>(t.state)).word},
          {"normal_N", t.normal.si},
          {"threshold_N", t.threshold.si},
          {"given_J", t.given.si},
          {"work_J", t.work.si},
          {"lost_J", t.lost.si},
          {"stored_J", t.stored.si},
          {"certificate_J", scene::margin_j(t)},
          {"yields", t.yields},
          {"attached", t.attached},
          {"dragged", t.dragged},
          {"dragged_at_N", t.dragged_at.si},
          {"torn", t.torn},
          {"torn_at_N", t.torn_at.si},
          {"torn_lost_J", t.torn_lost.si},
          {"lifted", t.lifted},
          {"lifted_at_N", t.lifted_at.si},
          {"set_down", t.set_down}};
}

nlohmann::json json_of(const scene::PatternState& pattern, bool judged) {
  return {{"particle_of_target", pattern.match.particles},
          {"rms_m", pattern.match.rms.si},
          {"allowed_m", pattern.pads > 0 ? nlohmann::json() : nlohmann::json(pattern.allowed.si)},
          {"pads", pattern.pads},
          {"pads_touched", pattern.touched},
          {"judged", judged},
          {"done", judged && pattern.done()}};
}

nlohmann::json particle_json(const scene::ParticleSet& set, std::size_t i, const ParticlePlace& end) {
  const physics::PlacedParticle& start = set.particles[i];
  nlohmann::json json{{"species", set.species[start.species].name},
                      {"start_m", {start.position.x.si, start.position.y.si}},
                      {"end_m", {end.position.x.si, end.position.y.si}},
                      {"pinned", start.pinned}};
  if (physics::turns_flat(set.setup.species[start.species])) {
    json["start_angle_rad"] = start.angle_rad;
    json["end_angle_rad"] = physics::angle_rad(end.turn);
  }
  return json;
}

std::string particles_json(const scene::ParticleSet& set, const ParticlesOptions& options,
                           const scene::ScriptedPush& played) {
  nlohmann::json species = nlohmann::json::array(), particles = nlohmann::json::array();
  for (std::size_t i = 0; i < set.species.size(); ++i) {
    const ParticleSpecies& s = set.setup.species[i];
    species.push_back(
        {{"name", set.species[i].name},
         {"law", physics::text_of(s.law).word},
         {"radius_m", s.contact.tip_radius.si},
         {"length_m", physics::is_rod(s) ? nlohmann::json(s.length.si) : nlohmann::json()},
         {"island_radius_m", physics::is_island(s) ? nlohmann::json(s.island_radius.si) : nlohmann::json()},
         {"figures", species_figures_json(set, i)},
         {"sources", exhibit::sources_json(set.species[i].sources)}});
  }
  for (std::size_t i = 0; i < set.particles.size(); ++i) particles.push_back(particle_json(set, i, played.at[i]));
  const auto list = [](const std::vector<scene::PushMoment>& samples) {
    nlohmann::json all = nlohmann::json::array();
    for (const scene::PushMoment& sample : samples) all.push_back(json_of(sample));
    return all;
  };
  nlohmann::json targets = nlohmann::json::array();
  for (const ParticlePlace& target : set.targets) targets.push_back({target.position.x.si, target.position.y.si});
  const auto pattern = scene::pattern_state(set, scene::pattern_of(set), played.judged_places());
  nlohmann::json whole{{"title", set.title},
                       {"medium", set.medium},
                       {"note", set.note},
                       {"rate_Hz", options.script.rate.si},
                       {"seconds", played.seconds},
                       {"ticks", played.ticks},
                       {"lagging_ticks", played.lagging},
                       {"exhausted_ticks", played.ends.back().tick.exhausted},
                       {"least_certificate_J", played.least_margin_j},
                       {"sources", exhibit::sources_json(set.sources)},
                       {"species", species},
                       {"particles", particles},
                       {"targets_m", targets},
                       {"pattern", pattern ? json_of(*pattern, played.judged()) : nlohmann::json()},
                       {"task", task_json(played.score)},
                       {"picture", picture_json(options.script, played)},
                       {"states", list(played.samples)},
                       {"changes", list(played.changes)},
                       {"all_changes", !played.more_changes},
                       {"moves", list(played.ends)}};
  core::name_software(whole);
  return core::json_text(whole) + "\n";
}

const char* plural(std::size_t count) { return count == 1 ? "" : "s"; }

// Text with energy, adhesion and faults, over all moves.
std::string energy_text(const scene::ScriptedPush& played) {
  const PushTick& last = played.ends.back().tick;
  // below what rounding leaves of sums, nothing is stored
  const physics::Energy stored = last.stored.si > kRounding * last.given.si ? last.stored : physics::Energy(0.0);
  std::string text = fmt::format(
      "\nenergy: {} of work by the hand, {} lost, {} stored; slips: {}\n", format_quantity(last.work, kEnergyUnits, 4),
      format_quantity(last.lost, kEnergyUnits, 4), format_quantity(stored, kEnergyUnits, 4), last.yields);
  const physics::Energy begun = played.samples.front().tick.stored;
  if (begun.si > kRounding * last.given.si) {
    text +=
        fmt::format("{} were stored at the start, where the lever is bent\n", format_quantity(begun, kEnergyUnits, 4));
  }
  const physics::Energy spent = begun + last.work, rest = spent - last.lost - stored;
  if (rest.si > 0.01 * spent.si) {
    text += fmt::format("{} more was lost in jumps of the tip\n", format_quantity(rest, kEnergyUnits, 4));
  }
  if (last.attached > 0) {
    text +=
        fmt::format("tip adhesion: held {} time{}, dragged {}, tore {}, with a loss of {}\n", last.attached,
                    plural(last.attached), last.dragged, last.torn, format_quantity(last.torn_lost, kEnergyUnits, 4));
  }
  if (last.lifted > 0) {
    text += fmt::format("on the tip: lifted {} time{}, set down {} time{}\n", last.lifted, plural(last.lifted),
                        last.set_down, plural(last.set_down));
  }
  if (played.lagging > 0) text += fmt::format("{} ticks lagged behind the hand: it was too fast\n", played.lagging);
  if (last.exhausted > 0) text += fmt::format("{} ticks ended before all particles were at rest\n", last.exhausted);
  return text;
}

std::string particles_text(const scene::ParticleSet& set, const ParticlesOptions& options,
                           const scene::ScriptedPush& played) {
  std::string text =
      fmt::format("{}, in {}: {} particle{}, {:g} s at {:g} Hz\n", set.title, set.medium, set.particles.size(),
                  plural(set.particles.size()), played.seconds, options.script.rate.si);
  for (std::size_t i = 0; i < set.species.size(); ++i) text += species_figures_text(set, i);
  text += "\nmove       state     particle   force on the lever sideways   friction and slips\n";
  for (std::size_t i = 0; i < played.ends.size(); ++i) {
    const PushTick& t = played.ends[i].tick;
    text += fmt::format(
        "{:<10} {:<9} {:<10} {:<29} {}\n", i + 1, physics::kPushStates.at(static_cast<std::size_t>(t.state)).word,
        t.particle == physics::kNoParticle ? "-" : fmt::format("{}", t.particle + 1),
        format_quantity(magnitude(t.lateral), kForceUnits, 4), format_quantity(t.lost, kEnergyUnits, 4));
  }
  const auto stays = [&](std::size_t i) {
    return !(magnitude(played.at[i].position - set.particles[i].position).si > 0.0);
  };
  bool any = false;
  for (std::size_t i = 0; i < played.at.size(); ++i) {
    const auto& [to, turn] = played.at[i];
    if (stays(i)) continue;
    if (!std::exchange(any, true)) text += "\nparticle   moved by     to\n";
    const Length way = magnitude(to - set.particles[i].position);
    const bool turns = physics::turns_flat(set.setup.species[set.particles[i].species]);
    text +=
        fmt::format("{:<10} {:<12} {}, {}{}\n", i + 1, format_quantity(way, kLengthUnits, 4),
                    format_quantity(to.x, kLengthUnits), format_quantity(to.y, kLengthUnits),
                    turns ? fmt::format(" at {:.1f} deg", physics::angle_rad(turn) * 180.0 / std::numbers::pi) : "");
  }
  if (!any) text += "\nno particle has moved\n";
  const auto pattern =
      set.blind ? std::nullopt : scene::pattern_state(set, scene::pattern_of(set), played.judged_places());
  if (pattern) {
    text += fmt::format("\npattern of {} target{}: {}, {} off in the root mean square, {}\n", set.targets.size(),
                        plural(set.targets.size()),
                        !played.judged()  ? "not looked at since the last push"
                        : pattern->done() ? "done"
                                          : "not done",
                        format_quantity(pattern->match.rms, kLengthUnits, 4),
                        pattern->pads > 0 ? fmt::format("{} of {} pads touched", pattern->touched, pattern->pads)
                                          : format_quantity(pattern->allowed, kLengthUnits, 4) + " allowed");
  }
  if (scene::has_task(set) && played.score.state != scene::TaskState::NotBegun) {
    text += fmt::format("{}: {}\n", set.blind ? "\ntask without the picture" : "task of the pattern",
                        scene::text_of(played.score));
  }
  text += picture_text(options.script, played);
  return text + energy_text(played);
}

// Fails if the hand has gained energy.
core::Result<void> certified(double least_margin_j, physics::Energy given, const std::string& path) {
  if (least_margin_j >= -kRounding * std::abs(given.si)) return {};
  return core::failure(
      core::ErrorCategory::Failed,
      fmt::format("the hand gained {:.3g} J from {}: a defect of TouchAFM, please report it", -least_margin_j, path));
}

core::Result<void> run_scratch(const scene::ParticleSet& set, const ParticlesOptions& options,
                               const std::string& path) {
  const auto run = scene::play_scratch(set, options.script.rate, static_cast<std::size_t>(options.script.samples));
  auto written = options.json ? write_stdout(exhibit::scratch_json(set, run, options.script.rate))
                              : write_report(exhibit::scratch_text(set, run, options.script.rate));
  if (!written) return written;
  if (!options.out.empty()) written = core::write_file(options.out, curves::gwy_bytes(run.image));
  if (!written) return written;
  return certified(run.least_margin_j, run.moves.back().end.tick.given, path);
}

core::Result<void> run_ink(const scene::ParticleSet& set, const ParticlesOptions& options) {
  const scene::InkRun run = scene::play_ink(set, options.script.rate);
  auto written = write_stdout((options.json ? exhibit::ink_json : exhibit::ink_text)(set, run, options.script.rate));
  if (!written || options.out.empty()) return written;
  return core::write_file(options.out, curves::gwy_bytes(run.image));
}

core::Result<void> run_particles(const ParticlesOptions& options, const std::string& assets_dir) {
  const auto path = scene::particle_file(options.file, assets_dir);
  if (!path) return tl::unexpected(path.error());
  const auto set = scene::load_particle_set(*path);
  if (!set) return tl::unexpected(set.error());
  if (!options.out.empty() && !((set->soft || set->ink) && core::has_ending(options.out, ".gwy"))) {
    return core::wrong_usage("--out: takes the image of a soft sample or of ink, in a file that ends in .gwy");
  }
  const bool has_islands = std::any_of(set->setup.species.begin(), set->setup.species.end(), physics::is_island);
  if (options.script.level > 0 && (set->soft || set->ink || has_islands)) {
    return core::wrong_usage(fmt::format("--level {}: only spheres and rods have a picture that grows old; {} has {}",
                                         options.script.level, *path,
                                         set->soft  ? "a soft sample"
                                         : set->ink ? "ink"
                                                    : "flat islands"));
  }
  const double ticks = scene::all_ticks(*set, options.script.rate);
  if (ticks > kMostTicks) {
    return core::wrong_usage(
        fmt::format("the moves of {} take {:.0f} s, which are {:.3g} ticks at {:g} Hz, more than {:.3g}: lower --rate, "
                    "or raise the speeds",
                    *path, ticks / options.script.rate.si, ticks, options.script.rate.si, kMostTicks));
  }
  if (set->soft) return run_scratch(*set, options, *path);
  if (set->ink) return run_ink(*set, options);
  const scene::ScriptedPush played = scene::play(*set, options.script);
  auto written = options.json ? write_stdout(particles_json(*set, options, played))
                              : write_report(particles_text(*set, options, played));
  if (!written) return written;
  return certified(played.least_margin_j, played.ends.back().tick.given, *path);
}

}  // namespace

void add_particles_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command("particles",
                                           "push particles on a sample, scratch it, or write on it with ink, with a "
                                           "scripted tip, without a window, and print "
                                           "forces and places");
  const auto options = std::make_shared<ParticlesOptions>();
  command
      .add_option(
          "file", options->file,
          "particle file (TOML) with particles, tip, lever and the moves of the hand; or the name of a built-in set, "
          "such as gold-row")
      .required()
      .type_name("FILE");
  quantity_option(
      command, "--rate", [options](Frequency rate) { options->script.rate = rate; }, physics::kFrequencyUnits,
      "ticks per second, like the servo's", std::optional(QuantityRange<Frequency>{kSlowestTicks, kFastestTicks}))
      .show_default("1kHz");
  command.add_option("--samples", options->script.samples, "number of states that --json prints, evenly spaced in time")
      .type_name("NUMBER")
      .within(2, 1'000'000)
      .show_default();
  command
      .add_option(
          "--level", options->script.level,
          "how far picture and particles are apart: 0, the particles are seen; 1, the picture is computed after "
          "each push; 2, the sample drifts and pull-offs scatter, too")
      .within(0, 2)
      .show_default();
  command
      .add_option("--seed", options->script.seed, "with --level 2: choice of the drift's direction and of the scatter")
      .type_name("NUMBER")
      .within(1, 65535)
      .show_default();
  command.add_flag(
      "--no-look", [options] { options->script.looks = false; },
      "with --level 1 or 2: the hand never looks again at what it has pushed");
  command.add_flag("--json", options->json,
                   "print figures, sources, states, events and final places as JSON, with the unit in each key");
  command
      .add_option("--out", options->out, "write the scratched or inked sample to FILE, an image of its heights (.gwy)")
      .writable_file()
      .type_name("FILE");
  command.footer(
      "example: touchafm particles gold-row\n"
      "         touchafm particles scratch-pmma --out scratch.gwy\n"
      "         touchafm particles write-ink\n"
      "         touchafm particles my-set.toml --json --rate 4kHz --samples 1000\n"
      "The exit code is 1 if the hand gained energy, which would be a fault of the program.");
  command.when_chosen([options, &context] { return run_particles(*options, context.assets_dir); });
}

}  // namespace afm::app
