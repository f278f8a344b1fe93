// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "laws/branch_parametrisation.h"
#include "physics/force_laws.h"
#include "physics/maugis_dugdale.h"
#include "physics/van_der_waals.h"

namespace afm::physics {
namespace {

// Maugis' contact in metres and newtons, along the family's parameter.
struct DimensionalContact {
  double lambda;
  MaugisUnits units;
  Length gap;  // height at which the indentation is zero

  LawPoint at(double s) const {
    const MaugisPoint point = maugis_point(lambda, s);
    return {gap - point.indentation * units.indentation, point.load * units.load,
            -point.dindentation_ds * units.indentation.si, point.dload_ds * units.load.si};
  }

  // Parameter at which the contact is as large as the deepest that a branch must include.
  double deepest(Length tip_radius) const {
    constexpr double kFarBeyondAdhesion = 100.0;
    const double wanted = kFarBeyondAdhesion + std::sqrt(tip_radius.si * kDeepest) / units.radius.si;
    double s = -1.0;
    while (maugis_point(lambda, s).contact_radius < wanted) s -= 0.25;
    return s;
  }
};

// Parameter at which van der Waals attraction equals the contact's, between one where it is stronger or equal and one
// where it is weaker. There is at most one in between: over the height, the contact's force is convex and van der
// Waals' concave.
double equal_forces(const DimensionalContact& neck_contact, const VanDerWaals& van_der_waals, double stronger,
                    double weaker) {
  for (;;) {
    const double middle = 0.5 * (stronger + weaker);
    if (middle == stronger || middle == weaker) return weaker;
    const LawPoint point = neck_contact.at(middle);
    (van_der_waals.force(point.h) > point.force ? weaker : stronger) = middle;
  }
}

// The parameter at which the indentation is zero.
double zero_indentation(const DimensionalContact& neck_contact, double inner, double outer) {
  for (;;) {
    const double middle = 0.5 * (inner + outer);
    if (!(middle > inner && middle < outer)) return outer;
    (neck_contact.at(middle).h < neck_contact.gap ? inner : outer) = middle;
  }
}

}  // namespace

ForceLaw maugis_law(const ContactParameters& contact, const LawOptions& options) {
  validate(options);
  const AdhesiveContact elastic = adhesive_contact(contact);
  const VanDerWaals van_der_waals(contact.hamaker, contact.tip_radius, options);
  const Length a0 = contact_gap(contact, options);
  const double lambda = maugis_lambda(elastic, cohesive_stress(elastic.work_of_adhesion, contact.atomic_distance));
  const DimensionalContact neck_contact{lambda, maugis_units(elastic), a0};
  const double deepest = neck_contact.deepest(elastic.tip_radius);
  const double end = maugis_fixed_grips_end(lambda);
  const double contact_end = std::min(end, 0.0);

  // the law is single-valued: both branches are one curve; the free one extends inwards to its largest attraction,
  // beyond which it has no fold. Beyond the parameter `joint` the van der Waals force acts, which is no stronger than
  // the contact there
  const auto joined_at = [&](double joint, std::vector<double> kinks) {
    const LawPoint held = neck_contact.at(joint);
    const Heights heights{held.h.si, a0.si};
    const auto attraction = [=, unbound = attraction_above(van_der_waals, held.h)](double above) {
      const ForceAndSlope here = unbound(above);
      return here.force < held.force.si ? ForceAndSlope{held.force.si, 0.0} : here;
    };
    constexpr double kShortest = 1e-9;  // length of a plateau in the parameter; shorter ones are rounding errors
    const double plateau = heights.parameter((van_der_waals.gap_at(held.force) - held.h).si);
    if (plateau > kShortest) kinks.push_back(joint + plateau);
    const auto curve = [=](double s) { return s < joint ? neck_contact.at(s) : heights.point(s - joint, attraction); };
    const LawBranch attached{deepest, joint + heights.parameter(kFarthest), curve, std::move(kinks)};
    return ForceLaw{.free = reversed(attached, maugis_pull_off(lambda)),
                    .attached = attached,
                    .contact_gap = a0,
                    .attached_end_potential = van_der_waals.potential(held.h + Length(kFarthest))};
  };

  const LawPoint neck = neck_contact.at(contact_end);
  if (van_der_waals.force(neck.h) < neck.force) return joined_at(contact_end, {contact_end});

  const LawPoint last = neck_contact.at(end);
  if (van_der_waals.force(last.h) <= last.force) {
    const double joint = equal_forces(neck_contact, van_der_waals, end, contact_end);
    return joined_at(joint, {0.0, joint});
  }

  const double touching = zero_indentation(neck_contact, deepest, contact_end);
  const double formed = equal_forces(neck_contact, van_der_waals, touching, end);
  const Length formation = neck_contact.at(formed).h;
  const Heights heights{formation.si, a0.si};
  LawBranch attached{deepest, end, [neck_contact](double s) { return neck_contact.at(s); }, {}};
  if (contact_end < end) attached.kinks = {contact_end};
  const Energy work = work_along(attached, formed, end);
  return {.free = heights.inwards(attraction_above(van_der_waals, formation)),
          .attached = std::move(attached),
          .contact_gap = a0,
          .attached_end_potential = van_der_waals.potential(formation) - work};
}

Length maugis_radius(const ContactParameters& contact, Force force) {
  const AdhesiveContact adhesive = adhesive_contact(contact);
  const MaugisUnits units = maugis_units(adhesive);
  const double lambda = maugis_lambda(adhesive, cohesive_stress(adhesive.work_of_adhesion, contact.atomic_distance));
  const double load = force / units.load;
  const double least = maugis_point(lambda, maugis_pull_off(lambda)).load;
  if (load <= least) return maugis_point(lambda, maugis_pull_off(lambda)).contact_radius * units.radius;
  return maugis_point(lambda, maugis_at_load(lambda, load)).contact_radius * units.radius;
}

}  // namespace afm::physics
