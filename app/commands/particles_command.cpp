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
#include "core/whole_file.h"
#include "curves/image_output.h"
#include "exhibit/report/scratch_report.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/manipulation/tip_meeting.h"
#include "physics/quantity_text.h"
#include "scene/samples/hand_script.h"
#include "scene/samples/particle_files.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/pattern_state.h"
#include "scene/samples/pattern_task.h"
#include "scene/samples/scratch_run.h"

namespace afm::app {
namespace {

using physics::format_quantity;
using physics::Frequency;
using physics::kEnergyUnits;
using physics::kForceUnits;
using physics::kLengthUnits;
using physics::Length;
using physics::LeverBase;
using physics::ParticlePlace;
using physics::ParticleSpecies;
using physics::PushTick;
using physics::Sideways;

constexpr Frequency kSlowestTicks{10.0}, kFastestTicks{1e5};
constexpr double kMostTicks = 2e7;  // some minutes
constexpr std::size_t kMostChanges = 10'000;
constexpr double kRounding = 1e-12;  // share of the energy given that the certificate may lack

struct ParticlesOptions {
  std::string file;
  Frequency rate{1000.0};
  std::string out;
  int samples = 100;
  bool json = false;
};

// One tick that is printed.
struct TickSample {
  double time_s = 0.0;
  PushTick tick;
};

struct Played {
  double seconds = 0.0;
  std::size_t ticks = 0, lagging = 0;
  double least_margin_j = 0.0;  // least certificate of all ticks
  bool more_changes = false;
  std::vector<TickSample> samples;  // evenly in time, with the last
  std::vector<TickSample> changes;  // ticks in which state or particle changes
  std::vector<TickSample> ends;     // end of each move
  std::vector<ParticlePlace> at;    // places of the particles at the end
  scene::TaskScore score;           // only for a set with a pattern
};

double margin_j(const PushTick& tick) { return (tick.given - tick.lost - tick.stored).si; }

std::vector<ParticlePlace> places_of(const physics::PushedParticles& particles) {
  std::vector<ParticlePlace> places;
  places.reserve(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) places.push_back({particles.position(i), particles.turn(i)});
  return places;
}

// Keeps the score of the scripted hand, as a live window does that of a person, except that a touch too weak to be felt
// (FeltParticles::kFeltN) can end in a loss, too.
class ScriptedTask {
 public:
  explicit ScriptedTask(const scene::ParticleSet& set)
      : normal_n_per_m_(set.setup.springs.normal.si), task_(set, scene::pattern_of(set)), meeting_(set.setup) {
    meeting_.begin(set.start);
  }

  void follow(const physics::PushedParticles& particles, double time_s) {
    const PushTick& tick = particles.last();
    const auto events = meeting_.follow(particles, tick.normal.si != 0.0);
    for (const auto& event : events.all()) task_.add(event.kind);
    if (!particles.moved().empty()) ++places_;
    add(particles, time_s);
  }

  // The hand stays where its last move ended, as long as it takes to end the task.
  scene::TaskScore end(const physics::PushedParticles& particles, double time_s) {
    const scene::TaskScore ended = task_.score();
    add(particles, time_s + 1e-9 * static_cast<double>(scene::PatternTask::kRestNs));
    return task_.score().state == scene::TaskState::Done ? task_.score() : ended;
  }

 private:
  void add(const physics::PushedParticles& particles, double time_s) {
    const PushTick& tick = particles.last();
    const bool touches = tick.particle != physics::kNoParticle;
    // of the particles alone, without what a lever that presses on the bare sample would have
    const double lift_n = tick.lift.si + normal_n_per_m_ * std::min(0.0, tick.base.z.si);
    const auto lateral = touches ? tick.lateral : Sideways<physics::Force>{};
    task_.add({.time_ns = std::llround(1e9 * time_s),
               .base_m = {tick.base.position.x.si, tick.base.position.y.si, tick.base.z.si},
               .lateral_n = {lateral.x.si, lateral.y.si},
               .lift_n = touches ? lift_n : 0.0,
               .places = places_,
               .carries = tick.state == physics::PushState::Carried});
    if (task_.unjudged()) task_.judge(places_of(particles));
  }

  double normal_n_per_m_;
  scene::PatternTask task_;
  physics::TipMeeting meeting_;
  std::uint64_t places_ = 0;
};

Played play(const scene::ParticleSet& set, const ParticlesOptions& options, std::size_t all_ticks) {
  physics::PushedParticles particles(set.setup, set.particles, set.start);
  Played played;
  std::optional<ScriptedTask> task;
  if (!set.targets.empty()) task.emplace(set);
  const double period_s = 1.0 / options.rate.si;
  const auto sample_count = static_cast<std::size_t>(options.samples);
  TickSample now{0.0, particles.last()};
  played.samples.push_back(now);
  played.least_margin_j = margin_j(now.tick);
  LeverBase from = set.start;
  for (const scene::HandMove& move : set.moves) {
    const std::size_t ticks = scene::ticks_of(from, move, options.rate);
    for (std::size_t i = 1; i <= ticks; ++i) {
      const PushTick before = now.tick;
      const double share = static_cast<double>(i) / static_cast<double>(ticks);
      now.tick =
          particles.move_to(i == ticks ? move.to : scene::on_the_way(from, move.to, share), physics::Time(period_s));
      now.time_s = static_cast<double>(++played.ticks) * period_s;
      if (task) task->follow(particles, now.time_s);
      if (now.tick.lagging) ++played.lagging;
      played.least_margin_j = std::min(played.least_margin_j, margin_j(now.tick));
      if (now.tick.state != before.state || now.tick.particle != before.particle) {
        played.more_changes = played.changes.size() == kMostChanges;
        if (!played.more_changes) played.changes.push_back(now);
      }
      // the sample of this tick: the k-th of N is the tick k/(N - 1) of the way
      if (played.ticks * (sample_count - 1) >= played.samples.size() * all_ticks) played.samples.push_back(now);
    }
    played.ends.push_back(now);
    from = move.to;
  }
  played.seconds = now.time_s;
  if (task) played.score = task->end(particles, played.seconds);
  played.at = places_of(particles);
  return played;
}

nlohmann::json json_of(const TickSample& sample) {
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
          {"certificate_J", margin_j(t)},
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

nlohmann::json json_of(const scene::PatternState& pattern) {
  return {{"particle_of_target", pattern.match.particles},
          {"rms_m", pattern.match.rms.si},
          {"allowed_m", pattern.pads > 0 ? nlohmann::json() : nlohmann::json(pattern.allowed.si)},
          {"pads", pattern.pads},
          {"pads_touched", pattern.touched},
          {"done", pattern.done()}};
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

std::string particles_json(const scene::ParticleSet& set, const ParticlesOptions& options, const Played& played) {
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
  const auto list = [](const std::vector<TickSample>& samples) {
    nlohmann::json all = nlohmann::json::array();
    for (const TickSample& sample : samples) all.push_back(json_of(sample));
    return all;
  };
  nlohmann::json targets = nlohmann::json::array();
  for (const ParticlePlace& target : set.targets) targets.push_back({target.position.x.si, target.position.y.si});
  const auto pattern = scene::pattern_state(set, scene::pattern_of(set), played.at);
  const nlohmann::json whole{{"title", set.title},
                             {"medium", set.medium},
                             {"note", set.note},
                             {"rate_Hz", options.rate.si},
                             {"seconds", played.seconds},
                             {"ticks", played.ticks},
                             {"lagging_ticks", played.lagging},
                             {"exhausted_ticks", played.ends.back().tick.exhausted},
                             {"least_certificate_J", played.least_margin_j},
                             {"sources", exhibit::sources_json(set.sources)},
                             {"species", species},
                             {"particles", particles},
                             {"targets_m", targets},
                             {"pattern", pattern ? json_of(*pattern) : nlohmann::json()},
                             {"task", task_json(played.score)},
                             {"states", list(played.samples)},
                             {"changes", list(played.changes)},
                             {"all_changes", !played.more_changes},
                             {"moves", list(played.ends)}};
  return whole.dump() + "\n";
}

const char* plural(std::size_t count) { return count == 1 ? "" : "s"; }

std::string particles_text(const scene::ParticleSet& set, const ParticlesOptions& options, const Played& played) {
  std::string text = fmt::format("{}, in {}: {} particle{}, {:g} s at {:g} Hz\n", set.title, set.medium,
                                 set.particles.size(), plural(set.particles.size()), played.seconds, options.rate.si);
  for (std::size_t i = 0; i < set.species.size(); ++i) text += species_figures_text(set, i);
  text += "\nmove       state     particle   force on the lever sideways   friction and slips\n";
  for (std::size_t i = 0; i < played.ends.size(); ++i) {
    const PushTick& t = played.ends[i].tick;
    text += fmt::format(
        "{:<10} {:<9} {:<10} {:<29} {}\n", i + 1, physics::kPushStates.at(static_cast<std::size_t>(t.state)).word,
        t.particle == physics::kNoParticle ? "-" : fmt::format("{}", t.particle),
        format_quantity(magnitude(t.lateral), kForceUnits, 4), format_quantity(t.lost, kEnergyUnits, 4));
  }
  text += "\nparticle   moved by     to\n";
  for (std::size_t i = 0; i < played.at.size(); ++i) {
    const auto& [to, turn] = played.at[i];
    const Length way = magnitude(to - set.particles[i].position);
    if (!(way.si > 0.0)) continue;
    const bool turns = physics::turns_flat(set.setup.species[set.particles[i].species]);
    text +=
        fmt::format("{:<10} {:<12} {}, {}{}\n", i, format_quantity(way, kLengthUnits, 4),
                    format_quantity(to.x, kLengthUnits), format_quantity(to.y, kLengthUnits),
                    turns ? fmt::format(" at {:.1f} deg", physics::angle_rad(turn) * 180.0 / std::numbers::pi) : "");
  }
  if (const auto pattern = scene::pattern_state(set, scene::pattern_of(set), played.at)) {
    text += fmt::format("\npattern of {} target{}: {}, {} off in the root mean square, {}\n", set.targets.size(),
                        plural(set.targets.size()), pattern->done() ? "done" : "not done",
                        format_quantity(pattern->match.rms, kLengthUnits, 4),
                        pattern->pads > 0 ? fmt::format("{} of {} pads touched", pattern->touched, pattern->pads)
                                          : format_quantity(pattern->allowed, kLengthUnits, 4) + " allowed");
    if (played.score.state != scene::TaskState::NotBegun) {
      text += fmt::format("task of the pattern: {}\n", scene::text_of(played.score));
    }
  }
  const PushTick& last = played.ends.back().tick;
  // below what rounding leaves of sums, nothing is stored
  const physics::Energy stored = last.stored.si > kRounding * last.given.si ? last.stored : physics::Energy(0.0);
  text += fmt::format("\nenergy: {} of work by the hand, {} lost, {} stored; slips: {}\n",
                      format_quantity(last.work, kEnergyUnits, 4), format_quantity(last.lost, kEnergyUnits, 4),
                      format_quantity(stored, kEnergyUnits, 4), last.yields);
  const physics::Energy begun = played.samples.front().tick.stored;
  if (begun.si > kRounding * last.given.si) {
    text +=
        fmt::format("{} were stored at the start, where the lever is bent\n", format_quantity(begun, kEnergyUnits, 4));
  }
  const physics::Energy spent = begun + last.work, rest = spent - last.lost - stored;
  if (rest.si > 0.01 * spent.si) {
    text += fmt::format("{} more was lost in jumps of the tip among several particles\n",
                        format_quantity(rest, kEnergyUnits, 4));
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
  if (last.exhausted > 0) text += fmt::format("{} ticks ended before all spheres were at rest\n", last.exhausted);
  return text;
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
  const auto run = scene::play_scratch(set, options.rate, static_cast<std::size_t>(options.samples));
  auto written = write_stdout((options.json ? exhibit::scratch_json : exhibit::scratch_text)(set, run, options.rate));
  if (!written) return written;
  if (!options.out.empty()) written = core::write_file(options.out, curves::gwy_bytes(run.image));
  if (!written) return written;
  return certified(run.least_margin_j, run.moves.back().end.tick.given, path);
}

core::Result<void> run_particles(const ParticlesOptions& options, const std::string& assets_dir) {
  const auto path = scene::particle_file(options.file, assets_dir);
  if (!path) return tl::unexpected(path.error());
  const auto set = scene::load_particle_set(*path);
  if (!set) return tl::unexpected(set.error());
  if (!options.out.empty() && !(set->soft && options.out.ends_with(".gwy"))) {
    return core::wrong_usage("--out: takes the image of a soft sample, in a file that ends in .gwy");
  }
  const double ticks = scene::all_ticks(*set, options.rate);
  if (ticks > kMostTicks) {
    return core::wrong_usage(
        fmt::format("the moves of {} take {:.0f} s, which are {:.3g} ticks at {:g} Hz, more than {:.3g}: lower --rate, "
                    "or raise the speeds",
                    *path, ticks / options.rate.si, ticks, options.rate.si, kMostTicks));
  }
  if (set->soft) return run_scratch(*set, options, *path);
  const Played played = play(*set, options, static_cast<std::size_t>(ticks));
  auto written =
      write_stdout(options.json ? particles_json(*set, options, played) : particles_text(*set, options, played));
  if (!written) return written;
  return certified(played.least_margin_j, played.ends.back().tick.given, *path);
}

}  // namespace

void add_particles_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command(
      "particles",
      "push particles on a sample, or scratch it, with a scripted tip, without a window, and print forces and places");
  const auto options = std::make_shared<ParticlesOptions>();
  command
      .add_option(
          "file", options->file,
          "particle file (TOML) with particles, tip, lever and the moves of the hand; or the name of a built-in set, "
          "such as gold-row")
      .required()
      .type_name("FILE");
  quantity_option(
      command, "--rate", [options](Frequency rate) { options->rate = rate; }, physics::kFrequencyUnits,
      "ticks per second, like the servo's", std::optional(QuantityRange<Frequency>{kSlowestTicks, kFastestTicks}))
      .show_default("1kHz");
  command.add_option("--samples", options->samples, "number of states that --json prints, evenly spaced in time")
      .type_name("NUMBER")
      .within(2, 1'000'000)
      .show_default();
  command.add_flag("--json", options->json,
                   "print figures, sources, states, events and final places as JSON, with the unit in each key");
  command.add_option("--out", options->out, "write the scratched sample to FILE, an image of its heights (.gwy)")
      .writable_file()
      .type_name("FILE");
  command.footer(
      "example: touchafm particles gold-row\n"
      "         touchafm particles scratch-pmma --out scratch.gwy\n"
      "         touchafm particles my-set.toml --json --rate 4kHz --samples 1000\n"
      "The exit code is 1 if the hand gained energy, which would be a fault of the program.");
  command.when_chosen([options, &context] { return run_particles(*options, context.assets_dir); });
}

}  // namespace afm::app
