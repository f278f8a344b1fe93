// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/swing_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/tapping/averaged_flow.h"

namespace afm::physics {
namespace {

constexpr int kFinerSteps = 4 * TappingOscillator::kUsualSteps;  // steps per swing
constexpr double kLongestNewtonStep = 0.1;                       // step of Newton's method, as a share of A0

std::complex<double> map_point_of(const TapState& state) { return std::polar(state.amplitude.si, state.phase); }
TapState swing_state_of(std::complex<double> point) { return {Length(std::abs(point)), std::arg(point)}; }

bool same_swing(const TapState& a, const TapState& b) {
  constexpr double kSameShare = 0.01, kSamePhase = 0.03;
  return abs(a.amplitude - b.amplitude) < kSameShare * b.amplitude &&
         std::abs(std::remainder(a.phase - b.phase, 2.0 * std::numbers::pi)) < kSamePhase;
}

bool is_among(std::span<const TapState> states, const TapState& state) {
  return std::any_of(states.begin(), states.end(), [&](const TapState& other) { return same_swing(state, other); });
}

}  // namespace

SwingMap::SwingMap(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever)
    : tip_(surface, lever), fine_(surface, lever, kFinerSteps), a0_m_(lever.free_amplitude.si) {}

SwingMap::Point SwingMap::after(Point point, Length z, int swings) {
  tip_.place(z, swing_state_of(point));
  return map_point_of(tip_.advance(swings));
}

std::optional<SwingMap::Fixed> SwingMap::fixed_near(Point at, Length z) {
  constexpr int kMostSteps = 20;
  const double nudge = 1e-7 * a0_m_;
  for (int i = 0; i < kMostSteps; ++i) {
    const Point there = after(at, z), missing = at - there;
    const Point by_x = (after(at + nudge, z) - there) / nudge;
    const Point by_v = (after(at + Point(0.0, nudge), z) - there) / nudge;
    const double trace = by_x.real() + by_v.imag();
    const double determinant = by_x.real() * by_v.imag() - by_x.imag() * by_v.real();
    const double of_change = determinant - trace + 1.0;  // determinant of the map minus the identity
    Point step(((by_v.imag() - 1.0) * missing.real() - by_v.real() * missing.imag()) / of_change,
               ((by_x.real() - 1.0) * missing.imag() - by_x.imag() * missing.real()) / of_change);
    const double length = std::abs(step);
    if (!std::isfinite(length)) return std::nullopt;
    if (length > kLongestNewtonStep * a0_m_) step *= kLongestNewtonStep * a0_m_ / length;
    at += step;
    if (length < 1e-9 * a0_m_) return Fixed{at, std::abs(trace) < 1.0 + determinant && determinant < 1.0};
  }
  return std::nullopt;
}

std::optional<DirectSwing> SwingMap::settled_near(Point at, Length z) {
  constexpr double kSettled = 1e-6, kNear = 0.02;  // limits as shares of the free amplitude
  // steps that are long for a stiff contact hold a swing at phases of their own: it goes on in shorter ones
  tip_.place(z, swing_state_of(at));
  const TapState before = tip_.swing().state;
  fine_.place(z, swing_state_of(at));
  const DirectSwing swing = fine_.settle(kSettled);
  if (std::abs(map_point_of(swing.state) - map_point_of(before)) > kNear * a0_m_) return std::nullopt;
  return swing;
}

// Point at which the swing itself rests, for maps made uneven by the steps of direct integration, as under a soft lever
// deep in the sample, where Newton's method does not end.
std::optional<SwingMap::Point> SwingMap::rest_of(Point at, Length z, std::span<const Point> known) {
  constexpr double kNear = 0.03, kRests = 1e-4;  // limits as shares of the free amplitude
  const auto is_near = [&](Point other) { return std::abs(other - at) < kNear * a0_m_; };
  if (std::any_of(known.begin(), known.end(), is_near)) return std::nullopt;
  const Point rest = after(at, z, static_cast<int>(std::ceil(3.0 * tip_.lever().quality_factor)));
  const bool rests = is_near(rest) && std::abs(after(rest, z) - rest) < kRests * a0_m_;
  return rests ? std::optional(rest) : std::nullopt;
}

std::vector<SwingMap::Point> SwingMap::stable_points(Length z) {
  constexpr int kAmplitudes = 8, kPhases = 8, kRounds = 8;
  constexpr double kLeastShare = 0.86, kMostShare = 1.4, kShareStep = 0.0125;  // shares of the height
  constexpr double kNear = 0.03, kSame = 1e-3, kStays = 0.1;                   // limits as shares of the free amplitude
  const int swings = static_cast<int>(std::ceil(0.2 * tip_.lever().quality_factor));
  std::vector<Point> found;
  const auto look = [&](Point at) {
    const auto fixed = fixed_near(at, z);
    const auto same = [&](Point other) { return std::abs(other - fixed->at) < kSame * a0_m_; };
    if (fixed && fixed->stable && std::none_of(found.begin(), found.end(), same)) found.push_back(fixed->at);
    return fixed && fixed->stable && std::abs(fixed->at - at) < kNear * a0_m_;
  };
  const auto look_at_rest = [&](Point at) {
    if (const auto rest = rest_of(at, z, found)) found.push_back(*rest);
  };
  for (double share = kLeastShare; z.si > 0.0 && share < kMostShare && share * z.si < a0_m_; share += kShareStep) {
    // swings that the sample repels, with the phase at which they lose nothing or something
    const double amplitude = z.si * share;
    for (const double loss : {1.0, 1.2}) {
      const Point at = std::polar(amplitude, std::asin(std::min(1.0, loss * amplitude / a0_m_)));
      if (look(at)) continue;
      const Point later = after(at, z, 5 * swings);
      if (std::abs(later - at) < kStays * a0_m_) look_at_rest(later);
    }
  }
  for (int i = 0; i < kAmplitudes * kPhases; ++i) {
    const int ring = i / kPhases;
    Point at = std::polar(a0_m_ * (ring + 1) / kAmplitudes,
                          2.0 * std::numbers::pi * (i % kPhases + 0.5 * (ring % 2)) / kPhases);
    bool ends = false;
    for (int round = 0; round < kRounds && !ends; ++round) {
      ends = look(at);
      if (!ends) at = after(at, z, swings);
    }
    if (!ends) look_at_rest(at);
  }
  return found;
}

std::vector<DirectSwing> SwingMap::stable_beside(std::span<const TapState> known, Length z) {
  std::vector<TapState> seen(known.begin(), known.end());
  std::vector<DirectSwing> beside;
  std::vector<TapState> found;
  for (const Point point : stable_points(z)) {
    tip_.place(z, swing_state_of(point));
    const TapState rough = tip_.swing().state;
    if (is_among(seen, rough)) continue;
    seen.push_back(rough);
    const auto swing = settled_near(point, z);
    if (!swing || is_among(known, swing->state) || is_among(found, swing->state)) continue;
    found.push_back(swing->state);
    beside.push_back(*swing);
  }
  std::sort(beside.begin(), beside.end(),
            [](const DirectSwing& a, const DirectSwing& b) { return a.state.amplitude < b.state.amplitude; });
  return beside;
}

}  // namespace afm::physics
