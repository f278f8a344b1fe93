// SPDX-License-Identifier: Apache-2.0
#include "app/live_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "app/guidance.h"
#include "app/interruption.h"
#include "app/key_list.h"
#include "app/panel_hit.h"
#include "app/servo_rows.h"
#include "core/log.h"
#include "haptics/device_probe.h"
#include "input/selection.h"
#include "render/control_layout.h"

namespace afm::app {

namespace {

constexpr double kHiddenPauseS = 0.05;           // between two heartbeats of a window that nobody sees
constexpr std::int64_t kSteadyNs = 250'000'000;  // a window that keeps its size for so long is drawn sharp
constexpr std::int64_t kMinuteNs = 60'000'000'000;
constexpr std::size_t kMostRestarts = 3;               // a minute
constexpr double kDrawnHandM = 0.085;                  // of the hand, shown as a third of the wall's height
constexpr double kHandPerPicture = 3.0 * kDrawnHandM;  // so that the tip follows the cursor on the wall

render::Layout layout_of(StereoMode mode) {
  switch (mode) {
    case StereoMode::Right:
      return render::Layout::Right;
    case StereoMode::SideBySide:
      return render::Layout::SideBySide;
    case StereoMode::Mono:
    case StereoMode::Left:
      break;
  }
  return render::Layout::Left;
}

std::array<scene::EyeView, 2> eyes_for(const Stage& stage, StereoMode mode) {
  if (mode != StereoMode::Mono) return stage.eyes;
  scene::Wall one_eyed = stage.wall;
  one_eyed.viewers.front().ipd_m = 0.0;
  return *eyes_at_sweet_spot(one_eyed);  // the stage was loaded with this wall and this head
}

std::string text_of(const scene::TipEvent& event) {
  const bool in = event.kind == scene::TipEventKind::JumpToContact;
  return fmt::format("{} at Z = {:.3f} nm, pull {:.4f} nN", in ? "jump to contact" : "jump off contact",
                     event.z_m * 1e9, -(in ? event.force_after_n : event.force_before_n) * 1e9);
}

void log_parameters(const LiveParameters& parameters) {
  std::string line = "parameters:";
  for (std::size_t i = 0; i < LiveParameters::kRows; ++i) {
    const auto row = static_cast<LiveParameters::Row>(i);
    line += fmt::format("{} {}", i == 0 ? "" : ",", parameters.value(row));
  }
  core::log_line(line);
}

std::optional<std::size_t> digit(render::Key key) {
  if (key < render::Key::Digit1 || key > render::Key::Digit9) return std::nullopt;
  return static_cast<std::size_t>(key) - static_cast<std::size_t>(render::Key::Digit1);
}

}  // namespace

LiveView::LiveView(const Stage& stage, const std::vector<FeltMaterial>& materials, render::Window& window,
                   render::Renderer& renderer, render::Presenter& presenter, ServoStarter start_servo,
                   const core::Clock& clock, const ViewSettings& settings)
    : stage_(stage),
      window_(window),
      renderer_(renderer),
      presenter_(presenter),
      start_servo_(std::move(start_servo)),
      clock_(clock),
      settings_(settings),
      felt_(materials),
      frames_(stage.wall_scene, felt_, stage.eyes),
      swatches_(stage.wall_scene.swatch_targets()),
      eyes_(eyes_for(stage, settings.stereo)),
      wand_(stage.wall.screens.front(), stage.wall_scene.wand_grip_m()),
      hand_(stage.wall_scene.sample_normal(), stage.wall_scene.sample_right()),
      person_(stage.wall_scene.wand_grip_m(), stage.wall_scene.sample_normal(), HandPath{}),
      cycles_(stage.materials.materials.size()),
      edits_(materials),
      eye_size_px_(settings.eye_px) {}

core::Result<void> LiveView::start_servo() {
  auto servo = start_servo_();
  if (!servo) return tl::unexpected(servo.error());
  servo_ = std::move(*servo);
  servo_error_.reset();
  stream_ = {};
  hand_ = MouseHand(stage_.wall_scene.sample_normal(), stage_.wall_scene.sample_right());
  edits_.resend(*servo_);
  if (settings_.first_material) choose(*settings_.first_material);
  return {};
}

core::Result<void> LiveView::run() {
  if (!settings_.record_folder.empty()) {
    auto folder = SessionFolder::open(settings_.record_folder);
    if (!folder) return tl::unexpected(folder.error());
    folder_ = std::move(*folder);
  }
  if (auto started = start_servo(); !started) return started;
  hand_moved_ns_ = clock_.now_ns();
  while (!leaving_ && !interrupted()) {
    const std::int64_t now_ns = clock_.now_ns();
    const render::WindowInput input = window_.poll();
    leaving_ = input.close_requested;
    for (const render::WindowEvent& event : input.events) handle(event, now_ns);
    move_hand(input.cursor_px, now_ns);
    take_news(now_ns);
    if (window_.size_px().x == 0) {
      window_.wait(kHiddenPauseS);
      continue;
    }
    fit_renderer(now_ns);
    draw(input.cursor_px, now_ns);
    pace(now_ns);
  }
  recorder_.finish();
  keep_session();
  servo_.reset();  // the hand is released while the last picture still stands
  if (servo_error_) return tl::unexpected(*servo_error_);
  return {};
}

void LiveView::handle(const render::WindowEvent& event, std::int64_t now_ns) {
  using Kind = render::WindowEvent::Kind;
  hand_.take(event, hand_m_per_px(), now_ns);
  if (event.kind == Kind::KeyDown) handle_key(event.key);
  if (event.kind == Kind::ButtonDown && event.button == render::MouseButton::Left) click(event.cursor_px);
}

void LiveView::handle_key(render::Key key) {
  if (const auto number = digit(key)) {
    if (*number < swatches_.size()) choose(*number);
    return;
  }
  switch (key) {
    case render::Key::Escape:
      leaving_ = true;
      break;
    case render::Key::F1:
      keys_shown_ = !keys_shown_;
      break;
    case render::Key::F2:
      parameters_shown_ = !parameters_shown_;
      break;
    case render::Key::F11:
      window_.set_full_screen(!window_.full_screen());
      break;
    case render::Key::M:
      next_scale();
      break;
    case render::Key::P:
      panels_hidden_ = !panels_hidden_;
      break;
    case render::Key::R:
      reset();
      break;
    case render::Key::S:
      settings_.swap_eyes = !settings_.swap_eyes;
      core::log_line(settings_.swap_eyes ? "eyes swapped" : "eyes as they were");
      break;
    default:
      break;
  }
}

LiveView::Pointed LiveView::pointed_at(const input::Ray& ray) {
  Pointed pointed{.control = {}, .tab = false, .swatch = {}, .point_m = wand_.wall_point(ray)};
  const render::PanelPlacement panel = stage_.wall_scene.parameter_placement();
  if (const auto hit = material() && parameters_shown_ && !panels_hidden_ ? hit_of(ray, panel) : std::nullopt) {
    pointed.control = render::control_at(parameter_panel(edits_.of(*material()), "", ChangeState::AsLoaded),
                                         size_mm(panel), hit->place_mm);
    return pointed;
  }
  if (!parameters_shown_ && material() && hit_of(ray, stage_.wall_scene.parameter_tab_placement())) {
    pointed.tab = true;
    return pointed;
  }
  pointed.swatch = input::pick(ray, input::kPickConeRad, swatches_);
  if (pointed.swatch) pointed.point_m = swatches_[*pointed.swatch].center_m;
  return pointed;
}

void LiveView::click(const glm::dvec2& cursor_px) {
  const Pointed pointed = pointed_at(wand_.ray(picture(), cursor_px));
  if (pointed.tab) parameters_shown_ = true;
  if (pointed.swatch) choose(*pointed.swatch);
  if (!pointed.control || servo_error_) return;
  const bool button = pointed.control->kind == render::ControlTarget::Kind::Button;
  if (button && static_cast<PanelButton>(pointed.control->index) == PanelButton::Close) {
    parameters_shown_ = false;
    return;
  }
  edits_.apply(*pointed.control, *material(), *servo_);
  log_parameters(edits_.of(*material()));
}

std::optional<std::size_t> LiveView::material() const {
  const std::int32_t material = servo_->tip().material;
  return material < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(material));
}

void LiveView::choose(std::size_t material) {
  if (servo_error_) return;
  servo_->choose(static_cast<std::int32_t>(material), settings_.scale);
  if (settings_.hand == HandSource::Simulated) {
    person_.begin(swatches_[material].center_m, static_cast<std::int32_t>(material), clock_.now_ns());
  }
  core::log_line("chosen: " + stage_.materials.materials[material].title);
}

// Felt once the tip is off the sample, as another material is.
void LiveView::next_scale() {
  using scene::ScaleMode;
  const ScaleMode now = settings_.scale;
  settings_.scale = now == ScaleMode::Fit          ? ScaleMode::Compressed
                    : now == ScaleMode::Compressed ? ScaleMode::Common
                                                   : ScaleMode::Fit;
  core::log_line(std::string("scale ") + text_of(settings_.scale));
  if (const auto current = material(); current && !servo_error_) {
    servo_->choose(static_cast<std::int32_t>(*current), settings_.scale);
  }
}

// Everything as after the start: also the way to go on after the servo has died.
void LiveView::reset() {
  cycles_ = FeltCycles(stage_.materials.materials.size());
  hand_.lift();
  if (!servo_error_) {
    edits_.reset(*servo_);
    return;
  }
  if (auto started = start_servo(); started) {
    core::log_line("the servo was started again");
  } else {
    servo_error_ = started.error();
  }
}

// The eye images get the pixels that the window has for them, once it has stopped changing.
void LiveView::fit_renderer(std::int64_t now_ns) {
  const glm::uvec2 window_px = window_.size_px();
  if (window_px != window_size_px_) {
    window_size_px_ = window_px;
    window_steady_since_ns_ = now_ns;
  }
  if (settings_.fixed_eye_size || now_ns - window_steady_since_ns_ < kSteadyNs) return;
  const render::RendererOptions options = stage_.renderer_options(stage_.eye_width_within(window_px, eyes_beside()));
  const glm::uvec2 size(options.eye_width, options.eye_height);
  if (size == eye_size_px_) return;
  eye_size_px_ = size;
  if (auto resized = renderer_.resize(size.x, size.y); !resized) core::log_line(resized.error().message);
}

std::uint32_t LiveView::eyes_beside() const { return settings_.stereo == StereoMode::SideBySide ? 2 : 1; }

WallPicture LiveView::picture() const {
  const glm::uvec2 picture_px(eye_size_px_.x * eyes_beside(), eye_size_px_.y);
  WallPicture picture{.place = render::picture_place(glm::max(window_.size_px(), glm::uvec2(1)), picture_px),
                      .layout = layout_of(settings_.stereo),
                      .eyes = eyes_};
  if (settings_.swap_eyes) std::swap(picture.eyes[0], picture.eyes[1]);
  return picture;
}

double LiveView::hand_m_per_px() const { return kHandPerPicture / picture().place.size_px.y; }

void LiveView::move_hand(const glm::dvec2& cursor_px, std::int64_t now_ns) {
  const double frame_s = static_cast<double>(now_ns - std::exchange(hand_moved_ns_, now_ns)) * 1e-9;
  if (servo_error_) return;
  if (hand() == HandSource::Device) return;
  if (hand() == HandSource::Mouse) {
    hand_.update(cursor_px, hand_m_per_px(), frame_s, now_ns);
    servo_->script(hand_.script());
    return;
  }
  const std::int32_t material = servo_->tip().material;
  if (person_.step() == SimulatedPerson::Step::Done && material >= 0) {
    person_.begin(swatches_[static_cast<std::size_t>(material)].center_m, material, now_ns);
  }
  person_.update(now_ns, servo_->tip());
  servo_->script(person_.hand());
}

// The mouse moves nothing but the simulated hand, which stands in where no device was found.
HandSource LiveView::hand() const {
  const std::string_view device = servo_->device().name.data();
  const bool another = !device.empty() && device != haptics::kSimulatedHand;
  return settings_.hand == HandSource::Mouse && another ? HandSource::Device : settings_.hand;
}

// A folder that has become full or read-only ends the recording, not the view.
void LiveView::keep_session() {
  const auto session = recorder_.take_finished();
  if (!session || !folder_) return;
  if (auto kept = folder_->keep(*session); !kept) {
    core::log_line(kept.error().message + "; nothing more is recorded");
    folder_.reset();
  }
}

// One that died is replaced, without force until the hand lifts and Turn-On is pressed; one that dies again and again,
// or that cannot have its device, needs a person.
void LiveView::lose_servo(const core::Error& error, std::int64_t now_ns) {
  servo_error_ = error;
  core::log_line(error.message);
  while (!restarts_ns_.empty() && now_ns - restarts_ns_.front() > kMinuteNs) restarts_ns_.pop_front();
  if (error.category != core::ErrorCategory::Failed || restarts_ns_.size() >= kMostRestarts) return;
  restarts_ns_.push_back(now_ns);
  const auto felt = material();
  if (auto started = start_servo(); !started) {
    core::log_line(started.error().message);
    return;
  }
  core::log_line("the servo was started again by itself: lift, then press Turn-On");
  told_state_ = scene::ServoState::Disarmed;
  if (felt) choose(*felt);
}

void LiveView::take_news(std::int64_t now_ns) {
  if (servo_error_) return;
  const auto news = servo_->poll(now_ns);
  if (!news) {
    lose_servo(news.error(), now_ns);
    return;
  }
  stream_.take(
      *news,
      [&](const scene::TipSample& sample) {
        cycles_.add(sample);
        if (!folder_) return;
        recorder_.add(sample, *servo_);
        keep_session();
      },
      [&](const scene::TipEvent& event) {
        cycles_.add(event);
        recorder_.add(event);
        core::log_line(text_of(event));
      });
  const scene::TipState& tip = servo_->tip();
  if (told_state_ == tip.servo_state) return;
  told_state_ = tip.servo_state;
  if (told_state_ == scene::ServoState::Running) core::log_line("force on");
  const bool off = told_state_ == scene::ServoState::Disarmed || told_state_ == scene::ServoState::Fault;
  if (off) core::log_line(std::string("force off: ") + reason(tip.fault));
}

Moment LiveView::moment(const Pointed& pointed, std::int64_t now_ns) const {
  const bool touched = servo_->tip().phase == scene::ContactPhase::Attached || cycles_.cycles() > 0;
  Moment now = moment_of(servo_->tip(), touched && cycles_.ascending());
  now.curves = cycles_.curves();
  now.hovered = pointed.swatch;
  now.wand = wand_.towards(pointed.point_m, now_ns);
  now.guidance = guidance(servo_->tip(), cycles_.ascending(), cycles_.cycles());
  now.servo = servo_rows(servo_->tip(), servo_->timing(), servo_->device());
  if (servo_error_) {
    now.servo_state = scene::ServoState::Fault;
    now.guidance = "The servo has ended: no force reaches the hand. R starts it again";
  }
  return now;
}

// What the servo has taken is what the wall shows.
void LiveView::follow_edits() {
  const auto current = material();
  if (!current) return;
  const ChangeState state = edits_.state(*current, servo_->tip());
  const FeltMaterial& edited = edits_.of(*current).felt();
  const bool taken = state == ChangeState::Felt || state == ChangeState::AsLoaded;
  if (!taken || felt_[*current].tables == edited.tables) return;
  felt_[*current] = edited;
  core::log_line("the changed parameters are felt from now on");
}

// The panel, or the tab that opens it; and the curve that follows from what was changed.
void LiveView::add_parameters(const Pointed& pointed, render::FrameState& frame) {
  if (!material()) return;
  const LiveParameters& parameters = edits_.of(*material());
  if (parameters_shown_) {
    frame.control_panel = parameter_panel(parameters, stage_.materials.materials[*material()].title,
                                          edits_.state(*material(), servo_->tip()));
    frame.control_panel.pointed = pointed.control;
    frame.control_placement = stage_.wall_scene.parameter_placement();
  } else {
    frame.labels.push_back({.text = "Change the parameters (F2)",
                            .highlighted = pointed.tab,
                            .placement = stage_.wall_scene.parameter_tab_placement()});
  }
  if (parameters_shown_ || parameters.changed()) add_prediction(parameters, frame.force_panel);
}

void LiveView::arrange_panels(render::FrameState& frame) const {
  if (keys_shown_) {
    frame.data_panel = key_list(hand());
    frame.data_placement = stage_.wall_scene.parameter_placement();
    frame.control_placement = render::kNoPlacement;
    return;
  }
  if (parameters_shown_ && material()) frame.data_placement = render::kNoPlacement;
  if (!panels_hidden_) return;
  frame.force_placement = frame.data_placement = frame.control_placement = render::kNoPlacement;
}

void LiveView::draw(const glm::dvec2& cursor_px, std::int64_t now_ns) {
  const FrameBeat beat(*servo_, clock_);
  follow_edits();
  const WallPicture shown = picture();
  const Pointed pointed = pointed_at(wand_.ray(shown, cursor_px));
  const Moment now = moment(pointed, now_ns);

  scene::SceneTransforms transforms;
  stage_.wall_scene.place({.material = now.material, .tip = now.tip, .hovered = now.hovered, .wand = now.wand},
                          transforms);
  servo_->place(transforms);

  if (now.guidance != guidance_) core::log_line(now.guidance);
  guidance_ = now.guidance;

  render::FrameState frame = frames_.build(now);
  frame.eyes = shown.eyes;
  add_parameters(pointed, frame);
  arrange_panels(frame);
  beat();
  renderer_.render(frame);
  beat();
  presenter_.present(shown.layout, beat);
  beat();
}

void LiveView::pace(std::int64_t frame_start_ns) const {
  const auto frame_ns = static_cast<std::int64_t>(1e9 / settings_.most_frames_per_s);
  const std::int64_t left_ns = frame_start_ns + frame_ns - clock_.now_ns();
  if (left_ns > 0) std::this_thread::sleep_for(std::chrono::nanoseconds(left_ns));
}

}  // namespace afm::app
