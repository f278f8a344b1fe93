// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/options/command_line.h"
#include "physics/quantity_text.h"

namespace afm::app {

// Both ends are legal.
template <class Q>
struct QuantityRange {
  Q least, most;
};

// Units of one sort, and the legal values among them, in SI.
struct QuantityDomain {
  std::string_view sort;  // "a length"
  std::span<const physics::Unit> units;
  std::optional<QuantityRange<double>> range{};
};

// The sort as the help names a value of it: "LENGTH".
std::string type_word(std::string_view sort);

// Use quantity_option.
Option si_option(OptionList& command, const std::string& name, std::function<void(double si)> store,
                 const QuantityDomain& domain, const std::string& description);

// An option whose value is a number with its unit. Help and refusal give the range if there is one, else the units.
template <class Q, class Store>
Option quantity_option(OptionList& command, const std::string& name, Store store, const physics::UnitList<Q>& units,
                       const std::string& description, std::optional<QuantityRange<Q>> range = std::nullopt) {
  QuantityDomain domain{units.sort, units.units};
  if (range) domain.range = {range->least.si, range->most.si};
  return si_option(command, name, [store](double si) { store(Q(si)); }, domain, description);
}

}  // namespace afm::app
