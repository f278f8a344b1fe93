// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>

#include "curves/tapping/tapping_options.h"

namespace afm::curves {

// A vibrating lever as a user describes it; empty text: not given.
struct TappingChoice {
  std::string mode = "contact";  // mode of the lever: contact, tapping or fm
  TappingOptions numbers{};
  std::string contact_gap{};  // contact gap a0 that determines the work of adhesion
};

// A lever that taps under a hand, on samples of the wall.
struct TappedHand {
  TappingChoice choice{};
  std::string model = "auto";
  std::string felt = "push";                                 // felt force: "push" or "mean"
  std::map<std::string, std::string, std::less<>> values{};  // values as typed, by the option of contact_parameters()
};

}  // namespace afm::curves
