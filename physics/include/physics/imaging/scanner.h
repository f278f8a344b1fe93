// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "physics/imaging/force_swings.h"
#include "physics/imaging/scan_image.h"
#include "physics/imaging/scan_loop.h"
#include "physics/imaging/scan_settings.h"
#include "physics/units.h"

namespace afm::physics {

enum class ScanPass { Trace, Retrace };  // motion along +x, motion along -x

// Record of one pixel, at its centre.
struct ScanPixel {
  std::size_t row = 0;     // row of the image; 0 is the top one, with the largest y
  std::size_t column = 0;  // column of the image; 0 is the left one, on both passes
  ScanPass pass = ScanPass::Trace;
  double height_m = 0;   // recorded height, z + d_set
  double error_n = 0;    // error signal k (d - d_set), with the detector's noise averaged over the pixel
  double lateral_n = 0;  // lateral force, positive along -x: against the trace
  // in tapping mode only, where error_n is the amplitude error A_set - A in metres
  double phase_deg = 0;     // lag of the swing behind the drive
  double energy_j = 0;      // energy lost in the sample per swing
  double peak_force_n = 0;  // force at the lowest point of the swing
  // extremes and shares since the previous pixel
  double lowest_force_n = 0;   // lowest force of the lever
  double highest_force_n = 0;  // highest force of the lever
  double off_surface = 0;      // share of the time without contact, 0 to 1
  double on_second_apex = 0;   // share of the time in contact with the second apex
  double ringing = 0;          // share of the time in which the lever force swings as in a ringing loop
};

// One pass, by column.
struct ScanTrack {
  std::vector<double> height_m;
  std::vector<double> error_n;
  std::vector<double> lateral_n;
  std::vector<double> phase_deg, energy_j, peak_force_n;  // channels of tapping mode, otherwise empty
  double lowest_force_n = 0;
  double highest_force_n = 0;
  double off_surface = 0;
  double on_second_apex = 0;
  double ringing = 0;
};

struct ScanLine {
  std::size_t row = 0;
  ScanTrack trace;
  ScanTrack retrace;
};

// Takes an image of a surface, pixel by pixel, like a microscope in static contact or tapping mode. Its time advances
// with the pixels: a live window calls next() until time() has caught up with the clock, a batch calls it without
// waiting.
//
// - A line is a trace along +x and a retrace along -x at the same speed; between lines the tip moves to the next row
//   within one pixel's time. Pixel (column, row) is at ((column + 1/2)/columns, (row + 1/2)/rows) of the area.
// - Changed settings and surfaces take effect from the next pixel on.
// - The surface is evaluated up to kSurfaceSamples times per pixel; in between its height is linear in time.
// - The same seed and calls give the same image, bit for bit.
//
// One thread. next() does not allocate.
class Scanner {
 public:
  // Height traced by the apex at a place of the sample, in metres: the surface dilated by the tip. Finite everywhere.
  using Surface = std::function<double(double x_m, double y_m)>;

  static constexpr std::size_t kSurfaceSamples = 16;

  // Throws UnphysicalValue as validate() does. `surface` must not be empty.
  Scanner(const ScanArea& area, const ScanSettings& settings, Surface surface, std::uint64_t seed = 1,
          std::optional<TappingDetector> tapping = std::nullopt);

  // Throws UnphysicalValue as validate() does, without any change.
  void change(const ScanSettings& settings);
  // In tapping mode: changes the drive of the same lever and the amplitude to keep. Throws as
  // TappingDetector::drive().
  void drive(const DrivenLever& lever, Length setpoint);
  void change_surface(Surface surface);  // changes the sample or the tip
  const ScanSettings& settings() const noexcept { return settings_; }
  const ScanArea& area() const noexcept { return area_; }

  // Begins a frame: lifts the tip, moves to the first row and engages. Time and drift continue. The constructor begins
  // the first frame, downwards.
  void begin_frame(SlowDirection direction);

  // Scans the next pixel. Empty: the frame is complete.
  std::optional<ScanPixel> next();

  // Scans the rest of the current line. Returns false if the frame was complete. Vectors grow only once.
  bool next_line(ScanLine& line);

  Time time() const noexcept { return Time(time_s_); }  // time since the scanner was created
  Time pixel_time() const noexcept;
  std::size_t row() const noexcept { return row_; }  // row of the next pixel
  // Current position of the apex, in the area's frame at time zero, for drawing it.
  double x_m() const noexcept { return x_m_; }
  double y_m() const noexcept { return y_m_; }
  double z_m() const noexcept;  // height of the apex, including the lever's deflection
  bool touching() const noexcept { return loop_.touching(); }
  const ScanLoop& loop() const noexcept { return loop_; }

 private:
  struct Below {
    double height_m;
    bool second_apex;
  };
  Below below(double x_m, double y_m) const;
  void scan_to(double x_m, double y_m, ScanPixel& pixel);
  void scan_segment(double x_m, double y_m, ScanPixel& pixel);
  double row_y_m(std::size_t row) const noexcept;
  double tick_length() noexcept;
  void look_for_swings() noexcept;

  ScanArea area_;
  ScanSettings settings_;
  Surface surface_;
  std::size_t segments_ = 1, ticks_of_segment_ = 1;  // segments per pixel and ticks per segment
  double tick_s_ = 0;
  ScanLoop loop_;
  ForceSwings swings_;
  SlowDirection direction_ = SlowDirection::Down;
  std::size_t row_ = 0, lines_done_ = 0, step_ = 0;  // step_: pixel within the line, 0 to 2 * columns
  double time_s_ = 0, x_m_ = 0, y_m_ = 0;
  double height_m_ = 0, slope_ = 0;  // height and slope of the surface below the apex
  bool engaged_ = false;
};

// Lateral force on a tip that slides over a slope with lever load `normal`, adhesion and friction coefficient mu,
// positive against a motion along +x (Ogletree, Carpick & Salmeron, Rev. Sci. Instrum. 67, 3298 (1996), wedge): (N
// sin(theta) +- mu (N cos(theta) + A))/(cos(theta) -+ mu sin(theta)), + and upper signs along +x. Gwyddion 2.62's
// latsim stores the value of the retrace with the other sign. `slope` is dh/dx = tan(theta).
Force lateral_force(Force normal, Force adhesion, double slope, double mu, ScanPass pass) noexcept;

// Scans the rest of a frame into channels "Height", "Error" and "Lateral force", in tapping mode "Height", "Amplitude
// error", "Phase" (deg), "Energy dissipated" and "Peak force", each also with " (retrace)"; without
// metadata, NaN where it was not scanned. Calls `taken` with each line; the scan ends if it returns false.
ScanImage scan_frame(Scanner& scanner, const std::function<bool(const ScanLine&)>& taken = nullptr);

}  // namespace afm::physics
