// SPDX-License-Identifier: Apache-2.0
#include "exhibit/words/signed_text.h"

#include <fmt/format.h>

#include <cmath>

#include "curves/plot_units.h"

namespace afm::exhibit {

std::string signed_text(double value, int decimals, const char* unit) {
  const double tiny = 0.5 * std::pow(10.0, -decimals);
  const char* sign = value >= tiny ? "+" : value <= -tiny ? "\u2212" : "";
  return fmt::format("{}{:.{}f} {}", sign, std::abs(value), decimals, unit);
}

std::string force_text(double force_n) { return signed_text(force_n * curves::kNnPerN, 2, "nN"); }

}  // namespace afm::exhibit
