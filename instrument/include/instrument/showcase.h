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
  std::shared_ptr<const curves::ContactSetup> setup;  // contact with the worn tip, shared with the showcase
  double x_m = 0, y_m = 0, surface_m = 0;             // position of the tip, and height of the sample there
  double z_m = 0;                                     // height of the lever's base above the surface below it
  double force_n = 0;                                 // force on the lever
  bool touching = false;
  std::shared_ptr<const physics::ForceCurve> curve;  // newest curve, shared with the showcase; null: none
  std::uint64_t curves = 0;                          // number of curves so far
  struct Image {
    std::uint64_t number = 0;  // number of the image; zero: there is none
    std::size_t columns = 0, rows = 0;
    double width_m = 0, height_m = 0, line_rate_hz = 0;
    double turn_rad = 0;       // angle from the sample's x axis to the image's
    std::uint64_t curves = 0;  // number of curves before the image
    bool running = false;
  };
  Image image;
  std::vector<physics::ScanLine> lines;  // lines of the newest image that have not been fetched yet
};

// Carries the newest state from the instrument's thread to a window's. State that the window does not fetch in time is
// replaced by newer state, so the showcase holds at most one curve and the lines of one image. Neither thread waits
// longer than the other takes to copy a few pointers.
class Showcase {
 public:
  // Called by the instrument's thread.
  void put_contact(const curves::ContactSetup& setup);
  void put_place(double x_m, double y_m, double surface_m, double z_m, double force_n, bool touching);
  void put_curve(const physics::ForceCurve& curve);
  void begin_image(const physics::ScanArea& area, double line_rate_hz, double turn_rad);
  void put_line(const physics::ScanLine& line);
  void end_image();

  // Called by the window's thread: everything so far. Moves the lines if `shows`, a short call, accepts the material.
  using Shows = std::function<bool(const std::string& material)>;
  Shown look(const Shows& shows = {});

 private:
  std::mutex mutex_;
  Shown newest_;
};

}  // namespace afm::instrument
