// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "curves/svg_plot.h"
#include "physics/adhesion_map.h"
#include "physics/units.h"

namespace afm::curves {

// The adhesion map of Johnson & Greenwood 1997 with one contact: Tabor parameter to the right, magnitude of the load in
// units of pi W R upwards. The borders are where physics::regime_of() changes. The contact is drawn at its pull-off
// force, or at the edge if it is outside.
SvgPlot adhesion_map_plot(const std::string& title, const physics::LawChoice& place,
                          const physics::ContactParameters& contact, physics::Force pull_off);

}  // namespace afm::curves
