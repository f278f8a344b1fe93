// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/options/command.h"
#include "core/result.h"
#include "curves/curve_run.h"
#include "curves/tapping/driven_setup.h"

namespace afm::app {

void add_tapping_options(OptionList& command, curves::TappingChoice& choice);

// Options for images: --mode contact or tapping, and the options of the drive and the contact.
void add_tapped_scan_options(OptionList& command, curves::TappingChoice& choice);

// Options for the live window: --mode contact or tapping, and the options of lever, drive and contact. The second
// function checks them; `alone`: without particles, a force map, friction and other machines, which tapping excludes.
void add_tapped_view_options(OptionList& command, curves::TappedHand& hand);
core::Result<void> check_tapped_view(const curves::TappedHand& hand, bool alone);

// Options for the demonstration: as for the live window, without --model, which it has anyway.
void add_tapped_demo_options(OptionList& command, curves::TappedHand& hand);

// WrongUsage, naming the option, if one has no effect in the chosen mode.
core::Result<void> check_tapping_options(const curves::TappingChoice& choice);

// The curve of a vibrating lever as csv, json or svg. `choice.mode` is tapping or fm.
core::Result<std::string> tapping_text(const curves::TappingChoice& choice, const curves::ContactOptions& contact,
                                       const curves::PathOptions& path, const std::string& format);

// Same for the map of regimes over the axes of --sweep.
core::Result<std::string> tapping_sweep_text(const curves::TappingChoice& choice, const curves::ContactOptions& contact,
                                             const std::vector<std::string>& sweeps, const std::string& format);

}  // namespace afm::app
