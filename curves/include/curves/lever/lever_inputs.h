// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string_view>

#include "core/enumerators.h"
#include "curves/angle_units.h"
#include "curves/quantity_domain.h"
#include "curves/viscosity_units.h"
#include "physics/quantity_text.h"

// Numbers from which a spring constant is calibrated. Each is an option of `touchafm lever` and may have an
// uncertainty.
namespace afm::curves {

enum class LeverInput : std::size_t {
  Sensitivity,
  ContactStiffness,
  Temperature,
  ModeFactor,
  SpringConstant,
  Length,
  Width,
  Resonance,
  QualityFactor,
  Density,
  Viscosity,
  GciCoefficient,
  Tilt,
  Area,
};

// Values in SI; empty: not given.
class LeverInputs {
 public:
  std::optional<double>& operator[](LeverInput input) { return values_[static_cast<std::size_t>(input)]; }
  const std::optional<double>& operator[](LeverInput input) const { return values_[static_cast<std::size_t>(input)]; }

 private:
  std::array<std::optional<double>, static_cast<std::size_t>(LeverInput::Area) + 1> values_{};
};

namespace lever_units {

inline constexpr std::array kSensitivities{
    physics::Unit{"um/V", 1e6, true}, physics::Unit{"\u00b5m/V", 1e6, false}, physics::Unit{"\u03bcm/V", 1e6, false},
    physics::Unit{"nm/V", 1e9, true}, physics::Unit{"pm/V", 1e12, true},      physics::Unit{"mm/V", 1e3, false},
    physics::Unit{"m/V", 1.0, false}};
// 1000^1.3: coefficients are usual for frequencies in kilohertz, too
inline constexpr std::array kGciCoefficients{physics::Unit{"N/m/kHz^1.3", 7943.282347242815, true},
                                             physics::Unit{"N/m/Hz^1.3", 1.0, true}};

}  // namespace lever_units

struct LeverInputRow {
  LeverInput input;
  std::string_view name;  // name of the option without its dashes, also in --uncertainty
  physics::Units units;
  QuantityRange<double> range;
  std::string_view of;    // option that the input needs, or empty
  std::string_view help;  // description for help; empty: no option, because the spectrum determines the value
};

inline const std::array kLeverInputs{
    LeverInputRow{LeverInput::Sensitivity,
                  "sensitivity",
                  {"a sensitivity", lever_units::kSensitivities},
                  {1e-12, 1e-3},
                  "",
                  "sensitivity of the optical lever, measured on a hard sample"},
    LeverInputRow{LeverInput::ContactStiffness,
                  "contact-stiffness",
                  physics::kStiffnessUnits,
                  {1e-6, 1e9},
                  "",
                  "stiffness of the contact with which the sensitivity was measured; default: rigid"},
    LeverInputRow{LeverInput::Temperature,
                  "temperature",
                  physics::kTemperatureUnits,
                  {200.0, 600.0},
                  "",
                  "temperature of the lever, also in C; default: 298.15 K"},
    LeverInputRow{LeverInput::ModeFactor,
                  "mode-factor",
                  physics::kPlainNumber,
                  {1e-3, 2.0},
                  "--thermal",
                  "share of k_B T/k that the optical lever sees in the mode; default: that of a "
                  "rectangular lever, 0.8174 in mode 1; a V-shaped one needs its own"},
    LeverInputRow{LeverInput::SpringConstant,
                  "spring-constant",
                  physics::kStiffnessUnits,
                  {1e-6, 1e6},
                  "",
                  "known spring constant, for the sensitivity by --thermal, or for --contact-stiffness"},
    LeverInputRow{LeverInput::Length, "length", physics::kLengthUnits, {1e-6, 1e-2}, "--sader", "length of the lever"},
    LeverInputRow{LeverInput::Width, "width", physics::kLengthUnits, {1e-7, 1e-2}, "--sader", "width of the lever"},
    LeverInputRow{LeverInput::Resonance,
                  "resonance",
                  physics::kFrequencyUnits,
                  {1.0, 1e8},
                  "",
                  "with --sader and --gci: resonance in the fluid; default: that of --thermal"},
    LeverInputRow{LeverInput::QualityFactor,
                  "quality-factor",
                  physics::kPlainNumber,
                  {0.1, 1e7},
                  "",
                  "with --sader and --gci: quality factor in the fluid; default: that of --thermal"},
    LeverInputRow{LeverInput::Density,
                  "density",
                  physics::kDensityUnits,
                  {1e-3, 3e4},
                  "--sader",
                  "density of the fluid instead of --fluid's"},
    LeverInputRow{LeverInput::Viscosity,
                  "viscosity",
                  {"a viscosity", kViscosityUnits},
                  {1e-7, 1e3},
                  "--sader",
                  "viscosity of the fluid instead of --fluid's"},
    LeverInputRow{LeverInput::GciCoefficient,
                  "gci",
                  {"a GCI coefficient", lever_units::kGciCoefficients},
                  {1e-14, 1e-2},
                  "",
                  "coefficient A of the lever's type in k = A Q f^1.3 (Global Calibration Initiative)"},
    LeverInputRow{LeverInput::Tilt,
                  "tilt",
                  kAngleUnits,
                  {0.0, 80.0 * std::numbers::pi / 180.0},
                  "",
                  "angle between lever and sample: also print k/cos^2, for forces along the sample's normal"},
    LeverInputRow{LeverInput::Area, "area", physics::kPlainNumber, {}, "", ""}};
static_assert(kLeverInputs.size() == core::kEnumerators<LeverInput>.size());

// Row of an input; the table has the order of the enum.
inline const LeverInputRow& row_of(LeverInput input) { return kLeverInputs[static_cast<std::size_t>(input)]; }

}  // namespace afm::curves
