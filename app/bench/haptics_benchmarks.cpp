// SPDX-License-Identifier: Apache-2.0
#include "app/bench/haptics_benchmarks.h"
#include "core/percentiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/bench/particle_work.h"
#include "app/bench/render_subjects.h"
#include "app/bench/servo_latency.h"
#include "app/bench/servo_reaction.h"
#include "app/bench/servo_work.h"
#include "core/log.h"
#include "core/written_by.h"
#include "curves/image_file.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/models/topography_model.h"
#include "physics/manipulation/pushed_particles.h"
#include "render/context.h"
#include "render/renderer.h"
#include "scene/samples/particle_files.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/particle_blocks.h"

namespace afm::app {

namespace {

constexpr std::uint32_t kEyeWidth_px = 640;

struct HapticsBenchOptions {
  std::size_t ticks = 200'000;
  double seconds = 10.0;
  int rounds = 20;
  bool json = false;
  std::string sample;  // file of a surface; empty: the largest surface that can be felt
};

struct Figures {
  std::vector<WorkFigure> work;
  std::array<core::Percentiles, kReleases.size()> release_ms;  // times in the order of kReleases
  ServoWake wake;
  std::vector<ParticleWorkFigure> particles;  // figures; the first one: only the law
  std::size_t frames = 0;                     // number drawn during the measurement
  std::string renderer;                       // name of the graphics device
};

// Particles of the set gold-row.
core::Result<std::unique_ptr<scene::SharedParticles>> gold_particles(const std::string& assets_dir) {
  const auto path = scene::particle_file("gold-row", assets_dir);
  if (!path) return tl::unexpected(path.error());
  const auto set = scene::load_particle_set(*path);
  if (!set) return tl::unexpected(set.error());
  return std::make_unique<scene::SharedParticles>(scene::shared_particles(*set));
}

// Measures the servo next to the real renderer, which draws the wall without a window at full rate.
core::Result<void> measure_beside_renderer(const CommandContext& context, const HapticsBenchOptions& options,
                                           Figures& figures) {
  exhibit::ExhibitFiles files;
  files.assets_dir = context.assets_dir;
  auto stage = exhibit::load_exhibit(files);
  if (!stage) return tl::unexpected(stage.error());
  auto vulkan = render::Context::open();
  if (!vulkan) return tl::unexpected(vulkan.error());
  const render::RendererOptions size = stage->renderer_options(kEyeWidth_px);
  auto renderer = render::Renderer::create(*vulkan, stage->wall_scene.scene(), size);
  if (!renderer) return tl::unexpected(renderer.error());
  std::vector<curves::SampleModel> materials;
  for (const scene::MaterialEntry& entry : stage->materials.materials) {
    auto model = curves::make_sample_model(curves::ContactSetup{entry, {}, {}});
    if (!model) return tl::unexpected(model.error());
    materials.push_back(std::move(*model));
  }
  const exhibit::FrameBuilder frames(stage->wall_scene, materials, stage->eyes);
  const render::FrameState frame = frames.build(exhibit::Moment{});
  figures.renderer =
      fmt::format("the wall, 2 x {} x {} pixels on {}", size.eye_width, size.eye_height, vulkan->device_name());
  core::log_line(fmt::format("running the servo for {} s alongside {}", options.seconds, figures.renderer));
  auto wake = measure_servo_wake(context.program_path, options.seconds, [&] { renderer->render(frame); });
  if (!wake) return tl::unexpected(wake.error());
  figures.wake = *wake;
  // a renderer draws nothing that has not changed
  const auto moving = wall_subject(*stage, kEyeWidth_px, WallMotion::TipAndHead);
  if (!moving) return tl::unexpected(moving.error());
  const auto gold = gold_particles(context.assets_dir);
  if (!gold) return tl::unexpected(gold.error());
  auto particles = core::Result<std::vector<ParticleWorkFigure>>{};
  std::atomic<bool> measured = false;
  std::thread ticks([&] {
    particles = measure_particle_work(**gold, options.ticks);
    measured = true;
  });
  for (; !measured; ++figures.frames) renderer->render(moving->frames[figures.frames % moving->frames.size()]);
  ticks.join();
  renderer->wait();
  if (!particles) return tl::unexpected(particles.error());
  figures.particles = std::move(*particles);
  return {};
}

core::Result<MeasuredSurface> measured_surface(const std::string& file) {
  if (file.empty()) return largest_measured_surface();
  constexpr double kStrokeM = 40e-9;  // roughly the stroke of the paper's materials
  auto model = exhibit::load_topography_model(file, {});
  if (!model) return tl::unexpected(model.error());
  const scene::TopographyScale scale = exhibit::topography_scale(*model, kStrokeM);
  const std::string name = fmt::format("measured {} x {}", model->topography.columns, model->topography.rows);
  return MeasuredSurface{name, std::move(model->topography), scale};
}

core::Result<Figures> measure_all(const CommandContext& context, const HapticsBenchOptions& options) {
  Figures figures;
  const auto surface = measured_surface(options.sample);
  if (!surface) return tl::unexpected(surface.error());
  auto work = measure_servo_work(options.ticks, *surface);
  if (!work) return tl::unexpected(work.error());
  figures.work = std::move(*work);
  // before the renderer starts, because a fork would lose its threads
  for (std::size_t i = 0; i < kReleases.size(); ++i) {
    auto lasted_ms = measure_reaction(context.program_path, kReleases[i], options.rounds);
    if (!lasted_ms) return tl::unexpected(lasted_ms.error());
    figures.release_ms[i] = core::percentiles(std::move(*lasted_ms));
  }
  if (auto measured = measure_beside_renderer(context, options, figures); !measured) {
    return tl::unexpected(measured.error());
  }
  return figures;
}

const char* yes_or_no(bool met) { return met ? "yes" : "no"; }

double share(std::uint64_t missed, std::uint64_t ticks) {
  return static_cast<double>(missed) / static_cast<double>(std::max<std::uint64_t>(1, missed + ticks));
}

std::string particle_table(const Figures& figures, const HapticsBenchOptions& options) {
  const core::Percentiles& alone = figures.particles.front().us;
  std::string text = fmt::format(
      "\nwork per tick among particles, us, {} ticks back to back alongside {} ({} frames); at most {:.0f} looks at "
      "contacts a "
      "tick\n"
      "{:<22}{:>8}{:>8}{:>10}{:>10}   {:<10}{:<6}{:>14}{:>14}{:>10}{:>11}\n",
      options.ticks, figures.renderer, figures.frames, physics::kHeapLooks, "", "p50", "p99", "p99.9", "max", "bar",
      "met", "p50 / alone", "p99 / alone", "touching", "exhausted");
  for (const ParticleWorkFigure& each : figures.particles) {
    const bool bar = each.p99_bar_us > 0;
    text += fmt::format(
        "{:<22}{:>8.2f}{:>8.2f}{:>10.2f}{:>10.2f}   {:<10}{:<6}{:>14.1f}{:>14.1f}{:>8.1f} %{:>9.2f} %\n", each.name,
        each.us.p50, each.us.p99, each.us.p999, each.us.max, bar ? fmt::format("p99 {}", each.p99_bar_us) : "",
        bar ? yes_or_no(each.met()) : "", each.us.p50 / alone.p50, each.us.p99 / alone.p99, 100.0 * each.touching_share,
        100.0 * each.exhausted_share);
  }
  return text;
}

std::string table(const Figures& figures, const HapticsBenchOptions& options) {
  std::string text = fmt::format(
      "work per tick, us, {} ticks back to back\n"
      "{:<22}{:>8}{:>8}{:>8}{:>9}   {:<24}{}\n",
      options.ticks, "", "p50", "p99", "p99.9", "max", "bar", "met");
  for (const WorkFigure& each : figures.work) {
    const std::string bar = each.p50_bar_us > 0 ? fmt::format("p50 {}, p99 {}", each.p50_bar_us, each.p99_bar_us)
                                                : fmt::format("p99 {}", each.p99_bar_us);
    text += fmt::format("{:<22}{:>8.2f}{:>8.2f}{:>8.2f}{:>9.2f}   {:<24}{}\n", each.name, each.us.p50, each.us.p99,
                        each.us.p999, each.us.max, bar, yes_or_no(each.met()));
  }

  text += particle_table(figures, options);

  const core::Percentiles servo = core::percentiles(figures.wake.servo.wake_us, figures.wake.servo.wake_max_us);
  const core::Percentiles plain = core::percentiles(figures.wake.plain.late_us, figures.wake.plain.max_us);
  text += fmt::format(
      "\nscheduling latency at 1 kHz, us, {} s alongside {} ({} frames)\n"
      "{:<22}{:>8}{:>8}{:>8}{:>9}   {}\n",
      options.seconds, figures.renderer, figures.wake.frames, "", "p50", "p99", "p99.9", "max", "missed");
  const auto row = [&](const char* name, const core::Percentiles& us, std::uint64_t missed, std::uint64_t ticks) {
    text += fmt::format("{:<22}{:>8.0f}{:>8.0f}{:>8.0f}{:>9.0f}   {} of {} ({:.2f} %)\n", name, us.p50, us.p99, us.p999,
                        us.max, missed, missed + ticks, 100.0 * share(missed, ticks));
  };
  row("servo", servo, figures.wake.servo.missed, figures.wake.servo.ticks);
  row("plain loop", plain, figures.wake.plain.missed, figures.wake.plain.ticks);
  text += fmt::format("{:<22}{:>8.2f}{:>8.2f}{:>8.2f}{:>9.2f}\n", "ratio", servo.p50 / plain.p50, servo.p99 / plain.p99,
                      servo.p999 / plain.p999, servo.max / plain.max);

  text += fmt::format(
      "\ntime until zero force after the renderer is killed, is stopped, or sends Stop, ms, {} rounds\n"
      "{:<22}{:>8}{:>8}{:>8}{:>9}   {:<24}{}\n",
      options.rounds, "", "p50", "", "", "max", "bar", "met");
  for (std::size_t i = 0; i < kReleases.size(); ++i) {
    const core::Percentiles& ms = figures.release_ms[i];
    text += fmt::format("{:<22}{:>8.1f}{:>8}{:>8}{:>9.1f}   {:<24}{}\n", kReleases[i].name, ms.p50, "", "", ms.max,
                        fmt::format("max {:.0f}", kReleases[i].bar_ms), yes_or_no(ms.max <= kReleases[i].bar_ms));
  }
  return text;
}

nlohmann::ordered_json in_seconds(const core::Percentiles& values, double unit_s) {
  return {{"p50_s", unit_s * values.p50},
          {"p99_s", unit_s * values.p99},
          {"p99.9_s", unit_s * values.p999},
          {"max_s", unit_s * values.max}};
}

void add_particles(nlohmann::ordered_json& root, const Figures& figures, const HapticsBenchOptions& options) {
  constexpr double kMicrosecond = 1e-6;
  const core::Percentiles& alone = figures.particles.front().us;
  nlohmann::ordered_json& among = root["particles"];
  among = {{"looks_per_tick", physics::kHeapLooks},
           {"beside", {{"renderer", figures.renderer}, {"frames", figures.frames}}}};
  for (const ParticleWorkFigure& each : figures.particles) {
    nlohmann::ordered_json& work = among["work"][each.name];
    work = in_seconds(each.us, kMicrosecond);
    work["ticks"] = options.ticks;
    work["particles"] = each.particles;
    if (each.p99_bar_us > 0) {
      work["bar_p99_s"] = kMicrosecond * each.p99_bar_us;
      work["met"] = each.met();
    }
    work["p50_to_law_alone"] = each.us.p50 / alone.p50;
    work["p99_to_law_alone"] = each.us.p99 / alone.p99;
    work["touching_share"] = each.touching_share;
    work["exhausted_share"] = each.exhausted_share;
  }
}

std::string json(const Figures& figures, const HapticsBenchOptions& options) {
  constexpr double kMicrosecond = 1e-6, kMillisecond = 1e-3;
  nlohmann::ordered_json root;
  core::name_software(root);
  for (const WorkFigure& each : figures.work) {
    nlohmann::ordered_json& work = root["work"][each.name];
    work = in_seconds(each.us, kMicrosecond);
    work["ticks"] = options.ticks;
    work["bar_p99_s"] = kMicrosecond * each.p99_bar_us;
    if (each.p50_bar_us > 0) work["bar_p50_s"] = kMicrosecond * each.p50_bar_us;
    work["met"] = each.met();
  }
  add_particles(root, figures, options);
  nlohmann::ordered_json& servo = root["wake"]["servo"];
  servo = in_seconds(core::percentiles(figures.wake.servo.wake_us, figures.wake.servo.wake_max_us), kMicrosecond);
  servo["ticks"] = figures.wake.servo.ticks;
  servo["missed"] = figures.wake.servo.missed;
  servo["policy"] = figures.wake.servo.policy_fifo != 0 ? "SCHED_FIFO" : "SCHED_OTHER";
  nlohmann::ordered_json& plain = root["wake"]["plain_loop"];
  plain = in_seconds(core::percentiles(figures.wake.plain.late_us, figures.wake.plain.max_us), kMicrosecond);
  plain["ticks"] = figures.wake.plain.ticks;
  plain["missed"] = figures.wake.plain.missed;
  root["wake"]["beside"] = {{"renderer", figures.renderer}, {"frames", figures.wake.frames}};
  for (std::size_t i = 0; i < kReleases.size(); ++i) {
    const core::Percentiles& ms = figures.release_ms[i];
    nlohmann::ordered_json& release = root["release"][kReleases[i].name];
    release = in_seconds(ms, kMillisecond);
    release["rounds"] = options.rounds;
    release["bar_max_s"] = kMillisecond * kReleases[i].bar_ms;
    release["met"] = ms.max <= kReleases[i].bar_ms;
  }
  return root.dump(2) + "\n";
}

}  // namespace

void add_haptics_benchmarks(OptionList& bench, const CommandContext& context) {
  OptionList command = bench.add_command(
      "haptics",
      "measure a servo tick with each law, the scheduling latency alongside the renderer, and the release of the hand");
  const auto options = std::make_shared<HapticsBenchOptions>();
  command.add_option("--ticks", options->ticks, "ticks per law").within(1000, 10'000'000).show_default();
  command.add_option("--seconds", options->seconds, "run time of the servo alongside the renderer, s")
      .within(0.5, 600.0)
      .show_default()
      .type_name("SECONDS");
  command.add_option("--rounds", options->rounds, "number of renderers to kill and to stop")
      .within(1, 1000)
      .show_default();
  command
      .add_option("--sample", options->sample,
                  fmt::format("measured surface for one of the rows ({}); default: a computed one of {} x {} points",
                              curves::kImageFiles, scene::kMaxTopographySide, scene::kMaxTopographySide))
      .type_name("FILE");
  command.add_flag("--json", options->json, "print JSON with times in seconds instead of tables");
  command.footer("example: touchafm bench haptics --seconds 60");
  command.when_chosen([options, &context]() -> core::Result<void> {
    const auto figures = measure_all(context, *options);
    if (!figures) return tl::unexpected(figures.error());
    std::fputs((options->json ? json(*figures, *options) : table(*figures, *options)).c_str(), stdout);
    return {};
  });
}

}  // namespace afm::app
