// SPDX-License-Identifier: Apache-2.0
#include "app/view/servo_supervisor.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "core/check.h"
#include "core/log.h"
#include "core/percentiles.h"
#include "servo/live_picture.h"
#include "servo/servo_client.h"
#include "servo/session_recorder.h"
#include "servo/tip_stream.h"

namespace afm::app {

namespace {

constexpr std::int64_t kMinuteNs = 60'000'000'000;
constexpr std::size_t kMostRestarts = 3;  // limit per minute

// Name of a person's action on the particles or marks between two lifts of the tip.
std::string_view stroke_name(const scene::SharedParticles& particles, bool several) {
  if (particles.soft.hardness_pa > 0.0) return several ? "scratches" : "scratch";
  if (particles.ink.molecules_per_s > 0.0) return several ? "strokes" : "stroke";
  return several ? "pushes" : "push";
}

// Log text of an event; empty for events that occur many times a second.
std::string log_text(const scene::TipEvent& event, const scene::SharedParticles& particles) {
  if (event.kind == physics::EventKind::PushTakenBack)
    return fmt::format("the last {} was taken back", stroke_name(particles, false));
  if (event.kind == physics::EventKind::ParticlesPutBack)
    return fmt::format("all {} were taken back", stroke_name(particles, true));
  if (event.kind == physics::EventKind::InkFlows) return "the tip touches: ink flows";
  if (event.kind == physics::EventKind::LiquidTorn)
    return fmt::format("the liquid tears at Z = {:.1f} nm, pull {:.4f} nN", event.z_m * 1e9,
                       event.force_before_n * 1e9);
  if (event.kind == physics::EventKind::LookedAgain) return "looking again, as long as the tip stays lifted";
  if (event.kind == physics::EventKind::ParticleSwept)
    return fmt::format("looking too hard: the scan pushes a particle away at {:.4f} nN", event.force_before_n * 1e9);
  if (event.kind == physics::EventKind::SurfaceMarked)
    return fmt::format("the tip marks the sample, load {:.4f} nN", event.force_after_n * 1e9);
  if (event.kind == physics::EventKind::JumpToRepulsion || event.kind == physics::EventKind::JumpToAttraction) {
    const bool in = event.kind == physics::EventKind::JumpToRepulsion;
    return fmt::format("jump to the {} state at Z = {:.3f} nm, mean force {:.4f} nN", in ? "repulsive" : "attractive",
                       event.z_m * 1e9, event.force_after_n * 1e9);
  }
  if (!physics::is_jump(event.kind)) return {};
  const bool in = event.kind == physics::EventKind::JumpToContact;
  return fmt::format("{} at Z = {:.3f} nm, pull {:.4f} nN", in ? "jump to contact" : "jump off contact",
                     event.z_m * 1e9, -(in ? event.force_after_n : event.force_before_n) * 1e9);
}

}  // namespace

ServoSupervisor::ServoSupervisor(Starter starter, Started started, std::size_t materials, std::string record_folder,
                                 servo::TipAudience& audience)
    : starter_(std::move(starter)),
      started_(std::move(started)),
      materials_(materials),
      record_folder_(std::move(record_folder)),
      audience_(audience),
      stream_(std::make_unique<servo::TipStream>()),
      cycles_(materials),
      recorder_(std::make_unique<servo::SessionRecorder>()) {}

ServoSupervisor::~ServoSupervisor() = default;

void ServoSupervisor::record(const servo::WallFrame& frame) { recorder_->add(frame); }

void ServoSupervisor::set_force_map(std::optional<servo::RecordedForceMap> map) {
  recorder_->set_force_map(std::move(map));
}

core::Result<void> ServoSupervisor::start() {
  if (!link_ && !record_folder_.empty()) {
    auto folder = servo::SessionFolder::open(record_folder_);
    if (!folder) return tl::unexpected(folder.error());
    folder_ = std::move(*folder);
  }
  return launch(link_ ? "the servo was restarted" : nullptr);
}

core::Result<void> ServoSupervisor::launch(const char* message) {
  // a choice that the servo has not put into effect applies to the next servo
  const std::int32_t chosen = link_ ? link_->chosen() : -1;
  const auto chosen_before = chosen < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(chosen));
  auto servo = starter_();
  if (!servo) {
    if (link_) error_ = servo.error();
    return tl::unexpected(servo.error());
  }
  link_ = std::move(*servo);
  error_.reset();
  *stream_ = {};
  picture_.reset();
  logged_state_ = scene::ServoState::Disarmed;
  if (message != nullptr) core::log_line(message);
  started_(*link_, chosen_before);
  return {};
}

std::optional<std::size_t> ServoSupervisor::material() const {
  const std::int32_t material = link_->tip().material;
  return material < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(material));
}

void ServoSupervisor::update(std::int64_t now_ns) {
  if (error_) return;
  const auto polled = link_->poll(now_ns);
  if (!polled) {
    replace(polled.error(), now_ns);
    return;
  }
  stream_->consume(
      *polled,
      [&](const scene::TipSample& sample) {
        cycles_.add(sample);
        friction_.add(sample);
        follow_picture(sample);
        for (const auto& hears : hears_) hears(sample);
        audience_.heard(sample);
        if (!folder_) return;
        if (recorder_->add(sample, *link_, picture_.get())) describe_session(sample);
        keep_finished();
      },
      [&](const scene::TipEvent& event) {
        cycles_.add(event);
        recorder_->add(event);
        audience_.heard(event);
        cues_.add(event);
        if (picture_) picture_->add(event);
        if (const std::string text = log_text(event, link_->model().particles); !text.empty()) core::log_line(text);
        for (const auto& hears : hears_events_) hears(event);
      });
  if (link_->tip().material < 0 && polled->samples.empty()) recorder_->has_no_contact();
  keep_part(now_ns);
  log_state();
}

// A servo that has been taken over has particles elsewhere: they are measured as they lie.
void ServoSupervisor::follow_picture(const scene::TipSample& sample) {
  servo::follow_settings(picture_, link_->model().particles, link_->device(), sample.settings);
  if (!picture_) return;
  const std::uint64_t looks = picture_->now().looks;
  picture_->add(sample, link_->particle_pages());
  if (picture_->now().looks > looks) core::log_line(servo::text_of(picture_->now().newest));
}

void ServoSupervisor::log_state() {
  const scene::TipState& tip = link_->tip();
  const scene::ServoState before = std::exchange(logged_state_, tip.servo_state);
  if (logged_state_ == before) return;
  if (logged_state_ == scene::ServoState::Running) core::log_line("force on");
  if (scene::is_armed(logged_state_) || before == scene::ServoState::Fault) return;  // fault already logged
  if (tip.fault == scene::FaultCode::ServoSilent) return core::log_line(scene::reason(tip.fault));  // even then
  const bool fault = tip.fault != scene::FaultCode::None;
  core::log_line(fault ? std::string("force off: ") + scene::reason(tip.fault) : "force off");
}

void ServoSupervisor::replace(const core::Error& error, std::int64_t now_ns) {
  error_ = error;
  core::log_line(error.message);
  while (!restarts_ns_.empty() && now_ns - restarts_ns_.front() > kMinuteNs) restarts_ns_.pop_front();
  if (error.category != core::ErrorCategory::Failed || restarts_ns_.size() >= kMostRestarts) {
    core::log_line("the servo has stopped: press R to restart it");
    return;
  }
  restarts_ns_.push_back(now_ns);
  if (auto started = launch("the servo was restarted automatically: lift, then press Turn-On"); !started) {
    core::log_line(started.error().message);
  }
}

void ServoSupervisor::describe_session(const scene::TipSample& first) {
  recorder_->set_earlier(curves_on_wall());
  if (!sources_ || first.material < 0) return;
  recorder_->set_sources(sources_(static_cast<std::size_t>(first.material), recorder_->session().parameters));
}

void ServoSupervisor::keep_finished() {
  const auto session = recorder_->take_finished();
  if (!session || !folder_) return;
  auto kept = folder_->add(*session);
  if (kept) kept = folder_->end();
  if (!kept) stop_recording(kept.error());
}

void ServoSupervisor::keep_part(std::int64_t now_ns) {
  if (!folder_ || !recorder_->has_head() || now_ns - kept_ns_ < servo::SessionWriter::kPauseNs) return;
  kept_ns_ = now_ns;
  if (auto kept = folder_->add(recorder_->session()); !kept) return stop_recording(kept.error());
  recorder_->forget_records();
}

// Stops the recording, but not the view, when a folder has become full or read-only.
void ServoSupervisor::stop_recording(const core::Error& error) {
  core::log_line(error.message + "; recording has stopped");
  folder_.reset();
}

std::vector<servo::EarlierCurve> ServoSupervisor::curves_on_wall() const {
  std::vector<servo::EarlierCurve> earlier;
  const scene::SharedModel& model = link_->model();
  for (std::size_t i = 0; i < cycles_.curves().size(); ++i) {
    const exhibit::CycleCurve& curve = cycles_.curves()[i];
    if (!curve.empty()) earlier.push_back({.material = model.materials[i].name.data(), .points = curve.points()});
  }
  return earlier;
}

// Logs the scheduling latency of the servo.
void ServoSupervisor::log_timing() const {
  const scene::ServoTiming timing = link_->timing();
  if (timing.ticks == 0) return;
  const core::Percentiles wake = core::percentiles(timing.wake_us, timing.wake_max_us);
  core::log_line(
      fmt::format("servo: {} ticks, {} missed; scheduling latency p50 {:.0f}, p99 {:.0f}, p99.9 {:.0f}, max {:.0f} "
                  "\u00b5s; {} samples lost on the way to the wall",
                  timing.ticks, timing.missed, wake.p50, wake.p99, wake.p999, wake.max, link_->lost_samples()));
}

void ServoSupervisor::finish() {
  log_timing();
  recorder_->finish();
  keep_finished();
  link_.reset();
}

}  // namespace afm::app
