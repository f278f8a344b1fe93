// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "physics/law.h"
#include "physics/rows_of_enum.h"
#include "physics/units.h"

// What holds a tip back sideways. The load N is the force on the tip and the pull-off force together: what presses the
// two surfaces upon each other, zero where contact is lost.
namespace afm::physics {

struct ContactParameters;

// The values are part of session files and shared blocks: a new law takes the next one (docs/adding-a-friction-law.md).
enum class FrictionLaw : std::uint32_t {
  None = 0,
  Amontons = 1,     // mu N
  ContactArea = 2,  // tau A, A the contact area of the law of force (Bowden & Tabor)
  Lattice = 3,      // Prandtl-Tomlinson: a spring that pulls the tip over the sample's atoms
};

struct FrictionLawText {
  FrictionLaw law;
  std::string_view word;     // after --friction
  std::string_view meaning;  // in the help
};

inline constexpr std::array kFrictionLaws{
    FrictionLawText{FrictionLaw::None, "none", "no force sideways"},
    FrictionLawText{FrictionLaw::Amontons, "amontons", "a share of the load"},
    FrictionLawText{FrictionLaw::ContactArea, "area", "a shear strength times the contact area"},
    FrictionLawText{FrictionLaw::Lattice, "lattice", "the tip sticks and slips from atom to atom"}};
static_assert(has_row_for_each(kFrictionLaws, &FrictionLawText::law));

constexpr const FrictionLawText& text_of(FrictionLaw law) { return kFrictionLaws.at(static_cast<std::size_t>(law)); }

// How the wells lie in which the tip rests. The values are part of session files and shared blocks.
enum class LatticeKind : std::uint32_t {
  Rows = 0,       // one period along x, nothing along y
  Square = 1,     // one period along x and along y: the ions of one kind of NaCl(100), turned by 45 degrees
  Hexagonal = 2,  // mica, graphite, gold(111)
};

struct LatticeKindText {
  LatticeKind kind;
  std::string_view word;  // in material files
};

inline constexpr std::array kLatticeKinds{LatticeKindText{LatticeKind::Rows, "rows"},
                                          LatticeKindText{LatticeKind::Square, "square"},
                                          LatticeKindText{LatticeKind::Hexagonal, "hexagonal"}};
static_assert(has_row_for_each(kLatticeKinds, &LatticeKindText::kind));

std::optional<LatticeKind> lattice_kind_of(std::string_view word);

// The numbers of one pair of surfaces. A number that a law does not use may be zero.
struct FrictionParameters {
  FrictionLaw law = FrictionLaw::None;
  LatticeKind lattice = LatticeKind::Hexagonal;
  double coefficient = 0.0;     // mu
  Pressure shear_strength;      // tau
  Length period;                // a, from well to well along x
  Length corrugation;           // of the lattice's potential: its U is this times N (physics/friction/lattice_tip.h)
  Stiffness lateral_stiffness;  // of lever, tip and contact in series
};

// The largest numbers that are believed, and the least above zero.
inline constexpr double kLargestFrictionCoefficient = 10.0;
inline constexpr Pressure kLargestShearStrength{1e11};
inline constexpr Length kSmallestPeriod{5e-11}, kLargestPeriod{5e-9};
inline constexpr Length kLargestCorrugation{1e-9};
inline constexpr Stiffness kSmallestLateralStiffness{1e-3}, kLargestLateralStiffness{1e5};

// Throws std::invalid_argument for an unknown law, and UnphysicalValue, whose field is friction_coefficient,
// shear_strength, lattice_period, lattice_corrugation or lateral_stiffness, unless what the law needs is there and
// every number is within its range.
void validate(const FrictionParameters& friction);

// Whether the law of force has a contact area, which FrictionLaw::ContactArea needs; its modulus must be finite as
// well.
constexpr bool has_contact_area(Law law) { return traits_of(law).contact_radius != nullptr; }

// pi a^2 at a force on the tip, by the law of force; zero without contact. Throws std::invalid_argument for a law
// without a contact area or a rigid contact. May search: not for a tick.
Area contact_area(Law law, const ContactParameters& contact, Force force);

// 8 G* a: what a contact of the radius a is to a tangential force before it slides, in series with the lever (Mindlin
// 1949; Carpick, Ogletree & Salmeron 1997). 1/G* = (2 - nu_t)/G_t + (2 - nu_s)/G_s.
Stiffness tangential_contact_stiffness(Pressure reduced_shear_modulus, Length contact_radius);
Pressure reduced_shear_modulus(Pressure tip_shear_modulus, double tip_poisson_ratio, Pressure sample_shear_modulus,
                               double sample_poisson_ratio);

// Of two springs behind each other.
constexpr Stiffness in_series(Stiffness a, Stiffness b) { return Stiffness(a.si * b.si / (a.si + b.si)); }

}  // namespace afm::physics
