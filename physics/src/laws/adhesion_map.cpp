// SPDX-License-Identifier: Apache-2.0
#include "physics/adhesion_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "physics/adhesive_contact.h"
#include "physics/contact.h"
#include "physics/maugis_dugdale.h"

namespace afm::physics {
namespace {

// Johnson & Greenwood 1997 define the borders of DMT and JKR by the terms that each neglects; in the Tabor parameter,
// at loads of the order of the adhesion, these are the values (Maugis 1992 puts them at the same values of lambda =
// 1.157 mu).
constexpr double kDmtBelow = 0.1;
constexpr double kJkrAbove = 5.0;

// Share of the load below which Johnson and Greenwood neglect adhesion: Hertz.
constexpr double kNegligibleAdhesion = 0.05;

// Flattening over the range of the attraction, W/sigma0, below which they call a contact rigid (Bradley).
constexpr double kNegligibleFlattening = 0.05;

// lambda/mu: 2 (16/(9 sqrt3)) cbrt(9/(16 pi)).
const double kLambdaPerTabor = 32.0 / (9.0 * std::numbers::sqrt3) * std::cbrt(9.0 / (16.0 * std::numbers::pi));

// DMT's indentation in units of the range of attraction: cbrt((9/16) (P + 2 pi W R)^2/(R E*^2)) divided by W/sigma0 =
// (9 sqrt3/16) z0.
double flattening(double tabor, double load) {
  const double indentation = tabor * std::cbrt(9.0 / 16.0 * std::pow(std::numbers::pi * (load + 2.0), 2.0));
  return indentation / (9.0 * std::numbers::sqrt3 / 16.0);
}

// Contribution of adhesion to the load: Hertz' load for the contact's radius, a^3 in Maugis' units, minus the load.
double adhesive_load(double tabor, double load) {
  // outside these limits the contact is DMT's or JKR's within rounding
  const double lambda = std::clamp(kLambdaPerTabor * tabor, 1e-3, 1e3);
  const double radius = maugis_point(lambda, maugis_at_load(lambda, load)).contact_radius;
  return radius * radius * radius - load;
}

template <class... Arguments>
std::string text(const char* format, Arguments... arguments) {
  std::array<char, 256> line{};
  const int length = std::snprintf(line.data(), line.size(), format, arguments...);
  return std::string(line.data(), static_cast<std::size_t>(length));
}

}  // namespace

std::string_view name_of(Regime regime) {
  switch (regime) {
    case Regime::Rigid:
      return "rigid";
    case Regime::Hertz:
      return "hertz";
    case Regime::Dmt:
      return "dmt";
    case Regime::Maugis:
      return "maugis";
    case Regime::Jkr:
      return "jkr";
  }
  return "unknown";
}

double tabor_parameter(const ContactParameters& contact) {
  if (!isfinite(contact.reduced_modulus)) return 0.0;
  const double w = work_of_adhesion(contact).si / contact.reduced_modulus.si;
  const double z0 = contact.atomic_distance.si;
  return std::cbrt(contact.tip_radius.si * w * w) / z0;
}

double maugis_parameter(const ContactParameters& contact) {
  if (!isfinite(contact.reduced_modulus)) return 0.0;
  const SurfaceEnergy w = work_of_adhesion(contact);
  return maugis_lambda({contact.tip_radius, contact.reduced_modulus, w}, cohesive_stress(w, contact.atomic_distance));
}

Regime regime_of(double tabor, double load) {
  if (load > 0.0 && adhesive_load(tabor, load) < kNegligibleAdhesion * load) return Regime::Hertz;
  if (flattening(tabor, std::fmax(load, 0.0)) < kNegligibleFlattening) return Regime::Rigid;
  if (tabor < kDmtBelow) return Regime::Dmt;
  return tabor > kJkrAbove ? Regime::Jkr : Regime::Maugis;
}

LawChoice choose_law(const ContactParameters& contact) {
  validate(contact);
  LawChoice choice;
  choice.tabor = tabor_parameter(contact);
  choice.maugis = maugis_parameter(contact);
  choice.regime = regime_of(choice.tabor, 0.0);
  switch (choice.regime) {
    case Regime::Jkr:
      choice.law = Law::Jkr;
      choice.reason = text("Tabor parameter %.3g > %g: the contact is soft enough to be drawn out into a neck, so JKR",
                           choice.tabor, kJkrAbove);
      break;
    case Regime::Maugis:
      choice.law = Law::MaugisDugdale;
      choice.reason = text(
          "Tabor parameter %.3g between %g and %g (Maugis' lambda %.3g): neither DMT nor JKR holds, so "
          "Maugis-Dugdale",
          choice.tabor, kDmtBelow, kJkrAbove, choice.maugis);
      break;
    case Regime::Rigid:
    case Regime::Dmt:
    case Regime::Hertz:
      choice.law = Law::Dmt;
      choice.reason =
          choice.tabor > 0.0
              ? text("Tabor parameter %.2g < %g: the contact is too stiff to be drawn out into a neck, so DMT",
                     choice.tabor, kDmtBelow)
              : "no modulus is given: the contact is rigid, so DMT";
      break;
  }
  return choice;
}

}  // namespace afm::physics
