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
#include "physics/tapping/felt_swing.h"
#include "physics/tapping/tap_surface.h"
#include "physics/tapping/tap_table.h"

namespace afm::physics {
namespace {

constexpr std::size_t kAmplitudes = 48;
constexpr double kLastRow = static_cast<double>(kAmplitudes) - 1.000001;
constexpr double kFinestGap = 0.1e-9;    // gap from contact up to which columns are evenly spaced, m
constexpr int kColumnsOfOctave = 36;     // number of columns for each doubling of the gap beyond, evenly spaced
constexpr double kFirstShare = 0.01;     // first row, as a share of the free amplitude
constexpr double kFarthestGap = 300e-9;  // gap of the last column, m
constexpr double kLongestShare = 0.1;    // longest step, as a share of the relaxation
constexpr double kLargestTurn = 0.25;    // largest turn per step, rad
constexpr double kLargestRing = 0.4;     // largest ringing per step, rad; more would feed a swing on a stiff contact
constexpr double kNudge = 0.05;          // distance for the slope of w, as a share of a row

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

// Length of a step: at most `most`, short beside the relaxation, the turn and the ringing, whose square times the
// amplitude is `ring`. For most steps that is clear without a root.
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
  amplitude_step_m_ = (kLargestAveragedShare - kFirstShare) * a0 / static_cast<double>(kAmplitudes - 1);
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
  const double y = std::clamp((amplitude_m - least_amplitude_m_) * pace_.by_row, 0.0, kLastRow);
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

// A step lasts as long as a chain of operations, each of which waits for the one before. So most swings are found in
// the cell of an earlier one, without a conversion or a load, and to the last bit as place_of() and between() find
// them.
[[gnu::always_inline]] inline TapEnvelope::Moved TapEnvelope::moving_at(double amplitude_m, double gap_m,
                                                                        Cell& cell) const noexcept {
  const double gap = gap_m - amplitude_m - contact_m_;
  const double y = (amplitude_m - least_amplitude_m_) * pace_.by_row;
  const double x = cell.columns * (cell.whole + (cell.share + cell.by_gap * gap)) - least_x_;
  if (cell.left <= x && x < cell.left + 1.0 && cell.low <= y && y < cell.high) return cell.at(x, y);
  const double column = std::max(0.0, column_of(gap) - least_x_), row = std::clamp(y, 0.0, kLastRow);
  if (!(column < last_column_)) return {};
  enter_cell(column, row, cell);
  return cell.at(column, row);
}

void TapEnvelope::enter_cell(double x, double y, Cell& cell) const noexcept {
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const Moving* low = tables_->moving.data() + std::ptrdiff_t{row} * columns_ + column;
  const Moving* high = low + columns_;
  const auto line = [](float from, float to) {
    return Line{static_cast<double>(from), static_cast<double>(to) - static_cast<double>(from)};
  };
  const int from_contact = static_cast<int>(least_x_) + column;
  const bool above = from_contact >= 0;
  const int octave = (above ? from_contact : -1 - from_contact) / kColumnsOfOctave;
  cell = {.left = static_cast<double>(column),
          .low = static_cast<double>(row),
          .high = std::min(static_cast<double>(row) + 1.0, kLastRow),
          .columns = above ? double{kColumnsOfOctave} : -double{kColumnsOfOctave},
          .whole = static_cast<double>(octave) - 1.0,
          .share = 1.0 / static_cast<double>(1 << octave),
          .by_gap = (above ? 1.0 : -1.0) / kFinestGap / static_cast<double>(1 << octave),
          .virial_below = line(low[0].virial, low[1].virial),
          .virial_above = line(high[0].virial, high[1].virial),
          .lost_below = line(low[0].lost, low[1].lost),
          .lost_above = line(high[0].lost, high[1].lost)};
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
  const double damping = pace_.damping, lowest = least_swing_m(), nudge = amplitude_step_m_ * kNudge;
  struct Rates {
    double g, w;
  };
  const auto rates = [&](double at, double gap_m, Cell& cell) __attribute__((always_inline)) {
    const auto [virial, lost, beyond] = moving_at(at, gap_m, cell);
    if (beyond) return Rates{damping, detuned};
    const double share = std::sqrt(at) / (at * at);
    return Rates{damping + by_turn * share * lost, detuned + by_stored * share * virial};
  };
  const auto length = [lowest](double u, double v) { return std::max(lowest, std::sqrt(u * u + v * v)); };
  double u = u_, v = v_, amplitude = amplitude_;
  // Amplitude and phase ring about a contact with the angular rate sqrt(|w' a/2r cos phi|), w' = dw/dA at this height;
  // its square times A.
  const auto ringing = [&](double at, double gap_m, double w) {
    const double more = at + nudge;
    const Moved moved = moving_at(more, gap_m, cells_.longer);
    if (moved.beyond) return 0.0;
    const double steeper = by_stored * std::sqrt(more) / (more * more) * moved.virial - (w - detuned);
    return std::abs(steeper * pace_.by_nudge * drive * u);
  };
  const double way_m = to_gap_m - from_gap_m;
  const double by_angle = angle > 0.0 ? 1.0 / angle : 0.0, by_steps = 1.0 / static_cast<double>(most_steps);
  double left = angle;
  // the base arrives also where the steps are used up and the swing is in slow motion
  const auto gap_at = [&](double undone, int steps) {
    if (way_m == 0.0) return from_gap_m;
    return from_gap_m + way_m * std::max(1.0 - undone * by_angle, static_cast<double>(steps) * by_steps);
  };
  for (int i = 0; left > 0.0 && i < most_steps; ++i) {
    const double gap_m = gap_at(left, i);
    const double here = std::max(lowest, amplitude);
    const Rates first = rates(here, gap_m, cells_.first);
    const double step = step_of(left, pace_.slowest, first.w, ringing(here, gap_m, first.w), here);
    const double middle_m = 0.5 * (gap_m + gap_at(left - step, i + 1));
    const double half = 0.5 * step;
    const double middle_u = u + half * (-first.g * u - first.w * v);
    const double middle_v = v + half * (-first.g * v + first.w * u + drive);
    const Rates middle = rates(length(middle_u, middle_v), middle_m, cells_.middle);
    // towards the swing at which these rates rest, turning about it: exact at rest, and no step lets the swing grow
    const double lost = 1.0 + step * middle.g * (1.0 + half * middle.g), tangent = half * middle.w;
    const double kept = 1.0 / (lost * (1.0 + tangent * tangent));
    const double cosine = kept * (1.0 - tangent * tangent), sine = kept * 2.0 * tangent;
    const double pull = drive / (middle.g * middle.g + middle.w * middle.w);
    const double rest_u = -pull * middle.w, rest_v = pull * middle.g;
    const double away_u = u - rest_u, away_v = v - rest_v;
    u = rest_u + cosine * away_u - sine * away_v;
    v = rest_v + sine * away_u + cosine * away_v;
    amplitude = std::sqrt(u * u + v * v);
    left -= step;
  }
  u_ = u, v_ = v, amplitude_ = amplitude;
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
