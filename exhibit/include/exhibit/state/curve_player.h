// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

#include "exhibit/state/cycle_curve.h"
#include "physics/force_curve.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// Plays a curve that was computed in an instant at a pace that people can follow: the tip moves along it, and its path
// is drawn. One thread.
class CurvePlayer {
 public:
  static constexpr double kSeconds = 2.0;  // time for one curve, whatever its length

  // Begins again from the first sample.
  void begin(std::shared_ptr<const physics::ForceCurve> curve);

  // Advances the playback.
  void advance(double seconds);

  bool playing() const { return curve_ != nullptr && next_ < curve_->samples.size(); }

  // Position of the tip; the first one before begin().
  const scene::Tip& tip() const { return tip_; }
  physics::Phase phase() const { return phase_; }
  bool retracting() const { return retracting_; }
  const CycleCurve& drawn() const { return drawn_; }

 private:
  std::shared_ptr<const physics::ForceCurve> curve_;  // curve being played; the sender may already have another
  std::size_t next_ = 0;                              // index of the first sample not yet played
  double seconds_ = 0;
  scene::Tip tip_{};
  physics::Phase phase_ = physics::Phase::Free;
  bool retracting_ = false;
  CycleCurve drawn_;
};

}  // namespace afm::exhibit
