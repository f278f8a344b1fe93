// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/frequency_shift.h"

#include <cmath>
#include <numbers>

#include "physics/contact_parameters.h"
#include "physics/quantity_text.h"
#include "require_range.h"

namespace afm::physics {
namespace {

class FrequencyShift {
 public:
  FrequencyShift(const TapSurface& surface, Frequency resonance, Length amplitude)
      : surface_(surface), resonance_(resonance), amplitude_(amplitude) {
    using namespace literals;
    require_range("amplitude", amplitude, 1_pm, 10_um, kLengthUnits);
    validate(LeverDynamics{resonance, 1.0, Temperature()});
  }

  FrequencyShiftPoint at(Length z) const {
    const Stiffness k = surface_.contact().spring_constant;
    const double rate = 2.0 * std::numbers::pi * resonance_.si;
    FrequencyShiftPoint point{.z = z, .shift = {}, .small_amplitude_shift = {}, .averages = {}};
    point.averages = surface_.exact_averages({amplitude_, z, rate});
    point.shift = -(point.averages.virial / (k * amplitude_ * amplitude_)) * resonance_;
    point.small_amplitude_shift = -(surface_.exact_gradient(z) / (2.0 * k)) * resonance_;
    return point;
  }

  // The turn between two heights, by golden section; `sign` is positive for a least value.
  FrequencyShiftTurn turn_between(Length low, Length high, double sign) const {
    constexpr double kGolden = 0.6180339887498949;
    constexpr int kSteps = 60;
    for (int i = 0; i < kSteps; ++i) {
      const Length a = high - kGolden * (high - low), b = low + kGolden * (high - low);
      const bool lower_half = sign * at(a).shift.si < sign * at(b).shift.si;
      (lower_half ? high : low) = lower_half ? b : a;
    }
    const Length z = 0.5 * (low + high);
    return {z, at(z).shift};
  }

 private:
  const TapSurface& surface_;
  Frequency resonance_;
  Length amplitude_;
};

}  // namespace

FrequencyShiftPoint frequency_shift_at(const TapSurface& surface, Frequency resonance, Length amplitude, Length z) {
  return FrequencyShift(surface, resonance, amplitude).at(z);
}

FrequencyShiftCurve record_frequency_shift(const TapSurface& surface, Frequency resonance, Length amplitude,
                                           const SweepPlan& plan) {
  const FrequencyShift shift(surface, resonance, amplitude);
  const std::uint64_t down = sample_count(plan) / 2;
  FrequencyShiftCurve curve;
  curve.points.reserve(down + 1);
  for (std::uint64_t i = 0; i <= down; ++i) curve.points.push_back(shift.at(sample_z(plan, i)));
  for (std::size_t i = 2; i < curve.points.size(); ++i) {
    const auto &above = curve.points[i - 2], &here = curve.points[i - 1], &below = curve.points[i];
    const double before = here.shift.si - above.shift.si, after = below.shift.si - here.shift.si;
    if (before * after < 0.0) curve.turns.push_back(shift.turn_between(below.z, above.z, after > 0.0 ? 1.0 : -1.0));
  }
  return curve;
}

}  // namespace afm::physics
