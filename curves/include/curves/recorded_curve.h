// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "physics/curve_analysis.h"
#include "physics/units.h"

namespace afm::curves {

// What a file says about how its curve was made; an empty text or optional is what it does not say.
struct CurveMetadata {
  std::optional<physics::Stiffness> spring_constant;
  std::optional<double> sensitivity_m_per_v;  // optical lever: deflection per volt ("InvOLS")
  std::optional<physics::Velocity> approach_speed;
  std::optional<physics::Velocity> retract_speed;
  std::optional<physics::Force> setpoint;
  std::string instrument;
  std::string software;
  std::string software_version;
  std::string date;      // YYYY-MM-DD
  std::string time;      // HH:MM:SS, local to the instrument
  std::string curve_id;  // identifies the curve
  // What a computed curve was made from, and whatever else a file of ours says: keys with their units, "tip_radius_m".
  std::vector<std::pair<std::string, std::string>> parameters;
};

// One approach-retract cycle as any file or model gave it, in one convention: SI, force positive away from the sample,
// height of the lever's base falling while the tip approaches (afmformats' "height (measured)"), all of the approach
// before all of the retract, every number finite, at most kMostCurvePoints.
struct RecordedCurve {
  std::vector<physics::CurvePoint> points;
  std::vector<double> time_s;  // each point's time since the first, or empty if unknown
  CurveMetadata metadata;
};

inline constexpr std::size_t kMostCurvePoints = 4'000'000;

// The software of curves that were computed, not measured.
inline constexpr const char* kComputedBy = "TouchAFM";

// A model's curve with the lever that it was made for.
RecordedCurve recorded_curve(const physics::ForceCurve& curve, physics::Stiffness spring_constant);

// Adds "key: value", made fit for one line of text; anything else, what is longer than 2000 characters or 32 KiB
// together with the others, and the 201st are passed over.
void add_parameter(std::string_view line, CurveMetadata& metadata);

// The value of a parameter that is a number.
std::optional<double> number_of(std::string_view value);

}  // namespace afm::curves
