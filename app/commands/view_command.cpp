// SPDX-License-Identifier: Apache-2.0
#include "app/commands/view_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/cluster/cluster_master.h"
#include "app/commands/view_map.h"
#include "app/commands/view_people.h"
#include "app/display/instructor_window.h"
#include "app/display/view_display.h"
#include "app/display/view_headset.h"
#include "app/headset/headset_runtime.h"
#include "app/lesson/view_lesson.h"
#include "app/live/live_window.h"
#include "app/live/view_keys.h"
#include "app/options/command.h"
#include "app/options/dynamic_resolution.h"
#include "app/options/exhibit_options.h"
#include "app/options/pixel_size_option.h"
#include "app/options/quantity_option.h"
#include "app/options/servo_options.h"
#include "app/options/sound_options.h"
#include "app/tapping/tapping_command.h"
#include "app/view/view_wand.h"
#include "core/clock.h"
#include "core/exit_code.h"
#include "core/interruption.h"
#include "core/log.h"
#include "curves/sample_model.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/lesson/lesson_samples.h"
#include "exhibit/lesson/live_lesson.h"
#include "exhibit/models/shared_model.h"
#include "render/context.h"
#include "render/monitor.h"
#include "render/renderer.h"
#include "scene/samples/particle_set.h"
#include "servo/haptic_choice.h"
#include "servo/keep_running.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

constexpr std::uint32_t kSmallestWindow = 64, kLargestWindow = 16384;
constexpr double kSlowestFrames = 10.0, kFastestFrames = 1000.0;  // frames per second; below 4 the servo trips

constexpr QuantityRange kForceLimits{physics::Force(haptics::kLeastForceLimitN), physics::Force(2.0)};

core::Result<void> check_validation(render::Context& context) {
  const auto messages = context.take_validation_messages();
  for (const std::string& message : messages) core::log_line(message);
  if (messages.empty()) return {};
  return core::failure(core::ErrorCategory::Failed,
                       fmt::format("the Vulkan validation layer reported {} messages; see above", messages.size()));
}

// Width to height of an eye's picture. A missing display is reported later, when the windows open.
double expected_aspect(const DisplayOptions& display) {
  const auto monitors = render::list_monitors();
  const glm::uvec2 window = expected_size(display.window, monitors.value_or(std::vector<render::Monitor>{}));
  const glm::dvec2 eye(scene::eye_size(display.picture.mode.value_or(scene::StereoMode::Mono), window));
  return eye.x / eye.y;
}

void add_picture_options(OptionList& command, ViewOptions& options) {
  add_stereo_options(command, options.display.picture, "the outputs of the wall file, otherwise mono");
  command.add_flag("--fullscreen", options.display.window.full_screen, "fill one monitor; F11 toggles this later");
  command
      .add_option("--monitor", options.display.window.monitor,
                  "open one window that fills this monitor, given by its name or number from touchafm devices")
      .type_name("NAME");
  command.add_flag(
      "--high-contrast", [&options] { options.display.contrast = render::PanelContrast::High; },
      "draw the panels in white on opaque black, for people with low vision");
  command.add_option("--text-size", options.files.text_size, "factor by which panel text is enlarged, where it fits")
      .within(1.0, exhibit::kLargestText)
      .show_default()
      .type_name("TIMES");
  command
      .add_option("--eye-width", options.display.eye_width,
                  "width of each eye image in pixels, scaled to the window; default: the window's resolution")
      .within(64, 8192)
      .type_name("PIXELS");
  add_frame_budget(command, options.display.frame_budget_ms);
  command
      .add_option("--comfort", options.display.comfort_deg,
                  "largest disparity in degrees; where the scene exceeds it, the picture uses a smaller eye "
                  "distance; many people see double above 1")
      .within(0.1, 3.0)
      .show_default()
      .type_name("DEGREES");
  command
      .add_option("--pictures", options.display.saved_folder,
                  "existing folder for screenshots taken with F12, named touchafm-001.png and so on; default: the "
                  "current folder")
      .existing_folder()
      .type_name("DIR");
  command
      .add_option("--frame-rate", options.frame_rate,
                  "highest frame rate in frames per second; default: the display's refresh rate")
      .within(kSlowestFrames, kFastestFrames)
      .type_name("RATE");
}

void add_wand_options(OptionList& command, ViewOptions& options) {
  command
      .add_option(
          "--wand", options.wand.source,
          "pointing device in addition to the mouse: auto or hid for the connected wand that is used (hot-plug), "
          "hid:NAME for the wand whose node, numbers or name contain NAME, dtrack or dtrack:ADDRESS:PORT for a "
          "tracker's Flystick, sim for a simulated wand, or mouse for none; default: auto")
      .type_name("SOURCE");
  command
      .add_option("--wand-file", options.wand.file,
                  "wand file (TOML): position of the hand, address of the tracker, or mapping of an HID device; see "
                  "docs/adding-a-wand.md")
      .type_name("FILE");
  command
      .add_option("--head", options.wand.head,
                  "head tracking: dtrack:BODY or dtrack:BODY@ADDRESS:PORT for a body of a tracker, or sim:FILE for a "
                  "script of lines \"seconds, x, y, z\" in metres; default: the wand file's, otherwise the wall's "
                  "sweet spot, which the arrow keys move")
      .type_name("SOURCE");
}

void add_hearing_options(OptionList& command, ViewOptions& options) {
  command.add_flag(
      "--sound", options.settings.sound.sound,
      "make the force audible: its pitch rises with the force, a pull is heard on the left and a push on the "
      "right; every event has a sound and, also without this option, a caption; Q turns the sound off and on");
  command.add_flag("--speech", options.speech,
                   "speak guidance, samples, events and values in the wall's language, by espeak-ng or by the screen "
                   "reader's voice; Y speaks the current state, X blanks the picture");
  add_sound_options(command, options.settings.sound.options);
}

void add_servo_options(OptionList& command, ViewOptions& options) {
  std::string hands;
  for (const servo::HapticWord& word : servo::haptic_words()) {
    hands += fmt::format("{}{} ({})", hands.empty() ? "" : ", ", word.word, word.meaning);
  }
  command
      .add_option("--haptics", options.servo.haptic_device,
                  fmt::format("haptic device: {}; default: {}", hands, options.servo.haptic_device))
      .type_name("DEVICE");
  command
      .add_option("--frame-log", options.settings.frame_log,
                  "write one line of CSV per frame to FILE: times, head-tracking latency, disparity, scheduling "
                  "latency of the servo")
      .writable_file()
      .type_name("FILE");
  command.add_flag("--dead-man", options.servo.settings.dead_man, "apply force only while Turn-On is held down");
  quantity_option(
      command, "--max-force", [&options](physics::Force most) { options.servo.settings.max_force_n = most.si; },
      physics::kForceUnits, "largest force on the hand; default: 2 N, or 0.9 of the device's nominal force",
      std::optional(kForceLimits));
  command
      .add_option("--servo-rate", options.servo.settings.rate_hz,
                  "ticks of the servo per second; a force-feedback device needs 400 Hz or more")
      .within(100.0, 10'000.0)
      .show_default()
      .type_name("HZ");
  command
      .add_option(
          "--spin", options.spin_us,
          "busy-wait of the servo before each tick for lower scheduling latency, at most half a period; default: 0")
      .within(0, 5000)
      .type_name("MICROSECONDS");
  command
      .add_option("--linger", options.servo.settings.linger_s,
                  "time for which the servo keeps its device for another touchafm view after this one dies")
      .within(0.0, 600.0)
      .show_default()
      .type_name("SECONDS");
}

void add_exhibition_options(OptionList& command, ViewOptions& options) {
  command.add_option("--record", options.settings.record_folder, "record into DIR, one session per sample")
      .type_name("DIR");
  command.add_flag(
      "--kiosk", options.kiosk,
      "run unattended and reopen the window whenever it fails or hangs; SIGTERM or Ctrl-C ends the program");
  command.add_option("--kept", options.kept, "descriptor for the signs of life of a kiosk's window").hidden();
  command.add_flag("--unattended", options.settings.unattended,
                   "lock the operators' keys; when no visitor is present, reset the wall and demonstrate the samples "
                   "in turn; SIGTERM or Ctrl-C ends the program");
  command
      .add_option("--idle", options.settings.idle_s,
                  "with --unattended or --kiosk, time without input after which the wall assumes that the visitor has "
                  "left")
      .within(5.0, 3600.0)
      .show_default()
      .type_name("SECONDS");
  add_scale_option(command, options.scale);
  add_friction_option(command, options.friction);
  add_tapped_view_options(command, options.tapping);
}

// Connection to the wall's other machines; null if this machine shows the wall by itself.
core::Result<std::unique_ptr<ClusterMaster>> other_machines(const ViewOptions& options, const std::string& program,
                                                            exhibit::Stage& stage, const core::Clock& clock) {
  if (options.cluster.wanted) {
    return start_cluster(options.cluster, options.files,
                         {options.friction, options.display.picture, options.display.contrast, options.tapping},
                         program, stage, clock);
  }
  if (auto alone = check_one_machine(stage.wall, options.display.window, "--cluster, or "); !alone) {
    return tl::unexpected(alone.error());
  }
  return nullptr;
}

DisplayOptions display_of(const ViewOptions& options, const ClusterMaster* others) {
  DisplayOptions display = options.display;
  if (others != nullptr) display.swap = render::Swap::WithOthers;
  return display;
}

servo::ServoChoice servo_of(const ViewOptions& options) {
  servo::ServoChoice servo = options.servo;
  servo.settings.spin_ns = 1000 * options.spin_us;
  if (servo.mode == servo::ServoMode::Thread) servo.settings.linger_s = 0;  // a thread ends with this program
  return servo;
}

// Sets the initial sample and scale: a person who asks for particles or a force map wants to feel them, particles on
// their scale.
void set_start(const ViewOptions& options, const exhibit::Stage& stage, ViewSettings& settings) {
  const bool particles = stage.particles != nullptr;
  settings.equal_force_n = options.files.equal_force_n;
  settings.scale = options.scale.value_or(particles ? scene::ScaleMode::Particles : scene::ScaleMode::Fit);
  if (settings.first_material) return;
  if (particles) settings.first_material = 0;
  const auto& materials = stage.materials.materials;
  const auto pixel = std::find_if(materials.begin(), materials.end(), [&](const scene::MaterialEntry& entry) {
    return stage.pixel && entry.name == stage.pixel->setup.material.name;
  });
  if (pixel != materials.end()) settings.first_material = static_cast<std::size_t>(pixel - materials.begin());
}

core::Result<std::unique_ptr<render::HeadsetRuntime>> headset_of(const ViewOptions& options) {
  if (!options.headset) return nullptr;
  return connect_headset();
}

// True without options that tapping excludes.
bool taps_alone(const ViewOptions& options) {
  return options.files.particles.empty() && options.files.force_map.empty() &&
         options.friction == physics::FrictionLaw::None;
}

core::Result<void> lay_particles(const ViewOptions& options, const exhibit::Stage& stage, scene::SharedModel& model) {
  if (stage.particles) model.particles = scene::shared_particles(*stage.particles);
  if (stage.particles && stage.particles->blind && options.level.level > 0) {
    return core::wrong_usage(fmt::format("--level {}: the task of {} is done without a picture; leave it out",
                                         options.level.level, options.files.particles));
  }
  return scene::set_level(options.level, model.particles);
}

LiveFeatures features_of(ViewDisplay& display, ClusterMaster* cluster, std::optional<exhibit::LiveLesson>& guide) {
  return {.headset = display.headset(),
          .cluster = cluster,
          .lesson = guide ? &*guide : nullptr,
          .instructor = display.instructor()};
}

core::Result<void> check_lesson(const ViewLesson* lesson, const std::vector<curves::SampleModel>& materials) {
  return lesson == nullptr ? core::Result<void>() : exhibit::check_samples(lesson->lesson, materials);
}

}  // namespace

core::Result<void> run_view(const ViewOptions& options, const std::string& program, const ViewLesson* lesson) {
  const core::CodeOfInterruption released(core::ExitCode::Done);
  const core::MonotonicClock clock;
  curves::TappedHand tapping = options.tapping;
  exhibit::ExhibitFiles files = options.files;
  if (auto taken = take_map_options(options, tapping, files); !taken) return taken;
  if (auto checked = check_tapped_view(tapping, taps_alone(options)); !checked) return checked;
  // before the rest, so that nothing else is loaded if there is no headset
  const auto runtime = headset_of(options);
  if (!runtime) return tl::unexpected(runtime.error());
  if (!options.headset) files.aspect = expected_aspect(options.display);
  auto stage = exhibit::load_exhibit(files);
  if (!stage) return tl::unexpected(stage.error());
  const auto samples = exhibit::felt_samples(*stage, options.friction, &tapping);
  if (!samples) return tl::unexpected(samples.error());
  const std::vector<curves::SampleModel>& materials = *samples;
  if (auto checked = check_lesson(lesson, materials); !checked) return checked;
  ViewSettings settings = options.settings;
  const auto wand_choice = parse_wand_choice(options.wand);
  if (!wand_choice) return tl::unexpected(wand_choice.error());
  settings.head_script = wand_choice->head_script;
  set_start(options, *stage, settings);
  if (auto set = set_people(options, *stage, settings); !set) return set;
  if (auto kept = keep_map(*stage, files, settings); !kept) return kept;
  auto wand = ViewWand::open(*wand_choice, *stage, options.files.assets_dir, clock);
  if (!wand) return tl::unexpected(wand.error());
  auto model = exhibit::shared_model(stage->wall_scene.scene(), stage->wall_scene.sample_node(), materials,
                                     stage->wall_scene.height_fields(), stage->recorded_curves(),
                                     stage->wall_scene.topography().size());
  if (!model) return tl::unexpected(model.error());
  if (auto laid = lay_particles(options, *stage, *model); !laid) return laid;

  const auto cluster = other_machines(options, program, *stage, clock);
  if (!cluster) return tl::unexpected(cluster.error());
  auto display = ViewDisplay::open(*stage, display_of(options, cluster->get()), runtime->get(), clock);
  if (!display) return tl::unexpected(display.error());
  settings.most_frames_per_s = options.frame_rate > 0 ? options.frame_rate : (*display)->windows().at(0).refresh_hz();
  const servo::ServoChoice servo = servo_of(options);
  const auto start_servo = [&] {
    return servo::ServoClient::start(*model, scene::digest(stage->wall_scene.scene()), servo, program,
                                     stage->wall_scene.topography());
  };
  std::optional<exhibit::LiveLesson> guide;
  if (lesson != nullptr) guide.emplace(lesson->lesson, materials, stage->phrases(), lesson->study, clock);
  auto ran = run_live_window({.stage = *stage,
                              .materials = materials,
                              .windows = (*display)->windows(),
                              .picture = (*display)->picture(),
                              .drawn_by = (*display)->context().device_name(),
                              .wand = **wand,
                              .clock = clock,
                              .start_servo = start_servo},
                             settings, features_of(**display, cluster->get(), guide));
  auto kept = guide ? guide->finish() : core::Result<void>{};
  if (!ran) return ran;
  if (!kept) return kept;
  return check_validation((*display)->context());
}

void add_window_options(OptionList& command, ViewOptions& options) {
  add_picture_options(command, options);
  pixel_size_option(command, "--size", options.display.window.size_px,
                    "open one window of this size in pixels; default: one window per output of the wall file, each in "
                    "its place, otherwise one of 1280x720; without a wall file, the picture fills the window",
                    PixelRange{kSmallestWindow, kLargestWindow});
  add_servo_mode_option(command, options.servo.mode);
  add_wand_options(command, options);
  add_servo_options(command, options);
  add_hearing_options(command, options);
  command.add_flag("--validate", options.display.validate,
                   "check every Vulkan call; any validation message leads to exit code 1");
}

void add_view_command(OptionList& program, const CommandContext& context) {
  OptionList command =
      program.add_command("view", "open the live window: choose a sample and feel it; a mouse is enough");
  command.footer(
      fmt::format("Press F1 in the window for its keys and buttons.\n"
                  "With --kiosk or --unattended these keys work: {}.\n\n"
                  "example: touchafm view\n"
                  "         touchafm view --stereo side-by-side --fullscreen --material mica --material pdms-air",
                  keys_of_visitors()));
  auto options = std::make_shared<ViewOptions>();
  add_stage_options(command, options->files, context);
  add_own_model_options(command, options->files, &options->level);
  add_particles_option(command, options->files);
  std::vector<NamedOption> of_map = add_force_map_options(command, options->files);
  command
      .add_option("--material", options->files.shown,
                  "material to show; repeatable, up to nine; default: the paper's mica, gold and silicon nitride")
      .one_value_each()
      .type_name("MATERIAL");
  add_window_options(command, *options);
  Option headset =
      command.add_flag("--headset", options->headset,
                       "show the picture in a headset through OpenXR, at true scale; its controller is a wand, and the "
                       "window mirrors the left eye");
  add_exhibition_options(command, *options);
  const Option cluster = add_cluster_options(command, options->cluster);
  headset.excludes(cluster);
  for (NamedOption& each : of_map) each.option.excludes(cluster);
  headset.excludes(add_gpu_option(command, options->display.picture.gpu));
  command.when_chosen([options, &context]() -> core::Result<void> {
    if (!options->kiosk) return run_view(*options, context.program_path);
    const core::CodeOfInterruption released(core::ExitCode::Done);
    std::vector<std::string> arguments = context.arguments;
    std::replace(arguments.begin(), arguments.end(), std::string("--kiosk"), std::string("--unattended"));
    arguments.insert(arguments.end(), {"--kept", std::to_string(servo::kBeatDescriptor)});
    return servo::keep_running(context.program_path, arguments);
  });
}

}  // namespace afm::app
