// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "curves/live_parameters.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"

namespace afm::exhibit {

// The state of a change, for people.
enum class ChangeState { AsLoaded, Waiting, Applied, Refused };

// The buttons of the panel, in their order.
enum class PanelButton { Reset, Close };

// The parameters of a material with what follows from them, for the wall. `title` as it is to be read.
render::ControlPanel parameter_panel(const curves::LiveParameters& parameters, const std::string& title,
                                     ChangeState state, const Phrases& phrases);

// The predicted curve behind the felt ones, with axes and markers that suit it.
void add_prediction(const curves::LiveParameters& parameters, const Phrases& phrases, render::ForcePanel& panel);

}  // namespace afm::exhibit
