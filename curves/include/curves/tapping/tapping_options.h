// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace afm::curves {

// Numbers of a vibrating lever, as typed; empty: not given.
struct TappingOptions {
  std::string free_amplitude{};  // tapping: needed
  std::string amplitude{};       // fm: needed
  std::string drive{};           // tapping; empty: at the resonance
  std::string viscosity{};       // viscosity of the contact; empty: none
  std::string method{};          // tapping: averaged or direct; empty: by the quality factor
  std::string at{};              // a single height instead of a path
};

}  // namespace afm::curves
