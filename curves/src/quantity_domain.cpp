// SPDX-License-Identifier: Apache-2.0
#include "curves/quantity_domain.h"

#include <string>

namespace afm::curves {

std::string legal_values(const QuantityDomain& domain) {
  if (!domain.range) return physics::list_units(domain.units);
  auto [least, most] = physics::range_ends(domain.range->least, domain.range->most, domain.units, 4);
  // in one word, as typed: "5mm/s"
  std::erase(least, ' ');
  std::erase(most, ' ');
  return least + " to " + most;
}

std::string refusal(double si, std::string_view text, const QuantityDomain& domain) {
  if (!domain.range || (si >= domain.range->least && si <= domain.range->most)) return {};
  return std::string(text) + " is outside " + legal_values(domain);
}

std::variant<double, std::string> parse_si(std::string_view text, const QuantityDomain& domain) {
  auto parsed = physics::parse_si(text, domain.sort, domain.units, physics::Infinity::Refused);
  const double* si = std::get_if<double>(&parsed);
  if (si == nullptr) return parsed;
  if (std::string why = refusal(*si, text, domain); !why.empty()) return why;
  return parsed;
}

}  // namespace afm::curves
