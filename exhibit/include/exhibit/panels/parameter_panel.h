// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "curves/live_parameters.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"

namespace afm::exhibit {

// State of a parameter change, for display.
enum class ChangeState { AsLoaded, Waiting, Applied, Refused, Held };

// Buttons of the panel, in order.
enum class PanelButton { Reset, Close };

// A material's parameters and the values that follow from them, for the wall. `title` is in the language of the wall.
// `drawn_by` is the name of the graphics device; empty: not shown.
render::ControlPanel parameter_panel(const curves::LiveParameters& parameters, const std::string& title,
                                     ChangeState state, const Phrases& phrases, const std::string& drawn_by = {});

// Adds the predicted curve behind the felt ones.
void add_forecast(const curves::LiveParameters& parameters, const Phrases& phrases, render::ForcePanel& panel);

// Same for changed parameters, with axes and markers that fit them.
void add_prediction(const curves::LiveParameters& parameters, const Phrases& phrases, render::ForcePanel& panel);

}  // namespace afm::exhibit
