// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "physics/law.h"
#include "physics/rows_of_enum.h"
#include "physics/units.h"

// Friction of the tip. The load N is the force on the tip plus the pull-off force, which presses the two surfaces
// together; it is zero where contact is lost.
namespace afm::physics {

struct ContactParameters;

// The values are part of session files and shared blocks: a new law gets the next one (docs/adding-a-friction-law.md).
enum class FrictionLaw : std::uint32_t {
  None = 0,
  Amontons = 1,     // coefficient of friction times load: mu N
  ContactArea = 2,  // shear strength times the force law's contact area, tau A (Bowden & Tabor)
  Lattice = 3,      // Prandtl-Tomlinson: a spring that pulls the tip over the sample's atoms
};

struct FrictionLawText {
  FrictionLaw law;
  std::string_view word;     // value of --friction
  std::string_view meaning;  // text of the help
};

inline constexpr std::array kFrictionLaws{
    FrictionLawText{FrictionLaw::None, "none", "no force sideways"},
    FrictionLawText{FrictionLaw::Amontons, "amontons", "a share of the load"},
    FrictionLawText{FrictionLaw::ContactArea, "area", "a shear strength times the contact area"},
    FrictionLawText{FrictionLaw::Lattice, "lattice", "the tip sticks and slips from atom to atom"}};
static_assert(has_row_for_each(kFrictionLaws, &FrictionLawText::law));

constexpr const FrictionLawText& text_of(FrictionLaw law) { return kFrictionLaws.at(static_cast<std::size_t>(law)); }

// Arrangement of the lattice's wells. The values are part of session files and shared blocks.
enum class LatticeKind : std::uint32_t {
  Rows = 0,       // one period along x, constant along y
  Square = 1,     // equal periods along x and y: the ions of one kind of NaCl(100), turned by 45 degrees
  Hexagonal = 2,  // triangular lattice of wells: mica, graphite, gold(111)
};

struct LatticeKindText {
  LatticeKind kind;
  std::string_view word;  // word in material files
};

inline constexpr std::array kLatticeKinds{LatticeKindText{LatticeKind::Rows, "rows"},
                                          LatticeKindText{LatticeKind::Square, "square"},
                                          LatticeKindText{LatticeKind::Hexagonal, "hexagonal"}};
static_assert(has_row_for_each(kLatticeKinds, &LatticeKindText::kind));

// Parameters of one pair of surfaces. A parameter that a law does not use may be zero.
struct FrictionParameters {
  FrictionLaw law = FrictionLaw::None;
  LatticeKind lattice = LatticeKind::Hexagonal;
  double coefficient = 0.0;     // mu, coefficient of friction
  Pressure shear_strength;      // tau, shear strength of the contact
  Length period;                // a, distance from well to well along x
  Length corrugation;           // U/N, depth of the lattice's potential per load (physics/friction/lattice_tip.h)
  Stiffness lateral_stiffness;  // stiffness of lever, tip and contact in series
};

// Upper and lower limits of accepted values.
inline constexpr double kLargestFrictionCoefficient = 10.0;
inline constexpr Pressure kLargestShearStrength{1e11};
inline constexpr Length kSmallestPeriod{5e-11}, kLargestPeriod{5e-9};
inline constexpr Length kLargestCorrugation{1e-9};
inline constexpr Stiffness kSmallestLateralStiffness{1e-3}, kLargestLateralStiffness{1e5};

// Throws std::invalid_argument for an unknown law, and UnphysicalValue with the field friction_coefficient,
// shear_strength, lattice_period, lattice_corrugation or lateral_stiffness unless every parameter that the law needs is
// set and every parameter is within its range.
void validate(const FrictionParameters& friction);

// Returns whether the force law has a contact area, which FrictionLaw::ContactArea needs, in addition to a finite
// modulus.
constexpr bool has_contact_area(Law law) { return traits_of(law).contact_radius != nullptr; }

// pi a^2 at a force on the tip, from the force law; zero without contact. Throws std::invalid_argument for a law
// without a contact area or a rigid contact. May iterate, so never call it in a tick.
Area contact_area(Law law, const ContactParameters& contact, Force force);

}  // namespace afm::physics
