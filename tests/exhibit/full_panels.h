// SPDX-License-Identifier: Apache-2.0
// Every panel of the wall with as much on it as it ever holds.
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
// With every colour, the truth, and a wide range of numbers.
LiveScan full_scan(const Stage& stage);
LiveScan full_tapped_scan(const Stage& stage);
// Three loops there and back, the last one open, with the longest numbers.
render::ForcePanel full_friction_loop(physics::FrictionLaw law, const Phrases& phrases);
// The dial of a lever that taps, with both states.
render::ForcePanel full_dial(const Phrases& phrases);
// Of either built-in set, with a softened lever.
std::vector<render::DataPanel> full_particles(const Phrases& phrases);
// The questions of a lesson with most words and most answers.
std::vector<LessonPrompt> full_prompts(const Phrases& phrases);

}  // namespace afm::exhibit
