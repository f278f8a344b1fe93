// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace afm::curves {

// Numbers of a vibrating lever, as typed; empty: not given.
struct TappingOptions {
  std::string free_amplitude{};  // free amplitude, required in tapping mode
  std::string amplitude{};       // constant amplitude, required in fm mode
  std::string drive{};           // drive frequency in tapping mode; empty: the resonance
  std::string viscosity{};       // viscosity of the contact; empty: none
  std::string method{};          // averaged or direct, in tapping mode; empty: by the quality factor
  std::string at{};              // single height in place of a path
};

}  // namespace afm::curves
