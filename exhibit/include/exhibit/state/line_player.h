// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/imaging/scanner.h"

namespace afm::exhibit {

// Plays a line of an image that was measured in an instant at a pace that people can follow: along the trace, then back
// along the retrace. One thread.
class LinePlayer {
 public:
  static constexpr double kSeconds = 1.0;  // time for both ways, whatever the line's length

  struct Place {
    double along = 0.5;      // share of the image's width, from its left edge
    double height_m = 0;     // height as measured there
    double error_n = 0;      // normal force beside the setpoint, as measured there; zero in tapping mode
    bool returning = false;  // retrace instead of trace
  };

  // Begins with the first pixel of the trace. A line without pixels is over at once.
  void begin(physics::ScanLine line);

  // Lets time pass.
  void advance(double seconds);

  bool playing() const { return seconds_ < kSeconds; }

  // Between two pixels linear. Only while playing().
  Place place() const;
  std::size_t row() const { return line_.row; }

 private:
  physics::ScanLine line_;
  double seconds_ = kSeconds;
};

}  // namespace afm::exhibit
