// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>

#include "physics/manipulation/sample_drift.h"
#include "scene/shared/particle_blocks.h"

namespace afm::haptics {

// Drift of the sample below the scanner at level 2 (scene::SharedLevel); at other levels it rests. Metres of the
// nanoworld along the sample's x and y; times as in TipState. Thread of the servo; nothing allocates.
class FeltDrift {
 public:
  explicit FeltDrift(const scene::SharedLevel& level) noexcept
      : drift_(level.level > 1 ? physics::kUsualDrift : physics::Velocity(0.0), level.seed),
        drifts_(level.level > 1),
        since_ns_(level.since_ns) {}

  // Advances the drift; call once a tick. The drift starts in the first one, unless the level has an earlier start.
  void follow(std::int64_t now_ns) noexcept {
    now_ns_ = now_ns;
    if (!drifts_) return;
    if (since_ns_ == 0) since_ns_ = now_ns;
    const glm::dvec2 before_m = way_m_;
    way_m_ = way_at(now_ns);
    step_m_ = way_m_ - before_m;
  }

  // Returns the sample to its place, from which it drifts again.
  void begin_again() noexcept {
    if (drifts_) since_ns_ = now_ns_;
    way_m_ = step_m_ = glm::dvec2(0.0);
  }

  bool drifts() const noexcept { return drifts_; }
  std::int64_t since_ns() const noexcept { return drifts_ ? since_ns_ : 0; }
  const glm::dvec2& way_m() const noexcept { return way_m_; }    // drift since the start
  const glm::dvec2& step_m() const noexcept { return step_m_; }  // drift in the newest tick

  // Way of the sample at a time; none before the start.
  glm::dvec2 way_at(std::int64_t time_ns) const noexcept {
    const double elapsed_s = 1e-9 * static_cast<double>(std::max<std::int64_t>(0, time_ns - since_ns_));
    const auto way = drift_.after(physics::Time(elapsed_s));
    return {way.x.si, way.y.si};
  }

 private:
  physics::SampleDrift drift_;
  bool drifts_;
  std::int64_t since_ns_;
  std::int64_t now_ns_ = 0;
  glm::dvec2 way_m_{0.0};
  glm::dvec2 step_m_{0.0};
};

}  // namespace afm::haptics
