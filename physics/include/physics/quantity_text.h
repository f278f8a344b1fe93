// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "physics/units.h"

// Quantities as typed by people, "50nm" or "24.5 zJ", and as printed, "13.999 nm". Independent of the locale.
namespace afm::physics {

struct Unit {
  std::string_view symbol;
  double per_si;         // units per SI unit; a power of ten, except for eV: 1e9 for nm, 1e-9 for GPa
  bool shown;            // true: used in messages and output; false: an alternative spelling, only accepted as input
  double zero_si = 0.0;  // SI value of zero: 273.15 for degrees Celsius
};

// The units of one physical quantity, the largest first. Stiffness and surface energy are one type but two lists, so
// that a spring constant in mJ/m2 is rejected.
struct Units {
  std::string_view sort;  // quantity as messages name it: "a length"
  std::span<const Unit> units;
};

// Units with the quantity as a compile-time type.
template <class Q>
struct UnitList : Units {};

extern const UnitList<Length> kLengthUnits;                // units m mm um nm pm
extern const UnitList<Force> kForceUnits;                  // units N mN uN nN pN
extern const UnitList<Energy> kEnergyUnits;                // units J aJ zJ
extern const UnitList<Stiffness> kStiffnessUnits;          // units N/m mN/m
extern const UnitList<Velocity> kVelocityUnits;            // units m/s mm/s um/s
extern const UnitList<SurfaceEnergy> kSurfaceEnergyUnits;  // units J/m2 mJ/m2, also mN/m
extern const UnitList<Pressure> kPressureUnits;            // units TPa GPa MPa kPa Pa
extern const Units kPlainNumber;                           // dimensionless
extern const UnitList<Time> kTimeUnits;                    // units s ms us
extern const UnitList<Frequency> kFrequencyUnits;          // units MHz kHz Hz
extern const UnitList<Temperature> kTemperatureUnits;      // unit K
extern const UnitList<Density> kDensityUnits;              // unit kg/m3

enum class Infinity { Refused, Allowed };

template <class Q>
struct ParsedQuantity {
  std::optional<Q> value;
  std::string error;  // error in one line with the legal units; empty if there is a value
};

// List of the units shown in messages: "m, mm, um, nm, pm".
std::string list_units(std::span<const Unit> units);

// Reads a value in SI, or an error. Implementation of parse_quantity.
std::variant<double, std::string> parse_si(std::string_view text, std::string_view sort, std::span<const Unit> units,
                                           Infinity infinity);

// Reads a decimal number and a unit, with or without blanks, also no-break ones, around them. Rejects, with a message:
// a bare number, another dimension's unit, a number beyond double, NaN, and, unless allowed, "inf" (which needs its
// unit too).
template <class Q>
ParsedQuantity<Q> parse_quantity(std::string_view text, const UnitList<Q>& list,
                                 Infinity infinity = Infinity::Refused) {
  const auto parsed = parse_si(text, list.sort, list.units, infinity);
  if (const double* si = std::get_if<double>(&parsed)) return {Q(*si), {}};
  return {std::nullopt, std::get<std::string>(parsed)};
}

// Significant digits of a value for people.
inline constexpr int kUsualDigits = 5;

// Implementation of format_quantity.
std::string format_si(double si, std::span<const Unit> units, int digits = kUsualDigits);

// Both ends of a range in SI as text. An end of zero is in the unit of the other end: "0 nm" and "100 nm".
std::array<std::string, 2> range_ends(double smallest, double largest, std::span<const Unit> units,
                                      int digits = kUsualDigits);

// Range in SI as text: "100 pm to 1 mm".
std::string range_text(double smallest, double largest, const Units& units);

// Formats with `digits` significant digits (1 to 17), in the unit that leaves 1 to 1000 before the point if there is
// one.
template <class Q>
std::string format_quantity(Q value, const UnitList<Q>& list, int digits = kUsualDigits) {
  return format_si(value.si, list.units, digits);
}

}  // namespace afm::physics
