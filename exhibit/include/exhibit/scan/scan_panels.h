// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "exhibit/scan/live_scan.h"
#include "exhibit/state/moment.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"

namespace afm::exhibit {

// The images of a scan so far, with the newest line; or, where the truth is shown, with what the tip could not reach
// and the tip that the image alone reveals. Painted by a hand: height, deflection and lateral forces.
render::ImagePanel image_panel(const LiveScan& scan, const std::string& sample, const Phrases& phrases);

// The settings of a scan, in the order of ScanRow, with its cause of error as the status. `title` as it is to be read.
render::ControlPanel scan_panel(const LiveScan& scan, const std::string& title, const Phrases& phrases);

// One line for the wall: what is wrong with the image and why, or how to change it.
std::string scan_guidance(const LiveScan& scan, const Phrases& phrases);

// True where the tip is the hand's: in contact or with force. Then the wall shows it at the hand.
bool hand_uses_tip(const scene::TipState& tip);

// Shows the scan on the sample: its line, and, as long as the hand does not use the tip, the tip; also where the tip
// leads the hand. Painted by a hand, the tip is the hand's. `scan` must outlive the moment.
void show_scan(const LiveScan& scan, Moment& moment);

}  // namespace afm::exhibit
