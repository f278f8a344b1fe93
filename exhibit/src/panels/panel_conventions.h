// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "exhibit/words/phrases.h"

namespace afm::exhibit {

// Ranges of the force axis above and below zero in all panels, in units of the greatest force in either direction.
inline constexpr double kForceAbove = 0.52, kForceBelow = 1.22;
inline constexpr int kDigits = 3;            // significant digits of a value
inline constexpr double kFreeSwing = 0.002;  // largest fraction of the amplitude lost by a swing that counts as free

// Force law in the wall's language; `name` comes from curves::law_name().
inline std::string law_word(const std::string& name, const Phrases& phrases) {
  constexpr std::string_view kDynamic = "dynamic-";
  if (!name.starts_with(kDynamic)) return phrases.word(name);
  const std::string dynamic = phrases.word("dynamic");
  return dynamic + (dynamic == "dynamic" ? "-" : " ") + phrases.word(name.substr(kDynamic.size()));
}

}  // namespace afm::exhibit
