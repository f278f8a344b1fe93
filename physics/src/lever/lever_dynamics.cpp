// SPDX-License-Identifier: Apache-2.0
#include "physics/lever_dynamics.h"

#include <array>
#include <charconv>
#include <string>

#include "physics/quantity_text.h"
#include "require_range.h"

namespace afm::physics {

void validate(const LeverDynamics& lever) {
  using namespace literals;
  require_range("resonance", lever.resonance, 1_Hz, 1e5_kHz, kFrequencyUnits);
  // written so that NaN fails
  if (!(lever.quality_factor >= 0.01 && lever.quality_factor <= 1e7)) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), lever.quality_factor,
                                   std::chars_format::general, 5);
    throw UnphysicalValue("quality_factor",
                          "quality factor " + std::string(digits.data(), end.ptr) + " is not within 0.01 to 1e7");
  }
  require_range("temperature", lever.temperature, 0_K, 2000_K, kTemperatureUnits);
}

}  // namespace afm::physics
