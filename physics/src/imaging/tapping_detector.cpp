// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/tapping_detector.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "physics/quantity_text.h"
#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/driven_lever.h"
#include "physics/tapping/tap_envelope.h"
#include "physics/tapping/tap_surface.h"
#include "require_range.h"

namespace afm::physics {
namespace {

AveragedFlow checked_flow(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever, Length setpoint) {
  const double a0 = lever.free_amplitude.si;
  require_range("quality_factor", lever.quality_factor, AveragedFlow::kLeastQuality, 1e5, kPlainNumber);
  require_range("setpoint", setpoint, Length(0.01 * a0), Length(0.999 * a0), kLengthUnits);
  return AveragedFlow(surface, lever);
}

}  // namespace

TappingDetector::TappingDetector(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever,
                                 Length setpoint)
    : TappingDetector(checked_flow(surface, lever, setpoint), surface->contact_height(), setpoint) {}

TappingDetector::TappingDetector(AveragedFlow&& flow, Length contact_height, Length setpoint)
    : free_amplitude_m_(flow.lever().free_amplitude.si),
      setpoint_m_(setpoint.si),
      engaged_(find_setpoint(flow, contact_height.si)),
      envelope_(std::make_unique<TapEnvelope>(flow, contact_height)) {
  engage();
}

TappingDetector::~TappingDetector() = default;
TappingDetector::TappingDetector(const TappingDetector& other)
    : free_amplitude_m_(other.free_amplitude_m_),
      setpoint_m_(other.setpoint_m_),
      engaged_(other.engaged_),
      envelope_(std::make_unique<TapEnvelope>(*other.envelope_)) {}
TappingDetector::TappingDetector(TappingDetector&& other) noexcept = default;
TappingDetector& TappingDetector::operator=(const TappingDetector& other) { return *this = TappingDetector(other); }
TappingDetector& TappingDetector::operator=(TappingDetector&& other) noexcept = default;

void TappingDetector::engage() noexcept { envelope_->place(engaged_.u_m, engaged_.v_m, engaged_.gap_m); }
void TappingDetector::advance(double gap_m, double angle) noexcept { envelope_->advance(gap_m, gap_m, angle); }

double TappingDetector::amplitude_m() const noexcept { return envelope_->amplitude_m(); }
double TappingDetector::phase_rad() const noexcept { return envelope_->phase_rad(); }
double TappingDetector::lost_j() const noexcept { return envelope_->lost_j(); }
double TappingDetector::peak_force_n() const noexcept { return envelope_->peak_force_n(); }
const DrivenLever& TappingDetector::lever() const noexcept { return envelope_->lever(); }

TappingDetector::Engaged TappingDetector::find_setpoint(AveragedFlow& flow, double contact_m) const {
  const double a0 = free_amplitude_m_, step = a0 / 200.0;
  TapState state{flow.lever().free_amplitude, flow.lever().free_phase};
  double above = contact_m + a0 + std::max(2e-9, 0.5 * a0);
  const double end = contact_m - a0;
  for (double z = above - step; z > end; z -= step) {
    const RestingTap tap = flow.settle(state, Length(z));
    if (tap.state.amplitude.si > setpoint_m_) {
      state = tap.state;
      above = z;
      continue;
    }
    double below = z;
    TapState held = tap.state;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (above + below);
      const RestingTap half = flow.settle(state, Length(middle));
      if (half.state.amplitude.si > setpoint_m_) {
        above = middle;
        state = half.state;
      } else {
        below = middle;
        held = half.state;
      }
    }
    return {below, held.amplitude.si * std::cos(held.phase), held.amplitude.si * std::sin(held.phase)};
  }
  throw UnphysicalValue("setpoint", "no height of the lever has this amplitude over the sample");
}

}  // namespace afm::physics
