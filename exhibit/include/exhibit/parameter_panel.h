// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "curves/live_parameters.h"
#include "render/frame.h"

namespace afm::exhibit {

// What has become of a change, for people.
enum class ChangeState { AsLoaded, Waiting, Applied, Refused };

// The buttons of the panel, in their order.
enum class PanelButton { Reset, Close };

// The parameters of a material with what follows from them, for the wall.
render::ControlPanel parameter_panel(const curves::LiveParameters& parameters, const std::string& title,
                                     ChangeState state);

// The predicted curve behind the felt ones, with axes and markers that suit it.
void add_prediction(const curves::LiveParameters& parameters, render::ForcePanel& panel);

}  // namespace afm::exhibit
