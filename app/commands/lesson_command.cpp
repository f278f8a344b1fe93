// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/commands/view_command.h"
#include "app/lesson/view_lesson.h"
#include "app/options/command.h"
#include "app/options/enum_option.h"
#include "app/options/exhibit_options.h"
#include "core/fnv1a.h"
#include "core/log.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/lesson/data_set.h"
#include "exhibit/lesson/lesson_file.h"
#include "exhibit/lesson/lesson_run.h"
#include "exhibit/lesson/lesson_samples.h"
#include "exhibit/lesson/simulated_student.h"
#include "study/age_band.h"

namespace afm::app {

namespace {

constexpr std::string_view kSimulated = "sim:";

struct LessonOptions {
  ViewOptions view;
  std::string lesson;
  std::string participant;
  std::string out;
  std::string withdrawn;
  std::string age_band;
};

core::Result<void> check_usage(const LessonOptions& options) {
  if (!options.withdrawn.empty()) {
    if (!exhibit::is_participant_code(options.withdrawn)) {
      return core::wrong_usage(fmt::format("--withdraw {}: a code is six capital letters", options.withdrawn));
    }
    return {};
  }
  if (options.lesson.empty())
    return core::wrong_usage("no lesson is named: touchafm lesson first-touch, or another name or file");
  const bool simulated = options.participant.starts_with(kSimulated);
  if (!simulated && !options.participant.empty() && !exhibit::is_participant_code(options.participant)) {
    return core::wrong_usage(
        fmt::format("--participant {}: write six capital letters that say nothing about the person, or sim:SEED",
                    options.participant));
  }
  if (simulated && !options.age_band.empty()) {
    return core::wrong_usage("--age-band: a simulated participant has no age; leave it out");
  }
  if (simulated && !options.view.display.instructor.empty()) {
    return core::wrong_usage("--instructor: a simulated participant has no window to follow; leave it out");
  }
  return {};
}

core::Result<scene::MaterialLibrary> load_library(const exhibit::ExhibitFiles& files) {
  auto library = scene::load_materials(files.assets_dir + "/materials.toml");
  if (!library || files.materials.empty()) return library;
  auto own = scene::load_materials(files.materials);
  if (!own) return own;
  library->add(std::move(*own));
  return library;
}

// Adds the name of the lesson file to an error in its materials.
core::Error of_lesson_file(const LessonOptions& options, const core::Error& error) {
  return {core::ErrorCategory::BadInputFile, fmt::format("lesson file {}: {}", options.lesson, error.message)};
}

// Samples of a lesson as models, and as JSON for its data set.
struct LessonSamples {
  std::vector<curves::SampleModel> models;
  std::string described;
};

core::Result<LessonSamples> samples_of(const LessonOptions& options, const exhibit::Lesson& lesson) {
  const auto library = load_library(options.view.files);
  if (!library) return tl::unexpected(library.error());
  auto models = exhibit::lesson_samples(lesson, *library);
  if (!models) return tl::unexpected(of_lesson_file(options, models.error()));
  auto described = exhibit::samples_json(lesson, *library);
  if (!described) return tl::unexpected(of_lesson_file(options, described.error()));
  return LessonSamples{std::move(*models), std::move(*described)};
}

// Seed for a participant's lesson, always the same for the same code. Fits into 53 bits, the integers that every JSON
// reader holds exactly.
std::uint64_t seed_of(const std::string& code, const exhibit::Lesson& lesson) {
  return core::fnv1a(code + "/" + lesson.id) >> 11U;
}

// Runs the lesson without a window, in simulated time.
core::Result<void> run_simulated(const LessonOptions& options) {
  const auto participant =
      exhibit::SimulatedParticipant::parse(std::string_view(options.participant).substr(kSimulated.size()));
  if (!participant) return tl::unexpected(participant.error());
  const auto lesson = exhibit::load_lesson(options.lesson, options.view.files.assets_dir, options.view.files.materials);
  if (!lesson) return tl::unexpected(lesson.error());
  const auto phrases = exhibit::load_phrases(options.view.files);
  if (!phrases) return tl::unexpected(phrases.error());
  const auto samples = samples_of(options, *lesson);
  if (!samples) return tl::unexpected(samples.error());
  const std::string code = participant->code();
  const std::uint64_t seed = seed_of(code, *lesson);
  auto data = exhibit::DataSet::create(*lesson, {.folder = options.out,
                                                 .code = code,
                                                 .device = "sim",
                                                 .wall = "none",
                                                 .seed = seed,
                                                 .observer = participant->json(),
                                                 .samples = samples->described,
                                                 .day = std::nullopt});
  if (!data) return tl::unexpected(data.error());
  exhibit::LessonRun run(
      *lesson, samples->models, phrases->wall, {.seed = seed, .order = data->order()},
      [&](const exhibit::TrialRow& row) { return data->add(row); }, 0.0);
  exhibit::SimulatedStudent student(*participant, *lesson, samples->models);
  if (auto taken = student.take(run); !taken) return taken;
  if (auto finished = data->finish(run.end().value_or(exhibit::LessonEnd::Stopped)); !finished) return finished;
  core::log_line(fmt::format("{}: {} of {}", data->participant_folder(), lesson->id, code));
  return {};
}

// Removes the empty folder of a participant who has declined.
void remove_empty(const std::string& folder) {
  std::error_code not_empty;
  std::filesystem::remove(folder, not_empty);
}

// Runs the lesson in the live window.
core::Result<void> run_live(const LessonOptions& options, const std::string& program) {
  auto lesson = exhibit::load_lesson(options.lesson, options.view.files.assets_dir, options.view.files.materials);
  if (!lesson) return tl::unexpected(lesson.error());
  const auto& conditions = lesson->conditions;
  const bool heard = std::find(conditions.begin(), conditions.end(), exhibit::Condition::Sound) != conditions.end();
  if (heard && !options.view.settings.sound.sound) {
    return core::wrong_usage(options.lesson + ": a condition of this lesson is sound; add --sound");
  }
  const auto samples = samples_of(options, *lesson);
  if (!samples) return tl::unexpected(samples.error());
  ViewOptions view = options.view;
  view.files.shown = lesson->materials;
  view.files.particles = lesson->particles;
  view.scale = lesson->scale;
  if (lesson->tapping) view.tapping = *lesson->tapping;
  ViewLesson guided{.lesson = std::move(*lesson), .study = std::nullopt};
  if (options.participant.empty()) return run_view(view, program, &guided);

  const std::string& code = options.participant;
  if (auto free = exhibit::check_not_done(guided.lesson, options.out, code); !free) return free;
  const auto order = exhibit::order_of(options.out, code);
  if (!order) return tl::unexpected(order.error());
  const auto days = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()).time_since_epoch();
  guided.study = exhibit::DataSetEntry{.folder = options.out,
                                       .code = code,
                                       .device = view.servo.haptic_device,
                                       .wall = view.files.wall.empty() ? "powerwall" : view.files.wall,
                                       .seed = seed_of(code, guided.lesson),
                                       .age_band = options.age_band,
                                       .samples = samples->described,
                                       .order = *order,
                                       .day = days.count()};
  const std::string participant = options.out + "/sub-" + code;
  view.settings.record_folder = participant + "/task-" + guided.lesson.id + "_session";
  std::error_code error;
  std::filesystem::create_directories(participant, error);
  if (error) {
    return core::failure(
        core::ErrorCategory::Failed,
        fmt::format("cannot make {}: {}; choose another folder with --out", participant, error.message()));
  }
  auto ran = run_view(view, program, &guided);
  for (const std::string& folder : {view.settings.record_folder, participant, options.out}) remove_empty(folder);
  return ran;
}

core::Result<void> run_lesson(const LessonOptions& options, const std::string& program) {
  if (auto checked = check_usage(options); !checked) return checked;
  if (!options.withdrawn.empty()) {
    if (auto deleted = exhibit::withdraw(options.out, options.withdrawn); !deleted) return deleted;
    core::log_line(fmt::format("deleted all data of {} in {}", options.withdrawn, options.out));
    return {};
  }
  return options.participant.starts_with(kSimulated) ? run_simulated(options) : run_live(options, program);
}

}  // namespace

void add_lesson_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command(
      "lesson", "go through a lesson, alone or as a study: its steps, blind tests and questionnaires");
  command.footer(
      "example: touchafm lesson first-touch\n"
      "         touchafm lesson three-materials --participant QXWERT --out study\n"
      "         touchafm lesson three-materials --participant sim:7 --out study\n"
      "         touchafm lesson first-touch --fullscreen --instructor 2\n"
      "         touchafm lesson --withdraw ABCDEF --out study");
  const auto options = std::make_shared<LessonOptions>();
  command
      .add_option(
          "lesson", options->lesson,
          fmt::format("lesson file (TOML), or the name of an included one; {}/lessons holds ten", context.assets_dir))
      .or_included_in(context.assets_dir + "/lessons")
      .type_name("FILE");
  auto participant = command.add_option(
      "--participant", options->participant,
      "participant: a code of six capital letters, or sim:SEED for a simulated participant in simulated time and "
      "without a window, whose abilities may follow as sim:SEED,d-prime=1.5,weber=0.1,bias=0; default: nobody, and "
      "nothing is kept");
  participant.type_name("CODE");
  auto out = command.add_option("--out", options->out, "folder of the study; created if it does not exist");
  out.type_name("DIR");
  participant.needs(out);
  enum_option(command, "--age-band", options->age_band, "an age band", study::kAgeBands, &study::AgeBandRow::word,
              &study::AgeBandRow::word, "age of the participant in years, for the study; default: not given")
      .needs(participant);
  auto withdraw =
      command.add_option("--withdraw", options->withdrawn, "delete the folder and the row of this participant");
  withdraw.type_name("CODE");
  withdraw.needs(out);
  withdraw.excludes(participant);
  command
      .add_option("--instructor", options->view.display.instructor,
                  "open a second window for the instructor: its state, and Next, Skip, Stop and Hand off; give the "
                  "name or number of the monitor that it fills (touchafm devices lists them), or \"window\"")
      .type_name("MONITOR");
  add_stage_options(command, options->view.files, context);
  add_window_options(command, options->view);
  command.when_chosen([options, &context] { return run_lesson(*options, context.program_path); });
}

}  // namespace afm::app
