// SPDX-License-Identifier: Apache-2.0
// Every panel of the wall with its largest possible contents.
#pragma once

#include <vector>

#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/lesson/lesson_panel.h"
#include "exhibit/scan/live_scan.h"
#include "physics/friction/friction.h"
#include "render/frame.h"

namespace afm::exhibit {

// `banner` with the longest texts of the live window.
render::Banner full_banner(const Phrases& phrases, render::Banner banner);
render::ControlPanel full_parameters(const Stage& stage);
// A scan with every colour, the truth, and a wide range of numbers.
LiveScan full_scan(const Stage& stage);
LiveScan full_tapped_scan(const Stage& stage);
// Three loops back and forth, the last one open, with the longest numbers.
render::ForcePanel full_friction_loop(physics::FrictionLaw law, const Phrases& phrases);
// Dial of a lever in tapping mode, with both states.
render::ForcePanel full_dial(const Phrases& phrases);
// Panels of either built-in set, with a softened lever.
std::vector<render::DataPanel> full_particles(const Phrases& phrases);
// Prompts of a lesson with the most words and the most answers.
std::vector<LessonPrompt> full_prompts(const Phrases& phrases);

}  // namespace afm::exhibit
