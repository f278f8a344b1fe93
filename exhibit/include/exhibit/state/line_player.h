// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/imaging/scanner.h"

namespace afm::exhibit {

// Plays a line of an image that was measured in an instant at a pace that people can follow: along the trace, then back
// along the retrace. One thread.
class LinePlayer {
 public:
  static constexpr double kSeconds = 1.0;  // time for trace and retrace together, whatever the line's length

  struct Place {
    double along = 0.5;      // fraction of the image's width, from the left edge
    double height_m = 0;     // height measured at that place
    double error_n = 0;      // error signal measured at that place; zero in tapping mode
    bool returning = false;  // true: on the retrace; false: on the trace
  };

  // Begins with the first pixel of the trace. A line without pixels ends at once.
  void begin(physics::ScanLine line);

  // Advances the playback.
  void advance(double seconds);

  bool playing() const { return seconds_ < kSeconds; }

  // Place on the line, interpolated between two pixels. Only while playing().
  Place place() const;
  std::size_t row() const { return line_.row; }

 private:
  physics::ScanLine line_;
  double seconds_ = kSeconds;
};

}  // namespace afm::exhibit
