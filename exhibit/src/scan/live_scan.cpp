// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/live_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace afm::exhibit {

namespace {

constexpr std::uint32_t kPixelsOfFrame = 2 * LiveScan::kPixels * LiveScan::kPixels;
constexpr std::uint32_t kMostFrames = 10'000'000;
constexpr std::size_t kMostChanges = 10'000;

void clear(std::vector<double>& map) {
  map.assign(LiveScan::kPixels * LiveScan::kPixels, std::numeric_limits<double>::quiet_NaN());
}

bool precedes(const ScanChange& change, std::uint32_t frame, std::uint32_t pixel) {
  return change.frame < frame || (change.frame == frame && change.pixel <= pixel);
}

}  // namespace

LiveScan::LiveScan(ScanSubject subject) : subject_(std::move(subject)) {
  usual_.tip_radius_m = subject_.tip_radius_m;
  progress_.changes = {{.choice = usual_}};
  begin_frame();
}

LiveScan::LiveScan(ScanSubject subject, const ScanProgress& progress) : subject_(std::move(subject)) {
  usual_.tip_radius_m = subject_.tip_radius_m;
  progress_ = progress;
  progress_.pixel = 0;
  // the frame before the newest is still seen below the tip
  for (std::uint32_t frame = progress.frame - std::min(progress.frame, 1U); frame <= progress.frame; ++frame) {
    progress_.frame = frame;
    begin_frame();
    take_until(frame == progress.frame ? progress.pixel : kPixelsOfFrame);
  }
  find_truth();
}

bool LiveScan::valid(const ScanProgress& progress) {
  const auto& changes = progress.changes;
  const auto later = [](const ScanChange& a, const ScanChange& b) { return !precedes(a, b.frame, b.pixel); };
  return progress.frame <= kMostFrames && progress.pixel <= kPixelsOfFrame && !changes.empty() &&
         changes.size() <= kMostChanges && std::adjacent_find(changes.begin(), changes.end(), later) == changes.end() &&
         std::all_of(changes.begin(), changes.end(), [](const ScanChange& c) { return is_valid(c.choice); });
}

// With the settings that were valid when it began, and other noise.
void LiveScan::begin_frame() {
  if (maps_.height_m[0].empty()) {
    for (auto* maps : {&maps_.height_m, &maps_.error_n, &maps_.lateral_n})
      std::for_each(maps->begin(), maps->end(), clear);
  }
  if (progress_.pixel == kPixelsOfFrame) {
    last_image_m_ = maps_.height_m[0];
    // what passes the loop of the detector's white noise: sqrt(S/(4 tau)), S = noise^2/bandwidth
    last_noise_m_ = applied_.noise_m * std::sqrt(applied_.gain_per_s / (4.0 * physics::kNoiseBandwidth.si));
  }
  progress_.pixel = 0;
  const auto& changes = progress_.changes;
  const auto after = std::find_if(changes.begin(), changes.end(),
                                  [&](const ScanChange& change) { return !precedes(change, progress_.frame, 0); });
  applied_ = after == changes.begin() ? changes.front().choice : (after - 1)->choice;
  traced_ = subject_.traced(applied_.tip_radius_m);
  physics::ScanArea area;
  area.width = area.height = physics::Length(subject_.side_m);
  area.columns = area.rows = kPixels;
  scanner_.emplace(area, settings_of(applied_, subject_.adhesion_n), traced_, progress_.frame + 1);
}

void LiveScan::apply(const ScanChoice& choice) {
  if (choice.tip_radius_m != applied_.tip_radius_m) {
    traced_ = subject_.traced(choice.tip_radius_m);
    scanner_->change_surface(traced_);
  }
  applied_ = choice;
  scanner_->change(settings_of(choice, subject_.adhesion_n));
}

// False at the end of the frame.
bool LiveScan::next_pixel() {
  for (const ScanChange& change : progress_.changes) {
    if (change.frame == progress_.frame && change.pixel == progress_.pixel && change.choice != applied_) {
      apply(change.choice);
    }
  }
  const auto pixel = scanner_->next();
  if (!pixel) return false;
  ++progress_.pixel;
  const std::size_t pass = pixel->pass == physics::ScanPass::Trace ? 0 : 1;
  const std::size_t at = pixel->row * kPixels + pixel->column;
  maps_.height_m[pass][at] = pixel->height_m;
  maps_.error_n[pass][at] = pixel->error_n;
  maps_.lateral_n[pass][at] = pixel->lateral_n;
  LineFacts& facts = facts_[pixel->row];
  if (pass == 0 && pixel->column == 0) facts = {};
  facts.highest_force_n = std::max(facts.highest_force_n, pixel->highest_force_n);
  facts.off_surface += pixel->off_surface / (2.0 * kPixels);
  facts.on_second_apex += pixel->on_second_apex / (2.0 * kPixels);
  force_n_ = applied_.setpoint_n + pixel->error_n;
  return true;
}

void LiveScan::take_until(std::uint32_t pixel) {
  while (progress_.pixel < pixel && next_pixel()) {
  }
}

void LiveScan::advance(double seconds) {
  owed_s_ = std::min(owed_s_ + std::max(seconds, 0.0), kMostCatchUpS);
  while (owed_s_ > 0.0) {
    const double before_s = scanner_->time().si;
    if (next_pixel()) {
      owed_s_ -= scanner_->time().si - before_s;
      continue;
    }
    ++progress_.frame;
    // what came before the frame that is now below the tip is no longer seen
    auto& changes = progress_.changes;
    while (changes.size() > 1 && precedes(changes[1], progress_.frame - 1, 0)) changes.erase(changes.begin());
    begin_frame();
  }
  find_truth();
}

void LiveScan::show_truth(bool shown) {
  progress_.truth = shown;
  find_truth();
}

// Once a frame and a tip: not in every frame of the wall.
void LiveScan::find_truth() {
  if (!progress_.truth) return truth_.reset();
  if (truth_ && truth_->frame == progress_.frame && truth_->tip_radius_m == applied_.tip_radius_m) return;
  if (!truth_ || truth_->tip_radius_m != applied_.tip_radius_m) {
    truth_.emplace().reach = reach_of_tip(subject_.drawn_m, subject_.side_m, kPixels, applied_.tip_radius_m);
  }
  truth_->frame = progress_.frame;
  truth_->tip_radius_m = applied_.tip_radius_m;
  truth_->true_tip = round_tip(applied_.tip_radius_m, 0.125 * subject_.side_m);
  truth_->revealed_tip = {};
  if (last_image_m_.empty()) return;
  physics::HeightGrid image = truth_->reach.sample;
  image.height_m = last_image_m_;
  truth_->revealed_tip = tip_revealed_by(image, last_noise_m_);
}

bool LiveScan::step(ScanRow row, int steps) {
  ScanChoice choice = this->choice();
  if (!exhibit::step(choice, row, steps, subject_.side_m)) return false;
  change_to(choice);
  return true;
}

void LiveScan::change_to(const ScanChoice& choice) {
  ScanChange& newest = progress_.changes.back();
  if (newest.frame == progress_.frame && newest.pixel == progress_.pixel) {
    newest.choice = choice;
  } else {
    progress_.changes.push_back({.frame = progress_.frame, .pixel = progress_.pixel, .choice = choice});
  }
}

void LiveScan::reset() {
  if (choice() != usual_) change_to(usual_);
}

std::size_t LiveScan::row() const { return std::min(std::size_t{progress_.pixel} / (2 * kPixels), kPixels - 1); }

glm::dvec3 LiveScan::apex_m() const { return {scanner_->x_m(), scanner_->y_m(), scanner_->z_m()}; }

std::optional<std::size_t> LiveScan::newest_row() const {
  const std::size_t whole = std::size_t{progress_.pixel} / (2 * kPixels);
  if (whole > 0) return whole - 1;
  return progress_.frame > 0 ? std::optional(kPixels - 1) : std::nullopt;
}

}  // namespace afm::exhibit
