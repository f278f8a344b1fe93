// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "exhibit/sound/tip_ear.h"
#include "exhibit/words/phrases.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// Magnitudes with two significant digits, as words and for the wall: "0.24 nanonewtons", "100 nanometres"; "0.24 nN".
// More digits would exceed the precision of an experiment.
std::string spoken_force(const Phrases& phrases, double force_n);
std::string spoken_length(const Phrases& phrases, double length_m);
std::string shown_force(const Phrases& phrases, double force_n);

// An event's caption for the wall, and its spoken text. `sample`: title of the material under the tip, in the phrases'
// language.
std::string caption_of(const Phrases& phrases, const Heard& heard, const std::string& sample);
std::string said_of(const Phrases& phrases, const Heard& heard, const std::string& sample);

// Speech for the key Y: sample, state of the servo, force and height if there is a force, and the next step.
std::string said_of_state(const Phrases& phrases, const scene::TipState& tip, const std::string& sample,
                          const std::string& guidance);

}  // namespace afm::exhibit
