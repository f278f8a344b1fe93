// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "exhibit/scan/live_scan.h"
#include "exhibit/state/moment.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"

namespace afm::exhibit {

// The images of a scan so far, with the newest line; with the truth shown, also the surface that the tip could not
// reach and the tip estimated from the image. For a painting hand: height, deflection and lateral forces.
render::ImagePanel image_panel(const LiveScan& scan, const std::string& sample, const Phrases& phrases);

// The settings of a scan, in the order of ScanRow, with the cause of an artefact as the status. `title` is in the
// language of the wall.
render::ControlPanel scan_panel(const LiveScan& scan, const std::string& title, const Phrases& phrases);

// One line for the wall: the image's artefact and its cause, or how to change the settings.
std::string scan_guidance(const LiveScan& scan, const Phrases& phrases);

// True if the hand moves the tip, in contact or with force. The wall then draws it at the hand.
bool hand_uses_tip(const scene::TipState& tip);

// Shows the scan on the sample: its line, and the tip unless the hand has it; also while the tip leads the hand. In a
// hand-painted scan the tip is always the hand's. `scan` must outlive the moment.
void show_scan(const LiveScan& scan, Moment& moment);

}  // namespace afm::exhibit
