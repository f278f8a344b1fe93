// SPDX-License-Identifier: Apache-2.0
#include "app/options/quantity_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>
#include <variant>

namespace afm::app {

std::string type_word(std::string_view sort) {
  std::string word(sort.substr(sort.find(' ') + 1));
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char letter) { return letter == ' ' ? '-' : static_cast<char>(std::toupper(letter)); });
  return word;
}

Option si_option(OptionList& command, const std::string& name, std::function<void(double si)> store,
                 const QuantityDomain& domain, const std::string& description) {
  const auto read = [store = std::move(store), domain](const std::string& text) -> core::Result<void> {
    const auto parsed = curves::parse_si(text, domain);
    if (const auto* why = std::get_if<std::string>(&parsed)) return core::wrong_usage(*why);
    store(std::get<double>(parsed));
    return {};
  };
  return command.add_parsed_option(name, read, description)
      .type_name(
          fmt::format("{} {} {}", type_word(domain.sort), domain.range ? "from" : "in", curves::legal_values(domain)));
}

}  // namespace afm::app
