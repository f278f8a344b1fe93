// SPDX-License-Identifier: Apache-2.0
#include "app/bench/render_benchmarks.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/bench/render_subjects.h"
#include "app/bench/render_timing.h"
#include "app/options/exhibit_options.h"
#include "app/options/standard_output.h"
#include "core/clock.h"
#include "core/log.h"
#include "core/written_by.h"
#include "exhibit/frame/exhibit_setup.h"
#include "render/context.h"
#include "render/renderer.h"

namespace afm::app {

namespace {

constexpr std::uint32_t kHills = 256;  // quads along each side
constexpr std::uint32_t kBoxes = 1000;
constexpr std::array<std::uint32_t, 4> kGrowingNodes{1, 1000, 10'000, 100'000};
constexpr std::uint32_t kCopies = 2000;
constexpr double kWallBar_ms = 1000.0 / 30.0;
constexpr double kHeadMovingBar_ms = 1000.0 / 15.0;
constexpr double kAtRestBar_ms = 5.0;  // summed over all processors
constexpr double kFirstFrameBar_ms = 1000.0;

struct RenderBenchOptions {
  exhibit::ExhibitFiles files;
  std::uint32_t eye_width = 960;
  RenderTimingPlan plan;
  std::vector<std::string> gltf;
  bool first_frame_alone = false;
  bool files_alone = false;
  bool one_light = false;
  bool json = false;
};

struct FirstFrame {
  double cold_ms = 0, warm_ms = 0;
};

core::Result<exhibit::Stage> load_wall(const RenderBenchOptions& options) {
  return exhibit::load_exhibit(options.files);
}

glm::uvec2 eye_size(const RenderBenchOptions& options) {
  return {options.eye_width, std::max(1U, options.eye_width * 9 / 16)};
}

core::Result<RenderSubject> first_subject(const RenderBenchOptions& options) {
  if (!options.gltf.empty()) return gltf_subject(options.gltf.front(), eye_size(options), 1);
  const auto stage = load_wall(options);
  if (!stage) return tl::unexpected(stage.error());
  return wall_subject(*stage, options.eye_width, WallMotion::None);
}

// Time from before the device is opened, or a glTF file is read, to the end of the first stereo frame.
core::Result<double> first_frame_ms(const RenderBenchOptions& options) {
  const core::MonotonicClock clock;
  std::int64_t start_ns = clock.now_ns();
  const auto subject = first_subject(options);
  if (!subject) return tl::unexpected(subject.error());
  if (options.gltf.empty()) start_ns = clock.now_ns();
  auto context = render::Context::open({.gpu = options.plan.gpu});
  if (!context) return tl::unexpected(context.error());
  render::RendererOptions drawing = subject->drawing;
  drawing.samples = options.plan.samples;
  drawing.lighting = options.plan.lighting;
  auto renderer = render::Renderer::create(*context, subject->scene, drawing);
  if (!renderer) return tl::unexpected(renderer.error());
  renderer->render(subject->frames.front());
  renderer->wait();
  return static_cast<double>(clock.now_ns() - start_ns) * 1e-6;
}

std::string in_quotes(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

// Measured in a separate process, first with an empty and then with a full shader cache of the driver.
core::Result<FirstFrame> first_frames(const std::string& program, const RenderBenchOptions& options) {
  std::string folder = (std::filesystem::temp_directory_path() / "touchafm-shader-cache-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) {
    return core::failure(core::ErrorCategory::Failed,
                         "cannot create the folder " + folder + " for a shader cache: set TMPDIR to a writable folder");
  }
  const std::string command = fmt::format(
      "MESA_SHADER_CACHE_DIR={} {} bench render --first-frame-alone --eye-width {} --samples {} --assets {}{}",
      in_quotes(folder), in_quotes(program), options.eye_width, options.plan.samples,
      in_quotes(options.files.assets_dir), options.one_light ? " --one-light" : "");
  const auto cold = printed_frame_ms(command);
  const auto warm = cold ? printed_frame_ms(command) : cold;
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  if (!warm) return tl::unexpected(warm.error());
  return FirstFrame{.cold_ms = *cold, .warm_ms = *warm};
}

// Adds the wall in each motion and the generated scenes.
core::Result<void> add_own_subjects(const RenderBenchOptions& options, std::vector<RenderSubject>& subjects) {
  const auto stage = load_wall(options);
  if (!stage) return tl::unexpected(stage.error());
  for (const WallMotion motion : {WallMotion::Tip, WallMotion::TipAndHead, WallMotion::None}) {
    auto wall = wall_subject(*stage, options.eye_width, motion);
    if (!wall) return tl::unexpected(wall.error());
    subjects.push_back(std::move(*wall));
  }
  const glm::uvec2 eye_px = eye_size(options);
  subjects.push_back(hills_subject(kHills, eye_px));
  subjects.push_back(boxes_subject(kBoxes, eye_px));
  for (const std::uint32_t nodes : kGrowingNodes) subjects.push_back(growing_subject(nodes, eye_px));
  subjects.push_back(copies_subject(kCopies, eye_px));
  return {};
}

core::Result<std::vector<RenderSubject>> subjects_of(const RenderBenchOptions& options) {
  std::vector<RenderSubject> subjects;
  if (!options.files_alone) {
    if (const auto added = add_own_subjects(options, subjects); !added) return tl::unexpected(added.error());
  }
  for (const std::string& path : options.gltf) {
    auto file = gltf_subject(path, eye_size(options));
    if (!file) return tl::unexpected(file.error());
    subjects.push_back(std::move(*file));
  }
  return subjects;
}

// Figures of the wall that have a limit, for the first and usual way of drawing.
struct WallFigures {
  double frame_ms = 0, head_moving_ms = 0, at_rest_processor_ms = 0;
};

WallFigures wall_figures(const RenderFigures& result) {
  const auto first_of = [&](std::string_view subject) {
    return *std::find_if(result.figures.begin(), result.figures.end(),
                         [&](const RenderFigure& each) { return each.subject == subject; });
  };
  return {.frame_ms = first_of("wall").frame_ms.p50,
          .head_moving_ms = first_of("wall, head moving").frame_ms.p50,
          .at_rest_processor_ms = first_of("wall at rest").processor_ms};
}

std::string rate_line(std::string_view what, double frame_ms, double bar_ms) {
  return fmt::format("{}: {:.1f} frames/s, target {:.0f}: {}\n", what, 1000.0 / frame_ms, 1000.0 / bar_ms,
                     frame_ms <= bar_ms ? "met" : "not met");
}

// Growth of the time: the work of all processors for a frame beyond that for one node, per node or copy.
std::string growth_lines(const RenderFigures& result) {
  std::string text;
  double one_ms = 0.0;
  for (const RenderFigure& each : result.figures) {
    if (each.things == 0) continue;
    if (each.things == 1) one_ms = each.processor_ms;
    text += fmt::format("growth, {}: {:.1f} ms of all processors a frame", each.subject, each.processor_ms);
    if (each.things > 1) text += fmt::format(", {:.2f} us for each", 1e3 * (each.processor_ms - one_ms) / each.things);
    text += "\n";
  }
  return text;
}

// One line for each figure.
std::string figure_lines(const RenderFigures& result, const RenderBenchOptions& options) {
  std::string text = fmt::format(
      "ms per frame, {} samples, {} rounds of {} frames on {}\n"
      "{:<34}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}   {:>8}{:>8}{:>8}{:>8}{:>8}\n",
      options.plan.samples, options.plan.rounds, options.plan.frames, result.device, "", "p50", "p99", "max", "ratio",
      "redrawn", "cpu", "panels", "shadow", "eyes", "compose", "read");
  for (const RenderFigure& each : result.figures) {
    text += fmt::format("{:<34}{:>8.1f}{:>8.1f}{:>8.1f}{:>8.2f}", each.subject + ", " + each.way, each.frame_ms.p50,
                        each.frame_ms.p99, each.frame_ms.max, each.ratio);
    if (each.processor_ms > 0.0) text += fmt::format("{:>6.0f} %{:>8.1f}", 100.0 * each.redrawn, each.processor_ms);
    if (each.pass_ms) {
      text +=
          fmt::format("   {:>8.1f}{:>8.1f}{:>8.1f}{:>8.1f}{:>8.1f}", each.pass_ms->panels_ms, each.pass_ms->shadow_ms,
                      each.pass_ms->eyes_ms, each.pass_ms->compose_ms, each.pass_ms->readback_ms);
    }
    text += "\n";
  }
  return text;
}

std::string table(const RenderFigures& result, const FirstFrame& first, const RenderBenchOptions& options) {
  std::string text = figure_lines(result, options);
  const WallFigures wall = wall_figures(result);
  text += "\n" + rate_line("the wall", wall.frame_ms, kWallBar_ms);
  text += rate_line("the wall, head moving", wall.head_moving_ms, kHeadMovingBar_ms);
  text += fmt::format("the wall at rest: {:.2f} ms of all processors a frame, target {:.0f}: {}\n",
                      wall.at_rest_processor_ms, kAtRestBar_ms,
                      wall.at_rest_processor_ms < kAtRestBar_ms ? "met" : "not met");
  text += fmt::format(
      "first frame: {:.0f} ms with an empty shader cache, {:.0f} ms with a full one, target {:.0f} when empty: {}\n",
      first.cold_ms, first.warm_ms, kFirstFrameBar_ms, first.cold_ms <= kFirstFrameBar_ms ? "met" : "not met");
  text += growth_lines(result);
  text += fmt::format("resident memory: {:.0f} MB at the start, {:.0f} MB at the end\n",
                      1e-6 * result.memory_before_bytes, 1e-6 * result.memory_after_bytes);
  return text;
}

std::string json(const RenderFigures& result, const FirstFrame& first, const RenderBenchOptions& options) {
  constexpr double kMillisecond = 1e-3;
  const WallFigures wall = wall_figures(result);
  nlohmann::ordered_json root{{"device", result.device},
                              {"samples", options.plan.samples},
                              {"rounds", options.plan.rounds},
                              {"frames", options.plan.frames},
                              {"wall_frames_per_s", 1000.0 / wall.frame_ms},
                              {"bar_wall_frame_s", kMillisecond * kWallBar_ms},
                              {"wall_head_moving_frames_per_s", 1000.0 / wall.head_moving_ms},
                              {"bar_wall_head_moving_frame_s", kMillisecond * kHeadMovingBar_ms},
                              {"wall_at_rest_processor_s", kMillisecond * wall.at_rest_processor_ms},
                              {"bar_wall_at_rest_processor_s", kMillisecond * kAtRestBar_ms},
                              {"first_frame_cold_s", kMillisecond * first.cold_ms},
                              {"first_frame_warm_s", kMillisecond * first.warm_ms},
                              {"bar_first_frame_cold_s", kMillisecond * kFirstFrameBar_ms},
                              {"memory_first_bytes", result.memory_before_bytes},
                              {"memory_end_bytes", result.memory_after_bytes}};
  core::name_software(root);
  for (const RenderFigure& each : result.figures) {
    nlohmann::ordered_json figure{{"subject", each.subject},
                                  {"way", each.way},
                                  {"p50_s", kMillisecond * each.frame_ms.p50},
                                  {"p99_s", kMillisecond * each.frame_ms.p99},
                                  {"max_s", kMillisecond * each.frame_ms.max},
                                  {"ratio", each.ratio}};
    if (each.things > 0) figure["things"] = each.things;
    if (each.processor_ms > 0.0) {
      figure["redrawn"] = each.redrawn;
      figure["processor_s"] = kMillisecond * each.processor_ms;
    }
    if (each.pass_ms) {
      figure["passes"] = {{"panels_s", kMillisecond * each.pass_ms->panels_ms},
                          {"shadow_s", kMillisecond * each.pass_ms->shadow_ms},
                          {"eyes_s", kMillisecond * each.pass_ms->eyes_ms},
                          {"compose_s", kMillisecond * each.pass_ms->compose_ms},
                          {"readback_s", kMillisecond * each.pass_ms->readback_ms}};
    }
    root["figures"].push_back(std::move(figure));
  }
  return root.dump(2) + "\n";
}

core::Result<void> run(const RenderBenchOptions& options, const std::string& program) {
  if (options.first_frame_alone) {
    const auto time_ms = first_frame_ms(options);
    if (!time_ms) return tl::unexpected(time_ms.error());
    return write_stdout(nlohmann::json{{"frame_ms", *time_ms}}.dump() + "\n");
  }
  if (options.files_alone) {
    const auto files = subjects_of(options);
    if (!files) return tl::unexpected(files.error());
    const auto timed = time_rendering(*files, options.plan, core::MonotonicClock());
    if (!timed) return tl::unexpected(timed.error());
    return write_stdout(figure_lines(*timed, options));
  }
  const auto first = first_frames(program, options);
  if (!first) return tl::unexpected(first.error());
  const auto subjects = subjects_of(options);
  if (!subjects) return tl::unexpected(subjects.error());
  const auto figures = time_rendering(*subjects, options.plan, core::MonotonicClock());
  if (!figures) return tl::unexpected(figures.error());
  return write_stdout(options.json ? json(*figures, *first, options) : table(*figures, *first, options));
}

}  // namespace

void add_render_benchmarks(OptionList& bench, const CommandContext& context) {
  OptionList command =
      bench.add_command("render", "measure frames of the wall and of other scenes, and the time to the first frame");
  const auto options = std::make_shared<RenderBenchOptions>();
  command.add_option("--rounds", options->plan.rounds, "number of rounds, each of which draws everything")
      .within(1, 1000)
      .show_default();
  command.add_option("--frames", options->plan.frames, "frames per scene and method in a round")
      .within(1, 10'000)
      .show_default();
  command.add_option("--eye-width", options->eye_width, "width of each eye image in pixels")
      .within(16, 8192)
      .show_default()
      .type_name("PIXELS");
  add_gpu_option(command, options->plan.gpu);
  command.add_option("--samples", options->plan.samples, "samples per pixel").one_of({1, 4}).show_default();
  const Option gltf =
      command.add_option("--gltf", options->gltf, "glTF file to draw as well; repeatable").type_name("FILE");
  command
      .add_option("--peer", options->plan.peers,
                  "shell command to time in each round; it must print a JSON object with frame_ms; repeatable")
      .type_name("COMMAND");
  command.add_flag(
      "--first-frame-alone", options->first_frame_alone,
      "print only a JSON object with frame_ms, as --peer expects: the time to the first frame of the wall or, from "
      "reading to the first frame, of the first --gltf");
  const Option json = command.add_flag("--json", options->json, "print JSON with times in seconds instead of a table");
  command
      .add_flag("--files-alone", options->files_alone,
                "measure only the files of --gltf and the peers, and print a line for each")
      .needs(gltf)
      .excludes(json);
  command.add_flag("--one-light", options->one_light,
                   "light scenes with one light and an even ambient light, without shadows, as simple programs do");
  add_stage_options(command, options->files, context);
  command.footer("example: touchafm bench render --rounds 3 --gltf model.glb");
  command.when_chosen([options, &context] {
    if (options->one_light) options->plan.lighting = render::Lighting::KeyAlone;
    return run(*options, context.program_path);
  });
}

}  // namespace afm::app
