// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/demo/demo_figures.h"
#include "app/demo/demo_plan.h"
#include "app/demo/demo_size.h"
#include "app/demo/demonstration.h"
#include "app/demo/report_pictures.h"
#include "app/options/command.h"
#include "app/options/dynamic_resolution.h"
#include "app/options/exhibit_options.h"
#include "app/options/quantity_option.h"
#include "app/options/servo_options.h"
#include "app/options/sound_options.h"
#include "app/tapping/tapping_command.h"
#include "core/file_names.h"
#include "core/json_text.h"
#include "core/log.h"
#include "core/output_folder.h"
#include "curves/tapping/driven_setup.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/models/shared_model.h"
#include "exhibit/report/curves_plot.h"
#include "exhibit/report/report.h"
#include "exhibit/sound/session_sound.h"
#include "haptics/realtime.h"
#include "haptics/scaling.h"
#include "haptics/simulated_device.h"
#include "render/context.h"
#include "render/image_file.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

// Width of Fig. 5, larger than the live wall's picture.
constexpr std::uint32_t kFigureEyeWidth = 1440;
constexpr double kCommonPushM = 0.012;  // clear of the end of the workspace
constexpr QuantityRange<physics::Velocity> kHandSpeeds{physics::Velocity(0.005), physics::Velocity(0.200)};

struct DemoOptions {
  std::string out;
  exhibit::ExhibitFiles files;
  std::uint32_t eye_width = 0;  // width of an eye image; 0: as large as fits
  std::string gpu;
  input::HandPath hand;
  std::optional<double> frame_budget_ms;
  servo::ServoChoice servo;
  DemoSamples samples;
  bool sound = false;  // true: writes a sound file for each session
  SoundOptions sound_options;
};

core::Result<void> check_tapping(const DemoSamples& samples) {
  curves::TappedHand tapping = samples.tapping;
  if (auto checked = check_tapping_options(tapping.choice); !checked) return checked;
  if (tapping.choice.mode == "contact") {
    tapping.model = curves::TappedHand().model;  // acts in contact, too
    return curves::check_contact_mode(tapping);
  }
  if (samples.vary.empty() && samples.measured.empty() && samples.friction == physics::FrictionLaw::None) return {};
  return core::wrong_usage("--mode tapping is demonstrated without --vary, --measured and --friction; remove them");
}

// Moves the path to the sample, which is lower on the common scale.
input::HandPath on_scale(scene::ScaleMode scale, input::HandPath path) {
  if (scale != scene::ScaleMode::Common) return path;
  path.push_m = haptics::Scaling::common_zero_m(haptics::SimulatedDevice().spec()) - kCommonPushM;
  return path;
}

void say(const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

void draw_picture(const std::string& file, const std::string& caption, const exhibit::Moment& moment,
                  const exhibit::FrameBuilder& frames, render::Renderer& renderer, ReportPictures& pictures) {
  say(fmt::format("  {}", file));
  renderer.render(frames.build(moment));
  pictures.add(file, caption);
}

core::Result<void> draw_journey(const exhibit::FrameBuilder& frames, render::Renderer& renderer,
                                core::OutputFolder& out, std::vector<exhibit::ReportPicture>& pictures,
                                const exhibit::Phrases& phrases) {
  say("  journey.png");
  const auto png = render::encode_png(journey_strip(frames, renderer));
  if (!png) return tl::unexpected(png.error());
  pictures.push_back({phrases[exhibit::Phrase::CaptionJourney], std::string(png->begin(), png->end())});
  return out.write("journey.png", pictures.back().png);
}

core::Result<void> draw_figures(render::Context& context, const exhibit::Stage& stage, const DemoPlan& plan,
                                const exhibit::DemoResult& result, core::OutputFolder& out,
                                std::vector<exhibit::ReportPicture>& pictures) {
  auto renderer = render::Renderer::create(context, stage.wall_scene.scene(), stage.renderer_options(kFigureEyeWidth));
  if (!renderer) return tl::unexpected(renderer.error());
  const exhibit::FrameBuilder frames(stage.wall_scene, plan.materials, stage.eyes);
  ReportPictures drawn(context, *renderer, out);
  const exhibit::Phrases& phrases = stage.phrases();
  const FigurePlan figures(result.sessions, result.measurements, 0, phrases);
  for (const Figure& figure : figures.figures()) {
    draw_picture(figure.file, figure.caption, figure.moment, frames, *renderer, drawn);
  }
  for (std::size_t i = 0; i < plan.materials.size(); ++i) {
    if (plan.variations[i].empty()) continue;
    const VariationFigure figure(result.sessions[i], result.measurements[i], plan.materials[i], result.variations, i,
                                 phrases);
    const exhibit::FrameBuilder varied(stage.wall_scene, figure.materials(), stage.eyes);
    const scene::MaterialEntry& entry = plan.materials[i].setup.material;
    draw_picture("vary-" + core::in_file_name(entry.name) + ".png",
                 phrases.text<exhibit::Phrase::CaptionVaried>(phrases.word(entry.title)), figure.moment(), varied,
                 *renderer, drawn);
  }
  auto written = drawn.finish();
  if (!written) return tl::unexpected(written.error());
  std::move(written->begin(), written->end(), std::back_inserter(pictures));
  return draw_journey(frames, *renderer, out, pictures, phrases);
}

core::Result<void> write_session(const servo::RecordedSession& session, const std::string& material,
                                 const DemoOptions& options, core::OutputFolder& out) {
  const std::string name = core::in_file_name(material);
  if (auto saved = servo::save_session(session, out.staged("session-" + name + ".afms")); !saved) return saved;
  if (options.sound) {
    const auto wav = exhibit::wav_of(session, options.sound_options.channels(), options.sound_options.gain());
    if (!wav) return tl::unexpected(wav.error());
    if (auto written = out.write("sound-" + name + ".wav", *wav); !written) return written;
  }
  return out.write("curve-" + name + ".csv", exhibit::session_csv(session));
}

core::Result<void> write_results(const exhibit::DemoResult& result, const std::vector<exhibit::ReportPicture>& pictures,
                                 const exhibit::Phrases& phrases, const DemoOptions& options, core::OutputFolder& out) {
  std::vector<exhibit::LabelledSession> plotted;
  for (std::size_t i = 0; i < result.sessions.size(); ++i) {
    const servo::RecordedSession& session = result.sessions[i];
    if (auto saved = write_session(session, session.material, options, out); !saved) return saved;
    plotted.push_back({result.measurements[i].title, &session});
    int number = 0;
    for (const exhibit::Variation& variation : result.variations) {
      if (variation.material != i) continue;
      const std::string name = fmt::format("{}-vary-{}", session.material, ++number);
      if (auto saved = write_session(variation.session, name, options, out); !saved) return saved;
      plotted.push_back({variation.measurement.title, &variation.session});
    }
  }
  if (auto saved = out.write("summary.json", core::json_text(exhibit::summary_json(result), 2) + "\n"); !saved)
    return saved;
  const std::string report = exhibit::report_html(result, pictures, exhibit::curves_svg(plotted, phrases), phrases);
  if (auto saved = out.write("report.html", report); !saved) return saved;
  return out.commit();
}

core::Result<void> measure_all(const DemoPlan& plan, exhibit::DemoResult& result) {
  for (std::size_t i = 0; i < result.sessions.size(); ++i) {
    const bool recorded = plan.materials[i].parameters.law == physics::Law::Measured;
    auto measured = exhibit::measure(result.sessions[i], plan.materials[i], recorded ? &*plan.recorded : nullptr);
    if (!measured) return tl::unexpected(measured.error());
    result.measurements.push_back(std::move(*measured));
  }
  for (exhibit::Variation& variation : result.variations) {
    auto measured = exhibit::measure(variation.session, variation.model);
    if (!measured) return tl::unexpected(measured.error());
    variation.measurement = std::move(*measured);
  }
  return {};
}

core::Result<void> check_measurements(const exhibit::DemoResult& result) {
  for (const exhibit::Measurement& m : result.measurements) {
    if (auto accurate = exhibit::check_accuracy(m); !accurate) return accurate;
  }
  for (const exhibit::Variation& variation : result.variations) {
    if (auto accurate = exhibit::check_accuracy(variation.measurement); !accurate) return accurate;
  }
  return {};
}

core::Result<void> run_demo(const DemoOptions& options, const std::string& program) {
  const core::MonotonicClock clock;
  const std::int64_t start_ns = clock.now_ns();
  if (auto checked = check_tapping(options.samples); !checked) return checked;
  const auto curve = load_measured(options.samples, options.files.assets_dir);
  if (!curve) return tl::unexpected(curve.error());
  exhibit::ExhibitFiles files = options.files;
  if (*curve) files.added.push_back((*curve)->entry);
  auto stage = exhibit::load_exhibit(files);
  if (!stage) return tl::unexpected(stage.error());
  auto plan = plan_demo(*stage, *curve, options.samples, options.files.assets_dir);
  if (!plan) return tl::unexpected(plan.error());
  auto out = core::OutputFolder::open(options.out);
  if (!out) return tl::unexpected(out.error());
  haptics::favour_drawing();
  auto context = render::Context::open({.gpu = options.gpu});
  if (!context) return tl::unexpected(context.error());
  auto drawn =
      create_demo_renderer(*context, *stage, plan->materials, options.eye_width, options.frame_budget_ms, clock);
  if (!drawn) return tl::unexpected(drawn.error());
  plan->frame_budget_ms = drawn->frame_budget_ms;
  exhibit::DemoResult result;
  result.vulkan_device = context->device_name();
  result.haptic_device = "simulated hand";
  result.eye_width = drawn->options.eye_width;
  result.eye_height = drawn->options.eye_height;
  result.hand_speed_m_per_s = options.hand.speed_m_per_s;
  say(fmt::format("drawing 2 x {} x {} pixels on {}{}", result.eye_width, result.eye_height, result.vulkan_device,
                  drawn->size_reason));

  std::vector<exhibit::ReportPicture> pictures;
  {
    const auto model =
        exhibit::shared_model(stage->wall_scene.scene(), stage->wall_scene.sample_node(), plan->materials,
                              stage->wall_scene.height_fields(), plan->curves, stage->wall_scene.topography().size());
    if (!model) return tl::unexpected(model.error());
    auto servo = servo::ServoClient::start(*model, scene::digest(stage->wall_scene.scene()), options.servo, program,
                                           stage->wall_scene.topography());
    if (!servo) return tl::unexpected(servo.error());
    ReportPictures live_pictures(*context, drawn->renderer, *out);
    Demonstration live(*stage, *plan, drawn->renderer, **servo, clock, on_scale(plan->scale, options.hand),
                       [&] { live_pictures.add("choosing.png", stage->phrases()[exhibit::Phrase::CaptionChoosing]); });
    if (auto ran = live.run(result, say); !ran) return ran;
    drawn->renderer.wait();
    auto written = live_pictures.finish();
    if (!written) return tl::unexpected(written.error());
    pictures = std::move(*written);
  }

  if (auto measured = measure_all(*plan, result); !measured) return measured;
  say("drawing the figures");
  if (auto figures = draw_figures(*context, *stage, *plan, result, *out, pictures); !figures) return figures;
  result.seconds = static_cast<double>(clock.now_ns() - start_ns) * 1e-9;
  if (auto written = write_results(result, pictures, stage->phrases(), options, *out); !written) return written;
  if (auto accurate = check_measurements(result); !accurate) return accurate;
  std::printf("open %s/report.html\n", options.out.c_str());
  return {};
}

core::Result<void> read_model(const std::string& text, DemoOptions& options) {
  const auto model = curves::ModelName::parse(text);
  if (!model || model->direction_rule) {
    return core::wrong_usage(fmt::format("cannot feel model \"{}\"; choose {} (paper-rule works only for curves)", text,
                                         curves::known_models(curves::ModelUse::Device)));
  }
  options.samples.model = *model;
  options.samples.tapping.model = text;
  return {};
}

// Options for the samples and how they are felt.
void add_sample_options(OptionList& command, DemoOptions& options, const CommandContext& context) {
  command
      .add_option("--material", options.files.shown,
                  "name of a material (touchafm material lists them); repeatable; default: the paper's three")
      .type_name("MATERIAL");
  command
      .add_parsed_option(
          "--model", [&options](const std::string& text) { return read_model(text, options); },
          fmt::format("law of force; auto chooses it by the contact's Tabor parameter, dynamic- is for a lever with "
                      "inertia; one of {}; in tapping one of {}, default: auto",
                      curves::known_models(curves::ModelUse::Device), curves::known_models(curves::ModelUse::Tapped)))
      .show_default("paper")
      .type_name("MODEL");
  command
      .add_parsed_option(
          "--probe",
          [&options](const std::string& text) -> core::Result<void> {
            (exhibit::is_model_file(text) ? options.files.probe : options.samples.probe) = text;
            return {};
          },
          fmt::format("lever and tip from {}/probes.toml instead of the materials' own; or a glTF model of your own "
                      "cantilever, .glb or .gltf, which changes only the picture",
                      context.assets_dir))
      .type_name("PROBE|FILE");
  add_own_sample_option(command, options.files);
  command
      .add_option("--vary", options.samples.vary,
                  "repeat the cycle on every sample at each of n values of one parameter, changed while the servo "
                  "runs: spring-constant=0.1N/m:0.4N/m:3")
      .type_name("KEY=RANGE");
  command
      .add_option("--measured", options.samples.measured,
                  "measured curve to feel as well (.csv, .tab, .h5, .jpk-force or .ibw; see docs/curves.md)")
      .type_name("FILE");
  add_scale_option(command, options.samples.scale);
  add_friction_option(command, options.samples.friction);
  add_tapped_demo_options(command, options.samples.tapping);
}

}  // namespace

void add_demo_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command(
      "demo", "run the demonstration: feel and draw one full cycle on every sample, without hardware or display");
  command.footer(
      "Writes to DIR: report.html (open it), fig5a.png to fig5e.png (side-by-side stereo), summary.json,\n"
      "and, for every material, curve-NAME.csv and session-NAME.afms.\n\n"
      "example: touchafm demo --out out\n"
      "         touchafm demo --out fast --hand-speed 200mm/s --eye-width 1440\n"
      "         touchafm demo --out lever --material mica --model dmt --vary spring-constant=0.1N/m:0.4N/m:3\n"
      "         touchafm demo --out taps --mode tapping --free-amplitude 20nm --spring-constant 40N/m");
  auto options = std::make_shared<DemoOptions>();
  command.add_option("--out", options->out, "folder for the results; created if it does not exist")
      .required()
      .type_name("DIR");
  add_stage_options(command, options->files, context);
  command
      .add_option("--eye-width", options->eye_width,
                  "width of each eye image in pixels during the run; the height follows from the wall; default: 960, "
                  "or what keeps a frame within --frame-budget")
      .within(64, 8192)
      .type_name("PIXELS");
  add_frame_budget(command, options->frame_budget_ms);
  add_gpu_option(command, options->gpu);
  quantity_option(
      command, "--hand-speed", [&hand = options->hand](physics::Velocity speed) { hand.speed_m_per_s = speed.si; },
      physics::kVelocityUnits, "mean speed of the simulated hand", std::optional(kHandSpeeds))
      .show_default("30mm/s");
  add_sample_options(command, *options, context);
  add_servo_mode_option(command, options->servo.mode);
  command.add_flag("--sound", options->sound, "write what each session sounds like, sound-NAME.wav");
  add_sound_options(command, options->sound_options);
  command.when_chosen([options, &context] { return run_demo(*options, context.program_path); });
}

}  // namespace afm::app
