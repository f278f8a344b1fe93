// SPDX-License-Identifier: Apache-2.0
#include "instrument/showcase.h"

#include <utility>

namespace afm::instrument {

void Showcase::put_contact(const curves::ContactSetup& setup) {
  auto copy = std::make_shared<const curves::ContactSetup>(setup);
  const std::lock_guard lock(mutex_);
  newest_.setup = std::move(copy);
}

void Showcase::put_place(double x_m, double y_m, double surface_m, double z_m, double force_n, bool touching) {
  const std::lock_guard lock(mutex_);
  newest_.x_m = x_m;
  newest_.y_m = y_m;
  newest_.surface_m = surface_m;
  newest_.z_m = z_m;
  newest_.force_n = force_n;
  newest_.touching = touching;
}

void Showcase::put_curve(const physics::ForceCurve& curve) {
  auto copy = std::make_shared<const physics::ForceCurve>(curve);
  const std::lock_guard lock(mutex_);
  newest_.curve = std::move(copy);
  ++newest_.curves;
}

void Showcase::begin_image(const physics::ScanArea& area, double line_rate_hz, double turn_rad) {
  const std::lock_guard lock(mutex_);
  newest_.image = {.number = newest_.image.number + 1,
                   .columns = area.columns,
                   .rows = area.rows,
                   .width_m = area.width.si,
                   .height_m = area.height.si,
                   .line_rate_hz = line_rate_hz,
                   .turn_rad = turn_rad,
                   .curves = newest_.curves,
                   .running = true};
  newest_.lines.clear();
}

void Showcase::put_line(const physics::ScanLine& line) {
  physics::ScanLine copy(line);
  const std::lock_guard lock(mutex_);
  newest_.lines.push_back(std::move(copy));
}

void Showcase::end_image() {
  const std::lock_guard lock(mutex_);
  newest_.image.running = false;
}

Shown Showcase::look(const Shows& shows) {
  const std::lock_guard lock(mutex_);
  std::vector<physics::ScanLine> lines = std::exchange(newest_.lines, {});
  Shown shown(newest_);
  (shows && newest_.setup && !shows(newest_.setup->material.name) ? newest_ : shown).lines = std::move(lines);
  return shown;
}

}  // namespace afm::instrument
