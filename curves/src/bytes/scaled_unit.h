// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace afm::curves {

// A unit without its prefix: "nm" becomes 1e-9 and "m". An unknown unit has the factor 1 and stays unchanged.
struct ScaledUnit {
  double factor = 1.0;
  std::string unit;
};
ScaledUnit scaled_unit(std::string_view text);

}  // namespace afm::curves
