// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "app/options/command_line.h"
#include "curves/quantity_domain.h"
#include "physics/quantity_text.h"

namespace afm::app {

using curves::QuantityDomain;
using curves::QuantityRange;

// Placeholder for a value of this sort in the help: "LENGTH".
std::string type_word(std::string_view sort);

// Implementation of quantity_option.
Option si_option(OptionList& command, const std::string& name, std::function<void(double si)> store,
                 const QuantityDomain& domain, const std::string& description);

// Adds an option whose value is a number with a unit. Help and error show the range if there is one, otherwise the
// units.
template <class Q, class Store>
Option quantity_option(OptionList& command, const std::string& name, const Store& store,
                       const physics::UnitList<Q>& units, const std::string& description,
                       std::optional<QuantityRange<Q>> range = std::nullopt) {
  QuantityDomain domain{units.sort, units.units};
  if (range) domain.range = {range->least.si, range->most.si};
  return si_option(command, name, [store](double si) { store(Q(si)); }, domain, description);
}

}  // namespace afm::app
