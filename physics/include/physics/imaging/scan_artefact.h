// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "physics/imaging/scanner.h"
#include "physics/rows_of_enum.h"

namespace afm::physics {

class TappingDetector;

// Artefacts of an image. Names and phrases of the wall are in this order.
enum class ScanArtefact {
  None,
  LostContact,  // the tip is above the sample: setpoint too low, or the sample drifted away
  Ringing,      // the loop oscillates: gain too high for the z scanner or the tick rate
  Parachuting,  // behind a step down the tip is off (tapping: the error saturates) and the image a slope: too fast, or
                // setpoint too near to the free state
  StateFlips,   // tapping: the swing changes between its two states, which have different heights at one amplitude
  Saturation,   // tapping: in front of a step up the swing stops, and the image is a slope: too fast
  Overload,     // force above three times the setpoint in front of a step up
  DoubleTip,    // second apex, which causes ghosts
  Drift,        // the sample moves during the scan: the image is sheared or stretched
  Noise,        // detector noise as large as the relief
  Blur,         // the loop is too slow: the image is flatter than the sample, and trace and retrace differ
  BluntTip,     // dents close and bumps grow wide: visible only by comparison with a sharper tip
};

struct ScanArtefactName {
  ScanArtefact artefact;
  std::string_view name;  // name in --json
};

inline constexpr std::array kScanArtefacts{
    ScanArtefactName{ScanArtefact::None, "none"},
    ScanArtefactName{ScanArtefact::LostContact, "lost-contact"},
    ScanArtefactName{ScanArtefact::Ringing, "ringing"},
    ScanArtefactName{ScanArtefact::Parachuting, "parachuting"},
    ScanArtefactName{ScanArtefact::StateFlips, "state-flips"},
    ScanArtefactName{ScanArtefact::Saturation, "saturation"},
    ScanArtefactName{ScanArtefact::Overload, "overload"},
    ScanArtefactName{ScanArtefact::DoubleTip, "double-tip"},
    ScanArtefactName{ScanArtefact::Drift, "drift"},
    ScanArtefactName{ScanArtefact::Noise, "noise"},
    ScanArtefactName{ScanArtefact::Blur, "blur"},
    ScanArtefactName{ScanArtefact::BluntTip, "blunt-tip"},
};
static_assert(has_row_for_each(kScanArtefacts, &ScanArtefactName::artefact));

std::string_view name_of(ScanArtefact artefact);

// Observations in the newest lines of a scan, both passes of each.
struct ScanEvidence {
  double off_surface = 0;      // largest share of a line's time without contact
  double on_second_apex = 0;   // largest share of a line's time on the second apex
  double ringing = 0;          // largest share of a line's time in which the loop oscillates
  double highest_force_n = 0;  // highest force of the lever; in tapping mode largest loss of amplitude, metres
  double state_changes = 0;    // largest number of changes of state in a line's two passes (tapping mode)
  double relief_m = 0;         // range of the measured heights
  double noise_m = 0;          // largest noise_of_lines_m() of two neighbouring lines
  double apart_m = 0;          // largest mean difference of a line's trace and retrace, a magnitude
  double time_s = 0;           // time since the start of the scan, during which drift adds up
  double bluntness = 1;        // ratio of the tip's radius to that of a sharper one; 1: no other tip is known
};

// Trace minus retrace, by column. NaN where a pass has no height.
std::vector<double> difference_of_passes(std::span<const double> trace_m, std::span<const double> retrace_m);

// Standard deviation of the noise in the heights, from the differences of the passes of two neighbouring lines: a
// sample, a slow loop and a bent scanner make them alike, noise does not. Robust against steps. Zero for empty ones.
double noise_of_lines_m(std::span<const double> passes_m, std::span<const double> passes_before_m);

// Mean magnitude of the difference of a line's passes.
double mean_apart_m(std::span<const double> passes_m);

// Number of times that a swing changes from repulsive to attractive or back and stays there for some pixels, from the
// phases of one pass in degrees; the free swing's is 90 at resonance, and a swing near it belongs to neither.
std::size_t changes_of_state(std::span<const double> phase_deg, double free_phase_deg);

// Number of newest lines that are judged, so that a single different line does not change the verdict.
inline constexpr std::size_t kJudgedLines = 6;

// Evidence of the lines of an image, added in the order of scanning: of the newest kJudgedLines, with the relief of
// all.
class NewestLines {
 public:
  // `tapping`: the detector of a scan in tapping mode.
  explicit NewestLines(const TappingDetector* tapping = nullptr);

  // `time_s`: at the end of the line, since the start of the scan.
  void add(const ScanLine& line, double time_s);
  ScanEvidence evidence() const;

 private:
  double free_phase_deg_;
  std::array<ScanEvidence, kJudgedLines> newest_{};
  std::size_t next_ = 0;          // place in newest_ of the next line
  std::vector<double> passes_m_;  // difference of the newest line's passes
  double time_s_ = 0;
  double low_m_ = HUGE_VAL, high_m_ = -HUGE_VAL;
};

// Inputs of the judgement in addition to the lines.
struct ScanConditions {
  const ScanSettings& settings;
  const ScanArea& area;
  Frequency largest_integral_gain;           // limit of stability, ScanLoop::largest_integral_gain()
  const TappingDetector* tapping = nullptr;  // detector of a scan in tapping mode; null: contact mode
};

// The only judge for wall and --json: of the artefacts found, the one that hides all others. First a tip that is off or
// doubled; then an image that oscillates, drifts or is noise, which also lifts the tip; last the effects of a slow loop
// on a clean image. Each is named where the lines show it; the settings only say which cause they can have.
ScanArtefact main_artefact(const ScanConditions& conditions, const ScanEvidence& evidence);

}  // namespace afm::physics
