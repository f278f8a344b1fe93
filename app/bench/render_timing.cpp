// SPDX-License-Identifier: Apache-2.0
#include "app/bench/render_timing.h"
#include "core/percentiles.h"

#include <fmt/format.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/log.h"
#include "render/context.h"
#include "render/screenshot_queue.h"

namespace afm::app {

namespace {

constexpr int kSettlingFrames = 2;    // frames skipped at the start of each round, after the change of scene
constexpr int kMostGrowthFrames = 4;  // per round; the largest scene takes about a second a frame
constexpr std::size_t kMostOutput = 65536;

struct Way {
  const char* name;
  render::PassMode pass_mode;
  bool one_eye = false;
  render::Redraw redraw = render::Redraw::Changes;
};

constexpr std::array<Way, 4> kWays{{{"multiview", render::PassMode::Multiview},
                                    {"two passes", render::PassMode::TwoPasses},
                                    {"mono", render::PassMode::Automatic, true},
                                    {"all redrawn", render::PassMode::Automatic, false, render::Redraw::Everything}}};

double median(std::vector<double> values) { return core::percentiles(std::move(values)).p50; }

double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double size_pages = 0, resident_pages = 0;
  statm >> size_pages >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// One subject, drawn in one way.
class Drawing {
 public:
  Drawing(render::Context& context, const RenderSubject& subject, const Way& way, render::Renderer renderer)
      : context_(&context), renderer_(std::move(renderer)), frames_(subject.frames) {
    if (!way.one_eye) return;
    for (render::FrameState& frame : frames_) frame.eyes[1] = frame.eyes[0];
  }

  void draw_round(int count, const core::Clock& clock, RenderFigure& figure) {
    const double start_s = processor_seconds();
    for (int i = 0; i < kSettlingFrames; ++i) renderer_.render(next());
    std::int64_t last_ns = clock.now_ns();
    std::vector<double> times_ms;
    for (int i = 0; i < count; ++i) {
      renderer_.render(next());
      const std::int64_t now_ns = clock.now_ns();
      times_ms.push_back(static_cast<double>(now_ns - std::exchange(last_ns, now_ns)) * 1e-6);
      redrawn_ += renderer_.redrawn_share();
    }
    renderer_.wait();
    processor_ms_.push_back(1e3 * (processor_seconds() - start_s) / (kSettlingFrames + count));
    figure.processor_ms = median(processor_ms_);
    times_ms_.insert(times_ms_.end(), times_ms.begin(), times_ms.end());
    figure.round_ms.push_back(median(std::move(times_ms)));
    figure.redrawn = redrawn_ / static_cast<double>(times_ms_.size());
    figure.frame_ms = core::percentiles(times_ms_);
    take_pass_times(figure);
  }

 private:
  const render::FrameState& next() { return frames_[drawn_++ % frames_.size()]; }

  void take_pass_times(RenderFigure& figure) {
    const auto path = std::filesystem::temp_directory_path() / fmt::format("touchafm-bench-{}.png", getpid());
    {
      render::ScreenshotQueue saver(*context_, renderer_);
      saver.save({}, path.string());
    }
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    const auto newest = renderer_.pass_times();
    if (!newest) return;
    passes_.push_back(*newest);
    const auto median_of = [this](double render::PassTimes::* pass) {
      std::vector<double> times;
      times.reserve(passes_.size());
      for (const render::PassTimes& each : passes_) times.push_back(each.*pass);
      return median(std::move(times));
    };
    figure.pass_ms = {.panels_ms = median_of(&render::PassTimes::panels_ms),
                      .shadow_ms = median_of(&render::PassTimes::shadow_ms),
                      .eyes_ms = median_of(&render::PassTimes::eyes_ms),
                      .compose_ms = median_of(&render::PassTimes::compose_ms),
                      .readback_ms = median_of(&render::PassTimes::readback_ms)};
  }

  render::Context* context_;
  render::Renderer renderer_;
  std::vector<render::FrameState> frames_;
  std::size_t drawn_ = 0;
  std::vector<double> times_ms_, processor_ms_;
  double redrawn_ = 0;  // sum over all frames
  std::vector<render::PassTimes> passes_;
};

// Compares within a round: each way with the first way of its subject, each peer with that of the last subject.
void set_ratios(std::vector<RenderFigure>& figures) {
  const RenderFigure* base = nullptr;
  for (RenderFigure& figure : figures) {
    if (base == nullptr || (figure.subject != base->subject && figure.subject != "peer")) base = &figure;
    std::vector<double> ratios;
    ratios.reserve(figure.round_ms.size());
    for (std::size_t i = 0; i < figure.round_ms.size(); ++i) {
      ratios.push_back(figure.round_ms[i] / base->round_ms[i]);
    }
    figure.ratio = median(std::move(ratios));
  }
}

}  // namespace

core::Result<double> printed_frame_ms(const std::string& command) {
  const auto refuse = [&](const std::string& why) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("the command \"{}\" {}: it must print a JSON object with frame_ms", command, why));
  };
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "re"), pclose);
  if (!pipe) return refuse("could not be started");
  std::string text(kMostOutput, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), pipe.get()));
  const nlohmann::json result = nlohmann::json::parse(text, nullptr, false);
  const auto found = result.is_object() ? result.find("frame_ms") : result.end();
  if (found == result.end() || !found->is_number()) return refuse("printed no time");
  const double time_ms = found->get<double>();
  if (!(time_ms > 0.0)) return refuse(fmt::format("printed {} ms", time_ms));
  return time_ms;
}

core::Result<RenderFigures> time_rendering(const std::vector<RenderSubject>& subjects, const RenderTimingPlan& plan,
                                           const core::Clock& clock) {
  auto context = render::Context::open({.gpu = plan.gpu});
  if (!context) return tl::unexpected(context.error());
  RenderFigures result;
  result.device = context->device_name();
  std::vector<Drawing> drawings;
  for (const RenderSubject& subject : subjects) {
    for (const Way& way : kWays) {
      if (way.pass_mode == render::PassMode::Multiview && !context->draws_both_eyes_at_once()) continue;
      if (way.redraw == render::Redraw::Everything && subject.eyes_move) continue;  // always everything
      render::RendererOptions drawing = subject.drawing;
      drawing.samples = plan.samples;
      drawing.lighting = plan.lighting;
      drawing.pass_mode = way.pass_mode;
      drawing.redraw = way.redraw;
      drawing.time_passes = true;
      auto renderer = render::Renderer::create(*context, subject.scene, drawing);
      if (!renderer) return tl::unexpected(renderer.error());
      drawings.emplace_back(*context, subject, way, std::move(*renderer));
      result.figures.push_back({.subject = subject.name, .way = way.name, .things = subject.things});
      RenderFigure warm_up;
      drawings.back().draw_round(kSettlingFrames, clock, warm_up);
      if (subject.things > 0) break;
    }
  }
  for (const std::string& peer : plan.peers) result.figures.push_back({.subject = "peer", .way = peer});
  result.memory_before_bytes = resident_bytes();

  for (int round = 0; round < plan.rounds; ++round) {
    core::log_line(fmt::format("round {} of {}", round + 1, plan.rounds));
    for (std::size_t i = 0; i < result.figures.size(); ++i) {
      RenderFigure& figure = result.figures[i];
      if (i < drawings.size()) {
        drawings[i].draw_round(figure.things > 0 ? std::min(plan.frames, kMostGrowthFrames) : plan.frames, clock,
                               figure);
        continue;
      }
      const auto time_ms = printed_frame_ms(figure.way);
      if (!time_ms) return tl::unexpected(time_ms.error());
      figure.round_ms.push_back(*time_ms);
      figure.frame_ms = core::percentiles(figure.round_ms);
    }
  }
  result.memory_after_bytes = resident_bytes();
  set_ratios(result.figures);
  return result;
}

}  // namespace afm::app
