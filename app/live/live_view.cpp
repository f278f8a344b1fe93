// SPDX-License-Identifier: Apache-2.0
#include "app/live/live_view.h"

#include <chrono>
#include <glm/geometric.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "app/display/view_picture.h"
#include "app/display/view_windows.h"
#include "app/view/live_sound.h"
#include "app/view/servo_supervisor.h"
#include "app/view/view_choice.h"
#include "app/view/view_controls.h"
#include "app/view/view_hand.h"
#include "app/view/view_panels.h"
#include "app/view/view_parts.h"
#include "app/view/view_pointer.h"
#include "app/view/view_wand.h"
#include "core/clock.h"
#include "core/interruption.h"
#include "core/log.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/frame/wall_pictures.h"
#include "exhibit/models/shared_model.h"
#include "exhibit/panels/servo_rows.h"
#include "render/device_failure.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

constexpr double kHiddenPauseS = 0.02;  // time between two heartbeats while the windows are invisible

}  // namespace

LiveView::LiveView(ViewParts& parts, std::function<void(render::Key)> press_key, Settings settings)
    : parts_(parts),
      press_key_(std::move(press_key)),
      settings_(std::move(settings)),
      frames_(std::make_unique<exhibit::FrameBuilder>(parts.stage.wall_scene, parts.choice.felt(), parts.stage.eyes)),
      record_(parts) {}

LiveView::~LiveView() = default;

core::Result<void> LiveView::run() {
  const core::OrderlyEnd by_itself;
  if (auto begun = record_.begin(settings_.frame_log); !begun) return begun;
  if (auto started = parts_.servo.start(); !started) return started;
  frame_ns_ = parts_.clock.now_ns();
  std::optional<core::Error> lost;
  try {
    while (!parts_.turn.leaving && !core::interrupted()) {
      for (ViewControl* control : parts_.controls) control->begin_frame();
      run_frame(parts_.clock.now_ns());
    }
  } catch (const render::DeviceFailure& failure) {
    lost = core::Error{core::ErrorCategory::Failed, failure.what()};
  }
  for (ViewControl* control : parts_.controls) control->finish();
  parts_.servo.finish();  // releases the hand and saves the session while the last picture is still visible
  if (lost) return tl::unexpected(*lost);
  parts_.picture.finish();
  if (parts_.turn.failure) return tl::unexpected(*parts_.turn.failure);
  if (parts_.servo.error()) return tl::unexpected(*parts_.servo.error());
  return record_.finish();
}

void LiveView::run_frame(std::int64_t now_ns) {
  ViewFrame frame{.now_ns = now_ns, .frame_s = static_cast<double>(now_ns - std::exchange(frame_ns_, now_ns)) * 1e-9};
  const ViewInput input = parts_.windows.poll();
  parts_.turn.leaving = input.close_requested && !settings_.unattended;
  notice(input, frame);
  for (const ViewEvent& event : input.events) handle(event, now_ns);
  parts_.pointer.follow(input.cursor_px, parts_.hand.mouse().dragging(), now_ns);
  for (ViewControl* control : parts_.controls) control->take(input, frame);
  move_hand(input, frame);
  parts_.servo.update(now_ns);
  follow_wand(input, frame);
  if (parts_.windows.hidden() && !parts_.turn.draws_unseen) {
    parts_.picture.rest();
    heartbeat_of(parts_)();
    parts_.windows.at(0).wait(kHiddenPauseS);
    return;
  }
  parts_.picture.fit(now_ns);
  draw(input, frame);
  pace(now_ns);
}

void LiveView::notice(const ViewInput& input, const ViewFrame& frame) {
  for (ViewControl* control : parts_.controls) control->notice(input, frame);
}

void LiveView::handle(const ViewEvent& input, std::int64_t now_ns) {
  const render::WindowEvent& event = input.event;
  render::WindowEvent on_desktop = event;
  on_desktop.cursor_px = parts_.windows.on_desktop(input.window, event.cursor_px);
  parts_.hand.mouse().apply(on_desktop, parts_.pointer.hand_m_per_px(input.window), now_ns);
  if (event.kind == render::WindowEvent::Kind::ButtonDown && event.button == render::MouseButton::Left) {
    parts_.choice.press(parts_.pointer.at(input.window, event.cursor_px),
                        parts_.pointer.ray(input.window, event.cursor_px));
  }
  if (event.kind == render::WindowEvent::Kind::KeyDown) press_key_(event.key);
}

void LiveView::move_hand(const ViewInput& input, const ViewFrame& frame) {
  parts_.hand.move({.cursor_px = parts_.windows.on_desktop(input.window, input.cursor_px),
                    .m_per_px = parts_.pointer.hand_m_per_px(input.window),
                    .frame_s = frame.frame_s,
                    .now_ns = frame.now_ns});
}

// Moves the hand's frame with the sample.
void LiveView::follow_wand(const ViewInput& input, const ViewFrame& frame) {
  ViewWand& wand = parts_.wand;
  const WallPicture shown = parts_.picture.picture(0);
  wand.update(frame.now_ns, parts_.servo.link().tip(),
              0.5 * (shown.eyes[0].eye_position_m + shown.eyes[1].eye_position_m));
  notice(input, frame);
  if (wand.stop_pressed()) parts_.choice.stop_force();
  if (wand.select_pressed()) parts_.choice.press(parts_.pointer.at_wand(), input::ray_of(wand.state()));
  const glm::dmat3 turned(wand.navigation());
  const exhibit::WallScene& wall = parts_.stage.wall_scene;
  parts_.hand.set_axes(turned * wall.sample_normal(), turned * wall.sample_right());
}

exhibit::Hint LiveView::next_hint(std::int64_t now_ns) {
  const scene::TipState& tip = parts_.servo.link().tip();
  const exhibit::CycleHistory& cycles = parts_.servo.cycles();
  // the sample's pull jerks the rising hand down, which is not a new approach
  const bool ascending = cycles.ascending() || (cycles.pressed() && tip.tip.z_m > 0.0);
  exhibit::CycleProgress progress{ascending, cycles.pressed(), cycles.cycles()};
  if (tip.material >= 0) {
    const curves::SampleModel& model = parts_.panels.edits().of(static_cast<std::size_t>(tip.material)).model();
    const double free_m = model.parameters.free_amplitude_m;
    if (model.taps()) progress.swing_share = tip.swing.amplitude_m / free_m;
  }
  return procedure_.update(tip, progress, now_ns);
}

exhibit::Moment LiveView::moment(ViewFrame& frame) {
  const servo::ServoClient& servo = parts_.servo.link();
  const exhibit::CycleHistory& cycles = parts_.servo.cycles();
  const bool touched = servo.tip().phase == physics::Phase::Attached || cycles.cycles() > 0;
  exhibit::Moment now = exhibit::moment_of(servo.tip(), touched && cycles.ascending());
  now.curves = cycles.curves();
  now.wall.hovered = frame.pointed.swatch;
  now.wall.wand = parts_.pointer.drawn(frame.pointed, frame.now_ns);
  now.by_wand = parts_.pointer.kind() == exhibit::Pointer::Wand;
  now.guidance = parts_.controls.guidance(parts_.stage.phrases());
  if (parts_.panels.shown() == "keys") now.letters = parts_.windows.at(0).letters();
  now.wall.cue = parts_.servo.cues().at(servo.tip().time_ns);
  now.servo = exhibit::servo_rows(servo.tip(), servo.timing(), servo.device(), parts_.stage.phrases());
  if (auto row = parts_.picture.quality_row()) now.servo.push_back(std::move(*row));
  if (!parts_.servo.running()) {
    now.servo_state = scene::ServoState::Fault;
    now.stopped = false;
  }
  for (ViewControl* control : parts_.controls) control->add_to_moment(now, frame);
  return now;
}

void LiveView::draw(const ViewInput& input, ViewFrame& frame) {
  const ViewControl::Beat beat = heartbeat_of(parts_);
  parts_.choice.follow_edits(frame.now_ns);
  parts_.turn.hint = next_hint(frame.now_ns);
  for (ViewControl* control : parts_.controls) control->update(frame);
  beat();
  frame.pointed = parts_.pointer.now(input.window, input.cursor_px);
  frame.caption = parts_.sound.narrator().caption();
  const exhibit::Moment now = moment(frame);
  render::FrameState picture = frames_->build(now);
  beat();
  parts_.servo.link().place(exhibit::shared_transforms(picture.room_from_node));
  record_.keep(now);
  log_guidance();

  const Panelled panelled{.pointed = frame.pointed, .hand = parts_.hand.source(), .tip = parts_.servo.link().tip()};
  add_panels(parts_.stage, parts_.panels, now, panelled, frame.caption, picture);
  for (ViewControl* control : parts_.controls) control->add_to_picture(picture, frame);
  parts_.picture.show(picture, frame.relief, frame.now_ns, beat, [&] {
    for (ViewControl* control : parts_.controls) control->before_showing(beat);
  });
  for (ViewControl* control : parts_.controls) control->shown(frame, beat);
  record_.presented(frame);
}

void LiveView::log_guidance() {
  const servo::ServoClient& servo = parts_.servo.link();
  if (servo.tip().material < 0 && servo.chosen() >= 0) return;  // chosen sample not yet under the tip
  const std::string line = parts_.controls.guidance(parts_.stage.english);
  if (std::exchange(logged_guidance_, line) != line) core::log_line(line);
}

void LiveView::pace(std::int64_t frame_start_ns) const {
  if (parts_.turn.paced) return;
  const auto frame_ns = static_cast<std::int64_t>(1e9 / settings_.most_frames_per_s);
  const std::int64_t left_ns = frame_start_ns + frame_ns - parts_.clock.now_ns();
  if (left_ns > 0) std::this_thread::sleep_for(std::chrono::nanoseconds(left_ns));
}

}  // namespace afm::app
