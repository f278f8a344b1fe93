// SPDX-License-Identifier: Apache-2.0
#include "app/live/scan_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>

#include "app/view/servo_supervisor.h"
#include "app/view/view_choice.h"
#include "app/view/view_hand.h"
#include "app/view/view_panels.h"
#include "app/view/view_parts.h"
#include "core/clock.h"
#include "core/enumerators.h"
#include "core/log.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/scan/scan_panels.h"
#include "exhibit/scan/scan_subject.h"
#include "haptics/sample_axes.h"
#include "servo/servo_client.h"

namespace afm::app {

namespace {

constexpr double kSimulatedMPerS = 0.1;     // speed of a simulated hand that paints
constexpr double kSimulatedLineM = 0.0015;  // distance between its lines
constexpr double kPressedM = -0.004;        // height of its aim relative to the touching tip

// Roles of a hand for the log, in the order of scene::ScanHand.
constexpr const char* kHandTexts[] = {"scan: the tip scans alone", "scan: the tip leads the hand",
                                      "scan: the hand takes the image"};

// Path of a simulated hand over the square, metres of the hand: back and forth, line by line from the top, repeatedly.
glm::dvec2 raster_m(double side_m, double seconds) {
  const double line_s = side_m / kSimulatedMPerS;
  const double lines = std::floor(side_m / kSimulatedLineM);
  const double line = std::fmod(std::floor(seconds / line_s), lines), along = std::fmod(seconds, line_s) / line_s;
  const bool back = std::fmod(line, 2.0) == 1.0;
  return {side_m * ((back ? 1.0 - along : along) - 0.5), side_m * (0.5 - (line + 0.5) / lines)};
}

}  // namespace

ScanControl::ScanControl(ViewParts& parts) : parts_(parts) {
  parts_.servo.hear([this](const scene::TipSample& sample) {
    if (scan_) scan_->follow_hand(sample);
  });
}

void ScanControl::toggle() {
  if (scan_) return end();
  hand_ = scene::ScanHand::Apart;
  begin();
}

// Scans the material under the tip, with the previous scan's settings if there was one.
void ScanControl::begin() {
  const auto material = parts_.servo.material();
  if (!material) return core::log_line("scan: choose a sample first");
  const auto settings = scan_ && material_ == *material ? std::optional(scan_->choice()) : std::nullopt;
  end();
  material_ = *material;
  scanned_ns_ = parts_.clock.now_ns();
  size_ = hand_size();
  exhibit::ScanSubject subject =
      exhibit::scan_subject(parts_.stage.wall_scene, material_, parts_.choice.felt()[material_]);
  const auto hand = hand_part(subject);
  scan_.emplace(std::move(subject), hand);
  ++begun_;
  if (settings) scan_->choose(*settings);
  parts_.panels.set_scan(&*scan_);
  parts_.turn.scan = {.scan = &*scan_, .material = material_, .begun = begun_};
  if (scan_->is_painted() && parts_.hand.source() == HandSource::Mouse) parts_.hand.mouse().scan(true);
  core::log_line(
      fmt::format("scan: {}, {} wide, {} lines", parts_.stage.materials.materials[material_].title,
                  physics::format_quantity(physics::Length(scan_->subject().side_m), physics::kLengthUnits, 3),
                  exhibit::LiveScan::kPixels));
}

void ScanControl::end() {
  if (!scan_) return;
  parts_.panels.set_scan(nullptr);
  parts_.turn.scan.scan = nullptr;
  if (scan_->is_painted() && parts_.hand.source() == HandSource::Mouse) parts_.hand.mouse().scan(false);
  if (has_hand() && parts_.servo.running()) parts_.servo.link().lead({});
  give_hand_back();
  scan_.reset();
  core::log_line("scan: ended");
}

void ScanControl::add_to_moment(exhibit::Moment& now, ViewFrame& /*frame*/) {
  now.wall.false_colours = false_colours_;
  if (scan_) exhibit::show_scan(*scan_, now);
}

// Advice on the hand's role in the scan or on a fault of the image; empty if the procedure's next step must be shown.
std::optional<std::string> ScanControl::guidance(const exhibit::Phrases& phrases) const {
  const scene::TipState& tip = parts_.servo.link().tip();
  if (has_hand()) return exhibit::hand_guidance(*scan_, tip, phrases);
  if (!scan_ || exhibit::hand_uses_tip(tip)) return std::nullopt;
  return exhibit::scan_guidance(*scan_, phrases);
}

// A hand-painted image counts the previous servo's ticks, so another servo begins a new one.
void ScanControl::restart(Restart what) {
  if (what != Restart::Servo) false_colours_ = false;
  if (what == Restart::Everything || (what == Restart::Servo && has_hand())) end();
}

exhibit::HandSize ScanControl::hand_size() const {
  const auto& felt = parts_.choice.felt()[*parts_.servo.material()];
  return exhibit::hand_size(parts_.servo.link().tip().active, felt.parameters.friction.period);
}

std::optional<exhibit::HandPart> ScanControl::hand_part(const exhibit::ScanSubject& subject) const {
  if (hand_ == scene::ScanHand::Apart) return std::nullopt;
  const servo::ServoClient& servo = parts_.servo.link();
  const double shown_m =
      exhibit::reachable_side_m(servo.device(), servo.room_from_sample(), size_, subject.shown_side_m());
  return exhibit::HandPart{.paints = hand_ == scene::ScanHand::Scans,
                           .feedback = feedback_,
                           .side_m = shown_m / subject.shown.lateral,
                           .first_tick = servo.tip().tick};
}

// Changes the hand's mode; without a scan, begins one in the first mode.
void ScanControl::next_hand() {
  if (!parts_.servo.material()) return core::log_line("scan: choose a sample first");
  constexpr std::size_t kRoles = std::size(kHandTexts);  // looks have no hand
  const std::size_t part = scan_ ? (core::index_of(hand_) + 1) % kRoles : 1;
  hand_ = core::kEnumerators<scene::ScanHand>[part];
  core::log_line(kHandTexts[part]);
  begin();
}

void ScanControl::toggle_feedback() {
  if (!has_hand()) return core::log_line("scan: press L first");
  feedback_ = !feedback_;
  core::log_line(feedback_ ? "scan: feedback on" : "scan: feedback off");
  begin();
}

void ScanControl::toggle_colours() {
  false_colours_ = !false_colours_;
  core::log_line(false_colours_ ? "sample: heights in false colours" : "sample: its own colour");
}

void ScanControl::toggle_truth() {
  if (!scan_) return core::log_line("scan: press I first");
  if (scan_->is_painted()) return core::log_line("scan: only of an image that the tip takes by itself");
  scan_->show_truth(!scan_->progress().truth);
  core::log_line(scan_->progress().truth ? "scan: showing what the tip could not reach" : "scan: showing the retrace");
}

// Advances the scan: the work takes a fraction of a millisecond per frame and is bounded even after a late frame.
void ScanControl::update(const ViewFrame& frame) {
  if (!scan_) return;
  if (const auto material = parts_.servo.material(); material && *material != material_) return begin();
  const double seconds = static_cast<double>(frame.now_ns - std::exchange(scanned_ns_, frame.now_ns)) * 1e-9;
  if (!has_hand()) return scan_->advance(seconds);
  if (!parts_.servo.running()) return;
  // the scale has changed, and with it the square that the hand reaches
  if (const exhibit::HandSize size = hand_size(); size != size_) return begin();
  const scene::TipState& tip = parts_.servo.link().tip();
  const glm::dvec2 place_m(tip.surface.xy_m[0], tip.surface.xy_m[1]);
  scene::ScanLead lead = scan_->is_painted() ? exhibit::painting_lead(*scan_)
                                             : leading_.advance(*scan_, size_, tip.led != 0, place_m,
                                                                !scan_->progress().hand->feedback, seconds);
  lead.time_ns = frame.now_ns;
  parts_.servo.link().lead(lead);
}

// Moves a simulated hand in a scan once it has a force: it follows the tip, or it paints.
void ScanControl::take(const ViewInput& /*input*/, const ViewFrame& frame) {
  if (!has_hand() || !parts_.servo.running()) return;
  const scene::TipState& tip = parts_.servo.link().tip();
  const auto& [x, y, z] = tip.hand.position_m;
  if (parts_.hand.source() == HandSource::Mouse && tip.led != 0) parts_.hand.mouse().rest_at({x, y, z});
  if (parts_.hand.source() == HandSource::Simulated) move_simulated_hand(frame.frame_s);
}

// Moves the simulated hand. The origin of its device is the contact point.
void ScanControl::move_simulated_hand(double frame_s) {
  const scene::TipState& tip = parts_.servo.link().tip();
  const glm::dvec3 place_m(tip.hand.position_m[0], tip.hand.position_m[1], tip.hand.position_m[2]);
  const bool force = tip.servo_state == scene::ServoState::Running;
  if (script_.revision != 0 && !force) return give_hand_back();
  const bool at_top = tip.phase == physics::Phase::Free && tip.tip.z_m > tip.active.release_z_m;
  if (script_.revision == 0) {
    if (!force || !at_top) return;
    script_.revision = parts_.hand.person().hand().revision + 1'000'000;  // revision never used by the person
    aim_m_ = place_m;
    way_s_ = 0;
  }
  if (scan_->is_painted()) {
    if (tip.phase == physics::Phase::Attached) way_s_ += frame_s;
    haptics::SampleAxes axes;
    axes.set_orientation(parts_.servo.link().room_from_sample());
    const glm::dvec2 way_m = raster_m(size_.sideways * scan_->subject().shown_side_m(), way_s_);
    const glm::dvec3 left_m = axes.in_device(glm::dvec3(way_m, kPressedM)) - aim_m_;
    aim_m_ += std::min(1.0, 2.0 * kSimulatedMPerS * frame_s / std::max(glm::length(left_m), 1e-6)) * left_m;
  } else if (tip.led != 0) {
    aim_m_ = place_m;
  }
  ++script_.revision;
  script_.target_m = {aim_m_.x, aim_m_.y, aim_m_.z};
  script_.duration_s = std::clamp(frame_s, 0.001, 0.25);
  script_.turn_on_pressed = 1;
  parts_.hand.replace_person(script_);
}

// Returns the hand to the simulated person, who begins again.
void ScanControl::give_hand_back() {
  if (std::exchange(script_, {}).revision == 0) return;
  parts_.hand.replace_person({});
  parts_.hand.begin_person(material_, parts_.clock.now_ns());
}

}  // namespace afm::app
