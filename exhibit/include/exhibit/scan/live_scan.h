// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "exhibit/scan/scan_choice.h"
#include "exhibit/scan/scan_truth.h"
#include "physics/imaging/scan_loop.h"
#include "physics/imaging/scanner.h"
#include "scene/shared/shared_blocks.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// The sample as a scan meets it, in metres as a microscope has them. What an instrument measured is shown and felt on
// another scale, the sample's frame: micrometres would be steps of nanometres for a lever.
struct ScanSubject {
  // The height that the apex of a tip of this radius traces, everywhere finite.
  std::function<physics::Scanner::Surface(double tip_radius_m)> traced;
  std::function<double(double x_m, double y_m)> drawn_m;  // the sample itself
  double side_m = 500e-9;                                 // of the square around the origin that is scanned
  scene::TopographyScale shown{};                         // metres of the sample's frame for one of these
  double tip_radius_m = 0;                                // of the probe in use
  double adhesion_n = 0;                                  // the pull-off force, a magnitude
  double slope = 0;                                       // of nearly all places; 0: the usual settings suit it

  double shown_side_m() const { return shown.lateral * side_m; }
};

// A change of the settings, from the pixel of a frame on.
struct ScanChange {
  std::uint32_t frame = 0;
  std::uint32_t pixel = 0;  // of that frame in the order of time, trace and retrace counted
  ScanChoice choice{};

  bool operator==(const ScanChange&) const = default;
};

// The part of a hand in a scan (scene::ScanHand): it is led, or it is the scanner and paints the image.
struct HandPart {
  bool paints = false;
  bool feedback = true;          // of one that paints: the height is the loop's; without it, the hand's own
  double side_m = 0;             // of the square, which the hand can reach, as in ScanSubject
  std::uint64_t first_tick = 0;  // of the servo: those after it paint

  bool operator==(const HandPart&) const = default;
};

// All that the picture of a scan follows from, with the sample and, where a hand paints, the servo's samples: what a
// session records.
struct ScanProgress {
  std::uint32_t frame = 0;          // since the scan was started; each begins at the top. 0 where a hand paints
  std::uint32_t pixel = 0;          // that comes next in it; where a hand paints, how many ticks have passed
  bool truth = false;               // shown: what the tip could not reach
  std::vector<ScanChange> changes;  // the settings before the first frame that is still seen, and every change since
  std::optional<HandPart> hand;     // none: the scan is left to itself

  bool operator==(const ScanProgress&) const = default;
};

// A quantity of both passes, row by row from the top; NaN: not measured yet.
struct ScanMaps {
  std::array<std::vector<double>, 2> height_m;  // trace, retrace; painted by a hand: height, the lever's deflection
  std::array<std::vector<double>, 2> error_n;
  std::array<std::vector<double>, 2> lateral_n;  // trace, retrace; painted by a hand: along x, along y
};

// What happened to the tip along one line, both passes.
struct LineFacts {
  double highest_force_n = 0;  // of the lever
  double off_surface = 0;      // mean share of the time, 0 to 1
  double on_second_apex = 0;   // likewise
};

// What the image does not show, as far as it is known.
struct ScanTruth {
  std::uint32_t frame = 0;  // with which it was found
  double tip_radius_m = 0;  // likewise
  ReachOfTip reach;
  TipProfile true_tip;
  TipProfile revealed_tip;  // by the last whole image; without points before there is one
};

// The scan that the live wall shows: frame after frame, each from the top, the newest over the one before it. A pure
// function of its subject and its progress.
//
// Where a hand paints, there are no frames: every tick in which the hand's tip is on the sample paints the cells of
// kCell x kCell pixels on its way; others stay unmeasured. With feedback the microscope's loop (physics::ScanLoop) runs
// over the heights on that way: its height and the residual deflection are painted. Without, the height is the hand's
// own and the deflection is that of the felt lever. The lateral force is the friction that the hand feels. One thread.
class LiveScan {
 public:
  static constexpr std::size_t kPixels = 128;    // a side
  static constexpr double kMostCatchUpS = 0.25;  // of scan that one call of advance() does: some milliseconds of work
  static constexpr std::size_t kCell = 2;        // pixels, of what a hand paints

  // A scan with this lever's usual settings.
  explicit LiveScan(ScanSubject subject, const std::optional<HandPart>& hand = {});

  // The scan as it was: of a session, with its `samples`. `progress` is valid().
  LiveScan(ScanSubject subject, const ScanProgress& progress, std::span<const scene::TipSample> samples = {});

  // True for what a session may have recorded.
  static bool valid(const ScanProgress& progress);

  // Scans on for so long; what is more than kMostCatchUpS is left out. Nothing where a hand paints.
  void advance(double seconds);

  // Scans on until this pixel, as another machine of the wall has done; nothing where a hand paints. False: it is more
  // than a frame away.
  bool follow(std::uint32_t frame, std::uint32_t pixel);

  // A tick of the servo, in their order. Nothing where no hand paints.
  void follow_hand(const scene::TipSample& sample);

  // One step of a row, from the next pixel on; false at the end of its series.
  bool step(ScanRow row, int steps);

  // The settings that a scan begins with.
  void reset();

  // All at once, from the next pixel on; valid.
  void choose(const ScanChoice& choice) { change_to(choice); }

  void show_truth(bool shown);

  const ScanProgress& progress() const { return progress_; }
  const ScanChoice& choice() const { return progress_.changes.back().choice; }
  const ScanChoice& usual() const { return usual_; }
  const ScanSubject& subject() const { return subject_; }
  bool is_painted() const { return progress_.hand && progress_.hand->paints; }  // by a hand
  double seen_share() const;                                                    // of the pixels
  const std::optional<ScanTruth>& truth() const { return truth_; }              // there while it is shown
  const ScanMaps& maps() const { return maps_; }
  const std::array<LineFacts, kPixels>& facts() const { return facts_; }  // by row, of the newest line there
  const physics::Scanner& scanner() const { return *scanner_; }           // of the present frame
  std::size_t row() const;                                                // that is scanned now, 0 is the top one
  glm::dvec3 apex_m() const;                                              // in the sample's frame
  double force_n() const { return force_n_; }                             // on the lever, of the newest pixel
  // The height that the apex traces, both in the sample's frame.
  double surface_m(double x_m, double y_m) const;

  // The newest whole line of both passes, by its row; none before the first.
  std::optional<std::size_t> newest_row() const;

 private:
  void begin_frame();
  void end_frame();
  void take_until(std::uint32_t pixel);
  void apply(const ScanChoice& choice);
  void change_to(const ScanChoice& choice);
  bool next_pixel();
  void find_truth();
  void paint(const scene::TipSample& sample);
  double below_m(double x_m, double y_m, double seconds) const;
  void color_way(std::size_t column, std::size_t row, const std::array<double, 4>& values);

  ScanSubject subject_;
  ScanChoice usual_;
  ScanChoice applied_;
  ScanProgress progress_;
  physics::Scanner::Surface traced_;
  std::optional<physics::Scanner> scanner_;
  ScanMaps maps_;
  std::array<LineFacts, kPixels> facts_{};
  std::vector<double> last_image_m_;  // the trace of the frame before the newest; empty before the second
  double last_noise_m_ = 0;           // of its heights
  std::optional<ScanTruth> truth_;
  double force_n_ = 0;
  double owed_s_ = 0;  // of scan time that the next call has to do

  // The hand that paints: where it was in the tick before, if it was on the sample then.
  struct Brush {
    std::int64_t time_ns = 0;
    double below_m = 0;
    std::size_t column = 0, row = 0;  // pixels
  };
  std::optional<Brush> brush_;
  std::optional<physics::ScanLoop> loop_;  // of its feedback
  std::optional<std::int64_t> painting_since_ns_;
  bool feedback_taken_ = false;  // by the servo, which takes it off the sample or without force
  std::size_t hand_row_ = 0;
};

}  // namespace afm::exhibit
