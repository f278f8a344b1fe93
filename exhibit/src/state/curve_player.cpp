// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/curve_player.h"

#include <algorithm>
#include <utility>

namespace afm::exhibit {

void CurvePlayer::begin(std::shared_ptr<const physics::ForceCurve> curve) {
  curve_ = std::move(curve);
  next_ = 0;
  seconds_ = 0;
  drawn_ = {};
  advance(0.0);
}

void CurvePlayer::advance(double seconds) {
  if (!playing()) return;
  constexpr std::size_t kMostDrawn = 2000;  // points, without those of the jumps
  const std::size_t count = curve_->samples.size(), stride = count / kMostDrawn + 1;
  seconds_ += seconds;
  const double share = std::min(1.0, seconds_ / kSeconds);
  const auto end = std::max<std::size_t>(1, static_cast<std::size_t>(share * static_cast<double>(count)));
  for (; next_ < end; ++next_) {
    const physics::CurveSample& sample = curve_->samples[next_];
    tip_ = {.z_m = sample.z.si,
            .force_n = sample.force.si,
            .height_m = sample.tip_height.si,
            .deflection_m = sample.cantilever_deflection.si,
            .sample_deformation_m = sample.sample_deformation.si};
    phase_ = sample.phase;
    retracting_ = sample.branch == physics::Branch::Retract;
    if (next_ % stride != 0 && !sample.event && next_ + 1 != count) continue;
    scene::TipSample drawn{};
    drawn.tip = tip_;
    drawn.phase = phase_;
    drawn.servo_state = scene::ServoState::Running;
    drawn_.add(drawn);
  }
}

}  // namespace afm::exhibit
