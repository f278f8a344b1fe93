// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "physics/imaging/scanner.h"
#include "physics/rows_of_enum.h"

namespace afm::physics {

// What keeps an image from showing the sample. Names and phrases of the wall are in this order.
enum class ScanArtefact {
  None,
  LostContact,  // the tip hangs above the sample: setpoint too low, or the sample drifted away
  Ringing,      // the loop swings by itself: gain too high for the z scanner or the feedback's ticks
  Parachuting,  // behind a step down the tip is off, and the image a slope: too fast, or setpoint too low
  Overload,     // in front of a step up the lever presses harder than three times the setpoint
  DoubleTip,    // a second apex draws ghosts
  Drift,        // the sample moves on while it is scanned: the image is sheared or stretched
  Noise,        // detector noise as large as the relief
  Blur,         // the loop is too slow: the image is flatter than the sample, and trace and retrace part
  BluntTip,     // dents close and bumps grow wide: visible only by comparison with a sharper tip
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
static_assert(has_row_for_each(kScanArtefacts, &ScanArtefactName::artefact));

std::string_view name_of(ScanArtefact artefact);

// What the newest lines of a scan show, both passes of each.
struct ScanEvidence {
  double off_surface = 0;      // largest share of a line's time without contact
  double on_second_apex = 0;   // largest share of a line's time on the second apex
  double highest_force_n = 0;  // force of the lever
  double relief_m = 0;         // from the lowest to the highest place that was measured
  double bluntness = 1;        // radius of the tip over that of a sharper one; 1: no other tip is known
};

// Evidence of one line alone.
ScanEvidence evidence_of(const ScanLine& line);

// A scan is judged by its newest lines, so that one that differs does not change the verdict.
inline constexpr std::size_t kJudgedLines = 6;

// Evidence of the lines of an image, in the order in which they are taken: of the newest kJudgedLines, with the relief
// of all.
class NewestLines {
 public:
  void add(const ScanLine& line);
  ScanEvidence evidence() const;

 private:
  std::array<ScanEvidence, kJudgedLines> newest_{};
  std::size_t next_ = 0;  // place of the next line in newest_
  double low_m_ = HUGE_VAL, high_m_ = -HUGE_VAL;
};

// What a scan is judged by besides its lines.
struct ScanConditions {
  const ScanSettings& settings;
  const ScanArea& area;
  Frequency largest_integral_gain;  // ScanLoop::largest_integral_gain()
};

// The one judge of wall and --json: of the artefacts that hold, the one that hides the others. A tip that is off or
// doubled is seen first, then an image that swings, drifts or is noise, which lifts the tip as well; what a slow loop
// does to a clean image comes last.
ScanArtefact main_artefact(const ScanConditions& conditions, const ScanEvidence& evidence);

}  // namespace afm::physics
