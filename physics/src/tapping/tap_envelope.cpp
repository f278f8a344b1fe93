// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tap_envelope.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/driven_lever.h"
#include "physics/tapping/tap_surface.h"
#include "physics/tapping/tap_table.h"

namespace afm::physics {
namespace {

constexpr std::size_t kAmplitudes = 48;
constexpr double kFinestGap = 0.1e-9;      // m; from contact this far the columns are evenly spaced
constexpr double kColumnsOfOctave = 36.0;  // columns for each doubling of the gap beyond, evenly spaced
constexpr double kFirstShare = 0.01;       // first row, as a share of the free amplitude
constexpr double kLastShare = 1.25;        // last row, as a share of the free amplitude
constexpr double kFarthestGap = 300e-9;    // gap of the last column
constexpr double kLongestShare = 0.1;      // longest step, as a share of the relaxation
constexpr double kLargestTurn = 0.25;      // rad a step
constexpr double kLargestRing = 0.4;       // rad a step; more, and a step gives a stiff contact more than a swing loses
constexpr double kNudge = 0.05;            // share of a row, for the slope of w

// The column of a gap, and the gap of a column. Between powers of two it is a straight line, read from the bits of a
// number: a logarithm would be the dearest part of a tick.
double column_of(double gap_m) noexcept {
  constexpr std::int64_t kOne = std::bit_cast<std::int64_t>(1.0);
  constexpr double kOctave = 0x1p-52;
  const std::int64_t bits = std::bit_cast<std::int64_t>(1.0 + std::abs(gap_m) * (1.0 / kFinestGap)) - kOne;
  return std::copysign(kColumnsOfOctave * kOctave * static_cast<double>(bits), gap_m);
}

double gap_of(double column) noexcept {
  const double octaves = std::abs(column) / kColumnsOfOctave, whole = std::floor(octaves);
  return std::copysign(kFinestGap * (std::ldexp(1.0 + octaves - whole, static_cast<int>(whole)) - 1.0), column);
}

// At most `most`, short beside the relaxation, the turn and the ringing, whose square times the amplitude is `ring`. Of
// most steps it is clear without a root that all that is left is short enough.
double step_of(double most, double slowest, double w, double ring, double amplitude) noexcept {
  constexpr double kClear = 0.98;
  const bool clear = slowest * most < kClear && std::abs(w) * most < kClear * kLargestTurn &&
                     ring * most * most < kClear * kLargestRing * kLargestRing * amplitude;
  if (clear) return most;
  const double fastest =
      std::max({slowest, std::abs(w) * (1.0 / kLargestTurn), std::sqrt(ring / amplitude) * (1.0 / kLargestRing)});
  return std::min(most, 1.0 / fastest);
}

}  // namespace

double TapEnvelope::longest_step(const DrivenLever& lever) noexcept {
  return 2.0 * lever.quality_factor * kLongestShare;
}

TapEnvelope::TapEnvelope(std::shared_ptr<const TapTable> rests)
    : lever_(rests, &rests->lever()),
      rests_(std::move(rests)),
      free_cosine_(std::cos(lever_->free_phase)),
      free_sine_(std::sin(lever_->free_phase)),
      u_(lever_->free_amplitude.si * free_cosine_),
      v_(lever_->free_amplitude.si * free_sine_) {
  measure();
}

TapEnvelope::TapEnvelope(AveragedFlow& flow, Length contact_height)
    : lever_(std::make_shared<const DrivenLever>(flow.lever())),
      contact_m_(contact_height.si),
      free_cosine_(std::cos(lever_->free_phase)),
      free_sine_(std::sin(lever_->free_phase)) {
  const double a0 = lever_->free_amplitude.si;
  least_amplitude_m_ = kFirstShare * a0;
  amplitude_step_m_ = (kLastShare - kFirstShare) * a0 / static_cast<double>(kAmplitudes - 1);
  set_pace();
  least_x_ = std::floor(column_of(-2.0 * a0));
  last_column_ = std::ceil(column_of(kFarthestGap)) - least_x_;
  const std::size_t columns = static_cast<std::size_t>(last_column_) + 1;
  columns_ = static_cast<std::ptrdiff_t>(columns);
  Tables tables{std::vector<Moving>(kAmplitudes * columns), std::vector<Forces>(kAmplitudes * columns)};
  for (std::size_t row = 0; row < kAmplitudes; ++row) {
    const double amplitude = least_amplitude_m_ + static_cast<double>(row) * amplitude_step_m_;
    // from far away inwards, so that the shift of each swing begins near its own
    for (std::size_t i = columns; i-- > 0;) {
      const double gap = gap_of(least_x_ + static_cast<double>(i));
      const SwingAverages& swing = flow.averages(Length(amplitude), Length(contact_m_ + gap + amplitude));
      const double root = std::sqrt(amplitude);
      const std::size_t node = row * columns + i;
      tables.moving[node] = {static_cast<float>(swing.virial.si / root), static_cast<float>(flow.lost().si / root)};
      tables.forces[node] = {static_cast<float>(swing.peak.si), static_cast<float>(swing.mean.si * root),
                             static_cast<float>(swing.lost.si / root)};
    }
  }
  tables_ = std::make_shared<const Tables>(std::move(tables));
  u_ = a0 * free_cosine_;
  v_ = a0 * free_sine_;
  measure();
}

void TapEnvelope::set_pace() noexcept {
  const double r = lever_->ratio, k = lever_->spring_constant.si;
  pace_ = {.drive = lever_->base_amplitude.si / (2.0 * r),
           .detuned = (r * r - 1.0) / (2.0 * r),
           .damping = 0.5 / lever_->quality_factor,
           .by_stored = 1.0 / (k * r),
           .by_turn = 1.0 / (2.0 * std::numbers::pi * k * r),
           .by_row = 1.0 / amplitude_step_m_,
           .by_nudge = 1.0 / (amplitude_step_m_ * kNudge),
           .slowest = 1.0 / longest_step(*lever_)};
}

void TapEnvelope::drive(const DrivenLever& lever) {
  lever_ = std::make_shared<const DrivenLever>(lever);
  free_cosine_ = std::cos(lever.free_phase);
  free_sine_ = std::sin(lever.free_phase);
  set_pace();
}

TapEnvelope::Place TapEnvelope::place_of(double amplitude_m, double gap_m) const noexcept {
  const double x = std::max(0.0, column_of(gap_m - amplitude_m - contact_m_) - least_x_);
  const double y =
      std::clamp((amplitude_m - least_amplitude_m_) * pace_.by_row, 0.0, static_cast<double>(kAmplitudes) - 1.000001);
  if (!(x < last_column_)) return {};
  // numbers with a sign are converted in one instruction each
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  return {.node = std::ptrdiff_t{row} * columns_ + column,
          .right = x - static_cast<double>(column),
          .up = y - static_cast<double>(row),
          .beyond = false};
}

template <class Node>
double TapEnvelope::between(const std::vector<Node>& nodes, const Place& place, float Node::* value) const noexcept {
  const Node* low = nodes.data() + place.node;
  const Node* high = low + columns_;
  const double a = static_cast<double>(low[0].*value), b = static_cast<double>(low[1].*value);
  const double c = static_cast<double>(high[0].*value), d = static_cast<double>(high[1].*value);
  const double below = a + place.right * (b - a), above = c + place.right * (d - c);
  return below + place.up * (above - below);
}

TapEnvelope::Swing TapEnvelope::contact() const noexcept {
  if (rests_) {
    const TapTable::Rest rest = rests_->at(repelled_, gap_m_);
    return {.lost = rest.lost_j, .peak = rest.peak_force_n, .mean = rest.mean_force_n};
  }
  const double amplitude = std::max(least_swing_m(), amplitude_m());
  const Place place = place_of(amplitude, gap_m_);
  if (place.beyond) return {};
  const double root = std::sqrt(amplitude);
  return {.lost = root * between(tables_->forces, place, &Forces::lost),
          .peak = between(tables_->forces, place, &Forces::peak),
          .mean = between(tables_->forces, place, &Forces::mean) / root};
}

void TapEnvelope::place(double u_m, double v_m, double gap_m) noexcept {
  u_ = u_m, v_ = v_m;
  measure();
  gap_m_ = gap_m;
  if (rests_) repelled_ = rests_->repelled_at(attraction() < 0.0, gap_m);
}

void TapEnvelope::place(const TapState& state, double gap_m) noexcept {
  place(state.amplitude.si * std::cos(state.phase), state.amplitude.si * std::sin(state.phase), gap_m);
}

void TapEnvelope::approach_rest(double gap_m, double angle) noexcept {
  repelled_ = rests_->repelled_at(repelled_, gap_m);
  const TapTable::Rest rest = rests_->at(repelled_, gap_m);
  const double kept = std::exp(-0.5 * angle / lever_->quality_factor);
  u_ = rest.u_m + kept * (u_ - rest.u_m);
  v_ = rest.v_m + kept * (v_ - rest.v_m);
  measure();
}

void TapEnvelope::advance(double from_gap_m, double to_gap_m, double angle, int most_steps) noexcept {
  gap_m_ = to_gap_m;
  if (rests_) return approach_rest(to_gap_m, angle);
  const double drive = pace_.drive, detuned = pace_.detuned, by_stored = pace_.by_stored, by_turn = pace_.by_turn;
  const double damping = pace_.damping, lowest = least_swing_m();
  struct Rates {
    double g, w;
  };
  const auto rates = [&](double amplitude, double gap_m) {
    const Place place = place_of(amplitude, gap_m);
    if (place.beyond) return Rates{damping, detuned};
    const double share = std::sqrt(amplitude) / (amplitude * amplitude);
    return Rates{damping + by_turn * share * between(tables_->moving, place, &Moving::lost),
                 detuned + by_stored * share * between(tables_->moving, place, &Moving::virial)};
  };
  const auto length = [lowest](double u, double v) { return std::max(lowest, std::sqrt(u * u + v * v)); };
  // Amplitude and phase ring about a contact with the angular rate sqrt(|w' a/2r cos phi|), w' = dw/dA at this height;
  // its square times A.
  const auto ringing = [&](double amplitude, double gap_m, double w) {
    const double more = amplitude + amplitude_step_m_ * kNudge;
    const Place place = place_of(more, gap_m);
    if (place.beyond) return 0.0;
    const double virial = between(tables_->moving, place, &Moving::virial);
    const double steeper = by_stored * std::sqrt(more) / (more * more) * virial - (w - detuned);
    return std::abs(steeper * pace_.by_nudge * drive * u_);
  };
  const double way_m = to_gap_m - from_gap_m;
  const double by_angle = angle > 0.0 ? 1.0 / angle : 0.0, by_steps = 1.0 / static_cast<double>(most_steps);
  double left = angle;
  // the base arrives also where the steps are used up and the swing is in slow motion
  const auto gap_at = [&](double undone, int steps) {
    return from_gap_m + way_m * std::max(1.0 - undone * by_angle, static_cast<double>(steps) * by_steps);
  };
  for (int i = 0; left > 0.0 && i < most_steps; ++i) {
    const double gap_m = gap_at(left, i);
    const double amplitude = std::max(lowest, amplitude_);
    const Rates first = rates(amplitude, gap_m);
    const double step = step_of(left, pace_.slowest, first.w, ringing(amplitude, gap_m, first.w), amplitude);
    const double middle_m = 0.5 * (gap_m + gap_at(left - step, i + 1));
    const double half = 0.5 * step;
    const double middle_u = u_ + half * (-first.g * u_ - first.w * v_);
    const double middle_v = v_ + half * (-first.g * v_ + first.w * u_ + drive);
    const Rates middle = rates(length(middle_u, middle_v), middle_m);
    // towards the swing at which these rates rest, turning about it: exact at rest, and no step lets the swing grow
    const double lost = 1.0 + step * middle.g * (1.0 + half * middle.g), tangent = half * middle.w;
    const double kept = 1.0 / (lost * (1.0 + tangent * tangent));
    const double cosine = kept * (1.0 - tangent * tangent), sine = kept * 2.0 * tangent;
    const double pull = drive / (middle.g * middle.g + middle.w * middle.w);
    const double rest_u = -pull * middle.w, rest_v = pull * middle.g;
    const double u = u_ - rest_u, v = v_ - rest_v;
    u_ = rest_u + cosine * u - sine * v;
    v_ = rest_v + sine * u + cosine * v;
    measure();
    left -= step;
  }
}

void TapEnvelope::measure() noexcept { amplitude_ = std::sqrt(u_ * u_ + v_ * v_); }

double TapEnvelope::phase_rad() const noexcept {
  const double phase = std::atan2(v_, u_);
  return phase < 0.0 ? phase + 2.0 * std::numbers::pi : phase;
}

double TapEnvelope::attraction() const noexcept {
  return amplitude_ > 0.0 ? (v_ * free_cosine_ - u_ * free_sine_) / amplitude_ : 0.0;
}

}  // namespace afm::physics
