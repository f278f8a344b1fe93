// SPDX-License-Identifier: Apache-2.0
#include "physics/van_der_waals.h"

#include <cmath>

#include "physics/contact.h"

namespace afm::physics {
namespace {

// R/D + R/(D + 2R) + ln(D/(D + 2R)) for x = D/R. The terms cancel for large x: there by twice the series
// sum over odd n >= 3 of y^n (n - 1)/n in y = 1/(1 + x), whose next term would be below 1e-16 of the first.
double hamaker_bracket(double x) {
  constexpr double kSeriesAbove = 2.0;
  if (x < kSeriesAbove) return 1.0 / x + 1.0 / (x + 2.0) + std::log(x / (x + 2.0));
  const double y = 1.0 / (1.0 + x);
  double sum = 0.0;
  for (int n = 33; n >= 3; n -= 2) sum = sum * y * y + (n - 1.0) / n;
  return 2.0 * sum * y * y * y;
}

}  // namespace

VanDerWaals::VanDerWaals(Energy hamaker, Length tip_radius, const LawOptions& options)
    : hamaker_(hamaker.si),
      radius_(tip_radius.si),
      exact_sphere_(options.exact_hamaker_sphere),
      retardation_per_metre_(options.retardation_wavelength ? 14.0 / options.retardation_wavelength->si : 0.0) {}

double VanDerWaals::bare_potential(double gap) const noexcept {
  if (!exact_sphere_) return -hamaker_ * radius_ / (6.0 * gap);
  return -hamaker_ / 6.0 * hamaker_bracket(gap / radius_);
}

double VanDerWaals::bare_force(double gap) const noexcept {
  const double derjaguin = -hamaker_ * radius_ / (6.0 * gap * gap);
  if (!exact_sphere_) return derjaguin;
  const double weakening = 1.0 + gap / (2.0 * radius_);
  return derjaguin / (weakening * weakening);
}

double VanDerWaals::bare_gradient(double gap) const noexcept {
  const double relative = 2.0 / gap + (exact_sphere_ ? 2.0 / (gap + 2.0 * radius_) : 0.0);
  return -bare_force(gap) * relative;
}

Energy VanDerWaals::potential(Length gap) const noexcept {
  return Energy(bare_potential(gap.si) / (1.0 + retardation_per_metre_ * gap.si));
}

Force VanDerWaals::force(Length gap) const noexcept {
  const double factor = 1.0 / (1.0 + retardation_per_metre_ * gap.si);
  const double slope = -retardation_per_metre_ * factor * factor;
  return Force(bare_force(gap.si) * factor - bare_potential(gap.si) * slope);
}

Stiffness VanDerWaals::gradient(Length gap) const noexcept {
  const double factor = 1.0 / (1.0 + retardation_per_metre_ * gap.si);
  const double slope = -retardation_per_metre_ * factor * factor;
  const double curvature = -2.0 * retardation_per_metre_ * factor * slope;
  return Stiffness(bare_gradient(gap.si) * factor + 2.0 * bare_force(gap.si) * slope -
                   bare_potential(gap.si) * curvature);
}

Length VanDerWaals::gap_at(Force attraction) const noexcept {
  // Derjaguin's force is the strongest, so its gap is an upper bound; from there Newton's method in ln F(ln D), which
  // is concave and decreasing, converges without overshoot
  const double derjaguin = std::sqrt(hamaker_ * radius_ / (-6.0 * attraction.si));
  Length gap(derjaguin);
  constexpr int kMostSteps = 60;
  for (int i = 0; i < kMostSteps; ++i) {
    const double excess = std::log(force(gap) / attraction);
    const double slope = gap * gradient(gap) / force(gap);
    const Length next = gap * std::exp(-excess / slope);
    if (!(next < gap)) break;
    gap = next;
  }
  return gap;
}

Length contact_gap(const ContactParameters& contact, const LawOptions& options) {
  return VanDerWaals(contact.hamaker, contact.tip_radius, options).gap_at(-adhesion_force(contact));
}

}  // namespace afm::physics
