// SPDX-License-Identifier: Apache-2.0
#include "physics/force_laws.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include "laws/branch_parametrisation.h"
#include "physics/contact.h"
#include "physics/hertz.h"
#include "physics/jkr.h"
#include "physics/lennard_jones.h"
#include "physics/meniscus.h"
#include "physics/van_der_waals.h"

namespace afm::physics {
namespace {

ForceAndSlope no_force(double) { return {0.0, 0.0}; }

}  // namespace

std::string_view source_of(Law law) {
  switch (law) {
    case Law::Paper:
      return "Liu & Peng";
    case Law::Hao:
      return "Hao, Baro & Saenz 1991";
    case Law::Hertz:
      return "Hertz 1882";
    case Law::Dmt:
      return "Derjaguin, Muller & Toporov 1975; Garcia & San Paulo 1999";
    case Law::Jkr:
      return "Johnson, Kendall & Roberts 1971";
    case Law::MaugisDugdale:
      return "Maugis 1992; Kim, McMeeking & Johnson 1998";
    case Law::LennardJones:
      return "Bradley 1932";
    case Law::Measured:
    case Law::Count:
      break;
  }
  return {};
}

ForceLaw hao_law(const ContactParameters& contact, const LawOptions& options) {
  validate(contact);
  validate(options);
  const VanDerWaals van_der_waals(contact.hamaker, contact.tip_radius, options);
  const double adhesion = adhesion_force(contact).si;

  // the attraction is unbounded towards the wall, so any lever jumps before it gets there: the branch ends below the
  // fold of the stiffest lever with the weakest attraction
  constexpr double kNearest = 1e-15;
  const auto approach = [van_der_waals](double s) {
    const Length d(kNearest * std::exp(-s));
    return LawPoint{d, van_der_waals.force(d), -d.si, -van_der_waals.gradient(d).si * d.si};
  };
  const auto wall = [adhesion](double s) {
    return LawPoint{Length(), Force(-adhesion * std::sinh(s)), 0.0, -adhesion * std::cosh(s)};
  };
  return {.free = {-std::log(kFarthest / kNearest), 0.0, approach, {}},
          .attached = {-std::asinh(kHardestPress / adhesion), std::asinh(1.0), wall, {}},
          .contact_gap = Length(),
          .attached_end_potential = std::nullopt};
}

ForceLaw hertz_law(const ContactParameters& contact, const LawOptions&) {
  const AdhesiveContact adhesive = adhesive_contact(contact);
  const Heights heights{0.0, contact.atomic_distance.si};
  const auto attached = [heights, adhesive](double s) {
    return heights.point(s, [&](double above) {
      if (above >= 0.0) return no_force(above);
      const Length indentation(-above);
      const Length radius = sqrt(adhesive.tip_radius * indentation);
      return ForceAndSlope{hertz_load(adhesive, indentation).si, -hertz_stiffness(adhesive, radius).si};
    });
  };
  return {.free = heights.inwards(no_force),
          .attached = {-heights.parameter(kDeepest), heights.parameter(kFarthest), attached, {0.0}},
          .contact_gap = Length(),
          .attached_end_potential = Energy()};
}

ForceLaw dmt_law(const ContactParameters& contact, const LawOptions& options) {
  validate(contact);
  validate(options);
  const VanDerWaals van_der_waals(contact.hamaker, contact.tip_radius, options);
  const Length a0 = contact_gap(contact, options);
  const Force adhesion = adhesion_force(contact);
  const Heights heights{a0.si, a0.si};
  const auto attraction = attraction_above(van_der_waals, a0);
  const double farthest = heights.parameter(kFarthest);
  ForceLaw law{.free = heights.inwards(attraction),
               .attached = {},
               .contact_gap = a0,
               .attached_end_potential = van_der_waals.potential(a0 + Length(kFarthest))};

  if (!isfinite(contact.reduced_modulus)) {
    const auto rigid = [=](double s) {
      if (s >= 0.0) return heights.point(s, attraction);
      return LawPoint{a0, adhesion * (std::sinh(-s) - 1.0), 0.0, -adhesion.si * std::cosh(s)};
    };
    law.attached = {-std::asinh(kHardestPress / adhesion.si), farthest, rigid, {0.0}};
    return law;
  }

  const AdhesiveContact adhesive = adhesive_contact(contact);
  const auto elastic = [=](double s) {
    if (s >= 0.0) return heights.point(s, attraction);
    return heights.point(s, [&](double above) {
      const Length indentation(-above);
      const Length radius = sqrt(adhesive.tip_radius * indentation);
      return ForceAndSlope{(hertz_load(adhesive, indentation) - adhesion).si, -hertz_stiffness(adhesive, radius).si};
    });
  };
  law.attached = {-heights.parameter(kDeepest), farthest, elastic, {0.0}};
  return law;
}

ForceLaw jkr_law(const ContactParameters& contact, const LawOptions&) {
  const AdhesiveContact adhesive = adhesive_contact(contact);
  const Heights heights{0.0, contact.atomic_distance.si};

  // contact radii by equal factors, from deep inside to the end of the neck under fixed grips, where dh/da = 0; a
  // softer lever loses the contact earlier
  const double end = jkr_fixed_grips_radius(adhesive).si;
  const auto attached = [adhesive, end](double s) {
    const Length a(end * std::exp(-s));
    const auto& [r, e, w] = adhesive;
    const Length neck = a * a / r - jkr_indentation(adhesive, a);
    const double ddelta_da = (2.0 * a / r - neck / (2.0 * a));
    const Force hertz = 4.0 / 3.0 * e * a * (a * a / r);
    const Force load = jkr_load(adhesive, a);
    const double dload_da = ((3.0 * hertz - 1.5 * (hertz - load)) / a).si;
    return LawPoint{-jkr_indentation(adhesive, a), load, ddelta_da * a.si, -dload_da * a.si};
  };
  const double deep = 1e3 * end + std::sqrt(adhesive.tip_radius.si * kDeepest);
  return {.free = heights.inwards(no_force),
          .attached = {-std::log(deep / end), 0.0, attached, {}},
          .contact_gap = Length(),
          .attached_end_potential = jkr_energy(adhesive, Length(end))};
}

ForceLaw lennard_jones_law(const ContactParameters& contact, const LawOptions&) {
  validate(contact);
  const Length z0 = contact.atomic_distance;
  const LennardJones surfaces(work_of_adhesion(contact), contact.tip_radius, z0);

  // gaps by equal factors of the atomic distance; free down to the minimum of the force, which is inside of the
  // steepest attraction and so of every fold
  const auto outwards = [surfaces, z0](double s) {
    const Length d = z0 * std::exp(s);
    return LawPoint{d, surfaces.force(d), d.si, (surfaces.gradient(d) * d).si};
  };
  const double farthest = std::log(kFarthest / z0.si);
  const double hardest = std::log(kHardestPress / adhesion_force(contact).si) / 8.0;
  const LawBranch attached{-hardest, farthest, outwards, {}};
  return {.free = reversed(attached, 0.0),
          .attached = attached,
          .contact_gap = z0,
          .attached_end_potential = surfaces.potential(z0 * std::exp(farthest))};
}

ForceLaw force_law(Law law, const ContactParameters& contact, const LawOptions& options) {
  validate(options);
  LawCurve* const curve = traits_of(law).curve;
  if (curve == nullptr) {
    throw std::invalid_argument("the law \"" + std::string(name_of(law)) + "\" is not given by a curve of force");
  }
  ForceLaw dry = curve(contact, options);
  return options.meniscus ? with_meniscus(dry, *options.meniscus, contact.tip_radius) : dry;
}

Length hertz_radius(const ContactParameters& contact, Force force) {
  return hertz_contact_radius(adhesive_contact(contact), std::max(Force(), force));
}

Length dmt_radius(const ContactParameters& contact, Force force) {
  const AdhesiveContact adhesive = adhesive_contact(contact);
  return dmt_contact_radius(adhesive, std::max(-dmt_adhesion(adhesive), force));
}

Length jkr_radius(const ContactParameters& contact, Force force) {
  const AdhesiveContact adhesive = adhesive_contact(contact);
  return jkr_contact_radius(adhesive, std::max(jkr_pull_off_load(adhesive), force));
}

}  // namespace afm::physics
