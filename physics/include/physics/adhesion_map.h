// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "physics/interaction.h"
#include "physics/law.h"

namespace afm::physics {

// The regimes of Johnson & Greenwood 1997.
enum class Regime { Rigid, Hertz, Dmt, Maugis, Jkr };

// "rigid", "hertz", "dmt", "maugis", "jkr".
std::string_view name_of(Regime regime);

// mu = (R W^2/(E*^2 z0^3))^(1/3) (Tabor 1977); 0 for a rigid contact.
double tabor_parameter(const Interaction& interaction);

// lambda = 2 sigma0 (R/(pi W K^2))^(1/3) with sigma0 the peak of the Lennard-Jones traction, 16 W/(9 sqrt3 z0), and
// K = 4 E*/3: 1.1570 mu (Maugis 1992).
double maugis_parameter(const Interaction& interaction);

// Where a contact lies on the adhesion map, and the law that suits it.
struct LawChoice {
  Law law = Law::Dmt;
  Regime regime = Regime::Dmt;
  double tabor = 0.0;
  double maugis = 0.0;
  std::string reason;  // one sentence for people, with the numbers
};

// By the Tabor parameter: DMT for a stiff contact, Maugis-Dugdale between, JKR for a soft one; thresholds and sources
// stand in the definition. Throws as validate() does.
LawChoice choose_law(const Interaction& interaction);

}  // namespace afm::physics
