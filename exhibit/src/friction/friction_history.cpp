// SPDX-License-Identifier: Apache-2.0
#include "exhibit/friction/friction_history.h"

#include <utility>

namespace afm::exhibit {

namespace {

constexpr physics::Length kKeptPlace(2e-12);  // shorter distances are not stored, so a tip at rest adds nothing

physics::SidewaysPoint point_of(const scene::TipSample& sample) {
  const auto [x, y] = sample.surface.xy_m;
  const auto [fx, fy] = sample.lateral_force_n;
  return {{physics::Length(x), physics::Length(y)}, {physics::Force(fx), physics::Force(fy)}};
}

}  // namespace

void FrictionHistory::add(const scene::TipSample& sample) {
  if (sample.material != material_ || sample.edit_revision != edit_revision_) {
    *this = {};
    material_ = sample.material;
    edit_revision_ = sample.edit_revision;
  }
  const bool lands = !attached_ && sample.phase == physics::Phase::Attached;
  attached_ = sample.phase == physics::Phase::Attached;
  if (lands) {
    if (physics::last_friction_loop(physics::along_main_line(contact_))) earlier_ = std::move(contact_);
    contact_.clear();
  }
  if (!attached_) return;
  const physics::SidewaysPoint point = point_of(sample);
  if (!contact_.empty() && physics::magnitude(point.place - contact_.back().place) < kKeptPlace) return;
  if (contact_.size() == kMostPoints) contact_.erase(contact_.begin(), contact_.begin() + kMostPoints / 3);
  contact_.push_back(point);
}

}  // namespace afm::exhibit
