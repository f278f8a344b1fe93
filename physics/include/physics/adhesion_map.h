// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "physics/contact_parameters.h"
#include "physics/law.h"

namespace afm::physics {

// The regimes of Johnson & Greenwood 1997.
enum class Regime { Rigid, Hertz, Dmt, Maugis, Jkr };

// "rigid", "hertz", "dmt", "maugis", "jkr".
std::string_view name_of(Regime regime);

// mu = (R W^2/(E*^2 z0^3))^(1/3) (Tabor 1977); 0 for a rigid contact.
double tabor_parameter(const ContactParameters& contact);

// lambda = 2 sigma0 (R/(pi W K^2))^(1/3) with sigma0 the peak of the Lennard-Jones traction, 16 W/(9 sqrt3 z0), and
// K = 4 E*/3: 1.1570 mu (Maugis 1992).
double maugis_parameter(const ContactParameters& contact);

// The regime at a Tabor parameter and a load in units of pi W R, in which DMT pulls off at -2 and JKR at -1.5. Borders
// of Johnson & Greenwood: Hertz if adhesion adds less than 5 % to the load; Rigid if the contact flattens by less than
// 5 % of the range of the attraction; otherwise DMT below a Tabor parameter of 0.1, JKR above 5, and Maugis in between.
Regime regime_of(double tabor, double load);

// Position of a contact on the adhesion map, and the law that suits it.
struct LawChoice {
  Law law = Law::Dmt;
  Regime regime = Regime::Dmt;
  double tabor = 0.0;
  double maugis = 0.0;
  std::string reason;  // reason in one sentence for users, with the numbers
};

// Chooses by the regime at zero load, where only adhesion presses the bodies together: JKR for JKR, Maugis-Dugdale for
// Maugis, and DMT for the stiffer ones, including Rigid, whose pull-off is the same. (At zero load the regime is never
// Hertz, so that no contact loses its adhesion.) Throws as validate() does.
LawChoice choose_law(const ContactParameters& contact);

}  // namespace afm::physics
