// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/tapping_detector.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "physics/quantity_text.h"
#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/tap_envelope.h"
#include "physics/tapping/tap_surface.h"
#include "physics/tapping/tap_table.h"
#include "require_range.h"

namespace afm::physics {
namespace {

// A swing at rest with the base at a height.
struct HeldSwing {
  double z_m, u_m, v_m;
};

// The first resting swing on the way down whose amplitude is no larger than the setpoint.
std::optional<HeldSwing> first_held(const TapTable& rests, double setpoint_m) {
  const double step = rests.lever().free_amplitude.si / 2000.0;
  bool repelled = false;
  for (double z = rests.highest().si; z >= rests.lowest().si; z -= step) {
    repelled = rests.repelled_at(repelled, z);
    const TapTable::Rest rest = rests.at(repelled, z);
    if (std::hypot(rest.u_m, rest.v_m) <= setpoint_m) return HeldSwing{z, rest.u_m, rest.v_m};
  }
  return std::nullopt;
}

std::optional<HeldSwing> first_held(AveragedFlow& flow, double contact_m, double setpoint_m) {
  const double a0 = flow.lever().free_amplitude.si, step = a0 / 200.0;
  TapState state{flow.lever().free_amplitude, flow.lever().free_phase};
  double above = contact_m + a0 + std::max(2e-9, 0.5 * a0);
  const double end = contact_m - a0;
  for (double z = above - step; z > end; z -= step) {
    const RestingTap tap = flow.settle(state, Length(z));
    if (tap.state.amplitude.si > setpoint_m) {
      state = tap.state;
      above = z;
      continue;
    }
    double below = z;
    TapState held = tap.state;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (above + below);
      const RestingTap half = flow.settle(state, Length(middle));
      if (half.state.amplitude.si > setpoint_m) {
        above = middle;
        state = half.state;
      } else {
        below = middle;
        held = half.state;
      }
    }
    return HeldSwing{below, held.amplitude.si * std::cos(held.phase), held.amplitude.si * std::sin(held.phase)};
  }
  return std::nullopt;
}

}  // namespace

TappingDetector::TappingDetector(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever,
                                 Length setpoint, std::shared_ptr<const TapTable> rests)
    : surface_(surface), lever_(lever), rests_(std::move(rests)) {
  const bool averages = lever.quality_factor >= AveragedFlow::kLeastQuality;
  if (!averages && !rests_) rests_ = std::make_shared<const TapTable>(surface, lever);
  hold(setpoint);
  if (averages) {
    AveragedFlow flow = averaged_flow();
    envelope_ = std::make_unique<TapEnvelope>(flow, surface->contact_height());
  } else {
    envelope_ = std::make_unique<TapEnvelope>(rests_);
  }
  engage();
}

TappingDetector::~TappingDetector() = default;
TappingDetector::TappingDetector(const TappingDetector& other)
    : surface_(other.surface_),
      lever_(other.lever_),
      rests_(other.rests_),
      setpoint_m_(other.setpoint_m_),
      engaged_(other.engaged_),
      envelope_(std::make_unique<TapEnvelope>(*other.envelope_)) {}
TappingDetector::TappingDetector(TappingDetector&& other) noexcept = default;
TappingDetector& TappingDetector::operator=(const TappingDetector& other) { return *this = TappingDetector(other); }
TappingDetector& TappingDetector::operator=(TappingDetector&& other) noexcept = default;

// Flow of the averages; for a lever driven at its resonance every image is that of earlier versions.
AveragedFlow TappingDetector::averaged_flow() const {
  const bool exact = lever_.harmonics == Harmonics::OfTheDrive && lever_.ratio != 1.0;
  return {surface_, lever_, exact ? AveragedFlow::Search::Exact : AveragedFlow::Search::AsFelt};
}

void TappingDetector::hold(Length setpoint) {
  engaged_ = find_setpoint(setpoint);
  setpoint_m_ = setpoint.si;
}

void TappingDetector::drive(const DrivenLever& lever, Length setpoint) {
  if (lever == lever_) return hold(setpoint);
  if (rests_) throw UnphysicalValue("drive", "the table of a low quality factor is for one drive");
  const DrivenLever before = std::exchange(lever_, lever);
  try {
    hold(setpoint);
  } catch (...) {
    lever_ = before;
    throw;
  }
  envelope_->drive(lever_);
}

void TappingDetector::engage() noexcept { envelope_->place(engaged_.u_m, engaged_.v_m, engaged_.gap_m); }
void TappingDetector::advance(double gap_m, double angle) noexcept { envelope_->advance(gap_m, gap_m, angle); }

double TappingDetector::amplitude_m() const noexcept { return envelope_->amplitude_m(); }
double TappingDetector::phase_rad() const noexcept { return envelope_->phase_rad(); }
double TappingDetector::lost_j() const noexcept { return envelope_->lost_j(); }
double TappingDetector::peak_force_n() const noexcept { return envelope_->peak_force_n(); }

TappingDetector::Engaged TappingDetector::find_setpoint(Length setpoint) const {
  const double a0 = lever_.free_amplitude.si;
  require_range("setpoint", setpoint, Length(0.01 * a0), Length(0.999 * a0), kLengthUnits);
  std::optional<HeldSwing> held;
  if (rests_) {
    held = first_held(*rests_, setpoint.si);
  } else {
    AveragedFlow flow = averaged_flow();
    held = first_held(flow, surface_->contact_height().si, setpoint.si);
  }
  if (!held) throw UnphysicalValue("setpoint", "no height of the lever has this amplitude over the sample");
  return {held->z_m, held->u_m, held->v_m};
}

}  // namespace afm::physics
