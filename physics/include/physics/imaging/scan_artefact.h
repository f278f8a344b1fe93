// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "physics/imaging/scanner.h"

namespace afm::physics {

// What keeps an image from showing the sample. Names and phrases of the wall follow this order.
enum class ScanArtefact {
  None,
  LostContact,  // the tip hangs above the sample: setpoint too low, or the sample drifted away
  Ringing,      // the loop swings by itself: gain too high for the z scanner or the feedback's ticks
  Parachuting,  // behind a step down the tip is off, and the image a slope: too fast, or setpoint too low
  Overload,     // in front of a step up the lever presses harder than twice the setpoint
  DoubleTip,    // a second apex draws ghosts
  Drift,        // the sample moves on while it is scanned: the image is sheared or stretched
  Noise,        // of the detector, as large as the relief
  Blur,         // the loop is too slow: the image is flatter than the sample, and trace and retrace part
  BluntTip,     // dents close and bumps grow wide: known only to who knows a sharper tip
};

struct ScanArtefactName {
  ScanArtefact artefact;
  std::string_view name;  // as --json has it
};

inline constexpr std::array kScanArtefacts{
    ScanArtefactName{ScanArtefact::None, "none"},         ScanArtefactName{ScanArtefact::LostContact, "lost-contact"},
    ScanArtefactName{ScanArtefact::Ringing, "ringing"},   ScanArtefactName{ScanArtefact::Parachuting, "parachuting"},
    ScanArtefactName{ScanArtefact::Overload, "overload"}, ScanArtefactName{ScanArtefact::DoubleTip, "double-tip"},
    ScanArtefactName{ScanArtefact::Drift, "drift"},       ScanArtefactName{ScanArtefact::Noise, "noise"},
    ScanArtefactName{ScanArtefact::Blur, "blur"},         ScanArtefactName{ScanArtefact::BluntTip, "blunt-tip"},
};

std::string_view name_of(ScanArtefact artefact);

// The one that explains best what the newest line shows, the first in the order of the enum that holds; never BluntTip,
// since a scanner knows the traced surface alone. `line` is one that `scanner` took with its present settings.
ScanArtefact main_artefact(const Scanner& scanner, const ScanLine& line);

}  // namespace afm::physics
