// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/cycle_history.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace afm::exhibit {

namespace {

// Turning distance of the hand; its millimetres are comparable for all materials, since a stroke is 50 mm.
constexpr double kHandTurnM = 0.001;
constexpr double kKeptM = 0.00005;

}  // namespace

bool CycleHistory::sound() const {
  const auto is_sound = [](const CycleCurve& curve) { return curve.sound(); };
  return std::all_of(curves_.begin(), curves_.end(), is_sound) && next_.sound() && material_ >= -1 &&
         material_ < static_cast<std::int32_t>(curves_.size()) && cycles_ >= 0;
}

void CycleHistory::begin(const scene::TipSample& sample) {
  material_ = sample.material;
  edit_revision_ = sample.edit_revision;
  curves_[static_cast<std::size_t>(material_)] = {};
  next_ = {};
  attached_ = released_ = pressed_ = false;
  cycles_ = 0;
  drawn_height_m_ = std::numeric_limits<double>::infinity();
}

void CycleHistory::add(const scene::TipSample& sample) {
  if (sample.material != material_ || sample.edit_revision != edit_revision_) begin(sample);
  CycleCurve& curve = curves_[static_cast<std::size_t>(material_)];

  const double height = sample.hand_height_m;
  turn_height_m_ = ascending_ ? std::max(turn_height_m_, height) : std::min(turn_height_m_, height);
  if (std::abs(height - turn_height_m_) > kHandTurnM) {
    ascending_ = !ascending_;
    turn_height_m_ = height;
  }

  const bool attached = sample.phase == physics::Phase::Attached;
  if (attached && !attached_ && released_) {
    curve = std::exchange(next_, {});
    released_ = false;
  }
  if (!attached && attached_) {
    released_ = true;
    if (sample.phase == physics::Phase::Free) ++cycles_;
  }
  attached_ = attached;
  pressed_ = attached && (pressed_ || sample.tip.z_m <= 0.0);

  // a hand at rest adds nothing
  if (std::abs(height - drawn_height_m_) < kKeptM) return;
  drawn_height_m_ = height;
  curve.add(sample);
  if (released_) next_.add(sample);
}

void CycleHistory::add(const scene::TipEvent& event) {
  if (event.material != material_) return;
  CycleCurve& curve = curves_[static_cast<std::size_t>(material_)];
  if (event.kind == physics::EventKind::JumpToContact && released_) next_.add(event);
  curve.add(event);
}

}  // namespace afm::exhibit
