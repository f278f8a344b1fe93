// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "app/commands/task_figures.h"
#include "app/options/command.h"
#include "app/options/sound_options.h"
#include "core/json_text.h"
#include "core/log.h"
#include "core/printable.h"
#include "core/whole_file.h"
#include "core/written_by.h"
#include "curves/felt_sources.h"
#include "exhibit/sound/session_sound.h"
#include "exhibit/state/particle_task.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/map_vibration.h"
#include "servo/replay.h"
#include "servo/session_file.h"

namespace afm::app {

namespace {

struct ReplayOptions {
  std::string session;
  servo::ReplayRange range;
  bool json = false;
  std::string sound;  // sound file; empty: none
  SoundOptions sound_options;
};

bool is_of_map(const servo::RecordedSession& session) { return session.curve && session.curve->column >= 0; }

// Pixel of the session; null if the material is not from a force map.
nlohmann::json pixel_of(const servo::RecordedSession& session) {
  if (!is_of_map(session)) return nullptr;
  return {session.curve->column, session.curve->row};
}

nlohmann::json json_of(const std::optional<servo::Difference>& first) {
  if (!first) return nullptr;
  return {{"index", first->index},
          {"quantity", first->quantity},
          {"recorded", first->recorded},
          {"replayed", first->replayed}};
}

double seconds(const servo::RecordedSession& session) {
  return session.seconds_since_start(session.samples.back().time_ns);
}

// Score of a session whose particles have a pattern: the pattern of the built-in set with these particles.
struct SessionTask {
  std::string set;  // title of the set
  scene::TaskScore score;
  bool from_the_start = true;  // true: no particle moved before the session
};

std::string json(const servo::RecordedSession& session, const servo::Replay& replayed, const servo::ReplayRange& range,
                 const std::optional<SessionTask>& task, const std::string& assets_dir) {
  nlohmann::json events = nlohmann::json::array();
  for (const scene::TipEvent& event : session.events) {
    if (!range.holds(session.seconds_since_start(event.time_ns))) continue;
    events.push_back({{"kind", physics::name_of(event.kind)},
                      {"time_s", session.seconds_since_start(event.time_ns)},
                      {"z_m", event.z_m},
                      {"force_before_N", event.force_before_n},
                      {"force_after_N", event.force_after_n}});
  }
  nlohmann::json scored;
  if (task) scored = task_json(task->score);
  if (!scored.is_null()) {
    scored["set"] = task->set;
    scored["from_the_start"] = task->from_the_start;
  }
  nlohmann::json report{
      {"material", session.material},
      {"pixel", pixel_of(session)},
      {"rate_Hz", session.rate_hz},
      {"device", session.device.name.data()},
      {"seconds", seconds(session)},
      {"complete", session.complete},
      {"from_s", range.from_s},
      {"to_s", std::min(range.to_s, seconds(session))},
      {"ticks", replayed.ticks},
      {"events", events},
      {"task", scored},
      {"identical", replayed.identical()},
      {"different_ticks", replayed.different_ticks},
      {"first_difference", json_of(replayed.first)},
      {"first_different_event", json_of(replayed.first_event)},
      {"largest_difference", {{"tip_N", replayed.largest_tip_n}, {"hand_N", replayed.largest_hand_n}}}};
  report.update(
      nlohmann::json(curves::session_numbers(session.material, session.parameters, session.sources, assets_dir)));
  core::name_software(report);
  return core::json_text(report) + "\n";
}

std::string plain(const servo::RecordedSession& session, const servo::Replay& replayed, const servo::ReplayRange& range,
                  const std::optional<SessionTask>& task) {
  const auto with_force = std::count_if(session.samples.begin(), session.samples.end(), [](const scene::TipSample& s) {
    return s.servo_state == scene::ServoState::Running;
  });
  std::string text =
      fmt::format("{}, recorded with {} at {:g} Hz: {:.3f} s, {} ticks, force on in {} of them, {} events\n",
                  session.material, core::printable_line(session.device.name.data()), session.rate_hz, seconds(session),
                  session.samples.size(), with_force, session.events.size());
  if (is_of_map(session)) {
    text += fmt::format("felt at pixel {},{} of a force map\n", session.curve->column, session.curve->row);
  }
  if (session.law_map) {
    text += fmt::format("felt over a {}map of modulus and adhesion of {} x {} points\n",
                        session.parameters.viscous_map != 0 ? "viscous " : "", session.law_map->columns,
                        session.law_map->rows);
    if (session.parameters.map_vibration != scene::MapVibration::None)
      text += fmt::format("{} is felt as a vibration\n", scene::text_of(session.parameters.map_vibration).name);
  }
  if (range.from_s > 0 || range.to_s < seconds(session)) {
    text += fmt::format("compared from {:.3f} s to {:.3f} s: {} ticks\n", range.from_s,
                        std::min(range.to_s, seconds(session)), replayed.ticks);
  }
  for (const scene::TipEvent& event : session.events) {
    if (!range.holds(session.seconds_since_start(event.time_ns))) continue;
    text += fmt::format("  {:<16} at {:8.3f} s   Z = {:9.4f} nm   force {:9.5f} nN, then {:9.5f} nN\n",
                        physics::name_of(event.kind), session.seconds_since_start(event.time_ns), event.z_m * 1e9,
                        event.force_before_n * 1e9, event.force_after_n * 1e9);
  }
  if (task && task->score.state != scene::TaskState::NotBegun) {
    text += fmt::format("pattern of the built-in set \"{}\": {}{}\n", task->set, scene::text_of(task->score),
                        task->from_the_start ? "" : "; of this session alone, before which particles had been moved");
  }
  text += fmt::format("largest difference: {:.3g} nN on the tip, {:.3g} N on the hand\n", replayed.largest_tip_n * 1e9,
                      replayed.largest_hand_n);
  if (replayed.identical()) text += "every force on the tip and on the hand is identical, bit for bit\n";
  return core::with_software_line(std::move(text));
}

std::string difference_text(const servo::RecordedSession& session, const servo::Replay& replayed) {
  if (replayed.first) {
    const servo::Difference& first = *replayed.first;
    return fmt::format("{} of {} ticks differ, the first at {:.3f} s: {} was {:g} and is now {:g}",
                       replayed.different_ticks, replayed.ticks,
                       session.seconds_since_start(session.samples[first.index].time_ns), first.quantity,
                       first.recorded, first.replayed);
  }
  const servo::Difference& first = *replayed.first_event;
  return fmt::format("the events differ, the first in event {}: {} was {:g} and is now {:g}", first.index,
                     first.quantity, first.recorded, first.replayed);
}

core::Result<void> write_sound(const servo::RecordedSession& session, const ReplayOptions& options) {
  const auto sound = exhibit::wav_of(session, options.sound_options.channels(), options.sound_options.gain());
  if (!sound) {
    return core::failure(sound.error().category,
                         fmt::format("session file {}: {}", options.session, sound.error().message));
  }
  return core::write_file(options.sound, *sound);
}

bool from_the_start(const servo::RecordedParticles& particles) {
  for (std::uint32_t i = 0; i < particles.set.count; ++i) {
    const scene::ParticlePose& pose = particles.pages[scene::page_of(i)].poses[i % scene::kPosesPerPage];
    if (pose.x_m != particles.set.particles[i].x_m || pose.y_m != particles.set.particles[i].y_m) return false;
  }
  return true;
}

core::Result<void> run_replay(const ReplayOptions& options, const std::string& assets_dir) {
  const auto session = servo::load_session(options.session);
  if (!session) return tl::unexpected(session.error());
  const servo::ReplayRange& range = options.range;
  if (!(range.from_s >= 0.0 && range.from_s <= seconds(*session) && range.to_s > range.from_s)) {
    const std::string to = std::isinf(range.to_s) ? "" : fmt::format(", --to {:g} s", range.to_s);
    return core::wrong_usage(fmt::format("--from {:g} s{}: the session has no such part; it lasts {:.3f} s",
                                         range.from_s, to, seconds(*session)));
  }
  if (!session->complete) core::log_line(servo::cut_text(*session, options.session));
  scene::ParticleSet set;
  if (session->particles) set = scene::recorded_set(session->particles->set, assets_dir);
  std::optional<exhibit::ParticleTask> followed;
  if (scene::has_task(set)) followed.emplace(set);
  const auto replayed = servo::replay(*session, range, [&](const servo::ReplayedTick& tick) {
    if (followed) followed->hear(tick);
  });
  if (!replayed) {
    return core::failure(replayed.error().category,
                         fmt::format("session file {}: {}", options.session, replayed.error().message));
  }
  if (!options.sound.empty()) {
    if (auto written = write_sound(*session, options); !written) return written;
  }
  std::optional<SessionTask> task;
  if (followed) task = {set.title, followed->score(), from_the_start(*session->particles)};
  std::fputs(
      (options.json ? json(*session, *replayed, range, task, assets_dir) : plain(*session, *replayed, range, task))
          .c_str(),
      stdout);
  if (replayed->identical()) return {};
  return core::failure(core::ErrorCategory::Failed,
                       fmt::format("the replay of {} differs: {}; another build of TouchAFM may have recorded it",
                                   options.session, difference_text(*session, *replayed)));
}

}  // namespace

void add_replay_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command(
      "replay", "replay a recorded hand through the servo and compare every force with the recording, bit for bit");
  const auto options = std::make_shared<ReplayOptions>();
  command.add_option("session", options->session, "session file written by demo or view --record")
      .required()
      .type_name("SESSION");
  command
      .add_option("--from", options->range.from_s,
                  "start of the comparison in seconds after the session's first tick; default: the first tick")
      .type_name("SECONDS");
  command
      .add_option("--to", options->range.to_s,
                  "end of the comparison in seconds after the session's first tick; default: the end of the session")
      .type_name("SECONDS");
  command
      .add_option("--sound", options->sound,
                  "write what the whole session sounds like: the tone of the force and a signal for each event, at its "
                  "own time")
      .writable_file()
      .ends_in(".wav")
      .type_name("FILE.wav");
  add_sound_options(command, options->sound_options);
  command.add_flag("--json", options->json, "print the comparison as JSON, with the unit in each key");
  command.footer(
      "example: touchafm replay out/session-gold.afms\n"
      "         touchafm replay out/session-gold.afms --from 2 --to 3.5\n"
      "         touchafm replay out/session-gold.afms --sound gold.wav\n"
      "The exit code is 0 if every force is identical, otherwise 1. A truncated file is compared as far as it goes. "
      "touchafm view --haptics replay:FILE shows the session on the wall. If particles of a built-in set are pushed, "
      "the score of the task, up to --to, is printed, too.");
  command.when_chosen([options, &context] { return run_replay(*options, context.assets_dir); });
}

}  // namespace afm::app
