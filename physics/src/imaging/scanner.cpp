// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/scanner.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>

namespace afm::physics {
namespace {

void resize(ScanTrack& track, std::size_t columns) {
  for (auto* channel :
       {&track.height_m, &track.error_n, &track.lateral_n, &track.phase_deg, &track.energy_j, &track.peak_force_n}) {
    channel->assign(columns, std::numeric_limits<double>::quiet_NaN());
  }
  track.lowest_force_n = std::numeric_limits<double>::infinity();
  track.highest_force_n = -std::numeric_limits<double>::infinity();
  track.off_surface = track.on_second_apex = track.ringing = 0.0;
}

void put(const ScanPixel& pixel, ScanTrack& track) {
  track.height_m[pixel.column] = pixel.height_m;
  track.error_n[pixel.column] = pixel.error_n;
  track.lateral_n[pixel.column] = pixel.lateral_n;
  track.phase_deg[pixel.column] = pixel.phase_deg;
  track.energy_j[pixel.column] = pixel.energy_j;
  track.peak_force_n[pixel.column] = pixel.peak_force_n;
  track.lowest_force_n = std::min(track.lowest_force_n, pixel.lowest_force_n);
  track.highest_force_n = std::max(track.highest_force_n, pixel.highest_force_n);
  track.off_surface += pixel.off_surface / static_cast<double>(track.height_m.size());
  track.on_second_apex += pixel.on_second_apex / static_cast<double>(track.height_m.size());
  track.ringing += pixel.ringing / static_cast<double>(track.height_m.size());
}

}  // namespace

Force lateral_force(Force normal, Force adhesion, double slope, double mu, ScanPass pass) noexcept {
  const double cosine = 1.0 / std::hypot(1.0, slope), sine = slope * cosine;
  const double signed_mu = pass == ScanPass::Trace ? mu : -mu;
  const double pressed = std::max(0.0, normal.si * cosine + adhesion.si);
  return Force((normal.si * sine + signed_mu * pressed) / (cosine - signed_mu * sine));
}

Scanner::Scanner(const ScanArea& area, const ScanSettings& settings, Surface surface, std::uint64_t seed,
                 std::optional<TappingDetector> tapping)
    : area_((validate(area), area)),
      settings_((validate(settings), settings)),
      surface_(std::move(surface)),
      loop_(settings, Time(tick_length()), seed, std::move(tapping)) {
  look_for_swings();
  begin_frame(SlowDirection::Down);
}

// A loop beyond its limit grows until the tip leaves the sample in each period.
void Scanner::look_for_swings() noexcept {
  constexpr double kShareOfHold = 0.5, kSmallestN = 1e-15;
  const double hold_n =
      loop_.tapping() != nullptr ? loop_.setpoint_m() : std::abs(settings_.setpoint.si) + settings_.adhesion.si;
  swings_.look_for(std::max(kShareOfHold * hold_n, kSmallestN), loop_.ringing_period_ticks());
}

// A pixel is a whole number of segments, each of a whole number of ticks.
double Scanner::tick_length() noexcept {
  const double ticks = std::max(1.0, std::ceil(pixel_time().si * settings_.loop_rate.si));
  segments_ = std::min(kSurfaceSamples, static_cast<std::size_t>(ticks));
  ticks_of_segment_ = static_cast<std::size_t>(std::ceil(ticks / static_cast<double>(segments_)));
  tick_s_ = pixel_time().si / static_cast<double>(segments_ * ticks_of_segment_);
  return tick_s_;
}

void Scanner::change(const ScanSettings& settings) {
  validate(settings);
  settings_ = settings;
  loop_.change(settings_, Time(tick_length()));
  look_for_swings();
}

void Scanner::drive(const DrivenLever& lever, Length setpoint) {
  loop_.drive(lever, setpoint);
  look_for_swings();
}

void Scanner::change_surface(Surface surface) { surface_ = std::move(surface); }

Time Scanner::pixel_time() const noexcept {
  return Time(1.0 / (2.0 * static_cast<double>(area_.columns) * settings_.line_rate.si));
}

double Scanner::z_m() const noexcept { return loop_.z_m() + loop_.deflection_m(); }

double Scanner::row_y_m(std::size_t row) const noexcept {
  const double from_top = (static_cast<double>(row) + 0.5) / static_cast<double>(area_.rows);
  return area_.y_centre.si + (0.5 - from_top) * area_.height.si;
}

void Scanner::begin_frame(SlowDirection direction) {
  direction_ = direction;
  row_ = direction == SlowDirection::Down ? 0 : area_.rows - 1;
  lines_done_ = step_ = 0;
  engaged_ = false;
}

Scanner::Below Scanner::below(double x_m, double y_m) const {
  const double x = x_m - settings_.drift_x.si * time_s_, y = y_m - settings_.drift_y.si * time_s_;
  const double first = surface_(x, y);
  const double distance = settings_.second_apex_distance.si;
  if (distance <= 0.0) return {first, false};
  const double second = surface_(x + distance, y) - settings_.second_apex_height.si;
  return {std::max(first, second), second > first};
}

void Scanner::scan_segment(double x_m, double y_m, ScanPixel& pixel) {
  const double from_m = height_m_, before_x_m = x_m_;
  x_m_ = x_m;
  y_m_ = y_m;
  time_s_ += tick_s_ * static_cast<double>(ticks_of_segment_);
  const Below there = below(x_m, y_m);
  height_m_ = there.height_m;
  const double rise_m = (height_m_ - from_m) / static_cast<double>(ticks_of_segment_);
  double lowest_n = pixel.lowest_force_n, highest_n = pixel.highest_force_n, noise_m = 0.0;
  std::size_t off = 0, swings = 0;
  for (std::size_t i = 1; i <= ticks_of_segment_; ++i) {
    loop_.tick(from_m + rise_m * static_cast<double>(i));
    lowest_n = std::min(lowest_n, loop_.force_n());
    highest_n = std::max(highest_n, loop_.force_n());
    noise_m += loop_.noise_m();
    if (!loop_.touching()) ++off;
    if (swings_.add(loop_.force_n())) ++swings;
  }
  pixel.lowest_force_n = lowest_n;
  pixel.highest_force_n = highest_n;
  const double share = 1.0 / static_cast<double>(segments_ * ticks_of_segment_);
  pixel.error_n += noise_m * share * loop_.per_metre();
  pixel.off_surface += static_cast<double>(off) * share;
  pixel.ringing += static_cast<double>(swings) * swings_.period_ticks() * share;
  if (there.second_apex) pixel.on_second_apex += static_cast<double>(ticks_of_segment_ - off) * share;
  slope_ = x_m == before_x_m ? 0.0 : (height_m_ - from_m) / (x_m - before_x_m);
}

void Scanner::scan_to(double x_m, double y_m, ScanPixel& pixel) {
  const double from_x_m = x_m_, from_y_m = y_m_;
  // at the ends of a line the tip continues to the edge of the area, half a pixel away, and comes back
  const double half_pixel_m = 0.5 * area_.width.si / static_cast<double>(area_.columns);
  const bool turns = step_ % area_.columns == 0;
  const double to_edge_m = turns ? (pixel.pass == ScanPass::Retrace ? half_pixel_m : -half_pixel_m) : 0.0;
  for (std::size_t i = 1; i <= segments_; ++i) {
    const double done = static_cast<double>(i) / static_cast<double>(segments_);
    const double beyond_m = to_edge_m * (1.0 - std::abs(1.0 - 2.0 * done));
    const bool last = i == segments_;
    scan_segment(last ? x_m : from_x_m + (x_m - from_x_m) * done + beyond_m,
                 last ? y_m : from_y_m + (y_m - from_y_m) * done, pixel);
  }
}

std::optional<ScanPixel> Scanner::next() {
  if (lines_done_ == area_.rows) return std::nullopt;
  ScanPixel pixel;
  pixel.row = row_;
  pixel.pass = step_ < area_.columns ? ScanPass::Trace : ScanPass::Retrace;
  pixel.column = pixel.pass == ScanPass::Trace ? step_ : 2 * area_.columns - 1 - step_;
  pixel.lowest_force_n = std::numeric_limits<double>::infinity();
  pixel.highest_force_n = -std::numeric_limits<double>::infinity();
  const double from_left = (static_cast<double>(pixel.column) + 0.5) / static_cast<double>(area_.columns);
  const double x_m = area_.x_centre.si + (from_left - 0.5) * area_.width.si, y_m = row_y_m(row_);
  if (engaged_) {
    scan_to(x_m, y_m, pixel);
  } else {
    x_m_ = x_m;
    y_m_ = y_m;
    height_m_ = below(x_m, y_m).height_m;
    slope_ = 0.0;
    loop_.engage(height_m_);
    pixel.lowest_force_n = pixel.highest_force_n = loop_.force_n();
    engaged_ = true;
  }

  pixel.height_m = loop_.topography_m();
  if (const TappingDetector* tapping = loop_.tapping()) {
    pixel.error_n += loop_.deflection_m() - loop_.setpoint_m();
    pixel.phase_deg = tapping->phase_rad() * 180.0 / std::numbers::pi;
    pixel.energy_j = tapping->lost_j();
    pixel.peak_force_n = tapping->peak_force_n();
  } else {
    pixel.error_n += loop_.force_n() - settings_.setpoint.si;
  }
  if (loop_.tapping() == nullptr && loop_.touching()) {
    pixel.lateral_n =
        lateral_force(Force(loop_.force_n()), settings_.adhesion, slope_, settings_.friction, pixel.pass).si;
  }
  if (++step_ == 2 * area_.columns) {
    step_ = 0;
    ++lines_done_;
    if (lines_done_ < area_.rows) row_ = direction_ == SlowDirection::Down ? row_ + 1 : row_ - 1;
  }
  return pixel;
}

bool Scanner::next_line(ScanLine& line) {
  resize(line.trace, area_.columns);
  resize(line.retrace, area_.columns);
  do {
    const std::optional<ScanPixel> pixel = next();
    if (!pixel) return false;
    line.row = pixel->row;
    put(*pixel, pixel->pass == ScanPass::Trace ? line.trace : line.retrace);
  } while (step_ != 0);
  return true;
}

ScanImage scan_frame(Scanner& scanner, const std::function<bool(const ScanLine&)>& taken) {
  struct Recorded {
    const char* name;
    const char* unit;
    std::vector<double> ScanTrack::* values;
  };
  static constexpr Recorded kContact[] = {{"Height", "m", &ScanTrack::height_m},
                                          {"Error", "N", &ScanTrack::error_n},
                                          {"Lateral force", "N", &ScanTrack::lateral_n}};
  static constexpr Recorded kTapping[] = {{"Height", "m", &ScanTrack::height_m},
                                          {"Amplitude error", "m", &ScanTrack::error_n},
                                          {"Phase", "deg", &ScanTrack::phase_deg},
                                          {"Energy dissipated", "J", &ScanTrack::energy_j},
                                          {"Peak force", "N", &ScanTrack::peak_force_n}};
  const bool tapping = scanner.loop().tapping() != nullptr;
  const std::span<const Recorded> kept = tapping ? std::span<const Recorded>(kTapping) : kContact;
  const ScanArea& area = scanner.area();
  ScanImage image;
  image.columns = area.columns;
  image.rows = area.rows;
  image.width_m = area.width.si;
  image.height_m = area.height.si;
  image.x_offset_m = area.x_centre.si - 0.5 * area.width.si;
  image.y_offset_m = area.y_centre.si + 0.5 * area.height.si;
  for (const Recorded& recorded : kept) {
    for (const char* pass : {"", " (retrace)"}) {
      image.channels.push_back(
          {recorded.name + std::string(pass), recorded.unit,
           std::vector<double>(area.columns * area.rows, std::numeric_limits<double>::quiet_NaN())});
    }
  }
  for (ScanLine line; scanner.next_line(line);) {
    std::size_t channel = 0;
    for (const Recorded& recorded : kept) {
      for (const ScanTrack* track : {&line.trace, &line.retrace}) {
        std::copy((track->*recorded.values).begin(), (track->*recorded.values).end(),
                  image.channels[channel++].values.begin() + static_cast<std::ptrdiff_t>(line.row * area.columns));
      }
    }
    if (taken && !taken(line)) break;
  }
  return image;
}

}  // namespace afm::physics
