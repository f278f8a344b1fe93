// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "physics/quantity_text.h"

namespace afm::curves {

// Range that includes both ends.
template <class Q>
struct QuantityRange {
  Q least, most;
};

// Units of one physical quantity, and its range of legal values in SI.
struct QuantityDomain {
  std::string_view sort;  // quantity as messages name it, "a length"
  std::span<const physics::Unit> units;
  std::optional<QuantityRange<double>> range{};
};

// Range as text, "100pm to 1mm", or the units if there is no range.
std::string legal_values(const QuantityDomain& domain);

// Reason why the value is not legal, in one line that quotes `text`; empty if it is.
std::string refusal(double si, std::string_view text, const QuantityDomain& domain);

// The value in SI, or the reason why it cannot be read or is not legal.
std::variant<double, std::string> parse_si(std::string_view text, const QuantityDomain& domain);

}  // namespace afm::curves
