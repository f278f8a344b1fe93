// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "exhibit/scan/scan_choice.h"
#include "exhibit/scan/scan_truth.h"
#include "physics/imaging/scan_loop.h"
#include "physics/imaging/scanner.h"
#include "physics/imaging/tapping_detector.h"
#include "physics/tapping/driven_lever.h"
#include "scene/shared/shared_blocks.h"
#include "scene/shared/tip_blocks.h"

namespace afm::physics {
class TapSurface;
class TapTable;
}  // namespace afm::physics

namespace afm::exhibit {

// A lever in tapping mode, and the surface under it.
struct TappedSubject {
  std::shared_ptr<const physics::TapSurface> surface;
  physics::DrivenLever lever;
  std::shared_ptr<const physics::TapTable> rests;  // table of steady swings; null for a high quality factor
};

// The sample for a scan, in the metres of a microscope. A measured sample is shown and felt at another scale, that of
// the sample's frame, because a lever would meet steps of nanometres instead of micrometres.
struct ScanSubject {
  // Returns the heights traced by the apex of a tip of this radius; finite everywhere.
  std::function<physics::Scanner::Surface(double tip_radius_m)> traced;
  std::function<double(double x_m, double y_m)> drawn_m;  // height of the drawn surface
  double side_m = 500e-9;                                 // side of the scanned square around the origin
  scene::TopographyScale shown{};                         // metres of the sample's frame per metre here
  double tip_radius_m = 0;                                // radius of the probe in use
  double adhesion_n = 0;                                  // pull-off force, magnitude
  std::optional<TappedSubject> tapped{};  // lever in tapping mode; unused for a hand's image, taken in contact
  double slope = 0;                       // slope exceeded almost nowhere; 0: the usual settings suit the sample

  double shown_side_m() const { return shown.lateral * side_m; }
};

// A change of the settings that takes effect at one pixel of a frame.
struct ScanChange {
  std::uint32_t frame = 0;
  std::uint32_t pixel = 0;  // index within that frame in order of time, counting trace and retrace
  ScanChoice choice{};

  bool operator==(const ScanChange&) const = default;
};

// Role of the hand in a scan (scene::ScanHand): the scan leads it, or it is the scanner and paints the image.
struct HandPart {
  bool paints = false;
  bool feedback = true;          // true: the loop sets a painting hand's height; false: the hand does
  double side_m = 0;             // side of the square within the hand's reach, as in ScanSubject
  std::uint64_t first_tick = 0;  // last tick of the servo that does not paint

  bool operator==(const HandPart&) const = default;
};

// State that determines the picture of a scan, together with the sample and, for a painting hand, the servo's samples.
// Sessions record it.
struct ScanProgress {
  std::uint32_t frame = 0;          // number since the scan's start; each frame begins at the top; 0 if a hand paints
  std::uint32_t pixel = 0;          // next pixel of the frame; for a painting hand, the number of ticks so far
  bool truth = false;               // true: surface shown that the tip could not reach
  std::vector<ScanChange> changes;  // settings before the first visible frame, and every change since
  std::optional<HandPart> hand;     // role of the hand; empty: the scan runs by itself

  bool operator==(const ScanProgress&) const = default;
};

// Images of each quantity in both passes, row by row from the top. NaN: not measured yet.
struct ScanMaps {
  std::array<std::vector<double>, 2> height_m;   // trace, retrace; for a painting hand: height, deflection of the lever
  std::array<std::vector<double>, 2> error_n;    // error signal; in tapping mode the amplitude error, metres
  std::array<std::vector<double>, 2> lateral_n;  // trace, retrace; for a painting hand: along x, along y
  // tapping mode only
  std::array<std::vector<double>, 2> phase_deg;  // lag behind the drive
  std::array<std::vector<double>, 2> energy_j;   // energy lost in the sample per swing
};

// Statistics of the tip along one line, both passes.
struct LineFacts {
  double highest_force_n = 0;  // largest force on the lever; in tapping mode largest loss of amplitude, metres
  double off_surface = 0;      // mean fraction of the time off the surface, 0 to 1
  double on_second_apex = 0;   // mean fraction of the time on the second apex, 0 to 1
  double ringing = 0;          // mean fraction of the time with ringing, 0 to 1
};

// Known facts that the image does not show.
struct ScanTruth {
  std::uint32_t frame = 0;  // frame it was computed from
  double tip_radius_m = 0;  // tip radius it was computed with
  ReachOfTip reach;
  TipProfile true_tip;
  TipProfile revealed_tip;  // tip estimated from the last complete image; no points before there is one
};

// The scan on the live wall: frame after frame, each from the top, each replacing the previous one. A pure function of
// its subject and its progress.
// In tapping mode the lever's swing takes the image, unless a hand has a role in the scan.
//
// A painting hand makes no frames: every tick with the hand's tip on the sample paints the cells of kCell x kCell
// pixels on its path; other cells stay unmeasured. With feedback, the microscope's loop (physics::ScanLoop) runs over
// the heights on that path, and its height and residual deflection are painted. Without feedback, the height is the
// hand's own and the deflection that of the felt lever. The lateral force is the friction that the hand feels. One
// thread.
class LiveScan {
 public:
  static constexpr std::size_t kPixels = 128;    // per side
  static constexpr double kMostCatchUpS = 0.25;  // limit for one call of advance(), some milliseconds of work
  static constexpr std::size_t kCell = 2;        // pixels per side of a painted cell

  // Begins a scan with this lever's usual settings.
  explicit LiveScan(ScanSubject subject, const std::optional<HandPart>& hand = {});

  // Restores a scan from a session and its `samples`. `progress` must be valid().
  LiveScan(ScanSubject subject, const ScanProgress& progress, std::span<const scene::TipSample> samples = {});

  // Returns whether a session's values are legal.
  static bool valid(const ScanProgress& progress);

  // Scans for this time. Drops time beyond kMostCatchUpS. No effect for a painting hand.
  void advance(double seconds);

  // Scans up to this pixel, to follow another machine of the wall; no effect for a painting hand. Returns false if it
  // is more than a frame away.
  bool follow(std::uint32_t frame, std::uint32_t pixel);

  // Handles a tick of the servo; call in order. No effect unless a hand paints.
  void follow_hand(const scene::TipSample& sample);

  // Rows of the settings for this scan: those of the drive only in tapping mode with averages.
  std::span<const ScanRow> rows() const;

  // Changes a row of the settings by `steps`, effective from the next pixel on. Returns false at the end of its series.
  bool step(ScanRow row, int steps);

  // Restores the initial settings of the scan.
  void reset();

  // Changes all settings, effective from the next pixel on. `choice` must be valid. No effect if it is for the other
  // mode, contact or tapping.
  void choose(const ScanChoice& choice) {
    if (in_tapping(choice) == in_tapping(usual_)) change_to(choice);
  }

  void show_truth(bool shown);

  const ScanProgress& progress() const { return progress_; }
  const ScanChoice& choice() const { return progress_.changes.back().choice; }
  const ScanChoice& usual() const { return usual_; }
  const ScanSubject& subject() const { return subject_; }
  bool is_painted() const { return progress_.hand && progress_.hand->paints; }  // true: image painted by a hand
  double seen_share() const;                                                    // fraction of the pixels measured
  const std::optional<ScanTruth>& truth() const { return truth_; }              // facts behind the image, if shown
  const ScanMaps& maps() const { return maps_; }
  const std::array<LineFacts, kPixels>& facts() const { return facts_; }  // newest line of each row
  bool is_tapped() const { return scanner_->loop().tapping() != nullptr; }
  const physics::Scanner& scanner() const { return *scanner_; }  // scanner of the current frame
  std::size_t row() const;                                       // current row; 0 is the top
  glm::dvec3 apex_m() const;                                     // position of the apex in the sample's frame
  double force_n() const { return force_n_; }  // force on the lever at the newest pixel; 0 in tapping mode
  // Height traced by the apex at this place, all in the sample's frame.
  double surface_m(double x_m, double y_m) const;

  // Row of the newest complete line; empty before the first.
  std::optional<std::size_t> newest_row() const;

 private:
  void prepare_detector();
  bool hold(const ScanChoice& choice);
  bool changes_drive() const;
  void begin_frame();
  void end_frame();
  void take_until(std::uint32_t pixel);
  void apply(const ScanChoice& choice);
  void change_to(const ScanChoice& wanted);
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
  std::optional<physics::TappingDetector> detector_;  // detector of the swing; empty: every image is taken in contact
  std::optional<physics::Scanner> scanner_;
  ScanMaps maps_;
  std::array<LineFacts, kPixels> facts_{};
  std::vector<double> last_image_m_;  // trace of the previous frame; empty before the second
  double last_noise_m_ = 0;           // noise of the heights in last_image_m_
  std::optional<ScanTruth> truth_;
  double force_n_ = 0;
  double owed_s_ = 0;  // scan time left for the next call

  // The painting hand's position in the previous tick, if it was on the sample.
  struct Brush {
    std::int64_t time_ns = 0;
    double below_m = 0;
    std::size_t column = 0, row = 0;  // position in pixels
  };
  std::optional<Brush> brush_;
  std::optional<physics::ScanLoop> loop_;  // feedback loop of the painting hand
  std::optional<std::int64_t> painting_since_ns_;
  bool feedback_taken_ = false;  // true: feedback switched off by the servo: hand off the sample or without force
  std::size_t hand_row_ = 0;
};

}  // namespace afm::exhibit
