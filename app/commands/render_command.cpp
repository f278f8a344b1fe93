// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/session_stage.h"
#include "app/demo/demonstration.h"
#include "app/live/view_keys.h"
#include "app/options/command.h"
#include "app/options/exhibit_options.h"
#include "app/options/pixel_size_option.h"
#include "app/view/map_overlay.h"
#include "app/view/view_panels.h"
#include "core/log.h"
#include "curves/live_parameters.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/frame/recorded_wall.h"
#include "exhibit/frame/wall_drawing.h"
#include "exhibit/frame/wall_pictures.h"
#include "exhibit/models/model_view.h"
#include "exhibit/panels/parameter_panel.h"
#include "exhibit/panels/scratch_panel.h"
#include "exhibit/scan/live_scan.h"
#include "exhibit/scan/map_picture.h"
#include "exhibit/scan/scan_panels.h"
#include "exhibit/scan/scan_subject.h"
#include "exhibit/scenery/lines_on_sample.h"
#include "exhibit/state/lines_to_write.h"
#include "exhibit/state/particle_task.h"
#include "exhibit/state/particles_now.h"
#include "render/context.h"
#include "render/renderer.h"
#include "scene/samples/adjusted_set.h"
#include "scene/samples/particle_set.h"
#include "servo/replay.h"
#include "servo/session_file.h"

namespace afm::app {

namespace {

struct RenderOptions {
  std::string session;
  std::optional<double> journey_orders;  // orders of the journey, drawn instead of a session
  std::string material = "mica";         // material of the journey
  bool analogy = false;
  exhibit::ModelChoice model;  // model drawn instead of a session or the journey
  bool describe = false;
  bool json = false;
  std::string out;
  double at_s = 0;
  exhibit::PictureOptions picture;
  exhibit::ExhibitFiles files;
};

// Width to height of an eye's picture if the size is given. The paper's wall takes this ratio, so that nothing is
// stretched.
std::optional<double> aspect_of(const exhibit::PictureOptions& picture, scene::StereoMode usual) {
  if (!picture.size_px || picture.size_px->x == 0 || picture.size_px->y == 0) return std::nullopt;
  const glm::dvec2 eye(scene::eye_size(picture.mode.value_or(usual), *picture.size_px));
  return eye.x / eye.y;
}

core::Result<void> draw(
    const exhibit::Stage& stage, const std::vector<curves::SampleModel>& models, const exhibit::Moment& moment,
    const exhibit::PictureOptions& picture, const std::string& out,
    const std::function<void(render::FrameState&)>& add_panels = [](render::FrameState&) {}) {
  auto drawing = exhibit::WallDrawing::open(stage.wall, picture);
  if (!drawing) return tl::unexpected(drawing.error());
  const exhibit::FrameBuilder frames(stage.wall_scene, models, stage.eyes);
  const auto build = [&](const exhibit::OutputPicture&, const std::array<scene::EyeView, 2>& eyes) {
    render::FrameState frame = frames.build(moment);
    add_panels(frame);
    frame.eyes = eyes;
    return frame;
  };
  return drawing->write(stage.wall_scene.scene(), stage.wall_scene.panel_millimetre_m(), build, out);
}

core::Result<void> run_journey(const RenderOptions& options) {
  // the option's range check lets NaN through
  if (!std::isfinite(*options.journey_orders)) {
    return core::failure(core::ErrorCategory::WrongUsage,
                         fmt::format("--journey: {:g} is outside the journey; give 0 to {:g}", *options.journey_orders,
                                     exhibit::kJourneyOrders));
  }
  exhibit::ExhibitFiles files = options.files;
  files.shown = {options.material};
  files.aspect = aspect_of(options.picture, scene::StereoMode::SideBySide);
  auto stage = exhibit::load_exhibit(files);
  if (!stage) return tl::unexpected(stage.error());
  auto model = curves::make_sample_model(curves::ContactSetup{stage->materials.materials.front(), {}, {}});
  if (!model) return tl::unexpected(model.error());
  exhibit::Moment moment;
  moment.wall = {
      .material = 0, .centerpiece = exhibit::Centerpiece::Journey, .journey_orders = *options.journey_orders};
  moment.realtime = true;  // real time, since nothing moves
  return draw(*stage, {*model}, moment, options.picture, options.out);
}

core::Result<void> run_model(const RenderOptions& options) {
  if (options.describe) {
    return exhibit::describe_model(
        options.model.file, options.json ? exhibit::DescriptionForm::Json : exhibit::DescriptionForm::Lines, std::cout);
  }
  auto context = render::Context::open({.gpu = options.picture.gpu});
  if (!context) return tl::unexpected(context.error());
  const scene::StereoMode mode = options.picture.mode.value_or(scene::StereoMode::Mono);
  exhibit::ModelChoice choice = options.model;
  if (options.picture.ipd_m) choice.eyes_apart_m = *options.picture.ipd_m;
  if (mode == scene::StereoMode::Mono) choice.eyes_apart_m = 0.0;
  render::ReadArea area;
  if (const auto& size = options.picture.size_px) {
    if (const auto checked = exhibit::check_picture_size(*size, context->largest_picture_px()); !checked)
      return checked;
    area.size_px = *size;
    choice.size_px = scene::eye_size(mode, *size);
  }
  const auto view = exhibit::open_model(choice);
  if (!view) return tl::unexpected(view.error());
  auto renderer = render::Renderer::create(*context, view->scene,
                                           {.eye_width = choice.size_px.x,
                                            .eye_height = choice.size_px.y,
                                            .samples = exhibit::affordable_samples(*context, choice.size_px)});
  if (!renderer) return tl::unexpected(renderer.error());
  renderer->render(view->frame);
  const render::Composition composition{.mode = mode, .order = options.picture.order};
  std::vector<render::Image> pictures;
  if (scene::has_two_pictures(mode)) {
    for (render::Image& picture : renderer->read_pair(composition, area)) pictures.push_back(std::move(picture));
  } else {
    pictures.push_back(renderer->read_composed(composition, area));
  }
  return exhibit::write_wall(pictures, options.out);
}

// Sets head, eyes and mode of the recorded frame, unless the user overrides them.
void look_as(const servo::WallFrame& frame, scene::Wall& wall, exhibit::PictureOptions& picture) {
  wall.viewers.front().sweet_spot = exhibit::head_of(frame.head);
  if (!picture.ipd_m) picture.ipd_m = frame.ipd_m;
  const auto mode = scene::parse_stereo_mode(frame.stereo);
  const bool as_the_file_says = !wall.outputs.empty() && mode && wall.outputs.front().mode == *mode;
  if (!picture.mode && mode && !as_the_file_says) picture.mode = *mode;
  if (frame.eyes_swapped) {
    const bool straight = picture.order == scene::EyeOrder::Straight;
    picture.order = straight ? scene::EyeOrder::Swapped : scene::EyeOrder::Straight;
  }
}

// Shows a map in the panels as in the frame; returns the visible part of the curves of a whole felt map.
MapView show_map(const servo::WallFrame& frame, const std::vector<curves::SampleModel>& models,
                 std::optional<std::size_t> material, ViewPanels& panels, scene::TipState& tip) {
  if (!frame.map || !material || !models[*material].pixel) return {};
  const servo::RecordedMapView& map = *frame.map;
  if (const auto quantity = exhibit::map_quantity_of(map.quantity))
    panels.show_map_quantity(*models[*material].pixel, *quantity);
  if (!models[*material].felt_map) return {};
  tip.here = {.reduced_modulus_pa = map.reduced_modulus_pa, .adhesion_j_per_m2 = map.adhesion_j_per_m2};
  return {.slice = map.slice, .equal_force_n = map.equal_force_n};
}

// Draws the frame as it was on the live wall.
core::Result<void> draw_frame(exhibit::Stage& stage, const std::vector<curves::SampleModel>& models,
                              const servo::RecordedSession& session, const exhibit::ParticlesNow* particles,
                              std::int64_t time_ns, const RenderOptions& options) {
  exhibit::RecordedMoment then = exhibit::moment_on_wall(session, stage.materials.names(), time_ns);
  then.moment.curves = then.curves;
  then.moment.wall.particles = particles;
  if (options.analogy) then.moment.wall.centerpiece = exhibit::Centerpiece::Analogy;
  exhibit::PictureOptions picture = options.picture;
  look_as(*then.frame, stage.wall, picture);
  ViewPanels panels(stage.wall_scene, models, key_list);
  panels.set_friction(&then.friction);
  panels.show(then.frame->panels);
  std::optional<exhibit::LiveScan> scan;
  if (then.frame->scan) {
    const exhibit::ScanProgress progress = exhibit::scan_progress_of(*then.frame);
    if (!exhibit::LiveScan::valid(progress)) {
      return core::failure(
          core::ErrorCategory::BadInputFile,
          fmt::format("session file {}: its scan has settings that no scan can have", options.session));
    }
    const std::size_t scanned = then.moment.wall.material.value();
    scan.emplace(exhibit::scan_subject(stage.wall_scene, scanned, models[scanned]), progress, session.samples);
    exhibit::show_scan(*scan, then.moment);
    panels.set_scan(&*scan);
  }
  const bool travels = then.moment.wall.centerpiece == exhibit::Centerpiece::Journey;
  const auto material = travels ? std::nullopt : then.moment.wall.material;
  scene::TipState tip;
  tip.tip = then.moment.wall.tip;
  tip.swing = then.moment.wall.swing;
  tip.surface = then.moment.wall.surface;
  MapOverlay overlay(stage, panels);
  const MapView curves_of_map = show_map(*then.frame, models, material, panels, tip);
  const auto add_panels = [&](render::FrameState& frame) {
    panels.add_to(frame, {}, material, material ? stage.phrases().word(stage.materials.materials[*material].title) : "",
                  tip, HandSource::Mouse);
    if (then.moment.wall.particles != nullptr && scene::leaves_marks(*then.moment.wall.particles->set)) {
      exhibit::leave_law_out(*then.moment.wall.particles, stage.phrases(), frame.panels.force.content);
    }
    if (then.frame->lines) exhibit::add_lines(exhibit::lines_of(*then.frame->lines), stage.wall_scene, frame);
    if (material) overlay.add_to(frame, models[*material], then.moment.wall, then.moment.retracting, curves_of_map);
  };
  return draw(stage, models, then.moment, picture, options.out, add_panels);
}

// The session's particles as they lay at that time; no pages if it has none.
core::Result<servo::ReplayedParticles> particles_at(const servo::RecordedSession& session, std::int64_t time_ns,
                                                    const RenderOptions& options,
                                                    std::optional<exhibit::ParticleTask>& task) {
  if (!session.particles) return servo::ReplayedParticles{};
  auto then = servo::replay_particles(session, time_ns, [&](const servo::ReplayedTick& tick) {
    if (task) task->hear(tick);
  });
  if (then) return then;
  return core::failure(then.error().category,
                       fmt::format("session file {}: {}", options.session, then.error().message));
}

// The moment of --at, by the session's clock.
core::Result<std::int64_t> time_of(const servo::RecordedSession& session, double at_s) {
  const double length_s = session.seconds_since_start(session.samples.back().time_ns);
  constexpr double kRoundingS = 0.0005;  // rounding of the printed length
  if (!(at_s >= 0.0 && at_s <= length_s + kRoundingS)) {
    return core::failure(core::ErrorCategory::WrongUsage,
                         fmt::format("--at: {:g} s is outside the session, which lasts {:.3f} s", at_s, length_s));
  }
  return session.samples.front().time_ns + static_cast<std::int64_t>(at_s * 1e9);
}

// Draws a moment of a session without pictures of a wall, such as the demonstration's.
core::Result<void> draw_replayed(const exhibit::Stage& stage, const std::vector<curves::SampleModel>& models,
                                 const servo::RecordedSession& session, std::size_t material,
                                 const exhibit::ParticlesNow* particles, std::int64_t time_ns,
                                 const RenderOptions& options) {
  std::vector<exhibit::CycleCurve> curves(models.size());
  curves[material] = exhibit::curve_until(session, time_ns);
  exhibit::Moment moment = exhibit::moment_of(session, material, time_ns, curves);
  moment.wall.particles = particles;
  moment.guidance = stage.phrases().text<exhibit::Phrase::ReplayedMoment>(
      stage.phrases().word(stage.materials.materials[material].title), fmt::format("{:.2f} s", options.at_s));
  if (options.analogy) moment.wall.centerpiece = exhibit::Centerpiece::Analogy;
  return draw(stage, models, moment, options.picture, options.out, [&](render::FrameState& frame) {
    if (session.curve || session.law_map) return;  // no forecast, since the law was recorded
    exhibit::add_forecast(curves::LiveParameters(models[material]), stage.phrases(), frame.panels.force.content);
  });
}

core::Result<void> run_render(const RenderOptions& options) {
  if (options.journey_orders) return run_journey(options);
  auto session = servo::load_session(options.session);
  if (!session) return tl::unexpected(session.error());
  if (!session->complete) core::log_line(servo::cut_text(*session, options.session));
  exhibit::ExhibitFiles files = options.files;
  const auto seen = scene::parse_stereo_mode(session->wall.empty() ? "" : session->wall.front().stereo);
  files.aspect = aspect_of(options.picture, seen.value_or(scene::StereoMode::SideBySide));
  auto stage = stage_of_session(*session, options.session, files);
  if (!stage) return tl::unexpected(stage.error());
  const auto models = models_of_session(*session, *stage);
  if (!models) return tl::unexpected(models.error());
  const auto at_ns = time_of(*session, options.at_s);
  if (!at_ns) return tl::unexpected(at_ns.error());

  const std::int64_t time_ns = *at_ns;
  std::optional<exhibit::ParticleTask> task;
  if (session->particles && scene::has_task(*stage->particles)) task.emplace(*stage->particles);
  const auto replayed = particles_at(*session, time_ns, options, task);
  if (!replayed) return tl::unexpected(replayed.error());
  const auto limits = session->particles ? scene::push_limits(*stage->particles) : std::vector<scene::PushLimits>();
  const exhibit::ParticlesNow particles{.set = stage->particles.get(),
                                        .pages = replayed->pages,
                                        .push = replayed->push,
                                        .score = task ? task->score() : scene::TaskScore{},
                                        .plan = replayed->plan,
                                        .picture = replayed->picture ? &*replayed->picture : nullptr,
                                        .tiles = replayed->tiles,
                                        .limits = session->particles ? &limits : nullptr};
  const exhibit::ParticlesNow* shown = session->particles ? &particles : nullptr;
  if (!session->wall.empty()) return draw_frame(*stage, *models, *session, shown, time_ns, options);
  const auto names = stage->materials.names();
  const auto material =
      static_cast<std::size_t>(std::find(names.begin(), names.end(), session->material) - names.begin());
  return draw_replayed(*stage, *models, *session, material, shown, time_ns, options);
}

// Options for drawing a model.
void add_model_options(OptionList& command, const Option& gltf, RenderOptions& options) {
  exhibit::ModelChoice& model = options.model;
  command.add_option("--camera", model.camera, "name of a camera in the model, or auto for a view of the whole model")
      .needs(gltf)
      .show_default()
      .type_name("NAME");
  command.add_option("--variant", model.variant, "variant of the model's materials (KHR_materials_variants)")
      .needs(gltf)
      .type_name("NAME");
  Option describe = command
                        .add_flag("--describe", options.describe,
                                  "list the model's contents and which parts are ignored, and why; draws nothing")
                        .needs(gltf);
  command.add_flag("--json", options.json, "print the list as JSON").needs(describe);
}

}  // namespace

void add_render_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command(
      "render",
      "draw a moment of a recorded session, a stage of the journey of scale, or a glTF model, without a window");
  command.footer(
      "example: touchafm render --session out/session-gold.afms --at 5.2 --out gold.png\n"
      "         touchafm render --journey 4.5 --material mica --out lever.png\n"
      "         touchafm render --gltf my_probe.glb --stereo anaglyph-red-cyan --out probe.png");
  auto options = std::make_shared<RenderOptions>();
  OptionList what = command.add_alternatives("subject of the picture");
  const Option session =
      what.add_option("--session", options->session, "session file written by demo or view --record").type_name("FILE");
  const Option journey = what.add_option("--journey", options->journey_orders,
                                         "stage of the journey of scale, without a session: 1 m of the paper's wall "
                                         "shows 10^-S m, from the bench (0) to the atoms (9)")
                             .within(0.0, exhibit::kJourneyOrders)
                             .type_name("S");
  const Option gltf = what.add_option("--gltf", options->model.file, "glTF 2.0 model, .glb or .gltf, drawn on its own")
                          .type_name("FILE");
  add_model_options(command, gltf, *options);
  command.add_option("--material", options->material, "sample for the journey")
      .needs(journey)
      .show_default()
      .type_name("MATERIAL");
  command
      .add_flag("--analogy", options->analogy, "draw Millet's analogy, a magnet on a spring, instead of the instrument")
      .needs(session);
  command
      .add_option("--force-map", options->files.force_map,
                  "file of the force map that the session felt, if it no longer lies where it was recorded")
      .needs(session)
      .type_name("FILE");
  command.add_option("--out", options->out, "PNG file to write").picture_file(".png").type_name("FILE.png");
  const Option at = command
                        .add_option("--at", options->at_s,
                                    "time since the start of the session or of the model's animations, in seconds; "
                                    "default: start of the session, or model at rest")
                        .type_name("SECONDS");
  add_stereo_options(command, options->picture,
                     "the outputs of the wall file, otherwise side-by-side; mono for a model");
  const Option size = pixel_size_option(command, "--size", options->picture.size_px,
                                        "size of the whole picture in pixels; default: from the wall's outputs or from "
                                        "--eye-width; for a model, 960x720 per eye");
  command
      .add_option("--eye-width", options->picture.eye_width,
                  "width of each eye image in pixels; the height follows from the wall")
      .within(64, 8192)
      .excludes(size)
      .show_default()
      .type_name("PIXELS");
  add_gpu_option(command, options->picture.gpu);
  add_stage_options(command, options->files, context);
  add_own_model_options(command, options->files);
  command.when_chosen([options, gltf, at]() -> core::Result<void> {
    if (!options->describe && options->out.empty()) return core::wrong_usage("--out FILE.png is required");
    if (!gltf.given()) return run_render(*options);
    if (at.given()) options->model.at_s = options->at_s;
    return run_model(*options);
  });
}

}  // namespace afm::app
