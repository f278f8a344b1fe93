// SPDX-License-Identifier: Apache-2.0
#include "app/live/live_view.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string_view>
#include <thread>
#include <utility>

#include "core/interruption.h"
#include "core/log.h"
#include "exhibit/blank_picture.h"
#include "exhibit/cluster/frame_inputs.h"
#include "exhibit/scan/scan_panels.h"
#include "exhibit/servo_rows.h"
#include "exhibit/shared_model.h"
#include "exhibit/wall_layout.h"
#include "render/device_failure.h"

namespace afm::app {

namespace {

constexpr double kHiddenPauseS = 0.05;  // between two heartbeats of a window that nobody sees
constexpr double kBesideWallM = 0.01;   // of the contact: so near, B would change nothing
constexpr double kDrawnHandM = 0.085;   // of the hand, shown as the stroke that a sample's cycle fills

MouseHand hand_over(const exhibit::WallScene& wall_scene) {
  return MouseHand(wall_scene.sample_normal(), wall_scene.sample_right());
}

}  // namespace

LiveView::LiveView(const exhibit::Stage& stage, const std::vector<curves::SampleModel>& materials, ViewWindows& windows,
                   ViewPicture& picture, ServoSupervisor::Starter start_servo, ViewWand& view_wand,
                   const core::Clock& clock, const ViewSettings& settings)
    : stage_(stage),
      windows_(windows),
      clock_(clock),
      settings_(settings),
      felt_(materials),
      frames_(stage.wall_scene, felt_, stage.eyes),
      swatches_(stage.wall_scene.swatch_targets()),
      picture_(picture),
      panels_(stage.wall_scene, materials),
      sound_(settings.sound, stage.phrases(), stage.titles(), clock),
      servo_(
          std::move(start_servo),
          [this](servo::ServoClient& servo, std::optional<std::size_t> felt_before) { begin_with(servo, felt_before); },
          stage.materials.materials.size(), settings.record_folder, sound_.narrator()),
      wand_(stage.screen, stage.wall_scene.wand_grip_m()),
      view_wand_(view_wand),
      head_(stage.wall),
      simulated_head_(stage.wall.viewers.front().sweet_spot, settings.head_script),
      hand_(hand_over(stage.wall_scene)),
      person_(stage.wall_scene.wand_grip_m(), stage.wall_scene.sample_normal(), input::HandPath{}),
      travel_(settings.headset == nullptr ? exhibit::JourneyTravel::Motion::Glide
                                          : exhibit::JourneyTravel::Motion::Steps),
      visitor_(static_cast<std::int64_t>(settings.idle_s * 1e9)),
      cluster_(settings.cluster),
      lesson_(settings.lesson),
      instructor_(settings.instructor) {
  panels_.set_friction(&servo_.friction());
  if (settings_.unattended) panels_.show_visitors_keys_only();
  if (lesson_ != nullptr) panels_.use_for(WallUse::Lesson);
  servo_.hear([this](const scene::TipSample& sample) {
    paint_with(sample);
    if (cluster_ != nullptr) cluster_->hear(sample);
  });
  servo_.hear_jumps([this](const scene::TipEvent& event) {
    if (lesson_ != nullptr) lesson_->happened(event, servo_.link());
    if (cluster_ != nullptr) cluster_->hear(event);
  });
}

void LiveView::begin_with(servo::ServoClient& servo, std::optional<std::size_t> felt_before) {
  if (scan_has_hand()) end_scan();  // its ticks are those of the servo before
  hand_ = hand_over(stage_.wall_scene);
  if (lesson_ != nullptr) lesson_->forget_laid();
  panels_.edits().resend(servo);
  sound_.attach(servo, felt_);
  if (const auto material = felt_before ? felt_before : settings_.first_material) choose(*material);
}

core::Result<void> LiveView::run() {
  const core::OrderlyEnd by_itself;
  if (!settings_.frame_log.empty()) {
    auto log = servo::FrameLog::create(settings_.frame_log, clock_.now_ns());
    if (!log) return tl::unexpected(log.error());
    frame_log_ = std::move(*log);
  }
  if (auto started = servo_.start(); !started) return started;
  hand_moved_ns_ = clock_.now_ns();
  std::optional<core::Error> lost;
  try {
    while (!leaving_ && !core::interrupted()) {
      if (settings_.headset != nullptr) follow_headset();
      run_frame(clock_.now_ns());
    }
  } catch (const render::DeviceFailure& failure) {
    lost = core::Error{core::ErrorCategory::Failed, failure.what()};
  }
  head_.log_latency();
  view_wand_.log_losses();
  if (cluster_ != nullptr) cluster_->log_summary();
  servo_.finish();  // releases the hand and saves the session while the last picture is still visible
  if (lost) return tl::unexpected(*lost);
  picture_.finish();
  if (servo_.error()) return tl::unexpected(*servo_.error());
  return frame_log_ ? frame_log_->finish() : core::Result<void>{};
}

void LiveView::run_frame(std::int64_t now_ns) {
  const ViewInput input = windows_.poll();
  leaving_ = input.close_requested && !settings_.unattended;
  for (const ViewEvent& event : input.events) handle(event, now_ns);
  follow_instructor(now_ns);
  if (std::exchange(cursor_px_, input.cursor_px) != input.cursor_px && !hand_.dragging()) cursor_moved_ns_ = now_ns;
  if (settings_.unattended) follow_visitor(input, now_ns);
  move_hand(input, now_ns);
  share_scan();
  servo_.update(now_ns);
  follow_wand(now_ns);
  if (windows_.hidden() && settings_.headset == nullptr && cluster_ == nullptr) {
    picture_.rest();
    windows_.at(0).wait(kHiddenPauseS);
    return;
  }
  picture_.fit(now_ns);
  if (settings_.headset == nullptr) follow_head(now_ns);
  draw(input, now_ns);
  pace(now_ns);
}

void LiveView::handle(const ViewEvent& input, std::int64_t now_ns) {
  const render::WindowEvent& event = input.event;
  render::WindowEvent on_desktop = event;
  on_desktop.cursor_px = windows_.on_desktop(input.window, event.cursor_px);
  hand_.apply(on_desktop, hand_m_per_px(input.window), now_ns);
  if (event.kind == render::WindowEvent::Kind::ButtonDown && event.button == render::MouseButton::Left) {
    press(pointed_at(input.window, event.cursor_px), wand_.ray(picture_.picture(input.window), event.cursor_px));
  }
  if (event.kind == render::WindowEvent::Kind::KeyDown) press_key(event.key);
}

void LiveView::press_key(render::Key key) {
  const WallUse use = lesson_ == nullptr ? WallUse::Free : WallUse::Lesson;
  for (const LiveKey& row : live_keys()) {
    if (!row.holds(key) || row.press == nullptr || !row.acts(use) || (row.staff && settings_.unattended)) continue;
    row.press(*this, static_cast<std::size_t>(key) - static_cast<std::size_t>(row.key));
  }
}

void LiveView::bring_home() {
  view_wand_.home();
  to_wall_ = glm::dmat4(1.0);
  simulated_head_.home();
}

// The contact comes into the wall's plane, where both eyes see it in one place.
void LiveView::bring_to_wall() {
  if (servo_.link().tip().phase == physics::Phase::Attached) {
    core::log_line("the scene is locked while the tip is in contact");
    return;
  }
  const double before_m = before_wall_m();
  to_wall_ = glm::translate(glm::dmat4(1.0), -before_m * stage_.screen.normal()) * to_wall_;
  core::log_line(fmt::format("moved the contact {:.3f} m {} the viewer, into the plane of the wall", std::abs(before_m),
                             before_m < 0.0 ? "towards" : "away from"));
}

double LiveView::before_wall_m() const {
  const glm::dvec3 contact(to_wall_ * view_wand_.navigation() * glm::dvec4(stage_.wall_scene.contact_m(), 1.0));
  return glm::dot(contact - stage_.screen.lower_left, stage_.screen.normal());
}

Pointed LiveView::pointed_at(std::size_t window, const glm::dvec2& cursor_px) {
  const input::Ray ray = wand_.ray(picture_.picture(window), cursor_px);
  return panels_.pointed_at(ray, wand_.wall_point(ray), servo_.material());
}

// Whichever of wand and mouse was used last.
bool LiveView::wand_points() const { return view_wand_.points() && view_wand_.used_ns() >= cursor_moved_ns_; }

// Like pointed_at(), but uses the target that the wand's ray has snapped to, if there is one.
Pointed LiveView::wand_pointed_at() {
  const input::Ray ray = input::ray_of(view_wand_.state());
  Pointed pointed = panels_.pointed_at(ray, wand_.wall_point(ray), servo_.material());
  if (pointed.control || pointed.tab) return pointed;
  pointed.swatch = view_wand_.hovered();
  if (pointed.swatch) pointed.point_m = swatches_[*pointed.swatch].center_m;
  return pointed;
}

// The sample's new place is where the hand finds it.
void LiveView::follow_wand(std::int64_t now_ns) {
  const WallPicture shown = picture_.picture(0);
  view_wand_.update(now_ns, servo_.link().tip(), 0.5 * (shown.eyes[0].eye_position_m + shown.eyes[1].eye_position_m));
  if (view_wand_.stop_pressed()) stop_force();
  if (view_wand_.select_pressed()) press(wand_pointed_at(), input::ray_of(view_wand_.state()));
  const glm::dmat3 turned(view_wand_.navigation());
  const glm::dvec3 normal = glm::normalize(turned * stage_.wall_scene.sample_normal());
  hand_.set_axes(normal, glm::normalize(turned * stage_.wall_scene.sample_right()));
  person_.set_normal(normal);
}

void LiveView::press(const Pointed& pointed, const input::Ray& ray) {
  if (lesson_ != nullptr) return press_in_lesson(ray, pointed);
  if (pointed.swatch) choose(*pointed.swatch);
  if (const auto material = servo_.material()) {
    panels_.press(pointed, *material, servo_.running() ? &servo_.link() : nullptr);
  }
}

void LiveView::choose(std::size_t material) {
  if (!servo_.running() || material >= swatches_.size()) return;
  servo_.link().choose(static_cast<std::int32_t>(material), settings_.scale);
  if (hand() == HandSource::Simulated) {
    person_.begin(swatches_[material].center_m, static_cast<std::int32_t>(material), clock_.now_ns());
  }
  core::log_line("chosen: " + stage_.materials.materials[material].title);
}

// Felt once the tip is off the sample, as another material is.
void LiveView::next_scale() {
  settings_.scale = scene::after(settings_.scale);
  const scene::ScaleModeText& text = scene::text_of(settings_.scale);
  core::log_line(fmt::format("scale {}: {}", text.word, text.meaning));
  if (const auto current = servo_.material(); current && servo_.running()) {
    servo_.link().choose(static_cast<std::int32_t>(*current), settings_.scale);
  }
}

// Everything as after the start: also the way to go on after the servo has died.
void LiveView::begin_again() {
  servo_.forget_cycles();
  if (cluster_ != nullptr) cluster_->forget();
  if (lesson_ != nullptr) lesson_->forget_laid();
  end_scan();
  hand_.lift();
  if (servo_.running()) {
    panels_.edits().reset(servo_.link());
  } else if (auto started = servo_.start(); !started) {
    core::log_line(started.error().message);
  }
}

void LiveView::stop_force() {
  if (servo_.running()) servo_.link().stop(clock_.now_ns());
}

// So that the tip follows the cursor.
double LiveView::hand_m_per_px(std::size_t window) const {
  const WallPicture shown = picture_.picture(window);
  const double stroke_m = exhibit::kStrokeHeight * stage_.wall_scene.unit_m();
  return kDrawnHandM / stroke_m * shown.screen.height_m() / shown.place.size_px.y;
}

void LiveView::move_hand(const ViewInput& input, std::int64_t now_ns) {
  const double frame_s = static_cast<double>(now_ns - std::exchange(hand_moved_ns_, now_ns)) * 1e-9;
  if (!servo_.running() || hand() == HandSource::Device) return;
  servo::ServoClient& servo = servo_.link();
  go_with_scan(frame_s);
  if (hand() == HandSource::Mouse) {
    hand_.update(windows_.on_desktop(input.window, input.cursor_px), hand_m_per_px(input.window), frame_s, now_ns);
    servo.script(hand_.script());
    return;
  }
  if (scan_script_.revision != 0) return servo.script(scan_script_);
  const std::int32_t material = servo.tip().material;
  const bool done = person_.step() == input::SimulatedPerson::Step::Done && !visitor_.away();
  const bool another = person_.material() != material && servo.chosen() == material;  // a lesson has laid it
  if (material >= 0 && (done || another)) {
    person_.begin(swatches_[static_cast<std::size_t>(material)].center_m, material, now_ns);
  }
  person_.update(now_ns, servo.tip());
  servo.script(person_.hand());
}

// The mouse and the simulated person do not move a real device.
HandSource LiveView::hand() const {
  if (has_own_hand()) return HandSource::Device;
  return settings_.unattended && visitor_.away() ? HandSource::Simulated : settings_.hand;
}

bool LiveView::has_own_hand() const { return servo_.link().device().has_own_hand != 0; }

// What the person at the wall holds.
exhibit::Controls LiveView::controls() const {
  using exhibit::HandControls;
  const exhibit::Pointer pointer = wand_points() ? exhibit::Pointer::Wand : exhibit::Pointer::Mouse;
  switch (hand()) {
    case HandSource::Mouse:
      return {HandControls::Mouse, pointer};
    case HandSource::Simulated:
      return {HandControls::Simulated, pointer};
    case HandSource::Device:
      break;
  }
  return {settings_.device_controls, pointer};
}

exhibit::Hint LiveView::next_hint(std::int64_t now_ns) {
  const scene::TipState& tip = servo_.link().tip();
  const exhibit::CycleHistory& cycles = servo_.cycles();
  // the pull of the sample jerks the hand down on its way up, which is no new approach
  const bool ascending = cycles.ascending() || (cycles.pressed() && tip.tip.z_m > 0.0);
  return procedure_.update(tip, {ascending, cycles.pressed(), cycles.cycles()}, now_ns);
}

exhibit::Moment LiveView::moment(const Pointed& pointed, std::int64_t now_ns) {
  const servo::ServoClient& servo = servo_.link();
  const exhibit::CycleHistory& cycles = servo_.cycles();
  hint_ = next_hint(now_ns);
  const bool touched = servo.tip().phase == physics::Phase::Attached || cycles.cycles() > 0;
  exhibit::Moment now = exhibit::moment_of(servo.tip(), touched && cycles.ascending());
  now.curves = cycles.curves();
  now.wall.hovered = pointed.swatch;
  now.wall.wand = wand_points() ? view_wand_.state() : wand_.towards(pointed.point_m, now_ns);
  now.wall.navigation = to_wall_ * view_wand_.navigation();
  now.guidance = guidance(stage_.phrases());
  now.wall.cue = servo_.cues().at(servo.tip().time_ns);
  now.wall.centerpiece = travel_.orders() ? exhibit::Centerpiece::Journey
                         : analogy_       ? exhibit::Centerpiece::Analogy
                                          : exhibit::Centerpiece::Instrument;
  now.wall.journey_orders = travel_.orders().value_or(0.0);
  now.wall.fade = travel_.fade();
  if (scan_) exhibit::show_scan(*scan_, now);
  now.servo = exhibit::servo_rows(servo.tip(), servo.timing(), servo.device(), stage_.phrases());
  if (auto row = picture_.quality_row()) now.servo.push_back(std::move(*row));
  if (!servo_.running()) now.servo_state = scene::ServoState::Fault;
  hide_sample(now);
  return now;
}

// What the servo has taken is what the wall shows.
void LiveView::follow_edits() {
  if (!panels_.edits().take_felt(servo_.link().tip(), felt_)) return;
  const std::size_t current = *servo_.material();
  sound_.set_ear(current, felt_[current]);
  core::log_line("the changed parameters are now in effect");
}

void LiveView::draw(const ViewInput& input, std::int64_t now_ns) {
  const std::function<void()> beat = heartbeat();
  follow_edits();
  travel(now_ns);
  follow_lesson(now_ns);
  follow_scan(now_ns);
  const Pointed pointed = wand_points() ? wand_pointed_at() : pointed_at(input.window, input.cursor_px);
  exhibit::Moment now = moment(pointed, now_ns);
  cluster::FrameMessage shared;
  if (cluster_ != nullptr) now = share(now, pointed, shared);
  render::FrameState frame = frames_.build(now);
  servo_.link().place(exhibit::shared_transforms(frame.room_from_node));
  record(now);

  follow_sound();
  const std::string said = guidance(stage_.english);
  if (std::exchange(logged_guidance_, said) != said) core::log_line(said);

  const Panelled panelled{.pointed = pointed, .hand = hand(), .tip = servo_.link().tip()};
  // as the other machines got it, which may be the one before
  const std::string caption = cluster_ != nullptr ? exhibit::caption_of(shared) : sound_.narrator().caption();
  add_panels(stage_, panels_, now, panelled, caption, frame);
  add_lesson(frame);
  if (blank_) exhibit::blank(frame);
  if (cluster_ != nullptr) share_built(shared, frame);
  const bool off_wall = std::abs(before_wall_m()) > kBesideWallM;
  picture_.show(frame, off_wall ? exhibit::Relief::BringToWall : exhibit::Relief::NarrowEyes, now_ns, beat, [&] {
    if (cluster_ != nullptr) cluster_->barrier(beat);
  });
  show_to_instructor(now_ns, beat);
  const std::int64_t presented_ns = clock_.now_ns();
  log_frame(now_ns, presented_ns, head_.presented(presented_ns));
}

// A headset's runtime paces its frames.
void LiveView::pace(std::int64_t frame_start_ns) const {
  if (settings_.headset != nullptr && settings_.headset->wants_picture()) return;
  const auto frame_ns = static_cast<std::int64_t>(1e9 / settings_.most_frames_per_s);
  const std::int64_t left_ns = frame_start_ns + frame_ns - clock_.now_ns();
  if (left_ns > 0) std::this_thread::sleep_for(std::chrono::nanoseconds(left_ns));
}

}  // namespace afm::app
