// SPDX-License-Identifier: Apache-2.0
#include "app/demo/demonstration.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>
#include <utility>

#include "core/log.h"
#include "core/percentiles.h"
#include "curves/felt_sources.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/models/shared_model.h"
#include "exhibit/panels/servo_rows.h"
#include "exhibit/report/report.h"
#include "exhibit/words/guidance.h"
#include "exhibit/words/phrases.h"
#include "render/renderer.h"
#include "servo/frame_heartbeat.h"
#include "servo/servo_client.h"
#include "servo/session_recorder.h"
#include "servo/tip_stream.h"

namespace afm::app {

namespace {

constexpr double kPatienceSeconds = 20.0;  // time added to the duration of the step itself
constexpr int kMostServosLost = 5;

}  // namespace

Demonstration::Demonstration(const exhibit::Stage& stage, const DemoPlan& plan, render::Renderer& renderer,
                             servo::ServoClient& servo, const core::Clock& clock, const input::HandPath& path,
                             std::function<void()> chosen)
    : wall_scene_(stage.wall_scene),
      phrases_(stage.phrases()),
      plan_(plan),
      materials_(plan.materials),
      frames_(std::make_unique<exhibit::FrameBuilder>(wall_scene_, materials_, stage.eyes)),
      renderer_(renderer),
      servo_(servo),
      clock_(clock),
      path_(path),
      chosen_(std::move(chosen)),
      person_(wall_scene_.places().wand_grip_m(), wall_scene_.sample_normal(), path),
      targets_(wall_scene_.swatch_targets()),
      between_eyes_m_(0.5 * (stage.eyes[0].eye_position_m + stage.eyes[1].eye_position_m)),
      recorder_(std::make_unique<servo::SessionRecorder>()),
      stream_(std::make_unique<servo::TipStream>()),
      curves_(materials_.size()) {
  if (plan.frame_budget_ms > 0) budget_.emplace(plan.frame_budget_ms, renderer.quality().samples);
}

Demonstration::~Demonstration() = default;

core::Result<void> Demonstration::run(exhibit::DemoResult& result, const Progress& progress) {
  for (std::size_t i = 0; i < materials_.size(); ++i) {
    progress(fmt::format("{} of {}: {}", i + 1, materials_.size(), materials_[i].setup.material.title));
    person_.begin(targets_[i].center_m, static_cast<std::int32_t>(i), clock_.now_ns());
    auto session = feel(i, result, progress);
    if (!session) return tl::unexpected(session.error());
    result.sessions.push_back(std::move(*session));
    for (const curves::SampleModel& variation : plan_.variations[i]) {
      session = feel_variation(i, variation, result, progress);
      if (!session) return tl::unexpected(session.error());
      result.variations.push_back({i, variation, std::move(*session), {}});
    }
  }
  result.servo = servo_.timing();
  result.lost_samples = servo_.lost_samples();
  return {};
}

core::Result<servo::RecordedSession> Demonstration::feel_variation(std::size_t material,
                                                                   const curves::SampleModel& variation,
                                                                   exhibit::DemoResult& result,
                                                                   const Progress& progress) {
  progress(fmt::format("  {}", variation.setup.material.title));
  const std::uint32_t revision = servo_.change(material, variation.parameters);
  const std::int64_t start_ns = clock_.now_ns();
  while (servo_.tip().active.edit_revision != revision) {
    if (auto stepped = step(result); !stepped) return tl::unexpected(stepped.error());
    const double waited_s = static_cast<double>(clock_.now_ns() - start_ns) * 1e-9;
    if (servo_.tip().acknowledged.refused_edit == revision || waited_s > kPatienceSeconds) {
      return core::failure(core::ErrorCategory::Failed,
                           fmt::format("{}: the servo refused these parameters", variation.setup.material.title));
    }
  }
  materials_[material] = variation;
  person_.begin_again(clock_.now_ns());
  return feel(material, result, progress);
}

core::Result<servo::RecordedSession> Demonstration::feel(std::size_t material, exhibit::DemoResult& result,
                                                         const Progress& progress) {
  const std::string title = materials_[material].setup.material.title;
  const double stroke_seconds = (path_.lift_m - path_.push_m) / path_.speed_m_per_s;

  std::size_t events_logged = 0;
  int restarts = 0;
  while (person_.step() != input::SimulatedPerson::Step::Done) {
    if (auto stepped = step(result); !stepped) return tl::unexpected(stepped.error());
    if (person_.restarts() != restarts) {
      restarts = person_.restarts();
      if (restarts > kMostServosLost) {
        return core::failure(
            core::ErrorCategory::Failed,
            fmt::format("{}: the servo released the hand {} times ({}); reduce the load on this machine and run again",
                        title, restarts, scene::reason(servo_.tip().fault)));
      }
      progress(fmt::format("  the servo released the hand: {}; lifting again", scene::reason(servo_.tip().fault)));
      recorder_->begin_again();
      forget_cycle(material);
      events_logged = 0;
    }
    const std::vector<scene::TipEvent>& events = recorder_->session().events;
    for (; events_logged < events.size() && events[events_logged].material == static_cast<std::int32_t>(material);
         ++events_logged) {
      const scene::TipEvent& e = events[events_logged];
      if (!physics::begins_cycle(e.kind) && !physics::ends_cycle(e.kind)) continue;
      const bool in = physics::begins_cycle(e.kind);
      if (!physics::is_jump(e.kind)) {
        progress(fmt::format("  jump to the {} state  Z = {:8.4f} nm", in ? "repulsive" : "attractive", e.z_m * 1e9));
        continue;
      }
      progress(fmt::format("  {:<17} Z = {:8.4f} nm   pull {:8.5f} nN", in ? "jump to contact" : "jump off contact",
                           e.z_m * 1e9, -(in ? e.force_after_n : e.force_before_n) * 1e9));
    }
    if (auto patient = keep_patience(title, stroke_seconds, result); !patient) return tl::unexpected(patient.error());
  }
  servo::RecordedSession session = recorder_->session();
  session.material = materials_[material].setup.material.name;
  session.sources = curves::felt_sources(materials_[material].setup, session.parameters);
  return session;
}

core::Result<void> Demonstration::keep_patience(const std::string& title, double step_seconds,
                                                const exhibit::DemoResult& result) const {
  if (person_.seconds_in_step(clock_.now_ns()) <= kPatienceSeconds + step_seconds) return {};
  return core::failure(core::ErrorCategory::Failed,
                       fmt::format("{}: waited {:.0f} s for {} without success ({}; a frame took {:.0f} ms); reduce "
                                   "the load on this machine or --eye-width and run again",
                                   title, kPatienceSeconds + step_seconds, person_.waiting_for(),
                                   scene::reason(servo_.tip().fault), core::percentiles(result.frame_ms).p50));
}

core::Result<void> Demonstration::step(exhibit::DemoResult& result) {
  const std::int64_t start_ns = clock_.now_ns();
  const servo::FrameHeartbeat beat(servo_, clock_);  // between the parts of a frame, each slow on a busy machine
  renderer_.wait_until_ready(beat);
  const std::int64_t now_ns = clock_.now_ns();
  if (auto consumed = consume_update(now_ns); !consumed) return consumed;

  person_.update(now_ns, servo_.tip());
  servo_.script(person_.hand());

  // chooses with the wand's ray and button, like a visitor
  const input::WandState wand = person_.wand(now_ns);
  const input::Selector::Result pointing = selector_.update(wand, between_eyes_m_, targets_);
  if (pointing.chosen) servo_.choose(static_cast<std::int32_t>(*pointing.chosen), plan_.scale);

  const exhibit::Moment now = moment(wand, pointing);
  const render::FrameState frame = frames_->build(now);
  beat();
  servo_.place(exhibit::shared_transforms(frame.room_from_node));
  if (budget_ && result.frame_ms.empty()) budget_->rehearse(renderer_, frame);
  renderer_.render(frame);
  beat();
  if (budget_) budget_->follow(renderer_);
  if (pointing.chosen && chosen_) std::exchange(chosen_, nullptr)();
  result.frame_ms.push_back(static_cast<double>(clock_.now_ns() - start_ns) * 1e-6);
  return {};
}

core::Result<void> Demonstration::consume_update(std::int64_t now_ns) {
  auto update = servo_.poll(now_ns);
  if (!update) return core::failure(update.error().category, update.error().message + "; run again");

  stream_->consume(
      *update,
      [&](const scene::TipSample& sample) {
        const auto material = static_cast<std::size_t>(sample.material);
        if (recorder_->add(sample, servo_)) forget_cycle(material);
        curves_[material].add(sample);
        deepest_z_m_ = std::min(deepest_z_m_, sample.tip.z_m);
      },
      [&](const scene::TipEvent& event) {
        curves_[static_cast<std::size_t>(event.material)].add(event);
        recorder_->add(event);
      });
  return {};
}

void Demonstration::forget_cycle(std::size_t material) {
  curves_[material] = {};
  deepest_z_m_ = std::numeric_limits<double>::infinity();
}

exhibit::Moment Demonstration::moment(const input::WandState& wand, const input::Selector::Result& pointing) const {
  exhibit::Moment now = exhibit::moment_of(servo_.tip(), exhibit::is_retracting(servo_.tip().tip.z_m, deepest_z_m_));
  now.wall.hovered = pointing.hovered;
  now.wall.wand = wand;
  now.guidance = exhibit::step_text(phrases_, hint(), {});
  now.curves = curves_;
  now.servo = exhibit::servo_rows(servo_.tip(), servo_.timing(), servo_.device(), phrases_);
  if (budget_) now.servo.push_back(budget_->row(phrases_));
  now.wall.cue = exhibit::jump_cue(recorder_->session().events, servo_.tip().time_ns);
  return now;
}

exhibit::Hint Demonstration::hint() const {
  using Step = input::SimulatedPerson::Step;
  const std::int32_t material = servo_.tip().material;
  const bool taps = material >= 0 && plan_.materials[static_cast<std::size_t>(material)].taps();
  switch (person_.step()) {
    case Step::PointAtSwatch:
    case Step::PressSelect:
      return exhibit::Hint::ChooseSample;
    case Step::Lift:
      return exhibit::Hint::Lift;
    case Step::PressTurnOn:
      return exhibit::Hint::TurnOn;
    case Step::MoveDown:
      return taps ? exhibit::Hint::TakeSwing : exhibit::Hint::MoveDown;
    case Step::MoveUp:
      return taps ? exhibit::Hint::GiveSwing : exhibit::Hint::MoveUp;
    case Step::Rest:
    case Step::Done:
      break;
  }
  return taps ? exhibit::Hint::SwingsFree : exhibit::Hint::LetGo;
}

}  // namespace afm::app
