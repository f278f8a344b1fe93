// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tap_envelope.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/driven_lever.h"
#include "physics/tapping/tap_surface.h"

namespace afm::physics {
namespace {

constexpr std::size_t kAmplitudes = 48;
constexpr double kFinestGap = 0.1e-9;    // m; from contact this far the columns are evenly spaced, then by factors
constexpr double kGapStep = 0.025;       // step in asinh(gap/kFinestGap)
constexpr double kFirstShare = 0.01;     // first row, as a share of the free amplitude
constexpr double kLastShare = 1.25;      // last row, as a share of the free amplitude
constexpr double kFarthestGap = 300e-9;  // gap of the last column
constexpr double kLongestShare = 0.1;    // longest step, as a share of the relaxation
constexpr double kLargestTurn = 0.25;    // rad a step
constexpr double kLargestRing = 0.4;     // rad a step; more, and a step gives a stiff contact more than a swing loses
constexpr double kNudge = 0.05;          // share of a row, for the slope of w

}  // namespace

double TapEnvelope::longest_step(const DrivenLever& lever) noexcept {
  return 2.0 * lever.quality_factor * kLongestShare;
}

TapEnvelope::TapEnvelope(AveragedFlow& flow, Length contact_height)
    : lever_(std::make_shared<const DrivenLever>(flow.lever())), contact_m_(contact_height.si) {
  const double a0 = lever_->free_amplitude.si;
  least_amplitude_m_ = kFirstShare * a0;
  amplitude_step_m_ = (kLastShare - kFirstShare) * a0 / static_cast<double>(kAmplitudes - 1);
  least_x_ = -std::asinh(2.0 * a0 / kFinestGap);
  columns_ = static_cast<std::size_t>(std::ceil((std::asinh(kFarthestGap / kFinestGap) - least_x_) / kGapStep)) + 1;
  auto table = std::make_shared<std::vector<Node>>(kAmplitudes * columns_);
  for (std::size_t row = 0; row < kAmplitudes; ++row) {
    const double amplitude = least_amplitude_m_ + static_cast<double>(row) * amplitude_step_m_;
    // from far away inwards, so that the shift of each swing begins near its own
    for (std::size_t i = columns_; i-- > 0;) {
      const double gap = kFinestGap * std::sinh(least_x_ + static_cast<double>(i) * kGapStep);
      const SwingAverages& swing = flow.averages(Length(amplitude), Length(contact_m_ + gap + amplitude));
      const double root = std::sqrt(amplitude);
      (*table)[row * columns_ + i] = {swing.virial.si / root, swing.lost.si / root, swing.peak.si,
                                      swing.mean.si * root};
    }
  }
  table_ = std::move(table);
  u_ = a0 * std::cos(lever_->free_phase);
  v_ = a0 * std::sin(lever_->free_phase);
}

TapEnvelope::Node TapEnvelope::sample(double amplitude_m, double gap_m) const noexcept {
  const double x = std::max(0.0, (std::asinh((gap_m - amplitude_m - contact_m_) / kFinestGap) - least_x_) / kGapStep);
  const double y = std::clamp((amplitude_m - least_amplitude_m_) / amplitude_step_m_, 0.0,
                              static_cast<double>(kAmplitudes) - 1.000001);
  const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
  if (column + 1 >= columns_) return {};
  const double right = x - static_cast<double>(column), up = y - static_cast<double>(row);
  const Node* low = table_->data() + row * columns_ + column;
  const Node* high = low + columns_;
  const auto between = [&](double Node::* value) {
    const double below = low[0].*value + right * (low[1].*value - low[0].*value);
    const double above = high[0].*value + right * (high[1].*value - high[0].*value);
    return below + up * (above - below);
  };
  const double root = std::sqrt(amplitude_m);
  return {root * between(&Node::virial), root * between(&Node::lost), between(&Node::peak),
          between(&Node::mean) / root};
}

void TapEnvelope::place(double u_m, double v_m, double gap_m) noexcept {
  u_ = u_m, v_ = v_m;
  contact_ = sample(amplitude_m(), gap_m);
}

void TapEnvelope::place(const TapState& state, double gap_m) noexcept {
  place(state.amplitude.si * std::cos(state.phase), state.amplitude.si * std::sin(state.phase), gap_m);
}

void TapEnvelope::advance(double from_gap_m, double to_gap_m, double angle, int most_steps) noexcept {
  const double k = lever_->spring_constant.si, r = lever_->ratio, q = lever_->quality_factor;
  const double drive = lever_->base_amplitude.si / (2.0 * r);
  const double lowest = least_amplitude_m_ * 1e-3;
  struct Rates {
    double g, w;
  };
  const auto rates = [&](double u, double v, double gap_m) {
    const double amplitude = std::max(lowest, std::sqrt(u * u + v * v)), stored = k * r * amplitude * amplitude;
    contact_ = sample(amplitude, gap_m);
    return Rates{0.5 / q + contact_.lost / (2.0 * std::numbers::pi * stored),
                 (r * r - 1.0) / (2.0 * r) + contact_.virial / stored};
  };
  // angular rate at which amplitude and phase ring about a contact, from w' = dw/dA at this height: sqrt(|w' a/2r cos
  // phi|)
  const auto ringing = [&](double u, double v, double gap_m, double w) {
    const double amplitude = std::max(lowest, std::sqrt(u * u + v * v)), more = amplitude + amplitude_step_m_ * kNudge;
    const double steeper = sample(more, gap_m).virial / (k * r * more * more) - (w - (r * r - 1.0) / (2.0 * r));
    return std::sqrt(std::abs(steeper / (more - amplitude) * drive * u / amplitude));
  };
  const double way_m = to_gap_m - from_gap_m;
  double left = angle;
  // the base arrives also where the steps are used up and the swing is in slow motion
  const auto gap_at = [&](double undone, int steps) {
    return from_gap_m +
           way_m * std::max(1.0 - undone / angle, static_cast<double>(steps) / static_cast<double>(most_steps));
  };
  for (int i = 0; left > 0.0 && i < most_steps; ++i) {
    const double gap_m = gap_at(left, i);
    const Rates first = rates(u_, v_, gap_m);
    const double turn = kLargestTurn / std::max(std::abs(first.w), 1e-12);
    const double ring = kLargestRing / std::max(ringing(u_, v_, gap_m, first.w), 1e-12);
    const double step = std::min({left, 2.0 * q * kLongestShare, turn, ring});
    const double middle_m = 0.5 * (gap_m + gap_at(left - step, i + 1));
    const double half = 0.5 * step;
    const Rates middle =
        rates(u_ + half * (-first.g * u_ - first.w * v_), v_ + half * (-first.g * v_ + first.w * u_ + drive), middle_m);
    // towards the swing at which these rates rest, turning about it: exact at rest, and no step lets the swing grow
    const double decay = 1.0 / (1.0 + step * middle.g * (1.0 + half * middle.g)), tangent = half * middle.w;
    const double scale = 1.0 / (1.0 + tangent * tangent);
    const double cosine = (1.0 - tangent * tangent) * scale, sine = 2.0 * tangent * scale;
    const double square = middle.g * middle.g + middle.w * middle.w;
    const double rest_u = -drive * middle.w / square, rest_v = drive * middle.g / square;
    const double u = u_ - rest_u, v = v_ - rest_v;
    u_ = rest_u + decay * (cosine * u - sine * v);
    v_ = rest_v + decay * (sine * u + cosine * v);
    left -= step;
  }
}

double TapEnvelope::amplitude_m() const noexcept { return std::sqrt(u_ * u_ + v_ * v_); }

double TapEnvelope::phase_rad() const noexcept {
  const double phase = std::atan2(v_, u_);
  return phase < 0.0 ? phase + 2.0 * std::numbers::pi : phase;
}

double TapEnvelope::attraction() const noexcept {
  const double amplitude = amplitude_m(), free = lever_->free_phase;
  return amplitude > 0.0 ? (v_ * std::cos(free) - u_ * std::sin(free)) / amplitude : 0.0;
}

}  // namespace afm::physics
