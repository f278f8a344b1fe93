// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "physics/quantity_text.h"

// Parsing of KEY=VALUE, once for each key, as of --uncertainty.
namespace afm::curves {

inline constexpr double kMostUncertainty = 0.5;  // largest relative uncertainty to the first order

struct UncertainKey {
  std::string_view name;
  std::span<const physics::Unit> units;  // accepted units, in addition to per cent
};

// Positive standard uncertainty: a share of up to kMostUncertainty, or in SI.
struct KeyUncertainty {
  std::size_t key;  // place in the caller's list
  double value;
  bool is_share;
};

// WrongUsage for an unknown key, a key that is given twice, or a value that is out of its range or has no unit.
core::Result<std::vector<KeyUncertainty>> parse_uncertainties(const std::vector<std::string>& texts,
                                                              std::span<const UncertainKey> keys);

}  // namespace afm::curves
