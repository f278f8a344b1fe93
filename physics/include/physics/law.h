// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "physics/units.h"

namespace afm::physics {

// The rate-independent laws of force. All of them are two monotone branches and two folds (physics/law_tables.h) and
// differ in nothing else. The values are part of session files and shared blocks.
enum class Law : std::uint32_t {
  Paper = 0,          // Liu & Peng: nothing until Hao's fold, then the contact line -k' Z until F_ad
  Hao = 1,            // the same with the van der Waals attraction before the fold
  Hertz = 2,          // elastic contact without adhesion
  Dmt = 3,            // van der Waals, then Hertz with a constant adhesion (Derjaguin, Muller & Toporov)
  Jkr = 4,            // Johnson, Kendall & Roberts
  MaugisDugdale = 5,  // van der Waals, then Maugis' contact with a cohesive zone
  LennardJones = 6,   // rigid sphere, surface 3-9 potential (Bradley)
  Measured = 7,       // two branches that an instrument recorded
};

// "paper", "hao", "hertz", "dmt", "jkr", "maugis", "lj", "measured": what command lines and files call them.
std::string_view name_of(Law law);
std::optional<Law> law_of(std::string_view name);

// A liquid bridge in humid air, on top of any law: 4 pi R gamma_L cos(theta) (Laplace pressure, sphere on plane).
struct Meniscus {
  SurfaceEnergy surface_tension{0.0728};  // gamma_L; water at 20 degrees Celsius
  double contact_angle_rad = 0.0;         // theta
  double relative_humidity = 0.5;         // 0 to 1; sets the height of the wetting films and the bridge's volume
};

// What changes a law without being a property of the materials.
struct LawOptions {
  bool exact_hamaker_sphere = false;             // Hamaker's sphere instead of Derjaguin's approximation of it
  std::optional<Length> retardation_wavelength;  // lambda of Gregory's factor; none: not retarded
  std::optional<Meniscus> meniscus;              // none: no liquid bridge
};

// Throws UnphysicalValue (physics/contact_parameters.h) unless: retardation wavelength 1 nm to 100 um, surface tension
// 0.1 mN/m to 10 N/m, contact angle 0 to below 90 degrees, relative humidity 1 % to 99 %.
void validate(const LawOptions& options);

}  // namespace afm::physics
