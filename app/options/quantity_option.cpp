// SPDX-License-Identifier: Apache-2.0
#include "app/options/quantity_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>
#include <variant>

namespace afm::app {

namespace {

// "5mm/s": as typed, in one word.
std::string typed(double si, const QuantityDomain& domain) {
  std::string text = physics::format_si(si, domain.units, 4);
  std::erase(text, ' ');
  return text;
}

std::string legal_values(const QuantityDomain& domain) {
  if (domain.range)
    return fmt::format("{} to {}", typed(domain.range->least, domain), typed(domain.range->most, domain));
  std::string units;
  for (const physics::Unit& unit : domain.units) {
    if (unit.shown) units += (units.empty() ? "" : ", ") + std::string(unit.symbol);
  }
  return units;
}

core::Result<double> read_si(const std::string& text, const QuantityDomain& domain) {
  const auto refused = [](std::string why) { return core::failure(core::ErrorCategory::WrongUsage, std::move(why)); };
  const auto parsed = physics::parse_si(text, domain.sort, domain.units, physics::Infinity::Refused);
  if (const auto* error = std::get_if<std::string>(&parsed)) return refused(*error);
  const double si = std::get<double>(parsed);
  if (domain.range && !(si >= domain.range->least && si <= domain.range->most)) {
    return refused(fmt::format("{} is outside {}", text, legal_values(domain)));
  }
  return si;
}

}  // namespace

std::string type_word(std::string_view sort) {
  std::string word(sort.substr(sort.find(' ') + 1));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char letter) { return letter == ' ' ? '-' : static_cast<char>(std::toupper(letter)); });
  return word;
}

Option si_option(OptionList& command, const std::string& name, std::function<void(double si)> store,
                 const QuantityDomain& domain, const std::string& description) {
  const auto read = [store = std::move(store), domain](const std::string& text) -> core::Result<void> {
    const auto si = read_si(text, domain);
    if (!si) return tl::unexpected(si.error());
    store(*si);
    return {};
  };
  return command.add_parsed_option(name, read, description)
      .type_name(fmt::format("{} {} {}", type_word(domain.sort), domain.range ? "from" : "in", legal_values(domain)));
}

}  // namespace afm::app
