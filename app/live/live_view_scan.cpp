// SPDX-License-Identifier: Apache-2.0
// The image that the live window takes of the sample under the tip.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "app/live/live_view.h"
#include "core/enumerators.h"
#include "core/log.h"
#include "exhibit/scan/scan_panels.h"
#include "exhibit/scan/scan_subject.h"
#include "haptics/sample_axes.h"

namespace afm::app {

namespace {

constexpr double kSimulatedMPerS = 0.1;     // of a simulated hand that paints
constexpr double kSimulatedLineM = 0.0015;  // between its lines
constexpr double kPressedM = -0.004;        // its aim, below the height at which the tip touches

// Words for the log, in the order of scene::ScanHand.
constexpr const char* kHandTexts[] = {"scan: the tip scans alone", "scan: the tip leads the hand",
                                      "scan: the hand takes the image"};

// A simulated hand's way over the square, in its metres: to and fro, line by line from the top, again and again.
glm::dvec2 raster_m(double side_m, double seconds) {
  const double line_s = side_m / kSimulatedMPerS;
  const double lines = std::floor(side_m / kSimulatedLineM);
  const double line = std::fmod(std::floor(seconds / line_s), lines), along = std::fmod(seconds, line_s) / line_s;
  const bool back = std::fmod(line, 2.0) == 1.0;
  return {side_m * ((back ? 1.0 - along : along) - 0.5), side_m * (0.5 - (line + 0.5) / lines)};
}

}  // namespace

void LiveView::toggle_scan() {
  if (scan_) return end_scan();
  scan_hand_ = scene::ScanHand::Apart;
  begin_scan();
}

// Of the material under the tip; with the settings of the scan before, if there is one.
void LiveView::begin_scan() {
  const auto material = servo_.material();
  if (!material) return core::log_line("scan: choose a sample first");
  const auto settings = scan_ && scanned_ == *material ? std::optional(scan_->choice()) : std::nullopt;
  end_scan();
  scanned_ = *material;
  scanned_ns_ = clock_.now_ns();
  scan_size_ = hand_size();
  exhibit::ScanSubject subject = exhibit::scan_subject(stage_.wall_scene, scanned_, felt_[scanned_]);
  const auto hand = hand_part(subject);
  scan_.emplace(std::move(subject), hand);
  ++scans_;
  if (settings) scan_->choose(*settings);
  panels_.set_scan(&*scan_);
  if (scan_->is_painted() && this->hand() == HandSource::Mouse) hand_.scan(true);
  core::log_line(
      fmt::format("scan: {}, {} wide, {} lines", stage_.materials.materials[scanned_].title,
                  physics::format_quantity(physics::Length(scan_->subject().side_m), physics::kLengthUnits, 3),
                  exhibit::LiveScan::kPixels));
}

void LiveView::end_scan() {
  if (!scan_) return;
  panels_.set_scan(nullptr);
  if (scan_->is_painted() && hand() == HandSource::Mouse) hand_.scan(false);
  if (scan_has_hand() && servo_.running()) servo_.link().lead({});
  give_hand_back();
  scan_.reset();
  core::log_line("scan: ended");
}

void LiveView::paint_with(const scene::TipSample& sample) {
  if (scan_) scan_->follow_hand(sample);
}

// What the hand can do in the scan, or what is wrong with its image; nothing where the procedure has to be said.
std::optional<std::string> LiveView::scan_guidance(const exhibit::Phrases& phrases) const {
  const scene::TipState& tip = servo_.link().tip();
  if (scan_has_hand()) return exhibit::hand_guidance(*scan_, tip, phrases);
  if (!scan_ || exhibit::hand_uses_tip(tip)) return std::nullopt;
  return exhibit::scan_guidance(*scan_, phrases);
}

bool LiveView::scan_has_hand() const { return scan_ && scan_->progress().hand; }

exhibit::HandSize LiveView::hand_size() const {
  return exhibit::hand_size(servo_.link().tip().active, felt_[*servo_.material()].parameters.friction.period);
}

std::optional<exhibit::HandPart> LiveView::hand_part(const exhibit::ScanSubject& subject) const {
  if (scan_hand_ == scene::ScanHand::Apart) return std::nullopt;
  const servo::ServoClient& servo = servo_.link();
  const double shown_m =
      exhibit::reachable_side_m(servo.device(), servo.room_from_sample(), scan_size_, subject.shown_side_m());
  return exhibit::HandPart{.paints = scan_hand_ == scene::ScanHand::Scans,
                           .feedback = scan_feedback_,
                           .side_m = shown_m / subject.shown.lateral,
                           .first_tick = servo.tip().tick};
}

// The next part of the hand; where there is no scan yet, the first.
void LiveView::next_scan_hand() {
  if (!servo_.material()) return core::log_line("scan: choose a sample first");
  constexpr auto kParts = core::kEnumerators<scene::ScanHand>;
  const std::size_t part = scan_ ? (core::index_of(scan_hand_) + 1) % kParts.size() : 1;
  scan_hand_ = kParts[part];
  core::log_line(kHandTexts[part]);
  begin_scan();
}

void LiveView::toggle_scan_feedback() {
  if (!scan_has_hand()) return core::log_line("scan: press L first");
  scan_feedback_ = !scan_feedback_;
  core::log_line(scan_feedback_ ? "scan: feedback on" : "scan: feedback off");
  begin_scan();
}

void LiveView::toggle_truth() {
  if (!scan_) return core::log_line("scan: press I first");
  if (scan_->is_painted()) return core::log_line("scan: only of an image that the tip takes by itself");
  scan_->show_truth(!scan_->progress().truth);
  core::log_line(scan_->progress().truth ? "scan: showing what the tip could not reach" : "scan: showing the retrace");
}

// In the frame loop: what a frame has to do is a fraction of a millisecond, and bounded however late the frame is.
void LiveView::follow_scan(std::int64_t now_ns) {
  if (!scan_) return;
  if (const auto material = servo_.material(); material && *material != scanned_) {
    return begin_scan();
  }
  const double seconds = static_cast<double>(now_ns - std::exchange(scanned_ns_, now_ns)) * 1e-9;
  if (!scan_has_hand()) return scan_->advance(seconds);
  if (!servo_.running()) return;
  // another scale, on which the hand reaches another square
  if (const exhibit::HandSize size = hand_size(); size != scan_size_) return begin_scan();
  const scene::TipState& tip = servo_.link().tip();
  const glm::dvec2 place_m(tip.surface.xy_m[0], tip.surface.xy_m[1]);
  scene::ScanLead lead = scan_->is_painted() ? exhibit::painting_lead(*scan_)
                                             : leading_.advance(*scan_, scan_size_, tip.led != 0, place_m,
                                                                !scan_->progress().hand->feedback, seconds);
  lead.time_ns = now_ns;
  servo_.link().lead(lead);
}

// What a hand that is not a person's does in a scan, once it has its force: it goes along, or it paints. The simulated
// hand's contact point is the origin of its device.
void LiveView::go_with_scan(double frame_s) {
  if (!scan_has_hand()) return;
  const scene::TipState& tip = servo_.link().tip();
  const glm::dvec3 place_m(tip.hand.position_m[0], tip.hand.position_m[1], tip.hand.position_m[2]);
  if (hand() == HandSource::Mouse && tip.led != 0) hand_.rest_at(place_m);
  if (hand() != HandSource::Simulated) return;
  const bool force = tip.servo_state == scene::ServoState::Running;
  if (scan_script_.revision != 0 && !force) return give_hand_back();
  const bool at_top = tip.phase == physics::Phase::Free && tip.tip.z_m > tip.active.release_z_m;
  if (scan_script_.revision == 0) {
    if (!force || !at_top) return;
    scan_script_.revision = person_.hand().revision + 1'000'000;  // none of the person's own
    scan_aim_m_ = place_m;
    scan_way_s_ = 0;
  }
  if (scan_->is_painted()) {
    if (tip.phase == physics::Phase::Attached) scan_way_s_ += frame_s;
    haptics::SampleAxes axes;
    axes.set_orientation(servo_.link().room_from_sample());
    const glm::dvec2 way_m = raster_m(scan_size_.sideways * scan_->subject().shown_side_m(), scan_way_s_);
    const glm::dvec3 left_m = axes.in_device(glm::dvec3(way_m, kPressedM)) - scan_aim_m_;
    scan_aim_m_ += std::min(1.0, 2.0 * kSimulatedMPerS * frame_s / std::max(glm::length(left_m), 1e-6)) * left_m;
  } else if (tip.led != 0) {
    scan_aim_m_ = place_m;
  }
  ++scan_script_.revision;
  scan_script_.target_m = {scan_aim_m_.x, scan_aim_m_.y, scan_aim_m_.z};
  scan_script_.duration_s = std::clamp(frame_s, 0.001, 0.25);
  scan_script_.turn_on_pressed = 1;
}

// To the simulated person, who begins again.
void LiveView::give_hand_back() {
  if (std::exchange(scan_script_, {}).revision == 0) return;
  person_.begin(swatches_[scanned_].center_m, static_cast<std::int32_t>(scanned_), clock_.now_ns());
}

void LiveView::mark_next_setting() {
  if (const auto material = servo_.material()) panels_.mark_next(*material);
}

void LiveView::step_setting(int steps) {
  if (lesson_ != nullptr) return lesson_->step(steps);
  if (const auto material = servo_.material()) {
    panels_.step_marked(steps, *material, servo_.running() ? &servo_.link() : nullptr);
  }
}

}  // namespace afm::app
