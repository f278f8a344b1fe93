// SPDX-License-Identifier: Apache-2.0
#include "fits/driven_contact.h"

#include <cmath>
#include <optional>

#include "adhesive_branch.h"
#include "series.h"

namespace afm::fits {

struct DrivenContact::Law {
  Indenter indenter;
  double modulus_pa, spring_n_per_m;
  std::optional<AdhesiveBranch> sticking{};  // branch of a law of adhesion
  double near = 0;                           // result of the last search: parameter of the branch, or depth in m
};

DrivenContact::DrivenContact(const Indenter& indenter, double reduced_modulus_pa, double work_j_per_m2,
                             double spring_n_per_m)
    : law_(std::make_unique<Law>(Law{indenter, reduced_modulus_pa, spring_n_per_m})) {
  if (!row_of(indenter.shape).is_adhesive) return;
  const physics::AdhesiveContact contact{physics::Length(indenter.radius_m), physics::Pressure(reduced_modulus_pa),
                                         physics::SurfaceEnergy(work_j_per_m2)};
  law_->sticking.emplace(indenter.shape, contact, indenter.atomic_distance_m, spring_n_per_m);
  law_->near = law_->sticking->fold();
  way_off_m_ = law_->sticking->fold_way_m();
  tabor_ = tabor_of(contact, indenter.atomic_distance_m);
}

DrivenContact::~DrivenContact() = default;
DrivenContact::DrivenContact(DrivenContact&&) noexcept = default;

double DrivenContact::pull_off_n() const { return law_->sticking ? law_->sticking->pull_off_n() : 0.0; }

DrivenContact::State DrivenContact::touching(double way_m) {
  if (law_->sticking) {
    const AdhesiveBranch::Held held = law_->sticking->at(way_m, law_->near);
    return {held.depth_m, held.force_n};
  }
  const InSeries found = in_series(law_->indenter, law_->modulus_pa, law_->spring_n_per_m, way_m, law_->near);
  law_->near = found.depth_m;
  return {found.depth_m, law_->modulus_pa * found.push.force};
}

// Finds the way by bisection; the force grows with a way that pushes, and the lever by itself bends by F/k.
double DrivenContact::way_of(double force_n) {
  constexpr int kHalvings = 60;
  double less_m = 0.0, more_m = force_n / law_->spring_n_per_m;
  while (std::isfinite(more_m) && touching(more_m).force_n < force_n) {
    less_m = more_m;
    more_m *= 2.0;
  }
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_m = 0.5 * (less_m + more_m);
    (touching(middle_m).force_n < force_n ? less_m : more_m) = middle_m;
  }
  return more_m;
}

}  // namespace afm::fits
