// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/options/contact_options.h"
#include "core/result.h"
#include "curves/curve_run.h"
#include "curves/tapping/tapping_run.h"

namespace afm::app {

// Options of `touchafm curve` for a vibrating lever, as typed; empty text: not given.
struct TappingChoice {
  std::string mode = "contact";
  curves::TappingOptions numbers;
  std::string contact_gap;  // instead of the work of adhesion
};

void add_tapping_options(OptionList& command, TappingChoice& choice);

// WrongUsage, naming the option, for one that has no effect in the chosen mode.
core::Result<void> check_tapping_options(const TappingChoice& choice);

// The curve of a vibrating lever as csv, json or svg. `choice.mode` is tapping or fm.
core::Result<std::string> tapping_text(const TappingChoice& choice, const ContactOptions& contact,
                                       const curves::PathOptions& path, const std::string& format);

}  // namespace afm::app
