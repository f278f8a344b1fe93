// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "curves/contact_setup.h"
#include "physics/force_curve.h"
#include "physics/imaging/scanner.h"

namespace afm::instrument {

// State of an instrument, for a window that shows it. SI.
struct Shown {
  std::shared_ptr<const curves::ContactSetup> setup;  // shared with the showcase; with the worn tip
  double x_m = 0, y_m = 0, surface_m = 0;             // place of the tip on the sample, whose height it is
  double z_m = 0;                                     // lever's base above the surface below it
  double force_n = 0;                                 // on the lever
  bool touching = false;
  std::shared_ptr<const physics::ForceCurve> curve;  // newest, shared with the showcase; null: none
  std::uint64_t curves = 0;                          // number so far
  struct Image {
    std::uint64_t number = 0;  // zero: there is none
    std::size_t columns = 0, rows = 0;
    double width_m = 0, height_m = 0, line_rate_hz = 0;
    double turn_rad = 0;       // from the sample's x to the image's
    std::uint64_t curves = 0;  // number before it
    bool running = false;
  };
  Image image;
  std::vector<physics::ScanLine> lines;  // lines of the newest image, not yet shown
};

// Carries the newest state from the instrument's thread to a window's. State that the window does not fetch in time is
// replaced by newer state, so the showcase holds at most one curve and the lines of one image. Neither thread waits
// longer than the other takes to copy a few pointers.
class Showcase {
 public:
  // By the instrument's thread.
  void put_contact(const curves::ContactSetup& setup);
  void put_place(double x_m, double y_m, double surface_m, double z_m, double force_n, bool touching);
  void put_curve(const physics::ForceCurve& curve);
  void begin_image(const physics::ScanArea& area, double line_rate_hz, double turn_rad);
  void put_line(const physics::ScanLine& line);
  void end_image();

  // By the window's thread: everything so far. Takes the lines out if `shows` accepts the material; it must be short.
  using Shows = std::function<bool(const std::string& material)>;
  Shown look(const Shows& shows = {});

 private:
  std::mutex mutex_;
  Shown newest_;
};

}  // namespace afm::instrument
