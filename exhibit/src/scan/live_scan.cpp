// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/live_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/enumerators.h"
#include "physics/contact_parameters.h"

namespace afm::exhibit {

namespace {

constexpr std::uint32_t kPixelsOfFrame = 2 * LiveScan::kPixels * LiveScan::kPixels;
constexpr std::uint32_t kMostFrames = 10'000'000;
constexpr std::size_t kMostChanges = 10'000;
constexpr std::uint32_t kMostTicks = 1U << 31U;         // limit for a painting hand: weeks
constexpr double kNarrowestM = 1e-10, kWidestM = 1e-3;  // limits for the side of the square
constexpr double kLoopTickS = 10e-6;
constexpr double kLongestTickS = 5e-3;  // longest tick of the servo for which a loop compensates

void clear(std::vector<double>& map) {
  map.assign(LiveScan::kPixels * LiveScan::kPixels, std::numeric_limits<double>::quiet_NaN());
}

bool precedes(const ScanChange& change, std::uint32_t frame, std::uint32_t pixel) {
  return change.frame < frame || (change.frame == frame && change.pixel <= pixel);
}

// Settings with a drive; those of an older recording, which lack it, get that of `usual`.
ScanChoice completed(ScanChoice choice, const ScanChoice& usual) {
  if (!in_tapping(choice)) return choice;
  if (choice.free_amplitude_m == 0.0) choice.free_amplitude_m = usual.free_amplitude_m;
  if (choice.drive_hz == 0.0) choice.drive_hz = usual.drive_hz;
  return choice;
}

}  // namespace

LiveScan::LiveScan(ScanSubject subject, const std::optional<HandPart>& hand) : subject_(std::move(subject)) {
  progress_.hand = hand;
  prepare_detector();
  if (hand) subject_.side_m = hand->side_m;
  progress_.changes = {{.choice = usual_}};
  begin_frame();
}

LiveScan::LiveScan(ScanSubject subject, const ScanProgress& progress, std::span<const scene::TipSample> samples)
    : subject_(std::move(subject)) {
  progress_ = progress;
  prepare_detector();
  for (ScanChange& change : progress_.changes) change.choice = completed(change.choice, usual_);
  if (progress.hand) subject_.side_m = progress.hand->side_m;
  progress_.pixel = 0;
  if (is_painted()) {
    begin_frame();
    for (const scene::TipSample& sample : samples) {
      if (sample.tick <= progress.hand->first_tick + progress.pixel) follow_hand(sample);
    }
    progress_.pixel = progress.pixel;
    return;
  }
  // the previous frame is still visible below the tip
  for (std::uint32_t frame = progress.frame - std::min(progress.frame, 1U); frame <= progress.frame; ++frame) {
    progress_.frame = frame;
    begin_frame();
    take_until(frame == progress.frame ? progress.pixel : kPixelsOfFrame);
  }
  find_truth();
}

// Finds the usual settings, and the detector of a tapping lever. A lever that never has the usual amplitude
// takes its image in contact.
void LiveScan::prepare_detector() {
  usual_ = usual_choice(subject_.tip_radius_m, subject_.side_m, subject_.slope, subject_.adhesion_n);
  if (!subject_.tapped || progress_.hand) return;
  const TappedSubject& tapped = *subject_.tapped;
  const ScanChoice tapping = usual_tapping_choice(subject_.tip_radius_m, subject_.side_m, subject_.slope, tapped.lever);
  try {
    detector_.emplace(tapped.surface, tapped.lever, tapping.setpoint_n * tapped.lever.free_amplitude, tapped.rests);
    usual_ = tapping;
  } catch (const physics::UnphysicalValue&) {
    detector_.reset();
  }
}

// Returns false, and changes nothing, if the swing never has this amplitude over the sample, or the drive is out of
// reach.
bool LiveScan::hold(const ScanChoice& choice) {
  try {
    const physics::DrivenLever lever = driven_by(choice, subject_.tapped->lever);
    const physics::Length amplitude = choice.setpoint_n * lever.free_amplitude;
    const bool same = lever == detector_->lever() && amplitude.si == detector_->setpoint_m();
    if (!same) detector_->drive(lever, amplitude);
    return true;
  } catch (const physics::UnphysicalValue&) {
    return false;
  }
}

bool LiveScan::changes_drive() const { return is_tapped() && !detector_->is_direct(); }

std::span<const ScanRow> LiveScan::rows() const {
  constexpr std::size_t kRowsOfDrive = 2;
  static constexpr auto kRows = core::kEnumerators<ScanRow>;
  return std::span(kRows).first(kRows.size() - (changes_drive() ? 0 : kRowsOfDrive));
}

bool LiveScan::valid(const ScanProgress& progress) {
  const auto& changes = progress.changes;
  const auto later = [](const ScanChange& a, const ScanChange& b) { return !precedes(a, b.frame, b.pixel); };
  const std::optional<HandPart>& hand = progress.hand;
  if (hand && !(hand->side_m >= kNarrowestM && hand->side_m <= kWidestM)) return false;
  const bool painted = hand && hand->paints;
  if (progress.frame > (painted ? 0 : kMostFrames) || progress.pixel > (painted ? kMostTicks : kPixelsOfFrame)) {
    return false;
  }
  return !changes.empty() && changes.size() <= kMostChanges &&
         std::adjacent_find(changes.begin(), changes.end(), later) == changes.end() &&
         std::all_of(changes.begin(), changes.end(), [](const ScanChange& c) { return is_valid(c.choice); });
}

// Begins a frame with the current settings and new noise.
void LiveScan::begin_frame() {
  if (maps_.height_m[0].empty()) {
    for (auto* maps : {&maps_.height_m, &maps_.error_n, &maps_.lateral_n, &maps_.phase_deg, &maps_.energy_j})
      std::for_each(maps->begin(), maps->end(), clear);
  }
  if (progress_.pixel == kPixelsOfFrame) {
    last_image_m_ = maps_.height_m[0];
    // part of the detector's white noise that passes the loop: sqrt(S/(4 tau)), S = noise^2/bandwidth
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
  std::optional<physics::TappingDetector> tapping;
  if (detector_ && in_tapping(applied_)) {
    (void)hold(applied_);
    tapping = detector_;
  }
  scanner_.emplace(area, settings_of(applied_, subject_.adhesion_n), traced_, progress_.frame + 1, std::move(tapping));
  if (is_painted()) loop_.emplace(scanner_->settings(), physics::Time(kLoopTickS), progress_.frame + 1);
}

void LiveScan::apply(const ScanChoice& choice) {
  if (choice.tip_radius_m != applied_.tip_radius_m) {
    traced_ = subject_.traced(choice.tip_radius_m);
    scanner_->change_surface(traced_);
  }
  applied_ = choice;
  if (is_tapped() && in_tapping(choice) && hold(choice)) {
    scanner_->drive(detector_->lever(), physics::Length(detector_->setpoint_m()));
  }
  scanner_->change(settings_of(choice, subject_.adhesion_n));
  if (loop_) loop_->change(scanner_->settings(), physics::Time(kLoopTickS));
}

// Takes the next pixel. Returns false at the end of the frame.
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
  if (is_tapped()) {
    maps_.phase_deg[pass][at] = pixel->phase_deg;
    maps_.energy_j[pass][at] = pixel->energy_j;
  }
  LineFacts& facts = facts_[pixel->row];
  if (pass == 0 && pixel->column == 0) facts = {};
  facts.highest_force_n = std::max(facts.highest_force_n, pixel->highest_force_n);
  facts.off_surface += pixel->off_surface / (2.0 * kPixels);
  facts.on_second_apex += pixel->on_second_apex / (2.0 * kPixels);
  facts.ringing += pixel->ringing / (2.0 * kPixels);
  force_n_ = is_tapped() ? 0.0 : scanner_->settings().setpoint.si + pixel->error_n;
  return true;
}

void LiveScan::take_until(std::uint32_t pixel) {
  while (progress_.pixel < pixel && next_pixel()) {
  }
}

void LiveScan::follow_hand(const scene::TipSample& sample) {
  if (!is_painted() || sample.tick <= progress_.hand->first_tick) return;
  const std::uint64_t tick = std::min<std::uint64_t>(sample.tick - progress_.hand->first_tick, kMostTicks);
  // changes before this tick
  const auto& changes = progress_.changes;
  const auto after = std::find_if(changes.begin() + 1, changes.end(), [&](const auto& c) { return c.pixel >= tick; });
  if (const ScanChoice& choice = (after - 1)->choice; choice != applied_) apply(choice);
  progress_.pixel = static_cast<std::uint32_t>(tick);
  const bool on_sample = sample.phase == physics::Phase::Attached;
  const bool no_force =
      sample.servo_state == scene::ServoState::Disarmed || sample.servo_state == scene::ServoState::Fault;
  feedback_taken_ = feedback_taken_ || !on_sample || no_force;
  if (!on_sample || !feedback_taken_) return brush_.reset();
  paint(sample);
}

// Height of the sample below the tip, which drifts and may have a second apex.
double LiveScan::below_m(double x_m, double y_m, double seconds) const {
  const double x = x_m - applied_.drift_m_per_s * seconds, y = y_m - applied_.drift_m_per_s * seconds;
  const physics::ScanSettings& settings = scanner_->settings();
  const double distance_m = settings.second_apex_distance.si;
  const double first_m = traced_(x, y);
  return distance_m > 0.0 ? std::max(first_m, traced_(x + distance_m, y) - settings.second_apex_height.si) : first_m;
}

void LiveScan::paint(const scene::TipSample& sample) {
  const scene::TopographyScale& shown = subject_.shown;
  const double x_m = sample.surface.xy_m[0] / shown.lateral, y_m = sample.surface.xy_m[1] / shown.lateral;
  const double right = x_m / subject_.side_m + 0.5, down = 0.5 - y_m / subject_.side_m;
  if (!(right >= 0.0 && right < 1.0 && down >= 0.0 && down < 1.0)) return brush_.reset();
  if (!painting_since_ns_) painting_since_ns_ = sample.time_ns;
  const double height_m = below_m(x_m, y_m, 1e-9 * static_cast<double>(sample.time_ns - *painting_since_ns_));
  const std::size_t column = static_cast<std::size_t>(right * kPixels), row = static_cast<std::size_t>(down * kPixels);
  if (!brush_) {
    loop_->engage(height_m);
    brush_ = {.time_ns = sample.time_ns, .below_m = height_m, .column = column, .row = row};
  }
  const double passed_s = 1e-9 * static_cast<double>(sample.time_ns - brush_->time_ns);
  const auto ticks = std::llround(std::clamp(passed_s, 0.0, kLongestTickS) / kLoopTickS);
  for (std::int64_t i = 1; i <= ticks; ++i) {
    loop_->tick(std::lerp(brush_->below_m, height_m, static_cast<double>(i) / static_cast<double>(ticks)));
  }
  const auto [along_x_n, along_y_n] = sample.lateral_force_n;
  if (progress_.hand->feedback) {
    color_way(column, row, {loop_->topography_m(), loop_->deflection_m() - loop_->setpoint_m(), along_x_n, along_y_n});
  } else {
    const double apex_m = sample.surface.height_m / shown.vertical + sample.tip.z_m;
    color_way(column, row, {apex_m, -sample.tip.deflection_m, along_x_n, along_y_n});
  }
  force_n_ = loop_->force_n();
  brush_ = {.time_ns = sample.time_ns, .below_m = height_m, .column = column, .row = row};
  hand_row_ = row;
}

// Paints height, deflection and lateral forces on the path from the previous tick to this one.
void LiveScan::color_way(std::size_t column, std::size_t row, const std::array<double, 4>& values) {
  const std::array<std::vector<double>*, 4> maps{&maps_.height_m[0], &maps_.height_m[1], &maps_.lateral_n[0],
                                                 &maps_.lateral_n[1]};
  const auto way = [](std::size_t from, std::size_t to) { return static_cast<double>(to) - static_cast<double>(from); };
  const double columns = way(brush_->column, column), rows = way(brush_->row, row);
  const double steps = std::max({std::abs(columns), std::abs(rows), 1.0});
  for (double step = 1.0; step <= steps; ++step) {
    const auto at = [&](std::size_t from, double along) {
      const auto pixel = static_cast<std::size_t>(std::lround(static_cast<double>(from) + along * step / steps));
      return pixel / kCell * kCell;
    };
    const std::size_t left = at(brush_->column, columns), top = at(brush_->row, rows);
    for (std::size_t pixel = 0; pixel < kCell * kCell; ++pixel) {
      const std::size_t place = (top + pixel / kCell) * kPixels + left + pixel % kCell;
      for (std::size_t map = 0; map < maps.size(); ++map) (*maps[map])[place] = values[map];
    }
  }
}

double LiveScan::seen_share() const {
  const auto seen = std::count_if(maps_.height_m[0].begin(), maps_.height_m[0].end(),
                                  [](double height_m) { return std::isfinite(height_m); });
  return static_cast<double>(seen) / static_cast<double>(maps_.height_m[0].size());
}

void LiveScan::advance(double seconds) {
  if (is_painted()) return find_truth();
  owed_s_ = std::min(owed_s_ + std::max(seconds, 0.0), kMostCatchUpS);
  while (owed_s_ > 0.0) {
    const double before_s = scanner_->time().si;
    if (next_pixel()) {
      owed_s_ -= scanner_->time().si - before_s;
      continue;
    }
    end_frame();
  }
  find_truth();
}

void LiveScan::end_frame() {
  ++progress_.frame;
  // earlier changes than the previous frame's are no longer visible
  auto& changes = progress_.changes;
  while (changes.size() > 1 && precedes(changes[1], progress_.frame - 1, 0)) changes.erase(changes.begin());
  begin_frame();
}

bool LiveScan::follow(std::uint32_t frame, std::uint32_t pixel) {
  if (is_painted()) return true;
  const bool behind = frame < progress_.frame || (frame == progress_.frame && pixel < progress_.pixel);
  if (behind || frame > progress_.frame + 1 || pixel > kPixelsOfFrame) return false;
  while (progress_.frame < frame) {
    take_until(kPixelsOfFrame);
    end_frame();
  }
  take_until(pixel);
  find_truth();
  return true;
}

void LiveScan::show_truth(bool shown) {
  progress_.truth = shown;
  find_truth();
}

// Computes the truth. Runs once per frame of the scan and tip, not in every frame of the wall.
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
  const bool drives = row == ScanRow::FreeAmplitude || row == ScanRow::DriveFrequency;
  if (drives && !changes_drive()) return false;
  const bool stepped = drives ? step_drive(choice, row, steps, subject_.tapped->lever)
                              : exhibit::step(choice, row, steps, subject_.side_m);
  if (!stepped) return false;
  if ((drives || row == ScanRow::Setpoint) && detector_ && in_tapping(choice)) {
    physics::TappingDetector now = *detector_;
    if (!hold(choice)) return false;
    detector_ = std::move(now);  // detector that takes effect with the next pixel
  }
  change_to(choice);
  return true;
}

void LiveScan::change_to(const ScanChoice& wanted) {
  const ScanChoice choice = completed(wanted, usual_);
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

std::size_t LiveScan::row() const {
  if (is_painted()) return hand_row_;
  return std::min(std::size_t{progress_.pixel} / (2 * kPixels), kPixels - 1);
}

glm::dvec3 LiveScan::apex_m() const {
  const scene::TopographyScale& shown = subject_.shown;
  const physics::TappingDetector* tapping = scanner_->loop().tapping();
  // a swing, at its lowest point
  const double z_m = tapping != nullptr ? scanner_->loop().z_m() - tapping->amplitude_m() : scanner_->z_m();
  return {shown.lateral * scanner_->x_m(), shown.lateral * scanner_->y_m(), shown.vertical * z_m};
}

double LiveScan::surface_m(double x_m, double y_m) const {
  const scene::TopographyScale& shown = subject_.shown;
  return shown.vertical * traced_(x_m / shown.lateral, y_m / shown.lateral);
}

std::optional<std::size_t> LiveScan::newest_row() const {
  if (is_painted()) return painting_since_ns_ ? std::optional(hand_row_) : std::nullopt;
  const std::size_t whole = std::size_t{progress_.pixel} / (2 * kPixels);
  if (whole > 0) return whole - 1;
  return progress_.frame > 0 ? std::optional(kPixels - 1) : std::nullopt;
}

}  // namespace afm::exhibit
