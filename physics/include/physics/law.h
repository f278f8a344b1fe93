// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "physics/units.h"

namespace afm::physics {

struct ContactParameters;
struct ForceLaw;
struct LawOptions;

// The rate-independent force laws. All are two monotone branches with two folds (physics/law_tables.h) and differ only
// in these. The values are part of session files and shared blocks: a new law gets the next one (docs/adding-a-law.md).
enum class Law : std::uint32_t {
  Paper = 0,          // Liu & Peng's law: zero until Hao's fold, then the contact line -k' Z until F_ad
  Hao = 1,            // Liu & Peng's law with the van der Waals attraction before the fold
  Hertz = 2,          // elastic contact without adhesion
  Dmt = 3,            // van der Waals attraction, then Hertz with a constant adhesion (Derjaguin, Muller & Toporov)
  Jkr = 4,            // contact of Johnson, Kendall & Roberts, without attraction before it
  MaugisDugdale = 5,  // van der Waals attraction, then Maugis' contact with a cohesive zone
  LennardJones = 6,   // rigid sphere with the surface 3-9 potential (Bradley)
  Measured = 7,       // two recorded branches of an instrument
  Count               // number of laws
};

// The curve of a law without lever and support. Contracts are in physics/force_laws.h.
using LawCurve = ForceLaw(const ContactParameters& contact, const LawOptions& options);
LawCurve hao_law, hertz_law, dmt_law, jkr_law, maugis_law, lennard_jones_law;

// Radius of the contact under a force on the tip, zero without contact. May iterate.
using LawContactRadius = Length(const ContactParameters& contact, Force force);
LawContactRadius hertz_radius, dmt_radius, jkr_radius, maugis_radius;

// Unused: E* has no influence. Optional: an infinite one makes the contact a rigid wall. Needed: must be finite.
enum class ModulusUse { Unused, Optional, Needed };

// Properties of a law and the operations that it supports. Lists of laws, help texts, panels and checks are derived
// from them.
struct LawTraits {
  Law law;
  std::string_view name;  // name on command lines and in files
  bool van_der_waals;     // true: the law includes the Hamaker constant
  bool adhesion;          // true: the law includes the work of adhesion
  bool atomic_distance;   // true: the law includes z0
  ModulusUse modulus;
  bool dynamic;     // true: the force follows from the tip's height without a lever, so the law can move a mass
  bool computed;    // true: computed from ContactParameters, so available for --model; false: recorded by an instrument
  LawCurve* curve;  // curve of the law; null: closed form (computed), or recorded
  LawContactRadius* contact_radius;  // null: no contact area, so friction by area is not available
};

inline constexpr std::array kLawTable{
    LawTraits{.law = Law::Paper,
              .name = "paper",
              .van_der_waals = true,
              .adhesion = true,
              .atomic_distance = false,
              .modulus = ModulusUse::Unused,
              .dynamic = false,
              .computed = true,
              .curve = nullptr,
              .contact_radius = nullptr},
    LawTraits{.law = Law::Hao,
              .name = "hao",
              .van_der_waals = true,
              .adhesion = true,
              .atomic_distance = false,
              .modulus = ModulusUse::Unused,
              .dynamic = false,
              .computed = true,
              .curve = hao_law,
              .contact_radius = nullptr},
    LawTraits{.law = Law::Hertz,
              .name = "hertz",
              .van_der_waals = false,
              .adhesion = false,
              .atomic_distance = false,
              .modulus = ModulusUse::Needed,
              .dynamic = true,
              .computed = true,
              .curve = hertz_law,
              .contact_radius = hertz_radius},
    LawTraits{.law = Law::Dmt,
              .name = "dmt",
              .van_der_waals = true,
              .adhesion = true,
              .atomic_distance = false,
              .modulus = ModulusUse::Optional,
              .dynamic = true,
              .computed = true,
              .curve = dmt_law,
              .contact_radius = dmt_radius},
    LawTraits{.law = Law::Jkr,
              .name = "jkr",
              .van_der_waals = false,
              .adhesion = true,
              .atomic_distance = false,
              .modulus = ModulusUse::Needed,
              .dynamic = true,
              .computed = true,
              .curve = jkr_law,
              .contact_radius = jkr_radius},
    LawTraits{.law = Law::MaugisDugdale,
              .name = "maugis",
              .van_der_waals = true,
              .adhesion = true,
              .atomic_distance = true,
              .modulus = ModulusUse::Needed,
              .dynamic = true,
              .computed = true,
              .curve = maugis_law,
              .contact_radius = maugis_radius},
    LawTraits{.law = Law::LennardJones,
              .name = "lj",
              .van_der_waals = false,
              .adhesion = true,
              .atomic_distance = true,
              .modulus = ModulusUse::Unused,
              .dynamic = true,
              .computed = true,
              .curve = lennard_jones_law,
              .contact_radius = nullptr},
    LawTraits{.law = Law::Measured,
              .name = "measured",
              .van_der_waals = false,
              .adhesion = false,
              .atomic_distance = false,
              .modulus = ModulusUse::Unused,
              .dynamic = false,
              .computed = false,
              .curve = nullptr,
              .contact_radius = nullptr},
};
static_assert(kLawTable.size() == static_cast<std::size_t>(Law::Count),
              "every law of force needs one row in kLawTable");
static_assert(
    [] {
      for (std::size_t i = 0; i < kLawTable.size(); ++i) {
        if (kLawTable[i].law != static_cast<Law>(i)) return false;
      }
      return true;
    }(),
    "the rows of kLawTable stand in the order of the enum");

// Returns whether the number, read from a file or from another process, is a law.
constexpr bool is_known(Law law) { return law < Law::Count; }

// Throws std::out_of_range for an unknown law.
constexpr const LawTraits& traits_of(Law law) { return kLawTable.at(static_cast<std::size_t>(law)); }

constexpr bool has_dynamics(Law law) { return traits_of(law).dynamic; }

// Returns whether a tapping lever's swing can be averaged on the law: only on bodies that deform.
constexpr bool has_averaged_swings(Law law) {
  return has_dynamics(law) && traits_of(law).modulus != ModulusUse::Unused;
}

// The laws with a trait, in the order of the table: laws_with(&LawTraits::computed).
std::vector<Law> laws_with(bool LawTraits::* trait);

std::string_view name_of(Law law);  // name on command lines, "unknown" for an unknown law
std::optional<Law> law_of(std::string_view name);

// A liquid bridge in humid air, added to any law: 4 pi R gamma_L cos(theta) (Laplace pressure, sphere on plane).
struct Meniscus {
  SurfaceEnergy surface_tension{0.0728};  // gamma_L; default: water at 20 degrees Celsius
  double contact_angle_rad = 0.0;         // theta, between liquid and solid
  double relative_humidity = 0.5;         // 0 to 1; determines the height of the wetting films and the bridge's volume
};

// Options of a law that are not properties of the materials.
struct LawOptions {
  bool exact_hamaker_sphere = false;             // true: Hamaker's sphere instead of Derjaguin's approximation
  std::optional<Length> retardation_wavelength;  // lambda in Gregory's factor; empty: no retardation
  std::optional<Meniscus> meniscus;              // liquid bridge; empty: none
};

// Throws UnphysicalValue (physics/contact_parameters.h) unless the retardation wavelength is within 1 nm to 100 um, the
// surface tension within 0.1 mN/m to 10 N/m, the contact angle within 0 to below 90 degrees, and the relative humidity
// within 1 % to 99 %.
void validate(const LawOptions& options);

}  // namespace afm::physics
