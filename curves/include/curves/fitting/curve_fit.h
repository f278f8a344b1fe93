// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "curves/curve_report.h"
#include "curves/quantity_domain.h"
#include "fits/elastic_fit.h"

namespace afm::curves {

inline constexpr std::size_t kBootstraps = 200;

// Options of a fit; sizes of zero: not given.
struct FitOptions {
  std::optional<fits::Shape> shape;  // shape of the indenter; empty: no fit is requested
  double radius_m = 0;
  double half_angle_rad = 0;
  double layer_m = 0;
  double poisson = 0.5;
  std::optional<double> atomic_distance_m;  // atomic distance; empty: default of fits::Indenter
  fits::Base base = fits::Base::Bonded;
  fits::Against against = fits::Against::Z;
  double most_force_n = std::numeric_limits<double>::infinity();
  double most_depth_m = std::numeric_limits<double>::infinity();
  bool tilt = false;
  bool white = false;
  bool bootstrap = false;                           // true: adds an interval by kBootstraps fits to resampled residuals
  std::vector<std::string> uncertainty_texts;       // uncertainties as typed: "radius=5%"
  std::vector<fits::Uncertainty> uncertainties{};   // uncertainties set by prepare() from the texts
  std::shared_ptr<const fits::LayerTable> table{};  // table for an exact layer, set by prepare()
};

// A number that a user gives to a fit.
struct FitNumber {
  std::string_view name;  // option on the command line, without dashes
  QuantityDomain domain;
  std::string_view help;
  void (*set)(FitOptions& options, double si);
};
std::span<const FitNumber> fit_numbers();

// Computes the table of an exact layer and reads the uncertainties. WrongUsage if one of these cannot be read, and if
// the shape lacks a size, or has one that it does not need.
core::Result<void> prepare(FitOptions& options);

// Fits the approach of a curve, or both branches to a law of adhesion. `options` is prepared and asks for a fit.
// BadInputFile, naming the curve, if it has no spring constant or nothing fits.
core::Result<fits::ElasticFit> fit_of(const AnalysedCurve& curve, const FitOptions& options);

// Lines for the report, the same in SI, and the model for the plot.
std::string fit_text(const fits::ElasticFit& fit, const FitOptions& options);
nlohmann::ordered_json fit_json(const fits::ElasticFit& fit, const FitOptions& options);
SvgLine fit_line(const AnalysedCurve& curve, const fits::ElasticFit& fit, const FitOptions& options);

// A doubt with its figure and limit, and which law to try.
std::string doubt_text(const fits::Found& found);

}  // namespace afm::curves
